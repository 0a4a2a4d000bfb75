"""Spectra of the housing over shaft speed, with bands and ball-pass lines (Campbell diagram)."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import panel as pn
from bokeh.models import GlyphRenderer, HSpan, Scatter
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.explorer.plots.frequency_bands import SHORT_BAND_WORDS, bands_along, highest
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state import value_range
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.kit.compute.jobs import COMPUTATION, Work
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.heat_map import GridImage, Side, ends
from bearing_explorer.kit.plots.levels import FREQUENCY, HIGHEST, SHOWN, decibels
from bearing_explorer.kit.plots.ranges import nice_range
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore import FieldError, Scene
from bearingcore.model.dynamics import SpeedRun, speed_run

SPEED = "shaft_speed_hz"
COUNTS = (25, 49, 97, 193)
"""Numbers of speeds to choose from."""
FIRST_COUNT = 25
"""Speeds of the first picture."""
FAINT = 0.35
"""Opacity of a run of another scene."""
RESOLUTION = 16.0  # [Hz]: below half a ball-pass frequency, 20 Hz on the fan rig at 7 turns/s
DEPTH_OF_VIEW = 60.0  # [dB] below the loudest point
HARMONICS = 8
HEIGHT = 330

_SIDES = {
    "frequency": Side("", "Frequency", "f", "Hz"),
    SPEED: Side.of(value_range.SWEEPABLE[SPEED]),
}
_SAY = "return isNaN(cell) ? 'not computed' : `${cell.toFixed(1).replace('-', '\\u2212')} dB`"
_HARMONIC_WORDS = "if (narrow && row.number % 2 == 0) return ''\n"
_HARMONIC_WORDS += "return row.number == 1 ? (row.inner ? 'BPFI' : 'BPFO') : `${row.number}×`"
_ON_PICTURE = {
    "text_align": "center",
    "text_color": style.LIGHT,
    "background_fill_color": style.SHADE,
    "background_fill_alpha": 0.6,
}
"""Style of words on the picture."""


def expected_layers(dof: str) -> list[layers.Layer]:
    """Layers of the natural frequencies' bands along `dof` and of the ball-pass harmonics."""
    bands, names = f"speed_run_bands_{dof}", "speed_run_harmonic_names"
    edge: dict[str, Any] = {"line_color": style.LIGHT, "line_alpha": 0.9, "line_width": 1.0}
    below = {"text_baseline": "top", "y_offset": 36, "padding": 1}
    return [
        layers.strips(bands, style.LIGHT, 0.13, **edge),
        layers.Words(
            bands,
            "label_at",
            1.0,
            SHORT_BAND_WORDS,
            reads=("direction", "number"),
            y_share=True,
            fitting=style.NARROW,
            look={**_ON_PICTURE, "padding": 2, "y_offset": 16},
        ),
        layers.curve("speed_run_harmonics", "frequency", "speed", style.LIGHT, 1.0, (5, 4), 0.75),
        layers.Words(
            names,
            "frequency",
            "speed",
            _HARMONIC_WORDS,
            reads=("number", "inner"),
            fitting=style.NARROW,
            look={**_ON_PICTURE, **below},
        ),
    ]


_TRIANGLE = {"marker": "triangle", "angle": -0.5 * math.pi, "size": 7, "level": "annotation"}
SCENE: list[layers.Layer] = [
    layers.Glyph(
        Scatter,
        "speed_run_marched",
        ("frequency", "speed"),
        {"fill_color": style.DEFECT, "line_color": None, **_TRIANGLE},
    ),
    *(
        layers.Glyph(HSpan, "speed_run_now", ("speed",), {"line_color": color, "line_width": width})
        for color, width in ((style.SHADE, 3.0), (style.LIGHT, 1.2))
    ),
]
"""Speeds whose motion was integrated in time, and the speed of this scene."""
ALL_LAYERS = [*(layer for dof in SHOWN for layer in expected_layers(dof)), *SCENE]


@dataclass(frozen=True)
class SweptRun:
    """A speed run, and its speeds [Hz] as a sweep of the field `shaft_speed_hz`."""

    run: SpeedRun
    speeds: value_range.Sweep


