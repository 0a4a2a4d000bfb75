"""Drawing of the bearing: rings, balls coloured by their loads, defects, and the load."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
from bokeh.models import Circle, CustomJS, LayoutDOM, LinearColorMapper, Range1d
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.defect_shape import race_angles, race_depth, spans
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.bearing_handles import handles, let_grab, points
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import color_scales, layers, style
from bearing_explorer.kit.plots.element_words import elements
from bearing_explorer.kit.plots.heat_map import color_bar
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import ANSWER, Ranges, Sources
from bearingcore import Bearing, Load, Scene
from bearingcore.common import table_of
from bearingcore.model.scene import ball_angles

# The drawing measures lengths in outer raceway radii, so its ranges never move.
HALF_WIDTH, OF_A_ROW = 1.62, 1.76  # of one row; of each of several rows, whose numbers need more
HEIGHT, STILL_HEIGHT = 250, 520  # [px] least height with the colour bar: on the page, elsewhere
BAR_START = 0.05  # gap between the outer ring and the bars
BAR_LENGTH = 0.26  # of the greatest load on the colour bar
LOWEST = 1.52  # end of the longest bar, from the middle
HIGHEST = 1.3  # top of a ring with words above it, from the middle
ROW_NAMES = 1.5  # distance of the names of rows below their middle
SIDE_ROOM = 0.55  # room for the number of a bar at 0° or 180°
NUMBER_RIGHT, NUMBER_UP = 20.0, 13.0  # [px] from the end of a bar to the middle of its number
NUMBER_HALF, SIDE = 30.0, 1.25  # [px] half the width of a number; start of its bar from the middle
MOST_NAMED = 4  # balls in a defect that are named; more are counted
LINE_PIXELS = 16.0
WORDS_WIDE, WORDS_HIGH = 95.0, 50.0  # [px] of three lines on the load
KEYWAY = 0.09  # [rad] half its width
ARROW_SHORTEST, ARROW_LONGEST = 0.3, 0.88  # shares of the radius of the bore, after a drag
ARROW_END = 1.45  # from the middle; a longer arrow would leave the figure
DRAWN_DEPTH = 0.45  # of a ball radius: no defect is drawn deeper

PLACE_AND_SIZE = ("x", "y", "radius")
POLYGONS = ("rings", "defect", "healthy_loads", "arrow")

# colours of a ball without load, and of a ball whose load is unknown
IDLE_BALL = style.PAPER
NO_VALUE = "#C9CED4"

_LOAD_WORDS = """
const {kind, value, angle, more} = row
const bore = more ? `, bore = ${si(more, 'N')}` : '', at = narrow ? '' : ` at ${rounded(angle, 3)}°`
if (kind == 0) return value > 0 ? `${si(value, 'N')}${at}${bore}` : 'No radial load'
if (kind == 1) return `Axial ${value > 0 ? '⊙' : '⊗'} ${si(Math.abs(value), 'N')}`
const times = value >= 1 ? value : rounded(value, 2)
if (kind == 4) return `Depth × ${times}`
return `Moment M${kind == 2 ? 'x' : 'y'} ${si(value, 'N·m')}`
"""
_BAR_WORDS = """
const below = row.load < 1 && row.load >= 0.001  // beside newtons, no millinewtons
const text = below ? rounded(row.load, 2) + '\\u00a0N' : si(row.load, 'N', 3)
let room = 0
try { room = row.room/(plot.x_range.end - plot.x_range.start)*plot.inner_width } catch {}
return row.most || room > 7.4*text.length ? text : ''
"""
_BALL_WORDS = """
let wide = Infinity  // two digits and the ring need 16 pixels
try { wide = 2*row.radius*plot.inner_width/(plot.x_range.end - plot.x_range.start) } catch {}
return wide > 16*larger ? row.number : ''
"""
_ROW_WORDS = """
return `Row ${row.row} at z = ${rounded(1000*row.place, 3)} mm`
"""
_EQUAL_ASPECT = f"""{style.LARGER}
let w = 0, h = 0
try {{ w = plot.inner_width; h = plot.inner_height }} catch {{ return }}  // not laid out yet
if (!(w > 0 && h > 0)) return
const several = shown.end > 1.01*half
// the number on the lowest bar is below it, and larger numbers need more
const low = 21*larger
// so does the number at 0°, which stands beside the ring
const beside = (w - 2*({NUMBER_RIGHT} + {NUMBER_HALF})*larger)/(shown.end - half + {SIDE})
// the pixels of two lengths, and the lower edge, with this room [px] above the ring
const fitted = (above) => {{
  const high = above ? {HIGHEST} : half
  const room = 2*(h - above - low - 35*(larger - 1))/(high + {LOWEST})
  // the names of several rows are below them
  const of_rows = several ? (h - above - 68*larger)/{ROW_NAMES} : Infinity
  const unit = Math.min(w/shown.end, room, of_rows, Math.max(beside, 0.3*w))
  return [unit, (high - {LOWEST})/2 - (h - above + low)/unit]
}}
let [unit, start] = fitted(0)
// the words on the load, top left, are above a ring whose numbers would reach into them; several
// small rings have room beside them, but on a phone
const right = w/2 - unit/2*(shown.end - half) - {WORDS_WIDE}*larger
const down = h + start*unit/2 - {WORDS_HIGH}*larger
const reach = {SIDE}*unit/2 + {NUMBER_HALF}*larger
if (several ? w < 420 : Math.hypot(Math.max(right, 0), Math.max(down, 0)) < reach)
  [unit, start] = fitted({WORDS_HIGH}*larger)
