"""Bearings that have a name: the presets, the catalogue by designation, those of a drawing."""
