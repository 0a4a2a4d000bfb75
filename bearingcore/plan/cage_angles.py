"""Where to put cage angles so that straight lines between them show the true curves.

Static curves are smooth between events: a ball meeting an edge or a floor, where curves have
corners, and a ball touching or letting go, where its stiffness begins like the square root of the
angle. With a node at each event, and finer nodes only where a curve bends, a given error takes
several times fewer nodes than equal spacing, which never resolves a root.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.dynamics.modes import two_body_matrix
from bearingcore.scene.packing import contacts, typical_compression
from bearingcore.scene.scene import DOF_NAMES, Scene
from bearingcore.statics.equilibrium import Equilibrium, default_cage_angles, equilibrium
from bearingcore.statics.passes import drops_at, path_kinks

Array = NDArray[np.float64]

CURVES = ("load", "stiffness", "modes")
"""What is to be drawn over the cage angle: ball loads with displacements, the 15 stiffness terms,
undamped natural frequencies."""

FIRST_NODES = 20
"""Intervals in a ball spacing to begin with, beside those that events make."""

MOST_NODES = 4000
LEAST_INTERVAL = 1e-7
"""Intervals below this part of a ball spacing are not divided any more."""

_TERMS = np.triu_indices(5)

ROOT_SPLIT = 1.0 / 16.0
"""Where an interval is divided that begins at a touch: for a curve like a square root, nodes at
fourth powers are the best there are, and a half to the fourth is a sixteenth."""

TOUCH_FOUND, TOUCH_SEEN = 1e-11, 1e-9
"""A gap below the first part of the load's compression counts as the touch itself when one is
looked for, and below the second as no sign of another."""

OFF_MIDDLE = 0.4
"""Where other intervals are divided. In the very middle an S-shaped curve crosses its own line."""

GRAZE = 0.25
"""A gap whose extremum comes nearer to zero than this part (squared) of what it varies by nearby is
looked at once more."""

LEAST_SWING = 0.01
"""Errors are taken over a curve's swing, but not over less than this part of its size."""


@dataclass(frozen=True)
class CageAngles:
    """Nodes for a scene's curves.

    Attributes
    ----------
    angles : (n,) [rad]
        rising, over one period of the scene's curves.
    kinks, touches : (k,) [rad]
        those of them at which a ball meets an edge or floor, and at which one touches or lets go.
    jumps : (k,) [rad]
        where a curve jumps, between two nodes too near to each other to be told apart. Stiffness
        does as a loaded ball's groove centres pass each other, and where an answer begins or ends.
    predicted_error
        greatest error of a straight line between nodes, over the curve's swing (see LEAST_SWING).
    solved
        cage angles that were solved to find them.
    met
        True where the predicted error is within the budget.
    """

    angles: Array
    kinks: Array
    touches: Array
    jumps: Array
    predicted_error: float
    solved: int
    met: bool


def curves_of(state: Equilibrium, curves: str) -> Array:
    """(n, m) the curves to be drawn, in their units; NaN where there is no answer."""
    if curves == "load":
        return np.hstack([state.ball_load, state.displacement])
    if curves == "stiffness":
        return state.stiffness[:, *_TERMS]
    checks.choice("curves", curves, CURVES)
    scene, dofs = state.scene, state.dofs
    index = [DOF_NAMES.index(name) for name in dofs]
    mass = np.concatenate([scene.support.inertia(body, dofs) for body in ("inner", "outer")])
    K = two_body_matrix(state.stiffness[:, index][:, :, index], scene.support.stiffness(dofs))
    frequency = np.full((len(K), mass.size), math.nan)
    known = np.isfinite(K).all(axis=(1, 2))
    values = np.linalg.eigvalsh(K[known] / np.sqrt(mass[:, None] * mass))
    frequency[known] = np.sqrt(np.maximum(values, 0.0)) / (2.0 * math.pi)
    return frequency


def swings(values: Array) -> Array:
    """(m,) what errors of curves (n, m) are taken over: swings, or LEAST_SWING of the size.

    A term that symmetry makes zero is measured by the size of its neighbours: 1 where nothing is.
    """
    known = values[np.isfinite(values).all(axis=1)]
    if not known.size:
        return np.ones(values.shape[1])
    size = np.abs(known).max(axis=0)
    swing = np.maximum(np.ptp(known, axis=0), LEAST_SWING * size)
    if values.shape[1] == 15:  # stiffness: a term counts beside the diagonal ones of its directions
        rows, columns = _TERMS
        diagonal = size[rows == columns]
        swing = np.maximum(swing, 1e-6 * np.sqrt(diagonal[rows] * diagonal[columns]))
    return np.where(swing > 0.0, swing, 1.0)


