"""Bearings: a file a kind, presets and the catalogue by designation, what a drawing says.

A bearing is rows; a row is elements, a place, and a contact that says its own kinematics. No file
here imports one that imports it.
"""

from bearingcore.bearings.kinds import KINDS

__all__ = ["KINDS"]