const x = w/unit, end = start + 2*h/unit
plot.x_range.setv({{start: -x, end: x, reset_start: -x, reset_end: x}})
plot.y_range.setv({{start, end, reset_start: start, reset_end: end}})
"""


_EDGE = "#6B7480"
_MIDDLE = {"text_align": "center"}
_NUMBER = {**_MIDDLE, "text_font_size": style.SMALL_TEXT_SIZE}
_LINE = {"text_font_size": style.TEXT_SIZE, "text_color": style.FAINT_INK}
_UNDER_A_ROW = {**_LINE, **_MIDDLE, "text_baseline": "top", "y_offset": 20}


def drawing_layers(
    prefix: str, colors: LinearColorMapper, inks: LinearColorMapper
) -> list[layers.Layer]:
    """Layers of the drawing, the lowest first; `colors` map loads, `inks` the numbers on them."""
    load, number = ({"field": "load", "transform": mapper} for mapper in (colors, inks))
    end = layers.Glyph(
        Circle,
        f"{prefix}_roller_ends",
        PLACE_AND_SIZE,
        {"fill_color": None, "line_color": _EDGE, "line_width": 1.0},
    )
    ball = layers.Glyph(
        Circle,
        f"{prefix}_balls",
        PLACE_AND_SIZE,
        {"fill_color": load, "line_color": _EDGE, "line_width": 1.2},
        ("element",),
        layers.LIT,
    )

    def words(
        name: str, code: str, reads: tuple[str, ...], x: Any = "x", y: Any = "y", **look: Any
    ) -> layers.Words:
        return layers.Words(
            f"{prefix}_{name}", x, y, code, reads, x == 0.0, y == 1.0, style.NARROW, look=look
        )

    return [
        layers.filled(f"{prefix}_healthy_loads", style.HEALTHY, 0.25),
        layers.filled(f"{prefix}_rings", style.STEEL, line_color=style.STEEL_EDGE, line_width=1.2),
        layers.filled(f"{prefix}_defect", style.DEFECT, 0.55, line_color="#B87A00", line_width=1.2),
        layers.segments(f"{prefix}_spacings", "#8A5A00", 1.5),
        words(
            "marks",
            "return row.angle + '°'",
            ("angle", "turn"),
            angle="turn",
            text_color=style.FAINT_INK,
            **_NUMBER,
        ),
        layers.segments(f"{prefix}_bars", load, 8, reads=("load",)),
        words(
            "bars",
            _BAR_WORDS,
            ("load", "room", "most", "right", "down"),
            x_offset=style.text_offset("right"),
            y_offset=style.text_offset("down"),
            **_MIDDLE,
        ),
        ball,
        end,
        words("balls", _BALL_WORDS, ("load", "number", "radius"), text_color=number, **_NUMBER),
        layers.filled(f"{prefix}_arrow", style.INK),
        words(
            "load_words",
            _LOAD_WORDS,
            ("kind", "value", "angle", "more", "down"),
            0.0,
            1.0,
            text_baseline="top",
            y_offset=style.text_offset("down"),
            **_LINE,
        ),
        words("row_words", _ROW_WORDS, ("row", "place"), **_UNDER_A_ROW),
    ]


class BearingDrawing(ComparingView):
    """The bearing seen along the shaft, turning with the cage angle."""

    name = "bearing"
    title = "The bearing"
    about = (
        "Ball loads at the cage angle, seen along the shaft. Rows are side by side. Bars and "
        "colours: loads of the balls. Grey rim: {grey}. The arrow is the load on the shaft; it "
        "reaches the bore at the load that is named. Ticks on the ring are ball spacings from the "
        "beginning of the defect. Compared scenes have dashed rims. The keyway turns with the "
        "shaft; z points towards you."
    )
    needs = frozenset({"equilibrium", "now", "drop"})
    #: prefix of the names of its sources
    prefix: ClassVar[str] = "bearing"
    #: True if the defects and the arrow can be dragged
    grabbed: ClassVar[bool] = True

    def build(self, packed: PackedSource) -> Any:
        self._bore_load = StickyRange(0.0, 100.0, anchor="zero", shrink_below=ARROW_SHORTEST)
        self._load_range = StickyRange(0.0, 100.0, anchor="zero", least_span=1e-3)
        load = packed.range(f"{self.prefix}_load", 0.0, 100.0)
        half = HALF_WIDTH
        plot = self._figure(
            Range1d(-half, half, syncable=False), Range1d(-half, half, syncable=False)
        )
        plot.toolbar.active_drag = None  # a drag that misses a handle must not zoom
        shown = packed.range(f"{self.prefix}_width", -half, half)
        aspect = CustomJS(args={"plot": plot, "half": half, "shown": shown}, code=_EQUAL_ASPECT)
        shown.js_on_change("end", aspect)
        plot.js_on_change("inner_width", aspect)
        plot.js_on_change("inner_height", aspect)
        scale = {"high": load.end, "syncable": False}
        idle = {"low": 1e-9, "low_color": IDLE_BALL, "nan_color": NO_VALUE}
        colors = LinearColorMapper(palette=color_scales.LOADS, **idle, **scale)
        inks = LinearColorMapper(palette=color_scales.INKS, low=0.0, nan_color=style.INK, **scale)
        follow = "for (const mapper of mappers) mapper.high = load.end"
        args = {"load": load, "mappers": [colors, inks]}
        load.js_on_change("end", CustomJS(args=args, code=follow))
        drawn = drawing_layers(self.prefix, colors, inks)
        for layer, renderer in zip(drawn, layers.draw(plot, packed, drawn), strict=True):
            if layer.source in (f"{self.prefix}_bars", f"{self.prefix}_healthy_loads"):
                renderer.tags = [ANSWER]
        if self.grabbed:
            layers.draw(plot, packed, compared_curves.curves(f"{self.prefix}_loads", "x", "y"))
            let_grab(plot, packed, f"{self.prefix}_handles")
        self._add_scale(plot, colors, load)
        return plot

    def _figure(self, x: Range1d, y: Range1d) -> figure:
        return style.bare_figure(x, y, height=HEIGHT)

    def still_figures(self) -> Sequence[LayoutDOM]:
        if self.grabbed:
            self.figures[0].min_height = STILL_HEIGHT
        return self.figures

    def _add_scale(self, plot: figure, colors: LinearColorMapper, load: Range1d) -> None:
        bar = color_bar(
            colors,
            orientation="horizontal",
            width=210,
            height=9,
            location="bottom_center",
            padding=2,
            title_standoff=4,
            bar_line_color=style.STEEL_EDGE,
            tags=[ANSWER],
        )
        style.write_units(bar, style.BALL_LOAD, load)
        plot.add_layout(bar, "below")

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        scene, now = results.scene, results.now
        compared = [load for other in results.compared_results for _, load in other.load_curves]
        load_range = self._load_range.fit(
            results.equilibrium.ball_load, results.reference.equilibrium.ball_load, *compared
        )
        top = load_range[1]
        rows = scene.bearing.all_rows
        half = OF_A_ROW if len(rows) > 1 else HALF_WIDTH
        wide = half * len(rows)
        healthy = results.reference.load_curves
        # shapes of each row, side by side
        several: list[Sources] = []
        if not results.held:  # a new scale would move the tip of the arrow out of the hand
            if results.before is None:  # at the start, and after a reset
                self._bore_load.forget()
            self._bore_load.fit(radial_load(scene.load) / ARROW_LONGEST or self._bore_load.end)
        bore_load = self._bore_load.end
        for row in range(len(rows)):
            row_balls = scene.bearing.balls_of_rows[row]
            drawn = Shapes(scene, results.cage_angle, row, bore_load)
            drop = {race: drops[row_balls] for race, drops in results.drop.items()}
            shapes = drawn.all(now.ball_load[0, row_balls], drop, top)
            shapes["healthy_loads"] = drawn.load_rim(*healthy[row], top)
            shapes["handles"] = drawn.handles()
            several.append(shift_shapes(shapes, (2 * row + 1) * half - wide))
        sources = {
            f"{self.prefix}_{name}": join_shapes(
                [outlines[name] for outlines in several], gaps=name in POLYGONS
            )
            for name in several[0]
        }

        def rims(other: Results) -> dict[str, NDArray[np.float64]]:
            curves = zip(range(len(rows)), other.load_curves, strict=False)
            lines = []
            for row, curve in curves:
                line = {"": Shapes(scene, 0.0, row).load_line(*curve, top)}
                lines.append(shift_shapes(line, (2 * row + 1) * half - wide)[""])
            return join_shapes(lines, gaps=True)

        sources |= compared_curves.sources(
            f"{self.prefix}_loads", ("x", "y"), results.compared_results, rims
        )
        sources |= {
            f"{self.prefix}_load_words": load_words(scene.load, drawn.depth_scale, bore_load),
            f"{self.prefix}_row_words": row_words(scene, wide),
        }
        return sources, {f"{self.prefix}_load": load_range, f"{self.prefix}_width": (-wide, wide)}

    def sentence(self, results: Results) -> str:
        now = results.now
        where = f"With the cage at {style.in_degrees(results.cage_angle)}"
        bearing = results.scene.bearing
        total, names = bearing.total_balls, elements(bearing)
        load = now.ball_load[0]
        if not np.all(np.isfinite(load)):
            return f"{where} there is no equilibrium to draw: {now.reason(0)}."
        drop = results.drop["outer"] + results.drop["inner"]
        inside = _inside_words(bearing, np.flatnonzero(drop > 0.0))
        loaded = int(now.loaded_balls[0])
        if loaded == 0:
            return f"{where} none of the {total} {names} carries load{inside}."
        why = reasons.most_loaded(results.scene, now, 0, drop)
        carry = "carry" if loaded > 1 else "carries"
        return f"{why} {where}, {loaded} of {total} {names} {carry} load{inside}.".lstrip()

    def table(self, results: Results) -> dict[str, np.ndarray]:
        bearing, now = results.scene.bearing, results.now
        row, ball = np.array([bearing.row_of_ball(k) for k in range(bearing.total_balls)]).T
        return (
            table_of(
                ("row", "", row + 1),
                ("ball", "", ball + 1),
                ("ball_angle", "rad", now.ball_angle[0]),
                ("ball_load", "N", now.ball_load[0]),
                ("contact_angle", "rad", now.contact_angle[0]),
                ("drop_into_outer_race", "m", results.drop["outer"]),
                ("drop_into_inner_race", "m", results.drop["inner"]),
            )
            .in_units()
            .named()
        )


def _inside_words(bearing: Bearing, balls: NDArray[np.int64]) -> str:
    """Say which of `balls`, counted from 0, are in a defect, row by row."""
    if balls.size == 0:
        return ""
    words = []
    for row, span in enumerate(bearing.balls_of_rows):
        numbers = balls[(balls >= span.start) & (balls < span.stop)] - span.start + 1
        if numbers.size:
            of_row = f" of row {row + 1}" if bearing.rows else ""
            count, kind = numbers.size, elements(bearing, numbers.size)
            names = f"{kind} {style.list_words([str(number) for number in numbers])}"
            words.append((names if count <= MOST_NAMED else f"{count} {kind}") + of_row)
    return f"; {style.list_words(words)} {'is' if balls.size == 1 else 'are'} in the defect"


def shift_shapes(shapes: Sources, to_right: float) -> Sources:
    """Move shapes to the right: all their columns of x."""
    return {
        name: {
            column: values + to_right if column in ("x", "x0", "x1") else values
            for column, values in columns.items()
        }
        for name, columns in shapes.items()
    }


def join_shapes(parts: list[dict[str, np.ndarray]], gaps: bool) -> dict[str, np.ndarray]:
    """Join the columns of several shapes; with `gaps`, polygons have NaN between them."""
    if not gaps:
        return {column: np.concatenate([part[column] for part in parts]) for column in parts[0]}
    return layers.with_gaps(((part["x"], part["y"]) for part in parts if part["x"].size), "x", "y")


def roller_ends(scene: Scene, balls: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The rim of a roller's end; empty for balls."""
    kept = slice(None) if scene.bearing.kind.picture.element == "roller" else slice(0)
    return {"x": balls["x"][kept], "y": balls["y"][kept], "radius": 0.72 * balls["radius"][kept]}


