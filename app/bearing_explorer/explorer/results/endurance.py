"""Life of a bearing, pressure on its races, and thickness of the oil film."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from bearing_explorer.kit.compute import compiling
from bearing_explorer.kit.compute.cache import cached
from bearing_explorer.kit.sentences import sentence_of
from bearingcore import (
    ContactPressures,
    Equilibrium,
    Film,
    Life,
    Limit,
    Scene,
    contact_pressures,
    dynamic_load_rating,
    film,
    life,
    limits as limits_of,
)
from bearingcore.bearings import STEEL_MODULUS, STEEL_POISSON, USUAL_GROOVES
from bearingcore.model.scene import WITH_MASS
from bearingcore.model.statics import GIVEN, NO_DRAWING, OF_A_CATALOGUE, state_of_limits, unknown

ASSUMED_GROOVES = (
    f"The groove radii are not known. Assumed: {USUAL_GROOVES['inner']} (inner) and "
    f"{USUAL_GROOVES['outer']} (outer) ball diameters, as usual; no limit is judged by them. "
    "Enter yours on the Machine tab, under Bearing."
)
ESTIMATED = "Estimated: the inside of the bearing follows from its designation."
ASSUMED_VISCOSITY = 0.02
"""Viscosity [Pa·s] that is assumed if none is given: a usual oil, warm."""


@dataclass(frozen=True)
class LifeInputs:
    """Steel, oil and surfaces as entered under Life.

    dynamic_load_rating
        C_r [N] of the catalogue; None: that of the bearing's number if it is known, else
        computed by ISO 281.
    viscosity [Pa·s]
        of the oil at its temperature where it is drawn in; None: not known. A film is then shown
        for `ASSUMED_VISCOSITY`, but no limit of the scene is judged by it.
    race_roughness, ball_roughness [m]
        root mean square.
    """

    dynamic_load_rating: float | None = None
    viscosity: float | None = None
    race_roughness: float = 0.1e-6
    ball_roughness: float = 0.05e-6


@dataclass(frozen=True)
class Endurance:
    """Life, pressures and film of a scene; each that is None comes with a reason.

    life, pressures, film
        the core's answers.
    healthy
        the life without the defects.
    assumed
        assumptions on a bearing whose groove radii are not known, or whose inside is estimated;
        else empty.
    rating [N], rating_words
        the dynamic load rating that was used, and its source.
    no_life, no_pressures, no_film
        reason why that answer is missing; else empty.
    """

    life: Life | None
    healthy: Life | None
    no_life: str
    rating: float | None
    rating_words: str
    pressures: ContactPressures | None
    no_pressures: str
    film: Film | None
    no_film: str
    assumed: str


Result = TypeVar("Result")

_LIFE_ASSUMES = "Life assumes usual ones, but no limit is judged by them"


@cached
def endurance(scene: Scene, inputs: LifeInputs) -> Endurance:
    """Life, contact pressures and film of a scene."""
    compiling.need(compiling.STATICS)
    with_grooves = assume_usual_grooves(scene)
    notes = [ESTIMATED] if scene.bearing.estimated else []
    of_number = scene.bearing.dynamic_load_rating
    assumed = " ".join(notes if with_grooves is None else [*notes, ASSUMED_GROOVES])
    scene = with_grooves or scene
    rating, rating_words = inputs.dynamic_load_rating, GIVEN
    no_life = ""
    if rating is None and of_number is not None:
        rating, rating_words = of_number, OF_A_CATALOGUE
    elif rating is None:
        try:
            rating = dynamic_load_rating(scene.bearing)
            rating_words = "computed from the dimensions by ISO 281"
        except ValueError:
            rating_words = ""
            no_life = (
                "The standard's rating of this kind of bearing is not computed here: enter that of "
                "the catalogue."
            )
    scene_life = healthy = None
    if rating is not None:
        scene_life, no_life = _answer(life, scene, rating)
        healthy, no_healthy_life = _answer(life, scene.healthy(), rating)
        no_life = no_life or no_healthy_life
    state = _state_of_contacts(scene)
    pressures, no_pressures = _answer(contact_pressures, scene, state)
    oil, no_film = _answer(film_of, scene, inputs, state)
    return Endurance(
        *(scene_life, healthy, no_life, rating, rating_words),
        *(pressures, no_pressures, oil, no_film, assumed),
    )


def _answer(compute: Callable[..., Result], *arguments: Any) -> tuple[Result | None, str]:
    """An answer of the core; or None, and the sentence of its refusal."""
    try:
        return compute(*arguments), ""
    except ValueError as error:
        return None, sentence_of(error)


def assume_usual_grooves(scene: Scene) -> Scene | None:
    """The scene with usual groove radii; None if its own are known or its loads would change.

    The loads stay the same for a row of balls without contact angle under a radial load, because
    the distance of the groove centres has no effect there.
    """
    bearing, load = scene.bearing, scene.load
    if bearing.knows_contacts or bearing.rows or bearing.kind.line_contact:
        return None
    if bearing.contact_angle != 0.0 or (load.fz, load.mx, load.my) != (0.0, 0.0, 0.0):
        return None
    ball = bearing.ball_diameter
    return scene.replace(
        bearing=bearing.replace(
            inner_groove_radius=USUAL_GROOVES["inner"] * ball,
            outer_groove_radius=USUAL_GROOVES["outer"] * ball,
            groove_center_distance=(sum(USUAL_GROOVES.values()) - 1.0) * ball,
            youngs_modulus=STEEL_MODULUS,
            poisson=STEEL_POISSON,
        )
    )


def _state_of_contacts(scene: Scene) -> Equilibrium | None:
    """State of the contacts; None for balls with mass: limits leave out their forces at speed."""
    return None if scene.balls == WITH_MASS else state_of_limits(scene)


def film_of(scene: Scene, inputs: LifeInputs, state: Equilibrium | None) -> Film:
    """The film of a scene with the oil of `inputs`; it raises ValueError as `film` does."""
    return film(
        scene,
        viscosity=inputs.viscosity or ASSUMED_VISCOSITY,
        roughness_inner=inputs.race_roughness,
        roughness_outer=inputs.race_roughness,
        roughness_ball=inputs.ball_roughness,
        state=state,
    )


@cached
def limits(
    scene: Scene, step_rate: float | None, dynamic_load: float | None, inputs: LifeInputs
) -> tuple[Limit, ...]:
    """Effects that the model leaves out of a scene, each with its number and its limit.

    `step_rate` [Hz] and `dynamic_load` [N], the greatest of a ball, come from a simulated motion;
    None without one.
    """
    compiling.need(compiling.STATICS)
    state = state_of_limits(scene)
    oil = None
    if inputs.viscosity is not None and scene.bearing.knows_contacts:
        oil = film_of(scene, inputs, _state_of_contacts(scene))
    answers = limits_of(scene, state, dynamic_load=dynamic_load, step_rate=step_rate, film=oil)
    if assume_usual_grooves(scene) is None:
        return answers
    return tuple(_not_judged(answer) for answer in answers)


def _not_judged(limit: Limit) -> Limit:
    """Add to a limit that is unknown for want of groove radii that the Life tab assumes them."""
    usual = unknown(limit.name, limit.limit, limit.unit, NO_DRAWING)
    if limit.sentence != usual.sentence:
        return limit
    return unknown(limit.name, limit.limit, limit.unit, f"{NO_DRAWING}; {_LIFE_ASSUMES}")
