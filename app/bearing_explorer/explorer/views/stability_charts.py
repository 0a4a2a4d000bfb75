"""Charts of stability: growth of a disturbance over shaft speed, amplitude over step rate."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

from bokeh.core.properties import value
from bokeh.models import BoxAnnotation, FixedTicker, HoverTool, Label, Range1d, Span

from bearing_explorer.explorer.views import work_precision
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import by_number
from bearing_explorer.kit.widgets.form import stack
from bearingcore.model.experiments import DIVERGED, OrbitAtSpeed, StabilityChart

HEIGHT = 340
UNSTABLE = "#D55E00"
LEAST = 1e-6
"""Least drawn value; smaller values are raised to it, because a logarithmic axis has no zero."""
STABLE_PAPER, STABLE_INK = "#E6F3EE", "#00704F"


class Mark(NamedTuple):
    """A point: place, colour (index of COLORS), marker, words beside it, tooltip, curve."""

    x: float
    y: float
    slot: int
    marker: str
    words: str
    tooltip: str
    line: int = 0
    align: str = "right"
    right: float = -9.0
    down: float = 4.0


Picture = tuple[list[Mark], dict[str, float], tuple[float, str], str]
"""Marks; edge of the stable part ({"top": a height} or {"left": a rate [Hz]}); place [Hz] and name
of the vertical line; the sentence."""


class StabilityPicture:
    """A chart on logarithmic axes, its stable and unstable part shaded, failures as crosses.

    `title` is its heading; `x` and `y` are the names of the axes.
    """

    def __init__(self, title: str, x: str, y: str) -> None:
        ranges = [Range1d(1.0, 10.0, syncable=False) for _ in range(2)]
        sides = [style.AxisQuantity(name, "", "") for name in (x, y)]
        self.plot = plot = style.make_figure(
            *sides, *ranges, height=HEIGHT, x_axis_type="log", y_axis_type="log",
            sizing_mode="stretch_width",
        )  # fmt: skip
        for axis, unit, steps in ((plot.xaxis, "Hz", (1, 2, 5)), (plot.yaxis, "", (1, 3))):
            axis.formatter = style.logarithmic_ticks(unit)
            ticks = [m * 10.0**e for e in range(-9, 9) for m in steps]
            axis.ticker = FixedTicker(ticks=ticks, minor_ticks=[])
        text = {"text_font": style.FONT, "text_font_size": style.SMALL_TEXT_SIZE}
        self._areas = [
            BoxAnnotation(fill_color=color, fill_alpha=alpha, line_color=None, level="image")
            for color, alpha in ((STABLE_PAPER, 1.0), (UNSTABLE, 0.12))
        ]
        self._words = [
            Label(x=0, y=0, x_offset=6, y_offset=4, text=words, text_color=color, **text)
            for words, color in (("stable", STABLE_INK), ("unstable", UNSTABLE))
        ]
        self._now = Span(dimension="height", line_color=style.INK, line_dash=[2, 4])
        self._now_words = Label(x=0, y=0, x_offset=4, y_offset=4, text_color=style.INK, **text)
        for part in (*self._areas, *self._words, self._now, self._now_words):
            plot.add_layout(part)
        self._marks = work_precision.column_source(*Mark._fields)
        self._lines = work_precision.column_source("xs", "ys", "slot")
        color = by_number("slot", work_precision.COLORS)
        plot.multi_line("xs", "ys", source=self._lines, line_color=color, line_width=1.4)
        marks = plot.scatter("x", "y", source=self._marks, marker="marker", size=9,
                             fill_color=color, line_color=color, line_width=1.6)  # fmt: skip
        plot.text("x", "y", text="words", source=self._marks, text_color=style.INK,
                  text_font=value(style.FONT), text_font_size=style.SMALL_TEXT_SIZE,
                  text_align="align", x_offset="right", y_offset="down")  # fmt: skip
        plot.add_tools(HoverTool(renderers=[marks], visible=False, tooltips="@tooltip"))
        self._sentence = work_precision.prose()
        self.panel = stack(work_precision.prose(f"<h4>{title}</h4>"), plot, self._sentence)

    def show(
        self, marks: list[Mark], stable: dict[str, float], now: tuple[float, str], words: str
    ) -> None:
        """Draw a `Picture`; an infinite mark is a cross on the upper edge."""
        self.plot.visible = bool(marks)
        self._sentence.object = work_precision.paragraph(words)
        if not marks:
            return
        marks = [mark._replace(y=max(mark.y, LEAST)) for mark in marks]
        xs, ys = [m.x for m in marks], [m.y for m in marks if math.isfinite(m.y)]
        left, right = min(xs) / 1.2, max(xs) * 1.5
        bottom, top = min([*ys, 0.5]) / 2.0, max([*ys, 1.5]) * 4.0
        work_precision.set_range(self.plot.x_range, left, right)
        work_precision.set_range(self.plot.y_range, bottom, top)
        opposite = {"top": "bottom", "left": "right"}
        self._areas[0].update(**stable)
        self._areas[1].update(**{opposite[side]: place for side, place in stable.items()})
        self._words[0].update(x=stable.get("left", left), y=bottom)
        self._words[1].update(x=left, y=stable.get("top", bottom))
        self._now.location = now[0]
        self._now_words.update(x=now[0], y=bottom, text=now[1])
        placed = [m if math.isfinite(m.y) else m._replace(y=top / 1.5, marker="x") for m in marks]
        self._marks.data = work_precision.columns_of(Mark._fields, placed)
        lines = []
        for line in dict.fromkeys(mark.line for mark in marks):
            known = [(m.x, m.y) for m in marks if m.line == line and math.isfinite(m.y)]
            lines.append(([x for x, _ in known], [y for _, y in known], line))
        self._lines.data = work_precision.columns_of(("xs", "ys", "slot"), lines)


def orbit_marks(orbits: tuple[OrbitAtSpeed, ...], shaft_speed: float) -> Picture:
    """Growth of a disturbance over the shaft speed; `shaft_speed` [rad/s] is that of the scene."""
    marks: list[Mark] = []
    before = ""
    for orbit in orbits:
        state = orbit.loss or ("stable" if orbit.multipliers else orbit.status)
        size = orbit.size if orbit.multipliers else math.inf
        speed = orbit.shaft_speed / (2.0 * math.pi)
        words = "" if state in (before, "stable") else state
        tooltip = f"{style.number(speed, 3)} Hz: {state}"
        if orbit.multipliers:
            tooltip += f", factor {style.number(size, 3)}"
        higher = sum(1 for mark in marks if mark.words) % 2  # so that names do not overlap
        mark = Mark(speed, size, int(state != "stable"), "circle", words, tooltip)
        marks.append(mark._replace(down=4.0 - 14.0 * higher))
        before = state
    now = shaft_speed / (2.0 * math.pi), "this scene"
    return marks, {"top": 1.0}, now, orbits_sentence(orbits)


def step_marks(chart: StabilityChart | None, in_use: float) -> Picture:
    """Amplitude over steps per second; `in_use` [Hz] is the step rate of the page."""
    if chart is None:
        return [], {}, (in_use, ""), steps_sentence(chart)
    marks = []
    for slot, method in enumerate(dict.fromkeys(trial.method for trial in chart.trials)):
        color, marker = work_precision.look(slot)
        trials = sorted((t for t in chart.trials if t.method == method), key=lambda t: t.step_rate)
        diverged = [trial.verdict == DIVERGED for trial in trials]
        for i, trial in enumerate(trials):
            # a method is named at its first trial that diverged and at its first that did not
            broken, is_first = diverged[i], diverged[i] not in diverged[:i]
            state = DIVERGED if broken else f"amplitude ratio {style.number(trial.amplitude, 3)}"
            tooltip = f"{method}, {style.number(trial.step_rate, 4)} steps/s: {state}"
            if broken:
                tooltip += f", with {_steps_in_period(chart, trial.step_rate)} steps in a period "
                tooltip += f"of {style.with_prefix(chart.highest_frequency, 'Hz')}"
            words = "" if not is_first else f"{method} {DIVERGED}" if broken else method
            size = math.inf if broken else trial.amplitude
            place = ("left", -5.0, 18.0 if slot else -7.0)
            marks.append(Mark(trial.step_rate, size, color, marker, words, tooltip, color, *place))
    rates = [trial.step_rate for trial in chart.trials]
    limit = min(max(next(iter(chart.linear_limit.values())), min(rates) / 2.0), 2.0 * max(rates))
    return marks, {"left": limit}, (in_use, "in use"), steps_sentence(chart)


def steps_sentence(chart: StabilityChart | None) -> str:
    """Say below which step rates methods diverge, and why."""
    if chart is None:
        return "The stability of the steps is not measured yet."
    words: dict[str, list[str]] = {}
    for name in dict.fromkeys(t.method for t in chart.trials):
        if not any(t.verdict == DIVERGED for t in chart.trials if t.method == name):
            words.setdefault("at no step rate tried", []).append(name)
            continue
        limit, theory = chart.stability_limit(name), chart.linear_limit[name]
        here, expected = (_steps_in_period(chart, rate) for rate in (limit, theory))
        why = (
            f"below {style.number(limit, 2)} steps/s: a period of the highest frequency, "
            f"{style.with_prefix(chart.highest_frequency, 'Hz')}, then has fewer than {here} "
            f"steps, so errors grow from step to step (linear theory: {expected})"
        )
        words.setdefault(why, []).append(name)
    return " ".join(
        f"{style.list_words(names)} diverge{'s' if len(names) == 1 else ''} {why}."
        for why, names in words.items()
    )


def _steps_in_period(chart: StabilityChart, step_rate: float) -> str:
    """Number of steps in a period of the chart's highest frequency."""
    return style.number(step_rate / chart.highest_frequency, 2)


def orbits_sentence(orbits: tuple[OrbitAtSpeed, ...]) -> str:
    """Say where the periodic motion loses its stability, and how."""
    known = [orbit for orbit in orbits if orbit.multipliers]
    if not known:
        why = orbits[0].status if orbits else "not measured yet"
        return f"No periodic motion is known at any shaft speed: {why}."

    def speed_words(orbit: OrbitAtSpeed) -> str:
        return f"{style.number(orbit.shaft_speed / (2.0 * math.pi), 3)} Hz"

    changed = [b for a, b in pairwise(known) if a.loss != b.loss]
    changes = [f"{orbit.loss or 'stable again'} from {speed_words(orbit)}" for orbit in changed]
    first = f"{'Unstable' if known[0].loss else 'Stable'} at {speed_words(known[0])}"
    words = ", ".join([first, *(changes or [f"and up to {speed_words(known[-1])}"])])
    missing = len(orbits) - len(known)
    rest = f" No orbit was found at {missing} of {len(orbits)} speeds." if missing else ""
    return f"{words}.{rest}"
