"""Spectra of the housing's acceleration with the bands of the natural frequencies (Fig. 10)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, ClassVar

import numpy as np
from bokeh.models import LayoutDOM
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.plots.frequency_bands import SHORT_BAND_WORDS, bands_along
from bearing_explorer.explorer.plots.spectra import SpectrumFigures
from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.excerpt import why_ended
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import HEALTHY, OTHER_BALLS
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import layers, style
from bearing_explorer.kit.plots.element_words import with_elements_of
from bearing_explorer.kit.plots.levels import HIGHEST, LEVEL_FLOOR, SHOWN
from bearing_explorer.kit.plots.ranges import StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, SessionParts, Sources
from bearing_explorer.kit.views.look_view import LookView
from bearing_explorer.kit.widgets.form import AS_HIGH_AS_SHOWN, FieldSpec, stack
from bearingcore import Scene
from bearingcore.model.dynamics import contact_resonance_band
from bearingcore.model.scene import WITH_MASS

GREY: FieldSpec = {
    "name": "grey",
    "label": "Grey",
    "options": [[HEALTHY, "without the defect"], [OTHER_BALLS, "with the mass of the balls"]],
}
AXIS: FieldSpec = {
    "name": "axis",
    "label": "Frequency",
    "options": [["linear", "Bands and peaks"], ["logarithmic", "Full range (log)"]],
}
"""The switches above the figures."""

NAMED_IN_FULL = 580.0
"""Least width [px] of a frame at which the names of bands include their frequencies."""
FEW = 3
"""Number of marks at the ball-pass frequency and its harmonics for a healthy bearing."""
LOWEST = 100.0
"""Lowest frequency [Hz] of the logarithmic axis."""
WIDE_DEPTH = 90.0
"""Range [dB] below the loudest line on the logarithmic axis."""
_RESONANCE_WORDS = (
    "return `contact resonance ${si(row.low, 'Hz')}${row.above ? ', above this range' : ''}`"
)
_PASS_WORDS = """
const of = row.row ? ` row ${row.row}` : ''
const give = row.spread > 0 ? ` ± ${rounded(row.spread, 1)}` : ''
return `${row.inner ? 'BPFI' : 'BPFO'}${of} ${rounded(row.frequency, 4)}${give} Hz`
"""


def spectra(dof: str) -> list[layers.Layer]:
    """Layers of the spectra along a direction, over the bands of the natural frequencies."""
    color = style.color_along(dof)
    bands = f"spectrum_bands_{dof}"
    return [
        layers.strips(bands, color, 0.12),
        *compared_curves.bands(f"spectrum_band_{dof}"),
        layers.Words(
            bands,
            "label_at",
            0.94,
            SHORT_BAND_WORDS,
            reads=("direction", "number"),
            y_share=True,
            fitting=NAMED_IN_FULL,
            look={"text_color": color, **layers.CENTERED},
        ),
        layers.curve("spectrum_grey", "frequency", dof, style.HEALTHY, 1.5),
        *compared_curves.curves("spectrum", "frequency", dof),
        layers.curve("spectrum_lines", "frequency", dof, color),
    ]


def wide_spectra(dof: str) -> list[layers.Layer]:
    """Layers of the spectra up to the bandwidth of the motion, with the contact resonances."""
    return [
        layers.strips("spectrum_wide_resonance", style.DEFECT, 0.22, reads=("above",)),
        layers.curve("spectrum_wide_grey", "frequency", dof, style.HEALTHY, 1.5),
        *compared_curves.curves("spectrum_wide", "frequency", dof, width=1.3),
        layers.curve("spectrum_wide_lines", "frequency", dof, style.color_along(dof), 1.4),
        layers.names_over(
            "spectrum_wide_resonance",
            _RESONANCE_WORDS,
            "label_at",
            0.06,
            style.INK,
            text_align="right",
        ),
    ]


PASSES: list[layers.Layer] = [
    layers.uprights("spectrum_passes", "frequency", style.DEFECT, 1.0, 0.4, level="underlay"),
    layers.names_over(
        "spectrum_first_pass",
        _PASS_WORDS,
        "frequency",
        0.06,
        style.INK,
        ("inner", "row", "spread"),
        x_offset=4,
    ),
]
"""Marks of the ball-pass frequencies."""


class VibrationSpectra(ComparingView, LookView[Results]):
    """Power spectral density of the housing's acceleration along x and y."""

    name = "vibration-spectrum"
    title = "Spectrum of the vibration"
    about = (
        "Spectrum of the housing's acceleration. Power spectral density along x and y once the "
        "start has died away; it resolves 32 Hz. Grey: {grey}. Shaded: the bands of the natural "
        "frequencies. Massless balls are in balance with both races at every instant, so they "
        "never strike one, and above some kilohertz they shake the housing too little. The card "
        "on the two mechanisms, below, says from which frequency on."
    )
    needs = frozenset({"motion", "late_spectra", "reference", "bands", "ranges"})
    look_fields = (AXIS, GREY)
    first_look: ClassVar[dict[str, Any]] = {"axis": "linear", "grey": HEALTHY}

    def build(self, packed: PackedSource) -> Any:
        self._frequency = StickyRange(0.0, HIGHEST, anchor="zero")
        levels = StickyRange(-80.0, -20.0, least_span=40.0)
        linear = SpectrumFigures(packed, "spectrum", spectra, (0.0, HIGHEST), levels)
        self._linear = linear
        self._wide = SpectrumFigures(
            packed,
            "spectrum_wide",
            wide_spectra,
            (LOWEST, 32768.0),
            StickyRange(-120.0, -20.0, least_span=60.0),
            WIDE_DEPTH,
        )
        sources = layers.sources_of(packed, PASSES)
        passes = [line for plot in linear.plots for line in layers.add_all(plot, sources, PASSES)]
        box = layers.toggle("Mark the ball-pass frequency and its harmonics", passes, shown=False)
        self._narrow = [*linear.plots, box]
        self._broad = stack(*self._wide.plots, visible=False, stylesheets=[AS_HIGH_AS_SHOWN])
        high = {"min-height": "calc(var(--room) - 170px)"}
        return self.only_with_numbers(*self._narrow, self._broad, self.panel_of_look, styles=high)

    def attach(self, parts: SessionParts) -> None:
        super().attach(parts)
        self.withhold(self._broad)

    def bring(self) -> None:
        if self.wide:
            super().bring()

    @property
    def is_empty(self) -> bool:
        """True if the motion ended before it had settled."""
        return self._results is not None and not self._results.late_spectra

    @property
    def wide(self) -> bool:
        """True if the figure shows the whole bandwidth on a logarithmic frequency axis."""
        return bool(self.look["axis"] == "logarithmic")

    def still_figures(self) -> Sequence[LayoutDOM]:
        return self._wide.plots if self.wide else self._linear.plots

    def look_changed(self, name: str, value: Any) -> None:
        if name == "grey" and self.parts is not None:
            self.parts.set_grey(value)  # all tabs draw the same reference in grey
        else:
            super().look_changed(name, value)

    def choices(self) -> dict[str, Any]:
        return {name: value for name, value in super().choices().items() if name != "grey"}

    def say(self, results: Results | None, sentence: str) -> None:
        if results is not None:
            self.look["grey"] = results.grey_kind
        super().say(results, sentence)

    def show_look(self) -> None:
        super().show_look()
        for part in self._narrow:
            part.visible = not self.wide
        self._broad.visible = self.wide

    def _resonance(self, results: Results, top: float) -> dict[str, np.ndarray]:
        """Band of the contact resonances if balls have mass; `top` [Hz] is the end of the axis."""
        scenes = results.scene, results.grey.scene
        bands = [contact_resonance_band(scene) for scene in scenes if scene.balls == WITH_MASS]
        low, high = np.array(bands[-1:]).reshape(-1, 2).T
        above = (low >= top).astype(float)
        return {"low": low, "high": high, "above": above, "label_at": 0.97 * np.minimum(low, top)}

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        top = self._frequency.fit(HIGHEST, results.picture_top)[1]
        sources, ranges = self._linear.data(results, top)
        if self.wide:
            known = results.motion.bandwidth
            wide, wide_ranges = self._wide.data(results, known)
            sources |= {**wide, "spectrum_wide_resonance": self._resonance(results, known)}
            ranges |= wide_ranges
        for dof in SHOWN:
            sources |= compared_curves.sources(
                f"spectrum_band_{dof}",
                ("low", "high"),
                results.compared_results,
                partial(_bands_of, dof, top),
            )
        passing = pass_frequencies(results.scene, top)
        first = np.unique([passing["inner"], passing["row"]], axis=1, return_index=True)[1]
        sources |= {
            "spectrum_passes": {"frequency": passing["frequency"]},
            "spectrum_first_pass": {name: column[first] for name, column in passing.items()},
            **{f"spectrum_bands_{dof}": bands_along(results.bands, dof, top) for dof in SHOWN},
        }
        return sources, ranges

    def sentence(self, results: Results) -> str:
        return f"{why_words(results)} {loudest_words(results)}".lstrip()

    def table(self, results: Results) -> dict[str, np.ndarray]:
        table: dict[str, np.ndarray] = {}
        before = f"{results.grey_kind.replace('-', '_')}_"
        spectra_of = {"": results.late_spectra, before: results.reference.late_spectra}
        for prefix, drawn in spectra_of.items():
            for dof, spectrum in drawn.items():
                unit = "(rad/s²)²/Hz" if dof.startswith("r") else "(m/s²)²/Hz"
                # frequencies of an orbit follow from its period and differ from those of a march
                columns = spectrum.table([dof], unit).named()
                table |= {f"{prefix}{name}": values for name, values in columns.items()}
        return table


