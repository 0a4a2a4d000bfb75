"""Limits of the model in a scene, each with its number, its limit and a sentence.

Quantity                                    | Symbol | Unit
------------------------------------------- | ------ | -----
contact pressure in the middle              | p      | Pa
half width of the contact across the groove | a      | m
angle of the groove's shoulder              | θ_s    | rad
density of the balls                        | ρ      | kg/m³
centrifugal force of a ball                 | F_c    | N
compression of a ball, distance of the groove centres | δ, A0 | m

These effects are left out of the model and checked here:

- plastic flow: contact pressure compared with 4.2 GPa, the static limit of ISO 76 for ball bearings
  (a dent of 1/10,000 of the ball diameter), at rest and, after a simulation, in motion. Pressure at
  the corners of a defect is higher;
- the end of the groove: contact angle and half the contact ellipse compared with the shoulder;
- inertia of the balls: the change of loads, stiffness and contact angles by centrifugal force,
  solved with `ball_positions`, and this force compared with the contact load. The shock of a ball
  at the far edge of a defect is left out and not checked;
- gyroscopic moments of the balls, compared with their loads (`gyroscopic`);
- the size of the contact, which Hertz's theory assumes to be small compared with the ball;
- thrust: a row that carries thrust one way only, if the thrust acts the other way or is less than
  that induced by the radial load (`thrust`);
- tilts: the moment that the shaft's other bearing must carry if the scene holds them, and the tilt
  of the shaft if they are free (`tilts`);
- inconsistent stiffness: a load-deflection factor that does not agree with the drawing;
- the lubricant film: its thickness over the roughness of the surfaces, if an oil is given;
- coarse time steps: steps while a ball passes a defect;
- an estimated inside, of a bearing that is known by its designation alone.

Friction, temperature, fits, bending of rings and slip of the cage are not checked. Balls that have
sunk deep into a defect, which look loaded in the printed Eq. 8, need no warning, as the kernels
distinguish them exactly.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from bearingcore.bearings import Bearing, center_distance
from bearingcore.bearings._hertz import series_factor
from bearingcore.bearings._inside import accuracy
from bearingcore.common import (
    Array,
    _checks as checks,
    number,
    percent,
    weighted_quantile,
    with_prefix,
)
from bearingcore.model.scene import WITH_MASS, Scene
from bearingcore.model.scene._packing import contacts
from bearingcore.model.statics._ball_positions import centrifugal_effect
from bearingcore.model.statics._equilibrium import Equilibrium
from bearingcore.model.statics._film import TOUCHING, Film
from bearingcore.model.statics._gyroscopic import gyroscopic_limit
from bearingcore.model.statics._limit import (
    NO_DRAWING,
    NO_MOTION,
    NO_OIL,
    Limit,
    unknown,
    upper_limit,
)
from bearingcore.model.statics._passes import STEPS_A_PASSAGE, shortest_passage
from bearingcore.model.statics._positions import over_all_positions, positions, state_of
from bearingcore.model.statics._pressure import RACES, heaviest_balls
from bearingcore.model.statics._thrust import thrust_limits
from bearingcore.model.statics._tilts import free_tilts, held_tilts

ANGLES = 361
"""Number of cage angles per ball spacing in a check; a third of them if a defect turns with the
shaft."""

CENTRIFUGAL_SHARE = 1.0
"""Limit on centrifugal force over contact load; beyond it the least loaded ball lifts off the inner
race."""

CENTRIFUGAL_CHANGE = 0.1
"""Limit on changes by centrifugal force: of loads relative to the heaviest, and of stiffness. Both
are rarely known better than to a tenth."""

_CHANGE_ANGLES, _MOST_CHANGES = 31, 240

GREATEST_COMPRESSION = 0.2
"""Limit on compression over distance of the groove centres. The contact's half width is 1.24 r_b
√(δ/A0) within 4 % for all usual grooves, at this limit 0.55 ball radii: 34° to either side."""

STIFFNESS_MISMATCH = 0.01
"""Limit on the relative difference of the load-deflection factor and that of the drawing."""


def usual_shoulder_height(contact_angle: float) -> float:
    """Return the assumed height of a groove's shoulder over its bottom, in ball diameters.

    It is 0.2 for deep grooves and rises linearly to 0.3 at α0 = 40°, which holds for the loaded
    shoulder by the shoulder diameters in catalogues.
    """
    return min(0.2 + 0.1 * contact_angle / math.radians(40.0), 0.5)


def state_of_limits(scene: Scene) -> Equilibrium:
    """Return the static equilibrium for `limits`, at all positions of a fixed grid.

    A verdict must not depend on the resolution of a figure, nor on the first position of a defect
    that turns with the shaft: see `bearingcore.model.statics._positions`.
    """
    return over_all_positions(scene, (ANGLES - 1) // 3 + 1 if scene.defect_turns else ANGLES)


def limits(
    scene: Scene,
    state: Equilibrium | None = None,
    *,
    dynamic_load: float | None = None,
    step_rate: float | None = None,
    film: Film | None = None,
) -> tuple[Limit, ...]:
    """Check the limits of the model for `scene`, each with its number, its limit and a sentence.

    Parameters
    ----------
    scene
        the scene to check.
    state
        its static equilibrium at chosen cage angles; None takes `state_of_limits`, so that equal
        scenes have equal verdicts. Loads and angles are the greatest over the angles.
    dynamic_load
        greatest load of a ball [N] in a simulated motion, e.g. of `Motion.ball_loads`. None if no
        motion was simulated: limits that depend on it are then not known.
    step_rate
        step rate [Hz] of a simulated motion, e.g. `Motion.step_rate`; None leaves its limit out.
    film
        the film of the scene's lubricant, from `film`. None if no oil is given: contact of the
        surfaces is then not known.

    Returns
    -------
    tuple of Limit
        in the order of the list at the head of the module. Loads in motion and the film appear only
        if the shaft turns; steps only with a step rate, a defect and a turning shaft.

    Raises
    ------
    ValueError
        for an impossible step rate or load, or a `state` or `film` of another scene.
    """
    checks.instance("scene", scene, Scene)
    state = state_of(scene, state_of_limits(scene) if state is None else state)
    bearing, turns = scene.bearing, scene.shaft_speed > 0.0
    heaviest = [(bearing.of_row(ball.row), ball) for ball in heaviest_balls(state)]
    at_rest = [(row, ball.load) for row, ball in heaviest]
    in_motion = []
    if dynamic_load is not None:
        load = checks.real_number("dynamic_load", dynamic_load, at_least=0.0, unit="N")
        # the row of this load is unknown: the row on which it matters most counts
        in_motion = [(row, load) for row, _ in bearing.unlike_rows]
    candidates: list[Limit | None] = [
        _pressure(
            bearing,
            f"contact pressure, {race} race",
            [(row, ball.load_on(race)) for row, ball in heaviest],
            (race,),
            NO_STATE,
        )
        for race in RACES
    ]
    if turns:
        name = "contact pressure in motion"
        candidates.append(_pressure(bearing, name, in_motion, RACES, NO_MOTION))
    candidates.append(_shoulder(scene, state))
    candidates.append(_centrifugal_change(scene))
    candidates.append(_worst(_centrifugal_share(*row, scene, state) for row in bearing.unlike_rows))
    candidates.append(gyroscopic_limit(scene))
    if not bearing.kind.line_contact:
        candidates.append(
            _compression("compression against groove centre distance", at_rest, NO_STATE)
        )
        if turns:
            candidates.append(_compression("compression in motion", in_motion, NO_MOTION))
        candidates.append(_stiffness(scene))
    candidates += thrust_limits(scene, state)
    candidates += [held_tilts(state), free_tilts(state)]
    film_limit = _film_limit(scene, film)  # refuses the film of another scene
    if turns:
        candidates.append(film_limit)
    if step_rate is not None:
        rate = checks.real_number("step_rate", step_rate, above=0.0, unit="Hz")
        candidates.append(_steps(scene, rate))
    candidates.append(_estimate(scene))
    return tuple(limit for limit in candidates if limit is not None)


def _film_limit(scene: Scene, film: Film | None) -> Limit:
    if film is None:
        why = NO_OIL if scene.bearing.knows_contacts else NO_DRAWING
        return unknown("film parameter", TOUCHING, "", why)
    if film.scene != scene:
        raise checks.refuse("film", "the film of another scene", "that of this scene")
    return film.limit


def _estimate(scene: Scene) -> Limit | None:
    """Return a note on estimated inside dimensions; None if they are known."""
    bearing = scene.bearing
    if not bearing.estimated:
        return None
    spread = bearing.frequency_spread("bpfo")
    count = f"the number of {bearing.kind.elements} is"
    right = f" even if {count} off by one" if bearing.kind.estimate_spread else f" if {count} right"
    good = f" BPFO is good to ±{percent(spread, 2)}{right}." if spread else ""
    return unknown(
        "inside dimensions",
        0.0,
        "",
        "they are estimated from the designation, and everything shown follows from that."
        f"{good} {accuracy(bearing.kind, bearing.contact_angle)} Enter the real numbers if they "
        "are known",
    )


def _known(state: Equilibrium) -> NDArray[np.bool_]:
    """Return True for cage angles with known loads of the balls, also with a free direction."""
    return np.isfinite(state.ball_load.sum(axis=1))


NOT_IN_STATICS = "the static model leaves it out"
NOT_IN_STATICS_WITH_MASS = (
    "the loads, stiffness and life of balls with mass include it, but these limits, maps and "
    "natural frequencies leave it out"
)

NO_STATE = "no cage angle has a static equilibrium"

Loaded = Sequence[tuple[Bearing, float]]
"""Unlike rows, each with the greatest load [N] of an element; empty without a motion."""


def _are_known(loaded: Loaded) -> bool:
    return bool(loaded) and not any(math.isnan(load) for _, load in loaded)


def _pressure(
    bearing: Bearing, name: str, loaded: Loaded, races: Sequence[str], no_load: str
) -> Limit:
    """Compare the greatest pressure of the most loaded elements on some races with ISO 76.

    `no_load` is NO_MOTION for loads in motion, and NO_STATE at rest.
    """
    allowed = bearing.kind.static_pressure
    if not bearing.knows_contacts:
        return unknown(name, allowed, "Pa", NO_DRAWING)
    if not _are_known(loaded):
        return unknown(name, allowed, "Pa", no_load)
    p, load, race = max(
        (float(row.race_contact(race).greatest_pressure(load)), load, race)
        for row, load in loaded
        for race in races
    )
    element, carried = bearing.kind.element, with_prefix(load, "N")
    fact = f"presses on the {race} race with {number(p / 1e9)} GPa"
    if no_load == NO_MOTION:
        fact = f"In the simulated motion a {element} carries up to {carried} and {fact}"
    else:
        fact = f"The most loaded {element} {fact} (load {carried})"
    most = f"the {allowed / 1e9:.1f} GPa that ISO 76 allows"
    beyond = f", above {most}: it dents the race, and elastic contact no longer holds."
    return upper_limit(name, p, allowed, "Pa", fact, beyond, f", below {most}.")


def _shoulder(scene: Scene, state: Equilibrium) -> Limit:
    """Return `_shoulder_of` the row whose contact is nearest to its shoulder."""
    bearing, known = scene.bearing, _known(state)
    if words := bearing.kind.tilt_unknown:
        name = f"tilt of the {bearing.kind.elements}"
        return Limit(name, math.nan, math.nan, "rad", False, words)
    loads = {"inner": state.inner_load[known], "outer": state.ball_load[known]}
    angles = {"inner": state.inner_contact_angle[known], "outer": state.contact_angle[known]}
    return _worst(
        _shoulder_of(row, race, loads[race][:, balls], angles[race][:, balls])
        for row, balls in bearing.unlike_rows
        for race in bearing.kind.shoulders
    )


def _worst(limits: Iterable[Limit]) -> Limit:
    """Return the limit that is nearest to being crossed, or crossed the farthest."""
    return max(limits, key=lambda limit: float(np.nan_to_num(limit.value / limit.limit, nan=-1.0)))


def _shoulder_of(bearing: Bearing, race: str, loads: Array, angles: Array) -> Limit:
    """Compare contact angles at a race, with half the contact ellipse if known, with the shoulder.

    The edge of a shoulder with a height h over the bottom is at the angle arccos(1 − h/r_b) from
    the groove's centre (Harris, truncated contact ellipse).
    """
    name = "contact angle at the shoulder"
    height = usual_shoulder_height(bearing.contact_angle)
    limit = math.acos(1.0 - 2.0 * height)
    carries = loads > 0.0
    if not carries.any():
        return unknown(name, limit, "rad", "no ball carries load" if loads.size else NO_STATE)
    reach = angles = np.abs(angles[carries])
    known = bearing.knows_contacts
    if known:
        half = bearing.race_contact(race).semi_axes(loads[carries])[0]
        spread = np.arcsin(np.minimum(half / bearing.ball_radius, 1.0))
        reach = angles + spread
    worst = int(np.argmax(reach))
    value = float(reach[worst])
    angle = math.degrees(angles[worst])
    load = with_prefix(float(loads[carries][worst]), "N")
    made_of = f"with a contact angle of {angle:.1f}°"
    if known:
        made_of += f" and half a contact ellipse of {math.degrees(value) - angle:.1f}°"
    else:
        made_of += " (half the contact ellipse comes on top, not known without groove radii)"
    fact = (
        f"A {bearing.kind.element} that carries {load} touches up to {math.degrees(value):.1f}° "
        "from the bottom of the groove, "
        f"{made_of}; a shoulder {number(height, 2)} ball diameters high is at "
        f"{math.degrees(limit):.1f}°"
    )
    return upper_limit(name, value, limit, "rad", fact, ": the ball rides over its edge.", ".")


def _centrifugal_share(bearing: Bearing, balls: slice, scene: Scene, state: Equilibrium) -> Limit:
    """Compare the centrifugal force with the load of the least loaded ball that carries load.

    Its median over the cage angles counts, because at some cage angles balls at the rim of the load
    zone carry almost nothing at any speed.
    """
    which = f"least loaded {bearing.kind.element}"
    name, limit = f"centrifugal force, {which}", CENTRIFUGAL_SHARE
    loads = state.ball_load[:, balls]
    lightest = np.where(loads > 0.0, loads, math.inf).min(axis=1, initial=math.inf)
    carried = _known(state) & np.isfinite(lightest)
    load = weighted_quantile(lightest[carried], state.shares[carried], 0.5)
    if not load > 0.0:
        return unknown(name, limit, "", "no ball is known to carry load")
    force = bearing.centrifugal_load(scene.shaft_speed)
    share = force / load
    fact = (
        f"The centrifugal force of a {bearing.kind.element}, {with_prefix(force, 'N')}, is "
        f"{percent(share)} of the {with_prefix(load, 'N')} on the {which}"
    )
    beyond = (
        f": it lifts that {bearing.kind.element} off the inner race, and the "
        f"{bearing.kind.element} may skid."
    )
    within = f", less than the {percent(limit)} that matter."
    return upper_limit(name, share, limit, "", fact, beyond, within)


def _centrifugal_change(scene: Scene) -> Limit:
    """Solve with and without centrifugal load, and check the change of loads and stiffness."""
    force = scene.bearing.centrifugal_load(scene.shaft_speed)
    name, limit = "change by centrifugal force", CENTRIFUGAL_CHANGE
    if words := scene.bearing.kind.mass_unknown:
        return unknown(name, limit, "", f"there is no model with the mass of {words}")
    try:
        grid = positions(scene, _CHANGE_ANGLES)
        sample = slice(None, None, max(grid.weights.size // _MOST_CHANGES, 1))
        effect = centrifugal_effect(scene, grid.cage_angles[sample], grid.shaft_angles[sample])
    except ValueError as error:
        return unknown(name, limit, "", str(error))
    if not effect.converged:
        return unknown(name, limit, "", "a cage angle lacks a static state with it or without it")
    value = max(effect.load, effect.stiffness)
    fact = (
        f"The centrifugal force of a {scene.bearing.kind.element}, {with_prefix(force, 'N')}, "
        f"changes loads by {_share_words(effect.load)} of the heaviest and stiffness by "
        f"{_share_words(effect.stiffness)}"
    )
    if effect.contact_angle > 1e-6:
        parted = number(math.degrees(effect.contact_angle), 2)
        fact += f", and separates the contact angles of the two races by up to {parted}°"
    left_out = NOT_IN_STATICS_WITH_MASS if scene.balls == WITH_MASS else NOT_IN_STATICS
    within = f"; up to {percent(limit)} it may be left out."
    return upper_limit(name, value, limit, "", fact, f": {left_out}, and here it counts.", within)


def _share_words(share: float) -> str:
    return f"up to {percent(share)}" if share >= 1e-4 else "less than 0.01 %"


def _compression(name: str, loaded: Loaded, no_load: str) -> Limit:
    """Compare the compression of the most loaded balls with the distance of the groove centres."""
    if not _are_known(loaded):
        return unknown(name, GREATEST_COMPRESSION, "", no_load)
    subject = "In the simulated motion a ball" if no_load == NO_MOTION else "The most loaded ball"
    return _worst(_compressed(row, name, load, subject) for row, load in loaded)


def _compressed(bearing: Bearing, name: str, load: float, subject: str) -> Limit:
    compression = contacts(bearing).compression(load)
    distance = center_distance(bearing.groove_center_distance)
    share = compression / distance
    most = percent(GREATEST_COMPRESSION)
    fact = (
        f"{subject} is compressed by {with_prefix(compression, 'm')}, {percent(share)} of the "
        f"{with_prefix(distance, 'm')} between the groove centres"
    )
    beyond = (
        f": above {most} the grooves, which fit closely around the ball, touch it far up their "
        "sides, and Hertz's small contact no longer holds."
    )
    within = f"; up to {most} the contact is small against the ball, as Hertz assumes."
    return upper_limit(name, share, GREATEST_COMPRESSION, "", fact, beyond, within)


def _stiffness(scene: Scene) -> Limit | None:
    """Compare the load-deflection factor with that of the drawing; None without a drawing."""
    bearing = scene.bearing
    if not bearing.is_drawn:
        return None
    drawn = series_factor(
        *(bearing.race_contact(race).load_deflection_factor for race in ("inner", "outer"))
    )
    difference = abs(bearing.load_deflection_factor / drawn - 1.0)
    fact = (
        f"The load-deflection factor of {number(bearing.load_deflection_factor / 1e6)} MN/m^1.5 "
        f"is {percent(difference)} off the {number(drawn / 1e6)} MN/m^1.5 that the drawing gives"
    )
    beyond = ": pressures and contact ellipses belong to the drawing, displacements to the factor."
    name = "load-deflection factor against the drawing"
    return upper_limit(name, difference, STIFFNESS_MISMATCH, "", fact, beyond, ".")


def _steps(scene: Scene, step_rate: float) -> Limit | None:
    """Count the time steps while a ball passes the shortest defect; None without a passage."""
    if not scene.defects or scene.cage_speed == 0.0:
        return None
    passing = shortest_passage(scene) / scene.cage_speed
    steps = passing * step_rate
    crossed = steps < STEPS_A_PASSAGE * (1.0 - 1e-9)
    sentence = (
        f"A ball passes the defect in {with_prefix(passing, 's')}, which are {number(steps)} time "
        f"steps at {number(step_rate, 6)} Hz; {STEPS_A_PASSAGE:.0f} or more keep its edges in the "
        "motion" + (": here steps can jump over them." if crossed else ".")
    )
    return Limit("time steps in a defect", steps, STEPS_A_PASSAGE, "", crossed, sentence)
