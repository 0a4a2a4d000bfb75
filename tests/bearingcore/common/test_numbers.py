"""Numbers in sentences: as many digits as mean something, never a computer's own notation."""

from __future__ import annotations

import ast
import math
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bearingcore.common import numbers


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.0, 3, "0"),
        (50.0, 3, "50"),
        (1389.4, 3, "1389"),
        (-0.4, 3, "−0.4"),
        (0.00012345, 3, "0.000123"),
        (7.94e-12, 3, "7.94·10⁻¹²"),
        (-2.0e9, 2, "−2·10⁹"),
        (math.nan, 3, "no value"),
        (-math.inf, 3, "no value"),
    ],
)
def test_significant_digits(value: float, digits: int, text: str) -> None:
    assert numbers.number(value, digits) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (2061.6, "N", "2.06 kN"),
        (999.96, "N", "1 kN"),
        (0.0, "N/m", "0 N/m"),
        (7.94e-24, "N/m", "7.94·10⁻²⁴ N/m"),  # no prefix reaches so far
        (2.3e-15, "N/m", "0.0023 pN/m"),
        (3.2e21, "Hz", "3.2·10²¹ Hz"),
        (-3.2e-6, "m", "−3.2 µm"),
        (math.inf, "s", "no value"),
    ],
)
def test_prefixes(value: float, unit: str, text: str) -> None:
    assert numbers.with_prefix(value, unit) == text


@pytest.mark.parametrize(
    ("share", "text"),
    [(24.8, "2480 %"), (0.1254, "12.5 %"), (1.0, "100 %"), (1e-6, "below 0.01 %"), (0.0, "0 %")],
)
def test_shares(share: float, text: str) -> None:
    assert numbers.percent(share) == text


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0031, "+0.3 %"), (-0.012, "−1.2 %"), (-0.0001, "0.0 %"), (0.0, "0.0 %"), (1.5, "+150.0 %"),
     (math.nan, "no value")],
)  # fmt: skip
def test_how_far_off(share: float, text: str) -> None:
    assert numbers.percent_off(share) == text


def test_no_sentence_writes_percents_or_powers_of_ten_by_itself() -> None:
    """Python's own ways, "-0.1%" and "2.48e+03", are for files; tables of experiments print."""
    root = Path(__file__).parents[3]
    files = [*(root / "app").rglob("*.py"), *(root / "bearingcore").rglob("*.py")]
    found = []
    for file in files:
        if file.name == "numbers.py" or "experiments" in file.parts:
            continue
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.FormattedValue) or node.format_spec is None:
                continue
            spec = ast.unparse(node.format_spec)
            if re.search(r"[%eE]'$", spec):
                found.append(f"{file.relative_to(root)}:{node.lineno} {spec}")
    assert found == []


@pytest.mark.parametrize(
    ("chance", "text"),
    [(1.0, "above 99 %"), (0.9901, "above 99 %"), (0.98, "98 %"),
     (0.004, "below 1 %"), (0, "below 1 %")],
)  # fmt: skip
def test_nothing_is_certain(chance: float, text: str) -> None:
    assert numbers.probability(chance) == text


@given(st.floats(0.0, 1.0))
def test_no_probability_reads_as_certain(chance: float) -> None:
    """Whatever rounding does: "100 %" beside "above 99 %" is never written."""
    assert numbers.probability(chance) not in ("100 %", "0 %")


@pytest.mark.parametrize(
    ("level", "text"),
    [(math.inf, "unlimited"), (-math.inf, "none"), (0.0123, "0.012 dB"), (2e-5, "below 0.001 dB"),
     (-6.02, "−6 dB"), (math.nan, "no value")],
)  # fmt: skip
def test_levels(level: float, text: str) -> None:
    assert numbers.decibels(level) == text


@pytest.mark.parametrize(
    ("value", "deviation", "text"),
    [
        (62.19, 0.31, "62.2° ± 0.3°"),
        (42.171, 0.032, "42.17° ± 0.03°"),
        (42.171, 0.096, "42.2° ± 0.1°"),
        (42.6, 12.2, "43° ± 12°"),
        (-1.0, 0.0, "−1.0° ± 0.0°"),
        (math.nan, 0.1, "no value"),
    ],
)
def test_numbers_with_deviations(value: float, deviation: float, text: str) -> None:
    assert numbers.with_deviation(value, deviation, "°") == text


def test_counts_and_spans() -> None:
    assert [numbers.count(n, "limit") for n in (0, 1, 2)] == ["no limits", "1 limit", "2 limits"]
    assert numbers.count(2, "ball pass", "ball passes") == "2 ball passes"
    assert numbers.span(365.2, 436.4, "Hz") == "365 to 436 Hz"
    assert numbers.span(0.0, 0.0, "Hz") == "0 Hz"
    assert numbers.span(670.1, 670.2, "Hz") == "670 Hz"
    assert numbers.span(math.nan, 1.0, "Hz") == "no value"
    assert numbers.prefixed_span(11.1e6, 20.1e6, "N/m") == "11.1 to 20.1 MN/m"
    assert numbers.prefixed_span(962.0, 20.1e3, "N/m") == "962 N/m to 20.1 kN/m"
    assert numbers.prefixed_span(0.0, 1.56e3, "N") == "0 to 1.56 kN"
    assert numbers.prefixed_span(math.nan, math.nan, "N") == "no value"
    assert numbers.thousands(65536.0) == "65\u202f536"


@given(st.floats(-1e300, 1e300) | st.sampled_from([math.nan, math.inf]), st.integers(1, 6))
def test_every_number_can_be_read(value: float, digits: int) -> None:
    """Short, without the letters of a computer, and read back to the digits asked for."""
    text = numbers.number(value, digits)
    if not math.isfinite(value):
        assert text == "no value"
        return
    assert len(text) <= digits + 12
    found = re.fullmatch(r"(−?\d+(?:\.\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?", text)
    assert found, text
    plain = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")
    exponent = found[2].translate(plain) if found[2] else "0"
    read = float(f"{found[1].translate(plain)}e{exponent}")
    assert read == pytest.approx(value, rel=0.5001 * 10.0 ** (1 - digits), abs=1e-320)