def _bands_of(dof: str, top: float, other: Results) -> dict[str, np.ndarray]:
    return bands_along(other.bands, dof, top)


def loudest_words(results: Results) -> str:
    """Say at which frequency the housing vibrates most along each direction, and balls pass."""
    words = []
    if not results.late_spectra:
        return f"There is no spectrum, as {why_ended(results.motion)}."
    for dof, peak in results.peaks.items():
        if peak.level > LEVEL_FLOOR:
            words.append(f"{style.number(peak.level, 2)} dB at {peak.frequency:.0f} Hz along {dof}")
    text = (
        f"The highest levels above 100 Hz are {style.list_words(words)} (re 1 (m/s²)²/Hz)"
        if words
        else "The housing does not move along x or y in this scene"
    )
    passing = style.list_words(
        [
            f"of the {race} race{f', row {row},' if row else ''} at {style.number(frequency, 4)} Hz"
            for race, row, frequency in passed_races(results.scene)
        ]
    )
    estimated = ", as estimated" if results.scene.bearing.estimated else ""
    text += with_elements_of(results.scene.bearing, f"; balls pass a point {passing}{estimated}")
    return f"{text}{results.doubt}."


def why_words(results: Results, *, briefly: bool = False) -> str:
    """Explain the largest peak, and say whether there is one at the ball-pass frequency.

    Without a defect a sentence says why there are peaks at all.
    """
    peaks = {dof: peak for dof, peak in results.peaks.items() if peak.level > LEVEL_FLOOR}
    if not peaks:
        return ""
    most = results.late_spectra[max(peaks, key=lambda dof: peaks[dof].level)]
    rates = [rate for _, _, rate in passed_races(results.scene)]
    words = [reasons.peak(results, rates, briefly=briefly)]
    lowest = min((low for low, _ in results.bands.values() if not np.isnan(low)), default=0.0)
    words.append(reasons.ball_pass_peak(most, min(rates), lowest, briefly=briefly))
    if not results.scene.defects:
        words.insert(len(words) if briefly else 0, reasons.HEALTHY_SHAKES)
    return with_elements_of(results.scene.bearing, " ".join(filter(None, words)))


