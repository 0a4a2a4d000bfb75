"""A map over two quantities, with the lines across it.

The lines follow the pointer without asking Python: so they do in a saved page too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from bokeh.models import ColumnDataSource, LinearColorMapper
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.color_scales import DIVERGING, SEQUENTIAL, hex_colors
from bearing_explorer.kit.plots.heat_map import (
    CLEAR,
    GridImage,
    Side,
    color_bar,
    ends,
    ring_at,
    scale_by,
    sections,
)
from bearing_explorer.kit.plots.layers import draw
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore.common import PREFIXES, prefix_power
from bearingcore.fields import FIELD_OF

if TYPE_CHECKING:
    from xarray import DataArray

_HATCHED = {
    "fill_color": "#B9BEC4",
    "line_color": None,
    "hatch_pattern": "/",
    "hatch_color": "white",
    "hatch_alpha": 0.6,
    "hatch_scale": 8,
}
"""Look of points without an answer."""
HEIGHTS = {"map": 340, "up": 340, "across": 200}
"""[px] of the figures."""
_NO_PREFIX = ("", "°", "kg", "kg·m²")
_PALETTES = {True: hex_colors(DIVERGING), False: hex_colors(SEQUENTIAL)}
_NO_WORDS: dict[str, list[str]] = {"words": [], "unit": []}

_SAY = """
const {words, unit} = said.data
if (isNaN(cell[0])) return `no answer: ${reasons.data.text[cell[1]]}`
return `${words[0]}: ${rounded(cell[0], 4)}${unit[0]}`
"""
SIDE_BY_SIDE = """
:host { display: grid !important; gap: 8px 16px;
        min-height: auto !important;
        grid-template-columns: repeat(auto-fit, minmax(min(100%, max(380px, 40%)), 1fr)); }
