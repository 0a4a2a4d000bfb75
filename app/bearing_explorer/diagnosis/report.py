"""One A4 page on a measured signal: the answer, the pictures behind it, all assumptions.

The browser finishes it, as it finishes the report of a scene; see `report`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from bokeh.embed import json_item

from bearing_explorer.diagnosis.diagnoses import Question
from bearing_explorer.diagnosis.machine import BEARING_SOURCES, SCENE, SIMULATED
from bearing_explorer.diagnosis.measurement_state import name_of
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.views import part_words
from bearing_explorer.diagnosis.views.diagnosis import RACES_NAMED, PartDiagnosis, panel_state
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.measured_indicators import no_velocity, severity, zone_of
from bearing_explorer.diagnosis.views.measured_kurtogram import MeasuredKurtogram
from bearing_explorer.diagnosis.views.measured_spectrum import MeasuredSpectrum
from bearing_explorer.diagnosis.views.measurement import MeasuredSignal
from bearing_explorer.diagnosis.views.next_steps import steps_now
from bearing_explorer.diagnosis.views.trend import TrendOfFiles, trend_words
from bearing_explorer.diagnosis.views.which_length import WhichLength
from bearing_explorer.diagnosis.widgets.part_panel import part_html
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.report_page import About, document, heading, mark_of
from bearing_explorer.kit.views.still_figure import Figure
from bearing_explorer.kit.widgets.facts import html_table, html_text
from bearingcore import Diagnosis
from bearingcore.bearings import FREQUENCIES
from bearingcore.common import number, percent, with_prefix

FILE = "bearing-report-{}.html"
NOT_SAID = "not said"
WIDTH, HEIGHT = 470, 200
"""Size [px] in which a figure is drawn; two stand side by side."""
MOST_FIGURES = 4
_ORIGINS = {
    "Said by": "From the file,", "A guess:": "Assumed:", "The file does not say it.": "Assumed",
}  # fmt: skip
FIGURES = {
    TrendOfFiles: "Trend",
    SpallExtent: "Mean ball pass",
    WhichLength: "Which length",
    PartDiagnosis: "Envelope spectrum",
    MeasuredKurtogram: "Kurtogram",
    MeasuredSignal: "The record",
    MeasuredSpectrum: "Spectrum",
}
"""Views whose first figure is shown, with its heading; those that come first are preferred."""

NOT_JUDGED = (
    "The cage, lubrication, balance, alignment and other bearings of the machine are not judged."
)
NOT_FORESEEN = (
    "The vibration shows neither the depth of the damage nor the remaining life of the bearing."
)
NO_SIZE = "The level of the vibration is not known, as the unit of the signal is not."


def _drawings(
    model: Model, measurement: Measurement, job_results: Mapping[str, Any], with_extent: bool
) -> tuple[list[str], list[Any], list[str]]:
    """Draw the figures that show something: their ids, their Bokeh items, and their HTML."""
    drawn: list[str] = []
    items: list[Any] = []
    figures: list[str] = []
    for view, title in FIGURES.items():
        figure = Figure(
            view,
            model,
            prepare=lambda view: _prepare(view, measurement),
            job_result=job_results.get(view.name),
            computed=False,
        )
        data, _ = figure.view.data(model)
        first, *_ = figure.view.figures
        if view is SpallExtent and not with_extent:
            continue
        if not any(column.size for columns in data.values() for column in columns.values()):
            continue
        # the table above the figures has the sentence on the trend
        caption = "" if view is TrendOfFiles else html_text(figure.sentence)
        drawn.append(first.id)
        items.append(json_item(figure.layout))
        figures.append(
            f"<figure><h2>{html_text(title)}</h2><div class='drawing'>{mark_of(first.id)}</div>"
            f"<figcaption>{caption}</figcaption></figure>"
        )
        if len(drawn) == MOST_FIGURES:
            break
    return drawn, items, figures


def _prepare(view: Any, measurement: Measurement) -> None:
    """Give a view the signal and the report's height; the places of names depend on the height."""
    view.measure(measurement)
    for plot in view.figures:
        plot.height = plot.min_height = plot.max_height = HEIGHT


