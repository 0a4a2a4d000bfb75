"""Colour scales for maps: perceptually even, and distinct to colour-blind eyes.

`SEQUENTIAL`, for numbers of one sign, goes from dark to light. `DIVERGING`, for numbers of both
signs, is blue below zero and orange above it, light at zero and equally dark at both ends.
`DIVERGING_DARK`, for a dark page, is dark at zero and equally light at both ends.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from bokeh.palettes import Viridis256, interp_palette, magma

from bearing_explorer.kit.plots import style

STEPS = 256

LOADS = list(magma(256))[40:246][::-1]
"""Loads of balls on a light page."""
DARK_LOADS = list(magma(256))[62:]
"""Loads of balls on a dark page."""
INKS = [style.INK, style.PAPER]
"""Text on a light colour, and on a dark one."""


def _rgb(colors: Sequence[str]) -> np.ndarray:
    """Colours as (n, 3) 8-bit sRGB."""
    return np.array([list(bytes.fromhex(color[1:])) for color in colors])


def _scale(colors: str) -> np.ndarray:
    """Return a scale of `STEPS` colours through evenly spaced ones."""
    return _rgb(interp_palette([f"#{color}" for color in colors.split()], STEPS))


SEQUENTIAL = _rgb(Viridis256)
"""(256, 3) sRGB, dark to light."""
# the lightness of these colours changes evenly in Oklab (Ottosson 2020)
_LIGHT = "0e60a4 3d86cc 71ace9 afd1f5 f6f6f7 f3c1a8 e39065 c3642c 9a3e00"
_DARK = "73bcff 4b94db 336da5 2c4a68 262727 653c26 9e5226 d2723b fe9963"
DIVERGING = _scale(_LIGHT)
"""(256, 3) sRGB, blue to white to orange."""
DIVERGING_DARK = _scale(_DARK)
"""(256, 3) sRGB, blue to black to orange."""


def packed_colors(scale: np.ndarray) -> list[int]:
    """Return the colours as browsers store pixels: red in the lowest byte, opaque."""
    red, green, blue = scale.T
    return [int(x) for x in 0xFF000000 + (blue << 16) + (green << 8) + red]


def hex_colors(scale: np.ndarray) -> list[str]:
    """Return the colours as "#rrggbb"."""
    return ["#{:02x}{:02x}{:02x}".format(*rgb) for rgb in scale]
