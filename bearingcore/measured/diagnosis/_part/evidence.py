"""Result of a diagnosis, and its evidence."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import ResultTable, number, shown_as_table, table_of
from bearingcore.measured.diagnosis._part.parts import INNER, OUTER, PARTS
from bearingcore.measured.diagnosis._part.status import DiagnosisStatus
from bearingcore.measured.signals._filter_bank import Band
from bearingcore.recordings import Recording

NONE_SEEN, CANNOT_TELL = "none seen", "cannot tell"
BESIDE = 0.5
"""Least probability of the other race at which it counts as damaged too."""

LIKELY = 0.9
"""Least probability of a part that is called damaged without a "probably"."""


@dataclass(frozen=True)
class PartEvidence:
    """Evidence for damage of one part.

    Attributes
    ----------
    part
        "outer race", "inner race" or "ball".
    nominal_frequency, nominal_order
        of its line by the geometry [Hz], [turns of the shaft]; for a ball twice its spin frequency.
    frequency, order
        of its strongest lines [Hz], [turns of the shaft].
    slip
        relative deviation of that frequency from the nominal one.
    harmonics : (h,) [dB]
        levels of the line and its harmonics over their surroundings.
    level
        [dB] mean of the harmonics without the loudest, so that no single line decides.
    noise
        [dB] level that noise alone reaches in one of a thousand signals.
    lead
        [dB] least of four margins: above noise, above all other lines in the band, above the lines
        of the other race, and that of the sidebands that the part should make. Below 0 its lines
        are absent.
    line_lead
        [dB] the same for the lines alone, without sidebands.
    modulation
        −ln(p/1 %), where p is the chance that noise alone reaches the height of the sidebands of
        the part's own rotation: above 0 they are present. Infinite for an outer race, which does
        not turn.
    foreign_spacing
        [Hz] of sidebands that neither the shaft nor the cage makes; NaN if there are none. They are
        searched at the outer race, which makes no sidebands of its own.
    depth
        swing of the envelope at these lines, relative to its mean.
    swing
        the swing including the first sidebands.
    deviations
        height of these lines above all others, over all bands and in short segments, in standard
        deviations; for a ball also above races and sidebands of the shaft.
    magnetic
        probability that these lines are magnetic noise at twice the mains frequency; 0 if they are
        more than 1 % off 100 and 120 Hz.
    probability
        probability that this part is damaged; both races may be.
    sidebands : (h, 2) [dB]
        levels below and above each harmonic, `sideband_spacing` away.
    sideband_spacing
        [Hz] one turn of the shaft for the races, of the cage for a ball.
    sideband_source
        "shaft" or "cage".
    band
        [Hz] in which the lines are clearest.
    direction
        direction of the recording with these lines.
    kurtosis
        of the signal in that band: 2 for noise, more for knocks.
    """

    part: str
    nominal_frequency: float
    nominal_order: float
    frequency: float
    order: float
    slip: float
    harmonics: NDArray[np.float64]
    level: float
    noise: float
    lead: float
    line_lead: float
    depth: float
    swing: float
    magnetic: float
    sidebands: NDArray[np.float64]
    sideband_spacing: float
    sideband_source: str
    band: Band
    direction: str
    kurtosis: float
    modulation: float = math.inf
    deviations: float = 0.0
    probability: float = 0.0
    foreign_spacing: float = math.nan

    @property
    def modulated(self) -> bool:
        """True if the sidebands of the part's own rotation are present."""
        return 0.0 <= self.modulation < math.inf

    @property
    def without_magnetic(self) -> float:
        """Probability of damage if magnetic noise were impossible."""
        return self.probability / (1.0 - self.magnetic)


def rank(part: PartEvidence) -> tuple[float, float]:
    """Return the rank of a part: by probability, then by lead."""
    return part.probability, part.lead


@dataclass(frozen=True)
class OtherLines:
    """The strongest lines in the signal that are not this bearing's.

    Attributes
    ----------
    frequency, order
        of the first [Hz], [turns of the shaft].
    level
        [dB] of its harmonics, as for a part.
    """

    frequency: float
    order: float
    level: float


@dataclass(frozen=True)
class EnvelopeLines:
    """The spectrum of the envelope on which a diagnosis rests.

    Attributes
    ----------
    frequency : (m,) [Hz]
    level : (m,) [dB]
        above local noise.
    band
        [Hz] of the signal whose envelope it is.
    direction
        of the recording.
    """

    frequency: NDArray[np.float64] = field(repr=False)
    level: NDArray[np.float64] = field(repr=False)
    band: Band
    direction: str


