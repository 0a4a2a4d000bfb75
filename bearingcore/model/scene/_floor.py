"""Floors of defects that are not flat: rough floors and measured floors.

Quantity                                        | Symbol | Name               | Unit
----------------------------------------------- | ------ | ------------------ | ----
root mean square height of the roughness        | R_q    | rms_height         | m
distance at which its correlation falls to 1/e  | l      | correlation_length | m
place along the defect, −1 at one end, 1 at the other |  | places             |
depth over the defect's depth                   |        | depths             |
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from bearingcore.common import Array, _checks as checks
from bearingcore.common._byte_cache import lru_cache_by_bytes

SAMPLES_A_LENGTH = 10
"""Samples of a rough floor per correlation length."""

MOST_ROWS = 100_000

MOST_SAMPLES = 2_000_000
"""Greatest number of samples of a rough floor; more would not fit the table of its path."""


@dataclass(frozen=True)
class RoughFloor:
    """A random floor of Gaussian heights and Gaussian correlation about the defect's depth.

    Parameters
    ----------
    rms_height
        root mean square height [m].
    correlation_length
        distance along the race [m] at which the correlation of heights has fallen to 1/e.
    seed
        whole number; equal seeds give equal surfaces, which a longer defect continues.
    """

    kind: ClassVar[str] = "rough"

    rms_height: float
    correlation_length: float
    seed: int = 0

    def __post_init__(self) -> None:
        checks.keep_number(self, "rms_height", at_least=0.0, unit="m")
        checks.keep_number(self, "correlation_length", at_least=1e-6)
        seed = checks.whole_number("seed", self.seed, at_least=0, at_most=2**31 - 1)
        checks.keep(self, seed=seed)

    def check_length(self, length: float) -> None:
        """Raise ValueError if a floor of `length` [m] along the race needs too many samples."""
        least = SAMPLES_A_LENGTH * length / MOST_SAMPLES
        if self.correlation_length < least:
            raise checks.refuse(
                "correlation_length",
                self.correlation_length,
                "at least {least:m} on a defect that is {length:m} long",
                least=least,
                length=length,
            )

    def surface(self, angle: Array, extent: float, depth: float, radius: float) -> Array:
        """Return the depth [m] at angles [rad] from the middle, on a race of `radius` [m].

        The floor is never above the healthy race.
        """
        step = self.correlation_length / SAMPLES_A_LENGTH
        reach = math.ceil(0.5 * extent * radius / step) + 1
        heights = _roughness(self.seed, reach) * self.rms_height
        place = np.arange(-reach, reach + 1) * step
        return np.maximum(depth + np.interp(angle * radius, place, heights), 0.0)


@lru_cache_by_bytes(64_000_000, lambda heights, *_: heights.nbytes)
def _roughness(seed: int, reach: int) -> Array:
    """Return 2·reach + 1 heights of unit variance, SAMPLES_A_LENGTH per correlation length."""
    from scipy import ndimage  # imported late: it would double the time to import this package

    # white noise smoothed by a Gaussian of σ = l/2 has the correlation exp(−(x/l)²)
    sigma = 0.5 * SAMPLES_A_LENGTH
    margin = math.ceil(5.0 * sigma)
    sides = [
        np.random.default_rng([seed, side]).standard_normal(reach + margin + side)
        for side in (0, 1)
    ]
    noise = np.concatenate([sides[0][::-1], sides[1]])
    smooth = ndimage.gaussian_filter1d(noise, sigma, mode="constant", truncate=5.0)
    kernel = ndimage.gaussian_filter1d(np.eye(1, 2 * margin + 1, margin)[0], sigma, truncate=5.0)
    heights = smooth[margin:-margin] / np.linalg.norm(kernel)
    heights.setflags(write=False)
    return heights


@dataclass(frozen=True)
class MeasuredFloor:
    """The shape of a measured floor, linear between its points.

    Parameters
    ----------
    places
        places along the defect, rising from −1 (its beginning) to 1 (its end).
    depths
        depth at each place over the depth of the defect: 0 is the healthy race; a negative number
        is above the race, such as a rim that was pushed up.
    """

    kind: ClassVar[str] = "measured"

    places: tuple[float, ...]
    depths: tuple[float, ...]

    def __post_init__(self) -> None:
        places, depths = (np.asarray(v, dtype=float) for v in (self.places, self.depths))
        if not (
            places.ndim == 1 and 2 <= places.size <= MOST_ROWS and places.shape == depths.shape
        ):
            raise checks.refuse(
                "floor",
                f"{places.size} places and {depths.size} depths",
                f"as many depths as places, 2 to {MOST_ROWS}",
            )
        if not (np.all(np.diff(places) > 0.0) and places[0] >= -1.0 and places[-1] <= 1.0):
            raise checks.refuse("floor places", "not rising from -1 to 1", "rising from -1 to 1")
        if not (np.all(np.isfinite(depths)) and np.all(np.abs(depths) <= 1.0)):
            raise checks.refuse("floor depths", "not all from -1 to 1", "-1 to 1")
        checks.keep(self, places=tuple(places.tolist()), depths=tuple(depths.tolist()))

    def surface(self, angle: Array, extent: float, depth: float, radius: float) -> Array:
        """Return the depth [m] at angles [rad] from the middle of a defect."""
        return depth * np.interp(angle / (0.5 * extent), self.places, self.depths)


def measured_floor(angle: ArrayLike, depth: ArrayLike) -> tuple[MeasuredFloor, float, float, float]:
    """Make a floor from measured angles [rad] and depths [m] in any order; below 0 it is raised.

    Returns the floor, and the extent [rad], depth [m] and center [rad] of its defect.

    Raises
    ------
    ValueError
        for fewer than two points, numbers that are not finite, repeated angles, or depths that
        are 0 everywhere.
    """
    angles = np.asarray(angle, dtype=float).ravel()
    depths = np.asarray(depth, dtype=float).ravel()
    if angles.size != depths.size or not 2 <= angles.size <= MOST_ROWS:
        raise checks.refuse(
            "floor", f"{angles.size} angles and {depths.size} depths", f"pairs, 2 to {MOST_ROWS}"
        )
    if not (np.all(np.isfinite(angles)) and np.all(np.isfinite(depths))):
        raise checks.refuse("floor", "not finite everywhere", "finite angles and depths")
    order = np.argsort(angles)
    angles, depths = angles[order], depths[order]
    extent = float(angles[-1] - angles[0])
    if np.any(np.diff(angles) <= 0.0) or not extent <= 2.0 * math.pi:
        raise checks.refuse(
            "floor angles", f"{extent:g} rad wide", "different angles within one turn"
        )
    deepest = float(np.abs(depths).max())
    if deepest == 0.0:
        raise checks.refuse("floor depths", "0 m everywhere", "not 0 everywhere")
    center = 0.5 * float(angles[0] + angles[-1])
    places = np.clip((angles - center) / (0.5 * extent), -1.0, 1.0)
    floor = MeasuredFloor(tuple(places.tolist()), tuple((depths / deepest).tolist()))
    return floor, extent, deepest, center
