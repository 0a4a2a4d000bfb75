"""Modes of the rotor on its support, linearised at the static state (Eqs. 24-29)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.common import Array, ResultTable, _checks as checks, shown_as_table, table_of
from bearingcore.common._arrays import least_and_greatest
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics._damping import contact_damping
from bearingcore.model.scene import DOF_NAMES, PackedScene, Scene
from bearingcore.model.scene._defect import floor_bytes
from bearingcore.model.scene._packing import contacts, length_units, pack
from bearingcore.model.statics import (
    ANGLES_A_PERIOD,
    ROUNDS,
    STIFFNESS_TERMS,
    Equilibrium,
    equilibrium,
)
from bearingcore.model.statics._equilibrium import equilibrium_of
from bearingcore.model.statics._positions import equilibrium_over_all, extremes, positions

MIXED = 0.25
"""Greatest share of another mode that dampers may add to a mode in `_approximate_damping`, which is
then right within 1e-4."""


@shown_as_table
@dataclass(frozen=True)
class Modes:
    """Natural frequencies, damping and shapes of m modes at n cage angles.

    Each column is one mode: at every angle the one whose shape is most like that of this mode at
    mean stiffness (modal assurance criterion).

    Attributes
    ----------
    scene, dofs, cage_angles
        the scene, its directions, and the cage angles (n,) [rad].
    frequency : (n, m) [Hz]
        |λ|/2π with the damping matrix (Eq. 29).
    damping_ratio : (n, m)
        −Re λ/|λ|; a negative value means a growing motion.
    undamped_frequency : (n, m) [Hz]
        of the mass and stiffness matrices alone.
    shape : (n, m, 2 len(dofs))
        undamped mode shapes of unit modal mass, inner ring first; signs are continuous over the
        angles.
    label : (m,)
        direction with the largest motion, numbered by rising frequency: "x1", "y1", "x2", "y2".
    state
        the static states that were linearised.

    Rows are NaN if the static state has no answer.
    """

    scene: Scene
    dofs: tuple[str, ...]
    cage_angles: Array
    frequency: Array
    damping_ratio: Array
    undamped_frequency: Array
    shape: Array
    label: tuple[str, ...]
    state: Equilibrium = field(repr=False, compare=False)

    def reason(self, i: int) -> str:
        """Return the status of the static state at cage angle i in words."""
        return self.state.reason(i)

    def table(self) -> ResultTable:
        """A row for each cage angle: frequency and damping ratio of each mode, static status."""
        labels = list(enumerate(self.label))
        return table_of(
            ("cage_angle", "rad", self.cage_angles, "angle of the cage"),
            *(
                (label, "Hz", self.frequency[:, i], f"natural frequency of mode {label}")
                for i, label in labels
            ),
            *((f"{label}_damping_ratio", "1", self.damping_ratio[:, i]) for i, label in labels),
            ("status", "", [self.reason(i) for i in range(len(self.cage_angles))]),
        )

    def bands(self) -> dict[str, tuple[float, float]]:
        """Return the least and greatest frequency [Hz] of each mode at the cage angles, by label.

        Both are NaN if no angle has an answer. `frequency_bands` also covers positions between the
        angles and other turns of the shaft.
        """
        ends = zip(*(end.tolist() for end in least_and_greatest(self.frequency, 0)), strict=True)
        return dict(zip(self.label, ends, strict=True))


def modes(scene: Scene, cage_angles: ArrayLike | None = None) -> Modes:
    """Compute natural frequencies, damping and shapes of `scene` at each cage angle (Eqs. 24-29).

    Parameters
    ----------
    scene
        the scene; support and inertia must be known along its active directions.
    cage_angles : (n,)
        [rad]; None takes one period, as `equilibrium` does.

    Raises
    ------
    ValueError
        if the support lacks a number; the error names it.
    """
    return modes_at(equilibrium(scene, cage_angles))


def frequency_bands(scene: Scene, *, coarse: bool = False) -> dict[str, tuple[float, float]]:
    """Compute the least and greatest natural frequency [Hz] of each mode over all positions.

    The positions are all cage angles and, if a defect turns with the shaft, all shaft angles at
    each: see `bearingcore.model.statics._positions`. The search refines the surroundings of each
    extreme sample. It leaves damping out if it is coarse or a defect turns with the shaft. The
    returned frequencies are always damped, as in `Modes`.

    Parameters
    ----------
    scene
        scene, as in `modes`.
    coarse
        True for a third of the cage angles and half the refinements.

    Returns
    -------
    {label: (least, greatest)} [Hz]
        NaN for both if no angle has an answer.

    Raises
    ------
    ValueError
        if the support lacks a number; the error names it.
    """
    checks.instance("scene", scene, Scene)
    n = ANGLES_A_PERIOD if scene.defect_turns else 3 * ANGLES_A_PERIOD - 2
    n, rounds = ((n - 1) // 3 + 1, 2) if coarse else (n, ROUNDS)
    packed = pack(scene)
    state = equilibrium_over_all(packed, n)
    if not state.converged.any():
        return modes_at(state).bands()
    search = BandSearch(scene, stiffness_terms(state), state.shares)
    undamped = scene.defect_turns or coarse  # for many samples, or for a quick answer

    def frequencies(known: Equilibrium) -> Array:
        """(m, k) [Hz] at the angles of a static state."""
        if undamped:
            return search.frequencies(stiffness_terms(known))
        # the damper of a ball that touches makes frequencies jump; undamped ones do not show this
        return modes_at(known, search.template, nearly=True).frequency.T

    def closer(cage_angles: Array, shaft_angles: Array) -> Array:
        return frequencies(equilibrium_of(packed, cage_angles, shaft_angles))

    ends = extremes(positions(scene, n), frequencies(state), closer, rounds=rounds)
    end_states = equilibrium_of(packed, ends.cage_angles.ravel(), ends.shaft_angles.ravel())
    least, greatest = map(np.diagonal, np.split(modes_at(end_states, search.template).frequency, 2))
    pairs = zip(least.tolist(), greatest.tolist(), strict=True)
    return dict(zip(search.labels, pairs, strict=True))


class BandSearch:
    """Undamped frequencies of many positions, in the order of the modes at mean stiffness.

    They are `modes_at(...).undamped_frequency`, computed for many matrices at a time, without the
    general eigenvalue problem that damping needs. A damping ratio ζ changes a frequency |λ|/2π by
    about ζ² of it. If no position has a stiffness, `labels` are those of the support alone.

    Parameters
    ----------
    scene
        a scene; its active directions, support and inertia are used, its defect is not.
    terms : (15, n)
        stiffness terms [N/m, N/rad, N·m/rad] in the order of `STIFFNESS_TERMS`; NaN where the
        static state has no answer.
    weights : (n,)
        weights of the positions in the mean.

    Raises
    ------
    ValueError
        if the support lacks a number; the error names it.
    """

    def __init__(self, scene: Scene, terms: Array, weights: Array) -> None:
        dofs = scene.active_dofs
        names = [f"k_{a}{b}" for i, a in enumerate(dofs) for b in dofs[i:]]
        self._rows = [STIFFNESS_TERMS.index(name) for name in names]
        self._support, mass = scene.support.stiffness(dofs), scene.support.inertias(dofs)
        chosen = terms[self._rows]
        known = np.isfinite(chosen).all(axis=0) * weights
        mean = np.zeros((len(dofs), len(dofs)))
        row, column = np.triu_indices(len(dofs))
        share = max(float(known.sum()), 1e-300)
        mean[row, column] = mean[column, row] = np.nan_to_num(chosen) @ known / share
        self.template = _undamped(two_body_matrix(mean, self._support), mass)[1]
        self.labels = _labels(self.template, mass, dofs)

    def frequencies(self, terms: Array) -> Array:
        """Return frequencies (m, n) [Hz] for stiffness terms (15, n); NaN if a term is unknown."""
        chosen = terms[self._rows]
        known = np.asarray(np.isfinite(chosen).all(axis=0))
        result = np.full((len(self.template), known.size), math.nan)
        result[:, known] = _frequencies_like(self.template, chosen[:, known], self._support)
        return result


def stiffness_terms(state: Equilibrium) -> Array:
    """Return the stiffness terms (15, n) of a state, in the order of `STIFFNESS_TERMS`."""
    return np.stack([state.term(name) for name in STIFFNESS_TERMS])


def modes_at(state: Equilibrium, template: Array | None = None, *, nearly: bool = False) -> Modes:
    """Return the modes at static states that are already known.

    Modes are ordered by their likeness to the shapes of a template (m, m); None takes the shapes at
    mean stiffness. `nearly`: damping by `_approximate_damping`, which is quicker.
    """
    scene, dofs = state.scene, state.dofs
    nd = len(dofs)
    index = [DOF_NAMES.index(name) for name in dofs]
    mass, support = scene.support.inertias(dofs), scene.support.stiffness(dofs)
    unloaded = two_body_matrix(np.zeros((nd, nd)), support)
    if state.cost:
        label = _labels(_undamped(unloaded, mass)[1], mass, dofs)
        rows = np.broadcast_to(np.float64(math.nan), (len(state.cage_angles), 2 * nd))
        shapes = np.broadcast_to(np.float64(math.nan), (*rows.shape, 2 * nd))
        return Modes(scene, dofs, state.cage_angles, rows, rows, rows, shapes, label, state)
    K_b = state.stiffness[:, index][:, :, index]
    C_b = contact_damping(scene) * loaded_directions(state)[:, index][:, :, index]
    K = two_body_matrix(K_b, support)
    C = two_body_matrix(C_b, scene.support.damping(dofs))
    # With a free direction the stiffness is known, but not the place at which the ring rests.
    known = state.converged & np.isfinite(K).all(axis=(1, 2))
    n, m = len(K), 2 * nd
    undamped, frequency, ratio = (np.full((n, m), np.nan) for _ in range(3))
    shape = np.full((n, m, m), np.nan)
    if template is None:
        mean = K[known].mean(axis=0) if known.any() else unloaded
        template = _undamped(mean, mass)[1]
    if known.any():
        undamped[known], shape[known] = _follow(*_undamped(K[known], mass), template, mass)
        damped = _approximate_damping if nearly else _exact_damping
        frequency[known], ratio[known] = damped(K[known], C[known], mass, shape[known])
    label = _labels(template, mass, dofs)
    return Modes(scene, dofs, state.cage_angles, frequency, ratio, undamped, shape, label, state)


def _frequencies_like(template: Array, terms: Array, support: Array) -> Array:
    """Return undamped frequencies (m, n) [Hz] of modes in the order of a template (m, m).

    `terms` (nd (nd + 1)/2, n) are the upper triangles of the bearing's stiffness, all known.
    """
    nd, n = len(support), terms.shape[1]
    inner, outer = template[:, :nd], template[:, nd:]
    squared, order = np.empty((n, 2 * nd)), np.empty((n, 2 * nd), dtype=np.int64)
    likeness = np.empty((n, 2 * nd, 2 * nd))
    kernels.modes_like(
        np.ascontiguousarray(terms),
        np.ascontiguousarray(inner - outer),
        (outer * support) @ outer.T,
        squared,
        order,
        likeness,
    )
    for k in np.flatnonzero(order[:, 0] == kernels.DOUBTFUL):
        order[k] = _assignment(likeness[k])
    frequency = np.sqrt(np.maximum(squared, 0.0)) / (2.0 * math.pi)
    return np.asarray(np.take_along_axis(frequency, order, axis=1).T)


def highest_natural_frequency(scene: Scene) -> float:
    """Return the greatest undamped natural frequency [Hz] of a scene over all its positions.

    It determines the step rate of a motion. It is NaN if no angle has a static state.
    """
    return highest_frequency_of(pack(scene))


@lru_cache_by_bytes(
    32_000_000,
    lambda _, packed: floor_bytes(packed.scene.defects),
    lambda packed: (packed.scene, packed.dofs),
)
def highest_frequency_of(packed: PackedScene) -> float:
    """Return the `highest_natural_frequency` of a packed scene."""
    scene, dofs = packed.scene, packed.dofs
    index = [DOF_NAMES.index(name) for name in dofs]
    K_b = equilibrium_over_all(packed, 31).stiffness[:, index][:, :, index]
    known = np.isfinite(K_b).all(axis=(1, 2))
    if not known.any():
        return math.nan
    mass = scene.support.inertias(dofs)
    frequency, _ = _undamped(two_body_matrix(K_b[known], scene.support.stiffness(dofs)), mass)
    return float(frequency.max())


def two_body_matrix(bearing: Array, support: Array) -> Array:
    """Assemble [B, −B; −B, B + diag(support)] (Eq. 25) of bearing matrices (..., nd, nd)."""
    return np.block([[bearing, -bearing], [-bearing, bearing + np.diag(support)]])


def loaded_directions(state: Equilibrium) -> Array:
    """Return Σ e e' (n, 5, 5) of the loaded balls, with the direction e of a contact (Eq. 27)."""
    alpha, phi = np.nan_to_num(state.contact_angle), state.ball_angle
    e = contacts(state.scene.bearing).gradients(phi, np.cos(alpha), np.sin(alpha))
    e *= state.carries[..., None] * length_units(state.scene)
    return np.swapaxes(e, 1, 2) @ e