"""
"""Style of a layout of the figures: two in a row where there is room."""


@dataclass(frozen=True, eq=False)
class Field:
    """Numbers over a plane.

    Attributes
    ----------
    x, y
        the quantities of the sides, and evenly spaced values in their units, (nx,) and (ny,).
    words, unit
        of the numbers.
    values : (ny, nx)
        NaN where there is no answer.
    reasons : (ny, nx)
        why there is none.
    """

    x: tuple[Side, NDArray[np.float64]]
    y: tuple[Side, NDArray[np.float64]]
    words: str
    unit: str
    values: NDArray[np.float64]
    reasons: NDArray[np.object_]

    @classmethod
    def of_sweep(cls, output: DataArray) -> Field:
        """One output of a sweep over two fields, angles in degrees.

        Raises
        ------
        ValueError
            for another number of fields.
        """
        if output.ndim != 2:
            raise ValueError(f"dimensions are {output.dims}; allowed: two, choose with .sel(...)")
        y, x = ((Side("", *of), at) for of, at in (_page_numbers(output[d]) for d in output.dims))
        (words, _, unit), values = _page_numbers(output)
        reasons = np.where(np.isfinite(values), "", "see the status of the sweep").astype(object)
        return cls(x, y, words, unit, values, reasons)

    @cached_property
    def scaled(self) -> tuple[NDArray[np.float64], str]:
        """The numbers with an SI prefix for the greatest of them, and their unit with it."""
        if self.unit in _NO_PREFIX:
            return self.values, self.unit
        power = prefix_power(float(np.nanmax(np.abs(self.values), initial=0.0)))
        return self.values / 10.0**power, PREFIXES[power] + self.unit


def _page_numbers(output: DataArray) -> tuple[tuple[str, str, str], NDArray[np.float64]]:
    """Words, symbol and unit of numbers, and the numbers: SI, but angles in degrees."""
    unit = str(output.attrs.get("units", ""))
    name = str(output.name)
    words = FIELD_OF[name].label if name in FIELD_OF else name.replace("_", " ")
    words = words[0].upper() + words[1:]
    values = np.asarray(output, dtype=float)
    if unit == "rad":
        return (words, "", "°"), np.degrees(values)
    return (words, "", "" if unit == "1" else unit), values


class PlaneFigures:
    """The map, and a line across it each way.

    Parameters
    ----------
    packed
        sends the numbers.
    name
        of the sources and ranges.
    sides
        all quantities that a side may have.
    """

    def __init__(self, packed: PackedSource, name: str, sides: Sequence[Side]) -> None:
        self._name = name
        # the words that go with the numbers: of the values, of x and of y
        self._said = ColumnDataSource(_NO_WORDS)
        self._reasons = ColumnDataSource({"text": []})
        x, y = packed.range(f"{name}_x", 0.0, 1.0), packed.range(f"{name}_y", 0.0, 1.0)
        value = packed.range(f"{name}_value", 0.0, 1.0)
        self.map, self.up, self.across = (
            style.make_figure(
                _NAMELESS, _NAMELESS, *ranges, height=height, name=f"{name}_{which}", title=""
            )
            for ranges, (which, height) in zip(
                ((x, y), (y, value), (x, value)), HEIGHTS.items(), strict=True
            )
        )
        self.plots = [self.map, self.up, self.across]
        self.up.frame_align = False  # it needs no colour bar's room
        self._add_map(packed, sides)
        for line, sideways in ((self.across, True), (self.up, False)):
            self._add_line(line, sideways)

    def _add_map(self, packed: PackedSource, sides: Sequence[Side]) -> None:
        plot, name = self.map, self._name
        plot.grid.visible = False
        plot.stylesheets = [":host { cursor: crosshair; }"]
        self._colors = LinearColorMapper(palette=_PALETTES[False], nan_color=CLEAR)
        scale_by(packed.range(f"{name}_colors", 0.0, 1.0), self._colors)
        codes = LinearColorMapper(palette=[CLEAR])  # of the reasons, which are read and not seen
        known = {"said": self._said, "reasons": self._reasons}
        self._image = GridImage(
            plot, packed, f"{name}_cells", [self._colors, codes], sides, _SAY, _HATCHED, **known
        )
        draw(plot, packed, ring_at(f"{name}_mark"))
        self._mark = plot.renderers[-1].data_source
        self._bar = color_bar(self._colors, bar_line_color=style.STEEL_EDGE)
        plot.add_layout(self._bar, "right")

    def _add_line(self, plot: figure, sideways: bool) -> None:
        """The line across the map at the pointer, or at the scene."""
        # or the server would hear of each movement
        line = ColumnDataSource({"place": [], "value": []}, syncable=False)
        plot.title.syncable = False
        plot.line("place", "value", source=line, line_color=style.DEFECTIVE, line_width=2.0)
        follow = sections(
            self._image.source, line=line, title=plot.title, mark=self._mark, said=self._said,
            sideways=sideways,
        )  # fmt: skip
        for event in ("mousemove", "mouseleave"):
            self.map.js_on_event(event, follow)
        for source in (self._mark, self._said, self._image.source):
            source.js_on_change("data", follow)

    def write(self, field: Field) -> None:
        """Set the words of a field. On the event loop only."""
        unit = field.scaled[1]
        (x, _), (y, _) = field.x, field.y
        said = {
            "words": [field.words, x.words, y.words],
            "unit": [part if part in ("", "°") else f" {part}" for part in (unit, x.unit, y.unit)],
        }
        if (reasons := _reasons_of(field)[0]) != self._reasons.data["text"]:
            self._reasons.data = {"text": reasons}
        least, greatest = (
            float(find(field.values, initial=0.0)) for find in (np.nanmin, np.nanmax)
        )
        palette = _PALETTES[least < 0.0 < greatest]
        if palette != self._colors.palette:
            self._colors.palette = palette
        if said == self._said.data:
            return
        self._said.data = said
        label = f"{field.words} ({unit})" if unit else field.words
        self._bar.title = label
        self.up.xaxis[0].axis_label, self.across.xaxis[0].axis_label = y.label, x.label
        self.up.yaxis[0].axis_label = self.across.yaxis[0].axis_label = f"({unit})" if unit else ""

    def data(
        self, field: Field, mark: tuple[float, float] | None = None, alpha: float = 1.0
    ) -> tuple[dict[str, dict[str, np.ndarray]], dict[str, tuple[float, float]]]:
        """Sources and ranges for a field; the lines are drawn across it at the `mark`."""
        name, values = self._name, field.scaled[0]
        known = values[np.isfinite(values)]
        low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
        room = 0.06 * (high - low) or 0.06 * abs(high) or 1.0
        codes = _reasons_of(field)[1]
        x, y = np.reshape(mark if mark is not None else (), (2, -1))
        sources: dict[str, dict[str, np.ndarray]] = {
            f"{name}_cells": self._image.columns(field.x, field.y, [values, codes], alpha),
            f"{name}_mark": {"x": x, "y": y},
        }
        return sources, {
            f"{name}_x": ends(field.x[1]),
            f"{name}_y": ends(field.y[1]),
            f"{name}_value": (low - room, high + room),
            f"{name}_colors": color_limits(values),
        }


_NAMELESS = style.AxisQuantity("", "", "")


def _reasons_of(field: Field) -> tuple[list[str], NDArray[np.float64]]:
    """The different reasons of a field, and which of them each of its points has."""
    texts, codes = np.unique(field.reasons.astype(str), return_inverse=True)
    return texts.tolist(), codes.astype(float)


def color_limits(values: NDArray[np.float64]) -> tuple[float, float]:
    """Ends of the colour scale for numbers: the same on both sides of zero for both signs."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    if low < 0.0 < high:
        most = max(-low, high)
        return -most, most
    if not high > low:
        half = 0.5 * abs(low) or 0.5
        return low - half, high + half
    return low, high
