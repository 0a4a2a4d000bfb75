"""A diagnosis in words: a headline, sentences, a summary to copy, and a table of evidence."""

from __future__ import annotations

import dataclasses
import html
import math

from bearing_explorer.diagnosis.diagnoses import Question
from bearing_explorer.diagnosis.machine import Machine
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.sized_defect import size_in_words
from bearing_explorer.diagnosis.views.part_lines import COLORS, NAMES, leading
from bearing_explorer.kit.plots import style
from bearingcore import Diagnosis, MeasuredExtent, PartEvidence, Sizing
from bearingcore.common import percent_off, probability, span
from bearingcore.measured.diagnosis import LIKELY, LOUDEST, NONE_SEEN, OUTER, SLIP, perhaps_a_ball

COUNTED = (
    " The number of {} is an estimate: if it is wrong, damage of a race shows at another "
    "frequency and is missed. Count them, or take the frequencies from the maker's sheet."
)
"""Warning after "no damage seen" if the number of balls or rollers is an estimate."""

LEAST_SPEED_RATIO = 1.05
"""Ratio of highest to lowest speed above which both are stated: noise scatters by less."""

LENGTH_HIDDEN = "the length of the spall does not show"

_FREQUENCY = {
    "outer race": "the outer-race frequency (BPFO)",
    "inner race": "the inner-race frequency (BPFI)",
    "ball": "twice the ball-spin frequency (2 BSF)",
}


def with_article(part: str) -> str:
    """Return a part with its article, for a sentence."""
    return "a ball" if part == "ball" else f"the {part}"


def mood(answer: Diagnosis) -> str:
    """Return "fault" for damage, "healthy" for none, or "unknown" without an answer."""
    if answer.names_a_part:
        return "fault"
    return "healthy" if answer.fault == NONE_SEEN else "unknown"


def headline(answer: Diagnosis) -> str:
    """The answer in a few words."""
    if answer.names_a_part:
        words = with_article(answer.fault)
        probably = "" if answer.probability >= LIKELY else "probably "
        return f"{words[0].upper()}{words[1:]} is {probably}damaged"
    return "No damage seen" if answer.fault == NONE_SEEN else "No clear result"


def explanation(answer: Diagnosis, question: Question) -> str:
    """The answer explained in up to three sentences."""
    if answer.names_a_part:
        part = answer.of(answer.fault)
        modulated = f", modulated once per {part.sideband_source} turn" if part.modulated else ""
        doubt = perhaps_a_ball() if answer.perhaps_a_ball else ""
        return (
            f"Impacts at {style.number(part.frequency, 4)} Hz{modulated}: {_FREQUENCY[part.part]}, "
            f"by the geometry {style.number(part.nominal_frequency, 4)} Hz.{doubt}"
        )
    if answer.fault == NONE_SEEN:
        return (
            "No impacts repeat as those of a damaged outer race, inner race or ball would. Impacts "
            f"that make the vibration's power swing by {swing(answer.detectable_depth)} of its "
            "mean, at each harmonic, would have shown in nine of ten such records."
            f"{estimate_warning(question)}"
        )
    return answer.detail


def estimate_warning(question: Question) -> str:
    """Sentence on an estimated number of balls or rollers; empty for a given one."""
    bearing = question.bearing
    return COUNTED.format(bearing.kind.elements) if "n_balls" in bearing.estimated else ""


def length(measured: MeasuredExtent, sizing: Sizing | None = None) -> str:
    """Return the length of a spall in a few words, from its sizing where that is conclusive."""
    if sizing is not None and sizing.conclusive:
        return f"{size_in_words(sizing)} long, by the frequencies at which the machine rings"
    if measured.measured:
        return f"{measured.size} long (95 % interval), or longer by whole ball spacings"
    return measured.size or LENGTH_HIDDEN


def swing(depth: float) -> str:
    """Return a share of the envelope's mean in words."""
    return f"{style.number(100.0 * depth, 1 if depth < 0.095 else 2)} %"


def turns(answer: Diagnosis) -> str:
    """Return the shaft's mean speed in words; empty where none is known."""
    if answer.shaft_speed is None:
        return ""
    return f"{30.0 / math.pi * answer.shaft_speed:.0f} turns a minute"


