"""Views of a measured signal."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from bearing_explorer.diagnosis.machine import NOT_KNOWN, ROUGH, Turning
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.session import Measurement, measurement_of
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, SessionParts, Sources, View
from bearing_explorer.kit.views.python_lines import code_of, short
from bearingcore import Scene, presets
from bearingcore.common import ResultTable
from bearingcore.measured.diagnosis import EnvelopeLines
from bearingcore.measured.files import ACCELERATIONS, path_in

HIGHEST_SHARE = 0.49
"""Share of the sample rate that a band may reach: the filter's edge lies below half of it."""

MEASURED = style.INK
"""Colour of measured curves in figures with simulated ones."""


def shown_unit(measured: Measured) -> tuple[str, float]:
    """Return the unit in which amplitudes are shown, and its size [m/s²].

    It is the unit of the file; g for voltages or velocities; "units of the file" if not known.
    """
    if not measured.in_si:
        return "units of the file", 1.0
    unit = "m/s²" if measured.origin is None else measured.origin.unit
    unit = unit if unit is not None and unit in ACCELERATIONS else "g"
    return unit, ACCELERATIONS[unit]


@dataclass(frozen=True)
class Demodulation:
    """The band [Hz] of an envelope, and the reason for it in words."""

    band: tuple[float, float]
    reason: str


NO_MEASUREMENT = measurement_of(None, next(iter(presets.values())))
"""An empty measurement, for views without a session."""
NOTHING = "There is no signal yet: choose a file or simulate one above."
WITHOUT_BEARING = "To see this, say in step 2 which bearing it is."


class MeasuredView(View[Model]):
    """A view of the session's measurement; `self.hidden` is shown once there is a signal.

    A subclass provides `data_of`, `words_of` and `columns_of` of a signal, or `data`, `sentence`
    and `table` themselves. Until there is a signal, only the first view, which has the form, is on
    the page.
    """

    needs = frozenset()
    hidden: Any = None
    #: True if its computation estimates an unknown shaft speed
    finds_speed: ClassVar[bool] = False
    #: True if its card appears only with a signal
    waits: ClassVar[bool] = True
    is_brief = False  # a result is always seen with its assumptions
    measurement: Measurement = NO_MEASUREMENT

    def __init__(self, packed: PackedSource) -> None:
        super().__init__(packed)
        self.panel.visible = not self.waits
        if self.waits:
            self.withhold(self.panel)

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self.measure(self.parts.measurement)

    def measure(self, measurement: Measurement) -> None:
        """Draw this measurement from now on."""
        self.measurement = measurement

    @property
    def measured(self) -> Measured | None:
        """The signal that is drawn, if there is one."""
        return self.measurement.measured

    def data(self, model: Model) -> tuple[Sources, Ranges]:
        measured = self.measured
        return ({}, {}) if measured is None else self.data_of(model, measured)

    def data_of(self, model: Model, measured: Measured) -> tuple[Sources, Ranges]:
        """`View.data` of the signal."""
        return {}, {}

    def sentence(self, model: Model) -> str:
        measured = self.measured
        return "" if measured is None else self.words_of(model, measured)

    def words_of(self, model: Model, measured: Measured) -> str:
        """`View.sentence` of the signal."""
        raise NotImplementedError

    def table(self, model: Model) -> dict[str, np.ndarray]:
        measured = self.measured
        return {} if measured is None else self.columns_of(model, measured)

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        """`View.table` of the signal."""
        raise NotImplementedError

    @property
    def shaft_speed(self) -> float | None:
        """Shaft speed [rad/s] that is given or that the diagnosis shows."""
        return self.measurement.shaft_speed

    @property
    def turning(self) -> Turning | None:
        """The measured bearing at its shaft speed; None where either is not known."""
        measured, speed = self.measured, self.shaft_speed
        if measured is None or measured.bearing is None or speed is None:
            return None
        return Turning(measured.bearing, speed)

    def diagnosed_envelope(self) -> EnvelopeLines | None:
        """Return the envelope on which the diagnosis rests, once there is one."""
        diagnosis = self.measurement.diagnosis()
        return None if diagnosis is None else diagnosis.spectrum

    def direction_of(self, measured: Measured, chosen: str = "") -> str:
        """Return the direction to show: the chosen one, or that of the diagnosis, or y."""
        diagnosed = self.diagnosed_envelope()
        wanted = (chosen, diagnosed.direction if diagnosed else "", "y", *measured.directions)
        return next(direction for direction in wanted if direction in measured.directions)

    def demodulation(self, measured: Measured, direction: str) -> Demodulation:
        """Return the band for envelopes: that of the diagnosis, or the kurtogram's best."""
        highest = HIGHEST_SHARE * measured.recording.sample_rate
        diagnosed = self.diagnosed_envelope()
        if diagnosed is not None:
            low, high = diagnosed.band
            along = f", along {diagnosed.direction}" if diagnosed.direction != direction else ""
            reason = f"the band of the diagnosis{along}"
        else:
            turning = self.turning
            passing = 0.0 if turning is None else turning.bearing.bpfo(turning.shaft_speed)
            lowest = min(5.0 * passing, 0.25 * highest)
            low, high = measured.kurtogram(direction).best(lowest)
            reason = "where the kurtogram is highest"
        return Demodulation((low, min(high, highest)), reason)

    def python(self) -> str:
        """Return lines of Python that read the file and make the figure."""
        measured, model = self.measured, self._results
        if measured is None or model is None:
            return f"# {NOTHING}\n"
        return self.lines_of_python(model)

    def scene_drawn(self, model: Model) -> Scene:
        measured = self.measured
        return model.scene if measured is None else measured.scene(model.scene)

    def lines_before(self) -> list[str]:
        """Lines that read the recording, or simulate it."""
        return [] if self.measured is None else recording_lines(self.measured)

    def more_arguments(self) -> dict[str, str]:
        measured = self.measured
        if measured is None:
            return {"recording": "recording"}
        machine = measured.machine
        known = {"in_si": "True" if measured.in_si else "False"}
        known["speed"] = {ROUGH: '"rough"', NOT_KNOWN: '"unknown"'}.get(machine.speed_source, "")
        if machine.exact_speed is None and not self.finds_speed and self.shaft_speed is not None:
            known["speed"] = short(self.shaft_speed)  # exported lines do not estimate it
        known["bearing"] = '"frequencies"' if machine.by_frequencies else ""
        if machine.bearing is None:
            known["bearing"] = '"unknown"'
        usual = {"in_si": "True"}
        return {"recording": "recording"} | {
            name: code for name, code in known.items() if code and code != usual.get(name)
        }

    def say(self, model: Model | None, sentence: str) -> None:
        super().say(model, sentence)
        measured = self.measured
        has_signal = measured is not None
        self.panel.visible = has_signal or not self.waits
        if has_signal:
            self.bring()
        if self.hidden is not None:
            self.hidden.visible = has_signal
        file = measured.recording.name if measured is not None and measured.origin else ""
        self._caption.put(nothing=not has_signal, subject=file)
        # hidden figures are not saved as pictures
        self._caption.figures = [plot.id for plot in self.figures] if self.drawn else []

    @property
    def is_empty(self) -> bool:
        """True without a signal: there are no numbers then."""
        return not self.drawn

    @property
    def drawn(self) -> bool:
        """True while its figures are on screen."""
        return self.measured is not None


