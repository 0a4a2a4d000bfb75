"""Life of the bearing, pressure on its races and the oil film, with a form for their inputs."""

from __future__ import annotations

import dataclasses
import html
import math
import re
from typing import Any, NamedTuple

import numpy as np
import panel as pn

from bearing_explorer.explorer.results import endurance
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.sentences import number_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources, View
from bearing_explorer.kit.widgets.facts import Fact, FactGroup, LiveFacts, facts_pane, groups_html
from bearing_explorer.kit.widgets.form import Fields, entry, row
from bearingcore import Life
from bearingcore.common import percent
from bearingcore.model.statics import LEFT_OUT, hours_in_words, turns_in_words


class Field(NamedTuple):
    """A number of the form: the field of `LifeInputs`, its label, unit and range.

    `hint` names the number that an empty field stands for; without a hint a number is required.
    """

    name: str
    label: str
    unit: str
    unit_si: float
    least: float
    most: float
    about: str
    hint: str = ""


FIELDS = (
    Field(
        "dynamic_load_rating",
        "Dynamic load rating of the catalogue",
        "kN",
        1e3,
        1e-3,
        1e5,
        "Rating of the whole bearing with all its rows. If empty, it is that of the catalogue for "
        "a bearing chosen by its number, else computed by ISO 281.",
        "automatic",
    ),
    Field(
        "viscosity",
        "Viscosity of the oil",
        "mPa·s",
        1e-3,
        0.1,
        1e4,
        "Viscosity of the oil, or of a grease's base oil, at the temperature of the contact. If "
        f"empty, {endurance.ASSUMED_VISCOSITY * 1e3:g} mPa·s is assumed, and no limit is judged by "
        "it.",
        "not given",
    ),
    Field(
        "race_roughness",
        "Roughness of the races",
        "µm",
        1e-6,
        1e-3,
        100.0,
        "Root mean square; 0.1 µm is usual for honed races.",
    ),
    Field(
        "ball_roughness",
        "Roughness of the balls or rollers",
        "µm",
        1e-6,
        0.0,
        100.0,
        "Root mean square; 0.05 µm is usual.",
    ),
)


class LifeOfBearing(View):
    """Fatigue life, contact pressure and oil film of a scene."""

    name = "life"
    title = "Life, pressure and oil film"
    about = (
        "Fatigue life, pressure on each race, and the oil film. Life by ISO 16281 from the loads "
        "of all balls; the greatest pressure by Hertz; the film where a ball or roller carries "
        "most, by Hamrock and Dowson."
    )

    def build(self, packed: PackedSource) -> Any:
        self.inputs = endurance.LifeInputs()
        self._fields = Fields(self.take)
        self._refusal = facts_pane(visible=False)
        parts: list[Any] = []
        for field in FIELDS:
            label = f"{field.label} ({field.unit})"
            box = entry(label, placeholder=field.hint, align="start")
            parts += [self._fields.add(field.name, box), facts_pane(f"<p>{field.about}</p>")]
        self._fields.put(self._values())
        self._answers = LiveFacts(styles={"flex": "2 1 340px"})
        form = pn.Column(*parts, self._refusal, margin=0, styles={"flex": "1 1 240px"})
        # on a phone the answers are above the form
        ways = {"flex-wrap": "wrap-reverse", "align-items": "flex-end", "gap": "10px 34px"}
        return row(form, self._answers, styles=ways)

    def take(self, name: str) -> None:
        """Read a typed number; a refused one changes nothing, and a sentence says why."""
        field = next(field for field in FIELDS if field.name == name)
        try:
            value: Any = read(field, self._fields.values[name])
        except ValueError as error:
            words = f'<p class="refused" role="alert">{html.escape(str(error))}</p>'
            self._refusal.param.update(object=words, visible=True)
            return
        self._refusal.visible = False
        self.inputs = dataclasses.replace(self.inputs, **{name: value})
        if self.parts is not None:
            self.parts.set_life_inputs(self.inputs)

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        _ = results.endurance  # computed here, in a thread
        return {}, {}

    def sentence(self, results: Results) -> str:
        answer = results.endurance
        if len(groups_of(results)) == 1:
            return "Enter the groove radii (Machine tab, Bearing) for life, pressure and film."
        if answer.healthy is None:
            return answer.no_life
        healthy = "Without the defect: " if results.scene.defects else ""
        return f"{healthy}{answer.healthy.sentence}"

    def show(self, results: Results) -> None:
        self._answers.put(text=groups_html(groups_of(results)))
        if not self._refusal.visible:
            self._fields.put(self._values())

    def _values(self) -> dict[str, str]:
        texts = {}
        for field in FIELDS:
            value = getattr(self.inputs, field.name)
            texts[field.name] = "" if value is None else f"{value / field.unit_si:.6g}"
        return texts

    def table(self, results: Results) -> dict[str, np.ndarray]:
        groups = groups_of(results)
        rows = [
            (group.title, _text(fact.name), fact.value)
            for group in groups
            for fact in (*group.facts, Fact("in words", group.words))
        ]
        about, quantity, value = np.array(rows, dtype=str).reshape(-1, 3).T
        return {"about": about, "quantity": quantity, "value": value}


