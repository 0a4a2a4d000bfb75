"""Natural frequencies over cage angle, and the bands in which they move (Fig. 8)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from bokeh.models import CustomJS
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.plots.frequency_bands import BAND_NAME, BAND_SPAN, band_rows, spread
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.element_words import with_elements_of
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore.common import span
from bearingcore.model.sweeps import mode_symbol

FREQUENCY = style.AxisQuantity("Natural frequency", "f", "Hz")
HEIGHT = 330
LABEL_PIXELS = 16.0  # height that a label needs
NAMES_WIDTH = 148
"""Width [px] right of the frame for the names of bands."""
NARROW = 520
"""Width [px] of the figure below which names are written without their frequencies."""
_ROOM = f"""{style.LARGER}
const room = cb_obj.outer_width < larger*below ? 34 : larger*usual
if (cb_obj.min_border_right != room) cb_obj.setv({{min_border_right: room}}, {{sync: false}})
"""

_NAME_WORDS = f"{BAND_NAME}\nif (plot.min_border_right < larger*100) return name\n{BAND_SPAN}"


def mode_layers(colors: Any) -> Sequence[layers.Layer]:
    """Layers, the lowest first; `colors` are those of bands and their names, by direction."""
    return (
        layers.strips("modes_bands", colors, 0.10, level=True),
        *compared_curves.bands("modes_band", level=True),
        *compared_curves.curves("modes", "angle", "frequency"),
        layers.curve("modes_healthy", "angle", "frequency", style.HEALTHY, 1.5),
        *(
            layers.curve(f"modes_{direction}", "angle", "frequency", color)
            for direction, color in zip(style.DIRECTIONS, style.DIRECTION_COLORS, strict=True)
        ),
        layers.uprights("modes_now"),
        # right of the frame, and so not cut off by it when it is zoomed
        layers.Words(
            "modes_bands",
            1.0,
            "label_at",
            _NAME_WORDS,
            reads=("direction", "number"),
            x_share=True,
            in_view="y",
            look={
                "level": "annotation",
                "x_offset": 8,
                "text_font_size": style.TEXT_SIZE,
                "text_color": colors,
            },
        ),
    )


class NaturalFrequencies(ComparingView):
    """Natural frequencies of rotor and housing on the varying stiffness of the bearing."""

    name = "modes"
    title = "Natural frequencies"
    about = (
        "Each natural frequency as the bearing turns. Blue x, orange y. A mode is named after the "
        "direction that moves most. Shaded: the band in which it moves. Grey: {grey}. Vertical "
        "line: current cage angle. For an inner-race defect, curves show the current turn of the "
        "shaft and bands all turns."
    )
    needs = frozenset({"modes", "bands", "ranges"})

    def build(self, packed: PackedSource) -> Any:
        self._range = StickyRange(0.0, 2000.0, least_span=20.0, room=ROOM)
        self._angle_range = packed.range("modes_angle", 0.0, 30.0)
        plot = style.make_figure(
            style.CAGE_ANGLE,
            FREQUENCY,
            self._angle_range,
            packed.range("modes_frequency", 0.0, 2000.0),
            height=HEIGHT,
            right=NAMES_WIDTH,
        )
        room = CustomJS(args={"usual": NAMES_WIDTH, "below": NARROW}, code=_ROOM)
        plot.js_on_change("outer_width", room)
        colors = layers.by_number("direction", style.DIRECTION_COLORS)
        layers.draw(plot, packed, mode_layers(colors))
        self._axis = plot.xaxis[0]
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        modes, healthy = results.modes, results.reference.modes
        bands = band_rows(results.bands)
        compared = compared_curves.sources(
            "modes",
            ("angle", "frequency"),
            (results.against(reference) for reference in results.compared),
            lambda other: lines(results.along(other.modes.cage_angles), other.modes.frequency),
        )
        shown = self._range.fit(
            modes.frequency,
            healthy.frequency,
            bands["low"],
            bands["high"],
            compared_curves.numbers(compared, "frequency"),
        )
        angle = results.along(modes.cage_angles)
        pixels = HEIGHT - 60.0  # of the frame, without axis and borders
        middle = 0.5 * (bands["low"] + bands["high"])
        bands["label_at"] = spread(middle, LABEL_PIXELS * (shown[1] - shown[0]) / pixels, *shown)
        sources: Sources = {
            **compared,
            **compared_curves.sources(
                "modes_band",
                ("low", "high"),
                results.compared_results,
                lambda other: band_rows(other.bands),
            ),
            "modes_bands": bands,
            "modes_healthy": lines(results.along(healthy.cage_angles), healthy.frequency),
            "modes_now": {"now": results.along([results.cage_angle])},
        }
        for direction in style.DIRECTIONS:
            columns = [i for i, label in enumerate(modes.label) if label[:-1] == direction]
            sources[f"modes_{direction}"] = lines(angle, modes.frequency[:, columns])
        ranges = {
            "modes_angle": (float(angle[0]), float(angle[-1])),
            "modes_frequency": shown,
        }
        return sources, ranges

    def sentence(self, results: Results) -> str:
        bands = results.bands
        known = {label: band for label, band in bands.items() if np.isfinite(band[0])}
        if not known:
            why = results.equilibrium.reason(0)
            return f"There is no static state to take natural frequencies from: {why}."
        named = sorted(known, key=lambda label: label[:-1] not in ("x", "y"))  # radial ones first
        words = [f"{mode_symbol(label)} {_band_words(known[label])}" for label in named]
        turning = "In all turns of the shaft" if results.over_shaft else "As the cage turns"
        text = f"{turning} the natural frequencies move: {style.list_words(words)}"
        why = with_elements_of(results.scene.bearing, reasons.frequencies(results))
        return f"{why} {text}.".lstrip()

    def show(self, results: Results) -> None:
        quantity = style.SHAFT_ANGLE if results.over_shaft else style.CAGE_ANGLE
        self._axis.axis_label = quantity.label()

    def table(self, results: Results) -> dict[str, np.ndarray]:
        modes, healthy = results.modes, results.reference.modes
        table, grey = modes.table(), healthy.table().prefixed("healthy")
        columns = (table | grey).in_units().named()
        if results.over_shaft:
            columns["shaft_angle_deg"] = results.along(modes.cage_angles)
        return columns


def _band_words(band: tuple[float, float]) -> str:
    words = span(*band, "Hz")
    return f"from {words}" if " to " in words else f"at {words}"


def lines(x: NDArray[np.float64], columns: NDArray[np.float64]) -> dict[str, np.ndarray]:
    """Join the columns over x to one line with gaps between them."""
    return layers.with_gaps(((x, column) for column in columns.T), "angle", "frequency")
