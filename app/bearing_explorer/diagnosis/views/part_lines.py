"""The spectrum of an envelope with the lines of each part of the bearing in it.

The lines of the part that stands out most are drawn strong where they were measured, with its
sidebands and a mark on each harmonic; those of the other parts are drawn faint, where geometry has
them. Below are frequencies, above the same in turns of the shaft (orders).
"""

from __future__ import annotations

import numpy as np
from bokeh.models import LinearAxis, Range1d, Scatter, VSpan
from bokeh.plotting import figure

from bearing_explorer.diagnosis.views.frequency_lines import (
    FAMILIES,
    ROW_PIXELS,
    named,
    thinned_to_peaks,
)
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Glyph, Layer, curve, draw, names_over
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.plots.zoom import MOVES
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearingcore import Diagnosis, PartEvidence
from bearingcore.measured.diagnosis import NONE_SEEN, PARTS

FREQUENCY = style.AxisQuantity("Impact frequency", "f", "Hz")
ORDER = style.AxisQuantity("Order: times a turn of the shaft", "", "")
LEVEL = style.AxisQuantity("Level above local noise", "", "dB")
FRAME, HEIGHT = 236.0, 330  # [px]
LOWEST = -6.0  # [dB] drawn

STRONG, FAINT, EVEN = 0.95, 0.32, 0.6
"""Opacity of lines: of the leading part, of the others, of all where none leads."""

NAMES = {"outer race": "BPFO", "inner race": "BPFI", "ball": "2 BSF"}
COLORS = {part: family.color for part, family in zip(PARTS, FAMILIES, strict=False)}
"""Colours of the parts: those that their lines have on all figures."""

_WORDS = "return row.order == 1 ? '%s' : `${row.order}×`"


def leading(diagnosis: Diagnosis) -> PartEvidence | None:
    """The part that stands out, be it enough to be named or not; None where none is seen."""
    lead = diagnosis.leading
    seen = lead is not None and diagnosis.fault != NONE_SEEN and lead.level > lead.noise
    return lead if seen or diagnosis.names_a_part else None


def shaft_frequency(diagnosis: Diagnosis) -> float:
    """Turns of the shaft a second [Hz] on which the lines rest."""
    part = diagnosis.evidence[0]
    return part.nominal_frequency / part.nominal_order


def fundamental(diagnosis: Diagnosis, part: PartEvidence) -> float:
    """The frequency [Hz] at which the first line of a part is drawn."""
    return part.frequency if part is leading(diagnosis) else part.nominal_frequency


def layers() -> list[Layer]:
    """Return the layers from the lowest up: lines of the parts, spectrum, marks on harmonics."""
    beneath: list[Layer] = []
    marks: list[Layer] = []
    for part, family in zip(PARTS, FAMILIES, strict=False):
        color, names = family.color, source_of(part, "lines_names")
        line = {"line_color": color, "level": "underlay"}
        looks = {**line, "line_alpha": "alpha", "line_width": "width"}
        dotted = {**line, "line_alpha": 0.7, "line_dash": "dotted"}
        mark = {"size": 8, "fill_color": color, "line_color": style.INK}
        beneath += [
            Glyph(VSpan, source_of(part, "lines"), ("frequency",), looks, ("alpha", "width")),
            Glyph(VSpan, source_of(part, "sidebands"), ("frequency",), dotted),
            names_over(names, _WORDS % NAMES[part], "frequency", "row", family.ink,
                       ("order", "alpha"), x_offset=3, text_alpha="alpha"),
        ]  # fmt: skip
        marks.append(Glyph(Scatter, source_of(part, "points"), ("frequency", "level"), mark))
    spectrum = curve("diagnosis_spectrum", "frequency", "level", style.INK, 1.2, alpha=0.9)
    return [*beneath, spectrum, *marks]


