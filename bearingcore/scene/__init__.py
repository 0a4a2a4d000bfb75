"""Scenes: bearing, defects, load, support. Values only; nothing is solved here."""
