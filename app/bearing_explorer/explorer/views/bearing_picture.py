"""Cross-section of a bearing as SVG, drawn from its numbers.

Each dimension is a group of the class ``dimension``, which a person can point at; its ``data-name``
is the name of its control.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

from bearing_explorer.explorer.state.field_values import BEARING_GROUPS, SHOWN_FIELDS
from bearingcore import Bearing
from bearingcore.bearings import center_distance

Point = tuple[float, float]

_CONTROL = {field.full_name: field.key for field in SHOWN_FIELDS if field.group in BEARING_GROUPS}

AXIS, MIDDLE = 372.0, 155.0
"""Height of the middle of the shaft (from the top), and place of the bearing along the shaft."""
SHOULDER = 0.42
"""Thickness of a ring behind its groove in ball diameters; height of its shoulders in radii."""
CONTACT: Point = (440.0, 142.0)
"""The centre of the element that is drawn large."""


@lru_cache(maxsize=32)
def bearing_picture(bearing: Bearing) -> str:
    """The SVG: section to scale, enlarged contact, front view, and the law of the contact.

    On a narrow page the style sheet puts all but the section below it.
    """
    enlarged = _line_contact if bearing.kind.picture.element == "roller" else _grooves
    details = "".join([*enlarged(bearing), *_front(bearing), *_law(bearing)])
    parts = _shape("g", "".join(_section(bearing)), cls="cross-section")
    parts += _shape("g", details, cls="details")
    words = "Cross-section of the bearing with its dimensions"
    return (
        '<svg viewBox="0 0 740 400" preserveAspectRatio="xMinYMin" role="img" class="picture" '
        f'aria-label="{words}">{parts}</svg>'
    )


# Shapes


def _shape(tag: str, content: str = "", **attributes: object) -> str:
    """An SVG element; ``cls`` stands for ``class``, and an underscore in a name for a hyphen."""
    named = {"class" if name == "cls" else name.replace("_", "-"): value
             for name, value in attributes.items()}  # fmt: skip
    text = "".join(
        f' {name}="{value:.2f}"' if isinstance(value, float) else f' {name}="{value}"'
        for name, value in named.items()
    )
    return f"<{tag}{text}>{content}</{tag}>"


def _path(cls: str, *commands: str | float) -> str:
    """An SVG path from its commands: letters, lengths (float) and flags (int)."""
    d = " ".join(f"{part:.2f}" if isinstance(part, float) else str(part) for part in commands)
    return _shape("path", d=d, cls=cls)


def _line(cls: str, x1: float, y1: float, x2: float, y2: float) -> str:
    return _path(cls, "M", x1, y1, "L", x2, y2)


def _label(
    x: float, y: float, text: str, below: str = "", after: str = "", anchor: str = "middle"
) -> str:
    """A symbol with an index `below`, and text `after` it on the line."""
    parts = [_shape("tspan", text)]
    if below:
        parts.append(_shape("tspan", below, cls="below", dy=4))
    if after:
        parts.append(_shape("tspan", after, dy=-4 if below else 0))
    return _shape("text", "".join(parts), x=x, y=y, text_anchor=anchor, cls="label")


def _dimension(field: str, *parts: str) -> str:
    """Group the shapes of a dimension: they light up together, a click leads to its control."""
    return _shape("g", "".join(parts), cls="dimension", data_name=_CONTROL[field])


def _arrow(x1: float, y1: float, x2: float, y2: float, both: bool = True) -> str:
    arrow = _line("line", x1, y1, x2, y2) + _line("grip", x1, y1, x2, y2)
    length = math.hypot(x2 - x1, y2 - y1)
    if length < 4.0:
        return arrow
    dx, dy = (x2 - x1) / length, (y2 - y1) / length
    arrow += _head(x2, y2, dx, dy)
    return arrow + (_head(x1, y1, -dx, -dy) if both else "")


def _head(x: float, y: float, dx: float, dy: float) -> str:
    side = (-7.0 * dx - 2.6 * dy, -7.0 * dy + 2.6 * dx)
    return _path("head", "M", x, y, "l", *side, "l", 5.2 * dy, -5.2 * dx, "z")


def _circle(cls: str, x: float, y: float, r: float) -> str:
    return _shape("circle", cx=x, cy=y, r=r, cls=cls)


def _box(cls: str, x: float, y: float, width: float, height: float, rx: float = 0.0) -> str:
    return _shape("rect", x=x, y=y, width=width, height=height, rx=rx, cls=cls)


# Upper half of the section, to scale: radii are heights above the middle of the shaft


class _DrawnRow(NamedTuple):
    """A drawn row: place, radius of its ball, heights of its centre and raceways.

    `lean` is the slope of the races along the shaft.
    """

    number: int
    x: float
    ball: float
    centre: float
    outer: float
    inner: float
    lean: float


class _Section:
    """The section of a bearing: its scale, and its rows from right to left."""

    def __init__(self, bearing: Bearing) -> None:
        self.bearing = bearing
        singles = [bearing.of_row(k) for k in range(len(bearing.all_rows))]
        largest = max(single.ball_diameter for single in singles)
        rim = max(s.outer_raceway_radius + SHOULDER * s.ball_diameter for s in singles)
        hole = min(s.inner_raceway_radius - SHOULDER * s.ball_diameter for s in singles)
        places = [row.place for row in bearing.all_rows]
        span = max(places) - min(places)
        self.scale = min(325.0 / rim, 84.0 / largest, 150.0 / (span + 1.6 * largest))
        self.is_roller = bearing.kind.picture.element == "roller"
        self.ball = 0.5 * self.scale * bearing.ball_diameter
        self.long = 0.5 * self.scale * (bearing.roller_length or bearing.ball_diameter)
        wide = span + 1.6 * largest
        if bearing.roller_length is not None:
            wide = span + bearing.roller_length + 0.6 * largest
        self.half = 0.5 * self.scale * wide
        self.left, self.right = MIDDLE - self.half, MIDDLE + self.half
        self.top, self.bore = self.up(rim), min(self.up(max(hole, 0.0)), AXIS - 6.0)
        self.rows = sorted(
            (
                _DrawnRow(
                    k,
                    MIDDLE + self.scale * row.place,
                    0.5 * self.scale * single.ball_diameter,
                    self.up(0.5 * single.pitch_diameter),
                    self.up(single.outer_raceway_radius),
                    self.up(single.inner_raceway_radius),
                    row.facing * math.tan(single.contact_angle),
                )
                for k, (row, single) in enumerate(zip(bearing.all_rows, singles, strict=True))
            ),
            key=lambda row: -row.x,
        )

    def up(self, radius: float) -> float:
        """Height in the drawing of a radius [m]."""
        return AXIS - self.scale * radius

    def groove(self, row: _DrawnRow, level: float, side: float) -> list[str | float]:
        """Path along the race of a row; `side` is 1 for the outer ring, −1 for the inner ring."""
        edge, wide = level + side * SHOULDER * row.ball, 0.8 * row.ball
        if self.is_roller:
            half = (self.long + 1.0) / math.hypot(1.0, row.lean)  # of a leaning race
            rise = half * row.lean
            edge += side * max(abs(rise) - SHOULDER * row.ball, 0.0)  # the rib covers the race
            return ["V", edge, "H", row.x + half, "V", level + rise,
                    "L", row.x - half, level - rise, "V", edge]  # fmt: skip
        deep = level - side * SHOULDER * row.ball
        return ["V", edge, "H", row.x + wide, "Q", row.x, deep, row.x - wide, edge]

    def outer_race(self) -> list[str | float]:
        if self.bearing.kind.picture.outer == "sphere":  # its centre is on the shaft
            radius = self.scale * self.bearing.outer_raceway_radius
            edge = AXIS - math.sqrt(max(radius * radius - self.half * self.half, 0.0))
            return ["V", edge, "A", radius, radius, 0, 0, 0, self.left, edge]
        return [*(part for row in self.rows for part in self.groove(row, row.outer, 1.0)),
                "H", self.left]  # fmt: skip

    def inner_race(self) -> list[str | float]:
        if self.bearing.kind.picture.inner == "flat":  # rollers run on a ring without shoulders
            return ["V", self.rows[0].inner, "H", self.left]
        return [*(part for row in self.rows for part in self.groove(row, row.inner, -1.0)),
                "H", self.left]  # fmt: skip

    def element(self, row: _DrawnRow) -> str:
        if not self.is_roller:
            return _circle("ball", row.x, row.centre, row.ball)
        corner = row.x - self.long, row.centre - row.ball
        box = _box("ball", *corner, 2.0 * self.long, 2.0 * row.ball, 2.0)
        turn = math.degrees(math.atan(row.lean))
        return _turned(box, turn, row.x, row.centre) if turn else box

    def height(
        self, field: str, x: float, start: float, level: float, text: str, below: str,
        after: str = "",
    ) -> str:  # fmt: skip
        """A radius, drawn as an arrow from the middle of the shaft."""
        before = x < MIDDLE
        return _dimension(
            field,
            _line("witness", start, level, x - math.copysign(5.0, start - x), level),
            _arrow(x, AXIS, x, level),
            _label(x + (-5.0 if before else 5.0), AXIS - 0.45 * (AXIS - level), text, below, after,
                   "end" if before else "start"),
        )  # fmt: skip


def _turned(content: str, degrees: float, x: float, y: float) -> str:
    return _shape("g", content, transform=f"rotate({degrees:.2f} {x:.2f} {y:.2f})")


def _section(bearing: Bearing) -> Iterable[str]:
    """The section to scale, with its dimensions."""
    cut, look = _Section(bearing), bearing.kind.picture
    yield _path("steel", "M", cut.left, cut.top, "H", cut.right, *cut.outer_race(), "Z")
    yield _path("steel", "M", cut.left, cut.bore, "H", cut.right, *cut.inner_race(), "Z")
    yield from map(cut.element, cut.rows)
    if len(cut.rows) > 1 and look.outer != "sphere" and any(row.lean for row in cut.rows):
        for row in cut.rows:  # lines of contact, down to the middle of the shaft
            rise = 1.5 * row.ball
            foot = row.x - (AXIS - row.centre) * row.lean
            yield _line("line dashed", row.x + rise * row.lean, row.centre - rise, foot, AXIS)
    yield _line("axis", 14.0, AXIS, 296.0, AXIS)
    # dimensions, at the first row if rows are unlike, else at the right one
    by_number = {row.number: row for row in cut.rows}
    second = bearing.rows[1].own if len(bearing.rows) > 1 else {}
    unlike = bool({"ball_diameter", "pitch_diameter"} & second.keys())
    first = by_number[0] if unlike else cut.rows[0]
    x, centre = first.x, cut.up(0.5 * bearing.pitch_diameter)
    if "roller_length" in look.dimensions:
        level = centre + 0.45 * cut.ball
        yield _dimension("roller_length", _arrow(x - cut.long, level, x + cut.long, level),
                         _label(x, level + 13.0, "l"))  # fmt: skip
    if len(cut.rows) > 1:
        yield _row_distance(cut)
    if unlike:
        yield from _second_row(by_number[1])
    if "groove_center_radius" in look.dimensions:
        level = cut.up(bearing.groove_center_radius)
        yield cut.height("groove_center_radius", 26.0, cut.left, level, "r", "d")
    place = min(72.0, cut.left - 6.0)
    yield cut.height("pitch_diameter", place, cut.left, centre, "D", "p", "/2")
    yield cut.height("inner_raceway_radius", max(236.0, cut.right + 8.0), cut.right,
                    cut.up(bearing.inner_raceway_radius), "R", "i")  # fmt: skip
    yield cut.height("outer_raceway_radius", max(266.0, cut.right + 38.0), cut.right,
                    cut.up(bearing.outer_raceway_radius), "R", "o")  # fmt: skip
    if cut.is_roller:
        x += 0.6 * cut.long
        yield _dimension("ball_diameter", _arrow(x, centre - cut.ball, x, centre + cut.ball),
                         _label(x - 5.0, centre - 8.0, "D", "b", anchor="end"))  # fmt: skip
    else:
        yield _dimension("ball_diameter", _arrow(x - cut.ball, centre, x + cut.ball, centre),
                         _label(x, centre - 5.0, "D", "b"))  # fmt: skip
    yield from (_circle("centre", row.x, row.centre, 2.6) for row in cut.rows)
    yield _label(MIDDLE, 396.0, "to scale, above the middle of the shaft")


def _row_distance(cut: _Section) -> str:
    """The distance between two rows, drawn below the middle of the shaft."""
    right, left = cut.rows[:2]
    level = AXIS + 6.0
    return _dimension(
        "row_distance",
        *(_line("witness", row.x, row.centre, row.x, level + 2.0) for row in (left, right)),
        _arrow(left.x, level, right.x, level),
        _label(MIDDLE, level - 4.0, "a"),
    )


def _second_row(row: _DrawnRow) -> Iterable[str]:
    """Dimensions of a second row that is unlike the first."""
    x, away = row.x, row.x - 0.6 * row.ball
    yield _dimension(
        "second_ball_diameter",
        _arrow(x - row.ball, row.centre, x + row.ball, row.centre),
        _label(x, row.centre - 5.0, "D", "b2"),
    )
    yield _dimension(
        "second_pitch_diameter",
        _arrow(away, AXIS, away, row.centre),
        _label(away - 5.0, AXIS - 0.3 * (AXIS - row.centre), "D", "p2", "/2", "end"),
    )


# One element between its races; clearance and conformity are drawn larger than they are


def _gap(bearing: Bearing) -> float:
    clearance = bearing.radial_clearance
    return 5.0 + 16.0 * (1.0 - math.exp(-clearance / 2e-5)) if clearance > 0.0 else 0.0


def _clearance(x: float, low: float, gap: float, *witnesses: str) -> str:
    return _dimension(
        "radial_clearance",
        *witnesses,
        _arrow(x, low - 18.0, x, low, both=False),
        _arrow(x, low + gap + 18.0, x, low + gap, both=False),
        _label(x + 8.0, low + 4.0 + 0.5 * gap, "r", "L", anchor="start"),
    )


def _line_contact(bearing: Bearing) -> Iterable[str]:
    """A roller between its races, which it touches along a line."""
    (x, y), high, gap = CONTACT, 60.0, _gap(bearing)
    slender = (bearing.roller_length or 0.0) / bearing.ball_diameter
    long = min(110.0, max(25.0, high * slender))
    low, angle = y + high, bearing.contact_angle
    races = _box("steel", x - 124.0, y - high - 30.0, 248.0, 30.0)
    races += _box("steel", x - 124.0, low + gap, 248.0, 30.0)
    races += _box("ball", x - long, y - high, 2.0 * long, 2.0 * high, 5.0)
    yield _turned(races, math.degrees(angle), x, y) if angle else races
    if angle:
        yield _angle(angle, high)
    if gap:
        yield _clearance(x + long + 20.0, low, gap)
    for number, note in enumerate(bearing.kind.picture.notes):
        yield _label(x, 270.0 + 18.0 * number, note)


class _Circle(NamedTuple):
    x: float
    y: float
    r: float

    def point(self, angle: float) -> Point:
        """Point of the circle at an angle from its top."""
        return self.x + self.r * math.sin(angle), self.y - self.r * math.cos(angle)


def _grooves(bearing: Bearing) -> Iterable[str]:
    """A ball between its grooves."""
    (x, y), ball, gap = CONTACT, 76.0, _gap(bearing)
    angle = bearing.contact_angle
    sine, cosine = math.sin(angle), math.cos(angle)
    likely = 0.5 * (center_distance(bearing.groove_center_distance) + bearing.ball_diameter)
    far = {}
    for race in ("outer", "inner"):
        wider = 2.0 * (bearing.groove_radius(race) or likely) / bearing.ball_diameter - 1.0
        far[race] = ball * (0.16 + 2.4 * min(max(wider, 0.0), 0.2))
    outer = _Circle(x - far["outer"] * sine, y + far["outer"] * cosine, ball + far["outer"])
    inner = _Circle(x + far["inner"] * sine, y - far["inner"] * cosine + gap, ball + far["inner"])
    yield _ring(outer, 1.0, y - ball - 34.0)
    yield _ring(inner, -1.0, y + ball + 34.0 + gap)
    yield _circle("ball", x, y, ball)
    yield _angle(angle, ball)
    if "groove_center_distance" in bearing.kind.picture.dimensions:
        middle = 0.5 * (outer.x + inner.x), 0.5 * (outer.y + inner.y)
        yield _dimension(
            "groove_center_distance",
            _arrow(outer.x, outer.y, inner.x, inner.y),
            *(_circle("centre", circle.x, circle.y, 2.6) for circle in (outer, inner)),
            _label(middle[0] - 9.0, middle[1] + 4.0, "A", "0", anchor="end"),
        )
    if bearing.outer_groove_radius is not None:
        ends = ("outer", "o", outer, -0.62, -6.0), ("inner", "i", inner, math.pi + 0.62, 14.0)
        for race, index, circle, turn, lower in ends:
            end = circle.point(turn)
            yield _dimension(
                f"{race}_groove_radius",
                _arrow(circle.x, circle.y, *end, both=False),
                _label(end[0] - 4.0, end[1] + lower, "r", index, anchor="end"),
            )
    if gap:
        right, low = x + ball + 52.0, y + ball
        yield _clearance(
            right, low, gap,
            _line("witness", x - 10.0, low, right + 6.0, low),
            _line("witness", x + 10.0, low + gap, right + 6.0, low + gap),
        )  # fmt: skip
    for number, note in enumerate(bearing.kind.picture.notes):
        yield _label(x, 300.0 + 18.0 * number, note)


def _ring(circle: _Circle, side: float, back: float) -> str:
    """The steel of a ring from the height `back` to its groove."""
    ends = [circle.point(turn if side > 0.0 else math.pi - turn) for turn in (-0.9, 0.9)]
    (left, level), end, sweep = ends[0], ends[1], 1 if side > 0.0 else 0
    x = CONTACT[0]
    return _path("steel", "M", x - 118.0, back, "V", level, "H", left, "A", circle.r, circle.r,
                 0, 0, sweep, *end, "H", x + 118.0, "V", back, "Z")  # fmt: skip


def _angle(angle: float, ball: float) -> str:
    """The contact angle, from the plane of the balls to the line of contact."""
    x, y = CONTACT
    sine, cosine, far, arc = math.sin(angle), math.cos(angle), 1.5 * ball, 1.32 * ball
    parts = [
        _line("line dashed", x - ball * sine, y + ball * cosine, x + far * sine, y - far * cosine),
        _line("witness", x, y, x, y - far),
    ]
    if angle > 0.0:
        end = x + arc * sine, y - arc * cosine
        parts.append(_path("line", "M", x, y - arc, "A", arc, arc, 0, 0, 1, *end))
    half = 0.5 * angle
    place = x + arc * math.sin(half) + 4.0, y - arc * math.cos(half) - 5.0
    return _dimension("contact_angle", *parts, _label(*place, "α", "0", anchor="start"))


# All elements seen along the shaft, and the load of an element over its compression


def _front(bearing: Bearing) -> Iterable[str]:
    """The elements seen along the shaft, with their number."""
    x, y = 660.0, 100.0
    scale = 66.0 / (bearing.outer_raceway_radius + 0.3 * bearing.ball_diameter)
    for radius in (bearing.outer_raceway_radius, bearing.inner_raceway_radius):
        yield _circle("ring", x, y, scale * radius)
    pitch, ball = 0.5 * scale * bearing.pitch_diameter, 0.5 * scale * bearing.ball_diameter
    turns = (2.0 * math.pi * i / bearing.n_balls for i in range(bearing.n_balls))
    balls = [_circle("ball", x + pitch * math.cos(t), y - pitch * math.sin(t), ball) for t in turns]
    counts = [balls.stop - balls.start for balls in bearing.balls_of_rows]
    alike = len(set(counts)) == 1
    several = f"{len(counts)} · {counts[0]}" if len(counts) > 1 else str(counts[0])
    count = several if alike else " + ".join(map(str, counts))
    yield _dimension("n_balls", *balls, _label(x, y + 5.0, "N", "b", f" = {count}"))


def _law(bearing: Bearing) -> Iterable[str]:
    """Load of an element over its compression: the curve that the factor K scales."""
    x, y, width, height, most, greatest = 606.0, 300.0, 104.0, 74.0, 20e-6, 1.6e10
    top = min(1.0, math.sqrt(bearing.load_deflection_factor / greatest))
    curve: list[str | float] = []
    for i in range(25):
        level = y - height * top * (i / 24.0) ** bearing.kind.exponent
        curve += ["L" if i else "M", x + width * i / 24.0, level]
    yield _path("ring", "M", x, y - height - 8.0, "V", y, "H", x + width + 8.0)
    law = f"Q = K δ{bearing.kind.exponent_text}"
    yield _dimension(
        "load_deflection_factor",
        _path("line curve", *curve),
        _path("grip", *curve),
        _label(x + 8.0, y - height + 4.0, law, anchor="start"),
    )
    yield _label(x + width, y + 16.0, f"compression δ, to {1e6 * most:g} µm", anchor="end")
