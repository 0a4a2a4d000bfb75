"""Every output of a sweep, from curves that `elements.py` computes at the same cage angles."""

import math
from functools import cache

import numpy as np
import pytest

from bearingcore.model.scene import DOF_NAMES
from bearingcore.model.statics._equilibrium import TERM_INDICES
from bearingcore.model.sweeps import OUTPUTS, STATUSES, Grid, Settings, SweepStatus
from tests.outside.test_contacts import gamma, pressures
from tests.outside.test_kinds import CASES, GROUND, MASS, C, problem_of
from tests.outside.witness import witness

PAIR = CASES["rows"]
ANGLES = 61
SETTINGS = Settings(
    cage_angles=ANGLES, duration=0.006, sample_rate=65_536.0, dynamic_load_rating=60e3
)


@cache
def swept() -> dict[str, np.ndarray]:
    """All outputs of the pair of 7208, in five directions."""
    wanted = [name for name in OUTPUTS if not name.startswith(("mass", "floquet"))]
    scene = PAIR.scene.replace(contact_damping=C)
    _, numbers = Grid.of(scene, {"depth": [1e-4]}, wanted, SETTINGS).compute()
    return {name: values[0] for name, values in numbers.items()}


@cache
def curves() -> tuple[np.ndarray, np.ndarray]:
    """Loads (angles, balls) and stiffness (angles, 5, 5) over a ball spacing, both ends."""
    cage = np.linspace(0.0, 2.0 * math.pi / PAIR.rows.count, ANGLES)
    return PAIR.rows.curves(PAIR.force, cage, PAIR.free)


def mean(values: np.ndarray) -> np.ndarray:
    """By the trapezoidal rule."""
    return np.trapezoid(values, axis=0) / (ANGLES - 1)


@witness(
    "output: k_*", "output: loaded_balls_*", "output: ball_load_greatest",
    "output: converged_share",
    by="least energy of contacts by SciPy at 61 cage angles, complex steps, trapezoidal rule",
    compared="mean, least and greatest of 15 stiffness terms, loads and balls of a pair of 7208",
    within=1e-5,
)  # fmt: skip
def test_statics() -> None:
    loads, stiffness = curves()
    for term, (i, j) in TERM_INDICES.items():
        values = stiffness[:, i, j]
        size = math.sqrt(stiffness[:, i, i].max() * stiffness[:, j, j].max())
        own = mean(values), values.min(), values.max()
        actual = [swept()[f"{term}_{which}"] for which in ("mean", "least", "greatest")]
        assert actual == pytest.approx(own, abs=1e-5 * size), term
    assert swept()["ball_load_greatest"] == pytest.approx(loads.max(), rel=1e-5)
    carrying = (loads > 0.0).sum(axis=1)
    assert swept()["loaded_balls_mean"] == pytest.approx(mean(carrying), rel=1e-9)
    assert swept()["loaded_balls_least"] == carrying.min()
    assert swept()["loaded_balls_greatest"] == carrying.max()
    assert swept()["converged_share"] == 1.0


@witness(
    "output: contact_pressure_*", "output: life_*",
    by="Hertz and ISO 16281 written out here, on loads by SciPy at 61 cage angles",
    compared="pressures, life in turns and hours, and over the healthy one's", within=2e-3,
)  # fmt: skip
def test_life_and_pressure() -> None:
    loads, _ = curves()
    own = pressures("rows", loads.max())
    actual = [swept()[f"contact_pressure_{race}"] for race in ("inner", "outer")]
    assert actual == pytest.approx(own, rel=1e-4)
    healthy = type(PAIR.rows)(**{**vars(PAIR.rows), "defect": None})
    cage = np.linspace(0.0, 2.0 * math.pi / PAIR.rows.count, ANGLES)
    whole, _ = healthy.curves(PAIR.force, cage, PAIR.free)

    def life(loads: np.ndarray) -> float:
        g, Z = gamma(PAIR), PAIR.rows.count
        B = 1.044 * ((1 - g) / (1 + g)) ** 1.72 * ((0.52 / 0.53) * (0.06 / 0.04)) ** 0.41
        share = 60e3 / (Z * math.cos(PAIR.rows.angle) * 2.0**0.7)
        ratings = (share / 0.407 * (1 + B ** (10 / 3)) ** 0.3,
                   share / 0.389 * (1 + B ** (-10 / 3)) ** 0.3)  # fmt: skip
        rows = loads.reshape(ANGLES, 2, Z)
        inner = mean((rows**3).mean(axis=2)) ** (1 / 3)
        outer = mean((rows ** (10 / 3)).mean(axis=2)) ** 0.3
        worn = (inner / ratings[0]) ** (10 / 3) + (outer / ratings[1]) ** (10 / 3)
        return float(worn.sum() ** -0.9)

    damaged, healthy_life = life(loads), life(whole)
    assert swept()["life_turns"] == pytest.approx(1e6 * damaged, rel=2e-3)
    hours = 1e6 * damaged / (3000.0 * 60.0)
    assert swept()["life_hours"] == pytest.approx(hours, rel=2e-3)
    assert swept()["life_share_of_healthy"] == pytest.approx(damaged / healthy_life, rel=2e-3)


