"""Stiffness and loaded balls over the extent of the defect and the cage angle (Figs. 5 and 6)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import holoviews as hv
import numpy as np

from bearing_explorer.plots import style
from bearing_explorer.plotting.style import Axes, color_scale, dimension
from bearingcore import Maps
from bearingcore.statics.equilibrium import TERM_SYMBOLS, TERM_UNITS

LOADED_BALLS = "loaded_balls"
_EXTENT = style.AxisQuantity("Extent", "Δφf", "°")


def maps(found: Maps, terms: Sequence[str] = (LOADED_BALLS, "k_yy")) -> hv.Image | hv.Layout:
    """Maps side by side, or the map itself where it is one.

    Parameters
    ----------
    found
        over evenly spaced extents and cage angles.
    terms
        of `bearingcore.STIFFNESS_TERMS`, or "loaded_balls".
    """
    drawn = [_map(found, term) for term in terms]
    return drawn[0] if len(drawn) == 1 else hv.Layout(drawn).cols(2)


def _map(found: Maps, term: str) -> hv.Image:
    if term == LOADED_BALLS:
        values = np.where(np.isfinite(found.greatest_load), found.loaded_balls, np.nan)
        quantity = style.AxisQuantity("Loaded balls", "", "")
    else:
        values = found.term(term)
        unit = TERM_UNITS[term]
        quantity = style.AxisQuantity("", TERM_SYMBOLS[term], unit, prefixed=True)
    palette, limits = color_scale(values)
    image = hv.Image(
        (np.degrees(found.cage_angles), np.degrees(found.extents), values),
        [
            dimension("cage_angle_deg", style.CAGE_ANGLE),
            dimension("extent_deg", _EXTENT),
        ],
        dimension(term, quantity),
    )
    options: dict[str, Any] = {
        "cmap": palette,
        "clim": limits,
        "colorbar": True,
        "width": 440,
        "height": 320,
        "tools": ["hover"],
        "active_tools": [],
        "clipping_colors": {"NaN": "#B9BEC4"},
        "hooks": [Axes(style.CAGE_ANGLE, _EXTENT, quantity)],
    }
    return image.opts(**options)
