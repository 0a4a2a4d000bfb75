"""A map over two quantities: what it draws is what was computed, with names, units and colours."""

from __future__ import annotations

import math
import re
from pathlib import Path

import holoviews as hv
import numpy as np
import pytest
from bearing_explorer.plots.plane import NO_ANSWER, Field, Section, color_scale, plane
from bearing_explorer.plots.style import AxisQuantity
from bokeh.models import LayoutDOM
from holoviews.plotting.util import get_nested_streams


def drawn(figure: object) -> LayoutDOM:
    """The Bokeh model that HoloViews makes of it."""
    return hv.render(figure, backend="bokeh")


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
    figure = plane(FIELD, news=news)
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
    figure = plane(FIELD)
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
    drawn(plane(swept))
    with pytest.raises(ValueError, match="two"):
        plane(swept.isel(fy=0))


def test_colours_are_light_at_zero_where_numbers_have_both_signs() -> None:
    palette, limits = color_scale(np.array([-1.0, np.nan, 3.0]))
    assert limits == (-3.0, 3.0)
    assert sum(int(palette[128][i : i + 2], 16) for i in (1, 3, 5)) > 700
    assert color_scale(np.array([2.0, 5.0]))[1] == (2.0, 5.0)
    low, high = color_scale(np.zeros(4))[1]
    assert low < 0.0 < high
    assert color_scale(np.full(3, np.nan))[1] == (0.0, 1.0)


def test_a_saved_map_needs_nothing_from_outside(tmp_path: Path) -> None:
    """Nor style sheets: each that it names by an address would be asked for."""
    file = tmp_path / "figure.html"
    hv.save(plane(FIELD), str(file), resources="inline")
    text = file.read_text(encoding="utf-8")
    assert re.findall(r"https?://[^\s\"\\\\]+\.css", text) == []
    assert re.findall(r"<script[^>]+src=|<link[^>]+stylesheet", text) == []
