"""The sentences of a diagnosis. Remarks follow another sentence and begin with a space."""

from __future__ import annotations

from collections.abc import Sequence

from bearingcore.common import count, decibels, number, percent, percent_off, probability, span
from bearingcore.measured.diagnosis._part.evidence import OtherLines, PartEvidence
from bearingcore.measured.diagnosis._part.mains import twice_mains
from bearingcore.measured.diagnosis._part.parts import BALL
from bearingcore.measured.diagnosis._part.probability import DEVIATIONS

FAR = 0.01
"""Relative deviation of a race's lines; 2 of 52 measured records that name a race exceed it."""


def dropout_message(share: float) -> str:
    """Sentence for a signal with too large a `share` of dropouts to analyse the rest."""
    return (
        f"{percent(share, 2)} of the signal is missing or too close to a gap: there, numbers are "
        "held, interpolated or repeated, as if the sensor had dropped out."
    )


def left_out(share: float) -> str:
    """Remark on a `share` of the samples that dropped out; the rest was analysed."""
    return (
        f" {percent(share, 2)} of the samples were not measured but held, interpolated or repeated "
        "and do not count."
    )


def too_short(duration: float, passes: float, fewest: int) -> str:
    """Sentence for a signal with fewer ball passes than are needed."""
    return (
        f"{number(duration)} s hold "
        f"{count(int(passes), 'ball pass', 'ball passes')}, and at least {fewest} are "
        "needed."
    )


def too_slow(rate: float, needed: float) -> str:
    """Sentence for a sample rate [Hz] too low to show repeating impacts."""
    return (
        f"Sampled at {number(rate, 4)} Hz, the signal lacks the high frequencies that "
        f"show repeating impacts at this speed; {number(needed, 4)} Hz or more are needed."
    )


def too_far(known: str, end: str, speed: float, why: str) -> str:
    """Sentence for a signal that is unfit at one end of the range of possible speeds [Hz]."""
    return (
        f"The shaft speed {known}. At the {end} possible speed, {number(60.0 * speed, 4)} rpm: "
        f"{why} Give the shaft speed; this record may then be enough."
    )


def other_unit(speed: float, other: float) -> str:
    """Sentence for a speed [Hz] that is 60 times too high or too low by the lines of the shaft."""
    return (
        f"Lines of the shaft do not show at {number(60.0 * speed, 4)} rpm, but clearly at "
        f"{number(60.0 * other, 4)} rpm: check whether the speed is in Hz or in rpm."
    )


def speed_changes(change: float) -> str:
    """Sentence for a speed that changes by a fraction and so blurs all lines."""
    return (
        f"The speed changes by {percent(change, 2)} of its mean or more, which blurs the lines of "
        "all parts. Take a steadier part of the record, or record the speed along with the signal."
    )


def other_shaft(part: PartEvidence, shaft: float) -> str:
    """Sentence for lines of a part with sidebands of another shaft than the stated one [Hz]."""
    spacing = part.foreign_spacing
    return (
        f"There are impacts at {number(part.frequency, 4)} Hz ({decibels(part.level)} above local "
        f"noise), as from a damaged {part.part}, but with sidebands {number(spacing, 3)} Hz apart, "
        f"{number(spacing / shaft, 3)} times the shaft speed. Neither this shaft nor its cage "
        f"makes such sidebands, nor does an {part.part} that stands still. Something that turns at "
        f"{number(60.0 * spacing, 3)} rpm makes these impacts. Check the speed, the sample rate "
        "and the bearings of other shafts."
    )


def lines_elsewhere(stated: float, shown: float) -> str:
    """Sentence for lines of the shaft at another speed [Hz] than the stated one."""
    return (
        f"The shaft's own lines are at {number(60.0 * shown, 4)} rpm, {number(shown / stated, 3)} "
        f"times the stated speed, and none are at {number(60.0 * stated, 4)} rpm: the speed or the "
        f"sample rate is wrong. If it is the speed, give {number(60.0 * shown, 4)} rpm."
    )


def against_the_shaft(part: PartEvidence) -> str:
    """Sentence for lines that fit a part only at a speed that the shaft does not have."""
    return (
        f"Impacts at {number(part.frequency, 4)} Hz ({decibels(part.level)} above local noise) fit "
        f"the {part.part} only at the stated speed, and the signal contradicts that speed."
    )


def damaged(part: PartEvidence) -> str:
    """Sentence that names the damaged part, with its evidence."""
    shown = int((part.harmonics > part.noise).sum())
    broad = part.part == BALL and part.deviations >= DEVIATIONS
    clear = (
        f"{number(part.deviations, 2)} standard deviations above all other lines, over all bands"
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
            " They have no sidebands at the cage frequency: impacts of another source whose rate "
            "drifts near this frequency look the same."
        )
    if part.part != BALL and abs(part.slip) > FAR:
        words += " Lines of a race seldom deviate as much: check the bearing and the speed."
    return words


def beside(other: PartEvidence) -> str:
    """Remark on lines of the other race, which is not named."""
    return (
        f" The {other.part} shows too: impacts at {number(other.frequency, 4)} Hz, "
        f"{decibels(other.level)} above local noise, probability {probability(other.probability)}. "
        "Inspect both races."
    )


def perhaps_a_ball() -> str:
    """Remark on a damaged ball, another cause of a race's lines."""
    return " The cause may be a damaged ball: inspect the balls too."


def magnetic(part: PartEvidence) -> str:
    """Sentence for lines of a part at a frequency where magnetic noise has lines too."""
    return (
        f"Lines of the {part.part} show ({number(part.frequency, 4)} Hz, {decibels(part.level)} "
        f"above local noise).{magnetic_alike(part)}"
    )


