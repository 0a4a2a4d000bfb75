"""Static equilibrium over cage angles: load distribution and 5×5 stiffness (Eqs. 7-17)."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import (
    Array,
    ResultTable,
    _checks as checks,
    cached_property,
    shown_as_table,
    table_of,
    thousands,
)
from bearingcore.common._arrays import least_and_greatest
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import (
    DOF_NAMES,
    DOF_SYMBOLS,
    LOAD_ALONG,
    PackedScene,
    Scene,
    _packing as packing,
)
from bearingcore.model.statics._shortage import contact_motion, explanation, is_unbounded
from bearingcore.model.statics._status import StaticStatus

TERM_INDICES = {
    f"k_{a}{b}": (i, i + k) for i, a in enumerate(DOF_NAMES) for k, b in enumerate(DOF_NAMES[i:])
}
"""Row and column of each stiffness term."""

STIFFNESS_TERMS = tuple(TERM_INDICES)
"""Names of the 15 independent terms of the symmetric 5×5 stiffness matrix, row by row."""

TERM_UNITS = {
    term: ("N/m", "N/rad", "N·m/rad")[sum(DOF_NAMES[i].startswith("r") for i in indices)]
    for term, indices in TERM_INDICES.items()
}
"""Unit of each stiffness term."""

TERM_SYMBOLS = {
    term: "k " + "".join(DOF_SYMBOLS[DOF_NAMES[i]] for i in indices)
    for term, indices in TERM_INDICES.items()
}
"""Symbol of each stiffness term: "k xθy" for "k_xry"."""

ANGLES_A_PERIOD = 121

UNEXPLAINED = (StaticStatus.NOT_CONVERGED, StaticStatus.BEYOND_GEOMETRY)
"""Outcomes of a descent whose cause may be that no contact can carry the load."""

MOST_CONTACTS = 20_000_000
"""Greatest number of contacts in one call, balls times cage angles: some seconds of one core and a
gigabyte of answers."""


@shown_as_table
@dataclass(frozen=True)
class Equilibrium:
    """Static equilibrium of a scene at n cage angles. NaN where there is no answer.

    Attributes
    ----------
    scene, dofs
        the scene that was solved, and its free directions.
    cage_angles : (n,) [rad]
    displacement : (n, 5) [m, rad]
        of the inner ring along x, y, z and about x, y (Eq. 16); 0 in held directions, NaN in
        directions without any resistance.
    ball_load : (n, N_b) [N]
        Q_j (Eq. 13).
    stiffness : (n, 5, 5) [N/m, N/rad, N·m/rad]
        K_b (Eq. 17) in all five directions, including held ones.
    loaded_balls : (n,)
        number of balls that carry load.
    status : (n,)
        each a `StaticStatus`; `reason(i)` puts it into words.
    residual : (n,)
        unbalanced load over total load, moments divided by r_d; the total includes loads of held
        directions. A state has converged at 1e-9 or less, or, under a very light load on very
        stiff balls, at the rounding error of the displacement.
    state : (n, 5) [m]
        the last displacement of the solver, tilts times r_d, even if it failed.
    leads : (n,) [rad]
        angle of the shaft beyond ω_s/ω_c times the cage angle: see `shaft_angles`.
    cost
        words with the number of contacts if it exceeded MOST_CONTACTS; otherwise empty.
    weights : (n,)
        share of the time of each angle if the angles sample all positions of balls and shaft (see
        `bearingcore.model.statics._positions`); otherwise None.
    """

    scene: Scene
    dofs: tuple[str, ...]
    cage_angles: Array
    displacement: Array
    ball_load: Array
    stiffness: Array
    loaded_balls: NDArray[np.int64]
    status: NDArray[np.int8]
    residual: Array
    state: Array = field(repr=False)
    leads: Array = field(repr=False)
    cost: str = ""
    weights: Array | None = field(default=None, repr=False)

    @cached_property
    def converged(self) -> NDArray[np.bool_]:
        """(n,) True where there is exactly one equilibrium, and the solver reached it."""
        return self.status == StaticStatus.CONVERGED

    @property
    def sentence(self) -> str:
        """Sentence on the free directions and on tilts of the shaft."""
        free = f"Free are {', '.join(DOF_SYMBOLS[dof] for dof in self.dofs)}."
        return f"{free} {self.scene.tilt_words(self.dofs)}".rstrip()

    @property
    def shaft_angles(self) -> Array:
        """(n,) [rad] angles of the shaft, and of defects of the inner race."""
        return self.cage_angles / self.scene.bearing.cage_ratio + self.leads

    @cached_property
    def shares(self) -> Array:
        """(n,) share of the time of each angle: `weights`, or without them `time_shares`."""
        if self.weights is not None:
            return self.weights
        return time_shares(self.cage_angles, self.scene.bearing.period)

    @property
    def carries(self) -> NDArray[np.bool_]:
        """(n, N_b) True for balls that carry load from ring to ring, at both races."""
        return np.asarray((self.inner_load > 0.0) & (self.ball_load > 0.0))

    @property
    def inner_load(self) -> Array:
        """(n, N_b) [N] load of each ball at the inner race; for massless balls Q_j."""
        return self.ball_load

    @cached_property
    def ball_angle(self) -> Array:
        """(n, N_b) [rad] angle φ_j of each ball, 0 to 2π (Eq. 4), row after row."""
        return packing.ball_angles(self.scene.bearing, self.cage_angles) % (2.0 * math.pi)

    @cached_property
    def contact_angle(self) -> Array:
        """(n, N_b) [rad] loaded contact angle α_j (Eq. 14); NaN for balls that carry nothing."""
        contacts = packing.contacts(self.scene.bearing)
        along, across = contact_motion(self.scene, self.cage_angles, self.state, self.leads)
        # Equation (8), in which the part along the unloaded line counts only while positive
        along += contacts.distance
        turned = np.arctan2(across, np.maximum(along, 0.0))
        angle = np.arctan2(contacts.line_z, contacts.line_r)
        angle = angle + np.where(contacts.fixed, 0.0, turned)
        return np.where(self.ball_load > 0.0, angle, math.nan)

    @property
    def inner_contact_angle(self) -> Array:
        """(n, N_b) [rad] contact angle at the inner race; for massless balls α_j."""
        return self.contact_angle

    def term(self, name: str) -> Array:
        """Return a stiffness term (n,) by name, e.g. "k_yy" [N/m, N/rad, N·m/rad]."""
        if name not in TERM_INDICES:
            raise checks.refuse("stiffness term", name, ", ".join(STIFFNESS_TERMS))
        i, j = TERM_INDICES[name]
        return self.stiffness[:, i, j]

    def table(self) -> ResultTable:
        """A row for each cage angle: displacement, stiffness terms, loaded balls, loads, status."""
        state = zip(DOF_NAMES, self.displacement.T, strict=True)
        return table_of(
            ("cage_angle", "rad", self.cage_angles, "angle of the cage"),
            *(
                (f"displacement_{dof}", "rad" if dof.startswith("r") else "m", q)
                for dof, q in state
            ),
            *((term, TERM_UNITS[term], self.term(term)) for term in STIFFNESS_TERMS),
            ("loaded_balls", "", self.loaded_balls, "balls that carry load"),
            *(
                (f"ball_{j + 1}_load", "N", load, f"load of ball {j + 1}")
                for j, load in enumerate(self.ball_load.T)
            ),
            ("status", "", [self.reason(i) for i in range(len(self.cage_angles))]),
        )

    def stiffness_table(self, i: int | None = None) -> ResultTable:
        """Return K_b as 5 × 5 numbers in SI units: a row per load, a column per displacement.

        It is that at cage angle i; None takes the mean in time over all angles with an equilibrium.
        """
        if i is None:
            stiffness = self._mean(self.stiffness)
        else:
            at_most = len(self.cage_angles) - 1
            stiffness = self.stiffness[checks.whole_number("i", i, at_least=0, at_most=at_most)]
        loads = LOAD_ALONG.items()
        names = [f"{load} [{'N·m' if dof.startswith('r') else 'N'}]" for dof, load in loads]
        return table_of(
            ("load", "", names),
            *(
                (f"per_{'rad' if dof.startswith('r') else 'm'}_{dof}", "", column)
                for dof, column in zip(DOF_NAMES, stiffness.T, strict=True)
            ),
        )

    def displacement_table(self) -> ResultTable:
        """Return the displacement of the inner ring, a row for each direction, in m and rad.

        Columns are the least value, the mean in time and the greatest value of the angles with an
        equilibrium.
        """
        least, greatest = least_and_greatest(self.displacement, 0)
        return table_of(
            ("direction", "", list(DOF_NAMES)),
            ("unit", "", ["rad" if dof.startswith("r") else "m" for dof in DOF_NAMES]),
            ("least", "", least),
            ("mean", "", self._mean(self.displacement)),
            ("greatest", "", greatest),
        )

    def _mean(self, values: Array) -> Array:
        """Return the mean in time of numbers (n, ...) over the angles at which all are known."""
        known = np.isfinite(values).all(axis=tuple(range(1, values.ndim)))
        share = np.where(known, self.shares, 0.0)
        return np.tensordot(share, np.nan_to_num(values), 1) / (share.sum() or np.nan)

    def reason(self, i: int) -> str:
        """Return the status of cage angle i in words."""
        free = [
            name for name in self.dofs if math.isnan(self.displacement[i, DOF_NAMES.index(name)])
        ]
        status = StaticStatus(int(self.status[i]))
        words = status.sentence(", ".join(free), float(self.residual[i]))
        angle = float(self.cage_angles[i])
        return self.cost or words + explanation(status, self.scene, angle, self.dofs, self.state[i])


def default_cage_angles(scene: Scene, n: int = ANGLES_A_PERIOD) -> Array:
    """Return n evenly spaced cage angles [rad] over a period of the scene's curves, ends included.

    The period is a ball spacing, or `Bearing.period` for unlike rows. A defect of the inner race
    turns with the shaft, and curves then have no period: they are given over one turn of the shaft
    of many, all of which `bearingcore.model.statics._positions` covers. More than a ball spacing
    has eight times as many angles.
    """
    period = scene.bearing.period
    if scene.defect_turns:
        period = 2.0 * math.pi * scene.bearing.cage_ratio
    return np.linspace(0.0, period, 8 * (n - 1) + 1 if has_long_period(scene) else n)


def time_shares(cage_angles: Array, period: float) -> Array:
    """Return the share of the time (n,) of each cage angle (n,) [rad], by the trapezium rule.

    Both ends of a period are the same position, so each counts half. All shares are equal if angles
    do not rise, or if one more even step would end a period [rad].
    """
    steps = np.diff(cage_angles)
    shares = np.ones(cage_angles.size)
    if steps.size and steps.min() > 0.0:
        periods = (steps.sum() + steps[-1]) / period
        is_even = np.ptp(steps) <= 1e-9
        if not (is_even and periods > 0.5 and abs(periods - round(periods)) <= 1e-9):
            shares = np.append(steps, 0.0) + np.insert(steps, 0, 0.0)
    return shares / shares.sum() if shares.size else shares


def has_long_period(scene: Scene) -> bool:
    """Return True if the period of the scene's curves is not a ball spacing."""
    turning = scene.defect_turns
    return turning or scene.bearing.period != scene.bearing.ball_spacing


