"""A view: figures made once, numbers pushed through the packed source, one live sentence.

A view never computes physics. It lists in `needs` the attributes that it reads of its results, the
content of its half. Only those are computed, and only while the view is on screen.

To write one, subclass `View`, set the class attributes (the key of `about`, sentences such as
“Grey: ...”, is seen above the figure; all else opens behind "?"), and give it

- `build(packed)`: make figures, sources and ranges, once, and return what goes on the page;
- `data(results)`: numbers to send, ``({source: {column: array}}, {range: (start, end)})``; pure;
  sources of the view that it leaves out are empty;
- `sentence(results)`: plain words on the figure; the first sentence is seen below it, and all
  others open behind "?";
- `table(results)`: the numbers behind the figure, units in the names, for the CSV file;
- `show(results)`, if something in the view is not in the packed source.

On the page, `parts` is the half of the session to which the view belongs, with the scene of the
controls or the measured signal. A view gets it by `attach(parts)`, before anything else.

`data`, `sentence` and `table` may run in a worker thread: they touch no model.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np
import panel as pn
import param
from bokeh.models import LayoutDOM, Plot

from bearing_explorer.kit.assets import asset_path, asset_text, scripts
from bearing_explorer.kit.compute.jobs import Jobs
from bearing_explorer.kit.plots.zoom import make_zoomable
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.serve.panel_internals import LiveComponent
from bearing_explorer.kit.views.content import Content
from bearing_explorer.kit.views.python_lines import code_of, figure_lines
from bearing_explorer.kit.widgets.facts import sentence_html, table_to_read
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, stack
from bearingcore import Scene
from bearingcore.common import as_csv

#: {source: {column: array}}
Sources = dict[str, dict[str, np.ndarray]]
#: {range: (start, end)}
Ranges = dict[str, tuple[float, float]]

ANSWER = "answer"
"""Tag of the parts of a figure that a veil hides while it leaves the others (page.js)."""


class Caption(LiveComponent):
    """Head of a view: its title, its content in a line, and a menu for exports."""

    title = param.String()
    #: words on its content, and the rest of them, which opens on a click
    line = param.String()
    rest = param.String()
    #: name of saved files, behind "bearing-"
    name_of_files = param.String()
    #: subject of its numbers, for names of files and beneath pictures; empty for the scene
    subject = param.String()
    #: True if the view draws an SVG of the class "picture" by itself
    picture = param.Boolean(default=False)
    #: ids of the models of Bokeh's figures in the view, for pictures
    figures = param.List(default=[])
    #: name, left, right, bottom and top of the cells that it enlarges one by one
    cells = param.List(default=[])
    #: HTML above each of them; empty strings for nothing
    cell_lines = param.List(default=[])
    #: True for a small card; its title leads to the tab `leads_to`
    compact = param.Boolean(default=False)
    leads_to = param.String()
    #: what that tab shows in addition
    lead = param.String()

    #: True while there are no numbers to save
    empty = param.Boolean(default=False)
    #: True while there is nothing to save, not even lines of Python
    nothing = param.Boolean(default=False)

    _esm = scripts("element.js", "figure_export.js", "enlarge.js", "caption.html", "caption.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("menu.css"), asset_text("caption.css")]


class Sentence(LiveComponent):
    """One live sentence: HTML that screen readers announce, set without a layout pass."""

    text = param.String()

    _esm = asset_path("sentence.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("sentence.css")]


class SessionParts(Protocol):
    """The parts that each half of a session gives to its views."""

    jobs: Jobs
    """The background jobs of the session."""

    def draw(self) -> None:
        """Draw the views on screen anew."""


C = TypeVar("C", bound=Content)


FADED = "0.2"
"""Opacity of a picture of an earlier scene."""


class View(Generic[C]):
    """One picture of the content. The head of this module lists the parts of a subclass."""

    name: ClassVar[str]
    title: ClassVar[str]
    about: ClassVar[str] = ""
    needs: frozenset[str] = frozenset()
    #: True if it draws an SVG of the class "picture" by itself instead of Bokeh's figures
    picture: ClassVar[bool] = False
    #: True if it is drawn only once the slider rests, and does not follow a drag
    at_rest: ClassVar[bool] = False
    #: True for a small card of the overview; `leads_to` is the tab that shows it in full
    compact: ClassVar[bool] = False
    #: True if only the key and one sentence are seen of the words on a figure
    is_brief: ClassVar[bool] = True
    #: "unseen": for screen readers alone
    sentence_looks: ClassVar[tuple[str, ...]] = ()
    leads_to: ClassVar[str] = ""
    lead: ClassVar[str] = ""
    #: name and sides of the cells of its drawing, one of which at a time can fill the screen
    cells: ClassVar[Sequence[tuple[str, float, float, float, float]]] = ()
    #: the half of the session, on the page alone
    parts: Any = None
    #: result of a job of the view
    job_result: Any = None
    #: True if `choose` computes the content of the view
    computes: ClassVar[bool] = False

    def __init__(self, packed: PackedSource) -> None:
        self._results: C | None = None
        self._has_drawn = False
        self._looks: tuple[bool, bool] | None = None  # as `say` last set them
        #: keys of the newest content, and of the last picture
        self._key: object = None
        self._drawn_key: object = None
        self._sentence = Sentence(css_classes=["sentence", *self.sentence_looks])
        #: parts of the content that are hidden without numbers
        self._pictures: list[pn.Column] = []
        self._withheld: list[tuple[pn.Column, list[pn.viewable.Viewable]]] = []
        others = set(packed.columns)
        body = self.build(packed)
        #: its sources without numbers
        self._empty: Sources = {
            name: dict.fromkeys(columns, np.zeros(0))
            for name, columns in packed.columns.items()
            if name not in others
        }
        body = stack(*body) if isinstance(body, list) else pn.panel(body, margin=0)
        #: Bokeh's figures, in the order of the page
        self.figures = [
            plot
            for pane in body.select(_holds_figures)
            for plot in figures_in(getattr(pane.object, "state", pane.object))
        ]
        if self.figures and _only_figures(body):
            # Panel resets the visibility of a figure's own pane, but not of a layout around it
            body = body if isinstance(body, pn.Column) else stack(body)
            self._pictures.append(body)
        if not self.needs:
            for picture in self._pictures:
                self.withhold(picture)
        self._caption = Caption(
            title=self.title,
            name_of_files=self.name,
            figures=[plot.id for plot in self.figures],
            picture=self.picture,
            cells=[list(cell) for cell in self.cells],
            compact=self.compact,
            leads_to=self.leads_to,
            lead=self.lead,
        )
        #: how to read the figure, and further sentences on it as it was last at rest
        self._rest, self._others = "", ""
        self._put_words(self.caption())
        self._caption.on_msg(self._answer)
        for plot in self.figures:
            make_zoomable(plot)
            plot.syncable = False  # the server does not need the size of a figure
        self.panel: pn.viewable.Viewable = stack(
            self._caption,
            body,
            self._sentence,
            css_classes=["view", f"view-{self.name}", *(["compact"] if self.compact else [])],
            stylesheets=[asset_text("view.css")],
            **({"sizing_mode": "stretch_both"} if self.compact else {}),
        )

    def attach(self, parts: SessionParts) -> None:
        """Take the half of the session; called once, before the view is first on screen."""
        self.parts = parts

    def build(self, packed: PackedSource) -> Any:
        """Make the figures, once; return one of them, a layout, or a list of parts to stack."""
        raise NotImplementedError

    def only_with_numbers(self, *parts: Any, **params: Any) -> pn.Column:
        """Stack parts that are hidden while there are no numbers; for `build`.

        A view that has only figures hides them by itself.
        """
        self._pictures.append(stack(*parts, stylesheets=[AS_HIGH_AS_SHOWN], **params))
        return self._pictures[-1]

    def withhold(self, hidden: pn.Column) -> None:
        """Take the parts out of a hidden layout until `bring`, so that no browser builds them."""
        self._withheld.append((hidden, list(hidden.objects)))
        hidden.objects = []

    def bring(self) -> None:
        """Put the withheld parts back into their layouts. On the event loop only."""
        for hidden, content in self._withheld:
            hidden.objects = content
        self._withheld = []

    def data(self, results: C) -> tuple[Sources, Ranges]:
        """Return sources and ranges for these results; none if the packed source has none."""
        return {}, {}

    def all_data(self, results: C) -> tuple[Sources, Ranges]:
        """Return `data` with all sources of the view."""
        sources, ranges = self.data(results)
        return {**self._empty, **sources}, ranges

    def sentence(self, results: C) -> str:
        """One sentence on the current figure, numbers with units."""
        raise NotImplementedError

    def table(self, results: C) -> dict[str, np.ndarray]:
        """The numbers behind the figure; a name says its unit: ``cage_angle_deg``."""
        raise NotImplementedError

    def say(self, results: C | None, sentence: str) -> None:
        """Show the sentence and keep the results for the table. On the event loop only.

        Without results, the last ones and the last picture stay, and the picture is faded. Before
        the first picture of a `Content.picture_key`, and in a picture without numbers, the sentence
        is shown instead of empty axes.
        """
        self._results = results or self._results
        if results is not None:
            self._has_drawn, self._drawn_key = not self.is_empty, self._key
        elif self._drawn_key != self._key:
            self._has_drawn, self._results = False, None
        if self._has_drawn:
            self.bring()
        looks = self._has_drawn, results is not None
        if self._pictures and looks != self._looks:  # setting these takes a twentieth of a step
            self._looks = looks
            for picture in self._pictures:
                picture.visible = self._has_drawn
                opacity = FADED if results is None else "1"
                if picture.styles.get("opacity", "1") != opacity:  # Bokeh removes no styles
                    picture.styles = picture.styles | {"opacity": opacity}
            classes = self.sentence_looks if self._has_drawn else ()
            self._sentence.css_classes = ["sentence", *classes]
            # hidden figures are not to be saved
            shown = [plot.id for plot in self.figures] if self._has_drawn else []
            self._caption.put(figures=shown)
        # the first sentence on a figure is seen, and all others open on a click
        brief = self.is_brief and self._has_drawn and results is not None and self.figures
        first, *others = _sentences(sentence) if brief else [sentence]
        self._sentence.put(text=sentence_html(first))
        if results is None or not results.moving:
            self._others = " ".join(others)
            self._put_rest()
        self._caption.put(
            empty=self._results is None or self.is_empty, nothing=self._results is None
        )
        if results is not None:
            if self.cells and not results.moving:
                lines = [sentence_html(line) for line in self.cell_lines(results)]
                self._caption.put(cell_lines=lines)
            self.show(results)

    def cell_lines(self, content: C) -> list[str]:
        """Return a sentence for each of `cells`, for when it is enlarged; none by default."""
        return []

    def show(self, content: C) -> None:
        """Show the parts of content that the packed source lacks. On the event loop only."""

    def put_head(self, content: C) -> None:
        """Show title and caption in the words for the content's bearing."""
        self._key = content.picture_key
        self._caption.put(title=content.in_words(self.title_of(content)))
        self._put_words(content.in_words(self.caption(content)))

    def _put_words(self, caption: str) -> None:
        line, self._rest = parts_of(caption, key_alone=self.is_brief and bool(self.figures))
        self._caption.put(line=line)
        self._put_rest()

    def _put_rest(self) -> None:
        words = f"{self._others} {self._rest}".strip()
        self._caption.put(rest=words if self.compact else sentence_html(words))

    def title_of(self, content: C) -> str:
        """Return the title over this content."""
        return self.title

    @classmethod
    def caption(cls, content: C | None = None) -> str:
        """Return the text above the figure of this content; without content, the usual text."""
        return cls.about

    def put_away(self) -> None:
        """Drop the results of a view that is off screen: a motion alone has megabytes."""
        self._results = None

    def end(self) -> None:
        """Cancel timers: the session is over."""

    @property
    def is_empty(self) -> bool:
        """True if there are no numbers behind the figure, as before the first result of a job."""
        return False

    def csv(self) -> str:
        """Return the table of the current figure as CSV; empty before the first figure."""
        return "" if self._results is None else as_csv(self.table(self._results))

    def python(self) -> str:
        """Return lines of Python that make the current figure; empty before the first figure."""
        return "" if self._results is None else self.lines_of_python(self._results)

    # Outside of the page: see `views.still_figure`

    def scene_drawn(self, results: C) -> Scene:
        """Return the drawn scene; the result of a job may be of an earlier scene."""
        return results.scene_drawn()

    def arguments(self, results: C) -> Mapping[str, str]:
        """Return the arguments of the figure of these results, as expressions of Python."""
        return results.arguments(self.needs)

    def lines_of_python(self, results: C) -> str:
        """Write lines of Python that make the scene, its figure, and the numbers of the figure."""
        choices = self.choices()
        chosen = {"choices": code_of(choices)} if choices else {}
        return figure_lines(
            self.scene_drawn(results),
            self.lines_before(),
            self.name,
            {**self.arguments(results), **chosen, **self.more_arguments()},
            has_numbers=bool(choices) or not self.is_empty,
            is_shown=bool(self.figures) or self.computes,
        )

    def choices(self) -> dict[str, Any]:
        """Return the choices made in the view itself, as plain values, for `choose`."""
        return {}

    def choose(self, choices: Mapping[str, Any], results: C) -> None:
        """Take `choices`, and compute as the page does when they are made."""

    def lines_before(self) -> list[str]:
        """Return lines of Python to put between the scene and the figure."""
        return []

    def more_arguments(self) -> dict[str, str]:
        """Return further arguments of the figure, as expressions that use `lines_before`."""
        return {}

    def still_figures(self) -> Sequence[LayoutDOM]:
        """Bokeh's figures, once `data` is in them."""
        return self.figures

    def _answer(self, event: Any) -> None:
        """Send the browser the text that it asks for."""
        if event.data == "csv":
            self._caption.send({"csv": self.csv()})
        if event.data == "table":
            columns = {} if self._results is None else self.table(self._results)
            table, count = table_to_read(columns)
            self._caption.send({"table": table, "count": count})
        if event.data == "python":
            self._caption.send({"python": self.python()})