def _text(name: str) -> str:
    """A name without its HTML tags, for tables and CSV files."""
    return re.sub(r"<[^>]*>", "", name)


def read(field: Field, typed: object) -> float | None:
    """Read a typed number [SI]; ValueError with a sentence for the page."""
    text = str(typed)[:40].strip()
    if not text and field.hint:
        return None
    words = f"The {field.label.lower()}"
    return number_of(text, words, field.unit, field.least, field.most) * field.unit_si


def groups_of(results: Results) -> list[FactGroup]:
    """The answers in groups; a reason that all of them share is given once."""
    answer = results.endurance
    groups = [_life(results, answer), _pressures(results, answer), _film(results, answer)]
    words = groups[0].words
    if all(not group.facts and group.words == words for group in groups):
        return [FactGroup("Life, greatest contact pressure and oil film", words, [])]
    return groups


PROFILE = "Rollers are taken to have the profile of ISO 16281, and not to tilt."


def _life(results: Results, answer: endurance.Endurance) -> FactGroup:
    """Facts on the life of the healthy bearing, and words on the effect of the defect."""
    title = "Life of the healthy bearing" if results.scene.defects else "Life"
    if answer.life is None or answer.healthy is None or answer.rating is None:
        return FactGroup(title, answer.no_life, [])
    healthy, known = answer.healthy, answer.healthy.known
    facts = [
        Fact(
            "Dynamic load rating C<sub>r</sub>",
            f"{style.with_prefix(answer.rating, 'N', 4)}, {answer.rating_words}",
            "The load under which nine of ten bearings reach a million turns.",
        ),
        Fact(
            "Life L<sub>10r</sub>",
            turns_in_words(healthy.million_revolutions) if known else "not known",
            "Turns that nine of ten bearings reach, from the load of each ball or roller by "
            "ISO 16281.",
        ),
        Fact(
            "at the speed of the scene",
            _hours(healthy),
            "This life in hours.",
        ),
        Fact(
            "Dynamic equivalent reference load P",
            style.with_prefix(healthy.equivalent_load, "N", 4) if known else "not known",
            "The load under which ISO 281 gives this life: (C/P)³ million turns for balls, "
            "(C/P)^(10/3) for rollers.",
        ),
    ]
    if len(healthy.rows) > 1 and known:
        each = " and ".join(map(turns_in_words, healthy.rows))
        facts.append(
            Fact(
                f"of rows 1 to {len(healthy.rows)} on their own",
                each,
                "Life of each row under its own load: the bearing fails with the first row.",
            )
        )
    words = _damaged_words(answer.life) if results.scene.defects else ""
    profile = PROFILE if results.scene.bearing.kind.line_contact else ""
    if not known and not words:
        words = healthy.sentence
    iso_281 = _iso_281_words(healthy, answer.rating) if known else ""
    words = " ".join(filter(None, (words, iso_281, profile, answer.assumed)))
    return FactGroup(title, words, facts)


def _iso_281_words(healthy: Life, rating: float) -> str:
    """The life by ISO 281 for a radial load alone, and why it differs; empty with other loads."""
    load, bearing = healthy.scene.load, healthy.scene.bearing
    radial = math.hypot(load.fx, load.fy)
    if load.fz or load.mx or load.my or not radial:
        return ""
    turns = (rating / radial) ** (10.0 / 3.0 if bearing.kind.line_contact else 3.0)
    uneven = ", unevenly along the rollers" if bearing.kind.line_contact else ""
    return (
        f"ISO 281 with P = Fr, the radial load, would give {turns_in_words(turns)}: it assumes "
        f"that half of a row is loaded{uneven}; here life and P follow from the computed "
        "loads, with clearance (ISO 16281)."
    )