def passed_races(scene: Scene) -> list[tuple[str, int, float]]:
    """Races with a defect, and their ball-pass frequencies [Hz]; the outer race without defects.

    The number of the row is 0, unless rows are unlike: then each row that meets a defect counts.
    """
    speed, lines = scene.shaft_speed, []
    several = not scene.bearing.rows_are_alike
    for race in ("outer", "inner"):
        for row, (bearing, _) in enumerate(scene.bearing.unlike_rows):
            rows = (None, row) if several else (None, *range(len(scene.bearing.all_rows)))
            met = [d.race == race and d.row in rows for d in scene.defects] or [race == "outer"]
            if any(met):
                rate = bearing.bpfo(speed) if race == "outer" else bearing.bpfi(speed)
                lines.append((race, row + 1 if several else 0, rate))
    return lines


def pass_frequencies(scene: Scene, top: float) -> dict[str, NDArray[np.float64]]:
    """Frequencies [Hz] at which balls pass the defects, with harmonics up to `top`.

    Without a defect nothing strikes, and only the first few are marked.

    Columns: the frequency, 1 for the inner race, the number of the row (0 if rows are alike), and
    the error [Hz] if the inside is estimated. The outer race comes first.
    """
    most = np.inf if scene.defects else FEW
    lines = [np.empty((0, 4))]
    for race, row, first in passed_races(scene):
        bearing = scene.bearing.of_row(max(row - 1, 0))
        spread = first * bearing.frequency_spread("bpfo" if race == "outer" else "bpfi")
        count = int(min(top / first, most)) if first > 0.0 else 0
        line = np.tile([0.0, float(race == "inner"), float(row), spread], (count, 1))
        line[:, 0] = first * np.arange(1.0, count + 1.0)
        lines.append(line)
    columns = np.concatenate(lines).T.copy()
    return dict(zip(("frequency", "inner", "row", "spread"), columns, strict=True))
