"""The next step after a diagnosis, and how soon, in sentences for planners.

The urgency follows from the zone of the vibration's velocity and from its growth. The intervals are
a rule of thumb, and the sentences say so.
"""

from __future__ import annotations

import math

from bearing_explorer.diagnosis.diagnoses import Question
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.views.measured_indicators import severity, zone_of
from bearing_explorer.diagnosis.views.part_words import finding, with_article
from bearing_explorer.diagnosis.views.trend import growth, line_growth
from bearingcore import Diagnosis, Trend
from bearingcore.common import number, percent
from bearingcore.measured.diagnosis import LIKELY, NONE_SEEN, DiagnosisStatus

GROWN = 2.0
"""Ratio to the baseline from which the vibration, or the line of the named part, has clearly
grown."""

MOSTLY_SHAFT = 0.5
"""Share of the shaft's own lines in the velocity's power from which the shaft is its cause."""

ONE_RECORD = "How fast the damage grows is not known: a trend of several records shows it."
PRACTICE = (
    "These intervals are a rule of thumb: neither computed nor checked against a standard. A "
    "machine that must not fail needs shorter ones."
)
UNSURE = "The part is not sure: confirm it by a second record where the process allows."

CLOSER = (
    "This record decides nothing about the bearing: measure again, with the sensor closer to it, "
    "at a higher sample rate, or for longer."
)
WHAT_HELPS = {
    DiagnosisStatus.SPEED_OPEN: "Read the shaft speed from a tachometer, a stroboscope or the "
    "drive: with it this record may be enough.",
    DiagnosisStatus.SPEED_CHANGES: "Measure again at a steady speed, or record a tachometer's "
    "pulses or the speed beside the vibration.",
    DiagnosisStatus.BEARING_OPEN: "Find out which bearing it is: with it this record may be "
    "enough.",
    DiagnosisStatus.DROPPED_OUT: "Check sensor, cable and recorder, and measure again: this record "
    "has gaps.",
    DiagnosisStatus.CLIPPED: "Measure again with a wider range: the peaks of this record are cut "
    "off.",
    DiagnosisStatus.MAGNETIC: "Measure again at another speed, or look whether the lines end at "
    "once when the motor is switched off.",
    DiagnosisStatus.OTHER_SHAFT: "Check the shaft speed, the sample rate and the shaft that the "
    "bearing is on: this record contradicts them.",
    DiagnosisStatus.OTHER_SOURCE: "Check which bearing it is and its speed, look for what else "
    "turns or strikes nearby, and measure again closer to the bearing.",
}
"""Remedies where no part is named, by the reason."""

ALIKE = "at the same point, speed and load"


def next_steps(
    diagnosis: Diagnosis,
    question: Question,
    zone: str = "",
    trend: Trend | None = None,
    shaft_share: float = math.nan,
) -> str:
    """Say in sentences what to do next, and how soon.

    Parameters
    ----------
    zone
        of ISO 20816-3; empty where it is not known.
    trend
        complete trend of several records, where there is one.
    shaft_share
        share of the velocity's power in the shaft's own lines; NaN where it is not known.
    """
    compared = trend is not None and len(trend.points) > 1 and question.measured.in_si
    change = float(trend.rms_change[-1]) if trend is not None and compared else 1.0
    if not diagnosis.names_a_part:
        return _without_a_part(diagnosis, zone, change)
    if trend is not None and compared and line_growth(trend):
        change = max(change, float(trend.line_change(diagnosis.fault)[-1]))
    of_the_shaft = shaft_share >= MOSTLY_SHAFT
    part = with_article(diagnosis.fault)
    words = [_how_soon(part, zone, change, diagnosis.probability < LIKELY, of_the_shaft)]
    if diagnosis.other_race is not None:
        words.append(f"Inspect {with_article(diagnosis.other_race.part)} too.")
    if of_the_shaft:
        words.append(
            f"Most of the velocity ({percent(shaft_share, 2)} of its power) is the shaft's own, 1 "
            "to 3 times its speed (unbalance, alignment): a new bearing will not lower it."
        )
    if diagnosis.probability < LIKELY and (zone in ("C", "D") or change >= GROWN):
        words.append(UNSURE)
    if not compared:
        words.append(ONE_RECORD)
    if zone in ("A", "B"):
        words.append("A low velocity does not clear a bearing: early damage hardly shows in it.")
    return " ".join([*words, PRACTICE])


def steps_now(
    measurement: Measurement,
    question: Question,
    diagnosis: Diagnosis,
    shaft_share: float = math.nan,
) -> str:
    """Say what to do next, from all that the session knows of the machine."""
    zone = zone_of(question.measured, measurement.machine_kind)
    return next_steps(diagnosis, question, zone, measurement.whole_trend, shaft_share)


def work_order(
    measurement: Measurement, question: Question, diagnosis: Diagnosis, length: str = ""
) -> str:
    """Write a work order, one fact a line; `length` is the length of the spall in words."""
    about, measured, trend = measurement.known_about, question.measured, measurement.whole_trend
    spall = f" Its spall is {length}." if length else ""
    compared = trend is not None and len(trend.points) > 1 and measured.in_si
    lines = {
        "Machine": about.machine,
        "Measuring point": about.point,
        "Recorded": about.date,
        "Finding": f"{finding(diagnosis, question)}{spall}",
        "Severity": severity(measured, measurement.machine_kind),
        "Growth": growth(trend) if trend is not None and compared else "",
        "To do": steps_now(measurement, question, diagnosis),
    }
    return "\n".join(f"{name}: {words}" for name, words in lines.items() if words)


def _how_soon(part: str, zone: str, change: float, unsure: bool, of_the_shaft: bool) -> str:
    """Say how soon to act on a named part, by the zone and growth of the vibration."""
    if zone == "D":
        cause = "find out why the shaft vibrates so, " if of_the_shaft else ""
        return (
            f"Now: the vibration is in zone D, which may damage the machine, and {part} is named. "
            "Stop it, or take load off it, as soon as the process allows, "
            f"{cause}and change the bearing."
        )
    if zone == "C" or change >= GROWN:
        why = "is in zone C, not for long operation" if zone == "C" else "has clearly grown"
        return (
            f"Soon: the vibration {why}. Order the bearing, change it at the next opportunity, and "
            f"measure every day until then, {ALIKE}."
        )
    first = "Confirm it first: measure again" if unsure else "Measure again"
    return (
        f"{first} within a week, {ALIKE}, and weekly from then on. Order the bearing, and have it "
        "inspected at the next planned stop."
    )


def _without_a_part(diagnosis: Diagnosis, zone: str, change: float) -> str:
    """Say what to do where the diagnosis names no part."""
    if diagnosis.fault == NONE_SEEN:
        words = "Measure again at the usual interval."
    else:
        words = WHAT_HELPS.get(diagnosis.status, CLOSER)
    if zone in ("C", "D"):
        soon = "now" if zone == "D" else "soon"
        words += (
            f" The vibration is in zone {zone} all the same: look {soon} for its cause in balance, "
            "alignment, looseness or another part."
        )
    elif change >= GROWN:
        words += (
            f" The vibration grew to {number(change, 2)} times that of the baseline: find out why."
        )
    return words
