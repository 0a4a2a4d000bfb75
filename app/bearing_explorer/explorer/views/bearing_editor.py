"""All dimensions of the bearing, a picture that explains them, and numbers that follow."""

from __future__ import annotations

import html
import math
from collections.abc import Callable
from functools import partial
from typing import Any, ClassVar, NamedTuple

import numpy as np
import param

from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.choice_list import KIND, MATERIAL, NUMBERS
from bearing_explorer.explorer.state.field_values import BEARING_GROUPS, values_of
from bearing_explorer.explorer.views.bearing_picture import bearing_picture
from bearing_explorer.explorer.views.control_view import ControlView, table_of_fields
from bearing_explorer.explorer.widgets.controls import Rows, spec_of
from bearing_explorer.kit.assets import asset_text, scripts
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.element_words import elements
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearingcore import Bearing, Scene
from bearingcore.common import with_deviation
from bearingcore.fields import FIELD_OF


class BearingRows(Rows):
    """The fields and the picture in the browser, with the numbers that follow."""

    #: the cross-section as SVG
    picture = param.String()
    #: [{label, symbol, value, about}]
    facts = param.List(default=[])

    _esm = scripts("element.js", "asking.js", "rows.js", "bearing_editor.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("controls.css"),
        asset_text("bearing_editor.css"),
        asset_text("picture.css"),
    ]


def _balls_of(bearing: Bearing) -> str:
    """Balls of a row in words."""
    ball, pitch = (1e3 * d for d in (bearing.ball_diameter, bearing.pitch_diameter))
    names = elements(bearing, bearing.n_balls)
    return (
        f"{bearing.n_balls} {names} of {style.number(ball, 5)} mm on a circle of "
        f"{style.number(pitch, 5)} mm"
    )


class BearingEditor(ControlView):
    """The form for the dimensions of the bearing."""

    name = "bearing-editor"
    title = "Dimensions of the bearing"
    about = (
        "Point at a field, or click in the picture. Its meaning is below the picture. Numbers take "
        "units: 5/16 in, 12 µm. All views follow what is changed here."
    )
    picture = True

    def build(self, packed: PackedSource) -> Any:
        spec = spec_of(BEARING_GROUPS, KIND, NUMBERS, MATERIAL)
        self.rows = BearingRows(self.forward, spec=spec)
        return self.rows

    def sentence(self, results: Results) -> str:
        bearing = results.scene.bearing
        unlike = [row for row, _ in bearing.unlike_rows]
        angles = dict.fromkeys(row.contact_angle for row in unlike)
        angle = "° and ".join(style.number(math.degrees(angle), 4) for angle in angles)
        rows = "two rows of " if bearing.rows else ""
        kinds = dict.fromkeys(_balls_of(row) for row in unlike)
        words = f"{rows}{' and of '.join(kinds)}, "
        if bearing.roller_length is not None:
            words += f"{style.number(1e3 * bearing.roller_length, 4)} mm long"
            words += f", {angle}° contact angle." if bearing.contact_angle else "."
        else:
            words += f"{'no contact angle' if angle == '0' else f'{angle}° contact angle'}"
            kind = bearing.kind.variant(bearing).replace("-", " ")
            words += f", {kind}." if bearing.rows else "."
        if bearing.estimated:
            words += " Estimated from the designation."
        return words[0].upper() + words[1:]

    def show(self, results: Results) -> None:
        scene = results.scene
        self.rows.put(picture=bearing_picture(scene.bearing), facts=facts_of(scene))

    def table(self, results: Results) -> dict[str, np.ndarray]:
        table = table_of_fields(BEARING_GROUPS, values_of(results.scene))
        facts = [[fact["label"], fact["value"], ""] for fact in facts_of(results.scene)]
        further = np.array(facts).T
        return {
            name: np.append(column, more)
            for (name, column), more in zip(table.items(), further, strict=True)
        }


def facts_of(scene: Scene) -> list[dict[str, str]]:
    """Numbers that follow from the dimensions and the shaft speed, with their words."""
    bearing, speed = scene.bearing, scene.shaft_speed
    element, elements = bearing.kind.element, bearing.kind.elements
    facts = [
        {
            "label": label.format(element, elements.capitalize()),
            "symbol": name.upper(),
            "value": _words_of_rows(bearing, words),
            "about": about.format(element),
        }
        for name, label, about in _FREQUENCIES
        for words in [partial(_hertz, name=name, speed=speed)]
    ]
    for name in bearing.kind.facts(bearing):
        fact = FACTS[name]
        value = (fact.of_all or partial(_words_of_rows, words=fact.of_row))(bearing)
        facts.append(
            {"label": fact.label, "symbol": fact.symbol, "value": value, "about": fact.about}
        )
    return facts


