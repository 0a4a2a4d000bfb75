"""Every dimension of the bearing, a picture of what each one is, and what follows from them."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.plots import style
from bearing_explorer.plots.element_words import elements
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.choice_list import KIND, NUMBERS, kind_of
from bearing_explorer.state.quantities import in_unit, of_rows
from bearing_explorer.state.quantity_list import BEARING_GROUPS, QUANTITY_LIST
from bearing_explorer.views.base import Ranges, Sources
from bearing_explorer.views.control_view import ControlView
from bearing_explorer.widgets.controls import Rows, spec_of

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results
    from bearingcore import Bearing, Scene


class BearingRows(Rows):
    """The fields and the picture in the browser."""

    #: {"shape": {field: number in SI}, "facts": [{label, symbol, value, about}]}
    shown = param.Dict(default={})

    _esm = scripts("element.js", "asking.js", "rows.js", "bearing_picture.js", "bearing_editor.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("controls.css"),
        asset_text("bearing_editor.css"),
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
    """The bearing that the sliders load, dimension by dimension."""

    name = "bearing-editor"
    title = "Dimensions of the bearing"
    about = (
        "Point at a field, or click in the picture. What it is stands below the picture. All "
        "views follow what is changed here."
    )
    needs = frozenset[str]()
    picture = True

    def build(self, packed: PackedSource) -> Any:
        self.rows = BearingRows(self.forward, spec=spec_of(BEARING_GROUPS, KIND, NUMBERS))
        return self.rows

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        return {}, {}

    def sentence(self, results: Results) -> str:
        bearing = results.scene.bearing
        own = [one for one, _ in bearing.unlike_rows]
        angles = dict.fromkeys(one.contact_angle for one in own)
        angle = "° and ".join(style.number(math.degrees(one), 4) for one in angles)
        rows = "two rows of " if bearing.rows else ""
        kinds = dict.fromkeys(_balls_of(one) for one in own)
        words = f"{rows}{' and of '.join(kinds)}, "
        if bearing.roller_length is not None:
            words += f"{style.number(1e3 * bearing.roller_length, 4)} mm long."
        else:
            words += f"{'no contact angle' if angle == '0' else f'{angle}° contact angle'}"
            kind = kind_of(bearing)
            words += "." if kind == "single" else f", {kind.replace('-', ' ')}."
        return words[0].upper() + words[1:]

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is not None:
            self.rows.put(
                shown={
                    "shape": shape_of(results.scene.bearing),
                    "facts": facts_of(results.scene),
                }
            )

    def table(self, results: Results) -> dict[str, np.ndarray]:
        bearing = results.scene.bearing
        rows = [q for q in QUANTITY_LIST if q.group in BEARING_GROUPS]
        values = [in_unit(q, of_rows(bearing, q.last_name)) for q in rows]
        facts = facts_of(results.scene)
        return {
            "quantity": np.array([q.label for q in rows] + [fact["label"] for fact in facts]),
            "value": np.array(
                ["" if math.isnan(v) else f"{v:.9g}" for v in values]
                + [fact["value"] for fact in facts]
            ),
            "unit": np.array([q.unit for q in rows] + [""] * len(facts)),
        }


_OF_EACH_ROW = (
    *("n_balls", "ball_diameter", "pitch_diameter", "contact_angle"),
    *("outer_raceway_radius", "inner_raceway_radius"),
)
"""What the picture needs of each row."""


def shape_of(bearing: Bearing) -> dict[str, Any]:
    """What the picture is drawn from: the fields of the bearing, in SI, and which kind it is."""
    shape = {
        q.last_name: of_rows(bearing, q.last_name)
        for q in QUANTITY_LIST
        if q.group in BEARING_GROUPS
    }
    if bearing.is_self_aligning:
        shape["inner_groove_radius"] = bearing.sphere_groove
    return shape | {
        "kind": kind_of(bearing),
        "rows": [
            {
                "place": row.place,
                "facing": row.facing,
                **{name: getattr(bearing.of_row(k), name) for name in _OF_EACH_ROW},
            }
            for k, row in enumerate(bearing.all_rows)
        ],
    }


def facts_of(scene: Scene) -> list[dict[str, str]]:
    """Numbers that follow from the dimensions and the speed of the shaft, with their words."""
    bearing, speed = scene.bearing, scene.shaft_speed

    def hertz(name: str) -> str:
        return _of_each_row(
            bearing, lambda own: f"{style.number(float(getattr(own, name)(speed)), 4)} Hz"
        )

    facts = [
        (
            "Balls pass the outer race",
            "BPFO",
            hertz("bpfo"),
            "How often a point of the outer race is passed.",
        ),
        (
            "Balls pass the inner race",
            "BPFI",
            hertz("bpfi"),
            "How often a point of the inner race meets a ball.",
        ),
        ("The cage turns", "FTF", hertz("ftf"), "Turns of the cage a second."),
        (
            "A ball spins",
            "BSF",
            hertz("bsf"),
            "Turns of a ball about itself a second.",
        ),
    ]
    if bearing.roller_length is not None:
        facts.append(
            (
                "Load-deflection factor",
                "K",
                f"{style.number(bearing.load_deflection_factor / 1e6, 5)} MN/m¹⁰⁄⁹",
                "Stiffness of both line contacts of a roller in series, by Palmgren's formula.",
            )
        )
    else:
        facts += _of_balls(bearing)
    if bearing.is_drawn:
        facts += [
            (
                "Groove centre radius",
                "r<sub>d</sub>",
                _of_each_row(
                    bearing, lambda own: style.with_prefix(own.groove_center_radius, "m", 5)
                ),
                "The lever with which a tilt moves a contact.",
            ),
            (
                "Raceway radii",
                "R<sub>o</sub>, R<sub>i</sub>",
                _of_each_row(bearing, _raceways),
                "At the bottom of the grooves, where defects are cut.",
            ),
        ]
        facts += [
            (
                f"{race.capitalize()} groove over ball",
                "f<sub>" + race[0] + "</sub>",
                _of_each_row(bearing, partial(_conformity, race=race)),
                "Groove radius in ball diameters; makers use 0.505 to 0.54.",
            )
            for race in ("outer", "inner")
        ]
    keys = ("label", "symbol", "value", "about")
    return [dict(zip(keys, fact, strict=True)) for fact in facts]


def _of_each_row(bearing: Bearing, words: Callable[[Bearing], str]) -> str:
    """What `words` says of a bearing; of rows that are not alike, of one after the other."""
    return " and ".join(dict.fromkeys(words(own) for own, _ in bearing.unlike_rows))


def _raceways(bearing: Bearing) -> str:
    radii = (bearing.outer_raceway_radius, bearing.inner_raceway_radius)
    return ", ".join(f"{style.number(1e3 * radius, 5)} mm" for radius in radii)


def _conformity(bearing: Bearing, race: str) -> str:
    return style.number(getattr(bearing, f"{race}_groove_radius") / bearing.ball_diameter, 4)


def _of_balls(bearing: Bearing) -> list[tuple[str, str, str, str]]:
    return [
        *_of_rows(bearing),
        *([] if bearing.is_self_aligning else _of_play(bearing)),
        (
            "Load-deflection factor",
            "K",
            _of_each_row(
                bearing, lambda own: f"{style.number(own.load_deflection_factor / 1e6, 5)} MN/m¹·⁵"
            ),
            "Stiffness of both contacts of a ball in series.",
        ),
        (
            "Groove centre distance",
            "A<sub>0</sub>",
            _of_each_row(
                bearing, lambda own: style.with_prefix(own.groove_center_distance, "m", 4)
            ),
            "Both groove radii together less a ball diameter.",
        ),
    ]


def _of_play(bearing: Bearing) -> list[tuple[str, str, str, str]]:
    return [
        (
            "Free contact angle",
            "α<sub>f</sub>",
            _of_each_row(bearing, _free_angle),
            "Pushed along the shaft until the balls touch, the bearing has this contact angle.",
        ),
        (
            "Diametral play",
            "s",
            _of_each_row(bearing, lambda own: style.with_prefix(own.diametral_play, "m")),
            "From contact to contact across the shaft: what contact angle and clearance stand for.",
        ),
    ]


def _of_rows(bearing: Bearing) -> list[tuple[str, str, str, str]]:
    """Where the lines of contact of a pair meet the shaft: that decides what tilts it."""
    distance = bearing.row_distance
    if bearing.is_self_aligning and distance is not None:
        about = "Along the shaft; it follows from the sphere, the inner groove and the angle."
        return [("Rows apart", "a", style.with_prefix(distance, "m", 4), about)]
    if distance is None or bearing.arrangement == "tandem" or not bearing.arrangement:
        return []
    own = [bearing.of_row(row) for row in range(2)]
    reach = sum(0.5 * one.pitch_diameter * math.tan(one.contact_angle) for one in own)
    back = bearing.arrangement == "back-to-back"
    apart = distance + reach if back else abs(distance - reach)
    return [
        (
            "Pressure centres apart",
            "a<sub>p</sub>",
            style.with_prefix(apart, "m", 4),
            "Where the lines of contact of both rows meet the shaft: the farther apart, the "
            "stiffer against tilt.",
        )
    ]


def _free_angle(bearing: Bearing) -> str:
    try:
        return f"{style.number(math.degrees(bearing.free_contact_angle), 4)}°"
    except ValueError:
        return "none: the ring slips through"
