"""Drawing Bokeh's figures by Matplotlib, for paper: all layers that the views use.

It knows glyphs, axes, legends and scales of colours, and nothing of views.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partialmethod
from pathlib import Path
from textwrap import wrap
from typing import Any

import numpy as np
from bokeh import models
from bokeh.core.property.vectorization import Expr, Field, Value
from bokeh.document import Document
from bokeh.models import GlyphRenderer, Plot

from bearing_explorer.kit.plots.without_browser import Scripts

SUFFIXES = (".svg", ".pdf", ".png")
COLUMN, TWO_COLUMNS = 88.0, 180.0
"""Width [mm] of a column of most journals, and of two."""
WIDE = "wide"
"""Tag of figures that need two columns."""
POINT = 0.6
"""Size [pt] of a pixel of the page: its text then has 6.6 and 7.2 pt."""
LINE = 15.0
"""Height [px] of a line of the key or of the note."""
_MARKS = {"circle": "o", "square": "s", "diamond": "D", "triangle": "^", "inverted_triangle": "v"}
_MARKS |= {"plus": "P", "cross": "+", "x": "x", "dash": "_", "star": "*", "hex": "h"}
_LEVELS = {"image": 0, "underlay": 1, "glyph": 2, "guide": 3, "annotation": 4, "overlay": 5}
_FONTS = ["Helvetica", "Arial", "Liberation Sans", "DejaVu Sans"]


def check_packages() -> None:
    """Raise ImportError, with the remedy, if the packages for printing are not installed."""
    try:
        import matplotlib
        import py_mini_racer  # noqa: F401
    except ImportError as error:
        raise ImportError(
            f"figures as {', '.join(SUFFIXES)} need matplotlib and mini-racer ({error}): "
            'pip install "bearing-explorer[figures]"'
        ) from error
    matplotlib.set_loglevel("error")  # no warning of missing fonts


def print_figures(document: Document, note: str, path: Path, width: float | None) -> None:
    """Write the visible figures of a document below one another with a note, `width` [mm] wide.

    The suffix of the path gives the format, see SUFFIXES. A width of None is that of a
    column, or of two for a figure that needs them.
    """
    check_packages()
    import matplotlib
    from matplotlib.figure import Figure
    from matplotlib.font_manager import get_font_names

    document = Document.from_json(document.to_json())  # a copy: its models are changed below
    plots = [plot for plot in document.roots[0].children if plot.visible]
    if width is None:
        width = TWO_COLUMNS if any(WIDE in plot.tags for plot in plots) else COLUMN
    pixels = width / 25.4 * 72.0 / POINT
    # drawings with circles are to scale: a frame taller than wide would be partly empty
    limits = [0.9 * pixels if _has_circles(plot) else math.inf for plot in plots]
    heights = [min(plot.min_height, limit) for plot, limit in zip(plots, limits, strict=True)]
    frame_sizes = {
        plot.id: (pixels - (plot.min_border_left or 0) - (plot.min_border_right or 0), height - 40)
        for plot, height in zip(plots, heights, strict=True)
    }
    for k, plot in enumerate(plots):  # each entry of a key takes a line above its figure
        heights[k] += LINE * sum(item.visible for item in plot.select(models.LegendItem))
    lines = wrap(note, int(pixels / (0.52 * 10)))
    scripts = Scripts(document.models, frame_sizes)
    scripts.follow()
    fonts = [name for name in _FONTS if name in get_font_names()]  # the first with the character
    look = {"font.family": fonts, "svg.fonttype": "none", "pdf.fonttype": 42}
    look |= {"font.size": 11 * POINT, "axes.linewidth": 0.6}
    with matplotlib.rc_context(look):
        height = (sum(heights) + LINE * len(lines)) * POINT / 72.0
        paper = Figure(figsize=(width / 25.4, height), layout="constrained", dpi=300)
        all_axes = paper.subplots(len(plots), 1, squeeze=False, height_ratios=heights)[:, 0]
        for plot, axes in zip(plots, all_axes, strict=True):
            _Printed(plot, axes, scripts)
        paper.supxlabel("\n".join(lines), fontsize=10 * POINT, color="#5B6470")
        paper.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def _has_circles(plot: Plot) -> bool:
    """True for a drawing with circles, whose radius is the same along both axes."""
    return any(isinstance(getattr(r, "glyph", None), models.Circle) for r in plot.renderers)


class _Printed:
    """One figure on the axes of Matplotlib."""

    def __init__(self, plot: Plot, axes: Any, scripts: Scripts) -> None:
        self.plot, self.axes, self.scripts = plot, axes, scripts
        for side in ("x", "y"):
            shown, scale = getattr(plot, f"{side}_range"), getattr(plot, f"{side}_scale")
            if isinstance(scale, models.LogScale):
                getattr(axes, f"set_{side}scale")("log")
            getattr(axes, f"set_{side}lim")(shown.start, shown.end)
            for axis in getattr(plot, f"{side}axis"):
                self._put_axis(side, axis)
        axes.spines[["top", "right"]].set_visible(False)
        if not any(axis.visible for axis in plot.axis):
            axes.axis("off")
        else:
            if any(grid.visible for grid in plot.grid):
                axes.grid(color="#EDEFF2", linewidth=0.5)
            axes.set_axisbelow(True)
        self.drawn: dict[str, Any] = {}
        layers = [r for r in plot.renderers if isinstance(r, GlyphRenderer) and r.visible]
        for renderer in sorted(layers, key=lambda renderer: _LEVELS[renderer.level]):
            self._put(renderer)
        if _has_circles(plot):
            axes.set_aspect("equal", adjustable="datalim")
        if plot.title is not None and plot.title.visible:
            axes.set_title(plot.title.text, loc="left", fontsize=11 * POINT)
        self._put_annotations()

    def _put_axis(self, side: str, axis: Any) -> None:
        """Give an axis its label, ticks and numbers."""
        from matplotlib.ticker import FixedLocator, LogLocator, MaxNLocator, NullLocator

        axes, name = self.axes, getattr(axis, f"{side}_range_name")
        if name != "default":  # a second axis, which shows the same places in another quantity
            if not axis.visible:
                return
            main, other = getattr(self.plot, f"{side}_range"), self.plot.extra_x_ranges[name]
            ratio = other.end / main.end
            axes = axes.secondary_xaxis("top", functions=(lambda x: x * ratio, lambda x: x / ratio))
        target = getattr(axes, f"{side}axis")
        axes.tick_params(length=2.5, width=0.6, labelsize=11 * POINT, colors="#20262D")
        target.set_label_text(axis.axis_label or "", fontsize=12 * POINT)
        if isinstance(axis.ticker, models.FixedTicker):
            target.set_major_locator(FixedLocator(axis.ticker.ticks))
        elif isinstance(axis, models.LogAxis):
            target.set_major_locator(LogLocator(numticks=7))
        else:
            target.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
        target.set_minor_locator(NullLocator())
        if (write := self._writer(axis)) is not None:
            target.set_major_formatter(write)
        if names := axis.major_label_overrides:
            target.set_major_formatter(lambda tick, _: str(names.get(tick, "")))

    def _writer(self, axis: Any) -> Callable[[float, int], str] | None:
        """Return the formatter of an axis or a colour bar; None for Matplotlib's own."""
        form = axis.formatter
        if not isinstance(form, models.CustomJSTickFormatter):
            return None
        return lambda tick, _: str(self.scripts.run(form.code, form.args, tick=float(tick)))

    def _value(self, part: Any, name: str, data: dict[str, Any]) -> Any:
        """Return the value of a property, a number or an array; None without the property."""
        if not hasattr(part, name):
            return None
        value = part.lookup(name).get_value(part)
        if isinstance(value, Expr):
            return self.scripts.run(value.expr.code, value.expr.args)
        if isinstance(value, Field):
            column, transform = data[value.field], value.transform
            if isinstance(transform, models.ColorMapper):
                return _colors(transform, np.asarray(column, float))
            if isinstance(transform, models.CustomJSTransform):
                return self.scripts.run(transform.v_func, transform.args, xs=list(column))
            return column
        return value.value if isinstance(value, Value) else value

    def _put(self, renderer: GlyphRenderer) -> None:
        """Draw a renderer by the method that is named after its glyph."""
        from matplotlib.transforms import blended_transform_factory

        data, glyph = renderer.data_source.data, renderer.glyph
        count = len(next(iter(data.values()), []))
        if not count:
            return

        def get(name: str) -> Any:
            return self._value(glyph, name, data)

        def color(kind: str) -> Any:
            return _with_alpha(get(f"{kind}_color"), get(f"{kind}_alpha"))

        sides = [
            self.axes.transAxes if name == "shares" else self.axes.transData
            for name in (renderer.x_range_name, renderer.y_range_name)
        ]
        free = renderer.level in ("annotation", "overlay")
        place: dict[str, Any] = {"zorder": _LEVELS[renderer.level], "clip_on": not free}
        place["transform"] = blended_transform_factory(*sides)
        line: dict[str, Any] = {}
        if hasattr(glyph, "line_width"):
            line["linewidth"] = _numbers(get("line_width")) * POINT
            line["linestyle"] = _dashes(get("line_dash"), line["linewidth"])
        draw = getattr(self, f"_{type(glyph).__name__.lower()}")
        self.drawn[renderer.id] = draw(get, color, place, line, count)

    def _rows(self, get: Any, names: Sequence[str], count: int) -> np.ndarray:
        """Return the numbers of some places as rows (count, names)."""
        return np.stack([np.broadcast_to(_numbers(get(name)), count) for name in names], axis=1)

    def _line(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        x, y = self._rows(get, ("x", "y"), count).T
        return self.axes.plot(x, y, color=color("line"), **line, **place)[0]

    def _lines(self, lines: Any, color: Any, place: Any, line: Any) -> Any:
        from matplotlib.collections import LineCollection

        return self.axes.add_collection(
            LineCollection(lines, colors=color("line"), **line, **place)
        )

    def _multiline(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        lines = [np.column_stack(pair) for pair in zip(get("xs"), get("ys"), strict=True)]
        return self._lines(lines, color, place, line)

    def _segment(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        ends = self._rows(get, ("x0", "y0", "x1", "y1"), count).reshape(-1, 2, 2)
        return self._lines(ends, color, place, line)

    def _polygons(self, corners: Any, color: Any, place: Any, line: Any) -> Any:
        from matplotlib.collections import PolyCollection

        return self.axes.add_collection(
            PolyCollection(
                corners, facecolors=color("fill"), edgecolors=color("line"), **line, **place
            )
        )

    def _patch(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path as Outline

        points = self._rows(get, ("x", "y"), count)
        gaps = np.flatnonzero(np.isnan(points).any(axis=1))
        rings = [part[~np.isnan(part).any(axis=1)] for part in np.split(points, gaps)]
        outlines = [
            Outline(np.vstack([ring, ring[:1]]), closed=True) for ring in rings if len(ring)
        ]
        whole = Outline.make_compound_path(*outlines)
        shape = PathPatch(whole, facecolor=color("fill"), edgecolor=color("line"), **line, **place)
        return self.axes.add_patch(shape)

    def _varea(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        x, low, high = self._rows(get, ("x", "y1", "y2"), count).T
        return self.axes.fill_between(x, low, high, color=color("fill"), linewidth=0.0, **place)

    def _quad(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        left, right, bottom, top = self._rows(get, ("left", "right", "bottom", "top"), count).T
        corners = np.stack([left, bottom, right, bottom, right, top, left, top], axis=1)
        return self._polygons(corners.reshape(-1, 4, 2), color, place, line)

    def _across(self, place: Any, up: bool) -> Any:
        """Return `place` for shapes that span the frame: at values of y if `up`, else of x."""
        axes = self.axes
        return {
            **place, "transform": axes.get_yaxis_transform() if up else axes.get_xaxis_transform()
        }  # fmt: skip

    def _vstrip(
        self, get: Any, color: Any, place: Any, line: Any, count: int, up: bool = False
    ) -> Any:
        low, high = self._rows(get, ("y0", "y1") if up else ("x0", "x1"), count).T
        across = np.stack([low, high, high, low])
        along = np.broadcast_to([[0.0], [0.0], [1.0], [1.0]], across.shape)
        corners = np.stack([along, across] if up else [across, along], axis=-1).transpose(1, 0, 2)
        return self._polygons(corners, color, self._across(place, up), line)

    _hstrip = partialmethod(_vstrip, up=True)

    def _vspan(
        self, get: Any, color: Any, place: Any, line: Any, count: int, up: bool = False
    ) -> Any:
        (value,) = self._rows(get, "y" if up else "x", count).T
        ends = np.stack([value, np.zeros(count), value, np.ones(count)], axis=1).reshape(-1, 2, 2)
        return self._lines(ends[..., ::-1] if up else ends, color, self._across(place, up), line)

    _hspan = partialmethod(_vspan, up=True)

    def _scatter(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        x, y = self._rows(get, ("x", "y"), count).T
        marks = np.broadcast_to(np.asarray(get("marker")), count)
        sizes = np.broadcast_to(_numbers(get("size")), count) * POINT
        drawn = None
        for mark in dict.fromkeys(marks.tolist()):
            rows = marks == mark
            only = {kind: _of_rows(color(kind), rows) for kind in ("fill", "line")}
            drawn = self.axes.scatter(
                x[rows], y[rows], sizes[rows] ** 2, marker=_MARKS.get(mark, "o"),
                **({"facecolors": only["fill"], "edgecolors": only["line"]}
                   if mark not in ("x", "cross", "dash") else {"color": only["line"]}),
                **{**line, **place},
            )  # fmt: skip
        return drawn

    def _circle(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        x, y, radius = self._rows(get, ("x", "y", "radius"), count).T
        turn = np.linspace(0.0, 2.0 * math.pi, 73)
        around = radius[:, None, None] * np.column_stack([np.cos(turn), np.sin(turn)])
        corners = np.column_stack([x, y])[:, None] + around
        return self._polygons(corners, color, place, line)

    def _image(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        drawn, mapper = None, get("color_mapper")
        for k, (x, y, w, h) in enumerate(self._rows(get, ("x", "y", "dw", "dh"), count)):
            grid = np.asarray(get("image")[k])
            pixels = _pixels(grid) if mapper is None else _colors(mapper, grid)
            drawn = self.axes.imshow(
                pixels, extent=(x, x + w, y, y + h), origin="lower", aspect="auto",
                interpolation="nearest", zorder=place["zorder"],
            )  # fmt: skip
        shown = self.plot.x_range, self.plot.y_range  # `imshow` has moved the limits
        self.axes.set(xlim=(shown[0].start, shown[0].end), ylim=(shown[1].start, shown[1].end))
        return drawn

    _imagergba = _image

    def _text(self, get: Any, color: Any, place: Any, line: Any, count: int) -> Any:
        texts = np.broadcast_to(np.asarray(get("text"), dtype=object), count)
        x, y, right, up, angle = self._rows(
            get, ("x", "y", "x_offset", "y_offset", "angle"), count
        ).T
        colors = color("text")
        size = float(str(get("text_font_size")).removesuffix("px")) * POINT
        aligns = np.broadcast_to(np.asarray(get("text_align"), dtype=object), count)
        base = str(get("text_baseline"))
        base = {"middle": "center", "alphabetic": "baseline"}.get(base, base)
        paper = get("background_fill_color")
        box = {"facecolor": paper, "edgecolor": "none", "pad": 0.5}
        box["alpha"] = get("background_fill_alpha")
        for k, text in enumerate(texts):
            if text and np.isfinite([x[k], y[k]]).all():
                self.axes.annotate(
                    text, (x[k], y[k]), (right[k] * POINT, -up[k] * POINT),
                    xycoords=place["transform"], textcoords="offset points", fontsize=size,
                    color=colors[k] if np.ndim(colors) == 2 else colors, ha=aligns[k], va=base,
                    rotation=math.degrees(angle[k]), zorder=place["zorder"] + 0.5,
                    bbox=None if paper is None else box, annotation_clip=False,
                )  # fmt: skip
        return None

    def _put_annotations(self) -> None:
        """Draw legends, colour bars, and single lines and words."""
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import ListedColormap, Normalize

        plot, axes = self.plot, self.axes
        for part in [*plot.center, *plot.left, *plot.right, *plot.above, *plot.below]:
            if not part.visible:
                continue
            if isinstance(part, models.Legend):
                shown = [item for item in part.items if item.renderers[0].id in self.drawn]
                axes.legend(
                    [self.drawn[item.renderers[0].id] for item in shown],
                    [item.label.value for item in shown],
                    loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.3, borderpad=0.0,
                    frameon=False,
                )  # fmt: skip
            elif isinstance(part, models.ColorBar):
                mapper = part.color_mapper
                scale = ScalarMappable(Normalize(mapper.low, mapper.high),
                                       ListedColormap(list(mapper.palette)))  # fmt: skip
                bar = axes.figure.colorbar(scale, ax=axes, format=self._writer(part), aspect=30)
                bar.set_label(part.title or "")
                bar.outline.set_visible(False)
            elif isinstance(part, models.Span) and part.location is not None:
                draw = axes.axvline if part.dimension == "height" else axes.axhline
                dashes = _dashes(part.line_dash, np.array(thick := part.line_width * POINT))
                draw(part.location, color=part.line_color, linewidth=thick, linestyle=dashes)
            elif isinstance(part, models.Label):
                axes.annotate(
                    part.text, (part.x, part.y), (part.x_offset * POINT, part.y_offset * POINT),
                    textcoords="offset points", color=part.text_color, ha=part.text_align,
                    va="bottom", annotation_clip=False,
                )  # fmt: skip


def _dashes(dash: Any, width: np.ndarray) -> Any:
    """Convert dashes from Bokeh to Matplotlib, which measures lengths in widths of the line."""
    if not isinstance(dash, Sequence) or isinstance(dash, str) or not len(dash):
        return "--" if dash == "dashed" else "-"
    thick = max(float(np.max(width, initial=0.3)), 0.3)
    return (0, [max(length * POINT, 0.1) / thick for length in dash])


def _numbers(value: Any) -> np.ndarray:
    return np.asarray(0.0 if value is None else value, dtype=float)


def _of_rows(colors: Any, rows: np.ndarray) -> Any:
    return colors[rows] if np.ndim(colors) == 2 else colors


def _with_alpha(color: Any, alpha: Any) -> Any:
    """Return colours for Matplotlib, (n, 4) where they or their alpha are columns."""
    from matplotlib.colors import to_rgba_array

    if color is None:
        return "none"
    count = max(1 if isinstance(color, str) else len(color), np.size(alpha))
    rows = to_rgba_array([color] * count if isinstance(color, str) else color)
    rows[:, 3] *= 1.0 if alpha is None else alpha
    return rows if count > 1 else rows[0]


def _colors(mapper: Any, values: np.ndarray) -> np.ndarray:
    """Return the colours (..., 4) that a linear mapper gives to numbers."""
    from matplotlib.colors import to_rgba_array

    palette = to_rgba_array(list(mapper.palette))
    known = values[np.isfinite(values)]
    low = mapper.low if mapper.low is not None else known.min(initial=0.0)
    high = mapper.high if mapper.high is not None else known.max(initial=1.0)
    share = np.nan_to_num((values - low) / (high - low))
    colors = palette[np.clip((share * len(palette)).astype(int), 0, len(palette) - 1)]
    colors[~np.isfinite(values)] = to_rgba_array([mapper.nan_color])[0]
    return np.asarray(colors)


def _pixels(grid: np.ndarray) -> np.ndarray:
    """Unpack whole numbers, red in the lowest byte, to pixels (rows, columns, 4) of 0 to 255."""
    whole = np.ascontiguousarray(grid.astype(np.uint32))
    return whole.view(np.uint8).reshape(*whole.shape, 4)
