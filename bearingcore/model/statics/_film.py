"""Thickness of the lubricant film between the heaviest loaded ball or roller and each race.

Quantity                                        | Symbol | Name               | Unit
----------------------------------------------- | ------ | ------------------ | -----
dynamic viscosity at the contact's temperature  | η0     | viscosity          | Pa·s
increase of its logarithm with pressure         | ξ      | pressure_viscosity | 1/Pa
mean speed of ball and race through the contact | u      | rolling_speed      | m/s
radius of curvature along the rolling, ball and race together | R_x | | m
modulus of both, E/(1 − ν²) for one material    | E'     |                    | Pa
ellipse ratio a/b                               | k      | ellipse_ratio      |
load of the ball or roller                      | Q      | load               | N
length of a roller                              | l      | roller_length      | m
least film thickness                            | h_min  | thickness          | m
roughness of ball and race, root mean square    | σ      | roughness          | m
film parameter, h_min over the roughness of both | Λ     | film_parameter     |

The film of balls is

    h_min/R_x = 3.63 U^0.68 G^0.49 W^(−0.073) (1 − e^(−0.68 k)),
    U = η0 u/(E' R_x), G = ξ E', W = Q/(E' R_x²),

for hard elliptical contacts that roll without sliding, at one temperature, fully flooded with oil
(Hamrock and Dowson, 1977, Part III). The formula was fitted to ellipses of k = 1 to 8, across the
rolling. Closer grooves have longer ellipses, for which the last factor is 1. The film of rollers is

    h_min/R_x = 1.714 U^0.694 G^0.568 W'^(−0.128), W' = Q/(l E' R_x),

for lines (Pan and Hamrock, 1989), with the same U and G. Near the ends of a roller without crowning
the pressure rises, and the film is thinner. Left out are heat of shear at the inlet, which thins
the film at high speed, a shortage of oil or grease (starvation), and the edges of a defect, which
tear the film.

Source: Hamrock and Dowson, J. Lubrication Technology 99 (1977) 264-276; Hamrock and Anderson,
Rolling-Element Bearings, NASA RP-1126, for the speeds and the meaning of Λ; Pan and Hamrock,
J. Tribology 111 (1989) 246-252, for lines.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearingcore.bearings import Bearing
from bearingcore.bearings._line_contact import RollerContact
from bearingcore.common import (
    ResultTable,
    _checks as checks,
    number,
    shown_as_table,
    table_of,
    with_prefix,
)
from bearingcore.model.scene import Scene
from bearingcore.model.statics._ball_positions import static_state
from bearingcore.model.statics._equilibrium import Equilibrium
from bearingcore.model.statics._limit import Limit
from bearingcore.model.statics._positions import state_of
from bearingcore.model.statics._pressure import RACES, HeaviestBall, heaviest_balls

TOUCHING, PARTED = 1.0, 3.0
"""Film parameter below which peaks of the surfaces always touch, and above which they hardly ever
touch."""

LUBRICATION = ("boundary", "mixed", "full film")
"""Names of the lubrication below TOUCHING, between both, and above PARTED."""

MINERAL_OIL = 2.0e-8
"""Pressure-viscosity coefficient ξ [1/Pa] of a usual mineral oil: 1.5 to 2.5e-8."""


@dataclass(frozen=True)
class RaceFilm:
    """Film between the heaviest loaded ball or roller and one race. Unknown numbers are NaN.

    Attributes
    ----------
    race
        "inner" or "outer".
    load [N]
        of the contact.
    thickness [m]
        h_min; 0 if the shaft stands still.
    roughness [m]
        of both surfaces together.
    film_parameter
        Λ.
    lubrication
        one of LUBRICATION; empty if the film is unknown.
    sentence
        the same in words.
    """

    race: str
    load: float
    thickness: float
    roughness: float
    film_parameter: float
    lubrication: str
    sentence: str


@shown_as_table
@dataclass(frozen=True)
class Film:
    """Lubricant film of a scene's heaviest loaded ball or roller.

    Attributes
    ----------
    scene
        the scene of the film.
    rolling_speed [m/s]
        u, the same at both races.
    inner, outer
        the film at each race.
    """

    scene: Scene
    rolling_speed: float
    inner: RaceFilm
    outer: RaceFilm

    @property
    def thinner(self) -> RaceFilm:
        """The film at the race with the smaller film parameter."""
        return self.outer if self.outer.film_parameter < self.inner.film_parameter else self.inner

    @property
    def sentence(self) -> str:
        """The thinner film in words, with the limitations."""
        left_out = ROLLER_LEFT_OUT if self.scene.bearing.kind.line_contact else FILM_LEFT_OUT
        return f"{self.thinner.sentence} {left_out}"

    @property
    def limit(self) -> Limit:
        """The film parameter of the thinner film, and its value below which surfaces touch."""
        value = self.thinner.film_parameter
        return Limit("film parameter", value, TOUCHING, "", value < TOUCHING, self.thinner.sentence)

    def table(self) -> ResultTable:
        """A row for each race: speed, film thickness, roughness, film parameter, and a sentence."""
        return table_of(
            ("race", "", "race"),
            ("rolling_speed", "m/s", [self.rolling_speed] * 2, "mean speed of both surfaces"),
            ("ball_load", "N", "load", "of the heaviest loaded ball"),
            ("film_thickness", "m", "thickness", "where it is least"),
            ("roughness", "m", "roughness", "of both surfaces together"),
            ("film_parameter", "1", "film_parameter", "film thickness over roughness"),
            ("sentence", "", "sentence"),
            of=(self.inner, self.outer),
        )


FILM_LEFT_OUT = (
    "For smooth races with enough oil at one temperature: the edges of a defect, heat and "
    "starvation are left out, and all of them make the film thinner."
)

ROLLER_LEFT_OUT = FILM_LEFT_OUT.replace(
    "the edges of a defect", "the edges of a defect and of the roller"
)


def rolling_speed(bearing: Bearing, shaft_speed: float) -> float:
    """Return the mean speed u [m/s] of ball and race at a contact, for a shaft speed [rad/s].

    u = ω_s D_p (1 − γ²)/4 with γ = D_b cos α0/D_p holds for both races, as the ball rolls on both.
    """
    gamma = bearing.ball_diameter * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    return 0.25 * shaft_speed * bearing.pitch_diameter * (1.0 - gamma**2)


def least_thickness(
    bearing: Bearing, race: str, speed: float, load: float, oil: tuple[float, float]
) -> float:
    """Return h_min [m] of a ball or roller on a race; see the head of the module.

    `speed` is u [m/s] and `load` Q [N], above 0; `oil` is η0 [Pa·s] and ξ [1/Pa].
    """
    contact, (viscosity, pressure_viscosity) = bearing.race_contact(race), oil
    gamma = bearing.ball_diameter * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    # 1/R_x = 2/D_b ± 2 γ/(D_b (1 ∓ γ)), upper signs inside
    radius = bearing.ball_radius * (1.0 - gamma if race == "inner" else 1.0 + gamma)
    U = viscosity * speed / (contact.modulus * radius)
    G = pressure_viscosity * contact.modulus
    if isinstance(contact, RollerContact):
        W = load / contact.length / (contact.modulus * radius)
        return 1.714 * U**0.694 * G**0.568 * W**-0.128 * radius
    W = load / (contact.modulus * radius**2)
    side_flow = -math.expm1(-0.68 * contact.ellipse_ratio)
    return 3.63 * U**0.68 * G**0.49 * W**-0.073 * side_flow * radius


def film(
    scene: Scene,
    *,
    viscosity: float,
    pressure_viscosity: float = MINERAL_OIL,
    roughness_inner: float = 0.1e-6,
    roughness_outer: float = 0.1e-6,
    roughness_ball: float = 0.05e-6,
    state: Equilibrium | None = None,
) -> Film:
    """Compute film thickness and film parameter at each race for the heaviest ball or roller.

    In a bearing with unlike rows the row with the least film parameter counts.

    Parameters
    ----------
    scene
        bearing, load and speed; a ball bearing needs its groove radii.
    viscosity
        η0 [Pa·s] of the oil (a grease's base oil) at the temperature of the contact.
    pressure_viscosity
        ξ [1/Pa]; a usual mineral oil by default.
    roughness_inner, roughness_outer, roughness_ball
        σ [m], root mean square, of each surface (roughness_ball also of rollers); the defaults are
        usual for honed races. The root of the sum of squares counts, and must be above 0.
    state
        the static equilibrium of the scene, if it is known; None computes it at all positions.

    Raises
    ------
    ValueError
        naming the field, its value and what is allowed.
    """
    checks.instance("scene", scene, Scene)
    eta = checks.real_number("viscosity", viscosity, above=0.0, unit="Pa·s")
    xi = checks.real_number("pressure_viscosity", pressure_viscosity, above=0.0, unit="1/Pa")
    ball = checks.real_number("roughness_ball", roughness_ball, at_least=0.0, unit="m")
    sigma = {
        race: math.hypot(
            checks.real_number(
                f"roughness_{race}",
                value,
                at_least=0.0,
                above=-math.inf if ball > 0.0 else 0.0,
                unit="m",
            ),
            ball,
        )
        for race, value in (("inner", roughness_inner), ("outer", roughness_outer))
    }
    state = state_of(scene, state, static_state)
    films = [_film_of(scene, heaviest, (eta, xi), sigma) for heaviest in heaviest_balls(state)]
    # an unknown film is not the thinnest, unless all are unknown
    return min(films, key=lambda answer: np.nan_to_num(answer.thinner.film_parameter, nan=math.inf))


def _film_of(
    scene: Scene, ball: HeaviestBall, oil: tuple[float, float], sigma: dict[str, float]
) -> Film:
    """Return the film of one ball; `oil` is viscosity and pressure-viscosity coefficient."""
    bearing, element = scene.bearing.of_row(ball.row), scene.bearing.kind.element
    bearing.race_contact("inner")  # refuses a bearing without its drawing
    u = rolling_speed(bearing, scene.shaft_speed)
    films = []
    for race in RACES:
        load = ball.load_on(race)
        h = least_thickness(bearing, race, u, load, oil) if load > 0.0 else math.nan
        films.append(_race_film(race, load, h, sigma[race], element))
    return Film(scene, u, *films)


def _race_film(race: str, load: float, h: float, sigma: float, element: str) -> RaceFilm:
    """Return a film of thickness h [m] on surfaces of roughness σ [m], with its sentence."""
    ratio = h / sigma
    if ratio < TOUCHING:
        kind, effect = LUBRICATION[0], "their peaks carry the load and wear"
    elif ratio < PARTED:
        kind, effect = LUBRICATION[1], "their peaks touch now and then"
    else:
        kind, effect = LUBRICATION[2], f"{element} and race hardly ever touch"
    if math.isnan(h):
        why = f"no {element} is loaded"
        if math.isnan(load):
            why = "no cage angle has a static equilibrium"
        kind, sentence = "", f"Film, {race} race: not known, as {why}."
    elif h == 0.0:
        sentence = f"The shaft is at rest and draws no oil between {element} and {race} race."
    else:
        sentence = (
            f"The film on the {race} race is {with_prefix(h, 'm')} thick where a {element} carries "
            f"most ({with_prefix(load, 'N')}), {number(ratio)} times the roughness of the surfaces "
            f"({with_prefix(sigma, 'm')}): {kind} lubrication, {effect}."
        )
    return RaceFilm(race, load, h, sigma, ratio, kind, sentence)
