"""Figures for notebooks: what they draw is what was computed, with names, units and the colours."""

from __future__ import annotations

import math
import re
from pathlib import Path

import holoviews as hv
import numpy as np
import pytest
from bearing_explorer import plotting
from bearing_explorer.plots import style
from bearing_explorer.plots.style import AxisQuantity
from bearing_explorer.plotting.plane import NO_ANSWER, Field, Section
from bearing_explorer.plotting.style import color_scale
from bokeh.models import LayoutDOM
from holoviews.plotting.util import get_nested_streams

from bearingcore import (
    STIFFNESS_TERMS,
    Spectrum,
    equilibrium,
    modes,
    orbit,
    presets,
    simulate,
    spectrum,
    stiffness_maps,
)
from bearingcore.diagnosis.size.sizing_error import extent_error

SCENE = presets["fan-rig"].replace(extent=math.radians(38.6), depth=50e-6, fy=-100.0)
STATE = equilibrium(SCENE)
HEALTHY = equilibrium(SCENE.healthy())


def drawn(figure: object) -> LayoutDOM:
    """The Bokeh model that HoloViews makes of it."""
    return hv.render(figure, backend="bokeh")


def labels(figure: object) -> list[str]:
    """Labels of the axes, upright and level, of a single figure."""
    made = drawn(figure)
    return [made.xaxis[0].axis_label, made.yaxis[0].axis_label]


def test_load_distribution_draws_the_loads_and_where_the_balls_are() -> None:
    figure = plotting.load_distribution(STATE, healthy=HEALTHY, cage_angle=0.1)
    kinds = [type(element).__name__ for element in figure]
    assert kinds == ["Curve", "Curve", "Points"]
    curve = figure.get(1)
    assert [(d.name, d.unit) for d in curve.dimensions()] == [
        ("angular_position_deg", "°"),
        ("ball_load", "N"),
    ]
    assert curve.range("ball_load")[1] == pytest.approx(np.nanmax(STATE.ball_load))
    at = np.abs(STATE.cage_angles - 0.1).argmin()
    np.testing.assert_array_equal(figure.get(2)["ball_load"], STATE.ball_load[at])
    assert hv.Store.lookup_options("bokeh", curve, "style").kwargs["color"] == style.DEFECTIVE
    assert labels(figure) == ["Angular position φ (°)", "Ball load Q (N)"]


def test_stiffness_has_a_curve_for_each_term() -> None:
    figure = plotting.stiffness(STATE, ["k_xx", "k_yy"], healthy=HEALTHY)
    assert [element.label for element in figure][2:] == ["kxx", "kyy"]
    np.testing.assert_array_equal(figure.get(3)["stiffness"], STATE.term("k_yy"))
    assert labels(figure) == ["Cage angle φc (°)", "Stiffness k (MN/m)"]
    with pytest.raises(ValueError, match="one unit"):
        plotting.stiffness(STATE, ["k_xx", "k_rxrx"])
    with pytest.raises(ValueError, match="stiffness term"):
        plotting.stiffness(STATE, ["k_ab"])


def test_modes_have_bands_and_colours_of_their_directions() -> None:
    found = modes(SCENE)
    figure = plotting.modes(found, healthy=modes(SCENE.healthy()))
    curves = {e.label: e for e in figure if isinstance(e, hv.Curve) and e.label}
    assert list(curves) == ["x₁", "y₁", "x₂", "y₂"]
    np.testing.assert_array_equal(
        curves["y₁"]["natural_frequency"], found.frequency[:, found.label.index("y1")]
    )
    options = hv.Store.lookup_options("bokeh", curves["y₁"], "style").kwargs
    assert options["color"] == style.DIRECTION_COLORS[1]
    bands = [e for e in figure if isinstance(e, hv.Area)]
    assert len(bands) == 4
    drawn(figure)


def test_maps_lie_the_right_way_up() -> None:
    found = stiffness_maps(SCENE, np.radians(np.linspace(0.0, 60.0, 13)))
    figure = plotting.maps(found, ["loaded_balls", "k_yy", "k_xy"])
    assert isinstance(figure, hv.Layout)
    assert len(figure) == 3
    image = plotting.maps(found, ["k_yy"])
    assert [(d.name, d.unit) for d in image.dimensions()] == [
        ("cage_angle_deg", "°"),
        ("extent_deg", "°"),
        ("k_yy", "N/m"),
    ]
    place = image[math.degrees(found.cage_angles[7]), 60.0]
    assert place == pytest.approx(found.term("k_yy")[12, 7])
    drawn(figure)


def test_motion_spectra_and_orbit() -> None:
    motion = simulate(SCENE, duration=0.5)
    curve = plotting.motion(motion, "y", last=0.1)
    assert len(curve) == round(0.1 * motion.sample_rate)
    assert curve["acceleration_y"][-1] == motion.outer_acceleration[-1, 1]
    assert curve.get_dimension("acceleration_y").unit == "m/s²"
    found = spectrum(motion.outer_acceleration[:, 1], motion.sample_rate)
    density = plotting.spectrum(found, highest=4000.0)
    k = 10
    assert density["density_db"][k] == pytest.approx(10.0 * math.log10(found.density[k + 1]))
    assert density["frequency"][-1] <= 4000.0
    both = plotting.spectrum({"one": found, "other": found})
    assert [element.label for element in both] == ["one", "other"]
    closed = orbit(SCENE)
    path = plotting.orbit(closed)
    ends = path.data[0]
    first = [float(ends[way][0]) for way in "xy"]
    assert [float(ends[way][-1]) for way in "xy"] == pytest.approx(first, rel=1e-3)
    for figure in (curve, density, both, path):
        drawn(figure)
    with pytest.raises(ValueError, match="dof"):
        plotting.motion(motion, "z")
    with pytest.raises(ValueError, match="a spectrum for each"):
        plotting.spectrum(Spectrum(found.frequency, np.ones((found.frequency.size, 2))))