def magnetic_alike(part: PartEvidence) -> str:
    """Remark on magnetic noise, another cause of the lines, and a way to exclude it."""
    return (
        f" Magnetic noise of a motor at twice the mains frequency ({twice_mains(part.frequency):g} "
        "Hz) looks alike: measure at another speed, or check whether the lines vanish at once when "
        "the motor is switched off."
    )


def unmodulated(part: PartEvidence) -> str:
    """Sentence for impacts at the frequency of a part that turns, all equally strong."""
    return (
        f"Impacts at {number(part.frequency, 4)} Hz ({percent_off(part.slip)} against the "
        f"frequency of the {part.part}, {decibels(part.level)} above local noise) are not "
        f"modulated once per {part.sideband_source} turn, as damage of the {part.part} would be "
        "under a load that stands still. An axial load or one that turns with the shaft makes no "
        "modulation, nor does another source, such as the outer race of another bearing. Check the "
        "bearing's geometry and speed."
    )


def marked(part: PartEvidence) -> str:
    """Sentence for lines of a race that are too faint for damage of that race."""
    return (
        f"Lines of the {part.part} show ({number(part.frequency, 4)} Hz, {decibels(part.level)} "
        f"above local noise), but they modulate the envelope by only {percent(part.swing, 2)}. A "
        "damaged ball or a healthy bearing may make them. Measure again, closer to the bearing."
    )


def alike(part: PartEvidence, other: PartEvidence) -> str:
    """Sentence for lines of two parts that are about equally strong."""
    return (
        f"There are impacts, but the lines of the {part.part} ({decibels(part.level)}) and the "
        f"{other.part} ({decibels(other.level)}) are about equally strong. A damaged ball makes "
        "lines of both races."
    )


def not_alone(part: PartEvidence, other: OtherLines) -> str:
    """Sentence for lines of a part that others equal, or whose sidebands do not fit."""
    return (
        f"There are lines at the frequency of the {part.part} ({decibels(part.level)}), but "
        f"others, at {number(other.order)} times a turn ({decibels(other.level)}), are as strong, "
        "or the sidebands do not fit. Check the bearing's geometry and speed."
    )


def not_carried(part: PartEvidence) -> str:
    """Sentence for lines at a ball's frequency that a damaged ball would not make."""
    return (
        f"There are lines at {number(part.order, 4)} times a turn ({decibels(part.level)} above "
        "local noise), as from a damaged ball, but they are too weak or lack its sidebands at the "
        "cage frequency. They may come from a race of another bearing. Check the bearing's "
        "geometry and speed."
    )


def unexplained(other: OtherLines) -> str:
    """Sentence for a line that no part of this bearing makes."""
    return (
        f"A line at {number(other.order)} times a turn ({number(other.frequency, 4)} Hz, "
        f"{decibels(other.level)} above local noise) comes from no part of this bearing. Check its "
        "geometry and speed, or look for another source."
    )


def nothing_but(why: str, share: float) -> str:
    """Sentence for a signal without lines, with a fault that may hide them."""
    return f"No damage shows, but {why} ({percent(share, 2)}), which may hide it."


def blows(kurtosis: float, duration: float) -> str:
    """Sentence for impacts that do not repeat at the rate of any part."""
    return (
        f"There are impacts (kurtosis {number(kurtosis, 2)}; smooth running has 2), but in "
        f"{number(duration)} s not at the rate of any part of this bearing. Other sources and "
        "widespread wear make such impacts. Measure again, longer."
    )


def weak(detectable: float, duration: float) -> str:
    """Sentence for a signal without lines, too short to show any but strong ones."""
    return (
        f"No damage shows, but {number(duration)} s show only damage that makes the "
        f"vibration's power swing by {percent(detectable, 2)} of its mean or more. A longer "
        "recording shows more."
    )


ROUNDED = (
    "No damage shows, but between its tones the signal holds no vibration, only the rounding of "
    "its numbers. Any bearing vibrates: check the sensor, its range and filter."
)
"""Sentence for a signal without lines that holds no vibration of a bearing either."""


def healthy(detectable: float) -> str:
    """Sentence for a bearing without visible damage."""
    return (
        "No damage seen on outer race, inner race or balls: their lines do not show. "
        f"Impacts that make the vibration's power swing by {percent(detectable, 2)} of its mean, "
        "at their frequency and its harmonics, would have been seen in nine of ten such records."
    )


def faint(part: PartEvidence) -> str:
    """Sentence for lines too faint to name a part, or for impacts that show no line in any band."""
    if part.level < part.noise:
        return (
            f"No line stands out, but the power of all bands together swings more at the frequency "
            f"of the {part.part} ({number(part.frequency, 4)} Hz) than beside it, so that damage "
            "cannot be excluded. Measure again, longer or closer to the bearing."
        )
    return (
        f"There are faint lines at the frequency of the {part.part} "
        f"({number(part.frequency, 4)} Hz, {decibels(part.level)} above local noise; noise itself "
        f"reaches {decibels(part.noise)}). Measure again, longer or closer to the bearing."
    )


WHICH_BEARING = (
    "Which part is damaged depends on the bearing, which is not known. Choose one from the list, "
    "or enter its designation or its frequencies."
)
"""Sentence for a signal of an unknown bearing."""


def which_speed(frequency: float, readings: Sequence[tuple[str, float]]) -> str:
    """Sentence for impacts whose part depends on the unknown speed."""
    ways = " or ".join(f"the {part} at {number(60.0 * speed, 4)}" for part, speed in readings)
    return (
        f"There are impacts at {number(frequency, 4)} Hz. They may be {ways} rpm, or come from "
        "elsewhere: the shaft speed decides."
    )