def _holds_figures(part: Any) -> bool:
    """Return True if a part shows figures, of Bokeh or of HoloViews."""
    return isinstance(part, pn.pane.Bokeh | pn.pane.HoloViews)


def _only_figures(body: pn.viewable.Viewable) -> bool:
    """Return True if a layout has only figures: nothing to choose or to press."""
    leaves = [part for part in body.select() if not isinstance(part, pn.layout.ListPanel)]
    return all(isinstance(part, pn.pane.Bokeh) for part in leaves)


_IS_KEY = re.compile(r"[A-Z][^:.]{0,26}: ")


def _sentences(text: str) -> list[str]:
    """Split a text into sentences; one that begins with a number stays with the previous one."""
    return re.split(r"(?<=[.!?])\s+(?=\D)", text)


def parts_of(text: str, *, key_alone: bool) -> tuple[str, str]:
    """Split a caption into the part that is seen and the part that opens on a click.

    The seen part is the key, sentences such as “Shaded: the defect.”, and the first sentence unless
    `key_alone`.
    """
    seen: list[str] = []
    rest: list[str] = []
    for number, sentence in enumerate(_sentences(text)):
        is_seen = _IS_KEY.match(sentence) or (number == 0 and not key_alone)
        (seen if is_seen else rest).append(sentence)
    return " ".join(seen), " ".join(rest)


def figures_in(layout: Any) -> list[Plot]:
    """Find the figures in a Bokeh layout; Bokeh's own `select` would look at all models."""
    if isinstance(layout, Plot):
        return [layout]
    return [plot for child in getattr(layout, "children", ()) for plot in figures_in(child)]
