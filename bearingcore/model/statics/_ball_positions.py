"""Static equilibrium of fast bearings: contact angles of both races under centrifugal load."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import (
    Array,
    ResultTable,
    _checks as checks,
    cached_property,
    shown_as_table,
    table_of,
)
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import DOF_NAMES, WITH_MASS, Scene, _packing as packing
from bearingcore.model.statics._equilibrium import (
    TERM_INDICES,
    Equilibrium,
    default_cage_angles,
    equilibrium,
    equilibrium_of,
)
from bearingcore.model.statics._shortage import explanation
from bearingcore.model.statics._status import StaticStatus

BALANCED = 1e-8
"""Greatest unbalanced force on a settled ball, relative to the greatest load."""

CARRYING = 0.05
"""Share of the heaviest load above which a ball counts as loaded."""


@shown_as_table
@dataclass(frozen=True)
class BallPositions:
    """Static equilibrium of a scene with freely placed balls, at n cage angles.

    NaN where there is no answer. In arrays with one entry per race the inner race comes first.

    Attributes
    ----------
    scene, dofs, cage_angles : (n,) [rad]
        the scene, its free directions, and the cage angles.
    centrifugal_load
        F_c [N] of each ball of the first row.
    displacement : (n, 5) [m, rad]
        of the inner ring.
    load : (2, n, N_b) [N]
        of the contacts with the inner and outer race.
    contact_angle : (2, n, N_b) [rad]
        of each contact; NaN if it carries nothing.
    position : (n, 2, N_b) [m]
        of each ball, radial and axial, from that of a ball that touches the outer race at the
        unloaded contact angle. A ball that carries nothing is inside the clearance.
    stiffness : (n, 5, 5) [N/m, N/rad, N·m/rad]
    status, residual : (n,)
        as in `Equilibrium`.
    leads, cost
        the same as in `Equilibrium`.
    """

    scene: Scene
    dofs: tuple[str, ...]
    cage_angles: Array
    centrifugal_load: float
    displacement: Array
    load: Array
    contact_angle: Array
    position: Array
    stiffness: Array
    status: NDArray[np.int8]
    residual: Array
    leads: Array
    cost: str = ""

    @cached_property
    def converged(self) -> NDArray[np.bool_]:
        """(n,) True where there is exactly one equilibrium, and the solver reached it."""
        return self.status == StaticStatus.CONVERGED

    def term(self, name: str) -> Array:
        """Return a stiffness term (n,) by name, e.g. "k_yy" [N/m, N/rad, N·m/rad]."""
        i, j = TERM_INDICES[name]
        return self.stiffness[:, i, j]

    def reason(self, i: int) -> str:
        """Return the status of cage angle i in words."""
        status = StaticStatus(int(self.status[i]))
        words = status.sentence(" or ".join(self.dofs), float(self.residual[i]))
        angle = float(self.cage_angles[i])
        return self.cost or words + explanation(status, self.scene, angle, self.dofs)

    def table(self) -> ResultTable:
        """A row for each cage angle: displacement, stiffness, loads and angles of each ball."""
        balls = range(self.load.shape[2])
        return table_of(
            ("cage_angle", "rad", self.cage_angles),
            *(
                (f"displacement_{dof}", "rad" if dof.startswith("r") else "m", values)
                for dof, values in zip(DOF_NAMES, self.displacement.T, strict=True)
            ),
            *(
                (f"ball_{j + 1}_{race}_load", "N", self.load[i, :, j])
                for i, race in enumerate(("inner", "outer"))
                for j in balls
            ),
            *(
                (f"ball_{j + 1}_{race}_contact_angle", "rad", self.contact_angle[i, :, j])
                for i, race in enumerate(("inner", "outer"))
                for j in balls
            ),
        )


def ball_positions(
    scene: Scene,
    cage_angles: ArrayLike | None = None,
    dofs: Iterable[str] | None = None,
    *,
    shaft_angles: ArrayLike | None = None,
    centrifugal_load: float | None = None,
) -> BallPositions:
    """Compute the static equilibrium of `scene` under the centrifugal load of its balls.

    Each ball moves to its equilibrium between its two contacts; contact angles, loads and stiffness
    follow. Without centrifugal load the result is that of `equilibrium`, but for rounding. The
    weight of the balls is left out, and so is their gyroscopic moment, which has no potential:
    `limits` gives the speed from which it matters.

    Parameters
    ----------
    scene, cage_angles, dofs, shaft_angles
        the same as in `equilibrium`.
    centrifugal_load
        F_c [N] of each ball; None takes that at the scene's speed.

    Returns
    -------
    BallPositions
        with a status for each cage angle.

    Raises
    ------
    ValueError
        for angles that are not finite or arrays of unequal length, unknown names in `dofs`, or
        contacts so soft or stiff that their numbers overflow.
    """
    checks.instance("scene", scene, Scene)
    scene.bearing.kind.check_mass()
    active = scene.free_dofs(dofs)
    with _refuse_overflow(scene):
        packed = packing.pack(scene, active, balls=True)
    if cage_angles is None:
        cage_angles = default_cage_angles(scene)
    massless = equilibrium_of(packed, cage_angles, shaft_angles)
    assert packed.balls is not None
    races = packed.balls.races
    races = races._replace(weight=np.zeros_like(races.weight))
    if centrifugal_load is not None:
        races = races._replace(centrifugal=np.full_like(races.mass, centrifugal_load))
    if massless.cost:
        loads = np.broadcast_to(massless.ball_load, (2, *massless.ball_load.shape))
        return BallPositions(
            scene, active, massless.cage_angles, float(races.centrifugal[0]),
            massless.displacement, loads, loads, np.swapaxes(loads, 0, 1), massless.stiffness,
            massless.status, massless.residual, massless.leads, massless.cost,
        )  # fmt: skip
    # the state of massless balls is the first guess
    start = np.where(np.isfinite(massless.state), massless.state, 0.0)
    with _refuse_overflow(scene):
        balls = packed.balls._replace(races=races)
        q, load, angle, place, stiffness, status, residual, _ = kernels.ball_positions(
            massless.cage_angles, massless.leads, start, balls, packed.load
        )
    # check the answers: geometry, loads that no contact carries, balance of each ball
    status[_exceeds_geometry(packed.balls, q, load, status)] = StaticStatus.BEYOND_GEOMETRY
    for missing in (StaticStatus.NOT_CARRIED, StaticStatus.BEYOND_GEOMETRY):
        status[massless.status == missing] = missing
    unbalanced = _unbalanced(races, load, angle)
    unsettled = (status < StaticStatus.NOT_CARRIED) & (unbalanced > BALANCED)
    status[unsettled] = StaticStatus.NOT_CONVERGED
    residual = np.maximum(residual, unbalanced)
    units = packed.units
    gone = status >= StaticStatus.NOT_CARRIED
    displacement = q / units
    stiffness *= units[:, None] * units
    for values in (displacement, place, stiffness):
        values[gone] = math.nan
    load[:, gone] = angle[:, gone] = math.nan
    loose = np.isin(status, (StaticStatus.NOTHING_TOUCHES, StaticStatus.FREE_DIRECTION))
    displacement[np.ix_(loose, packed.load.active)] = math.nan
    return BallPositions(
        scene,
        active,
        massless.cage_angles,
        float(races.centrifugal[0]),
        displacement,
        load,
        angle,
        place,
        stiffness,
        status.astype(np.int8),
        residual,
        massless.leads,
    )


@dataclass(frozen=True)
class EquilibriumWithMass(Equilibrium):
    """Static equilibrium of balls under their centrifugal load.

    `ball_load` and `contact_angle` are those at the outer race, which carries the load of the inner
    race and the centrifugal load.

    Attributes
    ----------
    positions
        positions of the balls, with loads and contact angles at both races.
    """

    positions: BallPositions = field(kw_only=True)

    @cached_property
    def contact_angle(self) -> Array:
        """(n, N_b) [rad] contact angle at the outer race; NaN for balls that carry nothing."""
        return self.positions.contact_angle[1]

    @property
    def inner_load(self) -> Array:
        """(n, N_b) [N] load of each ball at the inner race."""
        return self.positions.load[0]

    @property
    def inner_contact_angle(self) -> Array:
        """(n, N_b) [rad] contact angle at the inner race; NaN for contacts that carry nothing."""
        return self.positions.contact_angle[0]


def static_state(
    scene: Scene,
    cage_angles: ArrayLike | None = None,
    dofs: Iterable[str] | None = None,
    *,
    shaft_angles: ArrayLike | None = None,
) -> Equilibrium:
    """Compute the static equilibrium with the balls that the scene has, massless or with mass.

    For massless balls this is `equilibrium`. Balls with mass (`Scene.balls`) carry their
    centrifugal load at the scene's speed, with an `EquilibriumWithMass` from `ball_positions`.
    Arguments and exceptions are those of `equilibrium`.
    """
    checks.instance("scene", scene, Scene)
    if scene.balls != WITH_MASS:
        return equilibrium(scene, cage_angles, dofs, shaft_angles=shaft_angles)
    answer = ball_positions(scene, cage_angles, dofs, shaft_angles=shaft_angles)
    known = answer.status < StaticStatus.NOT_CARRIED
    carries = (answer.load[0] > 0.0) & (answer.load[1] > 0.0)
    return EquilibriumWithMass(
        scene=scene,
        dofs=answer.dofs,
        cage_angles=answer.cage_angles,
        displacement=answer.displacement,
        ball_load=answer.load[1],
        stiffness=answer.stiffness,
        loaded_balls=np.where(known, carries.sum(axis=1), 0),
        status=answer.status,
        residual=answer.residual,
        state=answer.displacement * packing.length_units(scene),
        leads=answer.leads,
        cost=answer.cost,
        positions=answer,
    )


class CentrifugalEffect(NamedTuple):
    """Greatest changes of a scene's static state by centrifugal load, over its cage angles.

    Attributes
    ----------
    load
        change of a load at the outer race over the heaviest load.
    contact_angle [rad]
        angle between the two contacts of a ball with more than CARRYING of the heaviest load.
    stiffness
        change of k_xx, k_yy or k_zz over the greatest value of that term, root mean square over the
        cage angles, as terms jump when a ball takes up load.
    converged
        True if both states have an answer at all cage angles.
    """

    load: float
    contact_angle: float
    stiffness: float
    converged: bool


@contextmanager
def _refuse_overflow(scene: Scene) -> Iterator[None]:
    """Turn an overflow into an error that names the load-deflection factor."""
    try:
        yield
    except ArithmeticError:
        raise checks.refuse(
            "load_deflection_factor",
            scene.bearing.load_deflection_factor,
            "one of which a computer has numbers for the contacts of both races",
        ) from None


def centrifugal_effect(
    scene: Scene, cage_angles: ArrayLike | None = None, shaft_angles: ArrayLike | None = None
) -> CentrifugalEffect:
    """Compare the static states with and without centrifugal load; see `ball_positions`."""
    without = ball_positions(scene, cage_angles, shaft_angles=shaft_angles, centrifugal_load=0.0)
    with_load = ball_positions(scene, without.cage_angles, shaft_angles=shaft_angles)
    both = without.converged & with_load.converged
    if not both.all():
        return CentrifugalEffect(math.nan, math.nan, math.nan, False)
    heaviest = max(float(without.load.max()), 1e-300)
    load = np.abs(with_load.load[1] - without.load[1]).max() / heaviest
    parted = np.abs(with_load.contact_angle[0] - with_load.contact_angle[1])
    parted = parted[(with_load.load > CARRYING * heaviest).all(axis=0)]
    # a mean over the cage angles, as the terms of both states jump at different angles
    changes = [
        np.sqrt(np.mean((with_load.term(name) - without.term(name)) ** 2))
        / max(without.term(name).max(), 1.0)
        for name in ("k_xx", "k_yy", "k_zz")
    ]
    separation = float(np.nanmax(parted)) if np.isfinite(parted).any() else 0.0
    return CentrifugalEffect(float(load), separation, float(max(changes)), True)


def _unbalanced(races: kernels.Races, load: Array, angle: Array) -> Array:
    """Return the greatest unbalanced force (n,) on a ball as a share of the angle's greatest load.

    This checks the answer of the kernel independently, so that no unsettled ball is accepted.
    """
    known = np.nan_to_num(angle)
    radial, axial = load * np.cos(known), load * np.sin(known)
    outwards = radial[0] - radial[1] + races.centrifugal
    force = np.hypot(outwards, axial[0] - axial[1]).max(axis=1)
    # the centrifugal load keeps the ratio finite for balls without load in the gap
    size = np.maximum(load.max(axis=(0, 2)), np.abs(races.centrifugal).max())
    return np.asarray(force / np.maximum(size, 1e-300) * (force > 0.0))


def _exceeds_geometry(
    balls: kernels.StaticBalls, q: Array, load: Array, status: NDArray[np.int8]
) -> NDArray[np.bool_]:
    """Return True (n,) for balances of loads outside the geometry of the contacts.

    Each of the two contacts of a ball may use all of `kernels.Contacts.room`.
    """
    contacts = balls.contacts
    most = balls.races.factor * contacts.room**contacts.exponent
    outside = (load > most[:, None]).any(axis=(0, 2))
    tilted = (np.abs(q[:, 3:]) > contacts.most_tilt).any(axis=1)
    converged, free = (status == code for code in (kernels.CONVERGED, kernels.FREE_DIRECTION))
    return np.asarray(converged & (outside | tilted) | free & outside)
