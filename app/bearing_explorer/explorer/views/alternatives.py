"""Simpler models of the scene: their errors and run times."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import panel as pn

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.scene_job_view import SceneJobView
from bearing_explorer.explorer.views.work_precision import ALLOWED
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.jobs import Work
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.widgets.facts import html_table, html_text
from bearing_explorer.kit.widgets.form import Fields, button, choices, row, select
from bearingcore.common import decibels, percent
from bearingcore.experiments import SPECTRUM, Alternative, Alternatives, alternatives

HEADS = ("Model", "Error", "of the", "Time", "Saves", "Remark")

GOOD_ENOUGH = {True: ALLOWED["dB"], False: ALLOWED["1"]}
"""Errors up to which a model will do: of spectra [dB], and of curves over their swing."""


class OtherModels(SceneJobView[Alternatives]):
    """Errors and run times with fewer directions, other edges, balls, orbits, steps and angles."""

    name = "alternatives"
    title = "Would a simpler model do here?"
    about = (
        "Other models against the scene's own, each computed. Errors of stiffness hold at 99 % "
        "of the cage angles; those of spectra up to 1.25 times the highest natural frequency."
    )
    start = "Compare simpler models"
    bounds = "A quarter of a second of motion in several models; it takes about a second."

    def build(self, packed: PackedSource) -> Any:
        self._table = pn.pane.HTML(
            "", stylesheets=[asset_text("alternatives.css")], sizing_mode="stretch_width", margin=0
        )
        self._models = Fields(lambda _: None)
        self._models.add("model", select("Model", [["", "none"]]))
        take = button("Take it", lambda: self._use(self._models.values["model"]))
        self._taking = row(self._models.widgets["model"], take, visible=False)
        return [self.job, self._table, self._taking]

    def _use(self, name: str) -> None:
        """Change the scene to that of the model with this name."""
        if self.parts is None or self.found is None:
            return
        for one in takeable(self.found.rows):
            if one.name == name:
                words = {k: " ".join(v) if k == "dofs" else v for k, v in one.changes.items()}
                self.parts.change_scene({"choose": words})

    def _offer(self, rows: Sequence[Alternative]) -> None:
        """Fill the list of what can be taken."""
        names = [one.name for one in takeable(rows)]
        chosen = self._models.values["model"]
        self._models.values["model"] = chosen = chosen if chosen in names else "".join(names[:1])
        options = choices([[name, name] for name in names])
        self._models.widgets["model"].param.update(**options, value=chosen)
        self._taking.visible = bool(names)

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        scene = editor.scene

        def compute(job: Work) -> str:
            compiling.need(compiling.BALLS_WITH_MASS)
            began = time.perf_counter()
            found = alternatives(scene, job.cancelled)
            job.show(found)
            return f"{len(found.rows)} models after {time.perf_counter() - began:.1f} s."

        return compute

    def sentence(self, results: Results) -> str:
        if self.found is None:
            return (
                f"Drawn are {results.settings.n_cage_angles} cage angles a ball spacing and "
                f"{results.settings.duration:g} s of motion, whatever the scene."
            )
        enough = [
            row.name
            for row in self.found.rows
            if row.error <= GOOD_ENOUGH[row.quantity == SPECTRUM]
        ]
        words = "No other model is within 0.1 dB or 1 % of the swing"
        if enough:
            words = f"Within 0.1 dB or 1 % of the swing: {style.list_words(enough)}"
        if self.found.scene != results.scene:
            words += ". Computed for an earlier scene"
        return f"{words}."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if self.found is not None:
            self._table.object = table_of_rows(self.found.rows)
            self._offer(self.found.rows)

    def columns(self, found: Alternatives) -> dict[str, np.ndarray]:
        return found.table().named()


def takeable(rows: Sequence[Alternative]) -> list[Alternative]:
    """The models that a scene can have, each once."""
    known = {one.name: one for one in rows if one.changes and math.isfinite(one.error)}
    return list(known.values())


def table_of_rows(rows: tuple[Alternative, ...]) -> str:
    """Models as an HTML table."""
    cells = (
        (
            one.name,
            error_words(one),
            one.quantity,
            _seconds(one.seconds),
            saved_words(one),
            one.note,
        )
        for one in rows
    )
    return html_table(HEADS, ([html_text(cell) for cell in row] for row in cells), named=True)


def saved_words(row: Alternative) -> str:
    """Time that a model saves, or costs more than the scene's own."""
    if not math.isfinite(row.saved):
        return ""
    size = style.with_prefix(abs(row.saved), "s")
    return size if row.saved >= 0.0 else f"costs {size} more"


def error_words(row: Alternative) -> str:
    """An error with its unit."""
    if not math.isfinite(row.error):
        return "not known"
    return decibels(row.error) if row.quantity == SPECTRUM else percent(row.error, 2)


def _seconds(seconds: float) -> str:
    return style.with_prefix(seconds, "s") if math.isfinite(seconds) else ""
