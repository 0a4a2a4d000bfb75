"""The measured signal's half of a session: files, the machine, the diagnosis, its views."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.report import measured_report
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.kit.report_page import About
from bearing_explorer.kit.session import Half, Section, Session
from bearingcore import Scene


class DiagnosisOfSignal(Half):
    """The measurement of a session, and the content of its views.

    Parameters
    ----------
    sections
        its tabs.
    scene
        returns the current scene, with which a signal is compared.
    """

    def __init__(self, sections: Sequence[Section], scene: Callable[[], Scene]) -> None:
        self.sections = tuple(sections)
        self._scene = scene

    kind_of_content = Model

    def join(self, page: Session) -> None:
        super().join(page)
        self.measurement = Measurement(self._scene, page.jobs, page.draw)

    @property
    def scene(self) -> Scene:
        """The current scene, with which a signal is compared."""
        return self._scene()

    def stop(self) -> None:
        self.measurement.stop()

    def content(self) -> Model:
        self.measurement.take_scene()
        return Model(self.scene, True, self.measurement.at_work, self.page.mark)

    def simulate(self, noise: str) -> None:
        """Simulate a measurement of the scene."""
        self.measurement.simulate(noise)

    def report(self, about: About) -> Callable[[], dict[str, Any]] | str:
        """Return a function that makes the report in any thread, or why there is none."""
        measurement = self.measurement.snapshot()
        if why := measurement.out_of_date:
            return why
        if measurement.diagnosis() is None:
            return "nothing is diagnosed yet."
        results: Mapping[str, Any] = {
            view.name: view.job_result
            for view in self.page.views_made()
            if view.job_result is not None
        }
        return lambda: measured_report(Model(self.scene), measurement, results, about)
