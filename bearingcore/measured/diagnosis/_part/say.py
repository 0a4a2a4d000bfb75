"""The sentences of a diagnosis."""

from __future__ import annotations

from collections.abc import Sequence

from bearingcore.common import (
    count,
    decibels,
    number,
    percent,
    percent_off,
    probability,
    span,
)
from bearingcore.measured.diagnosis._part.evidence import OtherLines, PartEvidence
from bearingcore.measured.diagnosis._part.mains import twice_mains
from bearingcore.measured.diagnosis._part.parts import BALL
from bearingcore.measured.diagnosis._part.probability import DEVIATIONS

FAR = 0.01
"""Of a race's frequency, by which its lines are off in 2 of 52 measured records that name one."""


def dropout_message(share: float) -> str:
    """Status where a `share` of the samples dropped out, too many to analyse the rest."""
    return (
        f"{percent(share, 2)} of the signal are gaps, or too near to one: held numbers, straight "
        "lines or repeats, as where a sensor dropped out."
    )


def left_out(share: float) -> str:
    """A `share` of the samples dropped out, and the rest was analysed."""
    return (
        f" {percent(share, 2)} of the samples were not measured but held, drawn as a straight line "
        "or repeated; they do not count."
    )


def too_short(duration: float, passes: float, fewest: int) -> str:
    """Too few knocks."""
    return (
        f"{number(duration)} s hold "
        f"{count(int(passes), 'ball pass', 'ball passes')}, and at least {fewest} are "
        "needed."
    )


def too_slow(rate: float, needed: float) -> str:
    """Sampled too slowly."""
    return (
        f"Sampled at {number(rate, 4)} Hz, the signal does not reach high enough to "
        f"show how impacts repeat at this speed; {number(needed, 4)} Hz or more are needed."
    )


def too_far(known: str, end: str, speed: float, why: str) -> str:
    """Unfit at one end of the speeds [Hz] that are looked for."""
    return (
        f"The shaft speed {known}. At the {end} speed looked for, {number(60.0 * speed, 4)} rpm: "
        f"{why} Give the shaft speed; this record may be enough then."
    )


def other_unit(speed: float, other: float) -> str:
    """The shaft's lines show at 60 times the speed [Hz] that is given, or at a 60th of it."""
    return (
        f"Lines of a shaft do not show at {number(60.0 * speed, 4)} rpm, but clearly at "
        f"{number(60.0 * other, 4)} rpm: is the speed given in Hz for rpm, or the other way?"
    )


def speed_changes(change: float) -> str:
    """Lines of all parts are blurred, as the speed changes by a fraction."""
    return (
        f"The speed changes by {percent(change, 2)} or more, which blurs the lines of all parts. "
        "Take a steadier part, or record the speed beside the signal."
    )


def other_shaft(part: PartEvidence, shaft: float) -> str:
    """The lines of a part have sidebands of another shaft than the stated one [Hz]."""
    spacing = part.foreign_spacing
    return (
        f"There are impacts at {number(part.frequency, 4)} Hz ({decibels(part.level)} above local "
        f"noise), as of a damaged {part.part}, but with sidebands {number(spacing, 3)} Hz apart, "
        f"{number(spacing / shaft, 3)} times the shaft speed. Neither this shaft nor its cage "
        f"makes them, and an {part.part} that stands still has none. Something that turns at "
        f"{number(60.0 * spacing, 3)} rpm makes these impacts. Check the speed, the sample rate "
        "and the bearings of other shafts."
    )


def lines_elsewhere(stated: float, shown: float) -> str:
    """The lines of the shaft show at another speed [Hz] than the stated one."""
    return (
        f"The shaft's own lines are at {number(60.0 * shown, 4)} rpm, {number(shown / stated, 3)} "
        f"times the stated speed, and none are at {number(60.0 * stated, 4)} rpm: the speed or the "
        f"sample rate is wrong. If it is the speed, give {number(60.0 * shown, 4)} rpm."
    )


def against_the_shaft(part: PartEvidence) -> str:
    """Lines fit a part only at a speed that the shaft does not have."""
    return (
        f"Impacts at {number(part.frequency, 4)} Hz ({decibels(part.level)} above local noise) fit "
        f"the {part.part} at the stated speed only, which the signal contradicts."
    )


def damaged(part: PartEvidence) -> str:
    """A part is named."""
    shown = int((part.harmonics > part.noise).sum())
    broad = part.part == BALL and part.deviations >= DEVIATIONS
    clear = (
        f"{number(part.deviations, 2)} deviations clearer than anything else in all bands together"
        if broad
        else f"{decibels(part.level)} above local noise, {shown} of {len(part.harmonics)} "
        "harmonics clear"
    )
    words = (
        f"Damage on the {part.part}: impacts at {number(part.frequency, 4)} Hz "
        f"({number(part.order, 4)} a turn, {percent_off(part.slip)} against the geometry), {clear}"
        f", demodulation band {span(1e-3 * part.band.low, 1e-3 * part.band.high, 'kHz', 2)}."
    )
    if broad and not part.modulated:
        words += (
            " They show no sidebands of the cage: blows of another source that wander around this "
            "frequency look alike."
        )
    if part.part != BALL and abs(part.slip) > FAR:
        words += " Lines of a race are seldom so far off: check bearing and speed."
    return words


def beside(other: PartEvidence) -> str:
    """The other race than the one named shows its lines too."""
    return (
        f" The {other.part} shows too: impacts at {number(other.frequency, 4)} Hz, "
        f"{decibels(other.level)} above local noise, probability {probability(other.probability)}. "
        "Inspect both races."
    )


