"""Work and precision of solvers of the static equilibrium.

The contacts are implemented here a second time, in NumPy, readable, for all cage angles at once and
in any precision. The compiled contacts are compared with them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, _checks as checks, scientific
from bearingcore.model import _kernels as kernels
from bearingcore.model.experiments._points import (
    NOT_WATCHED,
    RIGHT,
    Experiment,
    Point,
    Reference,
    Watch,
    least_time,
    measure_in_turn,
)
from bearingcore.model.scene import Scene, _packing as packing
from bearingcore.model.statics import default_cage_angles, drops_at, equilibrium, path_kinks

STATIC_ERRORS = {
    "stiffness": "greatest error of a stiffness term over the size of the term, or of its "
    "neighbours on the diagonal where symmetry makes it zero",
    "load": "greatest error of a ball's load over the greatest load",
}
"""Errors of static states by name."""

STATICS_LEFT_OUT = (
    "gradient descent on the energy, which takes hundreds of evaluations an angle; plain "
    "Newton steps, which fail where no ball is touched; the compiled Newton at looser "
    "tolerances, which save nothing because its last step squares the error"
)

WRONG_STIFFNESS, STRICT = 0.1, 1e-6
"""Error and tolerance that define a failure: a solver with a tolerance of STRICT or less fails if
the stiffness of an answer that it calls solved is wrong by more than WRONG_STIFFNESS."""


@dataclass(frozen=True)
class StaticProblem:
    """Static equilibrium of a scene at m cage angles, rotations times r_d, moments divided by r_d.

    `c`, `s`, `d` (m, N_b) are cosine, sine [-] and drop [m] of each ball; `force` (5,) [N] is the
    load, `active` the free directions, `packed` all contacts, `guess` (5,) [m] the first guess.
    """

    scene: Scene
    angles: Array
    c: Array
    s: Array
    d: Array
    force: Array
    active: NDArray[np.int64]
    packed: kernels.Contacts
    guess: Array

    @property
    def load(self) -> float:
        """Size of the load along the free directions [N]."""
        return float(np.linalg.norm(self.force[self.active]))


def static_problem(scene: Scene, angles: Array) -> StaticProblem:
    """Return the numbers of a scene's static equilibrium at cage angles (m,) [rad]."""
    numbers = packing.pack(scene)
    packed, (force, active) = numbers.contacts, numbers.load
    phi = packed.angles_at(angles)
    guess = np.zeros(5)
    load = float(np.linalg.norm(force[active]))
    if load > 0.0:
        reach = packed.clearance[0] / packed.line_r[0]
        reach += packed.compression(load)
        guess[active] = reach * force[active] / load
    drop = drops_at(scene, angles)
    return StaticProblem(
        scene, angles, np.cos(phi), np.sin(phi), drop, force, active, packed, guess
    )


class Contacts(NamedTuple):
    """Elastic energy (m,) [N·m], forces (m, 5) [N], stiffness (m, 5, 5), loads (m, N_b) [N]."""

    energy: Any
    force: Any
    stiffness: Any
    load: Any


def contacts(problem: StaticProblem, q: Any, rows: Any = slice(None)) -> Contacts:
    """Return all contacts at displacements q (m, 5) [m], in the precision of q (Eqs. 7-17)."""
    packed = problem.packed
    ca, sa, A0, n = packed.line_r, packed.line_z, packed.distance, packed.exponent
    c, s, d = problem.c[rows], problem.s[rows], problem.d[rows]
    R = np.stack([c, s, np.zeros_like(c), -packed.arm * s, packed.arm * c], axis=-1)
    Z = np.stack([0.0 * c, 0.0 * c, np.ones_like(c), packed.reach * s, -packed.reach * c], axis=-1)
    radial = np.einsum("mjd,md->mj", R, q) - packed.clearance  # Equation (11)
    axial = np.einsum("mjd,md->mj", Z, q) + packed.offset  # Equation (12)
    longer = radial * ca + axial * sa - d
    along = A0 + longer
    across = axial * ca - radial * sa
    guarded = np.maximum(along, 0.0)
    A = np.sqrt(guarded**2 + across**2)  # Equation (7)
    # A − A0 without a difference, as A0 is a thousand compressions long
    whole = np.maximum(A + A0, 1e-300)
    stretch = np.where(along > 0.0, (longer * (A0 + along) + across**2) / whole, A - A0)
    delta = np.maximum(np.where(packed.fixed, longer, stretch), 0.0)
    length = np.maximum(A, 1e-300)
    eu = np.where(packed.fixed, 1.0, guarded / length)
    ew = np.where(packed.fixed, 0.0, across / length)
    er, ez = eu * ca - ew * sa, eu * sa + ew * ca  # Equation (14)
    k1 = n * packed.factor * delta ** (n - 1.0)
    Q = k1 * delta / n  # Equation (13)
    k2 = np.where((along > 0.0) & ~packed.fixed, Q / length, 0.0)
    e = er[..., None] * R + ez[..., None] * Z
    t = -ez[..., None] * R + er[..., None] * Z
    force = (Q[..., None] * e).sum(axis=1)  # Equation (15)
    stiffness = np.swapaxes(k1[..., None] * e, 1, 2) @ e  # Equation (17)
    stiffness = stiffness + np.swapaxes(k2[..., None] * t, 1, 2) @ t
    return Contacts((Q * delta / (n + 1.0)).sum(axis=1), force, stiffness, Q)


