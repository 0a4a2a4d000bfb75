"""The 15 stiffness terms and the loaded balls over extent and cage angle (Figs. 5 and 6).

All sixteen maps share one canvas. The browser receives whole numbers of 16 bits, two in each float
of the packed source. It colours them and shows the number at the pointer; a click sets the sliders
to the extent and the cage angle of that point.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource, CustomJS
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import matrix_cells
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.field_values import CAGE_ANGLE
from bearing_explorer.explorer.state.references import massless_reference
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import color_scales, style
from bearing_explorer.kit.plots.element_words import elements
from bearing_explorer.kit.plots.heat_map import Side, ends, let_point
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.plots.style import in_degrees, number, with_prefix
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearingcore import STIFFNESS_TERMS
from bearingcore.model.statics import TERM_UNITS

_CELL_COLUMNS = ("low", "high", "kind", "now", "unit", "zero")
#: kinds of colour scales, by the numbers that the scripts use
ONE_SIGN, TWO_SIGNS, COUNT, FLAT = 0, 1, 2, 3

_TOOLTIP = (
    '<div style="font: 12px system-ui, sans-serif; line-height: 1.45">'
    "<b>@name: @left{custom}</b><br>@right{custom}<br>@top{custom}</div>"
)

NO_ANSWER = 65535
"""Whole number of a point without an answer."""
GREATEST = 65534
"""Whole number of the upper end of a map's scale; the lower end is 0."""
MOST_LEVELS_NAMED = 14
"""Most steps of the scale of loaded balls that are all numbered."""
HEIGHT = 385
NARROWEST = 700
"""Width [px] below which the maps have no room for their values at the cross."""
PHONE = 540
"""Width [px] below which numbers beside the scales are upright and the legend is short."""

_TO_TWO_SIGNS, _TO_ONE_SIGN = 0.03, 0.01
"""Ratio of the smaller to the greater sign: a map gets two signs above the first, one below the
second. In between it keeps its scale, so that a drag does not make it flicker."""


def _cell(row: int, column: int) -> matrix_cells.Cell:
    return matrix_cells.Cell(column + 0.15, column + 0.785, -row - 0.885, -row - 0.2)


_BALLS = matrix_cells.Cell(0.26, 1.98, -4.66, -3.36)
_CELLS = [*(_cell(i, j) for i, j in matrix_cells.PLACES), _BALLS]
_N = len(_CELLS)


def _bar(cell: matrix_cells.Cell) -> matrix_cells.Cell:
    """The colour scale right of a map."""
    width = 0.036 if cell is not _BALLS else 0.06
    return matrix_cells.Cell(cell.right + 0.02, cell.right + 0.02 + width, cell.bottom, cell.top)


BAR_NUMBERS = 0.1
"""Room for the numbers right of a colour scale."""
_BARS = [_bar(cell) for cell in _CELLS]

_SCALE_OF = """
const [{data}] = sources
const words = data.of_shaft[0] ? 'Shaft angle φs' : 'Cage angle φc'
const ends = (side) => ({first: data[side + '_first'][0], last: data[side + '_last'][0]})
return {
  x: {...ends('x'), factor: 1, unit: '°', words},
  y: {...ends('y'), factor: 1, unit: '°', words: 'Length of the defect Δφf'},
}
"""


