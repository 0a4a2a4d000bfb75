"""The scene: its controls, results, views and lessons."""
