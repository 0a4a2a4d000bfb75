"""The overview: the whole chain from the loads of the balls to the vibration, on one screen."""