FIELD = Field(
    ("extent_deg", AxisQuantity("Extent", "Δφf", "°"), np.array([10.0, 20.0, 30.0])),
    ("fy_n", AxisQuantity("Force, up", "Fy", "N"), np.array([-200.0, -100.0])),
    ("k_yy_mean", AxisQuantity("kyy, mean", "", "N/m", prefixed=True)),
    np.array([[1e6, 2e6, 3e6], [4e6, math.nan, 6e6]]),
    np.array([["", "", ""], ["", "nothing touches", ""]], dtype=object),
    (12.0, -110.0),
)


def test_a_plane_is_a_map_with_lines_across_it_a_histogram_and_the_gaps() -> None:
    news = hv.streams.Pipe(data=FIELD)
    figure = plotting.plane(FIELD, news=news)
    made = drawn(figure)
    assert isinstance(made, LayoutDOM)
    overlay, up, across, histogram = (part[()] for part in figure)
    image, gaps, veil = overlay
    assert image[30.0, -200.0] == 3e6
    assert image.bounds.lbrt() == (5.0, -250.0, 35.0, -50.0)
    assert gaps.data.values.tolist() == [[15.0, -150.0, 25.0, -50.0, "nothing touches"]]
    assert NO_ANSWER in str(hv.Store.lookup_options("bokeh", gaps, "style").kwargs)
    assert veil.dimension_values("not_selected").tolist() == [0.0] * 6
    # through the place that is nearest to `at`
    assert across["k_yy_mean"].tolist()[0::2] == [4e6, 6e6]
    assert up["k_yy_mean"].tolist() == [1e6, 4e6]
    assert histogram["points"].sum() == 5
    assert [d.unit for d in image.dimensions()] == ["°", "N", "N/m"]
    assert any(isinstance(link, Section) for links in Section.registry.values() for link in links)


def test_a_selection_of_values_leaves_those_bright() -> None:
    figure = plotting.plane(FIELD)
    overlay = figure.values()[0]
    streams = get_nested_streams(overlay)
    selection = next(s for s in streams if isinstance(s, hv.streams.BoundsX))
    selection.event(boundsx=(1.5e6, 4.5e6))
    veil = overlay[()].get(2)
    covered = veil.dimension_values("not_selected", flat=False)
    # the lower row first; what has no answer is not selected either
    assert covered.tolist() == [[1.0, 0.0, 0.0], [0.0, 1.0, 1.0]]


def test_an_output_of_a_sweep_is_drawn_in_the_units_of_the_page() -> None:
    xarray = pytest.importorskip("xarray")
    swept = xarray.DataArray(
        np.arange(6.0).reshape(2, 3),
        dims=("fy", "extent"),
        coords={
            "fy": ("fy", [-200.0, -100.0], {"units": "N"}),
            "extent": ("extent", np.radians([10.0, 20.0, 30.0]), {"units": "rad"}),
        },
        attrs={"units": "m/s²"},
        name="acceleration_rms_y",
    )
    field = Field.of_sweep(swept)
    assert field.x[0] == "extent_deg"
    assert field.x[2] == pytest.approx([10.0, 20.0, 30.0])
    assert field.y[1].unit == "N"
    drawn(plotting.plane(swept))
    with pytest.raises(ValueError, match="two"):
        plotting.plane(swept.isel(fy=0))


def test_a_sizing_shows_its_candidates_and_says_what_follows() -> None:
    found = extent_error(SCENE).sizing
    figure = plotting.sizing(found, true_extent=math.radians(38.6))
    spikes = figure.get(0)
    assert spikes["probability"].tolist() == [c.probability for c in found.candidates]
    np.testing.assert_allclose(
        spikes["extent_deg"], [math.degrees(c.extent) for c in found.candidates]
    )
    made = drawn(figure)
    assert made.title.text.replace("\n", " ") == found.status
    assert labels(figure) == ["Extent Δφf (°)", "Probability P"]


def test_colours_are_light_at_zero_where_numbers_have_both_signs() -> None:
    palette, limits = color_scale(np.array([-1.0, np.nan, 3.0]))
    assert limits == (-3.0, 3.0)
    assert sum(int(palette[128][i : i + 2], 16) for i in (1, 3, 5)) > 700
    assert color_scale(np.array([2.0, 5.0]))[1] == (2.0, 5.0)
    low, high = color_scale(np.zeros(4))[1]
    assert low < 0.0 < high
    assert color_scale(np.full(3, np.nan))[1] == (0.0, 1.0)


def test_every_term_has_its_name() -> None:
    for term in STIFFNESS_TERMS:
        plotting.stiffness(STATE, [term])


def test_a_saved_figure_needs_nothing_from_outside(tmp_path: Path) -> None:
    """Nor style sheets: each that the figure names by an address would be asked for."""
    file = tmp_path / "figure.html"
    both = plotting.stiffness(STATE, ["k_yy"]) + plotting.load_distribution(STATE)
    hv.save(both, str(file), resources="inline")
    text = file.read_text(encoding="utf-8")
    assert re.findall(r"https?://[^\s\"\\\\]+\.css", text) == []
    assert re.findall(r"<script[^>]+src=|<link[^>]+stylesheet", text) == []
