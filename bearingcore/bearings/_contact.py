"""The contact of an element with both races, and how its line moves with the inner ring.

A ball touches its grooves along the line through their centres of curvature, A0 apart: the line
turns with the displacement, as the inner centre moves against the outer one. A roller touches
straight races along a line that no displacement turns. If the inner centres of a row are
A0 cos α0 from the shaft and A0 sin α0 from the middle of the bearing, all lines pass through that
middle, and an inner ring that turns about it moves no ball: the row is self-aligning.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from bearingcore.common import _checks as checks


class Contact(NamedTuple):
    """Numbers that all contacts of a row have in common.

    Attributes
    ----------
    angle
        α0 [rad] of the unloaded line of contact.
    lever
        r_d [m], from the shaft to the point of the line that a tilt of the inner ring moves.
    beyond
        [m] along the shaft from the place of the row to that point, positive the way the row faces.
    factor, exponent
        of load over compression, Q = K δ^n [N/m^n].
    room
        greatest compression [m] that the geometry allows, and displacement along straight races.
    center_distance
        A0 [m] of the groove centres about which the line turns. None: the line is fixed.
    """

    angle: float
    lever: float
    beyond: float
    factor: float
    exponent: float
    room: float
    center_distance: float | None

    def play(self, clearance: float) -> float:
        """Return the radial play [m] of the inner ring from contact to contact, grooves opposite.

        2 (A0 (1 − cos α0) + r_L), the sum of what contact angle and clearance allow; 2 r_L where
        the line is fixed.
        """
        if self.center_distance is None:
            return 2.0 * clearance
        # 1 − cos α0 without cancellation
        return 4.0 * self.center_distance * math.sin(0.5 * self.angle) ** 2 + 2.0 * clearance

    def free_angle(self, clearance: float) -> float:
        """Return the angle α_f [rad] of the ring pushed along the shaft until the elements touch.

        cos α_f = cos α0 − r_L/A0; 0 where an interference leaves no play, α0 for a fixed line.
        ValueError where the clearance lets the ring slip through.
        """
        if self.center_distance is None:
            return self.angle
        if math.cos(self.angle) - clearance / self.center_distance < 0.0:
            raise checks.refuse(
                "radial_clearance",
                clearance,
                "at most {most:m}, or the ring slips through along the shaft",
                most=self.center_distance * math.cos(self.angle),
            )
        # half-angle form, which keeps its digits where α_f is small
        play = max(self.play(clearance), 0.0)
        return 2.0 * math.asin(math.sqrt(0.25 * play / self.center_distance))
