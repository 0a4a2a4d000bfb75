"""Static answers of a scene: what its contacts carry and what that costs."""
