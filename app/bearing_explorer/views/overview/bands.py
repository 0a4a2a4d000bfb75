"""The bands of the natural frequencies as bars over frequency."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.plots import style
from bearing_explorer.plots.layers import by_number
from bearing_explorer.plots.ranges import StickyRange
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View
from bearing_explorer.views.modes import (
    FREQUENCY,
    SHORT_BAND_WORDS,
    band_rows,
)
from bearing_explorer.views.vibration_spectrum import HIGHEST
from bearingcore.dynamics.modes import bands_table
from bearingcore.sweep.outputs import mode_symbol

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results

LEFT = 68
"""[px] left of the frame: the widest numbers fit, so that no drag moves it on either card."""
_LABEL_FROM = 0.8  # of the width: further right a label would be cut off
_LABEL_WIDTH = 0.26  # of the width, of a narrow card
_SIDE = f"""
const {{start, end}} = plot.x_range
let width = Infinity
try {{ width = plot.inner_width }} catch {{}}  // not laid out
const right = (row.high - start)/(end - start)*width
const fits = !(right + 7 + {0.55 * int(style.SMALL_TEXT_SIZE[:-2]):.1f}*text.length > width)
const to_right = !row.to_left && fits
"""
"""A name that the server puts right of its band has no room there on a narrow screen."""
_MOST_ROWS = 5
"""Modes that have a row each; of more those of a direction share one, to be legible."""


class OverviewBands(View):
    """A bar for each mode, from its least to its greatest frequency; the tick is now."""

    name = "overview-bands"
    title = "Natural frequencies"
    about = (
        "The band in which each mode moves as the bearing turns, blue x, orange y. Grey: "
        "{grey}. Black: where it is at this cage angle. The axis is that of the "
        "spectrum below."
    )
    needs = frozenset({"modes", "bands", "healthy_bands"})
    compact = True
    sentence_looks = ("unseen",)
    leads_to = "modes"
    in_report = False

    def build(self, packed: PackedSource) -> Any:
        self._frequency = StickyRange(0.0, HIGHEST, anchor="zero")
        plot = style.make_figure(
            FREQUENCY,
            style.AxisQuantity("", "", ""),
            packed.range("overview_band_frequency", 0.0, HIGHEST),
            packed.range("overview_band_rows", -3.6, 0.6),
            height=60,
            sizing_mode="stretch_both",
        )
        plot.min_border_left = LEFT
        plot.xaxis.visible = False
        plot.yaxis.visible = False
        plot.ygrid.visible = False
        plot.min_border_bottom = plot.min_border_top = 2
        healthy = packed.source("overview_healthy_bands", "low", "high", "row")
        plot.hbar(
            "row", left="low", right="high", height=0.84, source=healthy,
            fill_color=style.HEALTHY, fill_alpha=0.5, line_color=None,
        )  # fmt: skip
        bands = packed.source(
            "overview_bands",
            "low",
            "high",
            "direction",
            "number",
            "row",
            "now",
            "to_left",
            "shared",
        )
        color = by_number("direction", style.DIRECTION_COLORS)
        plot.hbar(
            "row", left="low", right="high", height=0.5, source=bands,
            fill_color=color, fill_alpha=0.6, line_color=color,
        )  # fmt: skip
        plot.scatter(
            "now", "row", source=bands, marker="dash", angle=np.pi / 2.0, size=15,
            line_color=style.INK, line_width=2.2,
        )  # fmt: skip
        short = f"if (!row.shared) narrow = false\n{SHORT_BAND_WORDS}"
        for place, side, offset, kept in (
            ("high", "left", 7, "to_right"),
            ("low", "right", -7, "!to_right"),
        ):
            words = style.fitting_words(plot, bands, short, keep=f"{_SIDE}return {kept}")
            plot.text(
                place, "row", text=words, source=bands,
                x_offset=offset, text_align=side, text_baseline="middle", text_color=color,
                text_font={"value": style.FONT}, text_font_size=style.SMALL_TEXT_SIZE,
            )  # fmt: skip
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        bands, usual = band_rows(results.bands), band_rows(results.healthy_bands)
        top = self._frequency.fit(HIGHEST, highest_band(results))[1]
        order = np.argsort(bands["low"], kind="stable")
        bands = {name: column[order] for name, column in bands.items()}
        keys = list(zip(bands["direction"], bands["number"], strict=True))
        each = keys if len(keys) <= _MOST_ROWS else [(direction, 0) for direction, _ in keys]
        places = {key: -float(i) for i, key in enumerate(dict.fromkeys(each))}
        rows = {key: places[own] for key, own in zip(keys, each, strict=True)}
        row = [
            rows.get(key, np.nan) for key in zip(usual["direction"], usual["number"], strict=True)
        ]
        own_row = np.array([rows[key] for key in keys])
        return {
            "overview_bands": {
                **bands,
                "row": own_row,
                "now": _now(results)[order],
                # right of the band where there is room, else left
                "to_left": _left_of(bands, own_row, top),
                "shared": np.full(own_row.size, len(keys) > _MOST_ROWS),
            },
            "overview_healthy_bands": {
                "low": usual["low"],
                "high": usual["high"],
                "row": np.array(row, dtype=float),
            },
        }, {
            "overview_band_frequency": (0.0, top),
            "overview_band_rows": (0.4 - max(len(places), 1), 0.6),
        }

    def sentence(self, results: Results) -> str:
        bands = {label: band for label, band in results.bands.items() if band[0] == band[0]}
        words = [
            f"{mode_symbol(label)} {low:.0f} to {high:.0f} Hz"
            for label, (low, high) in bands.items()
        ]
        if not words:
            return "There is no static state to take natural frequencies from."
        return f"The natural frequencies move within: {style.list_words(words)}."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return bands_table(results.bands).named()


def _left_of(bands: dict[str, np.ndarray], row: np.ndarray, top: float) -> NDArray[np.bool_]:
    """Which bands have their names on the left: near the edge, or before another of their row."""
    left = bands["high"] > _LABEL_FROM * top
    for i in range(row.size):
        follows = (row == row[i]) & (bands["low"] > bands["low"][i])
        room = np.min(bands["low"][follows], initial=np.inf) - bands["high"][i]
        names = _LABEL_WIDTH * (1.0 + np.any(left & follows)) * top
        left[i] |= room < names and bands["low"][i] > _LABEL_WIDTH * top
    return np.asarray(left, dtype=np.bool_)


def highest_band(results: Results) -> float:
    """Up to where [Hz] the cards of the overview reach, for the bands that they share."""
    ends = [band_rows(bands)["high"] for bands in (results.bands, results.healthy_bands)]
    return float(1.05 * np.max(np.concatenate(ends), initial=0.0))


def _now(results: Results) -> np.ndarray:
    """Frequency [Hz] of each mode that `band_rows` lists at the cage angle shown."""
    modes = results.modes
    angles = modes.cage_angles
    first, last, _ = results.stretch
    at = first + (results.cage_angle - first) % (last - first)
    return np.array(
        [
            np.interp(at, angles, modes.frequency[:, modes.label.index(label)])
            for label, (low, _) in results.bands.items()
            if np.isfinite(low)
        ]
    )
