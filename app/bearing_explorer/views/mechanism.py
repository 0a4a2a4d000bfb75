"""Which of two mechanisms shakes the housing: varying stiffness, or balls that strike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import panel as pn
from bokeh.models import Span

from bearing_explorer.compute.ball_mass import BallMass
from bearing_explorer.figures import style
from bearing_explorer.server.packed_source import PackedSource
from bearing_explorer.views.base import Ranges, Sources, View
from bearing_explorer.views.wide_spectrum import FREQUENCY

if TYPE_CHECKING:
    from bearing_explorer.compute.results import Results

SHARE = style.AxisQuantity("Share that mass adds", "", "%")
ROOM = 1.06
"""Between bars, as a ratio of frequencies."""
LEAST = -1.0
"""Share below which a bar is cut: next to nothing is left of what massless balls would give."""
HALF = 0.5
"""Share from which on most of the power comes from the balls' mass."""

_BAR_WORDS = "return row.known ? `${rounded(100*row.share, 2)} %` : 'not known'"


class WhichMechanism(View):
    """Share of the housing's power that the mass of the balls adds, octave by octave."""

    name = "mechanism"
    title = "Which mechanism"
    about = (
        "Share of the housing's power that is there only because balls strike. Having mass they "
        "do; the rest comes from the stiffness that varies as they pass. x and y together, by "
        "octaves; the thin lines are its standard error. Below zero mass takes power away."
    )
    needs = frozenset({"ball_mass"})

    def build(self, packed: PackedSource) -> Any:
        bars = packed.source(
            "mechanism_bars", "left", "right", "middle", "share", "top", "known", "low", "high",
            "label_at",
        )  # fmt: skip
        plot = style.house_figure(
            FREQUENCY,
            SHARE,
            packed.range("mechanism_frequency", 125.0, 32000.0),
            packed.range("mechanism_share", -20.0, 115.0),
            height=290,
            x_axis_type="log",
            name="mechanism",
        )
        plot.xaxis[0].formatter = style.logarithmic_ticks("Hz")
        plot.xaxis[0].axis_label = FREQUENCY.words
        plot.quad(
            left="left", right="right", bottom=0.0, top="top", source=bars,
            fill_color=style.DEFECTIVE, fill_alpha=0.75, line_color=None,
        )  # fmt: skip
        plot.segment("middle", "low", "middle", "high", source=bars, line_color=style.INK)
        plot.text(
            "middle", "label_at", text=style.words_of(bars, _BAR_WORDS), source=bars,
            text_align="center", text_baseline="bottom", text_font={"value": style.FONT},
            text_font_size=style.SMALL_TEXT_SIZE, text_color=style.INK,
        )  # fmt: skip
        plot.add_layout(Span(location=0.0, dimension="width", line_color=style.STEEL_EDGE))
        return pn.pane.Bokeh(plot, sizing_mode="stretch_width", margin=0)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        found = results.ball_mass
        known = np.isfinite(found.share)
        share = np.clip(np.where(known, found.share, 0.0), LEAST, 1.0)
        spread = np.nan_to_num(found.spread)
        low, high = found.octaves[:-1], found.octaves[1:]
        top = 100.0 * share
        ends = 100.0 * np.clip(share + np.array([[-1.0], [1.0]]) * spread, LEAST, 1.0)
        least = min(-12.0, 1.25 * float(ends[0].min(initial=0.0)))
        return {
            "mechanism_bars": {
                "left": low * ROOM,
                "right": high / ROOM,
                "middle": np.sqrt(low * high),
                "share": np.where(known, found.share, 0.0),
                "top": top,
                "known": known.astype(float),
                "low": ends[0],
                "high": ends[1],
                "label_at": np.maximum(ends[1], 0.0) + 1.5,
            }
        }, {
            "mechanism_frequency": (float(low[0]), float(high[-1])),
            "mechanism_share": (least, 115.0),
        }

    def sentence(self, results: Results) -> str:
        found = results.ball_mass
        if not np.isfinite(found.share).any():
            return "There is no settled motion whose power could be shared out."
        return verdict(found)

    def table(self, results: Results) -> dict[str, np.ndarray]:
        found = results.ball_mass
        return {
            "lowest_frequency_hz": found.octaves[:-1],
            "highest_frequency_hz": found.octaves[1:],
            "mass_share": found.share,
            "mass_share_standard_error": found.spread,
            "added_db": found.added,
        }


def verdict(found: BallMass) -> str:
    """In words: in which octaves which mechanism gives most of the power."""
    low, share = found.octaves[:-1], found.share
    struck = np.flatnonzero(np.isfinite(share) & (share > HALF))
    if not struck.size:
        at = int(np.nanargmax(share))
        return (
            "Stiffness that varies gives most of the power in every octave; mass adds most from "
            f"{_hertz(low[at])} to {_hertz(found.octaves[at + 1])}: {_percent(share[at])}."
        )
    most = _percent(share[struck].max())
    if struck.size < low.size - struck[0]:  # others lie between
        named = style.list_words([_hertz(low[i]) for i in struck])
        return (
            f"Balls that strike give most of the power in the octaves that begin at {named}, up to "
            f"{most}; in the others stiffness that varies does."
        )
    words = (
        f"From {_hertz(low[struck[0]])} up balls that strike give most of the power, up to {most}"
    )
    below = share[: struck[0]]
    if not np.isfinite(below).any():
        return f"{words}."
    return (
        f"{words}; below, stiffness that varies does, and mass adds "
        f"{_percent(np.nanmin(below))} to {_percent(np.nanmax(below))}."
    )


def _hertz(frequency: float) -> str:
    return style.with_prefix(float(frequency), "Hz")


def _percent(share: float) -> str:
    return f"{style.number(100.0 * float(share), 2)} %"
