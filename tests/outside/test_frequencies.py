"""Frequencies of bearings as others print them."""

from __future__ import annotations

import pytest

from bearingcore import Bearing
from tests.outside.witness import witness

TURN = 6.283185307179586
"""[rad/s] of one turn a second: frequencies are orders then."""

PYBEARING = {
    "NMB 1560kk": (7, 2.770, 10.514, 0.3683, 1.7661, 2.5779, 4.4221),
    "NMB 608DSD81": (7, 3.950, 14.974, 0.3681, 1.7635, 2.5767, 4.4233),
    "WTOO 608RS": (7, 3.960, 15.014, 0.3681, 1.7638, 2.5769, 4.4231),
    "Allout 608ZZ": (7, 3.968, 15.016, 0.3679, 1.7600, 2.5751, 4.4249),
}
"""Balls, their diameter and the pitch circle [mm]; orders of cage, spin, outer and inner race.

Source: the database of pybearing 1.0.4 (PyPI), printed by the makers.
"""

TEST_RIGS = {
    "MB ER-16K": (9, 7.9375, 38.50, 0.3969, 2.32, 3.572, 5.428),
    "6205, drive end": (9, 0.3126, 1.537, 0.39828, 0.5 * 4.7135, 3.5848, 5.4152),
}
"""The same of two public rigs, the spin of the second printed as twice that of a ball.

Sources: readme of the Curtin University measurements (2012); Case Western Reserve University.
"""


@witness(
    "ball bearing: ball-pass frequencies",
    by="database of pybearing 1.0.4, Curtin University, Case Western Reserve University",
    compared="four frequencies of six bearings",
    within=0.0012,
)
@pytest.mark.parametrize(
    ("name", "within"),
    [*((name, 1e-4) for name in PYBEARING), *((name, 1.2e-3) for name in TEST_RIGS)],
)
def test_frequencies_are_the_printed_ones(name: str, within: float) -> None:
    """Sources stand above; Curtin prints three digits."""
    count, ball, pitch, *printed = (PYBEARING | TEST_RIGS)[name]
    bearing = Bearing.from_drawing(
        int(count), ball, pitch, 0.52 * ball, 0.53 * ball, contact_angle=0.0
    )
    frequencies = (bearing.ftf(TURN), bearing.bsf(TURN), bearing.bpfo(TURN), bearing.bpfi(TURN))
    assert frequencies == pytest.approx(printed, rel=within, abs=6e-5)