TOUCH, PASSING = 0, 1
"""What is watched of each ball: its compression, and whether its groove centres pass each other."""


class _Nodes:
    """Solved cage angles in rising order."""

    def __init__(
        self, scene: Scene, curves: str, dofs: tuple[str, ...], angles: Array, kinks: Array
    ) -> None:
        self.scene, self.curves, self.dofs, self.kinks = scene, curves, dofs, kinks
        self.solved = 0
        self.jumps: list[Array] = []
        self.passings: list[Array] = []
        self.angles, self.values, self.gaps = self.solve(angles)
        self.touch = np.zeros(angles.size, dtype=bool)
        load = float(np.linalg.norm(scene.load.vector[:3])) or 1.0
        self.compression = typical_compression(scene.bearing, load)

    def solve(self, angles: Array) -> tuple[Array, Array, Array]:
        """Angles, curves (n, m) and `gaps_at` (n, 2, N_b) [m]."""
        state, gaps = self.gaps_at(angles)
        values = curves_of(state, self.curves)
        values[~state.converged] = math.nan
        return angles, values, gaps

    def gaps_at(self, angles: Array) -> tuple[Equilibrium, Array]:
        """The static states, and what changes sign at events (n, 2, N_b) [m].

        That is the compression of each ball, negative for a gap, and the part of the distance of
        its groove centres along the unloaded line of contact.
        """
        state = equilibrium(self.scene, angles, self.dofs)
        self.solved += angles.size
        one = contacts(self.scene.bearing)
        ca, sa, A0 = one.line_r, one.line_z, one.distance
        phi = state.ball_angle
        c, s = np.cos(phi), np.sin(phi)
        x, y, z, rx, ry = (state.state[:, i, None] for i in range(5))
        radial = (x + one.arm * ry) * c + (y - one.arm * rx) * s - one.clearance
        axial = z + one.reach * (rx * s - ry * c) + one.offset
        drop = drops_at(self.scene, angles)
        along = A0 + radial * ca + axial * sa - drop
        distance = np.hypot(np.maximum(along, 0.0), axial * ca - radial * sa)
        gaps: Array = np.stack([distance - A0, along], axis=1)
        gaps[~state.converged] = math.nan
        return state, gaps

    def insert(self, angles: Array, touch: bool) -> None:
        """Solve more angles and put them where they belong."""
        self.put(*self.solve(np.sort(angles)), touch)

    def put(self, angles: Array, values: Array, gaps: Array, touch: bool) -> None:
        """Put solved angles where they belong."""
        together = np.concatenate([self.angles, angles])
        order = np.argsort(together, kind="stable")
        self.angles = together[order]
        self.values = np.concatenate([self.values, values])[order]
        self.gaps = np.concatenate([self.gaps, gaps])[order]
        self.touch = np.concatenate([self.touch, np.full(angles.size, touch)])[order]

    def look_for_grazes(self) -> None:
        """Put a node where a ball may touch, or let go, for less than an interval.

        There its gap has an extremum near zero; the parabola through three nodes tells where.
        """
        a, g = self.angles, self.gaps[:, 0]
        left, right = np.diff(a)[:-1, None], np.diff(a)[1:, None]
        with np.errstate(invalid="ignore", divide="ignore"):
            before, after = np.diff(g, axis=0)[:-1] / left, np.diff(g, axis=0)[1:] / right
            bend = (after - before) / (left + right)
            slope = (before * right + after * left) / (left + right)
            away = -0.5 * slope / bend  # of the extremum from the middle node
            top = g[1:-1] - 0.25 * slope**2 / bend
            inside = (away > -left) & (away < right) & (before * after < 0.0)
            # a corner in between makes the parabola err by as much as the gap itself varies
            near = top * g[1:-1] < GRAZE * np.ptp(np.stack([g[:-2], g[1:-1], g[2:]]), axis=0) ** 2
            same = (g[:-2] * g[1:-1] > 0.0) & (g[2:] * g[1:-1] > 0.0)
            row, ball = np.nonzero(inside & near & same)
        found = np.unique(a[row + 1] + away[row, ball])
        if found.size:
            self.insert(np.setdiff1d(found, a), touch=False)

    def find_touches(self) -> bool:
        """Find where a ball touches or lets go between two nodes and put nodes there."""
        found = self._sign_changes(TOUCH, np.True_)
        if found.size:
            self.insert(found, touch=True)
        return bool(found.size)

    def find_passings(self, least: float) -> bool:
        """Put two nodes, `least` apart, where a loaded ball's groove centres pass each other.

        Stiffness jumps there, and too little for a test point beside it to notice.
        """
        wide = np.diff(self.angles)[:, None] > 1.01 * least
        loaded = np.maximum(self.gaps[:-1, TOUCH], self.gaps[1:, TOUCH]) > 0.0
        found = self._sign_changes(PASSING, wide & loaded)
        if found.size:
            self.passings.append(found)
            both = np.concatenate([found - 0.5 * least, found + 0.5 * least])
            inside = (both > self.angles[0]) & (both < self.angles[-1])
            self.insert(np.setdiff1d(both[inside], self.angles), touch=False)
        return bool(found.size)

    def _sign_changes(self, kind: int, among: NDArray[np.bool_] | np.bool_) -> Array:
        """Cage angles, rising, at which TOUCH or PASSING changes sign.

        `among` tells in which intervals and of which balls (n − 1, N_b) to look for it.
        """
        seen = TOUCH_SEEN * self.compression
        with np.errstate(invalid="ignore"):
            before, after = self.gaps[:-1, kind], self.gaps[1:, kind]
            change = (before * after < 0.0) & (np.abs(before) > seen) & (np.abs(after) > seen)
        row, ball = np.nonzero(change & among)
        if not row.size:
            return np.zeros(0)
        left, right = self.angles[row].copy(), self.angles[row + 1].copy()
        g_left, g_right = before[row, ball].copy(), after[row, ball].copy()
        best = np.where(np.abs(g_left) < np.abs(g_right), left, right)
        side = np.zeros(best.size)
        for _ in range(12):
            # false position; an end that stays a second time counts half (the Illinois way)
            best = right - g_right * (right - left) / (g_right - g_left)
            order = np.argsort(best, kind="stable")
            gaps = np.empty(best.size)
            gaps[order] = self.gaps_at(best[order])[1][np.arange(best.size), kind, ball[order]]
            if not np.all(np.isfinite(gaps)) or np.all(
                np.abs(gaps) <= TOUCH_FOUND * self.compression
            ):
                break
            moved = gaps * g_left > 0.0
            again = np.where(moved, 1.0, -1.0) == side
            side = np.where(moved, 1.0, -1.0)
            g_right = np.where(moved, np.where(again, 0.5, 1.0) * g_right, gaps)
            g_left = np.where(moved, gaps, np.where(again, 0.5, 1.0) * g_left)
            left = np.where(moved, best, left)
            right = np.where(moved, right, best)
        return np.unique(best)

    def suspects(self, budget: float) -> NDArray[np.bool_]:
        """Intervals whose neighbours say that the curve bends more than a test point showed.

        A point near an inflection shows nothing. The error of a line by the curvature at either
        end, where that is no corner.
        """
        a = self.angles
        slope = np.diff(self.values, axis=0) / np.diff(a)[:, None]
        curvature = np.zeros_like(self.values)
        curvature[1:-1] = np.diff(slope, axis=0) / (a[2:] - a[:-2])[:, None]
        curvature[self.corner | self.touch] = 0.0
        size = np.nan_to_num(np.abs(curvature) / swings(self.values), nan=0.0).max(axis=1)
        bent: NDArray[np.bool_] = np.maximum(size[:-1], size[1:]) * np.diff(a) ** 2 / 4.0 > budget
        return bent

    @property
    def corner(self) -> NDArray[np.bool_]:
        """(n,) nodes at kinks of a path."""
        return np.isin(self.angles, self.kinks)

    def bend(self, budget: float, least: float) -> float:
        """Divide intervals until lines are good; returns the greatest error that is left."""
        everywhere = np.ones(self.angles.size - 1, dtype=bool)
        left_over = self._divide(everywhere, budget, least)
        return max(left_over, self._divide(self.suspects(budget), budget, least))

    def _divide(self, fresh: NDArray[np.bool_], budget: float, least: float) -> float:
        """`bend`, but only in the intervals that are fresh."""
        left_over = 0.0
        while fresh.any() and self.angles.size < MOST_NODES:
            interval = np.flatnonzero(fresh)
            left = self.touch[interval] & ~self.touch[interval + 1]
            right = self.touch[interval + 1] & ~self.touch[interval]
            # beside a touch a curve is a root and a smooth one: a test for each
            at = np.concatenate([interval, interval[left], interval[right]])
            part = np.full(at.size, OFF_MIDDLE)
            part[interval.size :] = ROOT_SPLIT
            part[interval.size + int(left.sum()) :] = 1.0 - ROOT_SPLIT
            order = np.lexsort((part, at))
            at, part = at[order], part[order]
            a, b = self.angles[at], self.angles[at + 1]
            angles, values, gaps = self.solve(a + part * (b - a))
            line = self.values[at] + part[:, None] * (self.values[at + 1] - self.values[at])
            scale = swings(np.concatenate([self.values, values]))
            with np.errstate(invalid="ignore"):
                error = np.nan_to_num(np.abs(values - line) / scale, nan=0.0).max(axis=1)
            known = np.isfinite(
                np.stack([self.values[at, 0], values[:, 0], self.values[at + 1, 0]])
            )
            border = known.any(axis=0) & ~known.all(axis=0)
            wide = b - a > least
            divide = (error > budget) & wide
            divide |= border & (b - a > 1e4 * least)
            self.jumps.append(angles[(error > budget) & ~wide])
            divide = np.isin(at, at[divide])  # an interval as a whole
            left_over = max(left_over, float(error[~divide & wide].max(initial=0.0)))
            # the new nodes' intervals, in the order of all nodes
            marks = np.zeros(self.angles.size + angles.size, dtype=bool)
            where = np.searchsorted(self.angles, angles) + np.arange(angles.size)
            marks[where[divide]] = True
            marks[where[divide] - 1] = True
            self.put(angles, values, gaps, touch=False)
            fresh = marks[:-1]
        if fresh.any():
            left_over = math.inf
        return left_over


