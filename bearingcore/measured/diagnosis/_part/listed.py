"""Listed bearings whose lines are in a signal that the given bearing does not explain."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from bearingcore.bearings import Bearing
from bearingcore.measured.diagnosis._part.diagnose import diagnose_recording
from bearingcore.measured.diagnosis._part.evidence import Diagnosis
from bearingcore.measured.diagnosis._part.parts import part_lines
from bearingcore.recordings import Recording

SAME_LINES = 0.002
"""Relative difference up to which the lines of two bearings are the same."""


@dataclass(frozen=True)
class ListedBearing:
    """A bearing of a list that explains a signal: its name, and the diagnosis with it."""

    name: str
    diagnosis: Diagnosis

    @property
    def slip(self) -> float:
        """By how much the lines of its damaged part are off the geometry, as a fraction."""
        return self.diagnosis.of(self.diagnosis.fault).slip

    @property
    def level(self) -> float:
        """[dB] of those lines above their surroundings."""
        return self.diagnosis.of(self.diagnosis.fault).level


def explaining_bearings(
    recording: Recording,
    bearings: Mapping[str, Bearing],
    shaft_speed: float | tuple[float, float] | None,
    *,
    goes_on: Callable[[int, int], bool] = lambda done, of: True,
) -> tuple[ListedBearing, ...]:
    """The bearings with which a part is named, those with the strongest lines first.

    Damage of a ball is left out: its lines are near those of a race of many other bearings.

    Parameters
    ----------
    recording, shaft_speed
        as for `diagnose`.
    bearings
        by name; of those with the same lines the first stands for all.
    goes_on
        called with the number of bearings that are done, and of all; False ends the search.

    Raises
    ------
    ValueError
        for a speed that cannot be.
    """
    answers = []
    distinct = list(_distinct(bearings))
    for done, (name, bearing) in enumerate(distinct):
        if not goes_on(done, len(distinct)):
            break
        source = "assumed: one of a list"
        answer = diagnose_recording(recording, bearing, shaft_speed, bearing_source=source)
        if answer.fault in ("outer race", "inner race"):
            answers.append(ListedBearing(name, answer))
    # levels within a decibel are alike: then the nearer geometry is the better
    return tuple(sorted(answers, key=lambda bearing: (-round(bearing.level), abs(bearing.slip))))


def _distinct(bearings: Mapping[str, Bearing]) -> Iterator[tuple[str, Bearing]]:
    seen: list[list[float]] = []
    for name, bearing in bearings.items():
        if not bearing.rows_are_alike:
            continue
        orders = [line.order for line in part_lines(bearing)]
        if any(
            all(abs(own / other - 1.0) < SAME_LINES for own, other in zip(orders, one, strict=True))
            for one in seen
        ):
            continue
        seen.append(orders)
        yield name, bearing
