"""Numbers in sentences: as many digits as mean something, never a computer's own notation."""

import math
import re
from collections.abc import Callable

import pytest
from hypothesis import given as drawn, strategies as st

from bearingcore.common import _numbers as numbers

WRITTEN: list[tuple[Callable[..., str], tuple[object, ...], str]] = [
    (numbers.number, (0.0, 3), "0"),
    (numbers.number, (1389.4, 3), "1389"),
    (numbers.number, (-0.4, 3), "−0.4"),
    (numbers.number, (0.00012345, 3), "0.000123"),
    (numbers.number, (7.94e-12, 3), "7.94·10⁻¹²"),
    (numbers.number, (-math.inf, 3), "no value"),
    (numbers.with_prefix, (2061.6, "N"), "2.06 kN"),
    (numbers.with_prefix, (999.96, "N"), "1 kN"),
    (numbers.with_prefix, (7.94e-24, "N/m"), "7.94·10⁻²⁴ N/m"),  # no prefix reaches so far
    (numbers.with_prefix, (3.2e21, "Hz"), "3.2·10²¹ Hz"),
    (numbers.with_prefix, (-3.2e-6, "m"), "−3.2 µm"),
    (numbers.with_prefix, (0.0, "N"), "0 N"),
    (numbers.with_prefix, (math.nan, "N"), "no value"),
    (numbers.percent, (0.1254,), "12.5 %"),
    (numbers.percent, (1e-6,), "below 0.01 %"),
    (numbers.percent_off, (0.0031,), "+0.3 %"),
    (numbers.percent_off, (-0.0001,), "0.0 %"),
    (numbers.percent_off, (math.nan,), "no value"),
    (numbers.probability, (0.9901,), "above 99 %"),
    (numbers.probability, (0.98,), "98 %"),
    (numbers.probability, (0.004,), "below 1 %"),
    (numbers.decibels, (math.inf,), "unlimited"),
    (numbers.decibels, (-math.inf,), "none"),
    (numbers.decibels, (0.0123,), "0.012 dB"),
    (numbers.decibels, (2e-5,), "below 0.001 dB"),
    (numbers.with_deviation, (42.171, 0.096, "°"), "42.2° ± 0.1°"),
    (numbers.with_deviation, (42.6, 12.2, "°"), "43° ± 12°"),
    (numbers.with_deviation, (math.nan, 0.1, "°"), "no value"),
]


@pytest.mark.parametrize(("write", "given", "text"), WRITTEN)
def test_numbers_in_words(write: Callable[..., str], given: tuple[object, ...], text: str) -> None:
    assert write(*given) == text


@drawn(st.floats(0.0, 1.0))
def test_no_probability_reads_as_certain(chance: float) -> None:
    """Whatever rounding does: "100 %" beside "above 99 %" is never written."""
    assert numbers.probability(chance) not in ("100 %", "0 %")


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


@drawn(st.floats(-1e300, 1e300) | st.sampled_from([math.nan, math.inf]), st.integers(1, 6))
def test_every_number_can_be_read(value: float, digits: int) -> None:
    """Short, without the letters of a computer, and read back to the digits asked for."""
    text = numbers.number(value, digits)
    if not math.isfinite(value):
        assert text == "no value"
        return
    assert len(text) <= digits + 12
    match = re.fullmatch(r"(−?\d+(?:\.\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?", text)
    assert match, text
    plain = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")
    exponent = match[2].translate(plain) if match[2] else "0"
    read = float(f"{match[1].translate(plain)}e{exponent}")
    assert read == pytest.approx(value, rel=0.5001 * 10.0 ** (1 - digits), abs=1e-320)