class StiffnessMaps(View):
    """All stiffness terms and the loaded balls over extent and cage angle."""

    name = "maps"
    title = "Stiffness over length and cage angle"
    about = (
        "Every stiffness term over length and cage angle. Upwards: length of the defect. To the "
        "right: cage angle. The large map counts the balls that carry load. Sloping lines are "
        "balls that enter and leave the defect. Click in a map to go there."
    )
    needs = frozenset({"maps", "now"})
    cells = matrix_cells.named_cells(
        [matrix_cells.Cell(c.left, _bar(c).right + BAR_NUMBERS, c.bottom, c.top) for c in _CELLS]
    )

    def build(self, packed: PackedSource) -> Any:
        """Make the canvas of all maps."""
        self._one_sign = [StickyRange(0.0, 1.0) for _ in matrix_cells.PLACES]
        self._two_signs = [StickyRange(-1.0, 1.0, anchor="symmetric") for _ in matrix_cells.PLACES]
        self._two = [False] * len(matrix_cells.PLACES)
        self._balls = StickyRange(0.0, 1.0, shrink_below=0.0)
        looks = (
            ".bk-events.bk-events { cursor: crosshair; }"
            ".bk-events.bk-events:focus { outline: none; }"  # a click needs no mark of the focus
        )
        plot = matrix_cells.matrix_figure(
            (-0.22, 5.25), (-5.25, 0.12), looks, height=HEIGHT, name="maps_drawing"
        )
        cells = packed.source("maps_cells", *_CELL_COLUMNS, *_PLACES_OF_CELLS)
        grid = packed.source("maps_grid", *_GRID)
        ticks = packed.source("maps_ticks", "x", "y", "value", "at")
        now = packed.source("maps_now", "x", "y", *matrix_cells.SIDES)
        points = packed.source("maps_points", "bits")
        frames = _frames(plot)
        images = _images(plot, points)
        _names(plot, grid)
        _scales(plot, cells)
        _ticks(plot, ticks)
        _crosshair(plot, now)
        let_point(
            plot,
            images,
            _SIDES_OF,
            [frames],
            asset_text("maps_value.js"),
            stands=grid,
            count=_N,
            digits=1,
            tooltip=_TOOLTIP,
            fields={"@left": "value", "@right": "y", "@top": "x"},
            cells=cells,
            points=points,
            units=list(matrix_cells.UNITS),
            head=_HEAD,
            none=NO_ANSWER,
            greatest=GREATEST,
        )
        matrix_cells.axes_when_zoomed(plot, _CELLS, _SCALE_OF, [grid])
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        """Points as whole numbers, their scales, and the positions of the sliders."""
        maps, now = results.maps, results.against(massless_reference(results.scene)).now
        sizes = matrix_cells.term_sizes(maps.term)
        cells: list[tuple[float, ...]] = []
        points = [np.empty(0, np.uint16)]
        for i, term in enumerate(STIFFNESS_TERMS):
            values = maps.term(term)
            at_now = float(now.term(term)[0])
            low, high, flat = self._limits(i, values, sizes[i])
            points.append(whole_numbers(values, low, high))
            at_now = 0.0 if abs(at_now) < matrix_cells.NEGLIGIBLE * sizes[i] else at_now
            kind = FLAT if flat else TWO_SIGNS if self._two[i] else ONE_SIGN
            cells.append((low, high, kind, at_now, matrix_cells.UNITS.index(TERM_UNITS[term])))
        # the last map: a colour for each number of loaded balls, in the middle of its step
        counts = np.where(maps.converged, maps.loaded_balls, np.nan)
        low, high = self._balls.fit(counts)
        low, high = math.floor(low), math.ceil(high)
        points.append(whole_numbers(counts, low - 0.5, high + 0.5))
        at_now = float(now.loaded_balls[0]) if now.converged[0] else math.nan
        cells.append((low - 0.5, high + 0.5, COUNT, at_now, len(matrix_cells.UNITS)))

        columns = dict(zip(("low", "high", "kind", "now", "unit"), np.array(cells).T,
                           strict=True))  # fmt: skip
        zeros = matrix_cells.zero_kinds([cell[2] == FLAT for cell in cells[:-1]])
        grid = _grid(results)
        levels = high - low + 1
        sources: Sources = {
            "maps_cells": {**columns, "zero": np.array([*zeros, 0]), **_PLACES_OF_CELLS},
            "maps_grid": {name: np.array([value]) for name, value in grid.items()},
            "maps_ticks": _tick_rows(grid, low, high),
            "maps_now": {**_marks(results, grid), **_SIDE_COLUMNS},
            "maps_points": {"bits": pack_bits(maps.status.shape, columns["kind"], levels, points)},
        }
        return sources, {}

    def _limits(
        self, i: int, values: NDArray[np.float64], size: float
    ) -> tuple[float, float, bool]:
        """Ends of a term's colour scale, and True if the term is zero everywhere."""
        known = values[np.isfinite(values)]
        if not known.size:
            return math.nan, math.nan, False
        least, most = float(known.min()), float(known.max())
        if max(-least, most) < matrix_cells.NEGLIGIBLE * size:
            return -size, size, True
        lesser, greater = sorted((max(-least, 0.0), max(most, 0.0)))
        two = lesser > (_TO_ONE_SIGN if self._two[i] else _TO_TWO_SIGNS) * greater
        self._two[i] = two
        middle = 0.5 * (least + most)
        # a least span, so that a constant term does not show its rounding errors
        room = np.array([middle - 0.005 * size, middle + 0.005 * size])
        low, high = (self._two_signs if two else self._one_sign)[i].fit(least, most, room)
        return low, high, False

    def sentence(self, results: Results) -> str:
        """Say at which length the fewest balls carry load, and the state at the sliders."""
        maps = results.maps
        if not maps.converged.any():
            first = np.unravel_index(0, maps.status.shape)
            return f"There is nothing to map: {maps.reason(int(first[0]), int(first[1]))}."
        mean = maps.mean_loaded_balls
        bearing = results.scene.bearing
        n_balls, names = bearing.total_balls, elements(bearing)
        least, most = np.nanmin(mean), np.nanmax(mean)
        if most - least < 0.05:
            words = f"Whatever the length, about {least:.1f} of {n_balls} {names} carry load"
        else:
            fewest = int(np.nanargmin(mean))
            length = in_degrees(maps.extents[fewest], 0)
            where = f"at a length of {length}" if fewest else "without a defect"
            if fewest == mean.size - 1:
                where += ", the longest of the map"
            words = f"Fewest {names} carry load {where}: {least:.1f} of {n_balls} on average"
            if fewest and np.isfinite(mean[0]):
                words += f", against {mean[0]:.1f} without the defect"
        now = results.against(massless_reference(results.scene)).now
        if now.converged[0]:
            place = f"{in_degrees(results.extent)}, {in_degrees(results.cage_angle)}"
            stiff = with_prefix(float(now.term("k_yy")[0]), "N/m")
            words += f"; at the mark ({place}) {int(now.loaded_balls[0])} do, and k_yy is {stiff}"
        missing = float(np.mean(~maps.converged))
        if missing:
            words += f". {number(100.0 * missing, 2)} % of the points have no answer"
        return words + "."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        """Every point of every map in SI."""
        columns = results.maps.table().in_units().named()
        shape = results.maps.status.shape
        return {name: column.reshape(shape) for name, column in columns.items()}


