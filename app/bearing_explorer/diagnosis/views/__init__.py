"""Views of a measured signal."""
