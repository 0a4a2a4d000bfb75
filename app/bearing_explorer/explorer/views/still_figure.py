"""A view of one scene made once, outside of the page: for reports, notebooks and scripts."""

from __future__ import annotations

import dataclasses
import html
import tempfile
import webbrowser
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from bokeh.document import Document
from bokeh.embed import components
from bokeh.events import DocumentReady
from bokeh.models import Column, CustomJS
from bokeh.resources import Resources

from bearing_explorer.diagnosis.machine import BY_FREQUENCIES, GIVEN, Machine, of_scene
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.explorer.results.endurance import LifeInputs
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.compared import Compared
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.state.settings import Settings
from bearing_explorer.kit.serve.packed_source import Columns, PackedSource
from bearingcore.common import checks

if TYPE_CHECKING:
    from bearing_explorer.kit.views.base import View
    from bearingcore import Recording, Scene

BEARINGS = (GIVEN, BY_FREQUENCIES, "unknown")
"""Knowledge of the bearing of a recording."""

_FOLLOW = """
for (const range of ranges) for (const end of ["start", "end"]) range.properties[end].change.emit()
for (const source of sources) source.properties.data.change.emit()
"""


class FilledSources(PackedSource):
    """Sources and ranges that hold their numbers, where those of the page are sent them.

    Labels with prefixes, pictures and words are derived from them in the browser, after changes;
    the callback that `fill` returns derives them from the first numbers.
    """

    def fill(
        self, data: Mapping[str, Columns], ranges: Mapping[str, tuple[float, float]]
    ) -> CustomJS:
        """Put numbers into sources and ranges; returns a callback for the ready browser."""
        for name, columns in data.items():
            self._block(name, columns)  # refuses what does not fit
            rows = {column: np.asarray(v, np.float32).ravel() for column, v in columns.items()}
            self._sources[name].data = rows
        for name, (start, end) in ranges.items():
            self._ranges[name].update(start=start, end=end, reset_start=start, reset_end=end)
        args = {"sources": list(self._sources.values()), "ranges": list(self._ranges.values())}
        return CustomJS(args=args, code=_FOLLOW)


