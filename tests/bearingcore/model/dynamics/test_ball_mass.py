"""Balls with mass: limits, conservation, published bands, another family of methods."""

import math
import os

import numpy as np
import pytest

from bearingcore import Scene, equilibrium, presets, simulate
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import contact_resonance_band
from bearingcore.model.dynamics._ball_motion import (
    ball_start,
    ball_step_rate,
    ball_system,
    contact_stiffness,
    heaviest_load,
)
from bearingcore.model.dynamics._damping import packed_motion
from bearingcore.model.scene import _packing as packing
from tests.helpers.contact_law import TwoContacts
from tests.helpers.random_balls import ball_places, motion_faults, random_scene

RATE = 65536.0
FAN_RIG = presets["fan-rig"].replace(contact_damping=122.0, density=7850.0, balls="with mass")
GENERAL = presets["7208-25deg"].replace(dofs="tilt free", balls="with mass")


def test_contact_resonance_of_a_6205() -> None:
    """Its heaviest loaded ball under 1 kN: 532.30 N, 1.06189e8 and 1.00856e8 N/m, 2.04435 g."""
    scene = presets["6205"].healthy()
    assert scene.bearing.ball_mass == pytest.approx(2.04435e-3, rel=1e-5)
    assert heaviest_load(packing.pack(scene)) == pytest.approx(532.30, rel=2e-4)
    assert contact_stiffness(scene.bearing, 532.30) == pytest.approx(
        (1.06189e8, 1.00856e8), rel=1e-5
    )
    assert contact_resonance_band(scene)[1] == pytest.approx(50.65e3, rel=1e-4)


def test_races_in_series_are_the_contact_of_the_massless_ball() -> None:
    """Load-deflection factors, dampers and groove distances of both contacts, together."""
    for name in presets:
        scene = presets[name]
        bearing = scene.bearing
        n = bearing.kind.exponent
        both = sum(K ** (-1.0 / n) for K in bearing.race_factors) ** -n
        assert both == pytest.approx(bearing.load_deflection_factor, rel=1e-12)
        apart = bearing.groove_center_distance or 0.0  # no centres where races are straight
        assert sum(bearing.kind.race_distances(bearing)) == pytest.approx(apart)
        dampers = packing.races(scene, 122.0, weight=True).damping[:, 0]
        assert 1.0 / (1.0 / dampers).sum() == pytest.approx(122.0, rel=1e-12)
    assert presets["fan-rig"].bearing.race_factors[0] == pytest.approx(2.0**1.5 * 5453e6)
    assert packing.races(FAN_RIG, 122.0, weight=True).damping[:, 0] == pytest.approx([244.0, 244.0])


