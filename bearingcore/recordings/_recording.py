"""A measured signal: acceleration in SI units, and further facts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

import numpy as np

from bearingcore.common import Array, _checks as checks, count

DIRECTIONS = ("x", "y")

SWINGS = (1e-12, 1e12)
"""Least and greatest swing, in any unit: outside, fourth powers underflow or overflow."""

FEWEST_SAMPLES = 256


@dataclass(frozen=True)
class Recording:
    """Measured acceleration of the housing, in SI units.

    Attributes
    ----------
    acceleration : (n, d) [m/s²]
        one column per direction.
    sample_rate
        [Hz]
    directions
        of the columns: "x" (horizontal), "y" (vertical, up).
    name
        origin, such as the name of the file.
    shaft_speed
        [rad/s] at the measurement; None if it is not known.
    notes
        sentences on changes of the signal, and on omissions.
    shaft_angle : (n,) [rad]
        angle of the shaft at each sample, if it was measured with the signal; the speed may then
        change. For a tachometer with several pulses a turn it advances one turn from pulse to
        pulse.
    recorded
        date and time of the measurement; None if they are not known.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """

    acceleration: Array = field(repr=False)
    sample_rate: float
    directions: tuple[str, ...] = ("x", "y")
    name: str = ""
    shaft_speed: float | None = None
    notes: tuple[str, ...] = ()
    shaft_angle: Array | None = field(default=None, repr=False)
    recorded: datetime | None = None

    def __post_init__(self) -> None:
        checks.keep_number(self, "sample_rate", above=0.0, unit="Hz")
        checks.keep_number(self, "shaft_speed", optional=True, above=0.0, unit="rad/s")
        checks.keep(self, directions=check_directions(self.directions), notes=tuple(self.notes))
        signal = np.array(self.acceleration, dtype=float)
        if signal.ndim == 1:
            signal = signal[:, None]
        if signal.ndim != 2 or signal.shape[1] != len(self.directions):
            raise checks.refuse(
                "acceleration",
                f"of shape {np.shape(self.acceleration)}",
                f"a column for each direction: {', '.join(self.directions)}",
            )
        if len(signal) < FEWEST_SAMPLES:
            raise checks.refuse(
                "acceleration", f"{len(signal)} samples long", f"at least {FEWEST_SAMPLES} samples"
            )
        bad = np.flatnonzero(~np.isfinite(signal).all(axis=1))
        if bad.size:
            raise checks.refuse(
                "acceleration",
                f"not a finite number in {count(bad.size, 'sample')}, first in number {bad[0] + 1}",
                "finite numbers",
            )
        with np.errstate(over="ignore"):
            swings = np.ptp(signal, axis=0)
        for direction, swing in zip(self.directions, swings, strict=True):
            if not swing:
                what = f"the same number throughout along {direction}"
                raise checks.refuse("acceleration", what, "a signal that varies")
            if not SWINGS[0] <= swing <= SWINGS[1]:
                what = f"swinging by {swing:.1g} along {direction}"
                raise checks.refuse("acceleration", what, "from {:g} to {:g}".format(*SWINGS))
        signal.setflags(write=False)
        checks.keep(self, acceleration=signal)
        if self.shaft_angle is not None:
            checks.keep(self, shaft_angle=_check_shaft_angle(self.shaft_angle, len(signal)))

    @property
    def duration(self) -> float:
        """Length of the signal [s]."""
        return len(self.acceleration) / self.sample_rate

    def scale_shaft(self, ratio: float) -> Recording:
        """Return the recording for a shaft behind a gear that turns `ratio` times as fast."""
        speed, angle = self.shaft_speed, self.shaft_angle
        return replace(
            self,
            shaft_speed=None if speed is None else ratio * speed,
            shaft_angle=None if angle is None else ratio * angle,
        )


def _check_shaft_angle(angle: Array, samples: int) -> Array:
    """Return the angle of the shaft (samples,) as a copy; `FieldError` if it ever falls."""
    checked = np.array(angle, dtype=float)
    if checked.shape != (samples,) or not (np.isfinite(checked).all() and np.ptp(checked) > 0.0):
        allowed = f"a finite number for each of {samples} samples, rising"
        raise checks.refuse("shaft_angle", f"of shape {checked.shape}", allowed)
    if (np.diff(checked) < 0.0).any():
        raise checks.refuse("shaft_angle", "falling", "an angle that never falls")
    checked.setflags(write=False)
    return checked


def check_directions(directions: Sequence[str]) -> tuple[str, ...]:
    """Return `directions` as a tuple; ValueError unless they are x, y, or both."""
    names = (directions,) if isinstance(directions, str) else tuple(directions)
    if not names or len(set(names)) != len(names) or not set(names) <= set(DIRECTIONS):
        raise checks.refuse("directions", directions, "x, y or both")
    return names
