"""Spectra of the housing over shaft speed, with what should be seen in them (Campbell diagram)."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn
from bokeh.models import (
    CheckboxGroup,
    CustomJS,
    GlyphRenderer,
    LinearColorMapper,
    RadioButtonGroup,
    Range1d,
)
from bokeh.palettes import Viridis256
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.plots import style
from bearing_explorer.plots.heat_map import CLEAR, GridImage, Side, color_bar, ends
from bearing_explorer.plots.ranges import nice_range
from bearing_explorer.results.jobs import Work
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.state.sentences import sentence_of
from bearing_explorer.state.value_range import (
    SWEEPABLE,
    Sweep,
    alike_but_for,
    focused,
    sweep,
    usual_range,
    value_of,
)
from bearing_explorer.views.base import Ranges, Sources
from bearing_explorer.views.job_view import JobView
from bearing_explorer.views.modes import SHORT_BAND_WORDS, band_rows, spread
from bearing_explorer.views.vibration_spectrum import HIGHEST, LABEL_WIDTH, SHOWN, decibels
from bearing_explorer.widgets.form import FieldSpec
from bearingcore.dynamics.speed_run import SpeedRun, speed_run

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results

SPEED = "shaft_speed_hz"
COUNTS = (25, 49, 97, 193)
"""Speeds that can be asked for."""
FIRST_COUNT = 25
"""Speeds of the first picture."""
RESOLUTION = 16.0  # [Hz] half a ball pass at 7 Hz on the fan rig is 20 Hz
DEPTH_OF_VIEW = 60.0  # [dB] below the loudest point
HARMONICS = 8
HEIGHT = 520

_SIDES = {"frequency": Side("", "Frequency", "f", "Hz"), SPEED: Side.of(SWEEPABLE[SPEED])}
_SAY = "return isNaN(cell[0]) ? 'not computed' : `${cell[0].toFixed(1).replace('-', '\\u2212')} dB`"
_HARMONIC_WORDS = "if (narrow && row.number % 2 == 0) return ''\n"
_HARMONIC_WORDS += "return row.number == 1 ? (row.inner ? 'BPFI' : 'BPFO') : `${row.number}×`"
_SWITCH = """
const shown = cb_obj.active
parts.forEach((own, which) => { for (const part of own) part.visible = which == shown })
"""


@dataclass(frozen=True)
class Found:
    """A run with its shaft speeds as the page has them."""

    run: SpeedRun
    speeds: Sweep


class SpeedRunSpectra(JobView[Found]):
    """Power spectral density of the housing's acceleration over frequency and shaft speed."""

    name = "speed-run"
    title = "Spectrum over shaft speed"
    about = (
        "Spectrum of the vibration at each shaft speed. It is that of the steady vibration. "
        "Upright: the bands of the natural frequencies, which speed does not move. Slanted: the "
        "ball-pass frequency and its harmonics; where they cross a band the housing is loud. "
        "Horizontal line: current speed. Click to go to a speed."
    )
    needs = frozenset()
    start = "Run up"
    bounds = f"At most {COUNTS[-1]} speeds; a coarse picture comes by itself."

    _begun = False

    def build(self, packed: PackedSource) -> Any:
        frequency = packed.range("speed_run_frequency", 0.0, HIGHEST)
        plot_parts = {dof: self._plot(packed, frequency, dof) for dof in SHOWN}
        switch = RadioButtonGroup(
            labels=[f"Along {dof}" for dof in SHOWN],
            active=1,
            syncable=False,
            margin=(2, 5, 6, 5),
            stylesheets=[style.BUTTONS],
        )
        toggle = CheckboxGroup(
            labels=["Mark bands and ball-pass harmonics"],
            active=[0],
            syncable=False,
            margin=(8, 5, 6, 12),
            stylesheets=[style.BUTTONS],
        )
        plots = [[plot] for plot, _ in plot_parts.values()]
        switch.js_on_change("active", CustomJS(args={"parts": plots}, code=_SWITCH))
        marks = [mark for _, own in plot_parts.values() for mark in own]
        toggle.js_on_change(
            "active",
            CustomJS(
                args={"marks": marks},
                code="for (const mark of marks) mark.visible = cb_obj.active.length > 0",
            ),
        )
        return pn.Column(
            self.job,
            pn.Row(switch, toggle, margin=0, stylesheets=[style.WRAPPED]),
            *(plot for plot, _ in plot_parts.values()),
            sizing_mode="stretch_width",
            margin=0,
        )

    def _plot(
        self, packed: PackedSource, frequency: Range1d, dof: str
    ) -> tuple[figure, list[GlyphRenderer]]:
        speed = _SIDES[SPEED]
        if dof == SHOWN[0]:
            self._images: dict[str, GridImage] = {}
            self._speeds = packed.range("speed_run_speed", 0.0, 60.0)
            self._harmonics = packed.source("speed_run_harmonics", "frequency", "speed")
            self._names = packed.source(
                "speed_run_harmonic_names", "frequency", "speed", "number", "inner"
            )
            self._now = packed.source("speed_run_now", "speed")
            self._marched = packed.source("speed_run_marched", "frequency", "speed")
        plot = style.make_figure(
            style.AxisQuantity("Frequency", "f", "Hz"),
            style.AxisQuantity(speed.words, speed.symbol, speed.unit),
            frequency,
            self._speeds,
            height=HEIGHT,
            name=f"speed_run_drawing_{dof}",
        )
        plot.grid.visible = False
        plot.stylesheets = [":host { cursor: crosshair; }"]
        plot.visible = dof == SHOWN[1]
        plot.syncable = False  # which of them is seen is the browser's business
        shown = packed.range(f"speed_run_level_{dof}", -80.0, -20.0)
        mapper = LinearColorMapper(
            palette=list(Viridis256), low=-80.0, high=-20.0, nan_color=CLEAR, syncable=False
        )
        for end in ("start", "end"):
            shown.js_on_change(
                end,
                CustomJS(
                    args={"mapper": mapper, "shown": shown},
                    code="mapper.setv({low: shown.start, high: shown.end})",
                ),
            )
        self._images[dof] = GridImage(
            plot, packed, f"speed_run_cells_{dof}", [mapper], list(_SIDES.values()), _SAY
        )
        marks = [*self._mark_bands(plot, packed, dof), *self._mark_harmonics(plot)]
        for mark in marks:
            mark.syncable = False
        plot.scatter(
            "frequency", "speed", source=self._marched, marker="triangle", angle=-0.5 * math.pi,
            size=7, fill_color=style.DEFECT, line_color=None, level="annotation",
        )  # fmt: skip
        for color, width in ((style.LIGHT, 4.0), (style.SHADE, 1.6)):
            plot.hspan(y="speed", source=self._now, line_color=color, line_width=width)
        title = f"S{dof} (dB re 1 (m/s²)²/Hz)"
        plot.add_layout(color_bar(mapper, title, bar_line_color=None), "right")
        return plot, marks

    def _mark_bands(self, plot: figure, packed: PackedSource, dof: str) -> list[GlyphRenderer]:
        bands = packed.source(
            f"speed_run_bands_{dof}", "low", "high", "direction", "number", "label_at"
        )
        plot.extra_y_ranges["rows"] = Range1d(0.0, 1.0, syncable=False)
        strips = plot.vstrip(
            "low", "high", source=bands, fill_color=style.LIGHT, fill_alpha=0.13,
            line_color=style.LIGHT,
            line_alpha=0.9, line_width=1.0,
        )  # fmt: skip
        names = plot.text(
            "label_at", 0.965, y_range_name="rows",
            text=style.fitting_words(plot, bands, SHORT_BAND_WORDS),
            source=bands, text_align="center", text_baseline="middle",
            text_font={"value": style.FONT}, text_font_size=style.SMALL_TEXT_SIZE,
            text_color=style.LIGHT, background_fill_color=style.SHADE,
            background_fill_alpha=0.6,
            padding=2,
        )  # fmt: skip
        return [strips, names]

    def _mark_harmonics(self, plot: figure) -> list[GlyphRenderer]:
        lines = plot.line(
            "frequency", "speed", source=self._harmonics, line_color=style.LIGHT,
            line_alpha=0.75,
            line_width=1.0, line_dash=[5, 4],
        )  # fmt: skip
        names = plot.text(
            "frequency", "speed", text=style.fitting_words(plot, self._names, _HARMONIC_WORDS),
            source=self._names, text_align="center", text_baseline="top", y_offset=36,
            text_font={"value": style.FONT}, text_font_size=style.SMALL_TEXT_SIZE,
            text_color=style.LIGHT, background_fill_color=style.SHADE,
            background_fill_alpha=0.6,
            padding=1,
        )  # fmt: skip
        return [lines, names]

    # The job

    def fields(self) -> list[FieldSpec]:
        return [
            {"name": "from", "label": "Shaft speed from (Hz)"},
            {"name": "to", "label": "to (Hz)"},
            {"name": "count", "label": "Speeds", "options": [[str(n), str(n)] for n in COUNTS]},
        ]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        low, high = usual_range(SPEED, editor.limits)
        return {"from": f"{low:g}", "to": f"{high:g}", "count": "97"}, {}

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        if given["count"] not in map(str, COUNTS):
            counts = ", ".join(map(str, COUNTS[:-1]))
            raise ValueError(f"A run has {counts} or at most {COUNTS[-1]} speeds.")
        speeds = sweep(SPEED, given["from"], given["to"], int(given["count"]), editor.limits)
        scene = focused(editor.scene, editor.selected)

        def work(job: Work) -> str:
            return compute(job, scene, speeds)

        return work

    # The picture

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        found = self.found
        if found is None:
            return self._nothing(), {}
        run, speeds = found.run, found.speeds
        scene = focused(results.scene, results.focus)
        alpha = 1.0 if alike_but_for(scene, run.scene, (speeds,)) else 0.35
        seen = run.frequency <= top_frequency(run)
        frequency = run.frequency[seen]
        level_ranges = {}
        sources: Sources = {}
        for dof in SHOWN:
            level = levels_of(run, dof)[:, seen]
            level_ranges[f"speed_run_level_{dof}"] = level_range(level, frequency)
            sources[f"speed_run_cells_{dof}"] = self._images[dof].columns(
                (_SIDES["frequency"], frequency), (_SIDES[SPEED], speeds.values), [level], alpha
            )
            sources[f"speed_run_bands_{dof}"] = band_columns(run, dof, float(frequency[-1]))
        limits = ends(speeds.values)
        sources |= harmonics(run, speeds, float(frequency[-1]))
        not_proven = speeds.values[~run.from_orbit & np.isfinite(run.density).all(axis=(1, 2))]
        sources["speed_run_now"] = {"speed": np.array([value_of(scene, speeds.field)])}
        sources["speed_run_marched"] = {
            "frequency": np.full(not_proven.size, 0.006 * frequency[-1]),
            "speed": not_proven,
        }
        return sources, {
            "speed_run_frequency": (0.0, float(frequency[-1])),
            "speed_run_speed": limits,
            **level_ranges,
        }

    def _nothing(self) -> Sources:
        none = np.zeros(0)
        bands = dict.fromkeys(("low", "high", "direction", "number", "label_at"), none)
        return {
            **{f"speed_run_cells_{dof}": self._images[dof].nothing() for dof in SHOWN},
            **{f"speed_run_bands_{dof}": bands for dof in SHOWN},
            "speed_run_harmonics": {"frequency": none, "speed": none},
            "speed_run_harmonic_names": dict.fromkeys(
                ("frequency", "speed", "number", "inner"), none
            ),
            "speed_run_now": {"speed": none},
            "speed_run_marched": {"frequency": none, "speed": none},
        }

    def sentence(self, results: Results) -> str:
        found = self.found
        if found is None:
            return "There is no run yet."
        run = found.run
        words = []
        for dof in SHOWN:
            level = levels_of(run, dof)
            level[:, run.frequency < 100.0] = np.nan
            if np.isfinite(level).any():
                i, k = np.unravel_index(np.nanargmax(level), level.shape)
                words.append(
                    f"along {dof} at {run.frequency[k]:.0f} Hz when the shaft turns at "
                    f"{style.number(found.speeds.values[i])} Hz"
                )
        text = f"Loudest {style.list_words(words)}." if words else "Nothing moves."
        marched = int(np.sum(~run.from_orbit))
        if marched:
            text += (
                f" At {marched} of {run.shaft_speed.size} speeds (triangles) no stable orbit was "
                "found, and the motion was marched."
            )
        scene = focused(results.scene, results.focus)
        if not alike_but_for(scene, run.scene, (found.speeds,)):
            text = f"Faint, as the scene has changed since this was computed. Then: {text}"
        return text

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is None or results.moving or self._begun or self._jobs is None:
            return
        if self.found is None and not self._jobs.busy:
            self._begin_coarse()

    def _begin_coarse(self) -> None:
        """A first picture that nobody had to ask for."""
        self._begun = True
        with contextlib.suppress(ValueError):  # the button says why
            self.begin({**self.job.values, "count": str(FIRST_COUNT)})

    def table(self, results: Results) -> dict[str, np.ndarray]:
        found = self.found
        if found is None:
            return {}
        run = found.run
        orbits = np.repeat(run.from_orbit.astype(int), run.frequency.size)
        return {**run.table().in_units({"rad/s": "Hz"}).named(), "from_orbit": orbits}


