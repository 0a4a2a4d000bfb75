"""A map over two quantities: what it draws is what was computed, with names, units and colours."""

import math

import holoviews as hv
import numpy as np
import pytest
from bearing_explorer import figures
from bearing_explorer.explorer.plots.plane import Field, PlaneFigures, color_limits
from bearing_explorer.kit.plots.heat_map import Side
from bearing_explorer.kit.serve.packed_source import PackedSource
from bokeh.models import LayoutDOM

X, Y = (
    Side("extent_deg", "Length of the defect", "Δφf", "°"),
    Side("fy_n", "Load, upwards", "Fy", "N"),
)
FIELD = Field(
    (X, np.array([10.0, 20.0, 30.0])),
    (Y, np.array([-200.0, -100.0])),
    "kyy, mean",
    "N/m",
    np.array([[1e6, 2e6, 3e6], [4e6, math.nan, 6e6]]),
    np.array([["", "", ""], ["", "nothing touches", ""]], dtype=object),
)


def test_a_plane_is_a_map_with_lines_across_it_and_reasons() -> None:
    plane = PlaneFigures(packed := PackedSource(), "plane", [X, Y])
    sources, ranges = plane.data(FIELD, (12.0, -110.0))
    assert packed.pack(sources, ranges).size > 6
    cells = sources["plane_cells"]["packed"][9:].reshape(2, 2, 3)
    np.testing.assert_array_equal(cells[0], FIELD.values / 1e6)
    assert cells[1, 1, 1] not in cells[1, 0]
    assert ranges["plane_x"] == (5.0, 35.0)
    assert ranges["plane_y"] == (-250.0, -50.0)
    assert ranges["plane_colors"] == (1.0, 6.0)
    plane.write(FIELD)
    labels = [(p.xaxis[0].axis_label, p.yaxis[0].axis_label) for p in plane.plots[1:]]
    assert labels == [
        ("Load, upwards Fy (N)", "(MN/m)"),
        ("Length of the defect Δφf (°)", "(MN/m)"),
    ]


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
    assert field.x[0].label == "Length of the defect (°)"
    assert field.x[1] == pytest.approx([10.0, 20.0, 30.0])
    drawn = figures.of_sweep(swept)
    assert isinstance(hv.render(drawn, backend="bokeh"), LayoutDOM)
    image = drawn.main
    assert image[30.0, -100.0] == 5.0
    assert [d.unit for d in image.dimensions()] == ["°", "N", "m/s²"]
    with pytest.raises(ValueError, match="two"):
        figures.of_sweep(swept.isel(fy=0))


def test_colours_are_light_at_zero_where_numbers_have_both_signs() -> None:
    assert color_limits(np.array([-1.0, np.nan, 3.0])) == (-3.0, 3.0)
    assert color_limits(np.array([2.0, 5.0])) == (2.0, 5.0)
    low, high = color_limits(np.zeros(4))
    assert low < 0.0 < high
    assert color_limits(np.full(3, np.nan)) == (0.0, 1.0)