def place(
    scene: Scene,
    curves: str = "stiffness",
    budget: float = 2e-3,
    dofs: tuple[str, ...] | None = None,
) -> CageAngles:
    """Cage angles between which straight lines miss the scene's curves by at most `budget`.

    Parameters
    ----------
    scene
        what is drawn.
    curves
        "load", "stiffness" or "modes".
    budget
        greatest error over the swing of each curve, or over 1 % of its size if it swings less.
    dofs
        free directions; None takes the scene's.

    Raises
    ------
    ValueError
        for unknown curves or a budget that is not positive.
    """
    checks.choice("curves", curves, CURVES)
    budget = checks.number("budget", budget, above=0.0)
    ends = default_cage_angles(scene, 2)
    first, last = float(ends[0]), float(ends[-1])
    spacing = scene.bearing.ball_spacing
    kinks = path_kinks(scene, first, last)
    start = np.linspace(first, last, math.ceil((last - first) / spacing * FIRST_NODES - 1e-9) + 1)
    # an equal node next to a kink would make a sliver of an interval
    near = np.abs(start[:, None] - kinks[None, :]).min(axis=1, initial=math.inf)
    keep = near > 1e-3 * spacing
    keep[[0, -1]] = near[[0, -1]] > 0.0
    angles = np.unique(np.concatenate([start[keep], kinks]))
    nodes = _Nodes(scene, curves, scene.active_dofs if dofs is None else dofs, angles, kinks)
    error = math.inf
    nodes.look_for_grazes()
    nodes.find_touches()
    least = LEAST_INTERVAL * spacing
    nodes.find_passings(least)
    for _ in range(4):
        nodes.jumps.clear()
        error = nodes.bend(AIM * budget, least)
        nodes.look_for_grazes()
        more = nodes.find_touches()
        if not nodes.find_passings(least) and not more:
            break
    return CageAngles(
        nodes.angles,
        kinks,
        nodes.angles[nodes.touch],
        np.unique(np.concatenate([*nodes.jumps, *nodes.passings, np.zeros(0)])),
        AFTER_SPLIT * error,
        nodes.solved,
        error <= AIM * budget,
    )


AIM = 0.5
"""Part of the budget that an interval's one test point may use up: it can miss the worst place."""

AFTER_SPLIT = 0.6
"""What dividing an interval leaves of the error found in it: a quarter for a smooth curve, 0.6 for
one that begins like a root."""
