"""The measured signal's half of a session: files, the machine, the diagnosis, its views."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.report import measured_report
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.views.measured_indicators import MeasuredIndicators
from bearing_explorer.kit.bearing_list import BearingTable
from bearing_explorer.kit.half import Page, Section
from bearing_explorer.kit.report_page import About
from bearing_explorer.kit.views.base import View
from bearingcore import Scene


class DiagnosisOfSignal:
    """The measurement of a session, and what its views draw of it.

    Parameters
    ----------
    sections
        its tabs.
    scene
        gives the scene with which a signal is compared, as it is now.
    bearings
        to choose from.
    """

    def __init__(
        self, sections: Sequence[Section], scene: Callable[[], Scene], bearings: BearingTable
    ) -> None:
        self.sections = tuple(sections)
        self.scene_now, self._bearings = scene, bearings

    kind_of_content = Model

    def join(self, page: Page) -> None:
        self.page, self.jobs, self.draw = page, page.jobs, page.draw
        self.measurement = Measurement(self.scene_now, self._bearings, page.assign, page.draw)

    def attach(self, view: View) -> None:
        view.attach(self)

    def tab_opened(self, name: str) -> None:
        """Nothing of it depends on the tab."""

    def stop(self) -> None:
        self.measurement.stop()

    def content(self) -> Model:
        self.measurement.take_scene()
        return Model(self.scene_now(), True, self.measurement.at_work, self.page.mark)

    # What the page connects with the scene's half

    def change_scene_by(self, change: Callable[[dict[str, Any]], None]) -> None:
        """Have messages about the scene taken by this."""
        self.measurement.change_scene = change

    def simulate(self, noise: str) -> None:
        """Simulate a measurement of the scene."""
        self.measurement.simulate(noise)

    def report(self, about: About) -> Callable[[], dict[str, Any] | None] | str:
        """A function that makes the report on the signal, in any thread; or why there is none."""
        measurement = self.measurement.snapshot()
        if why := measurement.out_of_date:
            return why
        found: Mapping[str, Any] = {
            view.name: view.found for view in self.page.views_made() if view.found is not None
        }
        kinds = (view.look["machine"] for view in self.page.views_made()
                 if isinstance(view, MeasuredIndicators))  # fmt: skip
        kind = next(kinds, "")
        return lambda: measured_report(Model(self.scene_now()), measurement, found, about, kind)
