"""Dark colours of the figures: one for each colour of the light page.

Each colour has one meaning on the whole page, so one table is enough; `look.js` applies it in the
browser. Colours that must stay, such as those on top of a picture, are not in the table
(`style.LIGHT`, `style.SHADE`).
"""

from __future__ import annotations

import json

from bearing_explorer.kit.plots import color_scales, style

DARK_COLORS = {
    style.PAPER: "#1A222B",
    style.INK: "#E6EBF0",
    style.FAINT_INK: "#AAB4BF",
    style.DEFECTIVE: "#46AAEC",
    style.HEALTHY: "#8C959F",
    style.DEFECT: "#FFD34D",
    style.STEEL: "#2C3641",
    style.STEEL_EDGE: "#667280",
    style.GRID: "#29323C",
    "#D55E00": "#FF8B3E",
    "#009E73": "#2BC797",
    "#AA3377": "#EDA9C2",
    "#56B4E9": "#A9DBFA",
    "#6B7480": "#95A0AC",  # rim of a ball
    "#B87A00": "#E8B23E",  # rim of a defect
    "#C9CED4": "#4A5561",  # no value
    "#F3F4F6": "#222B35",  # an empty map, and its hatches
    "#D5DAE0": "#3C4854",
    "#FAFBFC": "#1F2832",  # a cell of the matrix
    "#E6F3EE": "#16342B",  # inside the circle of stable multipliers
    "#00704F": "#4CCB9C",
    "#8A5A00": "#E8B23F",  # names of the bearing's frequencies, as their lines
    "#94407A": "#E89BC7",
    "#1F6F9F": "#A9DBFB",
    "#B9BEC4": "#525D69",  # no answer
    "#661100": "#B5524A",  # the third compared scene
    "#665511": "#FFDD88",  # methods in the charts of accuracy
    "#5544FF": "#AA55EE",
    "#FF4466": "#EE4488",
}
"""Dark colours by the light ones, as upper-case hex."""

DARK_PALETTES = [
    (color_scales.LOADS, color_scales.DARK_LOADS),
    (color_scales.INKS, [DARK_COLORS[style.INK], DARK_COLORS[style.PAPER]]),
]
"""Palettes (light, dark) that change as a whole."""


def dark_properties() -> str:
    """Return the dark colours as CSS properties, see `style.css_color`."""
    words = (f"--in-dark-{light[1:].upper()}: {dark};" for light, dark in DARK_COLORS.items())
    return f':root[data-theme="dark"] {{ {" ".join(words)} }}'


def themes() -> str:
    """Return the tables in the form that `look.js` reads."""
    colors = {light.upper(): dark for light, dark in DARK_COLORS.items()}
    colors["WHITE"] = DARK_COLORS[style.PAPER]
    palettes = [[list(light), list(dark)] for light, dark in DARK_PALETTES]
    return json.dumps({"colors": colors, "palettes": palettes})
