"""A map over two quantities: what it draws is what was computed, with names, units and colours."""

import math
import subprocess
import sys

import holoviews as hv
import numpy as np
import pytest
from bearing_explorer import figures
from bearing_explorer.explorer.plots.plane import Field, PlaneFigures, color_limits, section_of
from bearing_explorer.kit.plots.heat_map import Side
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


def test_a_map_has_its_numbers_its_reasons_and_the_scene() -> None:
    plane = PlaneFigures("plane", lambda x, y: None)
    plane.show(FIELD, (12.0, -110.0), 0.35)
    image, missing, *rings = plane.map.renderers
    np.testing.assert_array_equal(image.data_source.data["image"][0], FIELD.values / 1e6)
    assert image.glyph.global_alpha == 0.35
    mapper = image.glyph.color_mapper
    assert (mapper.low, mapper.high) == (1.0, 6.0)
    cell = {name: list(column) for name, column in missing.data_source.data.items()}
    assert cell == {
        "left": [15.0], "right": [25.0], "bottom": [-150.0], "top": [-50.0],
        "reason": ["nothing touches"],
    }  # fmt: skip
    assert [ring.data_source.data for ring in rings] == 2 * [{"x": [12.0], "y": [-110.0]}]
    assert (plane.map.x_range.start, plane.map.x_range.end) == (5.0, 35.0)
    assert (plane.map.y_range.start, plane.map.y_range.end) == (-250.0, -50.0)
    labels = [(p.xaxis[0].axis_label, p.yaxis[0].axis_label) for p in (plane.up, plane.across)]
    assert labels == [
        ("Load, upwards Fy (N)", "(MN/m)"),
        ("Length of the defect Δφf (°)", "(MN/m)"),
    ]


@pytest.mark.parametrize(
    ("place", "up", "across"),
    [
        ((12.0, -110.0), [1.0, 4.0], [4.0, math.nan, 6.0]),
        ((34.9, -249.0), [3.0, 6.0], [1.0, 2.0, 3.0]),
        ((99.0, -110.0), [2.0, math.nan], [4.0, math.nan, 6.0]),  # beside the map: the middle
    ],
)
def test_sections_are_those_through_a_place(place, up, across) -> None:
    plane = PlaneFigures("plane", lambda x, y: None)
    plane.show(FIELD, place)
    for figure, values, way in ((plane.up, up, "up"), (plane.across, across, "across")):
        drawn = figure.renderers[0].data_source.data["value"]
        np.testing.assert_array_equal(drawn, values)
        curve = section_of(FIELD, way, *place)
        np.testing.assert_array_equal(curve.dimension_values("value"), values)


def test_axes_are_linked_and_a_zoomed_map_stays_zoomed() -> None:
    plane = PlaneFigures("plane", lambda x, y: None)
    plane.show(FIELD, (12.0, -110.0))
    assert plane.across.x_range is plane.map.x_range
    assert plane.up.x_range is plane.map.y_range
    plane.map.x_range.update(start=12.0, end=14.0)
    plane.show(FIELD, (12.0, -110.0))
    shown = plane.map.x_range
    assert (shown.start, shown.end, shown.reset_start, shown.reset_end) == (12.0, 14.0, 5.0, 35.0)


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
    drawn = figures.of_sweep(xarray.Dataset({"acceleration_rms_y": swept, "status": swept}))
    assert isinstance(hv.render(drawn, backend="bokeh"), LayoutDOM)
    image = drawn.traverse(lambda part: part, [hv.Image])[0]
    assert image[30.0, -100.0] == 5.0
    curve = drawn.DynamicMap.I
    curve.streams[0].event(x=12.0, y=-140.0)
    assert list(curve[()].dimension_values("value")) == [0.0, 3.0]
    assert [d.unit for d in image.dimensions()] == ["°", "N", "m/s²"]
    with pytest.raises(ValueError, match="two"):
        figures.of_sweep(swept.isel(fy=0))
    with pytest.raises(ValueError, match="evenly"):
        figures.of_sweep(swept.assign_coords(extent=[0.1, 0.2, 0.5]))
    with pytest.raises(ValueError, match="outputs are"):
        figures.of_sweep(xarray.Dataset({"a": swept, "b": swept}))


def test_colours_are_light_at_zero_where_numbers_have_both_signs() -> None:
    assert color_limits(np.array([-1.0, np.nan, 3.0])) == (-3.0, 3.0)
    assert color_limits(np.array([2.0, 5.0])) == (2.0, 5.0)
    low, high = color_limits(np.zeros(4))
    assert low < 0.0 < high
    assert color_limits(np.full(3, np.nan)) == (0.0, 1.0)


def test_a_page_starts_without_holoviews() -> None:
    """It takes a quarter of the time to import the page, and Explore alone needs it."""
    code = "import sys, bearing_explorer.page; print('holoviews' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split()[-1] == "False"
