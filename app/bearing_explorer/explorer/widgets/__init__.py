"""Widgets of the scene."""