def equilibrium(
    scene: Scene,
    cage_angles: ArrayLike | None = None,
    dofs: Iterable[str] | None = None,
    *,
    shaft_angles: ArrayLike | None = None,
) -> Equilibrium:
    """Compute the static equilibrium (Eq. 15) and stiffness (Eq. 17) of `scene` at each cage angle.

    Parameters
    ----------
    scene
        the scene to solve.
    cage_angles : (n,)
        [rad]; None takes `default_cage_angles`. Each solution starts from earlier ones, so ordered
        angles are cheapest; the answer does not depend on the order.
    dofs
        free directions, names out of x, y, z, rx, ry, or "tilt held"; None takes the scene's. The
        constraint of a held direction carries the load along it.
    shaft_angles : (n,)
        [rad], angle of the shaft, and of an inner-race defect, at each cage angle. None takes
        ω_s/ω_c times the cage angle, which is one of many possible runs: see
        `bearingcore.model.statics._positions`.

    Returns
    -------
    Equilibrium
        with a status for each cage angle. A missing or ambiguous answer is a status, not an error:
        see `Equilibrium.reason`. With more than MOST_CONTACTS contacts, cage angles times balls,
        nothing is computed.

    Raises
    ------
    ValueError
        for angles that are not finite or arrays of unequal length, or unknown names in `dofs`.
    """
    checks.instance("scene", scene, Scene)
    packed = packing.pack(scene, scene.free_dofs(dofs))
    if cage_angles is None:
        cage_angles = default_cage_angles(scene)
    return equilibrium_of(packed, cage_angles, shaft_angles)


