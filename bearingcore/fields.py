"""The registry of fields: each quantity of a scene with its symbol, unit, label, range and meaning.

Sliders, links, files of settings, sweeps, tables and sentences about a field come from here.
"""

from __future__ import annotations

from dataclasses import dataclass

from bearingcore.units import UNITS


@dataclass(frozen=True)
class Field:
    """One quantity of a scene.

    Attributes
    ----------
    name
        of the field, as `Scene.replace` knows it where it is one of the scene or its parts.
    part
        what it belongs to: "scene", "bearing", "load", "support", "defect", "floor" (of a defect),
        "pair" (both rows of a bearing), "second" (the second row of a bearing).
    label, symbol
        what it is called, and its symbol with simple HTML.
    unit
        SI unit; "1" for counts and ratios.
    shown_unit
        unit of sliders, links and files of settings.
    meaning
        what it is, in a sentence.
    group
        heading that its slider stands under; empty for a field without a slider.
    optional
        whether it may be left open: None in the scene.
    """

    name: str
    part: str
    label: str
    symbol: str
    unit: str
    shown_unit: str
    meaning: str
    group: str = ""
    optional: bool = False

    @property
    def factor(self) -> float:
        """What a number in the shown unit is multiplied by to be one in SI."""
        return UNITS[self.shown_unit].factor
