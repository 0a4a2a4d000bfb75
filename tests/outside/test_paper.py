"""The numbers beside the paper's, from curves that `elements.py` and `test_sampling.py` compute."""

import math
import re
from functools import cache

import numpy as np
import pytest
from bearing_explorer.explorer.views.paper_figures import FIGURES
from scipy.signal import welch

from tests.outside.elements import Array, Defect, Rows
from tests.outside.plane import Plane, damped
from tests.outside.test_charts import RATE, exact
from tests.outside.witness import witness

PREFIX = {"G": 1e9, "M": 1e6, "k": 1e3, "m": 1e-3, "µ": 1e-6, "n": 1e-9, "": 1.0}
SHOWN = {(figure.number, row.name): (row, figure) for figure in FIGURES for row in figure.printed}


def numbers(number: int, name: str) -> list[float]:
    """What the list shows as ours, in SI; the prefix of a span is that of its last number."""
    row, figure = SHOWN[number, name]
    text = (
        row.ours(figure.scenes)
        .replace("−", "-")
        .replace("\u202f", "")
        .replace("kg", "")
        .replace("m/s²", "")
    )
    values: list[float] = []
    units = re.findall(r"(-?\d+(?:\.\d+)?)\s*([GMkmµn]?)(?=(N|m/s|Hz|kg|s\b|dB))?", text)
    last = 1.0
    for value, prefix, unit in reversed(units):
        last = PREFIX[prefix] if unit or prefix else last
        values.append(float(value) * last)
    return values[::-1]


LIEW_LIM = Rows(12, 6e-3, math.radians(30.0), 19.65e-3, 50e-6, 0.05e-6, (1.45e10, 1.5))
LOAD = np.array([0.0, -2000.0, 500.0, 0.0, 0.0])


@cache
def liew_lim(extent: float, first: float, last: float, count: int) -> tuple[Array, Array]:
    """Loads (count, balls) and stiffness (count, 5, 5) over cage angles, all in degrees."""
    hurt = Defect(math.radians(extent), 50e-6, 22.65e-3, "published") if extent else None
    rows = Rows(**{**vars(LIEW_LIM), "defect": hurt})
    cage = np.radians(np.linspace(first, last, count))
    return rows.curves(LOAD, cage, [0, 1, 2, 3, 4])


EXTENTS = (0.0, 5.0, 40.0, 70.0)


@witness(
    "figure 3: Loads*", "figure 4: *",
    by="least energy of contacts by SciPy at 121 cage angles, complex steps",
    compared="loads, means and ranges of stiffness of the Liew-Lim bearing, to the digits shown",
    within=0.01,
)  # fmt: skip
@pytest.mark.proof
def test_loads_and_stiffness_of_figures_3_and_4() -> None:
    runs = [liew_lim(extent, 15.0, 45.0, 121) for extent in EXTENTS]
    loads = np.concatenate([one[0] for one in runs])
    assert numbers(3, "Loads; the printed axis") == pytest.approx([0.0, loads.max()], rel=0.01)
    (spacing,) = re.findall(
        r"[\d.]+", SHOWN[4, "Stiffness repeats after"][0].ours([*FIGURES[1].scenes])
    )
    assert float(spacing) == 360.0 / 12
    for term, i in (("k_xx", 0), ("k_yy", 1), ("k_zz", 2)):
        means = [float(one[1][:-1, i, i].mean()) for one in runs]
        assert numbers(4, f"Mean {term}, healthy to 70°") == pytest.approx(means, rel=0.01)
    for name, pairs in (
        ("k_xx, k_yy, k_zz; the printed axis", ((0, 0), (1, 1), (2, 2))),
        ("k_xy, k_xz, k_yz; the printed axis", ((0, 1), (0, 2), (1, 2))),
        ("k_θxθx, k_θyθy; the printed axis", ((3, 3), (4, 4))),
    ):
        values = np.concatenate([one[1][:, i, j] for one in runs for i, j in pairs])
        own = values.min(), values.max()
        assert numbers(4, name) == pytest.approx(own, abs=0.01 * np.abs(values).max()), name


@witness(
    "figure 5: *", "figure 6: *", "function: stiffness_maps",
    by="least energy of contacts by SciPy at 120 cage angles of six extents",
    compared="extents at which k_yy and the loaded balls are least, of the Liew-Lim bearing",
    within="0.5°",
)  # fmt: skip
@pytest.mark.proof
def test_extents_of_figures_5_and_6() -> None:
    least = {
        name: float(SHOWN[number, name][0].ours(SHOWN[number, name][1].scenes).rstrip("°"))
        for number, name in ((5, "Mean k_yy is least at an extent of"),
                             (6, "Fewest balls carry load at an extent of"))
    }  # fmt: skip
    k_yy, balls = {}, {}
    for extent in (61.75, 62.75, 63.5, 63.75, 64.75, 65.5):
        loads, stiffness = liew_lim(extent, 0.0, 29.75, 120)
        k_yy[extent] = stiffness[:, 1, 1].mean()
        balls[extent] = (loads > 0.0).sum(axis=1).mean()
    assert least["Mean k_yy is least at an extent of"] == pytest.approx(
        min(k_yy, key=lambda one: k_yy[one]), abs=0.5
    )
    assert least["Fewest balls carry load at an extent of"] == pytest.approx(
        min(balls, key=lambda one: balls[one]), abs=0.5
    )


