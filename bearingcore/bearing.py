"""The bearing: its geometry, its kinematics and the frequencies at which it announces defects.

Quantity                                    | Symbol | Name                     | Unit
------------------------------------------- | ------ | ------------------------ | ---------
number of balls                             | N_b    | n_balls                  |
ball diameter                               | D_b    | ball_diameter            | m
pitch diameter                              | D_p    | pitch_diameter           | m
unloaded contact angle                      | α0     | contact_angle            | rad
radius on which inner groove centres lie    | r_d    | groove_center_radius     | m
unloaded distance of the groove centres     | A0     | groove_center_distance   | m
radial clearance                            | r_L    | radial_clearance         | m
load-deflection factor of a ball            | K      | load_deflection_factor   | N/m^1.5
outer, inner raceway radius (groove bottom) | R_o, R_i | outer_, inner_raceway_radius | m
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from bearingcore import checks

GREATEST_CONTACT_ANGLE = math.radians(80.0)
"""Beyond this a bearing is a thrust bearing, for which the radial clearance loses its meaning."""


@dataclass(frozen=True)
class Bearing:
    """A single-row ball bearing as the contact model sees it (SI units, angles in rad).

    Parameters
    ----------
    n_balls
        number of balls N_b.
    ball_diameter, pitch_diameter
        D_b and D_p [m].
    contact_angle
        unloaded contact angle α0 [rad], at least 0 and at most 80°.
    groove_center_radius
        radius r_d [m] of the circle on which the inner groove's centres of curvature lie: the
        lever with which a tilt of the ring moves a ball's contact along z (Eq. 12).
    groove_center_distance
        distance A0 [m] between the groove centres of an unloaded ball (Eqs. 9, 10).
    radial_clearance
        r_L [m], on top of the contact angle (Eq. 11).
    load_deflection_factor
        K [N/m^1.5] of both contacts of a ball in series (Eq. 13).
    outer_raceway_radius, inner_raceway_radius
        radii R_o and R_i [m] at the bottom of the grooves; defects are cut there (Eq. 6).

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.

    Source: Petersen, Howard & Prime (2014), Sections 2.1 and 2.3.
    """

    n_balls: int
    ball_diameter: float
    pitch_diameter: float
    contact_angle: float
    groove_center_radius: float
    groove_center_distance: float
    radial_clearance: float
    load_deflection_factor: float
    outer_raceway_radius: float
    inner_raceway_radius: float

    def __post_init__(self) -> None:
        def keep(name: str, value: float) -> None:
            object.__setattr__(self, name, value)

        keep("n_balls", checks.whole_number("n_balls", self.n_balls, at_least=1, at_most=500))
        for name in (
            "ball_diameter",
            "pitch_diameter",
            "groove_center_radius",
            "groove_center_distance",
            "load_deflection_factor",
            "outer_raceway_radius",
            "inner_raceway_radius",
        ):
            keep(name, checks.number(name, getattr(self, name), above=0.0))
        keep(
            "contact_angle",
            checks.number(
                "contact_angle",
                self.contact_angle,
                at_least=0.0,
                at_most=GREATEST_CONTACT_ANGLE,
                unit="rad: 0 to 80 degrees",
            ),
        )
        keep(
            "radial_clearance",
            checks.number("radial_clearance", self.radial_clearance, at_least=0.0, unit="m"),
        )
        if self.ball_diameter >= self.pitch_diameter:
            raise checks.refuse(
                "ball_diameter",
                self.ball_diameter,
                f"below the pitch_diameter of {self.pitch_diameter:g} m",
            )
        if self.n_balls > 1:
            gap = self.pitch_diameter * math.sin(math.pi / self.n_balls)
            if gap < self.ball_diameter:
                raise checks.refuse(
                    "n_balls",
                    self.n_balls,
                    "so few that balls do not overlap: their centres would be "
                    f"{gap:g} m apart, the ball_diameter is {self.ball_diameter:g} m",
                )
        if not self.inner_raceway_radius < self.outer_raceway_radius:
            raise checks.refuse(
                "inner_raceway_radius",
                self.inner_raceway_radius,
                f"below the outer_raceway_radius of {self.outer_raceway_radius:g} m",
            )

    @property
    def ball_radius(self) -> float:
        """Ball radius r_b [m]."""
        return 0.5 * self.ball_diameter

    @property
    def ball_spacing(self) -> float:
        """Angle between neighbouring balls, 2π/N_b [rad] (Eq. 4)."""
        return 2.0 * math.pi / self.n_balls

    @cached_property
    def contact_numbers(self) -> tuple[int, float, float, float, float, float]:
        """N_b, cos α0, sin α0, A0, r_L, K: what the contact kernels need, in their order."""
        ca, sa = math.cos(self.contact_angle), math.sin(self.contact_angle)
        A0, rL, K = (
            self.groove_center_distance,
            self.radial_clearance,
            self.load_deflection_factor,
        )
        return self.n_balls, ca, sa, A0, rL, K

    @cached_property
    def _ratio(self) -> float:
        """D_b cos α0 / D_p, the number that all kinematics hang on."""
        return self.ball_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def cage_ratio(self) -> float:
        """Cage speed over shaft speed, (1 − D_b cos α0 / D_p)/2 (Eq. 3)."""
        return 0.5 * (1.0 - self._ratio)

    def cage_speed(self, shaft_speed: float) -> float:
        """Cage speed ω_c [rad/s] at a shaft speed ω_s [rad/s] (Eq. 3)."""
        return self.cage_ratio * shaft_speed

    def ftf(self, shaft_speed: float) -> float:
        """Fundamental train (cage) frequency f_c [Hz] at a shaft speed [rad/s]."""
        return self.cage_speed(shaft_speed) / (2.0 * math.pi)

    def bpfo(self, shaft_speed: float) -> float:
        """Ball-pass frequency of the outer race, N_b f_c [Hz], shaft speed in rad/s (Eq. 5)."""
        return self.n_balls * self.ftf(shaft_speed)

    def bpfi(self, shaft_speed: float) -> float:
        """Ball-pass frequency of the inner race, N_b (f_s − f_c) [Hz], shaft speed in rad/s."""
        return self.n_balls * (shaft_speed / (2.0 * math.pi) - self.ftf(shaft_speed))

    def bsf(self, shaft_speed: float) -> float:
        """Ball spin frequency, f_s D_p/(2 D_b) (1 − (D_b cos α0/D_p)²) [Hz], speed in rad/s."""
        shaft_frequency = shaft_speed / (2.0 * math.pi)
        lever = self.pitch_diameter / (2.0 * self.ball_diameter)
        return lever * shaft_frequency * (1.0 - self._ratio**2)
