"""The house style: one way to make a figure, one palette, one way to write numbers with units.

Data go to the browser in SI. The prefix (kN, µm, MN/m) is chosen there, from the range that the
axis shows, by the same rule as `with_prefix` uses for sentences: so an axis, its label and its
numbers cannot disagree, and nothing is rescaled on the way.

Colours have one meaning each on the whole page and stay apart for colour-blind eyes (Okabe-Ito).
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from bokeh.models import (
    Axis,
    ColorBar,
    CustomJS,
    CustomJSTickFormatter,
    CustomJSTransform,
    FixedTicker,
    LinearAxis,
    Range1d,
)
from bokeh.plotting import figure

from bearingcore.common import PREFIXES, number as number, prefix_power, with_prefix as with_prefix

DEFECTIVE = "#0072B2"
"""Colour of the bearing as the sliders describe it."""
HEALTHY = "#8E93A3"
"""Colour of the same bearing without its defect."""
DEFECT = "#E69F00"
"""Colour of the defect."""
INK = "#20262D"
"""Text, and the mark of the current cage angle."""
FAINT_INK = "#5B6470"
PAPER = "#FFFFFF"
"""Background of figures; white is paper."""
LIGHT, SHADE = "#FEFEFE", "#1B2127"
"""Colours on top of pictures, which are the same on a light and on a dark page."""
STEEL = "#E7EAEE"
STEEL_EDGE = "#A9B1BB"
GRID = "#EDEFF2"

DIRECTIONS = ("x", "y", "z", "rx", "ry")
DIRECTION_COLORS = ("#0072B2", "#D55E00", "#009E73", "#AA3377", "#56B4E9")
"""Colour of each direction of motion, in the order of `DIRECTIONS`."""
BALL_COLORS = ("#009E73", "#AA3377", "#661100", "#8A5A00")
"""Colours of balls that are shown one by one, taken in turn: not those of x and y beside them."""

FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"
HTML_FONT = f"font:12.5px/1.45 {FONT}".replace('"', "'")
TEXT_SIZE = "12px"
WRAPPED = ":host { flex-wrap: wrap; min-width: 0 !important; }"
"""Style of rows that wrap where there is little room."""
SIDE_BY_SIDE = """
:host { display: grid !important; gap: 8px 16px;
        min-height: auto !important;
        grid-template-columns: repeat(auto-fit, minmax(min(100%, max(380px, 40%)), 1fr)); }
"""
"""Style that puts two figures side by side where there is room."""
BUTTONS = f"""
:host {{
  --default: var(--card); --default-hover: var(--track-soft); --default-active: var(--accent-paper);
  --default-border: var(--line); --default-hover-border: var(--line);
  --default-active-border: var(--accent); --color: var(--ink); color: var(--ink);
  font-family: {FONT}; font-size: 13px;
}}
:host .bk-input-group, :host label {{ font-family: {FONT}; }}
:host .bk-btn {{ font-family: {FONT}; font-size: 13px; }}
:host .bk-btn.bk-active {{ color: var(--accent); }}
:host(.look) {{ display: var(--tick-box, inline-block); }}
"""
"""Style of Bokeh's own buttons and boxes to tick, light and dark."""
SMALL_TEXT_SIZE = "11px"

# Numbers as text, as `bearingcore.common._numbers` does in sentences.
JS_PREFIX = """
const names = {'-12':'p','-9':'n','-6':'µ','-3':'m','0':'','3':'k','6':'M','9':'G','12':'T'}
const power = (top) => !(top > 0) || !isFinite(top) ? 0 :
  Math.max(-12, Math.min(12, 3*Math.floor(Math.log10(top*1.0000001)/3)))
const minus = (text) => text.replace('-', '\u2212')
const raised = (e) => [...String(e)].map(c => c == '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]).join('')
const scientific = (value, digits) => {
  const [mantissa, e] = value.toExponential(digits - 1).split('e')
  return minus(Number(mantissa) + '·10' + raised(Number(e)))
}
const wide = (value) => value !== 0 && !(Math.abs(value) >= 1e-4 && Math.abs(value) < 1e7)
const rounded = (value, digits) => !isFinite(value) ? 'no value'
  : wide(value) ? scientific(value, digits)
  : minus(Math.abs(value) >= 10**(digits - 1)
    ? value.toFixed(0) : String(Number(value.toPrecision(digits))))
const si = (value, unit, digits = 3) => {
  if (!isFinite(value)) return 'no value'
  let e = power(Math.abs(value))
  let scaled = Number((value/10**e).toPrecision(digits))
  if (Math.abs(scaled) >= 1000 && e < 12) { e += 3; scaled /= 1000 }
  return wide(scaled) ? scientific(value, digits) + '\u00a0' + unit
    : rounded(scaled, digits) + '\u00a0' + names[e] + unit
}
"""


