"""Widgets of a measured signal."""
