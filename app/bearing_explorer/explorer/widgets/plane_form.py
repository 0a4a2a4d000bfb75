"""Two quantities to choose as the sides of a map, as a form and as sweeps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from bearing_explorer.explorer.state.value_range import SWEEPABLE, Sweep, sweep, usual_range
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore.fields import Range

SIDES = {"x": "Horizontal axis", "y": "Vertical axis"}


def plane_fields(headings: bool = False) -> list[FieldSpec]:
    """The fields of the form; with `headings` the quantities are listed under their groups."""
    quantities = [
        [
            q.key,
            f"{q.read_label} ({q.shown_unit})" if q.shown_unit else q.read_label,
            *([q.group] if headings else []),
        ]
        for q in SWEEPABLE.values()
    ]
    fields: list[FieldSpec] = []
    for side, words in SIDES.items():
        fields += [
            {"name": side, "label": words, "options": quantities},
            {"name": f"{side}_from", "label": "from"},
            {"name": f"{side}_to", "label": "to"},
        ]
    return fields


def plane_fills(limits: Mapping[str, Range]) -> dict[str, dict[str, dict[str, str]]]:
    """The fields of a side once a quantity is chosen there: side -> quantity -> fields."""
    usual = {
        name: [f"{v:g}".replace("-", "−") for v in usual_range(name, limits)] for name in SWEEPABLE
    }
    return {
        side: {
            name: {f"{side}_from": low, f"{side}_to": high} for name, (low, high) in usual.items()
        }
        for side in SIDES
    }


def plane_sweeps(
    given: Mapping[str, str], counts: Sequence[int], limits: Mapping[str, Range]
) -> tuple[Sweep, Sweep]:
    """The sweeps to the right and upwards; ValueError with a sentence where there are none."""
    if given["x"] == given["y"]:
        raise ValueError("Choose two different quantities.")
    x, y = (
        sweep(given[side], given[f"{side}_from"], given[f"{side}_to"], count, limits)
        for side, count in zip(SIDES, counts, strict=True)
    )
    return x, y