def whole_numbers(values: NDArray[np.float64], low: float, high: float) -> NDArray[np.uint16]:
    """Convert values between the ends of a scale to 0 to GREATEST, and NaN to NO_ANSWER."""
    if not low < high:
        return np.full(values.size, NO_ANSWER, np.uint16)
    shares = ((values - low) * (GREATEST / (high - low))).ravel()
    known = np.isfinite(shares)
    return np.where(known, np.clip(np.rint(shares), 0, GREATEST), NO_ANSWER).astype(np.uint16)


def pack_bits(
    shape: tuple[int, int],
    kinds: NDArray[np.float64],
    levels: int,
    points: list[NDArray[np.uint16]],
) -> NDArray[np.float32]:
    """Pack rows and columns of the maps, their kinds, levels of the last, and all points.

    The packed source carries floats. The bits of each float are two whole numbers; it is never
    read as a float.
    """
    head = np.array([*shape, *kinds, levels], np.uint16)
    numbers = np.concatenate([head, np.zeros(_HEAD - head.size, np.uint16), *points])
    if numbers.size % 2:
        numbers = np.append(numbers, np.uint16(0))
    return numbers.view(np.float32)


_HEAD = 20  # numbers in front of the points

_GRID = ("across", "up", "x_first", "x_last", "y_first", "y_last", "turn", "start", "of_shaft")
_SIDES_OF = (
    Side(CAGE_ANGLE, "Cage angle", "", "°"),
    Side("extent_deg", "Length of the defect", "", "°"),
    Side(CAGE_ANGLE, "Shaft angle", "", "°"),
)
_ACROSS, _UP = (0, 2), 1
_SIDE_COLUMNS = matrix_cells.sides_of(_CELLS)
_MIDDLES = 0.5 * (_SIDE_COLUMNS["bottom"] + _SIDE_COLUMNS["top"])
_PLACES_OF_CELLS = {
    **_SIDE_COLUMNS,
    "middle": _MIDDLES,
    "bar": np.array([bar.right for bar in _BARS]),
}


def _grid(results: Results) -> dict[str, float]:
    """Ends of the sides of a map [deg]: half a point past the first and the last.

    A map shows the angle of the cage, or of the shaft if a defect turns with it: `turn` is its
    change for a degree of cage angle, and `start` the cage angle at which it is zero.
    """
    maps = results.maps

    angles = results.along(np.array([maps.cage_angles[0], maps.cage_angles[-1]]))
    first, last = ends(np.linspace(float(angles[0]), float(angles[1]), maps.cage_angles.size))
    low, high = ends(np.degrees(maps.extents))
    turn = 1.0 / results.scene.bearing.cage_ratio if results.over_shaft else 1.0
    return {
        "across": float(_ACROSS[results.over_shaft]),
        "up": float(_UP),
        "x_first": first,
        "x_last": last,
        "y_first": low,
        "y_last": high,
        "turn": turn,
        "start": math.degrees(maps.cage_angles[0]),
        "of_shaft": float(results.over_shaft),
    }


