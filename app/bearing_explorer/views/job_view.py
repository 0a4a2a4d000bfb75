"""Views of what takes a while: a form that starts it, its progress, and what it has found."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Generic, TypeVar

import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.results.jobs import Jobs, JobState, Work
from bearing_explorer.serve.live_component import LiveComponent
from bearing_explorer.state.scene_editor import SceneEditor
from bearing_explorer.views.base import SessionParts, View

Found = TypeVar("Found")

_LONGEST_TEXT = 60  # characters of what a field says


class JobPanel(LiveComponent):
    """Fields, a button that starts a job, another that cancels it, a bar and a live sentence.

    `asked` gets messages of the browser as they come, from strangers too: judge them.
    """

    #: {"start": words of the button, "fields": [{"name", "label", "options": [[value, words]]}]};
    #: a field without options is one to type into, a third part of an option its heading in the
    #: list; one with "only": {other field: [values]} is shown with those alone; with "at_once" a
    #: changed field starts the job as the button does
    spec = param.Dict(default={})
    #: {field: what stands in it}
    values = param.Dict(default={})
    #: {field: {its value: {other field: what comes to stand in it}}}
    fills = param.Dict(default={})
    #: a JobState
    state = param.Dict(default={"mood": "idle", "part": 0.0, "words": ""})

    _esm = scripts("element.js", "job.js")
    _stylesheets: ClassVar[list[str]] = [asset_text("field.css"), asset_text("job.css")]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        super().__init__(margin=0, sizing_mode="stretch_width", **params)
        self.on_msg(lambda event: asked(event.data))

    def show(self, state: JobState) -> None:
        """How the job goes."""
        self.state = {"mood": state.mood, "part": state.part, "words": state.words}


class JobView(View, Generic[Found]):
    """A view that draws what a job has found.

    A subclass puts `self.job` among what it builds, and provides `form` and `prepare`; what the
    job shows last stands in `found`. `data`, `sentence` and `table` read it beside the results.
    """

    start: ClassVar[str]
    """Words of the button."""
    bounds: ClassVar[str]
    """A sentence: how large a job may be."""
    at_once: ClassVar[bool] = False
    """Whether a changed field starts the job, without the button."""

    found: Found | None = None
    _jobs: Jobs | None = None
    _editor: SceneEditor
    _draw: Callable[[], None]

    @property
    def job(self) -> JobPanel:
        """The panel of the job, made when first asked for."""
        if not hasattr(self, "_job"):
            state = JobState("idle", 0.0, self.bounds)
            spec = {"start": self.start, "fields": self.fields(), "at_once": self.at_once}
            self._job = JobPanel(self._asked, spec=spec)
            self._job.show(state)
        return self._job

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self.employ(parts.jobs, parts.editor, parts.draw)

    def employ(self, jobs: Jobs, editor: SceneEditor, draw: Callable[[], None]) -> None:
        """From now on jobs can be started, for the scene of `editor`; `draw` asks for a drawing."""
        self._jobs, self._editor, self._draw = jobs, editor, draw
        self.job.values, self.job.fills = self.form(editor)

    @property
    def is_empty(self) -> bool:
        """Before a job has found anything."""
        return self.found is None

    def fields(self) -> list[dict[str, Any]]:
        """The fields of the form, see `JobPanel.spec`."""
        raise NotImplementedError

    def form(self, editor: SceneEditor) -> tuple[dict[str, str], dict[str, Any]]:
        """What stands in the fields at first, and what comes with a choice: `values`, `fills`."""
        raise NotImplementedError

    def prepare(self, given: Mapping[str, str], editor: SceneEditor) -> Callable[[Work], str]:
        """The job that the form asks for; ValueError with a sentence where it cannot be."""
        raise NotImplementedError

    def texts(self, given: Mapping[Any, Any]) -> dict[str, str]:
        """What stands in each field, out of a message of the browser."""
        return {
            field["name"]: str(given.get(field["name"], ""))[:_LONGEST_TEXT]
            for field in self.fields()
        }

    def _asked(self, message: Any) -> None:
        if not isinstance(message, dict) or self._jobs is None:
            return
        if message.get("cancel") is True:
            self._jobs.cancel()
        if isinstance(given := message.get("start"), dict):
            try:
                work = self.prepare(self.texts(given), self._editor)
            except ValueError as error:
                self.job.show(JobState("failed", 0.0, str(error)))
            else:
                self._jobs.start(work, self._take, self.job.show)

    def _take(self, found: Found) -> None:
        self.found = found
        self._draw()