def row_words(scene: Scene, wide: float) -> dict[str, np.ndarray]:
    """Name and place on the shaft of each row, below it; empty for a single row."""
    rows = scene.bearing.rows
    number = np.arange(float(len(rows)))
    return {
        "x": (2.0 * number + 1.0) * OF_A_ROW - wide,
        "y": np.full(number.size, -ROW_NAMES),
        "row": number + 1.0,
        "place": np.array([row.place for row in rows], dtype=float),
    }


def load_words(
    load: Load, depth_scale: float = 0.0, bore_load: float = 0.0
) -> dict[str, np.ndarray]:
    """Lines of text in the corner: the radial load, and other loads that are not zero.

    The last line is the factor by which defects are drawn deeper (`depth_scale`; 0 without any).
    `bore_load` [N] is the load whose arrow ends at the bore.
    """
    angle = math.degrees(math.atan2(load.fy, load.fx)) % 360.0
    rows: list[tuple[float, ...]] = [(0, radial_load(load), angle, bore_load)]
    rows += [
        (kind, value, 0.0, 0.0)
        for kind, value in ((1, load.fz), (2, load.mx), (3, load.my), (4, depth_scale))
        if value != 0.0
    ]
    kind, value, angles, more = np.array(rows, dtype=float).T
    return {
        "down": LINE_PIXELS * np.arange(kind.size),
        "kind": kind,
        "value": value,
        "angle": angles,
        "more": more,
    }