def remove_defects(packed: PackedScene) -> PackedScene:
    """Return the same packed scene without its defects."""
    return dataclasses.replace(packed, scene=packed.scene.healthy(), path=packing.HEALTHY_PATH)


def equilibrium_of(
    packed: PackedScene, cage_angles: ArrayLike, shaft_angles: ArrayLike | None = None
) -> Equilibrium:
    """Return the `equilibrium` of a packed scene."""
    scene = packed.scene
    angles = checks.finite("cage_angles", cage_angles, "rad")
    leads = np.zeros_like(angles)
    if shaft_angles is not None:
        leads = checks.finite("shaft_angles", shaft_angles, "rad")
        if leads.shape != angles.shape:
            raise checks.refuse("shaft_angles", leads.size, f"{angles.size}, one a cage angle")
        leads = leads - angles / scene.bearing.cage_ratio
    balls = packed.contacts.angle.size
    if cost := too_many_contacts(balls * angles.size):
        return _not_begun(packed, angles, leads, cost)
    units = packed.units
    q, loads, stiffness, loaded, status, residual, _ = kernels.static_states(
        angles, leads, packed.contacts, packed.path, packed.load
    )
    displacement = q / units
    # without an answer, numbers are NaN; where nothing touches, only the loads (0) are known
    failed = np.flatnonzero(status)
    if failed.size:
        _explain(packed, angles, status, stiffness, displacement, failed)
        gone = status >= StaticStatus.NOT_CARRIED
        loads[gone] = math.nan
        loaded[gone] = 0
        loose = status == StaticStatus.NOTHING_TOUCHES
        loads[loose] = 0.0
        loaded[loose] = 0
        nowhere = gone | loose
        displacement[nowhere] = math.nan
        stiffness[nowhere] = math.nan
    stiffness *= units[:, None] * units  # of scaled tilts and moments, into [N/rad, N·m/rad]
    return Equilibrium(
        scene=scene,
        dofs=packed.dofs,
        cage_angles=angles,
        displacement=displacement,
        ball_load=loads,
        stiffness=stiffness,
        loaded_balls=loaded,
        status=status,
        residual=residual,
        state=q,
        leads=leads,
    )


