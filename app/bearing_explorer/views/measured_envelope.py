"""Envelope spectrum of a measured signal, and of the simulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from bearing_explorer.measurement.signal import Measured, Simulated
from bearing_explorer.plots import style
from bearing_explorer.state.sentences import sentence_of
from bearing_explorer.views.frequency_lines import fundamentals, of_rows
from bearing_explorer.views.frequency_view import ALONG, LINES, SCALE, FrequencyView, Look, Shown
from bearing_explorer.widgets.look import LookField

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results


class MeasuredEnvelope(FrequencyView):
    """Envelope spectrum of both in the demodulation band."""

    name = "measured-envelope"
    prefix = "measured_envelope"
    title = "Envelope spectrum, measured and simulated"
    about = (
        "How often impacts repeat. Each makes something ring, and the envelope of that rises: "
        "lines at BPFO speak for the outer race, at BPFI for the inner race, at "
        "twice BSF for a ball. Unless you give a band, it is the octave in which knocks stand "
        "out most."
    )
    first_look = Look(scale="linear", lines=("bpfo", "bpfi", "bsf", "ftf"))
    fields: ClassVar[list[LookField]] = [
        ALONG,
        SCALE,
        {"kind": "number", "name": "low", "label": "Band from", "hint": "auto"},
        {"kind": "number", "name": "high", "label": "to (Hz)", "hint": "auto"},
        LINES,
    ]

    def shown(self, results: Results, measured: Measured) -> Shown:
        model = Simulated(results, measured)
        first = fundamentals(model.scene)
        direction = self.direction(measured)
        band = self.band(measured, direction, first["bpfo"])
        nyquist = 0.5 * measured.recording.sample_rate
        top = max(8.6 * first["bpfo"], 2.3 * first["bpfi"], 20.0)
        top = min(top, 0.8 * nyquist)
        spectrum = measured.envelope(direction, band, top)
        try:
            simulated, why_not = model.envelope(direction, band, top), ""
        except ValueError as error:
            simulated, why_not = None, sentence_of(error)
        resolution = measured.envelope_resolution(top)
        return Shown(direction, top, spectrum, simulated, resolution, why_not, band)

    def band(self, measured: Measured, direction: str, passing: float) -> tuple[float, float]:
        """The demodulation band [Hz] as chosen; ends that are not given are found in the signal."""
        low, high = self.look.band
        if low is None or high is None:
            best = measured.band(direction, passing)
            low = low if low is not None else best[0] if high is None else 0.5 * high
            high = high if high is not None else best[1] if low == best[0] else 2.0 * low
        highest = 0.49 * measured.recording.sample_rate
        if not low < high:
            raise ValueError(
                f"a band from {style.number(low, 6)} to {style.number(high, 6)} Hz is empty"
            )
        if high > highest:
            raise ValueError(
                f"a band up to {style.number(high, 5)} Hz needs a faster sample rate; here it "
                f"ends at {highest:.0f} Hz"
            )
        return low, high

    def sentence(self, results: Results) -> str:
        measured = self.measured
        if measured is None:
            return self.why_nothing
        shown = self.shown(results, measured)
        sets = of_rows(measured.scene(results.scene))
        assert shown.band is not None
        chosen = "as chosen" if self.look.band != (None, None) else "where knocks stand out most"
        words = (
            f"Envelope along {shown.direction} between {shown.band[0]:.0f} and "
            f"{shown.band[1]:.0f} Hz, {chosen}. "
        )
        return words + telling(shown, sets) + f" {shown.why_not}".rstrip()


_PLACES = {
    "BPFO": ("bpfo", (1, 2, 3)),
    "BPFI": ("bpfi", (1, 2, 3)),
    "BSF": ("bsf", (2, 1, 4)),
    "FTF": ("ftf", (1, 2)),
}
_NEAR = 0.02  # slip, and what the shaft speed is off


def telling(shown: Shown, sets: Sequence[Mapping[str, float]]) -> str:
    """The bearing frequency, a set a row, at the highest line of the envelope."""
    frequency, density = shown.measured
    lowest = max(2.5 * shown.resolution, 0.7 * min(first["ftf"] for first in sets))
    seen = (frequency > lowest) & (frequency < shown.top)
    if not seen.any():
        return "It holds no lines."
    at = float(frequency[seen][density[seen].argmax()])
    words = f"Its highest line, at {style.number(at, 4)} Hz,"
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
            f"{words} is at none of the bearing's frequencies: shaft speed or bearing may be "
            "others."
        )
    words += f" is {'' if multiple == 1 else f'{multiple}×'}{title}"
    if abs(at - line) > 1.5 * shown.resolution:
        off = 100.0 * (at / line - 1.0)
        side = "above" if off > 0.0 else "below"
        words += f", {style.number(abs(off), 2)} % {side} what the geometry says"
    return f"{words}."
