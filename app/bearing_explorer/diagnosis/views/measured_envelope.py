"""Envelope spectrum of a measured signal."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import ENVELOPE_TOP, Measured
from bearing_explorer.diagnosis.views.frequency_lines import fundamentals, of_rows
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
        "to the inner race, at twice BSF to a ball. The band is that of the diagnosis, or, "
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

    def shown(self, model: Model, measured: Measured) -> Shown:
        turning = self.turning
        direction = self.direction(measured)
        band = self.band(measured, direction).band
        nyquist = 0.5 * measured.recording.sample_rate
        top = ENVELOPE_TOP
        if turning is not None:
            first = fundamentals(turning)
            top = max(8.6 * first["bpfo"], 2.3 * first["bpfi"], 20.0)
        top = min(top, 0.8 * nyquist)
        spectrum = measured.envelope(direction, band, top)
        return Shown(direction, top, spectrum, measured.envelope_resolution(top), band)

    def band(self, measured: Measured, direction: str) -> Demodulation:
        """The demodulation band [Hz] as chosen; ends that are not given are found."""
        low, high = (float(self.look[end] or math.nan) for end in ("low", "high"))
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
        if measured is None or self.diagnosed() is None:
            return chosen
        # elsewhere there is no diagnosis
        low, high = self.band(measured, chosen["direction"]).band
        return chosen | {"low": f"{low!r}", "high": f"{high!r}"}

    def words_of(self, model: Model, measured: Measured) -> str:
        shown = self.shown(model, measured)
        turning = self.turning
        assert shown.band is not None
        words = (
            f"Envelope along {shown.direction} between {shown.band[0]:.0f} and "
            f"{shown.band[1]:.0f} Hz, {self.band(measured, shown.direction).reason}. "
        )
        sets = [] if turning is None else of_rows(turning)
        return words + telling(shown, sets, *shown_unit(measured))


_PLACES = {
    "BPFO": ("bpfo", (1, 2, 3)),
    "BPFI": ("bpfi", (1, 2, 3)),
    "BSF": ("bsf", (2, 1, 4)),
    "FTF": ("ftf", (1, 2)),
}
_NEAR = 0.02  # slip, and what the shaft speed is off


def telling(shown: Shown, sets: Sequence[Mapping[str, float]], unit: str, size: float) -> str:
    """The bearing frequency, a set a row, at the highest line of the envelope."""
    frequency, density = shown.measured
    slowest = min((first["ftf"] for first in sets), default=0.0)
    lowest = max(2.5 * shown.resolution, 0.7 * slowest)
    seen = (frequency > lowest) & (frequency < shown.top)
    if not seen.any():
        return "It holds no lines."
    at = float(frequency[seen][density[seen].argmax()])
    height = float(amplitudes(shown.measured)[seen].max()) / size
    words = f"Its highest line, {style.number(height, 3)} {unit} at {style.number(at, 4)} Hz,"
    if not sets:
        return f"{words[:-1]}. Which part that is follows from bearing and shaft speed."
    lines = [
        (
            abs(at / (multiple * first[name]) - 1.0),
            multiple * first[name],
            multiple,
            title if len(sets) == 1 else f"{title} of row {row + 1}",
        )
        for row, first in enumerate(sets)
        for title, (name, multiples) in _PLACES.items()
        for multiple in multiples
    ]
    _, line, multiple, title = min(lines)
    if abs(at - line) > max(_NEAR * line, shown.resolution):
        return (
            f"{words} is at none of the bearing's frequencies: check the shaft speed and the "
            "bearing."
        )
    words += f" is {'' if multiple == 1 else f'{multiple}×'}{title}"
    if abs(at - line) > 1.5 * shown.resolution:
        off = 100.0 * (at / line - 1.0)
        side = "above" if off > 0.0 else "below"
        words += f", {style.number(abs(off), 2)} % {side} what the geometry says"
    return f"{words}."
