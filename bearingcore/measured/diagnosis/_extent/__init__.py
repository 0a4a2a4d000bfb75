"""The extent of a spall from the time between a ball's entry and its exit."""
