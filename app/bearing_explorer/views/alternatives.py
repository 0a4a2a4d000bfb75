"""Simpler models of the scene: their errors and run times."""

from __future__ import annotations

import html
import math
import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import panel as pn

from bearing_explorer.assets import asset_text
from bearing_explorer.plots import style
from bearing_explorer.results import compiling
from bearing_explorer.results.jobs import Work
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.views.job_view import JobView
from bearingcore.common.numbers import decibels, percent
from bearingcore.experiments.alternatives import SPECTRUM, Alternative, Alternatives, alternatives

HEADS = ("Model", "Error", "of the", "Time", "Scene's own", "Remark")

GOOD_ENOUGH = {True: 0.5, False: 0.01}
"""Errors up to which a model will do: of spectra [dB], and of curves over their swing."""


class OtherModels(JobView[Alternatives]):
    """Errors and run times with fewer directions, other balls, orbits, steps and cage angles."""

    name = "alternatives"
    title = "Would a simpler model do?"
    about = (
        "Other models against the scene's own, each computed. Errors of stiffness hold at 99 % "
        "of the cage angles; those of spectra up to 1.25 times the highest natural frequency."
    )
    needs = frozenset[str]()
    start = "Compare simpler models"
    bounds = "A quarter of a second of motion in several models; it takes about a second."

    def build(self, packed: PackedSource) -> Any:
        whole = {"sizing_mode": "stretch_width", "margin": 0}
        self._table = pn.pane.HTML("", stylesheets=[asset_text("alternatives.css")], **whole)
        return pn.Column(self.job, self._table, **whole)

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        scene = editor.scene

        def compute(job: Work) -> str:
            if not compiling.ready():
                raise compiling.StillCompiling
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
        words = "No other model comes close enough"
        if enough:
            words = f"Within 0.5 dB or 1 % of the swing: {style.list_words(enough)}"
        if self.found.scene != results.scene:
            words += ". Computed for an earlier scene"
        return f"{words}."

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if self.found is not None:
            self._table.object = table_of_rows(self.found.rows)

    def columns(self, found: Alternatives) -> dict[str, np.ndarray]:
        return found.table().named()


def table_of_rows(rows: tuple[Alternative, ...]) -> str:
    """Models as an HTML table."""
    heads = "".join(f'<th scope="col">{head}</th>' for head in HEADS)
    body = "".join(_row(row) for row in rows)
    return f"<table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>"


def _row(row: Alternative) -> str:
    cells = (
        error_words(row),
        row.quantity,
        _seconds(row.seconds),
        _seconds(row.own_seconds),
        row.note,
    )
    rest = "".join(f"<td>{html.escape(cell)}</td>" for cell in cells)
    return f'<tr><th scope="row">{html.escape(row.name)}</th>{rest}</tr>'


def error_words(row: Alternative) -> str:
    """An error with its unit."""
    if not math.isfinite(row.error):
        return "not known"
    return decibels(row.error) if row.quantity == SPECTRUM else percent(row.error, 2)


def _seconds(seconds: float) -> str:
    return style.with_prefix(seconds, "s") if math.isfinite(seconds) else ""
