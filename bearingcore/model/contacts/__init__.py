"""Contacts of a ball or roller with its races: stiffness, ellipse or strip, pressure."""