NARROW = 420
"""Width [px] of a frame below which there is room for short words only."""
LARGER = """
const larger = document.documentElement.hasAttribute("data-projector") ? 1.64 : 1  // see look.js
"""
IS_NARROW = (
    LARGER
    + """
let narrow = false
if (plot) try { narrow = plot.inner_width > 0 && plot.inner_width < larger*below } catch {}
"""
)
"""JavaScript that sets `narrow`: true if the frame of a `plot` is `below` this width [px]."""


def text_offset(column: str) -> dict[str, Any]:
    """Offset of texts by the pixels in a column; they grow with the type, on a projector too."""
    code = LARGER + "return xs.map(offset => larger*offset)"
    return {"field": column, "transform": CustomJSTransform(v_func=code)}


@dataclass(frozen=True)
class AxisQuantity:
    """Quantity of an axis: name, symbol and unit.

    `prefixed` lets the axis choose an SI prefix for `unit`; the data are in `unit` always.
    `around`: an angle, written between 0° and 360° even where the axis goes beyond.
    """

    name: str
    symbol: str
    unit: str
    prefixed: bool = False
    around: bool = False

    @property
    def words(self) -> str:
        """Name and symbol."""
        return f"{self.name} {self.symbol}".strip()

    def label(self, top: float = 1.0) -> str:
        """Text of the axis for a range whose greatest absolute value is `top` [unit]."""
        prefix = PREFIXES[prefix_power(top)] if self.prefixed else ""
        unit = f"{prefix}{self.unit}"
        return f"{self.words} ({unit})" if unit else self.words


BALL_LOAD = AxisQuantity("Contact load", "Q", "N", prefixed=True)
BALL_ANGLE = AxisQuantity("Angular position", "φ", "°", around=True)
CAGE_ANGLE = AxisQuantity("Cage angle", "φc", "°")
SHAFT_ANGLE = AxisQuantity("Shaft angle", "φs", "°")
TIME = AxisQuantity("Time", "t", "s", prefixed=True)


def make_figure(
    x: AxisQuantity,
    y: AxisQuantity,
    x_range: Range1d,
    y_range: Range1d,
    *,
    height: int = 300,
    title: str | None = None,
    right: int = 14,
    sizing_mode: str = "stretch_both",
    **options: Any,
) -> figure:
    """Make a figure in the house style on two fixed ranges, both axes labelled and prefixed.

    `right` is the room [px] right of the frame, for labels next to their lines. Unless
    `sizing_mode` says otherwise, the figure fills its place and is at least `height` [px] high.
    """
    plot = figure(
        x_range=x_range,
        y_range=y_range,
        **({"min_height": height} if sizing_mode == "stretch_both" else {"height": height}),
        title=title,
        tools="",
        toolbar_location="right",
        output_backend="canvas",
        sizing_mode=sizing_mode,
        min_border_right=right,
        min_border_left=64,
        min_border_top=10,
        lod_threshold=None,  # otherwise Bokeh keeps a second copy of long lines, with fewer points
        **{"min_width": 280, **options},
    )
    plot.toolbar_inner = True
    style_figure(plot)
    for axis, quantity, shown in ((plot.xaxis[0], x, x_range), (plot.yaxis[0], y, y_range)):
        style_axis(axis)
        write_units(axis, quantity, shown)
    return plot


def style_figure(plot: figure) -> None:
    """Style the paper, grid, title and toolbar of a figure."""
    plot.background_fill_color = plot.border_fill_color = PAPER
    plot.outline_line_color = None
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    plot.toolbar.styles = {"background-color": "var(--card, white)"}  # Bokeh's is white in the dark
    plot.grid.grid_line_color = GRID
    if plot.title is not None:
        plot.title.text_font = FONT
        plot.title.text_font_size = TEXT_SIZE
        plot.title.text_font_style = "normal"
        plot.title.text_color = FAINT_INK


def bare_figure(x_range: Range1d, y_range: Range1d, *, height: int, **options: Any) -> figure:
    """Make a figure without axes and grid, for drawings."""
    plot = make_figure(
        AxisQuantity("", "", ""),
        AxisQuantity("", "", ""),
        x_range,
        y_range,
        height=height,
        **options,
    )
    plot.axis.visible = False
    plot.grid.visible = False
    plot.min_border_left = plot.min_border_right = plot.min_border_top = 0
    plot.min_border_bottom = 0
    return plot