class Figure:
    """A view with the numbers of one scene in it.

    Attributes
    ----------
    results
        everything that is known about the scene; its attributes are results of `bearingcore`.
    sentence
        the sentence on the figure.
    layout
        the Bokeh layout of its figures.
    document
        the Bokeh document that holds the layout.

    Parameters
    ----------
    choices
        choices in the view itself, by its fields: computations are made anew with them.
    recording
        the signal that was measured, for views of a measurement, on the bearing and at the speed
        of the scene.
    in_si
        whether its numbers are in m/s².
    speed
        knowledge of the shaft speed: "given" (that of the scene), "rough" (good to 10 %),
        "unknown", or another one [rad/s].
    bearing
        knowledge of the bearing: "given" (that of the scene), "frequencies" (the scene has the
        frequencies of its parts alone), or "unknown".
    measurement
        of a session, in place of a recording.
    found
        the result of the computation of the view, where that is known already.
    computed
        whether a view of a computation without `found` makes it.

    Raises
    ------
    ValueError
        where there is no such figure for this scene, with the reason.
    """

    def __init__(
        self,
        kind: type[View],
        results: Results,
        *,
        choices: Mapping[str, Any] | None = None,
        recording: Recording | None = None,
        in_si: bool = True,
        speed: str | float = GIVEN,
        bearing: str = GIVEN,
        measurement: Measurement | None = None,
        found: Any = None,
        computed: bool = True,
    ) -> None:
        self.results = results
        sources = FilledSources()
        self.view = kind(sources)
        if recording is not None:
            machine = of_scene(results.scene, GIVEN).knowing(speed)
            if checks.choice("bearing", bearing, BEARINGS) == "unknown":
                machine = dataclasses.replace(machine, bearing=None)
            machine = dataclasses.replace(machine, by_frequencies=bearing == BY_FREQUENCIES)
            measurement = _measurement(recording, machine, in_si)
        if measurement is not None:
            self.view.take_measurement(measurement)
        if found is not None:
            self.view.found = found
        elif choices is not None or (computed and self.view.computes):
            self.view.choose(choices or {}, results)
        data, ranges = self.view.all_data(results)
        self.sentence = self.view.sentence(results)
        self.view.say(results, self.sentence)
        follow = sources.fill(data, ranges)
        for plot in self.view.figures:
            plot.frame_align = False  # or all would leave as much room as the one that needs most
        plots = [] if self.view.is_empty else list(self.view.still_figures())
        self.layout = Column(children=plots, sizing_mode="stretch_width")
        self.document = Document()
        self.document.add_root(self.layout)
        self.document.js_on_event(DocumentReady, follow)

    def table(self) -> dict[str, np.ndarray]:
        """The numbers behind the figure; a name says its unit: ``cage_angle_deg``."""
        return self.view.table(self.results)

    def page(self) -> str:
        """A page with the figure that needs nothing from outside."""
        title = html.escape(self.view.title)
        return (
            f"<!DOCTYPE html>\n<html><head><meta charset='utf-8'><title>{title}</title></head>"
            f"<body>{bokeh_scripts()}{self._place()}</body></html>\n"
        )

    def _place(self) -> str:
        """Where the figure goes, the script that draws it, and its sentence."""
        words = f"<p style='font-family: sans-serif'>{html.escape(self.sentence)}</p>"
        if not self.layout.children:
            return words
        script, place = components(self.layout)
        return f"{place}{script}{words}"

    def save(self, path: str | Path) -> None:
        """Write `page` to a file."""
        Path(path).write_text(self.page(), encoding="utf-8")

    def show(self) -> None:
        """Open the figure in the browser; where there is none, its path is printed."""
        with tempfile.NamedTemporaryFile(
            "w", suffix=f"-{self.view.name}.html", delete=False, encoding="utf-8"
        ) as file:
            file.write(self.page())
        if not webbrowser.open(Path(file.name).as_uri()):
            print(file.name)

    def _repr_html_(self) -> str:
        """In a notebook; Bokeh itself comes with the first figure."""
        return _bokeh_once() + self._place()


def figure_of(
    kind: type[View],
    scene: Scene,
    *,
    cage_angle: float = 0.0,
    focus: int = 0,
    compared: Mapping[str, Scene] | None = None,
    before: Scene | None = None,
    settings: Mapping[str, Any] | None = None,
    endurance: Mapping[str, Any] | None = None,
    **more: Any,
) -> Figure:
    """The figure of a view for a scene.

    Parameters
    ----------
    cage_angle
        [rad] shown.
    focus
        number of the defect that is looked at.
    compared
        further scenes that are drawn, by their names.
    before
        the scene before the last change, for the view of the last change.
    settings, endurance
        fields of `Settings` (how finely it is computed) and of steel, oil and surfaces.
    more
        further parameters of `Figure`.
    """
    results = Results(
        scene,
        cage_angle,
        Settings(**(settings or {})),
        focus,
        compared=[Compared(one, name) for name, one in (compared or {}).items()],
        before=before,
        life_inputs=LifeInputs(**(endurance or {})),
    )
    return Figure(kind, results, **more)


def editor_of(results: Results) -> SceneEditor:
    """The controls as they are for a scene."""
    editor = SceneEditor("fan-rig")
    editor.take_scene(results.scene, selected=results.focus)
    return editor


def _measurement(recording: Recording, machine: Machine, in_si: bool) -> Measurement:
    """A measurement that is there already."""

    async def assign(change: Any) -> None:
        change()

    made = Measurement(SceneEditor("fan-rig"), assign, lambda: None)
    bare = dataclasses.replace(recording, shaft_speed=None)
    made.measured = Measured(bare, machine, in_si=in_si)
    return made


_has_bokeh = False
_BOKEH = Resources(mode="inline", components=["bokeh"])


def _bokeh_once() -> str:
    global _has_bokeh
    first, _has_bokeh = not _has_bokeh, True
    return bokeh_scripts() if first else ""


def bokeh_scripts() -> str:
    """Bokeh itself, without the scripts of extensions."""
    return "".join(f"<script>{code}</script>" for code in _BOKEH.js_raw)