@pytest.mark.parametrize("scene", [FAN_RIG, GENERAL, presets["liew-lim"]], ids=lambda s: s.dofs)
def test_the_start_at_rest_stays_at_rest(scene: Scene) -> None:
    """At speed 0 nothing accelerates in the static state, balls' weight and all directions on."""
    scene = scene.replace(shaft_speed=0.0, balls="with mass")
    start = ball_start(packed_motion(scene), equilibrium(scene, [0.0]))
    assert start is not None
    n, step = len(scene.active_dofs), 1e-6
    moved = np.abs(marched(ball_system(packed_motion(scene)), start, step, 1) - start)
    # a force F moves a mass m, at rest at first, by F h²/2m in a step h
    off = 0.5e-9 * np.linalg.norm(scene.load.vector[:3]) * step**2
    assert moved[[*range(n), *range(2 * n, 3 * n)]].max() < off
    places = moved[4 * n :][: (start.size - 4 * n) // 2]
    assert places.max() * scene.bearing.ball_mass < off


@pytest.mark.parametrize("scene", [FAN_RIG, GENERAL], ids=["planar", "general"])
def test_loads_and_places_are_those_of_independent_sums(scene: Scene) -> None:
    """Loads at both contacts from the places that a motion returns, and vice versa."""
    scene = scene.replace(extent=math.radians(12.9), center=0.02 + 1.5 * math.pi)
    motion = simulate(scene, 0.01, RATE)
    assert motion.completed
    full = np.zeros((2, 5))
    index = packing.direction_numbers(motion.dofs)
    for i in (0, 100, 400):
        full[0, index], full[1, index] = motion.inner_displacement[i], motion.outer_displacement[i]
        sums = TwoContacts(scene, motion.cage_angle[i], *full, ball_places(motion, i))
        for race, load in enumerate(motion.race_loads()):
            assert load[i] == pytest.approx(sums.load[race], rel=1e-7, abs=1e-6)
    part = motion.race_loads(90, 110)
    assert np.array_equal(part[1], motion.ball_loads(90, 110))
    assert part[0] == pytest.approx(motion.race_loads()[0, 90:110], rel=1e-9, abs=1e-9)


def undamped(scene: Scene) -> tuple[kernels.BallSystem, np.ndarray]:
    """A scene that stands still in its frame, without damping, pushed off."""
    scene = scene.replace(contact_damping=0.0, contact_law="published")
    dofs = scene.active_dofs
    still = scene.replace(shaft_speed=0.0)
    system = ball_system(packed_motion(still))
    rotor = system.rotor._replace(damping=0.0 * system.rotor.damping)
    start = ball_start(packed_motion(still), equilibrium(still, [0.0]))
    assert start is not None
    n = len(dofs)
    start[n : 2 * n] = 1e-3 * np.arange(1, n + 1)  # so fast that balls let go and strike
    start[3 * n : 4 * n] = -2e-3
    return system._replace(rotor=rotor), start


def marched(
    system: kernels.BallSystem, start: np.ndarray, duration: float, steps: int
) -> np.ndarray:
    """State at the end."""
    n = system.rotor.active.size
    balls = system.contacts.angle.size
    history = np.empty((2, 6, n))
    place = np.empty((2, (start.size - 4 * n) // (2 * balls), balls))
    y = start.copy()
    done = kernels.march_balls(y, duration / steps, 0.0, steps, system, history, place)
    assert done == steps
    return y


def energy(scene: Scene, system: kernels.BallSystem, y: np.ndarray) -> float:
    """Kinetic, in contacts and support, of load and weight [J]; velocities in y are true ones."""
    rotor, races = system.rotor, system.races
    n, balls = rotor.active.size, system.contacts.angle.size
    x_i, v_i, x_o, v_o = y[: 4 * n].reshape(4, n)
    place, speed = y[4 * n :].reshape(2, -1, balls)
    full = np.zeros((2, 5))
    units = packing.length_units(scene)
    full[0, rotor.active], full[1, rotor.active] = x_i, x_o
    where = np.zeros((2, balls))
    where[: len(place)] = place
    sums = TwoContacts(scene, 0.0, full[0] / units, full[1] / units, where)
    kinetic = (v_i**2 / rotor.inverse_inner).sum() + (v_o**2 / rotor.inverse_outer).sum()
    kinetic += (races.mass * speed**2).sum()
    potential = 0.5 * (rotor.stiffness * x_o**2).sum() - (rotor.force * x_i).sum()
    potential += (races.weight * np.sin(system.contacts.angle) * where[0]).sum()
    return float(0.5 * kinetic + potential + sums.energy)


@pytest.mark.parametrize("scene", [FAN_RIG, GENERAL], ids=["planar", "general"])
def test_undamped_motion_keeps_its_energy_to_the_methods_order(scene: Scene) -> None:
    """Energy drifts by the fifth power of RK4's step while balls stay in contact.

    Where they let go and strike it is the third or more: stiffness begins like a square root.
    """
    system, start = undamped(scene)
    n = system.rotor.active.size
    before = energy(scene, system, start)
    drift = []
    for steps in (800, 1600, 3200):
        y = marched(system, start, 2e-3, steps)
        drift.append(abs(energy(scene, system, y) - before))
    pushed = 0.5 * (start[n : 2 * n] ** 2 / system.rotor.inverse_inner).sum()
    assert drift[-1] < 1e-6 * pushed
    order = math.log2(drift[0] / drift[-1]) / 2.0
    assert order > (4.5 if scene is GENERAL else 2.0)


def test_accelerations_of_random_motions_are_those_of_independent_sums() -> None:
    """MOTIONS says how many: of 12,000 none was wrong without saying so."""
    rng = np.random.default_rng(14)
    count = int(os.environ.get("MOTIONS", "40"))
    assert [motion_faults(random_scene(rng), rng) for _ in range(count)] == [""] * count


def test_steps_follow_the_contact_resonance_and_are_counted_before_they_begin() -> None:
    scene = presets["6205"].replace(balls="with mass")
    rate = ball_step_rate(packed_motion(scene), RATE)
    assert rate % RATE == 0.0
    assert rate > 5.0 * contact_resonance_band(scene)[1]
    endless = simulate(scene, 10.0, RATE)
    assert not endless.completed
    assert "most_steps" in endless.reason
    assert endless.right_hand_side_calls == 0
    assert np.isnan(endless.outer_acceleration[:10]).all()
    assert np.isnan(endless.race_loads(0, 10)).all()
    whole = simulate(presets["liew-lim"].replace(balls="with mass"), 1.4, RATE, most_steps=1)
    assert whole.step_rate * 1.4 < 1e6  # what is marched without asking
    with pytest.raises(ValueError, match="multiple of the sample_rate"):
        simulate(scene, 0.1, RATE, step_rate=0.5 * RATE)
