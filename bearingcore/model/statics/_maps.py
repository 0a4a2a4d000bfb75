"""Stiffness and loaded balls over the extent of a defect and the cage angle (Figs. 5 and 6)."""

from __future__ import annotations

import dataclasses
import inspect
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bearingcore.bearings import Bearing
from bearingcore.common import (
    Array,
    Progress,
    ResultTable,
    _checks as checks,
    cached_property,
    shown_as_table,
    table_of,
)
from bearingcore.common._byte_cache import lru_cache_by_bytes
from bearingcore.model import _kernels as kernels
from bearingcore.model.scene import Defect, Scene, _packing as packing
from bearingcore.model.scene._defect import TWO_PI, floor_bytes, path_tables
from bearingcore.model.statics._equilibrium import (
    MOST_CONTACTS,
    STIFFNESS_TERMS,
    TERM_UNITS,
    UNEXPLAINED,
    default_cage_angles,
    time_shares,
    too_many_contacts,
)
from bearingcore.model.statics._shortage import explanation, is_unbounded
from bearingcore.model.statics._status import StaticStatus

GREATEST_EXTENT = math.radians(90.0)
"""Greatest extent of maps by default, as in the paper's Figs. 5 and 6."""

FIRST_POINTS = 20_000
"""Number of points of a map that are solved before the first report of progress."""


@shown_as_table
@dataclass(frozen=True)
class Maps:
    """Static answers over m extents of a scene's first defect and n cage angles.

    NaN where there is no answer.

    Attributes
    ----------
    scene, dofs
        the solved scene, and its free directions. The extent of its first defect is not used.
    extents : (m,) [rad]
    cage_angles : (n,) [rad]
    stiffness : (15, m, n) [N/m, N/rad, N·m/rad]
        the terms of K_b (Eq. 17) in the order of `STIFFNESS_TERMS`; see `term`.
    loaded_balls : (m, n)
        number of balls that carry load.
    greatest_load : (m, n) [N]
        load of the most heavily loaded ball.
    status : (m, n)
        each a `StaticStatus`; `reason(i, k)` puts it into words.
    residual : (m, n)
        unbalanced load over total load, moments divided by r_d.
    refusals : (m,)
        the reason why a scene with this extent is impossible; empty if it is possible.
    """

    scene: Scene
    dofs: tuple[str, ...]
    extents: Array
    cage_angles: Array
    stiffness: Array
    loaded_balls: NDArray[np.int64]
    greatest_load: Array
    status: NDArray[np.int8]
    residual: Array
    refusals: tuple[str, ...]

    @cached_property
    def converged(self) -> NDArray[np.bool_]:
        """(m, n) True where there is exactly one equilibrium, and the solver reached it."""
        return self.status == StaticStatus.CONVERGED

    def term(self, name: str) -> Array:
        """Return a stiffness term (m, n) by name, e.g. "k_yy" [N/m, N/rad, N·m/rad]."""
        if name not in STIFFNESS_TERMS:
            raise checks.refuse("stiffness term", name, ", ".join(STIFFNESS_TERMS))
        return self.stiffness[STIFFNESS_TERMS.index(name)]

    @cached_property
    def mean_loaded_balls(self) -> Array:
        """(m,) mean in time of the loaded balls over the angles with an answer; NaN without any."""
        shares = time_shares(self.cage_angles, self.scene.bearing.period)
        known = self.converged @ shares
        balls = np.where(self.converged, self.loaded_balls, 0) @ shares
        return np.where(known > 0.0, balls / np.maximum(known, 1e-300), math.nan)

    def table(self) -> ResultTable:
        """A row for each point: extent, cage angle, loaded balls, greatest load, stiffness."""
        extents, angles = np.meshgrid(self.extents, self.cage_angles, indexing="ij")
        return table_of(
            ("extent", "rad", extents, "extent of the first defect"),
            ("cage_angle", "rad", angles, "angle of the cage"),
            ("loaded_balls", "", self.loaded_balls, "balls that carry load"),
            ("greatest_ball_load", "N", self.greatest_load),
            *((term, TERM_UNITS[term], self.term(term)) for term in STIFFNESS_TERMS),
        )

    def reason(self, i: int, k: int) -> str:
        """Return the status of extent i and cage angle k in words."""
        if self.status[i, k] == StaticStatus.REFUSED:
            return self.refusals[i]
        status = StaticStatus(int(self.status[i, k]))
        words = status.sentence(residual=float(self.residual[i, k]))
        return words + explanation(status, self.scene, float(self.cage_angles[k]), self.dofs)