class PartLines:
    """The figure, and what it shows."""

    def __init__(self, packed: PackedSource) -> None:
        self._levels = StickyRange(LOWEST, 30.0, least_span=12.0)
        shown = packed.range("diagnosis_frequency", 0.0, 1000.0)
        orders = packed.range("diagnosis_order", 0.0, 40.0)
        level = packed.range("diagnosis_level", LOWEST, 30.0)
        self.plot = style.make_figure(FREQUENCY, LEVEL, shown, level, height=HEIGHT)
        self._add_orders(self.plot, orders)
        draw(self.plot, packed, layers())

    def _add_orders(self, plot: figure, orders: Range1d) -> None:
        plot.extra_x_ranges["order"] = orders
        orders.tags = [MOVES]
        axis = LinearAxis(x_range_name="order")
        style.style_axis(axis)
        style.write_units(axis, ORDER, orders)
        plot.add_layout(axis, "above")
        self._order_axis = axis

    def show_orders(self, known: bool) -> None:
        """The axis of orders, where the shaft's speed is known."""
        self._order_axis.visible = known

    def data(self, diagnosis: Diagnosis) -> tuple[Sources, Ranges]:
        """The sources of a diagnosis with a spectrum."""
        spectrum = diagnosis.spectrum
        assert spectrum is not None
        greatest = max(
            fundamental(diagnosis, part) * len(part.harmonics) for part in diagnosis.evidence
        )
        high = min(1.04 * greatest, float(spectrum.frequency[-1]))
        shaft = shaft_frequency(diagnosis)
        kept = spectrum.frequency <= high
        frequency, level = thinned_to_peaks(spectrum.frequency[kept], spectrum.level[kept])
        # between lines a level may be endlessly low: what is below the frame is at its foot
        drawn = {"frequency": frequency, "level": np.maximum(level, LOWEST)}
        sources: Sources = {"diagnosis_spectrum": drawn}
        lead = leading(diagnosis)
        name_row = ROW_PIXELS / (FRAME + self.plot.height - HEIGHT)
        for row, part in enumerate(diagnosis.evidence):
            first = fundamental(diagnosis, part)
            alpha = EVEN if lead is None else STRONG if part is lead else FAINT
            multiples = np.arange(1.0, len(part.harmonics) + 1.0)
            size = multiples.size
            labels = named(multiples, first, high)
            sources[source_of(part.part, "lines")] = {
                "frequency": multiples * first,
                "alpha": np.full(size, alpha),
                "width": np.full(size, 2.2 if part is lead else 1.2),
            }
            sources[source_of(part.part, "lines_names")] = {
                "frequency": labels * first,
                "order": labels,
                "row": np.full(labels.size, 1.0 - name_row * (row + 0.8)),
                "alpha": np.full(labels.size, 1.0 if part is lead or lead is None else 0.75),
            }
        if lead is not None:
            sources |= self._of_lead(lead)
        swells = drawn["frequency"] > 0.5 * shaft  # what drifts slowly is not what the scale is for
        loudest = float(np.max(drawn["level"][swells], initial=10.0))
        room = name_row * (len(PARTS) + 0.8)
        head = (loudest - LOWEST) * room / (1.0 - room)
        return sources, {
            "diagnosis_frequency": (0.0, high),
            "diagnosis_order": (0.0, high / shaft),
            "diagnosis_level": (LOWEST, self._levels.fit(np.array([LOWEST, loudest + head]))[1]),
        }

    def _of_lead(self, lead: PartEvidence) -> Sources:
        """The marks on the harmonics of the part that leads, and its sidebands."""
        multiples = np.arange(1.0, len(lead.harmonics) + 1.0)
        sources: Sources = {
            source_of(lead.part, "points"): {
                "frequency": multiples * lead.frequency,
                "level": np.maximum(lead.harmonics, LOWEST),
            }
        }
        if lead.part != "outer race":  # which stands still in the load and makes none
            sidebands = np.array([-lead.sideband_spacing, lead.sideband_spacing])
            both = multiples[:, None] * lead.frequency + sidebands
            sources[source_of(lead.part, "sidebands")] = {"frequency": both.ravel()}
        return sources


def source_of(part: str, kind: str) -> str:
    """The name of a source: of the lines of a part, their names, sidebands or points."""
    return f"diagnosis_{part.replace(' ', '_')}_{kind}"