def radial_load(load: Load) -> float:
    """Return the size [N] of the radial load."""
    return math.hypot(load.fx, load.fy)


class Shapes:
    """Shapes of one row of a scene at one cage angle [rad], lengths in outer raceway radii.

    Unlike rows share the radius of the largest, so they are drawn to one scale.

    Shapes of several parts are one polygon with NaN between the parts; a part inside another is a
    hole in it.
    """

    def __init__(
        self, scene: Scene, cage_angle: float, row: int = 0, bore_load: float = 0.0
    ) -> None:
        bearing = scene.bearing.of_row(row)
        self.scene, self.cage_angle, self.row = scene, cage_angle, row
        self.unit = max(row.outer_raceway_radius for row, _ in scene.bearing.unlike_rows)
        self.ball = bearing.ball_radius / self.unit
        self.outer_race = bearing.outer_raceway_radius / self.unit
        self.inner_race = bearing.inner_raceway_radius / self.unit
        # midway between the races, so that balls are drawn between them for any pitch diameter
        self.pitch = 0.5 * (self.outer_race + self.inner_race)
        self.rim = 1.0 + 1.1 * min(self.ball, 0.18)
        self.bore = max(self.inner_race - 1.1 * self.ball, 0.35 * self.inner_race)
        # load [N] of an arrow of length 1, and the length of this arrow
        self.newtons = (bore_load or 2.0 * radial_load(scene.load) or 1.0) / self.bore
        self.arrow = radial_load(scene.load) / self.newtons
        self.spans = spans(scene, cage_angle, row)
        deepest = max((defect.depth for defect in scene.defects), default=0.0)
        self.depth_scale = (
            round_down(DRAWN_DEPTH * self.ball * self.unit / deepest) if deepest > 0.0 else 0.0
        )

    def all(
        self, load: NDArray[np.float64], drop: dict[str, NDArray[np.float64]], top: float
    ) -> Sources:
        """Columns of all shapes by name, for loads [N] and drops [m] of the row's balls."""
        balls = self.balls(drop, load)
        return {
            "rings": self.rings(),
            "defect": self.defects(),
            "spacings": self.ball_spacings(),
            "marks": self.angle_marks(),
            "balls": balls,
            "roller_ends": roller_ends(self.scene, balls),
            "bars": self.bars(load, top),
            "arrow": self.load_arrow(),
            "healthy_loads": polar(),
        }

    def _drawn(self, depth: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.depth_scale * depth / self.unit

    def _race(self, race: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Angle and radius along a race, with defects drawn deeper than they are."""
        angle = race_angles(self.spans, race)
        depth = self._drawn(race_depth(self.scene, self.cage_angle, race, angle, self.row))
        return angle, self.outer_race + depth if race == "outer" else self.inner_race - depth

    def rings(self) -> dict[str, np.ndarray]:
        """Both rings."""
        turn = np.linspace(0.0, 2.0 * math.pi, 181)
        return polar(
            (turn, np.full_like(turn, self.rim)),
            self._race("outer"),
            self._race("inner"),
            self._bore(),
        )

    def _bore(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The bore with a keyway, which turns with the shaft."""
        keyway = self.cage_angle / self.scene.bearing.cage_ratio + 0.5 * math.pi
        angle = keyway + np.linspace(KEYWAY, 2.0 * math.pi - KEYWAY, 181)
        radius = np.full_like(angle, self.bore)
        radius[[0, -1]] += 0.35 * (self.inner_race - self.bore)
        angle[[0, -1]] = angle[[1, -2]]  # radial walls
        return angle, radius

    def defects(self) -> dict[str, np.ndarray]:
        """Material missing from the races."""
        parts = []
        for span in self.spans:
            angle = np.linspace(span.start, span.start + span.extent, 121)
            outer = span.race == "outer"
            race, outwards = (self.outer_race, 1.0) if outer else (self.inner_race, -1.0)
            inside = np.clip(angle, angle[0] + 1e-9, angle[-1] - 1e-9)
            depth = race_depth(self.scene, self.cage_angle, span.race, inside, self.row)
            floor = race + outwards * self._drawn(depth)
            parts.append(
                (
                    np.concatenate([angle, angle[::-1]]),
                    np.concatenate([np.full_like(angle, race), floor[::-1]]),
                )
            )
        return polar(*parts)

    def ball_spacings(self) -> dict[str, np.ndarray]:
        """Ticks at whole ball spacings from the beginning of each defect, up to one beyond it."""
        spacing = self.scene.bearing.of_row(self.row).ball_spacing
        rings = {"outer": (self.outer_race, self.rim), "inner": (self.inner_race, self.bore)}
        ticks = [
            (span.start + number * spacing, rings[span.race])
            for span in self.spans
            if span.extent > 0.0
            for number in range(1, math.floor(span.extent / spacing + 1e-9) + 2)
        ]
        angle = np.array([angle for angle, _ in ticks])
        race, edge = np.array([ring for _, ring in ticks]).reshape(-1, 2).T
        middle = 0.5 * (race + edge)
        return points(middle, angle, "0") | points(edge, angle, "1")

    def angle_marks(self) -> dict[str, np.ndarray]:
        """0°, 90°, 180° and 270° on the outer ring."""
        degrees = np.array([0.0, 90.0, 180.0, 270.0])
        deepest = self._drawn(
            race_depth(self.scene, self.cage_angle, "outer", np.radians(degrees), self.row)
        )
        radius = 0.5 * (self.outer_race + deepest + self.rim)
        return {
            **points(radius, np.radians(degrees)),
            "angle": degrees,
            "turn": np.radians([90.0, 0.0, 90.0, 0.0]),  # along the ring, which can be thin
        }

    def ball_angles(self) -> NDArray[np.float64]:
        """Angle of each ball [rad]."""
        bearing = self.scene.bearing
        return ball_angles(bearing, np.array([self.cage_angle]))[0, bearing.balls_of_rows[self.row]]

    def ball_radii(self, drop: dict[str, NDArray[np.float64]]) -> NDArray[np.float64]:
        """Drawn distances of balls from the middle of the shaft, for drops [m] of any shape."""
        return self.pitch + self._drawn(drop["outer"]) - self._drawn(drop["inner"])

    def balls(
        self, drop: dict[str, NDArray[np.float64]], load: NDArray[np.float64]
    ) -> dict[str, np.ndarray]:
        """Balls at their places, moved by their `drop` [m] on the scale of the drawn depth."""
        angle, radius = self.ball_angles(), self.ball_radii(drop)
        return {
            **points(radius, angle),
            "radius": np.full(angle.size, self.ball),
            "load": load,
            "number": np.arange(1.0, angle.size + 1.0),
            "element": self.scene.bearing.balls_of_rows[self.row].start
            + np.arange(1.0, angle.size + 1.0),
        }

    def bars(self, load: NDArray[np.float64], top: float) -> dict[str, np.ndarray]:
        """A bar outside the ring for each ball, in proportion to its load; `top` has full length.

        Columns also hold the place of its number, the room for it, and True for the greatest load.
        The number lies above or below the end of the bar and right or left of its beginning: so it
        needs little more room to the side than the bar, and leaves the ring free.
        """
        angle = self.ball_angles()
        start = self.rim + BAR_START
        end = start + BAR_LENGTH * load / top
        end[~(load > 0.0)] = np.nan  # a bar without length would still show its line's ends
        return {
            "x": np.where(load > 0.0, start, np.nan) * np.cos(angle),
            "y": end * np.sin(angle),
            "right": NUMBER_RIGHT * np.cos(angle),
            "down": np.where(np.sin(angle) > -1e-9, -NUMBER_UP, NUMBER_UP),
            "room": np.full(angle.size, min(2.0 * math.pi * (start + 0.1) / angle.size, SIDE_ROOM)),
            "most": np.arange(load.size) == np.argmax(np.nan_to_num(load)),
            **points(start, angle, "0"),
            **points(end, angle, "1"),
            "load": load,
        }

    def load_rim(
        self, angle: NDArray[np.float64], load: NDArray[np.float64], top: float
    ) -> dict[str, np.ndarray]:
        """Area that the bar of a ball sweeps in a turn, at steps of half a degree or more."""
        angle, end = self._load_ends(angle, load, top)
        start = np.full_like(angle, self.rim + BAR_START)
        return polar((np.concatenate([angle, angle[::-1]]), np.concatenate([start, end[::-1]])))

    def load_line(
        self, angle: NDArray[np.float64], load: NDArray[np.float64], top: float
    ) -> dict[str, np.ndarray]:
        """Outer edge of the area of `load_rim`; NaN without a load."""
        angle, end = self._load_ends(angle, load, top)
        return polar((angle, np.where(end > self.rim + BAR_START, end, np.nan)))

    def _load_ends(
        self, angle: NDArray[np.float64], load: NDArray[np.float64], top: float
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        every = max(1, angle.size // 720)
        angle, load = angle[::every], np.nan_to_num(load[::every])
        return angle, self.rim + BAR_START + BAR_LENGTH * load / top

    def handles(self) -> dict[str, np.ndarray]:
        """Points where the defects and the arrow can be grabbed."""
        race = {"outer": self.outer_race, "inner": self.inner_race}
        tip = min(self.arrow, ARROW_END)
        return handles(self.scene, self.spans, self.row, race, tip, self.bore, self.newtons)

    def load_arrow(self) -> dict[str, np.ndarray]:
        """Arrow of the radial load from the middle of the shaft; empty without a load.

        A second head marks an arrow that is cut because it is longer than the figure.
        """
        load = self.scene.load
        if self.arrow == 0.0:
            return polar()
        direction = math.atan2(load.fy, load.fx)
        length, half = min(self.arrow, ARROW_END), 0.016
        head = min(0.11, 0.6 * length)
        neck, wide = length - head, 0.47 * head
        shape = [(0.0, -half), (neck, -half), (neck, -wide), (length, 0.0)]
        shape += [(along, -aside) for along, aside in reversed(shape[:-1])]
        parts = [np.array(shape)]
        if self.arrow > ARROW_END:
            parts.append(np.array([(neck - head, -wide), (neck, 0.0), (neck - head, wide)]))
        return polar(
            *((direction + np.arctan2(y, x), np.hypot(x, y)) for x, y in (p.T for p in parts))
        )


def polar(*parts: tuple[NDArray[np.float64], NDArray[np.float64]]) -> dict[str, np.ndarray]:
    """Points of closed lines from (angle [rad], radius), with NaN between the lines."""
    line = layers.with_gaps(parts, "angle", "radius")
    return points(line["radius"], line["angle"])


def round_down(value: float) -> float:
    """The greatest of 1, 2, 5 times a power of ten that is at most `value`."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-12)
    return max(factor for factor in (1.0, 2.0, 5.0) if factor * power <= value * (1 + 1e-9)) * power
