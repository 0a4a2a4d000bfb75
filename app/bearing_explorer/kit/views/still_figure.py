"""The figure of a view, drawn once outside the page: for reports, notebooks and scripts."""

from __future__ import annotations

import html
import re
import tempfile
import webbrowser
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Generic

import numpy as np
from bokeh.document import Document
from bokeh.embed import components
from bokeh.events import DocumentReady
from bokeh.models import Column, CustomJS
from bokeh.resources import Resources

from bearing_explorer.kit.plots import printed
from bearing_explorer.kit.serve.packed_source import Columns, PackedSource
from bearing_explorer.kit.views.base import C, View, parts_of
from bearingcore.errors import FieldError

_FOLLOW = """
for (const range of ranges) for (const end of ["start", "end"]) range.properties[end].change.emit()
for (const source of sources) source.properties.data.change.emit()
"""


LEAST_HEIGHT = (200, 500)
"""Least height [px] of a figure, and of one for two columns; on the page, figures fill cards."""


class FilledSources(PackedSource):
    """Sources and ranges that hold their numbers; on the page, numbers are sent to them.

    The browser derives labels with prefixes, pictures and words from the numbers when these change.
    The callback that `fill` returns makes it derive them from the first numbers.
    """

    def fill(
        self, data: Mapping[str, Columns], ranges: Mapping[str, tuple[float, float]]
    ) -> CustomJS:
        """Put numbers into sources and ranges; return a callback for the ready document."""
        blocks = {name: self._block(name, columns) for name, columns in data.items()}
        self._assign(
            {k: dict(zip(self.columns[k], rows, strict=True)) for k, rows in blocks.items()}, ranges
        )
        args = {"sources": list(self._sources.values()), "ranges": list(self._ranges.values())}
        return CustomJS(args=args, code=_FOLLOW)


class Figure(Generic[C]):
    """The figure of a view, filled with the numbers of one scene or signal.

    Attributes
    ----------
    results
        content of the figure; for a scene, its attributes are results of `bearingcore`.
    sentence
        the sentence below the figure.
    layout
        the Bokeh layout of its figures.
    document
        the Bokeh document that holds the layout.

    Parameters
    ----------
    choices
        choices in the view itself, by its fields; its computation is repeated with them.
    prepare
        callback with the new view, before it draws anything.
    job_result
        result of the view's computation, if it is known already.
    computed
        True if a view with a computation makes it when there is no `job_result`.

    Raises
    ------
    ValueError
        with the reason, if the view has no figure for this scene.
    """

    def __init__(
        self,
        kind: type[View[C]],
        results: C,
        *,
        choices: Mapping[str, Any] | None = None,
        prepare: Callable[[View[C]], None] = lambda _: None,
        job_result: Any = None,
        computed: bool = True,
    ) -> None:
        self.results = results
        sources = FilledSources()
        self.view = kind(sources)
        prepare(self.view)
        if job_result is not None:
            self.view.job_result = job_result
        elif choices is not None or (computed and self.view.computes):
            self.view.choose(choices or {}, results)
        data, ranges = self.view.all_data(results)
        self.sentence = self.view.sentence(results)
        self.view.say(results, self.sentence)
        follow = sources.fill(data, ranges)
        for plot in self.view.figures:
            plot.frame_align = False  # otherwise each figure takes the margins of the widest
            least = LEAST_HEIGHT[printed.WIDE in plot.tags]
            plot.min_height = max(plot.min_height or plot.height, least)
        plots = [] if self.view.is_empty else list(self.view.still_figures())
        self.layout = Column(children=plots, sizing_mode="stretch_width")
        # the tags keep those sources from which only pictures and colours are made
        self.layout.tags = [*follow.args["sources"], *follow.args["ranges"]]
        self.document = Document()
        self.document.add_root(self.layout)
        self.document.js_on_event(DocumentReady, follow)

    def table(self) -> dict[str, np.ndarray]:
        """The numbers behind the figure; each name ends with its unit: ``cage_angle_deg``."""
        return self.view.table(self.results)

    def page(self) -> str:
        """A self-contained HTML page with the figure."""
        title = html.escape(self.view.title)
        return (
            f"<!DOCTYPE html>\n<html><head><meta charset='utf-8'><title>{title}</title></head>"
            f"<body>{bokeh_scripts()}{self._place()}</body></html>\n"
        )

    def _place(self) -> str:
        """HTML of the figure: its place, the script that draws it, and its sentence."""
        words = f"<p style='font-family: sans-serif'>{html.escape(self.sentence)}</p>"
        if not self.layout.children:
            return words
        script, place = components(self.layout)
        return f"{place}{script}{words}"

    def save(self, path: str | Path, width: float | None = None) -> None:
        """Write the figure to a file in the format of its suffix.

        .html is `page`. .svg, .pdf and .png are for paper: Matplotlib draws them `width` [mm] wide.
        None stands for a column of 88 mm, or 180 mm for the matrix of stiffness.

        Raises
        ------
        ValueError
            for another suffix, for a width beyond 30 to 500 mm, and for a view without a figure.
        ImportError
            for paper, if ``pip install "bearing-explorer[figures]"`` was not run.
        """
        path = Path(path)
        if path.suffix.lower() == ".html":
            path.write_text(self.page(), encoding="utf-8")
            return
        allowed = (".html", *printed.SUFFIXES)
        if path.suffix.lower() not in allowed:
            raise FieldError("suffix of path", path.suffix, ", ".join(allowed))
        if width is not None and not 30.0 <= width <= 500.0:
            raise FieldError("width", width, "30 to 500 mm", "mm")
        if not self.layout.children:
            raise FieldError(
                "suffix of path", path.suffix, f".html: {self.view.name} has no figure"
            )
        caption = self.results.in_words(self.view.caption(self.results))
        # nobody can click on paper
        note, _ = parts_of(re.sub(r"Click[^.]*\. ?", "", caption), key_alone=False)
        printed.print_figures(self.document, note, path, width)

    def show(self) -> None:
        """Open the figure in the browser; print the path of its file if no browser opens."""
        with tempfile.NamedTemporaryFile(
            "w", suffix=f"-{self.view.name}.html", delete=False, encoding="utf-8"
        ) as file:
            file.write(self.page())
        if not webbrowser.open(Path(file.name).as_uri()):
            print(file.name)

    def _repr_html_(self) -> str:
        """HTML for a notebook; the first figure has the scripts of Bokeh with it."""
        return _bokeh_once() + self._place()


_has_bokeh = False
_BOKEH = Resources(mode="inline", components=["bokeh"])


def _bokeh_once() -> str:
    global _has_bokeh
    first, _has_bokeh = not _has_bokeh, True
    return bokeh_scripts() if first else ""


def bokeh_scripts() -> str:
    """Scripts of Bokeh itself, without those of extensions."""
    return "".join(f"<script>{code}</script>" for code in _BOKEH.js_raw)