def _assignment(likeness: Array) -> NDArray[np.int64]:
    """Assign a column to each row (m,) so that the sum of likeness (m, columns) is greatest."""
    from scipy.optimize import linear_sum_assignment  # imported late: slow to import

    return np.asarray(linear_sum_assignment(-likeness)[1])


def _matched(likeness: Array) -> NDArray[np.int64]:
    """Return the column (n, m) for each row of likeness (n, m, columns), none of them twice.

    It is the column of the greatest likeness in each row. If this is the same for two rows, the
    assignment with the greatest sum decides.
    """
    best = likeness.argmax(axis=2)
    clash = (np.diff(np.sort(best, axis=1), axis=1) == 0).any(axis=1)
    for k in np.flatnonzero(clash):
        best[k] = _assignment(likeness[k])
    return best


def _follow(frequency: Array, shape: Array, template: Array, mass: Array) -> tuple[Array, Array]:
    """Reorder modes so that each column is the mode most like the same column of a template.

    frequency is (n, m), shape (n, m, m) and template (m, m), all of unit modal mass, so that the
    modal assurance criterion is a squared product. A comparison from one angle to the next would
    depend on the spacing of the angles: where two frequencies meet and part again, small steps stay
    on a branch while its shape changes into that of the other mode.
    """
    product = np.einsum("im,m,njm->nij", template, mass, shape)
    order = _matched(product**2)
    sign = np.where(np.take_along_axis(product, order[:, :, None], axis=2) < 0.0, -1.0, 1.0)
    return (
        np.take_along_axis(frequency, order, axis=1),
        np.take_along_axis(shape, order[:, :, None], axis=1) * sign,
    )


