"""Figures of the paper: printed values against ours, and the live tab that draws each."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.address import Place, write
from bearing_explorer.explorer.views.paper_figures import FIGURES, PaperFigure
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.widgets.facts import facts_pane, html_table
from bearing_explorer.kit.widgets.form import button, row
from bearingcore import Scene, presets

TAB_TITLES = {
    "load": "Load",
    "stiffness": "Stiffness",
    "maps": "Stiffness, Maps",
    "modes": "Frequencies",
    "vibration": "Vibration",
    "model": "Machine, Rotor and support",
}
"""Titles of the tabs that show the figures live."""

SIZED = presets["fan-rig"].replace(extent=math.radians(38.6))
"""The scene of Section 4, "Defect size estimation": entry and exit alone suggest 12.9°."""
NOISE = "20"
"""Noise of its simulated signal, a name in `NOISES`."""


class PaperFigures(View[Results]):
    """The numbers of one figure of the paper, with a button for each figure."""

    name = "paper"
    title = "Figures of the paper in numbers"
    about = (
        "What the paper prints, and what is computed here. Figures 3 to 10 of Petersen, Howard and "
        "Prime (2014). The scene stays as it is until you open a figure or Section 4. Section 4 "
        "simulates the signal of a spall and finds its length on the Diagnosis tab."
    )
    computes = True

    def build(self, packed: PackedSource) -> Any:
        self._figure = FIGURES[0]
        self._buttons = {
            figure.number: button(f"Figure {figure.number}", partial(self._show, figure))
            for figure in FIGURES
        }
        self._live = button("Open it", self._open_live, css_classes=["main"])
        self._numbers = facts_pane(sizing_mode="stretch_width")
        size = button("Section 4: size a defect", self._size_a_defect)
        return [row(*self._buttons.values(), self._live, size), self._numbers]

    def _show(self, figure: PaperFigure) -> None:
        """Show the numbers of a figure; the scene of the sliders stays."""
        self._figure = figure
        if self.parts is not None:
            self.parts.draw()

    def _open_live(self) -> None:
        """Open the tab that draws the figure, with its other scenes for comparison."""
        figure = self._figure
        if self.parts is not None:
            self.parts.open_link(f"Figure {figure.number}", figure.link)

    def _size_a_defect(self) -> None:
        """Simulate a signal of the defect of Section 4; Diagnosis finds its length."""
        if self.parts is not None:
            place = Place(SIZED, "fan-rig", tab="diagnosis")
            self.parts.open_link("Section 4", write(place))
            self.parts.simulate(NOISE)

    def choices(self) -> dict[str, Any]:
        return {"figure": self._figure.number}

    def choose(self, choices: Mapping[str, Any], results: Results) -> None:
        numbers = {figure.number: figure for figure in FIGURES}
        number = choices.get("figure", FIGURES[0].number)
        if number not in numbers:
            raise ValueError(f"figure is {number!r}; it can be {', '.join(map(str, numbers))}")
        self._figure = numbers[number]

    def scene_drawn(self, results: Results) -> Scene:
        return self._figure.scenes[-1]

    def sentence(self, results: Results) -> str:
        figure = self._figure
        _ = figure.rows  # computed here, in a thread
        bearing = "Liew and Lim's bearing" if figure.preset == "liew-lim" else "the fan rig"
        return (
            f"Figure {figure.number}, {figure.title.lower()}, shows {bearing}, whatever the "
            f"sliders say; the tab {TAB_TITLES[figure.tab]} draws it."
        )

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        figure = self._figure
        rows = ([_symbols(name), html.escape(a), html.escape(b)] for name, a, b in figure.rows)
        slip = f"<p><b>Errors in the paper.</b> {_symbols(figure.slip)}</p>" if figure.slip else ""
        self._numbers.object = html_table(("", "Paper", "Here"), rows, named=True) + slip
        self._live.label = f"Open it on the tab {TAB_TITLES[figure.tab]}"
        for number, widget in self._buttons.items():
            widget.css_classes = ["main"] if number == figure.number else []

    def table(self, results: Results) -> dict[str, np.ndarray]:
        names, paper, here = zip(*self._figure.rows, strict=True)
        return {"number": np.array(names), "paper": np.array(paper), "here": np.array(here)}


def _symbols(words: str) -> str:
    """Words as HTML; the part after "_" becomes a subscript."""
    return re.sub(r"_(\w+)", r"<sub>\1</sub>", html.escape(words))