def column_name(direction: str, in_si: bool) -> str:
    """Column name of the signal along a direction, with its unit if that is known."""
    return f"acceleration_{direction}_m_per_s2" if in_si else f"signal_{direction}"


def named_columns(table: ResultTable, in_si: bool) -> dict[str, np.ndarray]:
    """Columns of a signal's table; without units and velocities if its unit is not known."""
    columns = table.in_units().named()
    if in_si:
        return columns
    return {
        name.replace("_m_per_s2", "_as_in_file"): values
        for name, values in columns.items()
        if not name.startswith("velocity")
    }


def recording_lines(measured: Measured) -> list[str]:
    """Write Python that reads `recording` from its file, or simulates it without noise."""
    recording, origin = measured.recording, measured.origin
    along, rate = code_of(list(recording.directions)), short(recording.sample_rate)
    if origin is None:
        duration = math.ceil(10.0 * recording.duration) / 10.0
        return [
            "# simulated again, without noise",
            f"motion = simulate(scene, {short(duration + 0.3)}, {rate})",
            f"columns = [motion.dofs.index(dof) for dof in {along}]",
            "settled = motion.outer_acceleration[motion.time >= 0.3]",
            f"recording = Recording(settled[:, columns], {rate}, {along})",
        ]
    name, path = code_of(origin.file), code_of(path_in(origin.file))
    speed, ratio = measured.machine.exact_speed, measured.machine.ratio
    speed = None if speed is None else speed / ratio
    known = {"sensitivity": origin.sensitivity, "shaft_speed": speed}
    further = "".join(f", {name}={short(v)}" for name, v in known.items() if v is not None)
    unit = code_of(origin.unit if measured.in_si else "m/s²")
    return [
        f"table = read_table({name}, Path({path}).read_bytes())",
        *([f"table = table.with_columns({dict(origin.given)!r})"] if origin.given else []),
        *([f"table = table.one_of_recordings({origin.part})"] if origin.part else []),
        *([] if measured.in_si else ["# the unit of the file is not known"]),
        "recording = table.recording(",
        f"    {list(origin.columns)}, {along}, {unit}, {rate}, {short(origin.full_scale)}{further}",
        ")",
        *([f"recording = recording.scale_shaft({ratio!r})"] if ratio != 1.0 else []),
    ]