def stiffness_maps(
    scene: Scene,
    extents: ArrayLike | None = None,
    cage_angles: ArrayLike | None = None,
    dofs: Iterable[str] | None = None,
    *,
    progress: Progress | None = None,
) -> Maps:
    """Compute stiffness (Eq. 17) and loaded balls of `scene` for each extent of its first defect.

    The answers are those of `equilibrium` for `scene.replace(extent=...)`, but several times
    faster: a point at which all balls have the same drop as at the previous extent is not solved
    again.

    Parameters
    ----------
    scene
        the scene to solve; its other defects stay as they are.
    extents : (m,)
        [rad], 0 to 2π; None takes 91 from 0 to 90 degrees.
    cage_angles : (n,)
        [rad]; None takes `default_cage_angles`, of which a defect of the inner race has many.
    dofs
        free directions, names out of x, y, z, rx, ry; None takes the scene's.
    progress
        called about ten times a second with the part done, 0 to 1, and words; an exception from it
        ends the work.

    Returns
    -------
    Maps
        with a status for each point. A missing answer is a status, not an error, and so are defects
        that cannot have this extent together.

    Raises
    ------
    ValueError
        for extents or cage angles that are not finite or out of range, or that are more than
        MOST_CONTACTS times balls; and for unknown names in `dofs`.
    """
    checks.instance("scene", scene, Scene)
    if extents is None:
        sizes = np.linspace(0.0, GREATEST_EXTENT, 91)
    else:
        sizes = checks.finite("extents", extents, "rad")
        if not np.all((sizes >= 0.0) & (sizes <= TWO_PI)):
            raise checks.refuse("extents", extents, "0 to 2π [rad]")
    if cage_angles is None:
        angles = default_cage_angles(scene)
    else:
        angles = checks.finite("cage_angles", cage_angles, "rad")
    free = scene.free_dofs(dofs)
    bearing = scene.bearing
    shape = sizes.size, angles.size
    packed = packing.pack(scene, free)
    contacts, load = packed.contacts, packed.load
    points = sizes.size * angles.size
    if too_many_contacts(points * contacts.angle.size):
        most = MOST_CONTACTS // contacts.angle.size
        raise checks.refuse("extents times cage_angles", points, f"at most {most}")
    first, *others = scene.defect if isinstance(scene.defect, tuple) else (scene.defect,)
    map_paths, refusals = _paths(first, tuple(others), bearing, tuple(sizes.tolist()))
    map_paths = map_paths._replace(leads=np.zeros(shape))
    answers = kernels.new_answers(*shape)
    status = answers.status
    refused = np.array([bool(words) for words in refusals], dtype=bool)
    status[refused] = StaticStatus.REFUSED
    memory = kernels.new_memory(angles.size, contacts)

    def solve(begin: int, end: int) -> None:
        for rows in kernels.parts(begin, end, max(FIRST_POINTS // max(angles.size, 1), 1)):
            kernels.static_maps(angles, contacts, map_paths, load, rows, memory, answers)
            if progress is not None:
                progress(rows[1] / sizes.size, f"{rows[1]} of {sizes.size} extents")

    # The cage angle alone decides whether contacts can carry the load, and a descent without an
    # answer takes long. So the first row shows which cage angles the other rows can leave out.
    start = int(np.argmin(refused)) if not refused.all() else sizes.size
    begun = min(start + 1, sizes.size)
    solve(start, begun)
    failed = np.flatnonzero(np.isin(status[start:begun], UNEXPLAINED).any(axis=0))
    force = load.force[load.active]
    gone = [k for k in failed if is_unbounded(contacts, float(angles[k]), load.active, force)]
    status[:, gone] = np.where(refused[:, None], StaticStatus.REFUSED, StaticStatus.NOT_CARRIED)
    solve(begun, sizes.size)
    units = packed.units
    stiffness = answers.stiffness
    stiffness *= np.outer(units, units)[np.triu_indices(5)][:, None, None]
    return Maps(
        scene=scene,
        dofs=free,
        extents=sizes,
        cage_angles=angles,
        stiffness=stiffness,
        loaded_balls=answers.loaded,
        greatest_load=answers.greatest,
        status=status,
        residual=answers.residual,
        refusals=refusals,
    )


# The cache is bounded by bytes, as the tables of rough floors in a map may take a gigabyte.
@lru_cache_by_bytes(
    128_000_000,
    lambda paths, first, *_: (
        paths[0].defects.nbytes + paths[0].tables.nbytes + floor_bytes((first,))
    ),
)
def _paths(
    first: Defect, others: tuple[Defect, ...], bearing: Bearing, extents: tuple[float, ...]
) -> tuple[kernels.MapPaths, tuple[str, ...]]:
    """Return the paths over the defects, with each of the extents for the first defect.

    Also returns, for each extent, the reason why such defects are impossible; empty if they are
    possible. Results are cached: with several defects, or floors that are not flat, paths cost more
    than the maps, and a change of load does not change them.
    """
    sizes = np.array(extents)
    columns = len(kernels.PATH_COLUMNS)
    if not others and first.floor is None and bearing.rows_are_alike:
        # all extents have the same row of numbers, but for the extent itself
        row = dataclasses.replace(first, extent=math.pi).edge_row(bearing)
        rows = np.tile(row, (sizes.size, 1, 1))
        rows[:, 0, _HALF_EXTENT] = 0.5 * sizes
        rows[sizes >= TWO_PI, 0, _FLOOR_ANGLE] = 0.0
        counts = np.where((sizes > 0.0) & (first.depth > 0.0), 1, 0)
        return kernels.MapPaths(rows, counts, np.zeros(0), _NO_LEADS), ("",) * sizes.size
    paths: list[tuple[Array, Array]] = []
    refusals = []
    for extent in extents:
        defects = (dataclasses.replace(first, extent=extent), *others)
        try:
            # without its cache, which would fill with tables that are not needed again
            paths.append(inspect.unwrap(path_tables)(defects, bearing))
            refusals.append("")
        except ValueError as error:
            paths.append((np.zeros((0, columns)), np.zeros(0)))
            refusals.append(str(error))
    counts = np.array([len(rows) for rows, _ in paths], dtype=np.int64)
    all_rows = np.zeros((sizes.size, max(counts, default=0), columns))
    size = 0
    for i, (rows, table) in enumerate(paths):
        all_rows[i, : len(rows)] = rows
        all_rows[i, : len(rows), _TABLE_START] += size
        size += table.size
    tables = np.concatenate([*(table for _, table in paths), np.zeros(0)])
    return kernels.MapPaths(all_rows, counts, tables, _NO_LEADS), tuple(refusals)


_NO_LEADS = np.zeros((0, 0))

_HALF_EXTENT, _FLOOR_ANGLE, _TABLE_START = (
    kernels.PATH_COLUMNS.index(name)
    for name in ("half_extent", "angle_from_edge_to_floor", "table_start")
)