def style_axis(axis: Axis) -> None:
    """Set the fonts and colours of an axis."""
    axis.axis_label_text_font = axis.major_label_text_font = FONT
    axis.axis_label_text_font_style = "normal"
    axis.axis_label_text_font_size = TEXT_SIZE
    axis.axis_label_text_color = INK
    axis.major_label_text_font_size = SMALL_TEXT_SIZE
    axis.major_label_text_color = FAINT_INK
    axis.axis_line_color = STEEL_EDGE
    axis.major_tick_line_color = STEEL_EDGE
    axis.major_tick_in = 0
    axis.major_tick_out = 4
    axis.minor_tick_line_color = None
    axis.axis_label_standoff = 6


def write_units(axis: LinearAxis | ColorBar, quantity: AxisQuantity, shown: Range1d) -> None:
    """Label an axis or colour bar; numbers and label follow the prefix that fits `shown`."""
    field = "title" if isinstance(axis, ColorBar) else "axis_label"
    setattr(axis, field, quantity.label(max(abs(shown.start), abs(shown.end))))
    axis.formatter = tick_formatter(quantity, shown)
    if quantity.prefixed:
        axis.syncable = False  # otherwise each change of its label would go to the server
        follow = CustomJS(
            args={
                "axis": axis,
                "field": field,
                "shown": shown,
                "words": quantity.words,
                "unit": quantity.unit,
            },
            code=JS_PREFIX
            + """
const e = power(Math.max(Math.abs(shown.start), Math.abs(shown.end)))
const label = `${words} (${names[e]}${unit})`
if (axis[field] != label) axis[field] = label
""",
        )
        shown.js_on_change("start", follow)
        shown.js_on_change("end", follow)


def tick_formatter(quantity: AxisQuantity, shown: Range1d) -> CustomJSTickFormatter:
    """Write the numbers of an axis over the range `shown`, with a true minus sign."""
    return CustomJSTickFormatter(
        args={"shown": shown, "prefixed": quantity.prefixed, "around": quantity.around},
        code=JS_PREFIX
        + """
const e = prefixed ? power(Math.max(Math.abs(shown.start), Math.abs(shown.end))) : 0
const turned = !around ? tick : tick > 360 ? tick - 360 : tick < 0 ? tick + 360 : tick
return minus(String(Number((turned/10**e).toPrecision(6))))
""",
    )


def logarithmic_ticks(unit: str = "") -> CustomJSTickFormatter:
    """Write the numbers of a logarithmic axis: with a prefix and a unit, or as powers of ten."""
    return CustomJSTickFormatter(
        args={"unit": unit},
        code=JS_PREFIX
        + """
if (unit) return si(tick, unit)
if (tick >= 0.01 && tick < 1000) return String(Number(tick.toPrecision(3)))
const e = Math.floor(Math.log10(tick*1.0000001))
const m = Number((tick/10**e).toPrecision(2))
return (m == 1 ? '' : m + '·') + '10' + raised(e)
""",
    )


def fixed_ticks(axis: LinearAxis, ticks: Sequence[float]) -> None:
    """Put the numbers of an axis at `ticks`, whatever its range is."""
    axis.ticker = FixedTicker(ticks=list(ticks), minor_ticks=[])


def in_degrees(angle: float, digits: int = 1) -> str:
    """Write an angle [rad] as one between 0° and 360°, for a sentence."""
    turned = math.degrees(angle) % 360.0
    text = f"{turned:.{digits}f}"
    whole = f"{360.0:.{digits}f}"
    text = f"{0.0:.{digits}f}" if text == whole else text
    return text.rstrip("0").rstrip(".") + "°" if "." in text else text + "°"


def color_along(direction: str) -> str:
    """Colour of a direction of motion."""
    return DIRECTION_COLORS[DIRECTIONS.index(direction)]


def css_color(color: str) -> str:
    """Return a colour for HTML that follows light and dark as it does in figures."""
    return f"var(--in-dark-{color[1:].upper()}, {color})"


def list_words(words: Sequence[str]) -> str:
    """List words as in a sentence: "a", "a and b", "a, b and c"."""
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1]))) if words else ""


def legend(items: Iterable[tuple[str, str, str]]) -> str:
    """Return a legend as HTML: colour, sign and words of each item."""
    spans = "".join(
        f'<span><span style="color:{css_color(color)}" aria-hidden="true">{sign}</span>'
        f" {html.escape(words)}</span>"
        for color, sign, words in items
    )
    box = f"{HTML_FONT};display:flex;flex-wrap:wrap;gap:3px 18px;padding:4px 2px"
    return f'<div style="{box}">{spans}</div>'