def too_many_contacts(contacts: int) -> str:
    """Return words on the number of contacts if it is too large; otherwise an empty text."""
    if contacts <= MOST_CONTACTS:
        return ""
    most = thousands(MOST_CONTACTS)
    return f"too many contacts: {thousands(contacts)}, in one call at most {most} are solved"


def _not_begun(packed: PackedScene, angles: Array, leads: Array, cost: str) -> Equilibrium:
    """Return an `Equilibrium` of NaN everywhere, without the memory that its arrays would need."""
    n, balls, unknown = angles.size, packed.contacts.angle.size, np.float64(math.nan)
    rows = np.broadcast_to(unknown, (n, 5))
    return Equilibrium(
        scene=packed.scene,
        dofs=packed.dofs,
        cage_angles=angles,
        displacement=rows,
        ball_load=np.broadcast_to(unknown, (n, balls)),
        stiffness=np.broadcast_to(unknown, (n, 5, 5)),
        loaded_balls=np.broadcast_to(np.int64(0), n),
        status=np.broadcast_to(np.int8(StaticStatus.TOO_MANY_CONTACTS), n),
        residual=rows[:, 0],
        state=rows,
        leads=leads,
        cost=cost,
    )


def _explain(
    packed: PackedScene,
    angles: Array,
    status: NDArray[np.int8],
    stiffness: Array,
    displacement: Array,
    failed: NDArray[np.int64],
) -> None:
    """Find the cause of each failure: free directions, or a load that no contact can carry."""
    force, active = packed.load
    for k in failed:
        if status[k] == StaticStatus.FREE_DIRECTION:
            K = stiffness[k][np.ix_(active, active)]
            if not np.isfinite(K).all():  # the stiffness overflows, so that nothing is free
                status[k] = StaticStatus.NOT_CONVERGED
                continue
            values, vectors = np.linalg.eigh(K)
            soft = vectors[:, values <= 10 * kernels.NO_PIVOT * values[-1]]
            displacement[k, active[np.abs(soft).max(axis=1, initial=0.0) > 1e-6]] = math.nan
        elif status[k] in UNEXPLAINED and is_unbounded(
            packed.contacts, angles[k], active, force[active]
        ):
            status[k] = StaticStatus.NOT_CARRIED