def speed_range(answer: Diagnosis, measured: Measured) -> str:
    """Return the shaft's speed in words; from least to greatest if it was seen to change."""
    if measured.speed_limits is None or answer.shaft_speed is None:
        return turns(answer)
    least, most = (30.0 / math.pi * speed for speed in measured.speed_limits)
    if most <= LEAST_SPEED_RATIO * least:
        return turns(answer)
    return f"{span(least, most, 'turns a minute', 3)} (measured)"


def speed_sentence(measured: Measured) -> str:
    """Sentence on the shaft speed while the bearing is not known."""
    machine = measured.machine
    if machine.shaft_speed is None and measured.speeds is not None:
        return "A pulse of the tachometer counts as a turn until a shaft speed is given."
    if machine.shaft_speed is None:
        return "The shaft speed is not known; it is searched once the bearing is known."
    speed = f"{_rpm(machine.shaft_speed)}{machine.ratio_words}"
    return f"Shaft speed: {speed}, {machine.source_of('speed')}."


def assumptions(question: Question) -> str:
    """Say which facts of the answer are assumed: no person gave them for this file."""
    machine = question.measured.machine
    names = {
        "bearing": f"the bearing ({machine.bearing_name})",
        "speed": f"the shaft speed ({_rpm(machine.shaft_speed or 0.0)})",
    }
    words = ""
    for why, assumed in (
        ("Assumed from the look of the file", machine.guessed),
        ("Assumed to be as for the previous file", machine.kept),
    ):
        if listed := [text for name, text in names.items() if name in assumed]:
            words += f" {why}: {style.list_words(listed)}."
    if machine.unread:
        words += f" “{machine.unread}” in the designation is not known here and was ignored."
    return words


def _rpm(speed: float) -> str:
    """A shaft speed [rad/s] for a sentence."""
    return f"{style.number(30.0 / math.pi * speed, 4)} turns a minute"


def speed_source(answer: Diagnosis, machine: Machine) -> str:
    """Source of the shaft speed of an answer, in words."""
    source = machine.source_of("speed")
    for prefix in ("given by the recording", "given"):
        if answer.speed_source.startswith(prefix):
            return source + answer.speed_source.removeprefix(prefix)
    return f"{source or 'not given'}; {answer.speed_source}"


def sentence(answer: Diagnosis, question: Question) -> str:
    """The answer in sentences, with the shaft speed and its source."""
    source = speed_source(answer, question.measured.machine)
    ratio = question.measured.machine.ratio
    answer = dataclasses.replace(answer, speed_source=source, shaft_ratio=ratio)
    return answer.sentence + assumptions(question) + truth(question)


def finding(answer: Diagnosis, question: Question) -> str:
    """The finding for a technician, with its assumptions."""
    speed, doubt = speed_range(answer, question.measured), assumptions(question)
    at_speed = f" at {speed}" if speed else ""
    name = question.measured.machine.bearing_name
    head = f"bearing{f' {name}' if name else ''}{at_speed}: "
    if answer.names_a_part:
        part = answer.of(answer.fault)
        return (
            f"{head}{headline(answer).lower()} (probability {probability(answer.probability)}); "
            f"impacts at {style.number(part.frequency, 4)} Hz, {part.order:.2f} a turn.{doubt}"
        )
    if answer.fault == NONE_SEEN:
        return (
            f"{head}no damage seen on outer race, inner race or balls (probability "
            f"{probability(answer.probability)}). This says nothing about lubrication, balance or "
            f"other bearings.{estimate_warning(question)}{doubt}"
        )
    return f"{head}no clear result from this signal.{doubt}"


def facts(answer: Diagnosis, question: Question) -> list[list[str]]:
    """The assumptions of the answer: [name, value]."""
    bearing = question.bearing
    angle = style.in_degrees(bearing.contact_angle)
    machine = question.measured.machine
    speed, source = speed_range(answer, question.measured), speed_source(answer, machine)
    rows = [
        ["Shaft", f"{speed}{machine.ratio_words}, {source}" if speed else source],
        ["Slip", f"balls up to {style.number(100.0 * SLIP, 2)} % slower or faster, assumed"],
        [
            "Bearing",
            f"{bearing.n_balls} {bearing.kind.elements} of "
            f"{style.number(1e3 * bearing.ball_diameter, 5)} mm on "
            f"{style.number(1e3 * bearing.pitch_diameter, 5)} mm, contact angle {angle}"
            f"{_origin(question)}",
        ],
    ]
    if not question.measured.in_si:
        rows.append(["Unit", "not known; the part does not depend on it"])
    if answer.spectrum is not None:
        words = band(*answer.spectrum.band) + question.measured.along(answer.spectrum.direction)
        rows.append(["Demodulation band", f"{words}, chosen"])
    return rows


