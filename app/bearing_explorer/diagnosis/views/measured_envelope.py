"""Envelope spectrum of a measured signal."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import ENVELOPE_TOP, Measured
from bearing_explorer.diagnosis.views.frequency_lines import FAMILIES, fundamentals, row_frequencies
from bearing_explorer.diagnosis.views.frequency_view import (
    ALONG,
    AXIS,
    FIRST_LOOK,
    LINES,
    SCALE,
    FrequencyView,
    Shown,
    amplitudes,
)
from bearing_explorer.diagnosis.views.measured_view import HIGHEST_SHARE, Demodulation, shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.widgets.form import FieldSpec
from bearingcore.measured.diagnosis import PARTS


def _edge(name: str, label: str, words: str) -> FieldSpec:
    """The field of an edge of the demodulation band."""
    within = (words, "Hz", 1e-3, 1e7)
    return {"name": name, "label": label, "hint": "auto", "within": within}


class MeasuredEnvelope(FrequencyView):
    """Envelope spectrum of the measured acceleration in the demodulation band."""

    name = "measured-envelope"
    prefix = "measured_envelope"
    title = "Envelope spectrum"
    about = (
        "Rates at which impacts repeat. Each impact makes the "
        "machine ring, and the envelope rises: lines at BPFO point to the outer race, at BPFI "
        "to the inner race, at twice BSF to a ball. They are drawn where the geometry puts them, "
        "without slip. The band is that of the diagnosis, or, "
        "without one, where the kurtogram is highest; you can give another. A click puts a "
        "cursor on a line."
    )
    first_look: ClassVar[dict[str, Any]] = {
        **FIRST_LOOK,
        "scale": "linear",
        "lines": ["bpfo", "bpfi", "bsf", "ftf"],
        "low": "",
        "high": "",
    }
    look_fields: ClassVar[list[FieldSpec]] = [
        ALONG,
        SCALE,
        _edge("low", "Band from", "The lower end of the band"),
        _edge("high", "to (Hz)", "The upper end of the band"),
        AXIS,
        LINES,
    ]

    #: name of the recording for which a band was given; another recording does not keep it
    _band_of = ""

    def take_look(self, choices: Mapping[str, Any]) -> None:
        super().take_look(choices)
        if {"low", "high"} & set(choices) and self.measured is not None:
            self._band_of = self.measured.recording.name

    def show_look(self) -> None:
        if self.measured is not None and self.measured.recording.name != self._band_of:
            self.look = {**self.look, "low": "", "high": ""}
        super().show_look()

    def shown(self, model: Model, measured: Measured) -> Shown:
        turning = self.turning
        direction = self.direction(measured)
        band = self.band(measured, direction).band
        nyquist = 0.5 * measured.recording.sample_rate
        top = ENVELOPE_TOP
        if turning is not None:
            first = fundamentals(turning)
            top = max(8.6 * first["bpfo"], 2.3 * first["bpfi"], 20.0)
        top = min(top, 0.8 * nyquist, band[1] - band[0])  # an envelope has no lines beyond
        spectrum = measured.envelope(direction, band, top)
        return Shown(direction, top, spectrum, measured.envelope_resolution(top), band)

    def band(self, measured: Measured, direction: str) -> Demodulation:
        """Return the chosen demodulation band; a missing end is half or twice the given one."""
        low, high = (float(self.look[end] or math.nan) for end in ("low", "high"))
        if measured.recording.name != self._band_of:
            low = high = math.nan
        if math.isnan(low) and math.isnan(high):
            return self.demodulation(measured, direction)
        if math.isnan(low):
            low = 0.5 * high
        if math.isnan(high):
            high = 2.0 * low
        highest = HIGHEST_SHARE * measured.recording.sample_rate
        if not low < high:
            raise ValueError(
                f"a band from {style.number(low, 6)} to {style.number(high, 6)} Hz is empty"
            )
        if high > highest:
            raise ValueError(
                f"a band up to {style.number(high, 5)} Hz needs a faster sample rate; here it "
                f"ends at {highest:.0f} Hz"
            )
        return Demodulation((low, high), "as chosen")

    def choices(self) -> dict[str, Any]:
        measured = self.measured
        chosen = super().choices()
        if measured is None or self.diagnosed_envelope() is None:
            return chosen
        # exported lines make no diagnosis that would give the band
        low, high = self.band(measured, chosen["direction"]).band
        return chosen | {"low": f"{low!r}", "high": f"{high!r}"}

    def words_of(self, model: Model, measured: Measured) -> str:
        shown = self.shown(model, measured)
        turning = self.turning
        assert shown.band is not None
        assert self.measurement is not None
        low, high = shown.band
        words = (
            f"Envelope{measured.along(shown.direction)} between {low:.0f} and {high:.0f} Hz, "
            f"{self.band(measured, shown.direction).reason}. "
        )
        sets: list[dict[str, float]] = []
        if turning is not None:
            shaft = turning.shaft_speed / (2.0 * math.pi)
            sets = [first | {"shaft": shaft} for first in row_frequencies(turning)]
            if shown.top == high - low:
                words += f"It has no lines above {shown.top:.0f} Hz, the width of that band. "
        diagnosis = self.measurement.diagnosis()
        fault = diagnosis.fault if diagnosis is not None and diagnosis.names_a_part else ""
        return words + highest_line(shown, sets, *shown_unit(measured), fault)


_PLACES = {
    "BPFO": ("bpfo", (1, 2, 3)),
    "BPFI": ("bpfi", (1, 2, 3)),
    "BSF": ("bsf", (2, 1, 4)),
    "FTF": ("ftf", (1, 2)),
    "the shaft's turn": ("shaft", (1, 2, 3)),
}
_TITLES = {part: family.title for part, family in zip(PARTS, FAMILIES, strict=False)}
_NEAR = 0.02  # slip, and the error of the shaft speed
_CLEAR = 4.0
"""Ratio to the median from which a line stands out; the highest of 1600 lines of noise has 3.3."""


def _lines_near(
    peak: float, sets: Sequence[Mapping[str, float]], resolution: float
) -> list[tuple[float, float, float, str]]:
    """Return the lines of the bearing near a frequency [Hz], the nearest first.

    A line has its distance, its frequency, the error of the geometry (as fractions), and its name.
    """
    lines = sorted(
        (
            abs(peak / (multiple * first[name]) - 1.0),
            multiple * first[name],
            first.get(f"{name}_spread", 0.0) / first[name],
            ("" if multiple == 1 else f"{multiple}×")
            + (title if len(sets) == 1 else f"{title} of row {row + 1}"),
        )
        for row, first in enumerate(sets)
        for title, (name, multiples) in _PLACES.items()
        for multiple in multiples
        if first[name] > 0.0
    )
    return [
        line
        for line in lines
        if abs(peak - line[1]) <= max((_NEAR + line[2]) * line[1], resolution)
    ]


def highest_line(
    shown: Shown,
    sets: Sequence[Mapping[str, float]],
    unit: str,
    size: float,
    fault: str = "",
) -> str:
    """Describe the highest line of the envelope, and its source.

    `sets` are the frequencies [Hz] of each row and the shaft. If slip allows several lines, the
    line of the part that the diagnosis names (`fault`) is taken.
    """
    frequency, density = shown.measured
    slowest = min((first["ftf"] for first in sets), default=0.0)
    lowest = max(2.5 * shown.resolution, 0.7 * slowest)
    seen = (frequency > lowest) & (frequency < shown.top)
    if not seen.any():
        return "It holds no lines."
    peak, height = float(frequency[seen][density[seen].argmax()]), amplitudes(shown.measured)[seen]
    highest = float(height.max())
    place = f"{style.number(highest / size, 3)} {unit} at {style.number(peak, 4)} Hz,"
    if highest < _CLEAR * float(np.median(height)):
        return f"No line stands out: the highest, {place} is as high as noise gives."
    words = f"Its highest line, {place}"
    if not sets:
        return f"{words[:-1]}. Which part that is follows from bearing and shaft speed."
    near = _lines_near(peak, sets, shown.resolution)
    near = [line for line in near if fault and _TITLES[fault] in line[3]] or near
    if not near:
        return (
            f"{words} is at none of the bearing's frequencies: it comes from another part of the "
            "machine, or the bearing or the shaft speed is not the given one."
        )
    unresolved = [line[3] for line in near if abs(line[1] - near[0][1]) < shown.resolution]
    if len(unresolved) > 1:
        apart = f"{style.number(shown.resolution, 2)} Hz apart"
        return f"{words} may be {' or '.join(unresolved[:3])}: lines here are {apart}."
    _, line, _, title = near[0]
    words += f" is {title}"
    if abs(peak - line) > 1.5 * shown.resolution:
        off = 100.0 * (peak / line - 1.0)
        side = "above" if off > 0.0 else "below"
        words += f", {style.number(abs(off), 2)} % {side} the frequency by the geometry"
    return f"{words}."