def _hours(healthy: Life) -> str:
    if math.isfinite(healthy.hours):
        return hours_in_words(healthy.hours)
    if healthy.scene.shaft_speed == 0.0:
        return "no hours: the shaft is at rest"
    return "no hours: unlimited" if healthy.known else "not known"


def _damaged_words(damaged: Life) -> str:
    """The life from the loads with a defect, and why it is not the life of a damaged bearing."""
    if not damaged.known:
        return damaged.sentence
    share = damaged.share_of_healthy
    why = ", as the defect takes load off the balls that carry most" if share > 1.0 else ""
    return (
        f"With the loads changed by the defect, the same formula gives {percent(share)} of "
        f"that{why}. {LEFT_OUT}"
    )


def _pressures(results: Results, answer: endurance.Endurance) -> FactGroup:
    """Facts on the contacts of the heaviest loaded ball or roller."""
    title = "Greatest contact pressure"
    if answer.pressures is None:
        return FactGroup(title, answer.no_pressures, [])
    bearing = results.scene.bearing
    if math.isnan(answer.pressures.ball.load):
        return FactGroup(title, f"Not known: {answer.pressures.reason}.", [])
    facts = []
    for contact in (answer.pressures.inner, answer.pressures.outer):
        across = "half the length" if bearing.kind.line_contact else "across"
        facts += [
            Fact(
                f"{contact.race.capitalize()} race",
                style.with_prefix(contact.greatest_pressure, "Pa"),
                "In the middle of the contact of the heaviest loaded ball or roller.",
            ),
            Fact(
                "half-axes of the contact ellipse",
                f"{style.with_prefix(contact.semi_axis_across, 'm')} {across}, "
                f"{style.with_prefix(contact.semi_axis_along, 'm')} along the rolling",
                "For a roller: half its length, and half the width of the contact.",
            ),
        ]
    allowed = style.with_prefix(bearing.kind.static_pressure, "Pa")
    words = (
        f"At {style.with_prefix(answer.pressures.ball.load, 'N', 4)}, the heaviest load at rest. "
        f"ISO 76 allows {allowed}. On the edge of a defect the pressure is higher: "
        "Hertz theory does not hold at an edge."
    )
    return FactGroup(title + _assuming(answer), words, facts)


def _assuming(answer: endurance.Endurance) -> str:
    """Words for a title if groove radii are assumed."""
    return ", with usual groove radii" if endurance.ASSUMED_GROOVES in answer.assumed else ""


def _film(results: Results, answer: endurance.Endurance) -> FactGroup:
    """Facts on the oil film; not known where the pressure is beyond Hertz theory."""
    title = "Oil film"
    if answer.film is None:
        return FactGroup(title, answer.no_film, [])
    pressed = answer.pressures and (answer.pressures.inner, answer.pressures.outer)
    allowed = results.scene.bearing.kind.static_pressure
    if pressed and any(contact.greatest_pressure > allowed for contact in pressed):
        return FactGroup(title, "Not known: the pressure is more than ISO 76 allows.", [])
    facts = []
    for film in (answer.film.inner, answer.film.outer):
        parameter = style.number(film.film_parameter) if film.lubrication else "not known"
        facts += [
            Fact(
                f"{film.race.capitalize()} race, thickness",
                style.with_prefix(film.thickness, "m") if film.lubrication else "not known",
                "Thickness where it is least.",
            ),
            Fact(
                "film parameter Λ",
                f"{parameter} ({film.lubrication or 'no film'})",
                "Thickness over the roughness of both surfaces: below 1 they touch all the time, "
                "above 3 hardly ever.",
            ),
        ]
    words = answer.film.sentence
    if results.life_inputs.viscosity is None:
        viscosity = style.with_prefix(endurance.ASSUMED_VISCOSITY, "Pa·s")
        words = words[0].lower() + words[1:]
        words = f"With an assumed viscosity of {viscosity}, because none is given: {words}"
    return FactGroup(title + _assuming(answer), words, facts)
