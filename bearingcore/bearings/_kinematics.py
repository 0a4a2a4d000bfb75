"""Speeds and frequencies of a row of elements that roll without slipping, outer ring at rest."""

from __future__ import annotations

import math
from dataclasses import dataclass

from bearingcore.common import _checks as checks, cached_property

GREATEST_CONTACT_ANGLE = math.radians(80.0)
"""Beyond this angle a bearing is a thrust bearing, and a radial clearance has no meaning."""


def check_contact_angle(angle: float, name: str = "contact_angle") -> float:
    """Return the unloaded contact angle [rad] as a float, else raise ValueError."""
    most, note = GREATEST_CONTACT_ANGLE, "0 to 80 degrees"
    return checks.real_number(name, angle, at_least=0.0, at_most=most, unit="rad", note=note)


@dataclass(frozen=True)
class Kinematics:
    """Numbers that speeds and frequencies depend on: N_b, D_b and D_p [m], and α0 [rad]."""

    n_balls: int
    ball_diameter: float
    pitch_diameter: float
    contact_angle: float

    def __post_init__(self) -> None:
        count = checks.whole_number("n_balls", self.n_balls, at_least=1, at_most=500)
        checks.keep(self, n_balls=count)
        for name in ("ball_diameter", "pitch_diameter"):
            checks.keep_number(self, name, above=0.0)
        checks.keep(self, contact_angle=check_contact_angle(self.contact_angle))

    @cached_property
    def size_ratio(self) -> float:
        """D_b cos α0 / D_p, the number that all kinematics depend on."""
        return self.ball_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def ball_radius(self) -> float:
        """Ball radius r_b [m]."""
        return 0.5 * self.ball_diameter

    @property
    def ball_spacing(self) -> float:
        """Angle between neighbouring balls, 2π/N_b [rad] (Eq. 4).

        It holds for rows without their own number of balls: see `Bearing.period`.
        """
        return 2.0 * math.pi / self.n_balls

    @property
    def cage_ratio(self) -> float:
        """Cage speed over shaft speed, (1 − D_b cos α0 / D_p)/2 (Eq. 3).

        Like all speeds and frequencies it follows from the bearing's own numbers; for a row with
        other numbers use `of_row(k)`.
        """
        return 0.5 * (1.0 - self.size_ratio)

    def cage_speed(self, shaft_speed: float) -> float:
        """Return the cage speed ω_c [rad/s] at a shaft speed ω_s [rad/s] (Eq. 3)."""
        return self.cage_ratio * shaft_speed

    def ftf(self, shaft_speed: float) -> float:
        """Return the fundamental train (cage) frequency f_c [Hz] at a shaft speed [rad/s]."""
        return self.cage_speed(shaft_speed) / (2.0 * math.pi)

    def bpfo(self, shaft_speed: float) -> float:
        """Return the outer ball-pass frequency N_b f_c [Hz] at a shaft speed [rad/s] (Eq. 5)."""
        return self.n_balls * self.ftf(shaft_speed)

    def bpfi(self, shaft_speed: float) -> float:
        """Return the inner ball-pass frequency N_b (f_s − f_c) [Hz] at a shaft speed [rad/s]."""
        return self.n_balls * (shaft_speed / (2.0 * math.pi) - self.ftf(shaft_speed))

    def bsf(self, shaft_speed: float) -> float:
        """Return the ball spin frequency [Hz] at a shaft speed [rad/s].

        It is f_s D_p/(2 D_b) (1 − (D_b cos α0/D_p)²).
        """
        shaft_frequency = shaft_speed / (2.0 * math.pi)
        lever = self.pitch_diameter / (2.0 * self.ball_diameter)
        return lever * shaft_frequency * (1.0 - self.size_ratio**2)