def _undamped(K: Array, mass: Array) -> tuple[Array, Array]:
    """Return rising natural frequencies (..., m) [Hz], and shapes (..., m, m) of unit modal mass.

    They solve K t = ω² M t (Eq. 24 without damping) for stiffness matrices K (..., m, m).
    """
    root = np.sqrt(mass)
    values, vectors = np.linalg.eigh(K / (root[:, None] * root))
    frequency = np.sqrt(np.maximum(values, 0.0)) / (2.0 * math.pi)
    return frequency, np.swapaxes(vectors, -1, -2) / root


def _exact_damping(K: Array, C: Array, mass: Array, shape: Array) -> tuple[Array, Array]:
    """Return |λ|/2π [Hz] and −Re λ/|λ| of each damped mode, in the order of the undamped modes.

    λ are eigenvalues of the state matrix [0, 1; −M⁻¹K, −M⁻¹C], which is Eq. 28 with correct signs.
    """
    n, m = shape.shape[:2]
    A = np.zeros((n, 2 * m, 2 * m))
    A[:, :m, m:] = np.eye(m)
    A[:, m:, :m] = -K / mass[:, None]
    A[:, m:, m:] = -C / mass[:, None]
    values, vectors = np.linalg.eig(A)
    motion = vectors[:, :m, :] * np.sqrt(mass)[:, None]
    motion = motion / np.maximum(np.linalg.norm(motion, axis=1, keepdims=True), 1e-300)
    likeness = np.abs((shape * np.sqrt(mass)) @ motion) ** 2
    # the two modes of a conjugate pair have the same shape: prefer a positive imaginary part
    picked = _matched(likeness - 2.0 * (values.imag < 0.0)[:, None, :])
    chosen = np.take_along_axis(values, picked, axis=1)
    size = np.abs(chosen)
    return size / (2.0 * math.pi), -chosen.real / np.maximum(size, 1e-300)