def measured_report(
    model: Model,
    measurement: Measurement,
    job_results: Mapping[str, Any],
    about: About,
) -> dict[str, Any]:
    """Return the report for the browser to finish. For any thread: no model of the page is touched.

    Parameters
    ----------
    measurement
        copy of the session's measurement, see `Measurement.snapshot`.
    job_results
        results of jobs, by view.

    Raises
    ------
    ValueError
        with a sentence, where nothing is diagnosed yet, or the diagnosis is out of date.
    """
    question, answer = measurement.question(), measurement.diagnosis()
    if why := measurement.out_of_date:
        raise ValueError(why)
    if question is None or answer is None:
        raise ValueError("nothing is diagnosed yet")
    extent = measurement.extent() if answer.fault in RACES_NAMED else None
    with_extent = extent is not None and bool(extent.passes)
    drawn, items, figures = _drawings(model, measurement, job_results, with_extent)
    state = panel_state(question, answer)
    state["facts"] = ()
    if extent is not None:
        state["extent"] = part_words.length(extent, measurement.sizing())
    machine = question.measured.machine
    bearing = about.bearing if model.scene.bearing == machine.bearing else "Bearing"
    said, kind = measurement.known_about, measurement.machine_kind
    about = replace(about, machine=said.machine or about.machine)
    title = about.title.strip() or ", ".join(filter(None, (about.machine, said.point)))
    title = title or f"{machine.bearing_name or bearing}: {question.measured.recording.name}"
    if (
        SCENE not in (machine.bearing_source, machine.speed_source)
        and not question.measured.true_part
    ):
        about = replace(about, link="")  # its scene has nothing to do with the signal
    steps = steps_now(measurement, question, answer, question.measured.shaft_share)
    body = [
        *heading(about, title),
        f"<p>Measuring point: {html_text(said.point or NOT_SAID)}. "
        f"Recorded: {html_text(said.date or NOT_SAID)}.</p>",
        part_html(state),
        f"<h2>What to do next</h2><p class='do'>{html_text(steps)}</p>",
        html_table([], _escaped(findings(question, answer, measurement)), named=True),
        f"<div class='figures'>{''.join(figures)}</div>",
        "<h2>Assumptions</h2>",
        html_table(
            ["", "Value", "From"], _escaped(assumptions(question, answer, measurement, kind))
        ),
        "<h2>Not answered by this signal</h2>",
        f"<p>{html_text(' '.join(limits(question, answer)))}</p>",
    ]
    style = asset_text("part.css") + asset_text("measured_report.css")
    return {
        "name": FILE.format(
            re.sub(r"[^\w.-]+", "-", Path(question.measured.recording.name).stem)[:60]
        ),
        "html": document(about, title, body, style),
        "items": items,
        "figures": drawn,
        "width": WIDTH,
    }


def findings(
    question: Question,
    answer: Diagnosis,
    measurement: Measurement,
) -> list[tuple[str, str]]:
    """Severity, the bearing's frequencies and the trend: name and words."""
    measured, speed, trend = question.measured, answer.shaft_speed, measurement.trend_now
    why = no_velocity(measured)
    level = "not known: " + why
    if not why:
        low, high = measured.indicators.band
        velocity = 1e3 * float(measured.indicators.velocity_rms.max())
        displacement = 1e6 * float(measured.indicators.displacement_rms.max())
        level = (
            f"velocity {number(velocity, 3)} mm/s and displacement {number(displacement, 3)} µm "
            f"RMS, {low:.0f} to {high:.0f} Hz"
        )
        if math.isfinite(share := measured.shaft_share):
            level += f", {percent(share, 2)} of the velocity's power at 1 to 3 turns of the shaft"
    frequencies = "the shaft speed is not known"
    if speed is not None:
        each = (f"{name.upper()} {number(getattr(question.bearing, name)(speed), 4)} Hz"
                for name in FREQUENCIES)  # fmt: skip
        frequencies = f"{', '.join(each)}, at {part_words.turns(answer)}, without slip"
    files = len(measurement.series.tables)
    grown = "one record shows none"
    whole = measurement.whole_trend
    if whole is not None and len(whole.points) > 1:
        grown = trend_words(whole, measured.in_si, measured.along(whole.direction))
    elif files > 1 and measurement.series.together:
        done = 0 if trend is None else len(trend.trend.points)
        grown = f"not finished: {done} of {files} files are done; make the report again later"
    return [
        ("Severity", f"{level}. {severity(measured, measurement.machine_kind)}"),
        ("Frequencies", frequencies),
        ("Trend", grown),
    ]