class Solved(NamedTuple):
    """Displacements (m, 5), True where the solver claims success, and number of evaluations."""

    q: Any
    solved: NDArray[np.bool_]
    evaluations: int


def refine(problem: StaticProblem, q: Array) -> Solved:
    """Refine displacements q (m, 5) [m] by four Newton steps whose forces are 80-bit numbers.

    The stiffness stays in double precision, which only makes the steps slightly wrong. An angle is
    solved where the unbalanced load is below 1e-15 of the load. The energy is convex, so the error
    is then at most this unbalanced load over the least stiffness.
    """
    active = problem.active
    precise = np.where(np.isfinite(q), q, 0.0).astype(np.longdouble)
    force = problem.force.astype(np.longdouble)
    for _ in range(4):
        state = contacts(problem, precise)
        unbalanced = (state.force - force)[:, active].astype(float)
        stiffness = state.stiffness[:, active][:, :, active].astype(float)
        inverse = np.linalg.pinv(stiffness, rcond=1e-12, hermitian=True)
        precise[:, active] -= np.einsum("mij,mj->mi", inverse, unbalanced)
    exact = np.isfinite(q).all(axis=1) & (residuals(problem, precise) <= 1e-15)
    return Solved(precise, exact, 4 * len(q))


def residuals(problem: StaticProblem, q: Any) -> Array:
    """Return the unbalanced load over the load (m,) at displacements (m, 5) [m]."""
    unbalanced = (contacts(problem, q).force - problem.force)[:, problem.active].astype(float)
    sizes: Array = np.linalg.norm(unbalanced, axis=1)
    return sizes / (problem.load or 1.0)


def _scipy(
    problem: StaticProblem,
    tolerance: float,
    method: str,
    warm: bool = False,
    starts: Array | None = None,
) -> Solved:
    """Solve angle by angle by `scipy.optimize.root`, `least_squares` or `minimize`.

    `minimize` works on the energy ("trust-exact"), the others on the forces. Each angle starts from
    the guess, if `warm` from the angle before, or from `starts` (m, 5) [m]. Displacements are in
    units of the length of the guess.
    """
    from scipy.optimize import least_squares, minimize, root  # imported late: slow to import

    active, load = problem.active, problem.load or 1.0
    length = float(np.linalg.norm(problem.guess)) or 1e-6
    q, solved = np.zeros((len(problem.angles), 5)), np.zeros(len(problem.angles), dtype=bool)
    evaluations = 0

    def contacts_at(u: Array, k: int) -> Contacts:
        nonlocal evaluations
        evaluations += 1
        full = np.zeros((1, 5))
        full[0, active] = u * length
        return contacts(problem, full, slice(k, k + 1))

    def unbalanced(u: Array, k: int) -> Array:
        return np.asarray((contacts_at(u, k).force[0] - problem.force)[active] / load)

    def jacobian(u: Array, k: int) -> Array:
        return np.asarray(contacts_at(u, k).stiffness[0][np.ix_(active, active)] * (length / load))

    def energy(u: Array, k: int) -> tuple[float, Array]:
        """Return the energy with that of the load, over load times length, and its slopes."""
        state = contacts_at(u, k)
        work = float(u @ problem.force[active]) * length
        slopes = (state.force[0] - problem.force)[active] / load
        return (float(state.energy[0]) - work) / (load * length), slopes

    for k in range(len(q)):
        begin = problem.guess if starts is None else starts[k]
        begin = q[k - 1] if warm and k > 0 and solved[k - 1] else begin
        start = begin[active] / length
        if method == "least_squares":
            tight = max(tolerance, 2.3e-16)
            result: Any = least_squares(
                unbalanced, start, jac=jacobian, args=(k,), ftol=tight, xtol=tight, gtol=tight
            )
            success = result.success and np.abs(result.fun).max() <= max(tolerance, 1e-8)
        elif method == "trust-exact":
            result = minimize(
                energy, start, args=(k,), jac=True, hess=jacobian, method="trust-exact",
                options={"gtol": tolerance},
            )  # fmt: skip
            success = result.success
        else:
            result = root(  # type: ignore[call-overload]
                unbalanced, start, args=(k,), jac=jacobian, method=method, tol=tolerance
            )
            success = result.success
        q[k, active], solved[k] = result.x * length, success
    return Solved(q, solved, evaluations)