def _origin(question: Question) -> str:
    """Source of the bearing of an answer, after a comma."""
    machine, estimated = question.measured.machine, question.bearing.estimated
    source = machine.source_of("bearing")
    if machine.by_frequencies:
        return f", from its {machine.bearing_name} ({source}); only ratios of sizes are known"
    known = "".join(f", {words}" for words in (machine.bearing_name, source) if words)
    if not estimated:
        return known
    spread = question.bearing.frequency_spread("bpfo")
    off = f", so BPFO ± {style.number(100.0 * spread, 2)} %" if spread else ""
    return f"{known}, estimated from the designation{off}"


def band(low: float, high: float) -> str:
    """A band [Hz] in kHz."""
    return f"{style.number(1e-3 * low, 2)} to {style.number(1e-3 * high, 2)} kHz"


def truth(question: Question) -> str:
    """Say the true state behind a simulated signal, and if it is unrealistically quiet."""
    part = question.measured.true_part
    if not part:
        return ""
    if part != "none":
        return f" The signal is simulated: {with_article(part)} is damaged."
    words = " The signal is simulated: the bearing is healthy."
    if question.measured.noiseless:
        words += (
            " Without any noise even a healthy bearing's balls show as they pass under the load; "
            "no machine is so quiet. Simulate it with noise."
        )
    return words


def evidence_html(answer: Diagnosis, several: bool = True) -> str:
    """The evidence for each part as an HTML table; with directions where there are `several`.

    Without a clear result, no part has a probability or is marked: that would look like a verdict.
    """
    if not answer.evidence:
        return ""
    harmonics = range(1, len(answer.evidence[0].harmonics) + 1)
    heads = [
        ("Part", ""), ("Order", "nominal"), ("Line", "slip"),
        *((f"{k}×", "dB" if k == 1 else "") for k in harmonics),
        ("Together", "dB"), ("Sidebands", "dB"), ("Demodulation band", ""),
        *([("Probability", "")] if answer.conclusive else []),
    ]  # fmt: skip
    head = "".join(_cell(words, below, 'th scope="col"') for words, below in heads)
    body = "".join(_evidence_row(part, answer, several) for part in answer.evidence)
    return (
        '<div class="rows" tabindex="0" role="region" aria-label="Evidence for each part"><table>'
        f"<caption>Evidence for each part</caption><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )


def _evidence_row(part: PartEvidence, answer: Diagnosis, several: bool) -> str:
    """A row of that table; without a shaft speed, it has no number that depends on it."""
    lead, known = leading(answer), answer.shaft_speed is not None
    rotates, slip = part.part != OUTER, percent_off(part.slip)
    near = part.sidebands[: len(part.sidebands) // 2]
    spacing = f"± {style.number(part.sideband_spacing, 3)} Hz, {part.sideband_source}"
    swatch = f'<i class="swatch" style="background: {style.css_color(COLORS[part.part])}"></i>'
    cells = [
        f'<th scope="row">{swatch}{part.part}<small>{NAMES[part.part]}</small></th>',
        _cell(f"{part.order:.3f}" if known else "?", f"of {part.nominal_order:.3f}"),
        _cell(f"{style.number(part.frequency, 4)} Hz", slip if known else "not known"),
        *(
            _cell(
                f"{'≥ ' if level >= LOUDEST else ''}{decibels(level)}",
                tag='td class="clear"' if lead and level > part.noise else "td",
            )
            for level in part.harmonics.tolist()
        ),
        _cell(decibels(part.level), f"noise {decibels(part.noise)}"),
        _cell(
            decibels(float(near.mean())) if rotates else "none expected",
            spacing if rotates and known else "",
        ),
        _cell(band(part.band.low, part.band.high), f"along {part.direction}" if several else ""),
        *([_cell(probability(part.probability))] if answer.conclusive else []),
    ]
    leads = "leads" if part is lead and answer.conclusive else ""
    return f'<tr class="{leads}">{"".join(cells)}</tr>'


def _cell(words: str, below: str = "", tag: str = "td") -> str:
    small = f"<small>{html.escape(below)}</small>" if below else ""
    return f"<{tag}>{html.escape(words)}{small}</{tag.split()[0]}>"


def decibels(level: float) -> str:
    """A level for a table."""
    return f"{level:.0f}".replace("-0", "0").replace("-", "−")