def compute(job: Work, scene: Any, speeds: Sweep) -> str:
    """A coarse run and then the one that was asked for. Runs in a job's thread."""
    started = time.perf_counter()
    n = speeds.values.size
    levels = [speeds.every((n - 1) // (FIRST_COUNT - 1)), speeds] if n > FIRST_COUNT else [speeds]
    total = sum(level.values.size for level in levels)
    done = 0
    shown = "Nothing is shown yet."
    for level in levels:
        size = level.values.size
        try:
            run = speed_run(
                scene,
                level.in_si[1],
                resolution=RESOLUTION,
                progress=job.within(done / total, (done + size) / total),
                cancelled=job.cancelled,
            )
            if run.cost and not done:
                raise ValueError(run.cost)
        except ValueError as error:
            raise ValueError(sentence_of(error)) from error
        if run.cost:
            return f"{shown} Finer was not begun, {run.cost}."
        if run.completed or not done:
            job.show(Found(run, level))
            shown = f"{size} speeds after {time.perf_counter() - started:.1f} s."
        if not run.completed:
            break
        done += size
    return shown


def top_frequency(run: SpeedRun) -> float:
    """Highest frequency that is drawn [Hz]: more than usual where a band lies higher."""
    high = np.array([band[1] for band in run.bands.values()])
    return max(HIGHEST, 1.05 * float(np.nanmax(high, initial=0.0)))


def levels_of(run: SpeedRun, dof: str) -> NDArray[np.float64]:
    """(n, m) levels [dB] of a direction; NaN where it cannot move or was not computed."""
    if dof not in run.dofs:
        return np.full(run.density.shape[:2], np.nan)
    return np.asarray(decibels(run.density[:, :, run.dofs.index(dof)]))


def level_range(level: NDArray[np.float64], frequency: NDArray[np.float64]) -> tuple[float, float]:
    """Ends of the colour scale [dB], after what is heard above 100 Hz."""
    heard = level[:, frequency >= 100.0]
    if not np.isfinite(heard).any():
        return -80.0, -20.0
    top = nice_range(float(np.nanmax(heard)) - DEPTH_OF_VIEW, float(np.nanmax(heard)))[1]
    return top - DEPTH_OF_VIEW, top


def band_columns(run: SpeedRun, dof: str, top: float) -> dict[str, np.ndarray]:
    """Bands of the modes of one direction as columns, with the places of their labels."""
    bands = band_rows({label: ends for label, ends in run.bands.items() if label[:-1] == dof})
    middle = 0.5 * (bands["low"] + bands["high"])
    return {**bands, "label_at": spread(middle, LABEL_WIDTH * top, 0.0, top)}


def harmonics(run: SpeedRun, speeds: Sweep, top: float) -> Sources:
    """The lines of the ball-pass frequency and its harmonics up to `top` [Hz], and their names.

    Names stand where a line leaves the picture.
    """
    low, high = ends(speeds.values)
    ratio = float(run.ball_pass_frequency[-1] / speeds.values[-1])
    number = np.arange(1.0, HARMONICS + 1.0)
    last = np.minimum(high, top / (number * ratio))
    drawn = last > low
    number, last = number[drawn], last[drawn]
    first, gap = np.full(number.size, low), np.full(number.size, np.nan)
    places = np.stack([first, last, gap], axis=1)  # of each line along the speeds
    inner = any(defect.race == "inner" for defect in run.scene.defects)
    return {
        "speed_run_harmonics": {
            "frequency": (places * (ratio * number)[:, None]).ravel(),
            "speed": places.ravel(),
        },
        "speed_run_harmonic_names": {
            "frequency": np.minimum(number * ratio * last, 0.985 * top),
            "speed": last,
            "number": number,
            "inner": np.full(number.size, float(inner)),
        },
    }