@witness(
    "figure 3: Balls in the defect*", "figure 8: Ball spacing", "figure 9: From entry to exit",
    "figure 9: Ball that leaves*", "figure 7: *",
    by="Table 1 and Section 4 of the paper; angles of balls counted here",
    compared="numbers of the rig as printed, balls in the defect, times between entry and exit",
    within=1e-3,
)  # fmt: skip
def test_numbers_of_geometry() -> None:
    inside = []
    for extent in EXTENTS[1:]:
        at = np.arange(0.0, 30.0, 0.01)[:, None] + 30.0 * np.arange(12)
        count = (np.abs((at - 270.0 + 180.0) % 360.0 - 180.0) < 0.5 * extent).sum(axis=1)
        inside += [count.min(), count.max()]
    assert numbers(3, "Balls in the defect at 5°, 40° and 70°") == inside
    assert numbers(8, "Ball spacing") == pytest.approx([360.0 / 14.0], rel=1e-3)
    cage = 0.5 * 7.0 * 360.0 * (1.0 - 8.0 / 45.0)  # degrees a second
    times = [(extent % (360.0 / 14.0)) / cage for extent in (12.9, 38.6)]
    assert numbers(9, "From entry to exit") == pytest.approx(times, rel=1e-3)
    left = []
    for extent in (12.9, 38.6):
        enters = (270.0 - 0.5 * extent - 8 * 360.0 / 14.0) % 360.0  # cage angle; ball 9 is number 8
        out = [(270.0 + 0.5 * extent - j * 360.0 / 14.0 - enters) % 360.0 for j in range(14)]
        left.append(float(np.argmin(out) + 1))
    assert numbers(9, "Ball that leaves after ball 9 has entered") == left
    printed = {
        "Mass of rotor and inner ring": 2.0, "Mass of housing and outer ring": 2.0,
        "Stiffness of the support": 212.2e6, "Damping of the support": 1648.2,
        "Load, downwards": 100.0, "Load-deflection factor": 5453e6,
    }  # fmt: skip
    for name, value in printed.items():
        assert numbers(7, name)[0] == pytest.approx(value, rel=1e-3), name


@cache
def fan_rig(extent: float) -> Array:
    """(angles, 4) frequencies of the fan rig over a ball spacing, rising, damping 122 N·s/m."""
    plane = Plane(14, 8e-3, 45e-3, 5453e6, 3e-6)
    cage = np.linspace(0.0, 2.0 * math.pi / 14, 721)
    own = math.radians(extent), 50e-6, "outer", "published"
    _, k, along = plane.solve(100.0, cage, 1.5 * math.pi, own)
    return damped(k, 121.96 * along, 2.0, (212.2e6, 1648.2))


@witness(
    "figure 8: Mean*", "figure 10: Band*",
    by="eigenvalues of K, M and C by `plane.py` at 721 cage angles",
    compared="mean frequencies and bands of the fan rig, to whole hertz", within=2e-3,
)  # fmt: skip
def test_frequencies_of_figures_8_and_10() -> None:
    rows = [fan_rig(extent) for extent in (0.0, 12.9, 38.6)]
    for name, mode in (
        ("Mean ω_x1: healthy, 12.9°, 38.6°", 0), ("Mean ω_x2", 2), ("Mean ω_y1", 1),
        ("Mean ω_y2", 3),
    ):  # fmt: skip
        means = [one[:-1, mode].mean() for one in rows]
        # of 38.6° x₁ and y₁, x₂ and y₂ change places: labels follow the direction
        assert numbers(8, name)[:2] == pytest.approx(means[:2], rel=2e-3), name
        pair = [rows[2][:-1, one].mean() for one in (mode, mode ^ 1)]
        assert min(abs(numbers(8, name)[2] / one - 1.0) for one in pair) < 0.03, name
    for name, mode in (("Band of ω_x1", 0), ("Band of ω_y1", 1)):
        shown = numbers(10, name)
        assert shown[:2] == pytest.approx(
            [rows[1][:, mode].min(), rows[1][:, mode].max()], rel=2e-3
        )
    ends = [numbers(10, name)[2:] for name in ("Band of ω_x1", "Band of ω_y1")]
    assert min(min(ends)) == pytest.approx(rows[2][:, 0].min(), rel=2e-3)
    assert max(max(ends)) == pytest.approx(rows[2][:, 1].max(), rel=2e-3)


@witness(
    "figure 9: * acceleration*", "figure 10: Level*",
    by="SciPy's DOP853 over 1.4 s on Eqs. 6, 18 and 19, densities by SciPy's welch",
    compared="accelerations from 0.745 to 0.775 s, levels from 0.3 to 2.1 kHz, both extents",
    within="2 %, 0.5 dB",
)  # fmt: skip
@pytest.mark.proof
def test_accelerations_and_levels_of_figures_9_and_10() -> None:
    runs = [
        exact("fan-rig", 1.4, "published", math.radians(extent), tolerance=1e-7)
        for extent in (12.9, 38.6)
    ]
    first, last = round(0.745 * RATE), round(0.775 * RATE)
    for i, name in enumerate(("Horizontal", "Vertical")):
        seen = np.concatenate([one[first:last, i] for one in runs])
        printed = numbers(9, f"{name} acceleration; the printed axis")
        assert printed == pytest.approx([seen.min(), seen.max()], rel=0.02), name
    for i, dof in enumerate("xy"):
        levels = []
        for one in runs:
            frequency, density = welch(one[len(one) // 2 :, i], RATE, nperseg=round(RATE / 32.0))
            shown = (frequency >= 300.0) & (frequency <= 2100.0)
            levels.append(10.0 * np.log10(density[shown]))
        ends = np.min(levels), np.max(levels)
        assert numbers(10, f"Level along {dof}; the printed axis") == pytest.approx(ends, abs=0.5)
