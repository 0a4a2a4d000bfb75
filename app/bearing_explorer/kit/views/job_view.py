"""Views of a long computation: a form that starts it, its progress, and its result."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np
import panel as pn

from bearing_explorer.kit.compute.jobs import COMPUTATION, Jobs, JobState, Kind, Work
from bearing_explorer.kit.views.base import C, Sentence, SessionParts, View
from bearing_explorer.kit.widgets.facts import sentence_html
from bearing_explorer.kit.widgets.form import (
    SEARCHED,
    Fields,
    FieldSpec,
    SearchedSelect,
    button,
    row,
    widget_of,
)
from bearingcore import Scene

Result = TypeVar("Result")


class Editor(Protocol):
    """Owner of the scene that a form computes."""

    @property
    def scene(self) -> Scene:
        """The scene of the controls."""


E = TypeVar("E", bound=Editor)

_FIELDS = ":host { flex-wrap: wrap; align-items: end; gap: 8px; min-width: 0 !important; }"
_PROGRESS = """
progress { width: 220px; height: 6px; accent-color: var(--accent); vertical-align: middle; }
progress::-webkit-progress-bar { background: var(--track-soft); border-radius: 3px; }
progress::-webkit-progress-value { background: var(--accent); border-radius: 3px; }
"""


def last_shown(work: Callable[[Work], str]) -> Any:
    """Run a job here and now, and return its result; ValueError if it has none."""
    job = Work(math.inf)
    job.started = time.monotonic()
    words = work(job)
    results = job.take_results()
    if not results:
        raise ValueError(words)
    return results[-1]


class JobForm(pn.Column):
    """Fields, a button that starts a job, another that cancels it, its progress and a sentence.

    Parameters
    ----------
    start
        called with the values of the fields, by their names.
    cancel
        called to end the job.
    words
        words of the button that starts it.
    fields
        fields of the form.
    at_once
        True if a changed field starts the job, without the button.
    """

    def __init__(
        self,
        start: Callable[[Mapping[str, str]], None],
        cancel: Callable[[], None],
        words: str,
        fields: list[FieldSpec],
        at_once: bool = False,
    ) -> None:
        self._words, self._at_once = words, at_once
        #: {field: {its value: {other field: its value then}}}
        self.fills: Mapping[str, Any] = {}
        self._fields = fields_of_form = Fields(self._changed)
        self._start = lambda: start(dict(fields_of_form.values))
        widgets = [self._widget(spec) for spec in fields]
        begin = button(words, self._start, css_classes=["main", "start"])
        self._cancel = button("Cancel", cancel, css_classes=["cancel"], disabled=True)
        self._bar = pn.pane.HTML("", visible=False, margin=0, stylesheets=[_PROGRESS])
        self._sentence = Sentence(css_classes=["words"])
        #: state of the job that is shown
        self.state = JobState("idle", 0.0, "")
        # with `at_once`, the last field stands below the others, beside the buttons
        first, below = (widgets[:-1], widgets[-1:]) if at_once else (widgets, [])
        (below if at_once else first).extend((begin, self._cancel))
        super().__init__(
            row(*first, stylesheets=[_FIELDS]),
            row(*below, self._bar, self._sentence, margin=(6, 0, 0, 0)),
            css_classes=["job", "idle"],
            sizing_mode="stretch_width",
            margin=(4, 0, 8, 0),
        )

    def _widget(self, spec: FieldSpec) -> pn.viewable.Viewable:
        widget = self._fields.add(spec["name"], widget_of(spec))
        options = spec.get("options", ())
        if not options:
            widget.param.watch(lambda _: self._start(), "enter_pressed")
        return SearchedSelect(widget, options) if len(options) > SEARCHED else widget

    @property
    def values(self) -> Mapping[str, str]:
        """Values of the fields by name."""
        return self._fields.values

    def fill(self, values: Mapping[str, str], fills: Mapping[str, Any]) -> None:
        """Set the fields, and the values that a choice sets in other fields."""
        self.fills = fills
        self._fields.put(values)

    def show(self, state: JobState) -> None:
        """Show the state of the job."""
        self.state = state
        self._bar.param.update(
            object=f'<progress aria-label="{self._words}" value="{state.part:.3f}"></progress>',
            visible=state.running,
        )
        self._cancel.disabled = not state.running
        self._sentence.text = sentence_html(state.words)
        self.css_classes = ["job", state.mood]

    def _changed(self, name: str) -> None:
        self._fields.put(self.fills.get(name, {}).get(self.values[name], {}))
        if self._at_once:
            self._start()


class JobView(View[C], Generic[C, Result, E]):
    """A view of the result of a job.

    A subclass puts `self.job` into its layout, and provides `form` and `prepare`;
    `job_result` is the newest result. `data`, `sentence` and `table` read it beside the results
    of the scene.
    """

    start: ClassVar[str]
    """Words of the button."""
    bounds: ClassVar[str]
    """A sentence on the size or the time of a job."""
    at_once: ClassVar[bool] = False
    """True where a changed field starts the job, without the button."""
    kind: ClassVar[Kind] = COMPUTATION
    """Kind of the job: in a session, a newer job replaces an older one of its kind."""

    computes = True
    job_result: Result | None = None
    #: values of the form, and the scene, of the newest result
    _computed_for: tuple[dict[str, str], Scene] | None = None
    _jobs: Jobs | None = None
    _editor: E
    _draw: Callable[[], None]

    @property
    def job(self) -> JobForm:
        """The form of the job, made when first needed."""
        if not hasattr(self, "_job"):
            self._job = JobForm(
                self.start_job, self.cancel_job, self.start, self.fields(), self.at_once
            )
            self._job.show(JobState("idle", 0.0, self.bounds))
        return self._job

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self._jobs, self._editor, self._draw = parts.jobs, self.editor_of(parts), parts.draw
        self.job.fill(*self.form(self._editor))

    def editor_of(self, owner: Any) -> E:
        """Return the owner of the scene: the half on the page, elsewhere the drawn results."""
        editor: E = owner
        return editor

    @property
    def is_empty(self) -> bool:
        """True before a job has shown anything."""
        return self.job_result is None

    def fields(self) -> list[FieldSpec]:
        """The fields of the form; none where there is nothing to choose."""
        return []

    def form(self, editor: E) -> tuple[dict[str, str], dict[str, Any]]:
        """Return the first values of the fields, and values that a choice sets in other fields.

        The second is {field: {its value: {other field: its value then}}}.
        """
        return {}, {}

    def prepare(self, given: Mapping[str, str], editor: E) -> Callable[[Work], str]:
        """Return the job for the values of the form; ValueError with a sentence if it has none."""
        raise NotImplementedError

    def table(self, results: C) -> dict[str, np.ndarray]:
        return {} if self.job_result is None else self.columns(self.job_result)

    def columns(self, result: Result) -> dict[str, np.ndarray]:
        """The numbers behind the figures of a result, see `View.table`."""
        raise NotImplementedError

    def start_job(self, given: Mapping[str, str]) -> None:
        """Start the job for the values of the form."""
        if self._jobs is None:
            return
        try:
            self.begin(given)
        except ValueError as error:
            self.job.show(JobState("failed", 0.0, str(error)))

    def cancel_job(self) -> None:
        """End the job; its newest result stays."""
        if self._jobs is not None:
            self._jobs.cancel(self.kind)

    def begin(self, given: Mapping[str, str]) -> None:
        """Start the job of a form; ValueError with a sentence if it has none."""
        assert self._jobs is not None
        work, asked = self.prepare(given, self._editor), (dict(given), self._editor.scene)

        def take(result: Result) -> None:
            self._computed_for = asked
            self._take(result)

        self._jobs.start(work, take, self.report, self.kind)

    def report(self, state: JobState) -> None:
        """Show the state of the job, on the event loop."""
        self.job.show(state)

    def scene_drawn(self, results: C) -> Scene:
        return super().scene_drawn(results) if self._computed_for is None else self._computed_for[1]

    def choices(self) -> dict[str, Any]:
        return {} if self._computed_for is None else dict(self._computed_for[0])

    def choose(self, choices: Mapping[str, Any], results: C) -> None:
        """Compute the job of a form with these fields; missing ones have their usual values."""
        editor = self.editor_of(results)
        given = {**self.form(editor)[0], **choices}
        self.job_result = last_shown(self.prepare(given, editor))
        self._computed_for = given, editor.scene

    def _take(self, result: Result) -> None:
        self.job_result = result
        self._draw()
