"""The answer to how large a defect is: a status, and candidates with their probabilities."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from bearingcore.common.arrays import Array
from bearingcore.common.table import ResultTable, shown_as_table, table_of
from bearingcore.diagnosis.part.evidence import Diagnosis
from bearingcore.diagnosis.size.matching import PassQuality
from bearingcore.diagnosis.size.simulation import Band
from bearingcore.errors import Status
from bearingcore.scene.scene import Scene
from bearingcore.signals.averaging import BallPasses
from bearingcore.signals.recording import Recording


class SizingStatus(Status):
    """The outcome of a sizing."""

    SIZED = "sized", "One extent explains the signal, and no other does."
    AT_MOST = "at most", "The defect is shorter than what the compared band resolves."
    AT_LEAST = "at least", "The defect is as long as the longest extent considered."
    OTHER_PART = "other part", "The outer race is not named as damaged, so no extent is estimated."
    SUPPORT_NOT_MEASURED = (
        "support not measured",
        "Whole ball spacings are counted by natural frequencies: that needs the measured masses "
        "and stiffness of the support.",
    )
    TOO_MANY_STEPS = (
        "too many steps",
        "The search would take more steps of integration than allowed.",
    )
    NO_LINES = "no lines", "No lines stand out at the ball-pass frequency of an outer-race defect."
    ONE_TONE = (
        "one tone",
        "The mean ball pass is a tone; a defect's entry and exit show in many harmonics.",
    )
    UNEXPLAINED = "unexplained", "The best extent leaves much of the mean ball pass unexplained."
    OTHER_LEVEL = "other level", "The signal has another level than such a defect gives."
    SEVERAL = "several extents", "Several extents, whole ball spacings apart, explain the signal."
    WIDE = "wide range", "Extents over a wide range explain the signal nearly as well."
    LIKE_A_PIT = "like a pit", "A long spall and a pit explain the signal nearly as well."
    TWO_KNOCKS = (
        "two knocks",
        "A short pit explains the signal best, but its envelope has two knocks a ball pass.",
    )
    UNCONFIRMED = "unconfirmed", "Entry and exit in the envelope do not bear the extent out."


AT_MOST, AT_LEAST = SizingStatus.AT_MOST, SizingStatus.AT_LEAST


@dataclass(frozen=True)
class Candidate:
    """An extent that the time between entry and exit allows.

    Attributes
    ----------
    turns
        k, whole ball spacings in the extent.
    extent
        [rad]
    probability
        that this candidate is the true one, among all candidates.
    edge
        the edge model that fits best.
    waveform_misfit, spectrum_misfit : (d,)
        what is left unexplained of the mean ball pass; mean squared natural logarithm of the ratio
        of the smoothed spectra.
    level
        natural logarithm of simulated over measured power.
    scene
        with this defect: its modes, bands, motion and spectrum are the candidate's.
    """

    turns: int
    extent: float
    probability: float
    edge: str
    waveform_misfit: Array
    spectrum_misfit: Array
    level: float
    scene: Scene = field(repr=False)


@shown_as_table
@dataclass(frozen=True)
class Sizing:
    """Result of sizing a defect by a signal.

    Attributes
    ----------
    candidates
        by rising extent; their probabilities add up to 1. None where no extent was looked for.
    extent_uncertainty
        standard deviation [rad] of the extent if the most probable candidate is the true one.
    status
        how it ended.
    sentence
        the status with its numbers: how sure the answer is, or why there is none.
    diagnosis
        which part the signal names; None where it was given by hand.
    quality
        what the mean ball pass consists of.
    apart
        spread [rad] of extents that explain it nearly as well, in half a ball spacing.
    passes
        the measured mean ball pass and spectrum.
    band
        frequencies that were compared.
    recording
        the signal.
    """

    candidates: tuple[Candidate, ...]
    extent_uncertainty: float
    status: SizingStatus
    sentence: str
    passes: BallPasses
    band: Band
    recording: Recording = field(repr=False)
    quality: PassQuality
    apart: float = 0.0
    diagnosis: Diagnosis | None = None

    def said(self, status: SizingStatus, sentence: str) -> Sizing:
        """With another outcome."""
        return replace(self, status=status, sentence=sentence)

    @property
    def conclusive(self) -> bool:
        """Whether one candidate is clearly ahead of all others, and its extent is not a bound."""
        return self.status == SizingStatus.SIZED

    @property
    def bound(self) -> str:
        """At most or at least, where the best extent is at an end of the search; else empty."""
        return str(self.status) if self.status in (AT_MOST, AT_LEAST) else ""

    def table(self) -> ResultTable:
        """A row a candidate: extent, probability, edges and misfits."""
        candidates = self.candidates
        return table_of(
            ("extent", "rad", "extent"),
            ("ball_spacings", "", "turns", "whole ball spacings in it"),
            ("probability", "1", "probability"),
            ("edge", "", "edge"),
            ("waveform_misfit", "1", [c.waveform_misfit.mean() for c in candidates]),
            ("spectrum_misfit", "1", [c.spectrum_misfit.mean() for c in candidates]),
            of=candidates,
        )

    @property
    def resolved(self) -> float:
        """The extent [rad] that a ball passes in a cycle of the highest compared frequency."""
        spacing = self.best.scene.bearing.ball_spacing
        return spacing * self.passes.frequency / self.band.highest

    def end(self, bound: str) -> float:
        """Length [rad] of the defect at most, or at least, by `bound`."""
        room = 2.0 * self.extent_uncertainty
        if bound == AT_MOST:
            return max(self.best.extent + room, self.resolved)
        return self.best.extent - room

    @property
    def best(self) -> Candidate:
        """The most probable candidate. ValueError, with the sentence, where there is none."""
        if not self.candidates:
            raise ValueError(self.sentence)
        return max(self.candidates, key=lambda candidate: candidate.probability)
