"""One chart of error against cost: points of several methods against one reference."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from typing import Any

import panel as pn
from bokeh.core.properties import value
from bokeh.models import (
    ColumnDataSource,
    CustomJS,
    HoverTool,
    Label,
    Range1d,
    Span,
)

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import ON_PAPER, by_number
from bearing_explorer.kit.widgets.form import stack
from bearingcore.common import decibels, percent, scientific
from bearingcore.model.experiments import METHODS, Experiment, Point

HEIGHT, TALL = 280, 360
"""Height [px] of a chart, and of one that has a row for itself."""
COLORS = (
    "#0072B2", "#D55E00", "#009E73", "#AA3377", "#665511", "#5544FF", style.INK, "#FF4466",
    "#661100",
)  # fmt: skip
"""Colours of the methods, distinct for colour-blind people on a light and a dark page."""
MARKERS = ("circle", "square", "triangle", "diamond", "inverted_triangle", "plus", "star")
ALLOWED = {"dB": 0.1, "1": 0.01}
"""Allowed error by its unit; the chart draws it as a line."""
UNORDERED = 1.0
"""Order of convergence below which shorter steps gain little."""
BEYOND = "no vibration at all, so no error in dB"
ABOVE = " It lies above the line because the page filters the acceleration, unlike this chart."
NOT_YET = "Nothing was measured beforehand for this chart: “Measure on this machine” draws it."
SHORTEST = 100.0
"""Least ratio of the ends of an axis."""

_POINTS = ("cost", "error", "slot", "marker", "label", "method", "setting", "seconds",
           "evaluations", "status", "size", "first", "text", "right", "down")  # fmt: skip
_NAMES = ("cost", "error", "slot", "name", "text", "right", "down")

_PLACE_LABELS = """
const {x_range, y_range} = plot
let inner_width = 0, inner_height = 0
try { ({inner_width, inner_height} = plot) } catch {}
if (!(inner_width > 0)) return  // not laid out yet
const larger = document.documentElement.hasAttribute("data-projector") ? 1.3 : 1
const {cost, error, label, method, first, text, right, down} = points.data
const part = (value, {start, end}) => Math.log(value/start)/Math.log(end/start)
const places = Array.from(cost, (value, i) =>
  [part(value, x_range)*inner_width, (1 - part(error[i], y_range))*inner_height])
const taken = places.map(([x, y]) => [x - 5, y - 5, x + 5, y + 5])
const line = (1 - part(limit.y, y_range))*inner_height
taken.push([0, line - 2, inner_width, line + 2],
  [inner_width - 46*larger, line - 18*larger, inner_width, line])
const free = ([left, top, end, bottom], boxes) => left >= 0 && end <= inner_width && top >= 0
  && bottom <= inner_height && boxes.every((other) =>
    end <= other[0] || left >= other[2] || bottom <= other[1] || top >= other[3])
// small boxes along the line from each point to the next of its method
const lines = places.slice(1).flatMap(([x, y], i) => method[i + 1] != method[i] ? [] :
  Array.from({length: 40}, (_, k) => [x + (places[i][0] - x)*k/40, y + (places[i][1] - y)*k/40])
    .map(([at, height]) => [at - 1, height - 1, at + 1, height + 1]))
