"""A measured signal: its spectra and envelopes, computed when first used.

All drawings of a measurement take their numbers from here, as drawings of a scene take theirs from
`results.results`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bearingcore as core
from bearing_explorer.diagnosis.machine import Machine
from bearingcore import Bearing, Indicators, Kurtogram, Recording, Scene, Spectrum
from bearingcore.common import cached_property
from bearingcore.measured.diagnosis import NARROWEST, speed_over_time
from bearingcore.measured.files import Column
from bearingcore.measured.signals import shaft_share

ENVELOPE_TOP = 1000.0
"""Highest frequency [Hz] of an envelope spectrum that is drawn for an unknown machine."""

ENVELOPE_LINES = 1600
"""Largest number of frequencies of an envelope spectrum that are drawn."""

MOST_KEPT = 12
"""Largest number of spectra, envelopes and kurtograms that are kept for a signal."""


@dataclass(frozen=True)
class Origin:
    """The origin of a recording: columns of a file, and the meaning of their numbers.

    `unit` is None if the columns have units of their own, empty if it is not known. A 1 in the file
    stands for `full_scale` units. If the file holds voltages, `sensitivity` [V/(m/s²)] is that of
    the sensor. `given` holds the meaning of columns that a person gave. `place` is the place of the
    sensors, as given or as named in the file. `part` is the number of the recording chosen among
    several in the file, 0 if none was chosen; `which` names the recording that was read. `machine`
    is the name of the machine in the file.
    """

    file: str
    columns: tuple[int, ...]
    unit: str | None
    full_scale: float
    sensitivity: float | None = None
    given: Mapping[int, Column] = field(default_factory=dict)
    place: str = ""
    part: int = 0
    which: str = ""
    machine: str = ""


@dataclass(frozen=True, eq=False)
class Measured:
    """A recording, and the machine on which it was measured, as far as it is known.

    Attributes
    ----------
    recording
        the signal; it carries no shaft speed.
    machine
        bearing and shaft speed, where they are known.
    true_extent
        [rad] of the defect in a simulated signal, else None.
    origin
        the file, where it comes from one.
    true_part
        damaged part in a simulated signal, or "none"; "" for a measured one.
    true_load, true_edge
        radial load [N] that presses balls into the defect, and model of its edges, in a simulated
        signal with one defect; else None.
    true_scene
        scene of a simulated signal, else None.
    noiseless
        True for a simulated signal without noise.
    in_si
        True for a recording in m/s². Otherwise its unit or sensor is not known, and its numbers are
        those of the file; whatever depends on their size waits until a person gives the unit.
    """

    recording: Recording
    machine: Machine
    true_extent: float | None = None
    origin: Origin | None = None
    true_part: str = ""
    true_load: float | None = None
    true_edge: str | None = None
    true_scene: Scene | None = None
    noiseless: bool = False
    in_si: bool = True
    _known: dict[tuple[Any, ...], Any] = field(default_factory=dict, repr=False)

    @property
    def shaft_speed(self) -> float | None:
        """Shaft speed [rad/s]; None where it is not known."""
        return self.machine.shaft_speed

    @property
    def bearing(self) -> Bearing | None:
        """The measured bearing; None where nothing says which it is."""
        return self.machine.bearing

    @property
    def directions(self) -> tuple[str, ...]:
        """The measured directions."""
        return self.recording.directions

    def along(self, direction: str) -> str:
        """Words for a direction, " along x"; empty for a single one, which may be any direction."""
        return f" along {direction}" if len(self.directions) > 1 else ""

    def finest(self, wanted: float) -> float:
        """Resolution [Hz] nearest to `wanted` that leaves the recording at least two segments."""
        coarsest = self.recording.sample_rate / 64.0
        return max(min(wanted, coarsest), 2.0 / self.recording.duration)

    def spectrum(self, direction: str, resolution: float) -> Spectrum:
        """Spectrum along a direction."""
        recording = self.recording

        def compute() -> Spectrum:
            signal = recording.acceleration - recording.acceleration.mean(axis=0)
            return core.spectrum(signal, recording.sample_rate, resolution)

        frequency, density = self.once(("spectrum", resolution), compute)
        return core.Spectrum(frequency, density[:, self.directions.index(direction)])

    def kurtogram(self, direction: str) -> Kurtogram:
        """Kurtogram of the signal along a direction."""
        narrowest = NARROWEST * (self.shaft_speed or 0.0) / (2.0 * math.pi)
        signal, rate = self.column(direction), self.recording.sample_rate
        key = ("kurtogram", direction, narrowest)
        return self.once(key, lambda: core.kurtogram(signal, rate, narrowest))

    def envelope_resolution(self, top: float) -> float:
        """Resolution [Hz] of an envelope spectrum that is drawn up to `top` [Hz]."""
        return max(1.0 / self.recording.duration, top / ENVELOPE_LINES)

    def envelope(self, direction: str, band: tuple[float, float], top: float) -> Spectrum:
        """Envelope spectrum of a band [Hz] along a direction, for a drawing up to `top` [Hz]."""
        signal, resolution = self.column(direction), self.envelope_resolution(top)
        rate = self.recording.sample_rate
        return self.once(
            ("envelope", direction, *band, top),
            lambda: core.envelope_spectrum(signal - signal.mean(), rate, band, resolution),
        )

    def once(self, key: tuple[Any, ...], compute: Callable[[], Any]) -> Any:
        """Return a kept result, or compute and keep it; beyond `MOST_KEPT` the oldest goes."""
        result = self._known.get(key)
        if result is None:
            result = compute()
            while len(self._known) >= MOST_KEPT:
                self._known.pop(next(iter(self._known)), None)
            self._known[key] = result
        return result

    def column(self, direction: str) -> NDArray[np.float64]:
        """The signal (n,) along a direction."""
        return self.recording.acceleration[:, self.directions.index(direction)]

    @cached_property
    def indicators(self) -> Indicators:
        """Condition indicators of the recording."""
        return core.indicators(self.recording, self.shaft_speed)

    @cached_property
    def speeds(self) -> NDArray[np.float64] | None:
        """Speed (n,) [rad/s] of the bearing's shaft, if measured with the signal; else None."""
        return speed_over_time(self.recording, self.shaft_speed)

    @cached_property
    def speed_limits(self) -> tuple[float, float] | None:
        """Least and greatest [rad/s] of `speeds`; None without them."""
        speeds = self.speeds
        return None if speeds is None else (float(speeds.min()), float(speeds.max()))

    @cached_property
    def shaft_share(self) -> float:
        """Share of the velocity's power in the shaft's own lines; NaN if it is not known."""
        if self.shaft_speed is None or not self.in_si:
            return math.nan
        loudest = int(self.indicators.velocity_rms.argmax())
        return float(shaft_share(self.recording, self.shaft_speed)[loudest])

    def scene(self, scene: Scene) -> Scene:
        """Return a scene with the bearing and the speed of the measurement, as far as known.

        The defect is dropped if the bearing cannot have it. Raises ValueError if the scene cannot
        have the bearing at all.
        """
        known = {"shaft_speed": self.shaft_speed, "bearing": self.bearing}
        changes = {name: value for name, value in known.items() if value is not None}
        try:
            return scene.replace(**changes)
        except ValueError:
            return scene.replace(**changes, defect=())
