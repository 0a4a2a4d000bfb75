"""Widgets of both halves."""
