"""Numbers, units and words in the house style."""

import math

import pytest
from bearing_explorer.plots import style
from bokeh.models import Range1d


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


def test_words_in_a_row() -> None:
    assert [style.list_words(list("abc")[:n]) for n in range(4)] == [
        "",
        "a",
        "a and b",
        "a, b and c",
    ]


def test_the_label_of_an_axis_has_name_symbol_and_prefixed_unit() -> None:
    assert style.BALL_LOAD.label(50.0) == "Contact load Q (N)"
    assert style.BALL_LOAD.label(1400.0) == "Contact load Q (kN)"
    assert style.CAGE_ANGLE.label(4000.0) == "Cage angle φc (°)"


def test_a_figure_has_fixed_ranges_and_labelled_axes() -> None:
    x, y = Range1d(0.0, 360.0), Range1d(0.0, 2500.0)
    plot = style.make_figure(style.BALL_ANGLE, style.BALL_LOAD, x, y)
    assert plot.x_range is x
    assert plot.y_range is y
    assert plot.xaxis[0].axis_label == "Angular position φ (°)"
    assert plot.yaxis[0].axis_label == "Contact load Q (kN)"
    assert plot.output_backend == "canvas"
