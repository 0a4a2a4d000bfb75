"""Colour scales for maps: perceptually even, and distinct to colour-blind eyes.

`SEQUENTIAL` for numbers of one sign, from dark to light; `DIVERGING` for numbers of both signs,
blue below zero and orange above it, as light as paper at zero and equally dark at both ends;
`DIVERGING_DARK` the same on a dark page, as dark as that at zero and equally light at both ends.
"""

from __future__ import annotations

import numpy as np
from bokeh.palettes import Viridis256, magma

from bearing_explorer.kit.plots import style

STEPS = 256

LOADS = list(magma(256))[40:246][::-1]
"""Loads of balls on a light page."""
DARK_LOADS = list(magma(256))[62:]
"""The same on a dark page."""
INKS = [style.INK, style.PAPER]
"""Text on a light colour, and on a dark one."""


def _oklab_to_rgb(lab: np.ndarray) -> np.ndarray:
    """(n, 3) colours of the even colour space Oklab (Ottosson 2020) as 8-bit sRGB."""
    to_cones = np.array([[1.0, 0.3963377774, 0.2158037573],
                         [1.0, -0.1055613458, -0.0638541728],
                         [1.0, -0.0894841775, -1.2914855480]])  # fmt: skip
    to_rgb = np.array([[4.0767416621, -3.3077115913, 0.2309699292],
                       [-1.2684380046, 2.6097574011, -0.3413193965],
                       [-0.0041960863, -0.7034186147, 1.7076147010]])  # fmt: skip
    linear = np.clip(((lab @ to_cones.T) ** 3) @ to_rgb.T, 0.0, 1.0)
    coded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.rint(255.0 * coded).astype(int)


def _arm(hue_deg: float, chroma: float, share: np.ndarray, ends: tuple[float, float]) -> np.ndarray:
    """From paper (share 0) to a strong colour (share 1); lightness goes evenly between `ends`."""
    lightness = ends[0] + (ends[1] - ends[0]) * share
    strength = chroma * np.sin(0.5 * np.pi * np.minimum(1.25 * share, 1.0))
    hue = np.radians(hue_deg)
    return np.stack([lightness, strength * np.cos(hue), strength * np.sin(hue)], axis=1)


def _diverging(*ends: float) -> np.ndarray:
    share = (np.arange(STEPS // 2) + 0.5) / (STEPS // 2)
    between = (ends[0], ends[1])
    blue, orange = _arm(250.0, 0.13, share, between), _arm(48.0, 0.14, share, between)
    return _oklab_to_rgb(np.concatenate([blue[::-1], orange]))


SEQUENTIAL = np.array([list(bytes.fromhex(color[1:])) for color in Viridis256])
"""(256, 3) sRGB, dark to light."""
DIVERGING = _diverging(0.975, 0.48)
"""(256, 3) sRGB, blue to white to orange."""
DIVERGING_DARK = _diverging(0.27, 0.78)
"""(256, 3) sRGB, blue to black to orange."""


def packed_colors(scale: np.ndarray) -> list[int]:
    """The colours as browsers keep pixels: red in the lowest byte, opaque."""
    red, green, blue = scale.T
    return [int(x) for x in 0xFF000000 + (blue << 16) + (green << 8) + red]


def hex_colors(scale: np.ndarray) -> list[str]:
    """The colours as "#rrggbb"."""
    return ["#{:02x}{:02x}{:02x}".format(*rgb) for rgb in scale]