class SpeedRunSpectra(SceneJobView[SweptRun]):
    """Power spectral density of the housing's acceleration over frequency and shaft speed."""

    name = "speed-run"
    title = "Spectrum over shaft speed"
    about = (
        "Spectrum of the steady vibration at each shaft speed. Speed does not move the bands of "
        "the natural frequencies; where the ball-pass frequency or a harmonic crosses one, "
        "vibration is strong. Vertical: bands. Slanted: ball-pass harmonics. Horizontal: current "
        "speed. Click in the map to go to a speed."
    )
    noun = "run"
    start = "Compute all speeds"
    bounds = f"At most {COUNTS[-1]} speeds; a coarse picture is computed by itself."

    _first_run_began = False

    def build(self, packed: PackedSource) -> Any:
        frequency = packed.range("speed_run_frequency", 0.0, HIGHEST)
        speed = packed.range("speed_run_speed", 0.0, 60.0)
        self._images: dict[str, GridImage] = {}
        sources = layers.sources_of(packed, ALL_LAYERS)
        sides = list(_SIDES.values())
        plots: list[figure] = []
        marks: list[GlyphRenderer] = []
        for dof in SHOWN:
            plot = style.make_figure(
                FREQUENCY,
                _SIDES[SPEED].quantity,
                frequency,
                speed,
                height=HEIGHT,
                name=f"speed_run_drawing_{dof}",
            )
            plot.stylesheets = [":host { cursor: crosshair; }"]
            plot.syncable = False  # the browser alone shows one of them and hides the other
            shown = packed.range(f"speed_run_level_{dof}", -80.0, -20.0)
            name, title = f"speed_run_cells_{dof}", f"S{dof} (dB re 1 (m/s²)²/Hz)"
            self._images[dof] = GridImage(plot, packed, name, shown, sides, _SAY, title)
            marks += layers.add_all(plot, sources, expected_layers(dof))
            layers.add_all(plot, sources, SCENE)
            plots.append(plot)
        along = layers.switch([f"Along {dof}" for dof in SHOWN], plots, active=1)
        box = layers.toggle("Mark bands and ball-pass harmonics", marks, shown=True)
        choices = pn.Row(along, box, margin=0, stylesheets=[style.WRAPPED])
        return [self.only_with_numbers(*plots, choices), self.job]

    # The job

    def fields(self) -> list[FieldSpec]:
        return [
            {"name": "from", "label": "Shaft speed from (Hz)"},
            {"name": "to", "label": "to (Hz)"},
            {"name": "count", "label": "Speeds", "options": [[str(n), str(n)] for n in COUNTS]},
        ]

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        low, high = value_range.usual_range(SPEED, editor.limits)
        return {"from": f"{low:g}", "to": f"{high:g}", "count": "97"}, {}

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        if given["count"] not in map(str, COUNTS):
            counts = ", ".join(map(str, COUNTS[:-1]))
            raise ValueError(f"A run has {counts} or at most {COUNTS[-1]} speeds.")
        speeds = value_range.sweep(
            SPEED, given["from"], given["to"], int(given["count"]), editor.limits
        )
        scene = value_range.focus_first(editor.scene, editor.selected)
        return lambda job: compute(job, scene, speeds)

    # The picture

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        if (answer := self.job_result) is None:
            return {}, {}
        run, speeds = answer.run, answer.speeds
        alpha = FAINT if self._is_of_another_scene(results, answer) else 1.0
        seen = drawn_frequencies(run)
        frequency = run.frequency[seen]
        top = float(frequency[-1])
        level_ranges = {}
        sources: Sources = {}
        for dof in SHOWN:
            level = levels_of(run, dof)[:, seen]
            level_ranges[f"speed_run_level_{dof}"] = level_range(level, frequency)
            sources[f"speed_run_cells_{dof}"] = self._images[dof].columns(
                frequency, speeds.values, level, alpha
            )
            sources[f"speed_run_bands_{dof}"] = bands_along(run.bands, dof, top)
        limits = ends(speeds.values)
        sources |= harmonics(run, speeds, top)
        marched = speeds.values[~run.from_orbit & np.isfinite(run.density).any(axis=(1, 2))]
        sources["speed_run_now"] = {
            "speed": np.array([value_range.value_of(results.scene, speeds.field)])
        }
        sources["speed_run_marched"] = {
            "frequency": np.full(marched.size, 0.006 * top),
            "speed": marched,
        }
        return sources, {
            "speed_run_frequency": (0.0, top),
            "speed_run_speed": limits,
            **level_ranges,
        }

    def _is_of_another_scene(self, results: Results, answer: SweptRun) -> bool:
        """True if a run belongs to another scene than that on screen."""
        scene = value_range.focus_first(results.scene, results.focus)
        return not value_range.differ_only_in(scene, answer.run.scene, (answer.speeds,))

    def sentence(self, results: Results) -> str:
        if self.job_result is None:
            return self.words_of_nothing
        words = words_of(self.job_result)
        if self._is_of_another_scene(results, self.job_result):
            return f"Faint: computed before the scene changed. For the earlier scene: {words}"
        return words

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is None or results.moving or self._first_run_began or self._jobs is None:
            return
        if self.job_result is None and not self._jobs.busy(COMPUTATION):
            self._first_run_began = True
            with contextlib.suppress(ValueError):  # “Compute all speeds” shows the reason
                self.begin({**self.job.values, "count": str(FIRST_COUNT)})

    def columns(self, answer: SweptRun) -> dict[str, np.ndarray]:
        run = answer.run
        orbits = np.repeat(run.from_orbit.astype(int), run.frequency.size)
        return {**run.table().in_units({"rad/s": "Hz"}).named(), "from_orbit": orbits}


