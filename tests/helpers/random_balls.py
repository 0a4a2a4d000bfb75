"""Random scenes of balls with mass, and what is wrong with the answers to them.

Each is judged by sums that share nothing with the solver (`tests.helpers.contact_law`): what is
left on every ball and on the ring, and of motions the accelerations of both rings against the
loads that the same sums make of all places. None may be wrong without saying so.
"""

import math

import numpy as np

from bearingcore import Bearing, Defect, Load, Scene, presets, simulate
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import Motion
from bearingcore.model.scene import WITH_MASS
from bearingcore.model.statics import BallPositions
from tests.helpers.contact_law import TwoContacts

TOLERANCE = 1e-7
"""Unbalanced load over the greatest load, from which on an answer counts as wrong."""
SAMPLE_RATE, SAMPLES, LOOKS = 262_144.0, 128, 5


def random_scene(rng: np.random.Generator) -> Scene:
    """Any bearing, defects in either race, load, speed: light and heavy, slow and very fast."""
    n_balls = int(rng.integers(5, 25))
    D_b = 10.0 ** rng.uniform(-2.5, -1.4)
    D_p = D_b * max(n_balls / math.pi * rng.uniform(1.08, 1.8), 2.0)
    bearing = Bearing.from_drawing(
        n_balls,
        D_b,
        D_p,
        rng.uniform(0.505, 0.56) * D_b,
        rng.uniform(0.505, 0.56) * D_b,
        contact_angle=rng.choice([0.0, rng.uniform(0.0, 0.9)]),
    ).replace(radial_clearance=rng.choice([0.0, rng.uniform(0.0, 2e-3) * D_b]))
    heading = rng.uniform(0.0, 2.0 * math.pi)
    size = 10.0 ** rng.uniform(0.0, 4.5)
    share = rng.choice([0.0, rng.uniform(0.0, 2.0)])
    defects = tuple(
        Defect(
            rng.uniform(0.01, 0.6),
            rng.uniform(0.0, 0.03) * D_b,
            heading + 2.0 * race + rng.uniform(-0.5, 0.5),
            ("outer", "inner")[race],
            str(rng.choice(["published", "chord", "exact"])),
        )
        for race in range(int(rng.integers(0, 3)))
    )
    return Scene(
        bearing=bearing,
        defect=defects,
        load=Load(size * math.cos(heading), size * math.sin(heading), share * size),
        shaft_speed=10.0 ** rng.uniform(0.0, 3.3),
        support=presets["fan-rig"].support,
        dofs=["tilt free", ("x", "y"), ("x", "y", "z")][int(rng.integers(3))],
    )


def faults(state: BallPositions, i: int) -> str:
    """What is wrong with a cage angle's answer, "" for nothing: right, or said not to be."""
    if state.status[i] not in (kernels.CONVERGED, kernels.FREE_DIRECTION):
        silent = np.isfinite(state.load[:, i]).any() and state.status[i] >= kernels.NOT_CARRIED
        return "numbers without an answer" if silent else ""
    scene = state.scene
    if state.status[i] == kernels.FREE_DIRECTION:
        known = np.isfinite(state.displacement[i]).all()
        return "a free direction with a displacement" if known else ""
    sums = TwoContacts(
        scene, state.cage_angles[i], state.displacement[i], np.zeros(5), state.position[i]
    )
    size = max(float(state.load[:, i].max()), float(np.linalg.norm(scene.load.vector[:3])))
    left = np.abs(sums.on_balls(centrifugal=state.centrifugal_load, weight=False)).max()
    lever = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
    free = [("x", "y", "z", "rx", "ry").index(dof) for dof in state.dofs]
    ring = float(np.abs((sums.force(0) - scene.load.vector) / lever)[free].max())
    if left > TOLERANCE * size:
        return f"{left:.2e} N left on a ball, of {size:.2e} N"
    if ring > TOLERANCE * size:
        return f"{ring:.2e} N left on the ring, of {size:.2e} N"
    return ""


def ball_places(motion: Motion, i: int) -> np.ndarray:
    """Radial and axial places (2, N_b) [m] of balls in a sample; axial 0 of a planar motion."""
    assert motion.ball_place is not None
    return np.vstack([*motion.ball_place[i], np.zeros(motion.ball_place.shape[2])])[:2]


def motion_faults(scene: Scene, rng: np.random.Generator) -> str:
    """What is wrong with a motion of a scene without damping of its contacts, "" for nothing.

    Raises ValueError where it cannot move.
    """
    scene = scene.replace(balls=WITH_MASS, contact_damping=0.0)
    motion = simulate(scene, SAMPLES / SAMPLE_RATE, SAMPLE_RATE)
    known = np.isfinite(motion.outer_acceleration).all(axis=1)
    if not motion.completed:
        silent = known.any() and not known[: int(known.sum())].all()
        return "numbers after the end" if silent or known.all() else ""
    if not known.all():
        return "NaN in a motion that is said to be complete"
    number = [("x", "y", "z", "rx", "ry").index(dof) for dof in motion.dofs]
    lengths = [i for i, dof in enumerate(motion.dofs) if not dof.startswith("r")]
    support = scene.support
    stiffness, damping = support.stiffness(motion.dofs), support.damping(motion.dofs)
    masses = [support.inertia(body, motion.dofs) for body in ("inner", "outer")]
    for row in rng.integers(0, SAMPLES, LOOKS):
        rings = np.zeros((2, 5))
        rings[0, number] = motion.inner_displacement[row]
        rings[1, number] = motion.outer_displacement[row]
        sums = TwoContacts(scene, motion.cage_angle[row], *rings, ball_places(motion, row))
        carried = [sums.force(race)[number] for race in (0, 1)]
        held = stiffness * rings[1, number] + damping * motion.outer_velocity[row]
        forces = scene.load.vector[number] - carried[0], carried[1] - held
        sizes = [np.abs(part).max() for part in (*carried, held, scene.load.vector)]
        size = max(*sizes, 1e-3)
        for body, name in enumerate(("inner", "outer")):
            acceleration = motion.instant_acceleration(name)
            off = np.abs(masses[body] * acceleration[row] - forces[body])[lengths].max()
            if off > TOLERANCE * size:
                return f"{off:.2e} N left on a ring in motion, of {size:.2e} N"
    return ""