const beside = (i, words, letter, over_lines = false) => {
  const [x, y] = places[i]
  const width = letter*larger*words.length + 4, half = letter*larger
  for (const height of [-7, 7, 0, -18, 18, -30, 30, -42, 42, 54, 66]) {
    for (const side of [11, -11 - width]) {
      const box = [x + side, y + height - half, x + side + width, y + height + half]
      if (!free(box, over_lines ? taken : [...taken, ...lines])) continue
      taken.push(box)
      return [side, height]
    }
  }
}
// names of methods: first beside points where they cover no line, then also over lines
const rows = names.data
for (const [k, name] of rows.name.entries()) {
  rows.text[k] = ""
  const known = places.map((_, i) => i).filter((i) => name && method[i] == name)
  for (const [i, over] of [...known.map((i) => [i, false]), ...known.map((i) => [i, true])]) {
    const place = beside(i, name, 6.6, over)
    if (!place) continue
    ;[rows.cost[k], rows.error[k], rows.text[k]] = [cost[i], error[i], name]
    ;[rows.right[k], rows.down[k]] = place
    break
  }
}
// labels of settings, those of the best methods and the one in use first
const order = places.map((_, i) => i).sort((a, b) => first[b] - first[a])
for (const i of order) {
  const words = label[i], used = words.startsWith("in use")
  const place = words && (beside(i, words, 6) ?? (used && beside(i, words, 6, true)))
  text[i] = place ? words : ""
  if (place) [right[i], down[i]] = place
}
points.change.emit()
names.change.emit()
"""
"""Put the name of each method beside one of its points, and then the settings beside theirs. A
label covers neither a point nor another label; without such a place it is left out."""


def look(slot: int) -> tuple[int, str]:
    """Index of COLORS, and marker. After all colours the markers shift, so no two are alike."""
    return slot % len(COLORS), MARKERS[(slot + slot // len(COLORS)) % len(MARKERS)]


class WorkPrecision:
    """A chart of errors against one reference, and its sentence.

    `case`: name of the hard case; empty for the large chart, which has a row for itself.
    """

    def __init__(self, case: str = "") -> None:
        self._case = case
        self._drawn: object = None
        self.plot = self._figure(HEIGHT if case else TALL)
        self._head, self._words = prose(), prose()
        self._head.visible = bool(case)
        self.panel = stack(self._head, self.plot, self._words)

    def _figure(self, height: int) -> Any:
        # placeholders make room for the names of the axes
        sides = [style.AxisQuantity(name, "", "") for name in ("Time", "Error")]
        ranges = [Range1d(*ends, syncable=False) for ends in ((1e-4, 1.0), (1e-6, 10.0))]
        plot = style.make_figure(
            *sides, *ranges, height=height, x_axis_type="log", y_axis_type="log",
            sizing_mode="stretch_width",
        )  # fmt: skip
        style.fixed_ticks(plot.xaxis, [10.0**e for e in range(-9, 13)])
        plot.yaxis.formatter = style.logarithmic_ticks()
        colors = by_number("slot", COLORS)
        self._best = column_source("cost", "error")
        self._lines = column_source("costs", "errors", "slot")
        self._points = column_source(*_POINTS)
        self._names = column_source(*_NAMES)
        self._used = column_source("cost", "error")
        self._allowed = Span(dimension="width", line_color=style.FAINT_INK, line_dash=[6, 4])
        self._limit = Label(x=1.0, y=1.0, y_offset=2, text="allowed", text_align="right",
                            text_color=style.FAINT_INK, text_font=style.FONT,
                            text_font_size=style.SMALL_TEXT_SIZE)  # fmt: skip
        plot.add_layout(self._allowed)
        plot.add_layout(self._limit)
        plot.line("cost", "error", source=self._best, line_color=style.STEEL_EDGE, line_width=7,
                  line_alpha=0.45)  # fmt: skip
        plot.multi_line("costs", "errors", source=self._lines, line_color=colors, line_width=1.2)
        points = plot.scatter("cost", "error", source=self._points, marker="marker", size="size",
                              fill_color=colors, line_color=colors)  # fmt: skip
        plot.scatter("cost", "error", source=self._used, size=17, fill_color=None,
                     line_color=style.INK, line_width=1.8)  # fmt: skip
        for source, color, size, weight in (
            (self._points, style.FAINT_INK, "10px", "normal"),
            (self._names, colors, "11px", "bold"),
        ):
            plot.text("cost", "error", text="text", source=source, text_color=color,
                      text_font=value(style.FONT), text_font_size=size,
                      text_font_style=value(weight), text_baseline="middle",
                      x_offset="right", y_offset="down", **ON_PAPER)  # fmt: skip
        args = {"plot": plot, "points": self._points, "names": self._names,
                "limit": self._limit}  # fmt: skip
        place = CustomJS(args=args, code=_PLACE_LABELS)
        self._points.js_on_change("data", place)
        for change in ("inner_width", "inner_height"):
            plot.js_on_change(change, place)
        for side in ranges:
            side.js_on_change("end", place)
        tips = [("method", "@method, @setting"), ("error", "@error"), ("time", "@seconds"),
                ("evaluations", "@evaluations{0.[0]}"), ("status", "@status")]  # fmt: skip
        plot.add_tools(HoverTool(renderers=[points], visible=False, tooltips=tips))
        return plot

    def draw(
        self, shown: Experiment | None, error: str, cost: str, refused: str, more: str
    ) -> None:
        """Show the points of an experiment; `refused` says why there are none.

        `error`: name of the vertical quantity. `cost`: "seconds" or "evaluations". `more`:
        sentences after those on the points.
        """
        state = (shown, error, cost, refused, more)
        if self._drawn == state:
            return
        self._drawn = state
        self.plot.visible = has_points = shown is not None and bool(shown.points)
        if shown is None or not has_points:
            self._words.object = paragraph(refused or NOT_YET)
            return
        self._fill(shown, error, cost)
        heading = f"{self._case.capitalize()}. {verdict(shown, error, cost)}"
        self._head.object = f"<h4>{html.escape(heading)}</h4>"
        self._words.object = paragraph(f"{sentence(shown, error)} {more}".rstrip())

    def _fill(self, shown: Experiment, error: str, cost: str) -> None:
        """Put the points, lines and names of the methods into the sources of the chart."""

        def place(point: Point) -> tuple[float, float]:
            return getattr(point, cost), point.errors.get(error, math.nan)

        known = [p for p in shown.points if p.failed or not math.isnan(place(p)[1])]
        good = [p for p in known if not p.failed and _are_logarithmic(place(p))]
        left, right, top = self._scale(shown, error, cost, [place(p) for p in known], good)
        frontier = [p for p in shown.frontier(error, cost) if p in good]
        rows, lines, names = [], [], []
        for slot, method in enumerate(shown.methods):
            color, marker = look(slot)
            names.append((left, top, color, method, "", 0.0, 0.0))
            line = [place(p) for p in good if p.method == method]
            lines.append((*columns_of(("cost", "error"), line).values(), color))
            for p in (p for p in known if p.method == method):
                shown_place = _shown_place(place(p), p in good, right / 1.3, top / 2.0)
                rows.append(_point_row(p, shown_place, p in good, p in frontier, color, marker))
        self._best.data = columns_of(("cost", "error"), [place(p) for p in frontier])
        self._used.data = columns_of(("cost", "error"), [place(p) for p in good if p.in_use])
        # always as many rows: Bokeh paints a longer text source before it has the new colours
        names += [(left, top, 0, "", "", 0.0, 0.0)] * (len(COLORS) - len(names))
        self._names.data = columns_of(_NAMES, names)
        self._points.data = columns_of(_POINTS, rows)
        self._lines.data = columns_of(("costs", "errors", "slot"), lines)

    def _scale(
        self,
        shown: Experiment,
        error: str,
        cost: str,
        places: Sequence[tuple[float, float]],
        good: Sequence[Point],
    ) -> tuple[float, float, float]:
        """Set the axes; return the left, right and upper end."""
        left, right = _axis_ends([c for c, _ in places if _are_logarithmic((c,))], 1.8)
        allowed = ALLOWED[shown.unit(error)]
        bottom, top = _axis_ends([*(p.errors[error] for p in good), allowed], 2.5)
        top *= 6.0
        set_range(self.plot.x_range, left, right)
        set_range(self.plot.y_range, bottom, top)
        timed = cost == "seconds"
        work = "an equilibrium" if shown.name == "statics" else "0.1 s of motion"
        self.plot.xaxis.axis_label = (
            f"Time to compute {work}" if timed else shown.evaluations.capitalize()
        )
        self.plot.xaxis.formatter = style.logarithmic_ticks("s" if timed else "")
        unit = " (dB)" if shown.unit(error) == "dB" else ""
        self.plot.yaxis.axis_label = f"Error of {error}{unit}"
        self._allowed.location = allowed
        self._limit.update(x=right, y=allowed)
        return left, right, top


def _shown_place(
    at: tuple[float, float], is_placed: bool, right: float, top: float
) -> tuple[float, float]:
    """Place of a point: at `top` without an error, at `right` without a cost."""
    across, up = at
    return across if _are_logarithmic((across,)) else right, up if is_placed else top


def _point_row(
    point: Point,
    at: tuple[float, float],
    is_placed: bool,
    is_best: bool,
    color: int,
    marker: str,
) -> tuple[Any, ...]:
    """Values of a point for the columns `_POINTS`; without a place it is a cross at the edge."""
    label = f"in use: {point.label}" if point.in_use else point.label if is_best else ""
    return (
        *at, color, marker if is_placed else "x", label, point.method, point.setting,
        style.with_prefix(point.seconds, "s"), point.evaluations,
        point.status if point.failed or is_placed else BEYOND, 8 if is_placed else 11,
        is_best + point.in_use, "", 0.0, 0.0,
    )  # fmt: skip


def _are_logarithmic(values: Sequence[float]) -> bool:
    """True if all values have a place on a logarithmic axis."""
    return all(math.isfinite(value) and value > 0.0 for value in values)


def error_with_unit(shown: Experiment, error: str, value: float) -> str:
    """An error for a sentence; a small one is written in powers of ten."""
    if shown.unit(error) == "dB" and value >= 0.01:
        return decibels(value)
    if 0.01 <= value < 10.0:
        return percent(value, 2)
    text = style.number(value, 2) if 0.01 <= value < 1000.0 else scientific(value, 2)
    return f"{text} dB" if shown.unit(error) == "dB" else text


def verdict(shown: Experiment, error: str, cost: str) -> str:
    """Compare the cheapest method within the allowed error with the next one of another program."""
    allowed = ALLOWED[shown.unit(error)]
    limit = error_with_unit(shown, error, allowed)
    within = sorted(
        (p for p in shown.points if not p.failed and p.errors.get(error, math.inf) <= allowed),
        key=lambda p: getattr(p, cost),
    )
    if not within:
        return f"No method is within {limit}"
    best = within[0].method
    others = [p for p in within if p.method.split()[0] != best.split()[0]]
    if not others:
        return f"Only {best} is within {limit}"
    ratio = f"{float(f'{getattr(others[0], cost) / getattr(within[0], cost):.2g}'):g}"
    how = "with fixed steps " if best in METHODS and METHODS[best].fixed_step else ""
    less = f"{ratio} times cheaper" if cost == "seconds" else f"done with {ratio} times fewer"
    unit = "" if cost == "seconds" else f" {shown.evaluations.removesuffix(' per equilibrium')}"
    return f"Within {limit}, {best} {how}is {less}{unit} than {others[0].method}"


def point_words(shown: Experiment, error: str, point: Point) -> str:
    """A point in words: method, setting, time and error."""
    words = error_with_unit(shown, error, point.errors[error])
    setting = f", {point.setting}" if point.setting else ""
    return f"{point.method}{setting} ({style.with_prefix(point.seconds, 's')}, {words})"


def sentence(shown: Experiment, error: str) -> str:
    """Name the fastest point within the allowed error, and the point in use, perhaps above it."""
    allowed = ALLOWED[shown.unit(error)]
    frontier = shown.frontier(error)
    within = [point for point in frontier if point.errors[error] <= allowed]
    limit = error_with_unit(shown, error, allowed)
    parts = []
    if within:
        also = ", and in use" if within[0].in_use else ""
        parts.append(f"Fastest within {limit}{also}: {point_words(shown, error, within[0])}")
    elif frontier:
        parts.append(
            f"None is within {limit}; the nearest is {point_words(shown, error, frontier[-1])}"
        )
    used = [p for p in shown.points if p.in_use and error in p.errors and p not in within[:1]]
    parts += [f"in use: {point_words(shown, error, point)}" for point in used]
    words = "; ".join(parts) + "."
    above = any(point.errors[error] > allowed for point in used)
    return words + (ABOVE if above and shown.name == "motion" else "")


def details(shown: Experiment, error: str) -> str:
    """Orders of convergence, failures and the reference of one chart, as HTML."""
    parts = []
    slopes = {m: shown.order(m, error) for m in shown.methods if m in METHODS and METHODS[m].order}
    if known := {m: slope for m, slope in slopes.items() if math.isfinite(slope)}:
        words = ", ".join(f"{m} {style.number(slope, 2)}" for m, slope in known.items())
        theory = "4 in theory for smooth forces, 2 with kinks, 1 with jumps"
        parts.append(f"Order of convergence: {words}; {theory}")
        if min(known.values()) < UNORDERED:
            parts.append(
                "Below 1 the errors are at their floor, or a force jumps: shorter steps gain little"
            )
    failed = {point.method: point for point in shown.points if point.failed}
    parts += [", ".join(filter(None, (m, p.setting, p.status))) for m, p in failed.items()]
    endless = [p for p in shown.points if p.errors.get(error) == math.inf]
    parts += [f"{p.method}: {BEYOND}" for p in endless]
    (reference,) = shown.references.values()
    apart = reference.agreement.get(error, math.nan)
    trust = "agree" if reference.trusted else "do not agree, so small errors mean little"
    parts.append(
        f"Reference: {style.list_words(reference.families)} {trust}"
        + (f", {error_with_unit(shown, error, apart)} apart" if math.isfinite(apart) else "")
    )
    parts += [part for part in (reference.note,) if part]
    words = html.escape(". ".join(part.rstrip(".") for part in parts))
    return f"<p>{words}.</p>"


def prose(content: str = "") -> pn.pane.HTML:
    """A pane for headings and paragraphs in the font of the page."""
    styles = [asset_text("accuracy.css")]
    return pn.pane.HTML(content, stylesheets=styles, sizing_mode="stretch_width", margin=0)


def paragraph(words: str) -> str:
    """Words under a chart as HTML."""
    return f"<p>{html.escape(words)}</p>"


def _axis_ends(values: list[float], room: float) -> tuple[float, float]:
    """Ends of an axis: a factor of `room` around the values, and room for two tick labels."""
    low, high = (min(values), max(values)) if values else (1.0, 1.0)
    room = max(room, math.sqrt(SHORTEST * low / high))
    return low / room, high * room


def set_range(side: Range1d, start: float, end: float) -> None:
    """Set the ends of an axis, and those of its reset."""
    side.update(start=start, end=end, reset_start=start, reset_end=end)


def column_source(*columns: str) -> ColumnDataSource:
    """A source with these columns, without numbers."""
    return ColumnDataSource({column: [] for column in columns}, syncable=False)


def columns_of(names: tuple[str, ...], rows: list[Any]) -> dict[str, list[Any]]:
    """Convert rows to columns."""
    return {name: [row[i] for row in rows] for i, name in enumerate(names)}