@shown_as_table
@dataclass(frozen=True)
class Diagnosis:
    """Diagnosis of the damaged part of a bearing.

    Attributes
    ----------
    fault
        "outer race", "inner race", "ball", "none seen" or "cannot tell".
    probability
        probability that the named fault is the true one, always below 1; that of the
        leading part if nothing is clear.
    status
        the outcome.
    detail
        the finding in a sentence, or the reason why nothing is clear.
    evidence
        of each part: outer race, inner race, ball; empty if the signal could not be analysed.
    shaft_speed
        [rad/s] used in the diagnosis; None if none was found.
    speed_source
        source of the speed: "given", "from the file", "assumed", "looked for", ...
    bearing_source
        source of the bearing, likewise.
    shaft_ratio
        turns of the bearing's shaft (whose speed is `shaft_speed`) per turn of the measured shaft.
    other
        the strongest clear lines of another source, if any.
    detectable_depth
        least detectable swing of the squared envelope (the power of the vibration) at each line, as
        a share of its mean: it would have been seen in nine of ten such records.
    spectrum
        spectrum of the envelope in the band of the best evidence; None without evidence.
    steady_recording
        the signal as if the shaft turned at its mean speed, if its speed changed and was measured
        with the signal. None if the speed is steady or was not measured.
    """

    fault: str
    probability: float
    status: DiagnosisStatus
    detail: str
    evidence: tuple[PartEvidence, ...]
    shaft_speed: float | None
    speed_source: str
    other: OtherLines | None
    detectable_depth: float
    spectrum: EnvelopeLines | None
    bearing_source: str = "given"
    shaft_ratio: float = 1.0
    steady_recording: Recording | None = field(default=None, repr=False, compare=False)

    @property
    def sentence(self) -> str:
        """The answer in sentences, with the shaft speed that was used."""
        words = self.detail
        if not self.conclusive:
            words = f"No clear result: {words[:1].lower()}{words[1:]}"
        if not self.evidence:
            return words
        if self.bearing_source != "given":
            words += f" Bearing {self.bearing_source}."
        if self.shaft_speed is None:
            return f"{words} No shaft speed is known ({self.speed_source})."
        speed = number(30.0 / math.pi * self.shaft_speed, 4)
        if self.shaft_ratio == 1.0:
            return f"{words} Shaft speed {speed} turns a minute ({self.speed_source})."
        ratio = f"{number(self.shaft_ratio, 4)} times the measured shaft"
        return f"{words} Bearing's shaft {speed} turns a minute, {ratio} ({self.speed_source})."

    @property
    def conclusive(self) -> bool:
        """True if a part is named, or none is seen although damage would have shown."""
        return self.fault != CANNOT_TELL

    @property
    def names_a_part(self) -> bool:
        """True if a part is named."""
        return self.fault in PARTS

    @property
    def perhaps_a_ball(self) -> bool:
        """True if a damaged ball may have made the lines of the named race."""
        return self.fault in (OUTER, INNER) and self.probability < LIKELY

    @property
    def other_race(self) -> PartEvidence | None:
        """Evidence of the other race if one is named and the other is probably damaged too."""
        if self.fault not in (OUTER, INNER):
            return None
        other = self.of(INNER if self.fault == OUTER else OUTER)
        return other if other.probability >= BESIDE else None

    @property
    def leading(self) -> PartEvidence | None:
        """Evidence of the most probable part, named or not; None without evidence."""
        return max(self.evidence, key=rank, default=None)

    def of(self, part: str) -> PartEvidence:
        """Return the evidence of a part by its name; KeyError if there is no evidence."""
        for evidence in self.evidence:
            if evidence.part == part:
                return evidence
        raise KeyError(part)

    def table(self) -> ResultTable:
        """Return a row for each part with its evidence, and the spectrum of the envelope, if any.

        Without a shaft speed, numbers that depend on it are NaN.
        """
        turns = math.nan if self.shaft_speed is None else 1.0
        parts, spectrum = self.evidence, self.spectrum
        count = len(parts[0].harmonics) if parts else 0

        def each(attribute: str, factor: float = 1.0) -> list[float]:
            value_of = attrgetter(attribute)
            return [factor * value_of(part) for part in parts]

        columns = table_of(
            ("part", "", [part.part for part in parts]),
            ("frequency", "Hz", each("frequency"), "of its strongest lines"),
            ("nominal_frequency", "Hz", each("nominal_frequency", turns), "by geometry"),
            ("order", "1", each("order", turns), "turns of the shaft"),
            ("nominal_order", "1", each("nominal_order")),
            ("slip", "1", each("slip", turns)),
            ("level", "dB", each("level"), "of all harmonics but the loudest"),
            ("noise", "dB", each("noise"), "reached in one of a thousand signals"),
            *(
                (f"harmonic_{k + 1}", "dB", [part.harmonics[k] for part in parts])
                for k in range(count)
            ),
            ("sidebands", "dB", [part.sidebands.mean() for part in parts], "their mean"),
            ("sideband_spacing", "Hz", each("sideband_spacing", turns)),
            ("envelope_swing", "1", each("depth"), "at the lines, of its mean"),
            ("swing_with_sidebands", "1", each("swing")),
            ("lead", "dB", each("lead"), "above noise and all other lines"),
            ("deviations", "1", each("deviations"), "in all bands together"),
            ("magnetic_noise", "1", each("magnetic"), "probability of magnetic noise"),
            ("probability", "1", each("probability")),
            ("band_low", "Hz", each("band.low")),
            ("band_high", "Hz", each("band.high")),
            ("direction", "", [part.direction for part in parts]),
            ("kurtosis", "1", each("kurtosis")),
        )
        if spectrum is None:
            return columns
        return columns | table_of(
            ("envelope_frequency", "Hz", spectrum.frequency),
            ("envelope_level", "dB", spectrum.level, "above local noise"),
        )