def drawn_frequencies(run: SpeedRun) -> NDArray[np.bool_]:
    """Mask of the frequencies that are drawn: more than usual if a band lies higher."""
    return run.frequency <= max(HIGHEST, 1.05 * highest(run.bands))


def words_of(answer: SweptRun) -> str:
    """Say where the housing vibrates most, and how many motions were integrated in time."""
    run, words, seen = answer.run, [], drawn_frequencies(answer.run)
    for dof in SHOWN:
        level = levels_of(run, dof)
        level[:, (run.frequency < 100.0) | ~seen] = np.nan
        if np.isfinite(level).any():
            i, k = np.unravel_index(np.nanargmax(level), level.shape)
            words.append(
                f"along {dof} at {run.frequency[k]:.0f} Hz when the shaft turns at "
                f"{style.number(answer.speeds.values[i])} Hz"
            )
    top = style.with_prefix(float(run.frequency[seen][-1]), "Hz", 2)
    text = f"Up to {top} the loudest vibration is {style.list_words(words)}."
    text = text if words else "Nothing moves."
    marched = int(np.sum(~run.from_orbit))
    if marched:
        text += (
            f" At {marched} of {run.shaft_speed.size} speeds (triangles) no stable orbit was "
            "found; their motion was integrated in time."
        )
    return text


def compute(job: Work, scene: Scene, speeds: value_range.Sweep) -> str:
    """Compute and show a coarse run and then the full one, in a job's thread.

    ValueError if the coarse run cannot be computed.
    """
    n = speeds.values.size
    runs = [speeds] if n <= FIRST_COUNT else [speeds.every((n - 1) // (FIRST_COUNT - 1)), speeds]
    whole = sum(grid.values.size for grid in runs)
    started = time.perf_counter()
    done, shown = 0, "Nothing is shown yet."

    def progress(start: float, share: float, part: float, _: str) -> None:
        job.progress(start + share * part)

    for grid in runs:
        size = grid.values.size
        try:
            run = speed_run(
                scene,
                grid.in_si[1],
                resolution=RESOLUTION,
                progress=partial(progress, done / whole, size / whole),
                cancelled=job.cancelled,
            )
        except FieldError as error:
            if not done or error.field != "shaft_speeds":
                raise
            return f"{shown} A finer run was not begun: speeds must be {error.allowed}."
        if run.completed or not done:
            job.show(SweptRun(run, grid))
            shown = f"{size} speeds after {time.perf_counter() - started:.1f} s."
            if size == FIRST_COUNT:
                shown = f"A coarse picture: {shown} “Compute all speeds” makes it finer."
        if not run.completed:
            break
        done += size
    return shown


def levels_of(run: SpeedRun, dof: str) -> NDArray[np.float64]:
    """Levels (n, m) [dB] along a direction; NaN where it cannot move or was not computed."""
    if dof not in run.dofs:
        return np.full(run.density.shape[:2], np.nan)
    return np.asarray(decibels(run.density[:, :, run.dofs.index(dof)]))


def level_range(level: NDArray[np.float64], frequency: NDArray[np.float64]) -> tuple[float, float]:
    """Ends of the colour scale [dB], from the levels above 100 Hz."""
    levels = level[:, frequency >= 100.0]
    if not np.isfinite(levels).any():
        return -80.0, -20.0
    top = nice_range(float(np.nanmax(levels)) - DEPTH_OF_VIEW, float(np.nanmax(levels)))[1]
    return top - DEPTH_OF_VIEW, top


def harmonics(run: SpeedRun, speeds: value_range.Sweep, top: float) -> Sources:
    """Lines of the ball-pass frequency and its harmonics up to `top` [Hz], with their names.

    A name is placed where its line leaves the picture.
    """
    low, high = ends(speeds.values)
    ratio = float(run.ball_pass_frequency[-1] / speeds.values[-1])
    number = np.arange(1.0, HARMONICS + 1.0)
    last = np.minimum(high, top / (number * ratio))
    drawn = last > low
    number, last = number[drawn], last[drawn]
    first, gap = np.full(number.size, low), np.full(number.size, np.nan)
    places = np.stack([first, last, gap], axis=1)  # of each line along the speeds
    inner = run.scene.defect_turns
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
