"""Views of a long computation on a measured signal."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.kit.views.job_view import JobView
from bearingcore import Scene

Found = TypeVar("Found")


@dataclass(frozen=True)
class SceneNow:
    """The scene with which a signal is compared, as it is when a job begins."""

    give: Callable[[], Scene]

    @property
    def scene(self) -> Scene:
        """That scene."""
        return self.give()


class MeasuredJobView(JobView[Model, Found, SceneNow], MeasuredView, Generic[Found]):
    """A `JobView` of the session's measurement."""

    def editor_on_page(self, parts: Any) -> SceneNow:
        return SceneNow(parts.scene_now)

    def editor_of(self, model: Model) -> SceneNow:
        return SceneNow(lambda: model.scene)
