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

NONE_SEEN, CANNOT_TELL = "none seen", "cannot tell"
BESIDE = 0.5
"""Probability of a race from which the other one is judged as damaged beside it."""

LIKELY = 0.9
"""Probability from which a part is called damaged without a "probably"."""


@dataclass(frozen=True)
class PartEvidence:
    """Evidence for damage of one part.

    Attributes
    ----------
    part
        "outer race", "inner race" or "ball".
    nominal_frequency, nominal_order
        of its line by the geometry [Hz], [turns of the shaft]; of a ball twice its spin.
    frequency, order
        where its strongest lines are [Hz], [turns of the shaft].
    slip
        by how much that differs from nominal, as a fraction.
    harmonics : (h,) [dB]
        levels of the line and its harmonics over their surroundings.
    level
        [dB] of them together: the mean without the loudest, so that no single line decides.
    noise
        [dB] that noise alone reaches in one of a thousand signals.
    lead
        [dB] above noise, above all other lines in the band and above the other race's, and of the
        sidebands that the part should make; the least of these. Below 0 the lines are not there.
    line_lead
        [dB] the same of the lines alone, whatever their sidebands.
    modulation
        logarithm of how often noise reaches the sidebands that the part's own turning makes,
        against one signal of a hundred, with its sign changed: above 0 they are there. Infinite for
        an outer race, which stands still.
    foreign_spacing
        [Hz] of sidebands that neither the shaft nor the cage makes; NaN where there are none. They
        are looked for at the outer race, which makes no sidebands of its own.
    depth
        by how much the envelope swings at these lines, as a share of its mean.
    swing
        the same with the first sidebands.
    deviations
        by how much all bands together show these lines above all others, in short segments, in
        standard deviations; of a ball above races and shaft sidebands too.
    magnetic
        probability that lines here are magnetic noise at twice the mains' frequency; 0 where they
        are more than 1 % off 100 and 120 Hz.
    probability
        that this part is damaged; both races may be.
    sidebands : (h, 2) [dB]
        levels below and above each harmonic, `sideband_spacing` away.
    sideband_spacing
        [Hz] one turn of the shaft for the races, of the cage for a ball.
    sideband_source
        "shaft" or "cage".
    band
        [Hz] in which the lines were seen best.
    direction
        of the recording in which they were.
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
    modulation: float
    depth: float
    swing: float
    deviations: float
    magnetic: float
    probability: float
    sidebands: NDArray[np.float64]
    sideband_spacing: float
    sideband_source: str
    band: Band
    direction: str
    kurtosis: float
    foreign_spacing: float = math.nan

    @property
    def modulated(self) -> bool:
        """Whether the sidebands that the part's own turning makes are there."""
        return 0.0 <= self.modulation < math.inf

    @property
    def without_magnetic(self) -> float:
        """Its probability if nothing of it were magnetic noise."""
        return self.probability / (1.0 - self.magnetic)


def leading_by(one: PartEvidence) -> tuple[float, float]:
    """The order of parts: by probability, then by lead."""
    return one.probability, one.lead


@dataclass(frozen=True)
class OtherLines:
    """The strongest lines in the signal that are none of this bearing's.

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
        that the fault named is the true one, never 1; without a clear result that of the part
        that leads.
    status
        how it ended.
    detail
        the finding in a sentence, or why nothing is clear.
    evidence
        of each part: outer race, inner race, ball; empty where nothing could be looked at.
    shaft_speed
        [rad/s] on which it rests; None where none was found.
    speed_source
        where that is from: "given", "from the file", "assumed", "looked for", ...
    bearing_source
        where the bearing is from, likewise.
    other
        the strongest lines that are none of this bearing's, if any are clear.
    detectable_depth
        the least swing of the squared envelope, the power of the vibration, at each of the lines,
        as a share of its mean, that would have been seen in nine of ten such records.
    spectrum
        that of the envelope in the band of the best evidence; None with no evidence.
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

    @property
    def sentence(self) -> str:
        """The answer in sentences, to pass on, with the shaft speed on which it rests."""
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
        return f"{words} Shaft speed {speed} turns a minute ({self.speed_source})."

    @property
    def conclusive(self) -> bool:
        """Whether a part is named, or none seen where one would have been."""
        return self.fault != CANNOT_TELL

    @property
    def names_a_part(self) -> bool:
        """Whether a part is named."""
        return self.fault in PARTS

    @property
    def perhaps_a_ball(self) -> bool:
        """Whether a damaged ball may have made the lines of the race that is named."""
        return self.fault in (OUTER, INNER) and self.probability < LIKELY

    @property
    def other_race(self) -> PartEvidence | None:
        """Evidence of the other race, where one is named and the other is damaged too, probably."""
        if self.fault not in (OUTER, INNER):
            return None
        other = self.of(INNER if self.fault == OUTER else OUTER)
        return other if other.probability >= BESIDE else None

    @property
    def leading(self) -> PartEvidence | None:
        """Evidence of the part that leads, be it named or not; None with no evidence."""
        return max(self.evidence, key=leading_by, default=None)

    def of(self, part: str) -> PartEvidence:
        """The evidence of a part, by its name; KeyError where nothing could be looked at."""
        for one in self.evidence:
            if one.part == part:
                return one
        raise KeyError(part)

    def table(self) -> ResultTable:
        """A row a part with its evidence; next to them the spectrum of the envelope, if any.

        Without a shaft speed what rests on it is NaN.
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
            ("magnetic_noise", "1", each("magnetic"), "share of twice the mains"),
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
