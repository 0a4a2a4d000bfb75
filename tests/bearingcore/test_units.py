"""Numbers with units, as people type them."""

import math

import pytest

from bearingcore.units import UNITS, read_number


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0,5", "mm", 0.5),
        ("8mm", "m", 8e-3),
        ("12 µm", "mm", 12e-3),
        ("12 μm", "mm", 12e-3),  # a Greek letter
        ("5/16 in", "mm", 7.9375),
        ("1 1/4 inch", "mm", 31.75),
        ("−1 1/2", "", -1.5),
        ("1797 rpm", "Hz", 29.95),
        ("180 °", "rad", math.pi),
        *(
            ("3 kN", "N", 3000.0),
            ("1 MN", "kN", 1000.0),
            ("2 mN", "N", 2e-3),
            ("1 kgf", "N", 9.80665),
        ),
        *(("200 N/mm", "MN/m", 0.2), ("3 kN/mm", "N/m", 3e6), ("210000 MPa", "GPa", 210.0)),
        *(("850 g", "kg", 0.85), ("25.6 kHz", "Hz", 25600.0), ("20 nm", "mm", 2e-5)),
        *(("3 kNm", "N·m", 3e3), ("4 Nm", "N·m", 4.0), ("210000 N/mm²", "Pa", 2.1e11)),
    ],
)
def test_numbers_with_units(text: str, unit: str, value: float) -> None:
    assert read_number(text, unit) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        *(("", "mm"), ("mm", "mm"), ("eight", "mm"), ("3 rpm", "mm"), ("3 bananas", "mm")),
        *(("1/0 in", "mm"), ("1e999", "mm"), ("nan", "mm"), ("1_000", "mm"), ("8 mm 3", "mm")),
        *(("5 mm", ""), ("1 m", "N"), ("1 xN", "N"), ("--3", "mm"), ("1.2.3", "mm"), ("٣", "mm")),
    ],
)
def test_what_is_no_number_of_a_unit_is_refused(text: str, unit: str) -> None:
    with pytest.raises(ValueError, match="no"):
        read_number(text, unit)


def test_every_unit_reads_its_own_numbers() -> None:
    for unit in UNITS:
        if unit not in ("", "1"):
            assert read_number(f"2.5 {unit}", unit) == 2.5