def _compiled(problem: StaticProblem, tolerance: float, warm: bool = True) -> Solved:
    """Solve by the program's own solver, whose tolerance is fixed.

    Each angle starts from the previous one, or without `warm` from the guess. The latter takes one
    call for each angle, and the time includes these calls.
    """
    load = kernels.StaticLoad(problem.force, problem.active)
    path = packing.path(problem.scene)
    parts = [problem.angles] if warm else np.split(problem.angles, len(problem.angles))
    states = [
        kernels.static_states(part, np.zeros_like(part), problem.packed, path, load)
        for part in parts
    ]
    q, status, evaluations = (np.concatenate([state[i] for state in states]) for i in (0, 4, 6))
    return Solved(q, status == kernels.CONVERGED, int(evaluations.sum()))


_TOLERANCES = (1e-2, 1e-4, 1e-8, 1e-12)
OWN = "compiled energy Newton"

SOLVERS: dict[str, tuple[Callable[[StaticProblem, float], Solved], tuple[float, ...]]] = {
    OWN: (_compiled, (kernels.RESIDUAL_AIM,)),
    f"{OWN}, cold start": (partial(_compiled, warm=False), (kernels.RESIDUAL_AIM,)),
    "scipy hybr": (partial(_scipy, method="hybr"), _TOLERANCES),
    "scipy hybr, warm start": (partial(_scipy, method="hybr", warm=True), _TOLERANCES),
    "scipy lm": (partial(_scipy, method="lm"), _TOLERANCES),
    "scipy trust-exact on the energy": (partial(_scipy, method="trust-exact"), _TOLERANCES),
    "scipy least squares": (partial(_scipy, method="least_squares"), _TOLERANCES),
}
"""Solvers by name, with the tolerances at which each is measured."""


@dataclass(frozen=True)
class StaticReference:
    """Stiffness (m, 5, 5) and ball loads (m, N_b) on which two families of solvers agree.

    `known` (m,) marks the angles with a single equilibrium that was proven.
    """

    stiffness: Array
    load: Array
    known: NDArray[np.bool_]
    reference: Reference


ROUNDING_SHARE = 1e-14
"""Share of the greatest load of a ball below which a load is rounding."""


def static_reference(problem: StaticProblem) -> StaticReference:
    """Compute minima of the energy in extended precision, and roots of the forces in double.

    Angles with a least stiffness of zero have no unique answer. If only rounding loads a contact,
    its stiffness is rounding too, at any precision. This matters most for rollers, whose stiffness
    grows as the ninth root of their compression.
    """
    exact = refine(problem, _compiled(problem, 0.0).q)
    other = _scipy(problem, 1e-12, "hybr")
    # MINPACK also reports success where forces do not balance
    other = other._replace(solved=other.solved & (residuals(problem, other.q) <= STRICT))
    missed = int((exact.solved & ~other.solved).sum())
    if missed:
        near = _scipy(problem, 1e-12, "hybr", False, 1.01 * exact.q.astype(float))  # 1 % beside
        q = np.where(other.solved[:, None], other.q, near.q)
        other = Solved(q, other.solved | near.solved, 0)
    state = contacts(problem, exact.q)
    active = np.ix_(np.arange(len(exact.q)), problem.active, problem.active)
    least = np.linalg.eigvalsh(state.stiffness.astype(float)[active])[:, 0]
    greatest = np.abs(state.stiffness.astype(float)[active]).max(axis=(1, 2))
    faint = ROUNDING_SHARE * state.load.max(axis=1, keepdims=True)
    grazed = ((state.load > 0.0) & (state.load < faint)).any(axis=1)
    unique = exact.solved & (least > 1e-10 * greatest)
    known = unique & ~grazed
    stiffness, load = state.stiffness.astype(float), state.load.astype(float)
    both = known & other.solved
    agreement = (
        static_errors(problem, other.q[both], stiffness[both], load[both], both)
        if both.any()
        else dict.fromkeys(STATIC_ERRORS, math.nan)
    )
    note = f"{int(unique.sum())} of {len(known)} cage angles have one equilibrium"
    if grazing := int((unique & grazed).sum()):
        note += f"; {grazing} of them left out, where a ball or roller touches by rounding alone"
    if missed:
        note += f"; at {missed} MINPACK finds one only if it starts within 1 % of it"
    reference = Reference(
        ("energy Newton, refined in 80-bit numbers", "MINPACK hybr on the forces"),
        agreement,
        bool(known.any()) and agreement["stiffness"] < 1e-6,
        note,
    )
    return StaticReference(stiffness, load, known, reference)