def perhaps_a_ball() -> str:
    """Another cause of a race's lines."""
    return " The cause may be a damaged ball: inspect the balls too."


def magnetic(part: PartEvidence) -> str:
    """The lines of a part, where magnetic noise has its own."""
    return (
        f"Lines of the {part.part} show ({number(part.frequency, 4)} Hz, {decibels(part.level)} "
        f"above local noise).{magnetic_alike(part)}"
    )


def magnetic_alike(part: PartEvidence) -> str:
    """Another cause of lines at twice the mains' frequency, and how to exclude it."""
    return (
        f" Magnetic noise of a motor at twice the mains frequency ({twice_mains(part.frequency):g} "
        "Hz) looks alike: measure at another speed, or look whether it ends at once when the motor "
        "is switched off."
    )


def unmodulated(part: PartEvidence) -> str:
    """Impacts at the frequency of a part that turns, all of one size."""
    return (
        f"Impacts at {number(part.frequency, 4)} Hz ({percent_off(part.slip)} against the "
        f"frequency of the {part.part}, {decibels(part.level)} above local noise), but not "
        f"modulated once per {part.sideband_source} turn, as damage of the {part.part} is under a "
        "load that stands still. A load along the shaft, or one that turns with it, makes no "
        "modulation; nor does another source, such as the outer race of another bearing. Check the "
        "bearing's geometry and speed."
    )


def marked(part: PartEvidence) -> str:
    """The lines of a race, too faint for its own damage."""
    return (
        f"Lines of the {part.part} show ({number(part.frequency, 4)} Hz, {decibels(part.level)} "
        f"above local noise), but modulate the envelope by {percent(part.swing, 2)} only. A "
        "damaged ball or a healthy bearing may make them. Measure again, closer to the bearing."
    )


def alike(part: PartEvidence, other: PartEvidence) -> str:
    """The lines of two parts are seen."""
    return (
        f"There are impacts, but the lines of {part.part} ({decibels(part.level)}) and "
        f"{other.part} ({decibels(other.level)}) are about as strong. A damaged ball marks "
        "both races."
    )


def not_alone(part: PartEvidence, other: OtherLines) -> str:
    """Lines at a part's frequency that others reach, or without its sidebands."""
    return (
        f"There are lines where damage of the {part.part} has them ({decibels(part.level)}), but "
        f"others, at {number(other.order)} times a turn ({decibels(other.level)}), are as strong, "
        "or the sidebands do not fit. Check the bearing's geometry and speed."
    )


def not_carried(part: PartEvidence) -> str:
    """Lines at a ball's frequency that are none of a ball."""
    return (
        f"There are lines at {number(part.order, 4)} times a turn ({decibels(part.level)} above "
        "local noise), as of a damaged ball, but they are too weak or lack its sidebands at the "
        "cage frequency. They may be those of a race of another bearing. Check the bearing's "
        "geometry and speed."
    )


def unexplained(other: OtherLines) -> str:
    """Something else knocks."""
    return (
        f"A line at {number(other.order)} times a turn ({number(other.frequency, 4)} Hz, "
        f"{decibels(other.level)} above local noise) is none of this bearing. Check its geometry "
        "and speed, or look for another source."
    )


def nothing_but(why: str, share: float) -> str:
    """Nothing seen, and it means nothing."""
    return f"No damage shows, but {why} ({percent(share, 2)}), which may hide it."


def blows(kurtosis: float, duration: float) -> str:
    """Knocks that do not repeat as a part's do."""
    return (
        f"There are impacts (kurtosis {number(kurtosis, 2)}; smooth running has 2), but in "
        f"{number(duration)} s not at the rate of any part of this bearing. Other sources and "
        "widespread wear do that. Measure again, longer."
    )


def weak(detectable: float, duration: float) -> str:
    """Nothing seen, but nothing would have been."""
    return (
        f"No damage shows, but {number(duration)} s are enough only for damage that makes the "
        f"vibration's power swing by {percent(detectable, 2)} of its mean or more. A longer "
        "recording shows more."
    )


def rounded() -> str:
    """Nothing seen, in a signal that shows nothing of a bearing."""
    return (
        "No damage shows, but between its tones the signal holds no vibration, only the rounding "
        "of its numbers: a running bearing would show too. Check the sensor, its range and filter."
    )


def healthy(detectable: float) -> str:
    """None seen."""
    return (
        "No damage seen on outer race, inner race or balls: their lines do not show. "
        f"Impacts that make the vibration's power swing by {percent(detectable, 2)} of its mean, "
        "at their frequency and its harmonics, would have been seen in nine of ten such records."
    )


def faint(part: PartEvidence) -> str:
    """Lines too faint to name a part."""
    return (
        f"There are faint lines where damage of the {part.part} has them "
        f"({number(part.frequency, 4)} Hz, {decibels(part.level)} above local noise; noise itself "
        f"reaches {decibels(part.noise)}). Measure again, longer or closer to the bearing."
    )


def which_bearing() -> str:
    """A signal, but no bearing."""
    return (
        "Which part is damaged depends on the bearing, which is not known. Choose one of the list, "
        "or enter its designation or its frequencies."
    )


def which_speed(frequency: float, readings: Sequence[tuple[str, float]]) -> str:
    """Knocks, but the speed decides whose they are."""
    ways = " or ".join(f"the {part} at {number(60.0 * speed, 4)}" for part, speed in readings)
    return (
        f"There are impacts at {number(frequency, 4)} Hz, which may be {ways} rpm or come from "
        "elsewhere: the shaft speed decides."
    )
