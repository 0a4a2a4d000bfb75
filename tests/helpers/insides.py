"""Insides that are estimated from a designation, against those that are published."""

import csv
import math
from pathlib import Path
from typing import NamedTuple

from bearingcore.bearings import read_designation
from bearingcore.bearings._designation import inside_of

PUBLISHED = Path(__file__).parents[1] / "reference" / "published_insides.csv"


class Judged(NamedTuple):
    """A published inside and what the rule makes of it.

    Attributes
    ----------
    designation, source
        as listed.
    count, estimated_count
        balls or rollers, printed and estimated.
    printed_ratio
        D_b cos α/D_p as printed.
    ratio, frequency
        relative errors of the estimated ratio and of BPFO for one number of balls.
    """

    designation: str
    source: str
    count: int
    estimated_count: int
    printed_ratio: float
    ratio: float
    frequency: float

    @property
    def is_right(self) -> bool:
        """True where the number of balls is the printed one."""
        return self.count == self.estimated_count


def judged() -> list[Judged]:
    """All published insides."""
    text = PUBLISHED.read_text("utf-8").splitlines()
    lines = [line for line in text if not line.startswith("#")]
    return [_judged(line) for line in csv.DictReader(lines, delimiter=";")]


def _judged(line: dict[str, str]) -> Judged:
    inside = inside_of(read_designation(line["designation"]).basic)
    cosine = math.cos(math.radians(float(line["contact_angle_deg"])))
    gamma, printed = inside.ball_diameter / inside.pitch_diameter * cosine, float(line["ratio"])
    return Judged(
        line["designation"],
        line["source"],
        int(line["count"]),
        inside.n_balls,
        printed,
        gamma / printed - 1.0,
        (1.0 - gamma) / (1.0 - printed) - 1.0,
    )