_FREQUENCIES = (
    ("bpfo", "{1} pass the outer race", "Rate at which a point of the outer race is passed."),
    ("bpfi", "{1} pass the inner race", "Rate at which a point of the inner race meets a {0}."),
    ("ftf", "The cage turns", "Turns of the cage a second."),
    ("bsf", "A {0} spins", "Turns of a {0} about its own axis a second."),
)


def _hertz(bearing: Bearing, name: str, speed: float) -> str:
    value = float(getattr(bearing, name)(speed))
    if spread := bearing.frequency_spread(name):
        return f"{with_deviation(value, spread * value, 'Hz')}, estimated"
    counted = name.startswith("bp") and "n_balls" in bearing.estimated
    return f"{style.number(value, 4)} Hz{', number of rollers estimated' if counted else ''}"


def _words_of_rows(bearing: Bearing, words: Callable[[Bearing], str]) -> str:
    """The `words` of a bearing; for unlike rows those of each row."""
    return " and ".join(dict.fromkeys(words(row) for row, _ in bearing.unlike_rows))


def _length(name: str, digits: int = 3) -> Callable[[Bearing], str]:
    return lambda bearing: style.with_prefix(getattr(bearing, name), "m", digits)


def _factor(bearing: Bearing) -> str:
    K = style.number(bearing.load_deflection_factor / 1e6, 5)
    return f"{K} MN/m{bearing.kind.exponent_text}"


def _raceways(bearing: Bearing) -> str:
    radii = (bearing.outer_raceway_radius, bearing.inner_raceway_radius)
    return ", ".join(f"{style.number(1e3 * radius, 5)} mm" for radius in radii)


def _conformity(bearing: Bearing, race: str) -> str:
    return style.number(getattr(bearing, f"{race}_groove_radius") / bearing.ball_diameter, 4)


def _free_angle(bearing: Bearing) -> str:
    try:
        return f"{style.number(math.degrees(bearing.free_contact_angle), 4)}°"
    except ValueError:
        return "none: the ring slips through"


class Fact(NamedTuple):
    """A number that follows from the dimensions: its words, and the function of its value.

    `of_row` writes the value of each row if rows are unlike, `of_all` that of the whole bearing.
    """

    label: str
    symbol: str
    about: str
    of_row: Callable[[Bearing], str] = str
    of_all: Callable[[Bearing], str] | None = None


def _field_fact(name: str, *words: Callable[[Bearing], str], **more: Any) -> Fact:
    """A number that describes other bearings, and follows from the dimensions of this one."""
    field = FIELD_OF[name]
    return Fact(field.label, field.symbol_html, html.escape(field.meaning), *words, **more)


_GROOVE_OVER_BALL = "Groove radius in ball diameters; makers use 0.505 to 0.54."

FACTS = {
    "pressure_centers_apart": Fact(
        "Pressure centres apart",
        "a<sub>p</sub>",
        "Where the lines of contact of both rows meet the shaft: the farther apart, the stiffer "
        "against tilt.",
        of_all=_length("pressure_centers_apart", 4),
    ),
    "preload_force": _field_fact(
        "preload_force",
        of_all=lambda bearing: style.with_prefix(bearing.preload_force or 0.0, "N", 3),
    ),
    "sphere_rows_apart": Fact(
        "Rows apart",
        "a",
        "Along the shaft; it follows from the sphere, the inner groove and the angle.",
        of_all=_length("row_distance", 4),
    ),
    "free_contact_angle": Fact(
        "Free contact angle",
        "α<sub>f</sub>",
        "Pushed along the shaft until the balls touch, the bearing has this contact angle.",
        _free_angle,
    ),
    "diametral_play": Fact(
        "Diametral play",
        "s",
        "From contact to contact across the shaft: it follows from contact angle and clearance.",
        _length("diametral_play"),
    ),
    "load_deflection_factor": _field_fact("load_deflection_factor", _factor),
    "line_load_deflection_factor": Fact(
        "Load-deflection factor",
        "K",
        "Stiffness of both line contacts of a roller in series, by ISO 16281.",
        _factor,
    ),
    "groove_center_distance": _field_fact(
        "groove_center_distance", _length("groove_center_distance", 4)
    ),
    "groove_center_radius": _field_fact("groove_center_radius", _length("groove_center_radius", 5)),
    "raceway_radii": Fact(
        "Raceway radii",
        "R<sub>o</sub>, R<sub>i</sub>",
        "At the bottom of the grooves, where defects are cut.",
        _raceways,
    ),
    **{
        f"{race}_conformity": Fact(
            f"{race.capitalize()} groove over ball",
            f"f<sub>{race[0]}</sub>",
            _GROOVE_OVER_BALL,
            partial(_conformity, race=race),
        )
        for race in ("outer", "inner")
    },
}
"""All numbers that the page may show for a kind of bearing, see `Kind.facts`."""
