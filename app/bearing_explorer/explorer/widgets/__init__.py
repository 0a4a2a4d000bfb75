"""Panels of controls, lessons and links of the scene."""
