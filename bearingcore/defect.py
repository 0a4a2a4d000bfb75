"""A raceway defect and the path that a ball's centre takes over it (Eq. 6).

Quantity                              | Symbol | Name         | Unit
------------------------------------- | ------ | ------------ | ----
circumferential extent                | Δφ_f   | extent       | rad
depth of the floor                    | h      | depth        | m
angle of the middle                   | φ_f    | center       | rad
drop of the ball's centre             | d(φ)   | path         | m
angle from the nearer edge inwards    | s      |              | rad
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore import checks, kernels
from bearingcore.bearing import Bearing

RACES = ("outer", "inner")
EDGES = ("published", "chord", "exact")
"""Edge models. `published` is Eq. 6 with r_b read for r_b² and its factor 0.25, which the paper's
figures were made with; `chord` is the same with factor 1; `exact` is a ball that pivots on the
corner of the curved race."""

TWO_PI = 2.0 * math.pi


@dataclass(frozen=True)
class Defect:
    """A square-shaped spall of one race.

    Parameters
    ----------
    extent
        circumferential extent [rad], 0 to 2π. The whole race (2π) has no edges left: it is a
        race worn down by `depth` everywhere.
    depth
        depth of the floor [m].
    center
        angle of its middle [rad]; for an inner-race defect at cage angle 0, as it turns with the
        shaft.
    race
        "outer" or "inner".
    edge
        how the ball's centre follows the edges: "published", "chord" or "exact".

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """

    extent: float
    depth: float
    center: float
    race: str = "outer"
    edge: str = "published"

    def __post_init__(self) -> None:
        def keep(name: str, value: float) -> None:
            object.__setattr__(self, name, value)

        # 360° typed as a decimal must not fail on the last digit of 2π
        extent = checks.number(
            "extent", self.extent, at_least=0.0, at_most=TWO_PI * (1.0 + 1e-9), unit="rad"
        )
        keep("extent", min(extent, TWO_PI))
        keep("depth", checks.number("depth", self.depth, at_least=0.0, unit="m"))
        keep("center", checks.number("center", self.center, unit="rad"))
        checks.choice("race", self.race, RACES)
        checks.choice("edge", self.edge, EDGES)

    @classmethod
    def none(cls) -> Self:
        """A sound bearing: no extent, no depth."""
        return cls(extent=0.0, depth=0.0, center=0.0)

    @property
    def is_none(self) -> bool:
        """True where there is nothing for a ball to fall into."""
        return self.extent == 0.0 or self.depth == 0.0

    def turn_ratio(self, bearing: Bearing) -> float:
        """How far the defect turns for each unit of cage angle: 0 (outer) or ω_s/ω_c (inner)."""
        return 0.0 if self.race == "outer" else 1.0 / bearing.cage_ratio

    def path_row(self, bearing: Bearing) -> NDArray[np.float64]:
        """The numbers the kernels need of this defect, in the order of `kernels.PATH_COLUMNS`."""
        r_b = bearing.ball_radius
        inner = self.race == "inner"
        R = bearing.inner_raceway_radius if inner else bearing.outer_raceway_radius
        h = self.depth
        if h > r_b:
            raise checks.refuse(
                "depth", h, f"at most the ball radius of {r_b:g} m, or no ball rolls over the edge"
            )
        if self.edge == "exact":
            # law of cosines: the ball touches floor and corner at once
            rho = R + r_b - h if inner else R - r_b + h
            s_floor = math.acos(min(1.0, (R * R + rho * rho - r_b * r_b) / (2.0 * R * rho)))
        else:
            factor = 0.25 if self.edge == "published" else 1.0
            s_floor = math.sqrt(h * (2.0 * r_b - h) / factor) / R
        if self.extent >= TWO_PI:
            s_floor = 0.0  # no edge is left: the floor is everywhere
        code = EDGES.index(self.edge) + (kernels.INNER_EXACT - kernels.EXACT) * (
            inner and self.edge == "exact"
        )
        return np.array(
            [self.center, self.turn_ratio(bearing), 0.5 * self.extent, h, s_floor, code, R, r_b]
        )

    def path(
        self, ball_angle: ArrayLike, bearing: Bearing, cage_angle: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Drop d(φ) [m] of the ball's centre at the ball angles [rad] (Eq. 6, mended).

        `cage_angle` [rad] says how far the cage has turned, and with it the shaft: it moves an
        inner-race defect and leaves an outer-race one where it is. Shapes broadcast.
        """
        angles = np.asarray(ball_angle, dtype=float) + np.zeros_like(cage_angle, dtype=float)
        cage = np.asarray(cage_angle, dtype=float) + np.zeros_like(angles)
        drop = kernels.ball_path(angles.ravel(), cage.ravel(), path_rows([self], bearing))
        return drop.reshape(angles.shape)


def path_rows(defects: Sequence[Defect], bearing: Bearing) -> NDArray[np.float64]:
    """One row of numbers a defect, shape (n, len(kernels.PATH_COLUMNS)), for the kernels."""
    rows = [defect.path_row(bearing) for defect in defects]
    return np.array(rows).reshape(len(rows), len(kernels.PATH_COLUMNS))