def static_errors(
    problem: StaticProblem, q: Array, stiffness: Array, load: Array, rows: Any
) -> dict[str, float]:
    """Return the errors of stiffness and loads at q (m, 5), by the names of STATIC_ERRORS."""
    state = contacts(problem, q, rows)
    size = np.abs(stiffness).max(axis=0)
    diagonal = np.diagonal(size)
    neighbors = np.sqrt(diagonal[:, None] * diagonal)
    size = np.where(size > 1e-6 * neighbors, size, neighbors)
    size = np.where(size > 0.0, size, 1.0)
    return {
        "stiffness": float((np.abs(state.stiffness - stiffness) / size).max()),
        "load": float(np.abs(state.load - load).max() / load.max()),
    }


def statics_experiment(
    scene: Scene, *, n_angles: int = 121, watch: Watch = NOT_WATCHED
) -> Experiment:
    """Measure error and cost of solvers of the static equilibrium over a period of cage angles.

    Parameters
    ----------
    scene
        scene to solve.
    n_angles
        equally spaced cage angles in a ball spacing.
    watch
        progress, intermediate results, and cancelling.

    Raises
    ------
    ValueError
        for a scene without a static state.
    """
    report = watch.within(0.0, 0.1)
    report(0.0)
    problems = {
        "": static_problem(scene, default_cage_angles(scene, n_angles)),
        **hard_cases(scene),
    }
    # a reference for each problem, then all solvers at all tolerances, and on the hard cases once
    truths = {}
    for k, (case, problem) in enumerate(problems.items()):
        report(k / len(problems))
        truths[case] = static_reference(problem)
    if not truths[""].known.any():
        raise checks.refuse("scene", equilibrium(scene, [0.0]).reason(0), "one with a static state")
    for name in SOLVERS:
        if SOLVERS[name][1] == (kernels.RESIDUAL_AIM,):
            SOLVERS[name][0](problems[""], 0.0)  # compiles now, not while time is measured
    tasks = [("", name, tolerance) for name in SOLVERS for tolerance in SOLVERS[name][1]]
    tasks += [
        (case, name, SOLVERS[name][1][-1 if len(SOLVERS[name][1]) == 1 else -2])
        for case in problems
        if case
        for name in SOLVERS
    ]
    experiment = Experiment(
        "statics",
        STATIC_ERRORS,
        "evaluations of all contacts per equilibrium",
        {case: truth.reference for case, truth in truths.items()},
        (),
        STATICS_LEFT_OUT,
    )
    return measure_in_turn(
        experiment,
        tasks,
        lambda task: f"{task[1]}, {scientific(task[2])}",
        lambda task: replace(
            _measure(problems[task[0]], truths[task[0]], *task[1:]), against=task[0]
        ),
        watch,
        begin=0.1,
    )


HARD_CASES = ("all balls just touching", "a ball at an edge", "clearance closed")
"""Names of the problems at which solvers fail."""


def hard_cases(scene: Scene) -> dict[str, StaticProblem]:
    """Return problems close to `scene` at which solvers fail, by name."""
    angles = default_cage_angles(scene, 13)
    loads = {name: 1e-3 * getattr(scene.load, name) for name in ("fx", "fy", "fz", "mx", "my")}
    edges = path_kinks(scene, float(angles[0]), float(angles[-1]))[:12]
    cases = {HARD_CASES[0]: (scene.replace(**loads), angles)}
    if edges.size:
        cases[HARD_CASES[1]] = (scene, np.unique([edges - 1e-9, edges, edges + 1e-9]))
    if scene.bearing.radial_clearance > 0.0:
        cases[HARD_CASES[2]] = (scene.replace(radial_clearance=0.0), angles)
    return {name: static_problem(*case) for name, case in cases.items()}


def _measure(problem: StaticProblem, truth: StaticReference, name: str, tolerance: float) -> Point:
    """Measure one solver at one tolerance; times and evaluations are for one equilibrium."""
    with np.errstate(all="ignore"):
        answer, seconds = least_time(lambda: SOLVERS[name][0](problem, tolerance))
    known = truth.known
    missing = int((known & ~answer.solved).sum())
    errors: dict[str, float] = {}
    status = RIGHT
    if missing:
        status = f"failed: no answer at {missing} of {int(known.sum())} cage angles"
    elif known.any():
        errors = static_errors(
            problem, answer.q[known].astype(float), truth.stiffness[known], truth.load[known], known
        )
        if tolerance <= STRICT and not errors["stiffness"] <= WRONG_STIFFNESS:
            status = "failed: it calls a wrong answer solved"
    n = len(problem.angles)
    return Point(
        name, f"tolerance {scientific(tolerance)}", tolerance, errors, seconds / n,
        answer.evaluations / n, status, in_use=name == OWN,
    )  # fmt: skip