@witness(
    "output: band_*",
    by="eigenvalues by SciPy of K and M at 61 cage angles",
    compared="lowest and highest end of all bands, as a set", within=2e-3,
)  # fmt: skip
def test_bands() -> None:
    _, stiffness = curves()
    whole = [np.block([[k, -k], [-k, k + np.diag(GROUND)]]) for k in stiffness]
    inertia = np.concatenate([MASS, MASS])
    values = np.linalg.eigvals([k / inertia[:, None] for k in whole]).real
    frequency = np.sort(np.sqrt(np.maximum(values, 0.0)), axis=1) / (2.0 * math.pi)
    least, greatest = (np.sort(swept()[f"band_{which}"]) for which in ("least", "greatest"))
    # modes may cross, so that ends of bands are those of all frequencies in order
    assert least[0] == pytest.approx(frequency.min(), rel=2e-3)
    assert greatest[-1] == pytest.approx(frequency.max(), rel=2e-3)
    assert least == pytest.approx(frequency.min(axis=0), rel=0.02)
    assert greatest == pytest.approx(frequency.max(axis=0), rel=0.02)


@witness(
    "output: acceleration_*",
    by="SciPy's DOP853 on the equations of `march.py`, low-passed by SciPy's firwin",
    compared="root mean square and greatest acceleration in five directions, second half of 6 ms",
    within=0.01,
)  # fmt: skip
@pytest.mark.proof
def test_accelerations() -> None:
    times = np.arange(393) / 65_536.0
    one = problem_of(PAIR, PAIR.rows)
    late = one.accelerations(times, one.solved(one.start(), times))[196:]
    for i, dof in enumerate(DOF_NAMES):
        rms = math.sqrt(np.mean(late[:, i] ** 2))
        assert swept()[f"acceleration_rms_{dof}"] == pytest.approx(rms, rel=0.01), dof
        greatest = np.abs(late[:, i]).max()
        assert swept()[f"acceleration_greatest_{dof}"] == pytest.approx(greatest, rel=0.02), dof


@witness(
    "output: contact_pressure_*", "output: band_*",
    by="Hertz by closed form and eigenvalues by SciPy, on loads of `elements` at five cage angles",
    compared="pressures and bands of a 1208 whose life has no rating", within=2e-3,
)  # fmt: skip
def test_what_a_missing_rating_leaves_known() -> None:
    case, free = CASES["self-aligning"], [0, 1, 2]
    outputs = ["contact_pressure_*", "life_*", "band_*"]
    grid = Grid.of(case.scene, {"depth": [1e-4]}, outputs, Settings(cage_angles=5))
    (code,), numbers = grid.compute()
    assert STATUSES[code] is SweepStatus.COMPUTATION_REFUSED
    assert np.isnan(numbers["life_turns"][0])
    cage = np.linspace(0.0, 2.0 * math.pi / case.rows.count, 5)
    loads, stiffness = case.rows.curves(case.force, cage, free)
    ours = [numbers[f"contact_pressure_{race}"][0] for race in ("inner", "outer")]
    assert ours == pytest.approx(pressures("self-aligning", loads.max()), rel=1e-5)
    bearing = stiffness[:, :3, :3]
    ground = bearing + np.diag(GROUND[:3])
    whole = np.block([[bearing, -bearing], [-bearing, ground]]) / MASS[0]
    frequency = np.sqrt(np.linalg.eigvalsh(whole)) / (2.0 * math.pi)
    assert np.nanmin(numbers["band_least"]) == pytest.approx(frequency.min(), rel=2e-3)
    assert np.nanmax(numbers["band_greatest"]) == pytest.approx(frequency.max(), rel=2e-3)