def _escaped(rows: Iterable[Iterable[str]]) -> Iterable[list[str]]:
    return ([html_text(cell) for cell in row] for row in rows)


def assumptions(
    question: Question, answer: Diagnosis, measurement: Measurement, kind: str = ""
) -> list[tuple[str, str, str]]:
    """Assumptions of the answer: name, value and source (given, from the file, ...)."""
    measured, bearing = question.measured, question.bearing
    machine, recording = measured.machine, measured.recording
    values = measurement.state.values
    facts = dict(part_words.facts(answer, question))
    for name, source in (
        ("Shaft", machine.source_of("speed")), ("Bearing", machine.source_of("bearing")),
        ("Slip", "assumed"), ("Demodulation band", "chosen"),
    ):  # fmt: skip
        if source and name in facts:  # the source has a column of its own
            facts[name] = facts[name].replace(f", {source}", "", 1)
    load = measured.true_load or measurement.state.load
    typed = [f"{name.upper()} {values[name]}" for name in FREQUENCIES if values.get(name)]
    clearance = with_prefix(bearing.radial_clearance, "m")
    unknown, simulated = machine.exact_speed is None, BEARING_SOURCES[SIMULATED].capitalize()
    no_kind = "zone D for every kind of machine" if zone_of(measured, "") else "no zone"
    return [
        ("File", name_of(measured), "" if measured.origin else "Simulated"),
        ("Signal", with_prefix(recording.duration, "s")
         + measured.along(" and ".join(measured.directions)), origin_of(measurement, "columns")),
        ("Sampling rate", with_prefix(recording.sample_rate, "Hz", 4),
         origin_of(measurement, "sample_rate")),
        ("Unit", values.get("unit", "m/s²") or "not known", origin_of(measurement, "unit")),
        ("Shaft", facts["Shaft"],
         "Found" if unknown else machine.source_of("speed").capitalize()),
        ("Slip", facts["Slip"], "Assumed"),
        ("Bearing", facts["Bearing"], machine.source_of("bearing").capitalize()),
        ("Its frequencies", ", ".join(typed) or "from its dimensions",
         machine.source_of("bearing").capitalize() if typed
         else "Estimated" if machine.bearing and machine.bearing.estimated else "Computed"),
        ("Machine and support", kind or f"not said: {no_kind}", "Given" if kind else ""),
        ("Load", "typical loads, used for the extent" if load is None
         else with_prefix(load, "N"),
         "Assumed" if load is None else simulated if measured.true_load else "From the file"),
        ("Radial clearance", f"{clearance}, used for the extent",
         simulated if measured.true_edge else "Assumed: usual for the bearing"),
        ("Demodulation band", facts.get("Demodulation band", "none"), "Chosen"),
    ]  # fmt: skip


def origin_of(measurement: Measurement, name: str) -> str:
    """Origin of a field in words: given, from the file or assumed, with its reason."""
    words = measurement.source_of(name)
    for before, after in _ORIGINS.items():
        if words.startswith(before):
            return f"{after} {words.removeprefix(before).strip()}".strip()
    if words.startswith("Given") or not words:
        return words
    return f"From the file, {words[0].lower()}{words[1:]}"


def limits(question: Question, answer: Diagnosis) -> list[str]:
    """Open questions, in sentences."""
    return [
        NOT_JUDGED,
        *([NOT_FORESEEN] if answer.names_a_part else []),
        *([] if question.measured.in_si else [NO_SIZE]),
        *(words.strip() for words in [part_words.estimate_warning(question)] if words),
    ]
