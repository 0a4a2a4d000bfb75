"""Two causes of the housing's vibration: varying stiffness, and the mass of the balls."""

from __future__ import annotations

from typing import Any

import numpy as np
from bokeh.models import Quad, Segment, Span

from bearing_explorer.explorer.plots.spectra import FREQUENCY_WITH_UNITS, write_hertz
from bearing_explorer.explorer.results.ball_mass import BallMass
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.folded_view import FoldedView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore.common import prefixed_span
from bearingcore.model.dynamics import LOWEST_COMPARED, contact_resonance_band

SHARE = style.AxisQuantity("Share that mass adds", "", "%")
ROOM = 1.06
"""Gap between bars, as a ratio of frequencies."""
LEAST = -1.0
"""Share below which a bar is cut; at −1 the mass has halved the power."""
HALF = 0.5
"""Share above which most of the power comes from the balls' mass."""

_BAR_WORDS = """
if (!row.known) return narrow ? '?' : 'not known'
return narrow ? minus(`${(100*row.share).toFixed(0)}%`) : `${rounded(100*row.share, 2)} %`
"""
_BAR_LOOK = {"fill_color": style.DEFECTIVE, "fill_alpha": "alpha", "line_color": None}
_WORDS_LOOK = {"text_align": "center", "text_baseline": "bottom"}
_SPREAD = ("middle", "low", "middle", "high")
LAYERS: tuple[layers.Layer, ...] = (
    layers.Glyph(Quad, "mechanism_bars", ("left", "right", "top", 0.0), _BAR_LOOK, ("alpha",)),
    layers.Glyph(Segment, "mechanism_bars", _SPREAD, {"line_color": style.INK}),
    layers.Words(
        "mechanism_bars",
        "middle",
        "label_at",
        _BAR_WORDS,
        ("share", "known"),
        fitting=style.NARROW,
        look=_WORDS_LOOK,
    ),
)
"""Bars, their standard errors and their numbers."""


class WhichMechanism(FoldedView[Results]):
    """Share of the housing's power that the mass of the balls adds, octave by octave."""

    name = "mechanism"
    title = "Which mechanism"
    about = (
        "Vibration power from the mass of the balls. Its share of the housing's power "
        "along x and y together, by octaves; the rest comes from the stiffness that varies as "
        "balls pass. Thin lines: its standard error. Faint bars: 40 dB and more below the "
        "loudest octave. Below zero mass takes power away."
    )
    needs = frozenset({"ball_mass"})

    def build(self, packed: PackedSource) -> Any:
        plot = style.make_figure(
            FREQUENCY_WITH_UNITS,
            SHARE,
            packed.range("mechanism_frequency", 125.0, 32000.0),
            packed.range("mechanism_share", -20.0, 115.0),
            height=290,
            x_axis_type="log",
            name="mechanism",
        )
        write_hertz(plot)
        layers.draw(plot, packed, LAYERS)
        plot.add_layout(Span(location=0.0, dimension="width", line_color=style.STEEL_EDGE))
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        mass = results.ball_mass
        known = np.isfinite(mass.share)
        share = np.clip(np.where(known, mass.share, 0.0), LEAST, 1.0)
        spread = np.nan_to_num(mass.spread)
        low, high = mass.octaves[:-1], mass.octaves[1:]
        top = 100.0 * share
        ends = 100.0 * np.clip(share + np.array([[-1.0], [1.0]]) * spread, LEAST, 1.0)
        least = min(-12.0, 1.25 * float(ends[0].min(initial=0.0)))
        return {
            "mechanism_bars": {
                "left": low * ROOM,
                "right": high / ROOM,
                "middle": np.sqrt(low * high),
                "share": np.where(known, mass.share, 0.0),
                "top": top,
                "known": known.astype(float),
                "low": ends[0],
                "high": ends[1],
                "label_at": np.maximum(ends[1], 0.0) + 1.5,
                "alpha": np.where(mass.quiet, 0.2, 0.75),
            }
        }, {
            "mechanism_frequency": (float(low[0]), float(high[-1])),
            "mechanism_share": (least, 115.0),
        }

    def words(self, results: Results) -> str:
        mass = results.ball_mass
        if not np.isfinite(mass.share).any():
            return "There is no settled motion to compute the power from."
        words = f"{mechanism_words(mass)} {_why_mass_matters(mass)}".rstrip()
        if mass.comparison is None:
            return f"{words} The motion is too short to show where massless balls will do."
        up_to = mass.comparison.massless_up_to
        if np.isnan(up_to):
            lowest = _hertz(LOWEST_COMPARED)
            return f"{words} The mass of the balls makes a difference from {lowest} on."
        return f"{words} Up to {_hertz(up_to)} the mass of the balls makes no difference."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        return results.ball_mass.share_table().named()


def _why_mass_matters(mass: BallMass) -> str:
    """Say why massless balls are wrong at high frequencies; empty if no ball carries load."""
    low, high = contact_resonance_band(mass.scene)
    if not low > 0.0:
        return ""
    return (
        "A massless ball is in balance with both races at every instant. A real one is a mass "
        f"between two contact springs. It swings there at {prefixed_span(low, high, 'Hz')}, and a "
        "strike lasts no longer than half a swing, so it reaches frequencies that massless balls "
        "do not."
    )


def mechanism_words(mass: BallMass) -> str:
    """Say which mechanism gives most of the power in which octaves."""
    loud = np.isfinite(mass.share) & ~mass.quiet
    low, high, share = mass.octaves[:-1][loud], mass.octaves[1:][loud], mass.share[loud]
    by_mass = np.flatnonzero(share > HALF)
    if not by_mass.size:
        top = int(np.argmax(share))
        most = f"{_percent(share[top])} from {_hertz(low[top])} to {_hertz(high[top])}"
        adds = f"mass adds at most {most}" if share[top] > 0.0 else "mass adds nothing"
        return f"The varying stiffness gives most of the power in every octave; {adds}."
    most = _percent(share[by_mass].max())
    if by_mass.size < low.size - by_mass[0]:  # octaves by stiffness lie between them
        named = style.list_words([_hertz(low[i]) for i in by_mass])
        return (
            f"The mass of the balls gives most of the power in the octaves that begin at {named}, "
            f"up to {most}; in the others the varying stiffness does."
        )
    words = f"From {_hertz(low[by_mass[0]])} up the mass of the balls gives most of the power"
    below = share[: by_mass[0]]
    if not below.size:
        return f"{words}, up to {most}, as its strikes are short."
    return (
        f"{words}, up to {most}, as its strikes are short; below it the varying stiffness does, "
        f"and mass adds at most {_percent(max(below.max(), 0.0))}."
    )


def _hertz(frequency: float) -> str:
    return style.with_prefix(float(frequency), "Hz")


def _percent(share: float) -> str:
    return f"{style.number(100.0 * float(share), 2)} %"