def _marks(results: Results, grid: dict[str, float]) -> dict[str, np.ndarray]:
    """Positions of the sliders, in each map."""
    angle, extent = float(results.along(results.cage_angle)), math.degrees(results.extent)
    x = (angle - grid["x_first"]) / (grid["x_last"] - grid["x_first"])
    y = (extent - grid["y_first"]) / (grid["y_last"] - grid["y_first"])
    return {
        "x": np.array([cell.x(np.array(x)) for cell in _CELLS]),
        "y": np.array([cell.y(np.array(y), (0.0, 1.0)) for cell in _CELLS]),
    }


#: places of numbers: left of a map, below it, at a colour scale
_LEFT, _FOOT, _SCALE = 0, 1, 2


def _tick_rows(grid: dict[str, float], least: int, most: int) -> dict[str, np.ndarray]:
    """Numbers on the axes of the diagonal maps and of the large map, and on its colour scale."""
    rows = []
    for index, cell in enumerate(_CELLS):
        large = cell is _BALLS
        if not large and len(set(matrix_cells.PLACES[index])) > 1:
            continue
        for side, first, last in (
            (_LEFT, grid["y_first"], grid["y_last"]),
            (_FOOT, grid["x_first"], grid["x_last"]),
        ):
            parts = (4 if side == _FOOT else 6) if large else 2
            for value in _round_numbers(first, last, parts):
                share = np.array((value - first) / (last - first))
                x = cell.left if side == _LEFT else float(cell.x(share))
                y = cell.bottom if side == _FOOT else float(cell.y(share, (0.0, 1.0)))
                rows.append((x, y, value, side))
    every = -(-(most - least + 1) // MOST_LEVELS_NAMED)
    for count in range(least, most + 1, every):
        share = np.array((count - least + 0.5) / (most - least + 1))
        y = float(_BARS[-1].y(share, (0.0, 1.0)))
        rows.append((_BARS[-1].right, y, count, _SCALE))
    return dict(zip(("x", "y", "value", "at"), np.array(rows).T, strict=True))


def _round_numbers(first: float, last: float, parts: int) -> list[float]:
    """Multiples of a round step from zero on, about `parts` of them within the ends [deg]."""
    span = last - max(first, 0.0)
    steps = [s for s in (1, 2, 5, 10, 15, 20, 30, 45, 60, 90, 120, 180) if s * parts >= 0.85 * span]
    step = steps[0] if steps else span / parts
    return [step * k for k in range(int(last / step + 1e-6) + 1)]


# ------------------------------------------------------------------------ the drawing, made once


def _frames(plot: figure) -> Any:
    """Draw hatched frames, which are seen where a map has no answer."""
    return plot.quad(
        **{side: side for side in matrix_cells.SIDES},
        source=ColumnDataSource({**_SIDE_COLUMNS, "name": matrix_cells.NAMES}),
        fill_color="#F3F4F6",
        hatch_pattern="right_diagonal_line",
        hatch_color="#D5DAE0",
        hatch_scale=7,
        hatch_weight=1,
        line_color=style.STEEL_EDGE,
    )


def _images(plot: figure, points: ColumnDataSource) -> ColumnDataSource:
    """Draw the maps and their colour scales, which the browser colours."""
    places = [*_CELLS, *_BARS]
    left, right, bottom, top = matrix_cells.sides_of(places).values()
    blank = [np.zeros((1, 1), np.uint32) for _ in places]
    images = ColumnDataSource(
        {"image": blank, "x": left, "y": bottom, "dw": right - left, "dh": top - bottom},
        syncable=False,
    )
    plot.image_rgba("image", "x", "y", "dw", "dh", source=images)
    kinds = (color_scales.SEQUENTIAL, color_scales.DIVERGING, color_scales.DIVERGING_DARK)
    one_sign, *two_signs = map(color_scales.packed_colors, kinds)
    scales = {
        theme: [one_sign, two, one_sign, two]
        for theme, two in zip(("light", "dark"), two_signs, strict=True)
    }
    color = CustomJS(
        args={"images": images, "scales": scales, "n": _N, "head": _HEAD, "none": NO_ANSWER},
        code=asset_text("maps_color.js"),
    )
    points.js_on_change("data", color)
    return images


_LEGEND = (
    ("Stiffness k of each displacement", "Up: length Δφf"),
    ("(column) against each load (row).", "Across: angle"),
    ("Cross: current extent, cage angle.", "Cross: current"),
    ("Hatched: no answer.", "Hatched: none"),
)
"""Lines, and what they say where there is less room."""


def _names(plot: figure, grid: ColumnDataSource) -> None:
    """Write symbols over the maps, words on the axes, and the legend."""
    matrix_cells.write_names(plot, _CELLS)
    centered = {"text_align": "center", "text_color": style.INK}
    up = ColumnDataSource({"x": [_BALLS.left], "y": [0.5 * (_BALLS.bottom + _BALLS.top)]})
    extent = "return narrow ? '' : 'Length of the defect Δφf (°)'"
    beside = {"angle": 0.5 * math.pi, "x_offset": -31, "fitting": PHONE}
    matrix_cells.write(plot, up, extent, **beside, **centered)
    words = "return row.of_shaft ? 'Shaft angle φs (°)' : 'Cage angle φc (°)'"
    below = {"x": 0.5 * (_BALLS.left + _BALLS.right), "y": _BALLS.bottom, "y_offset": 36}
    matrix_cells.write(plot, grid, words, text_font_size=style.TEXT_SIZE, **below, **centered)
    y = [-2.3 - 0.18 * line for line in range(len(_LEGEND))]
    text, short = zip(*_LEGEND, strict=True)
    legend = ColumnDataSource({"x": [0.12] * len(y), "y": y, "text": text, "short": short})
    matrix_cells.write(plot, legend, "return narrow ? row.short : row.text", fitting=PHONE)


_UNIT = f"""
const unit = {[*matrix_cells.UNITS, ""]}[row.unit]
const e = power(Math.max(Math.abs(row.low), Math.abs(row.high)))
"""
_END = f"""{_UNIT}
if (narrow !== %s || !unit || row.kind == 3 || isNaN(row.low)) return ''
return minus(String(Number((row.%s/10**e).toPrecision(narrow ? 2 : 4))))
"""
_NOW = f"""{_UNIT}
if (narrow && unit) return ''  // it would lie on the symbol
if (isNaN(row.now)) return 'no value'
if (!unit) return row.now + (row.now == 1 ? ' ball' : ' balls') + (narrow ? '' : ' at the cross')
return rounded(row.now/10**e, 3) + '\\u00a0' + names[e] + unit
"""
_ZERO = f"{_UNIT}return unit && row.kind == 1 && !narrow ? '0' : ''"
_FLAT = f"return row.zero && narrow ? '0' : {list(matrix_cells.ZEROS)}[row.zero]"
_ONLY = "return row.at == %d ? String(Number(row.value.toPrecision(4))) + '%s' : ''"


def _scales(plot: figure, cells: ColumnDataSource) -> None:
    """Write the numbers of the colour scales, values at the cross, and why a map is zero."""
    place = {"x": "bar", "x_offset": 4, "fitting": PHONE}
    for end, side in (("low", "bottom"), ("high", "top")):
        level = {"text_baseline": side, "y": side}
        matrix_cells.write(plot, cells, _END % ("false", end), **place, **level)
        upright = {"angle": 0.5 * math.pi, "text_align": "left" if end == "low" else "right"}
        level |= {"text_baseline": "top"}
        matrix_cells.write(plot, cells, _END % ("true", end), **place, **level, **upright)
    matrix_cells.write(plot, cells, _ZERO, **place, y="middle", text_baseline="middle")
    above = {"x": "bar", "y": "top", "x_offset": 20, "y_offset": -6}
    matrix_cells.write(plot, cells, _NOW, fitting=NARROWEST, text_align="right", **above)
    inside = {"x": "left", "y": "top", "x_offset": 8, "y_offset": 8}
    matrix_cells.write(plot, cells, _FLAT, fitting=NARROWEST, text_baseline="top", **inside)


def _ticks(plot: figure, ticks: ColumnDataSource) -> None:
    """Write the numbers of the axes and of the scale of loaded balls."""
    for side, unit, look in (
        (_LEFT, "°", {"x_offset": -5, "text_align": "right", "text_baseline": "middle"}),
        (_FOOT, "°", {"y_offset": 5, "text_align": "center", "text_baseline": "top"}),
        (_SCALE, "", {"x_offset": 6, "text_baseline": "middle"}),
    ):
        matrix_cells.write(plot, ticks, _ONLY % (side, unit), **look)


def _crosshair(plot: figure, now: ColumnDataSource) -> None:
    """Draw a cross at the positions of the sliders: dark on light, to show on every colour."""
    for color, width, alpha in ((style.LIGHT, 3.0, 0.75), (style.SHADE, 1.0, 0.9)):
        look = {"source": now, "line_color": color, "line_width": width, "line_alpha": alpha}
        plot.segment("x", "bottom", "x", "top", **look)
        plot.segment("left", "y", "right", "y", **look)
    plot.scatter("x", "y", source=now, size=8, fill_color=style.DEFECT, line_color=style.SHADE)
