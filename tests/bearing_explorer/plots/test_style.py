"""Numbers, units and words in the house style."""

import math

import pytest
from bearing_explorer.plots import style


@pytest.mark.parametrize(
    ("value", "unit", "expected"),
    [
        (2061.6, "N", "2.06 kN"),
        (48.62, "N", "48.6 N"),
        (-100.0, "N", "−100 N"),
        (5e-5, "m", "50 µm"),
        (999.96, "N", "1 kN"),
        (0.0, "N", "0 N"),
        (1.2345e8, "N/m", "123 MN/m"),
        (math.nan, "N", "no value"),
    ],
)
def test_prefixes(value: float, unit: str, expected: str) -> None:
    assert style.with_prefix(value, unit) == expected


def test_angles_lie_between_0_and_360() -> None:
    written = [style.in_degrees(math.radians(x)) for x in (257.14, -90.0, 359.99, 720.0, 12.5)]
    assert written == ["257.1°", "270°", "0°", "0°", "12.5°"]