def _approximate_damping(K: Array, C: Array, mass: Array, shape: Array) -> tuple[Array, Array]:
    """Return `_exact_damping` to the third order in the coupling by dampers, without `eig`.

    In modal coordinates, with D_j = λ² + c_jj λ + ω_j² of the other modes j, k ≠ i:
    λ² + c_ii λ + ω_i² = λ² Σ_j c_ij²/D_j − λ³ Σ_jk c_ij c_jk c_ki/(D_j D_k), k ≠ j. It is solved by
    iteration. If modes mix by more than MIXED, or one hardly swings, `_exact_damping` is used.
    """
    c = shape @ C @ np.swapaxes(shape, 1, 2)
    damping = np.diagonal(c, axis1=1, axis2=2)
    squared = np.einsum("nij,nij->ni", shape @ K, shape)
    between = np.where(np.eye(len(mass), dtype=bool), 0.0, c)
    rest = squared
    for _ in range(3):
        rate = -0.5 * damping + 1j * np.sqrt(rest - 0.25 * damping**2 + 0j)
        rates = rate[:, :, None]
        D = rates**2 + damping[:, None] * rates + squared[:, None]
        part = between / np.where(between == 0.0, 1.0, D)
        pull = (part * between).sum(axis=2) - rate * ((part @ between) * part).sum(axis=2)
        rest = squared - rate**2 * pull
    size = np.abs(rate)
    frequency, ratio = size / (2.0 * math.pi), -rate.real / np.maximum(size, 1e-300)
    near = (np.abs(rates * part) < MIXED).all(axis=(1, 2)) & (damping**2 < squared).all(axis=1)
    if not near.all():
        frequency[~near], ratio[~near] = _exact_damping(K[~near], C[~near], mass, shape[~near])
    return frequency, ratio


def _labels(template: Array, mass: Array, dofs: tuple[str, ...]) -> tuple[str, ...]:
    """Return direction and number of each mode; each direction has two modes.

    `template` (m, m) are shapes in the order of rising frequency.
    """
    nd, m = len(dofs), 2 * len(dofs)
    energy = template**2 * mass  # shares of the kinetic energy
    by_direction = energy[:, :nd] + energy[:, nd:]
    direction = _assignment(np.repeat(by_direction, 2, axis=1)) // 2
    label = [""] * m
    for d in range(nd):
        for number, i in enumerate(np.flatnonzero(direction == d), start=1):
            label[i] = f"{dofs[d]}{number}"
    return tuple(label)
