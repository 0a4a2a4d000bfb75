"""Results as tables of their own numbers; equal scenes give equal results, bit for bit."""

import csv
import hashlib
import io
import math
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

from bearingcore import (
    STIFFNESS_TERMS,
    contact_pressures,
    diagnose,
    equilibrium,
    kurtogram,
    life,
    modes,
    orbit,
    presets,
    simulate,
    spectrum,
    stiffness_maps,
)
from bearingcore.common import ResultTable, as_csv, table_of
from bearingcore.model.dynamics import speed_run
from bearingcore.model.statics import ball_positions
from bearingcore.model.sweeps import Grid
from bearingcore.recordings import Recording
from bearingcore.units import UNITS

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]


def test_an_equilibrium_has_its_terms_loads_and_reasons() -> None:
    state = equilibrium(LIEW_LIM, [0.0, 0.1, 0.2])
    table = state.table()
    assert set(STIFFNESS_TERMS) <= set(table)
    np.testing.assert_array_equal(table["k_yrx"], state.term("k_yrx"))
    assert (table.unit("k_yy"), table.unit("k_yrx"), table.unit("k_rxry")) == (
        "N/m",
        "N/rad",
        "N·m/rad",
    )
    np.testing.assert_array_equal(table["ball_12_load"], state.ball_load[:, 11])
    np.testing.assert_array_equal(table["displacement_ry"], state.displacement[:, 4])
    assert table.unit("displacement_ry") == "rad"
    assert list(table["status"]) == ["converged"] * 3


def test_units_for_people_stand_in_the_names() -> None:
    state = equilibrium(FAN_RIG, [0.0, 0.1])
    read = state.table().in_units()
    named = read.named()
    np.testing.assert_allclose(named["cage_angle_deg"], np.degrees(state.cage_angles))
    np.testing.assert_allclose(named["displacement_y_um"], 1e6 * state.displacement[:, 1])
    assert "k_yy_n_per_m" in named
    with pytest.raises(ValueError, match=r"unit of k_\w+ is 'deg'; allowed: N/m"):
        state.table().in_units({"N/m": "deg"})


def test_tables_stand_side_by_side_under_prefixes_and_never_mix_names() -> None:
    table = table_of(("a", "m", [1.0]))
    both = table | table.prefixed("healthy")
    assert list(both) == ["a", "healthy_a"]
    assert list(both.only("healthy_a")) == ["healthy_a"]
    with pytest.raises(ValueError, match="names of columns"):
        _ = table | table


def test_every_unit_has_an_si_unit_that_is_one_itself() -> None:
    for name, unit in UNITS.items():
        assert UNITS[unit.si].si == unit.si, name
        assert UNITS[unit.si].factor == 1.0, name


def test_every_result_has_a_table_of_its_own_numbers() -> None:
    modal = modes(FAN_RIG)
    np.testing.assert_array_equal(modal.table()["y1"], modal.frequency[:, modal.label.index("y1")])
    maps = stiffness_maps(FAN_RIG, [0.0, 0.2], [0.0, 0.1, 0.2])
    np.testing.assert_array_equal(maps.table()["k_yy"].reshape(2, 3), maps.term("k_yy"))
    assert maps.table()["extent"].tolist() == [0.0] * 3 + [0.2] * 3
    motion = simulate(FAN_RIG, 0.01)
    table = motion.table()
    np.testing.assert_array_equal(table["outer_acceleration_y"], motion.outer_acceleration[:, 1])
    density = spectrum(simulate(FAN_RIG, 0.1).outer_acceleration, 65536.0)
    np.testing.assert_array_equal(density.table(["x", "y"])["density_y"], density.density[:, 1])
    with pytest.raises(ValueError, match="directions"):
        density.table(["x"])
    steady = orbit(FAN_RIG)
    assert steady.table()["multiplier_size"].max() == pytest.approx(steady.largest_multiplier)
    run = speed_run(FAN_RIG, [40.0, 44.0], duration=0.1)
    np.testing.assert_array_equal(run.table()["density_x"].reshape(2, -1), run.density[..., 0])
    assert isinstance(run.table(), ResultTable)


def test_what_has_no_answer_is_nan_with_its_reason() -> None:
    table = equilibrium(FAN_RIG.replace(fy=0.0), [0.0]).table()
    assert math.isnan(table["k_yy"][0])
    assert table["status"][0].startswith("nothing touches")


def test_columns_of_different_length_end_in_empty_cells() -> None:
    table = {
        "cage_angle_deg": np.array([0.0, 0.1 + 0.2]),
        "label": np.array(["x1"]),
        "k_yy_n_per_m": np.array([1.25e8, np.nan]),
    }
    assert as_csv(table) == ("cage_angle_deg,label,k_yy_n_per_m\n0,x1,125000000\n0.3,,nan\n")


@pytest.mark.parametrize("word", ["=cmd|'/C calc'!A0", "+1", "-1", "@SUM(A1)", "\t=1"])
def test_words_are_no_formulas_to_a_spreadsheet(word: str) -> None:
    text = as_csv({word: np.array([-1.5]), "name": np.array([word])})
    head, row = csv.reader(io.StringIO(text, newline=""))
    assert head == ["'" + word, "name"]
    assert row == ["-1.5", "'" + word]


RESULTS = [
    lambda: equilibrium(LIEW_LIM, [0.0, 0.1]),
    lambda: modes(FAN_RIG, [0.0, 0.1]),
    lambda: life(presets["6205"].healthy(), 14_000.0),
    lambda: spectrum(np.random.default_rng(1).normal(size=(4096, 2)), 4096.0),
    lambda: kurtogram(np.random.default_rng(1).normal(size=8192), 8192.0),
    lambda: contact_pressures(presets["6205"]),
    lambda: stiffness_maps(FAN_RIG, [0.0, 0.2], [0.0, 0.1]),
    lambda: simulate(FAN_RIG, 0.01),
    lambda: orbit(FAN_RIG),
    lambda: speed_run(FAN_RIG, [40.0], duration=0.1),
]


@pytest.mark.parametrize("make", RESULTS)
def test_a_result_is_printed_as_its_table_in_a_notebook_too(make: Callable[[], Any]) -> None:
    result = make()
    table, text, page = result.table(), str(result), result._repr_html_()
    assert text.startswith(type(result).__name__)
    first, last = table.columns[0], table.columns[-1]
    for column in (first, last):
        assert column.name in text
        assert column.name in page
    assert "<table" in page
    line = repr(result)
    assert line.startswith(f"{type(result).__name__}(")
    assert "()" not in line
    assert len(line) <= 120
    assert "\n" not in line


def test_of_a_large_table_the_middle_is_left_out_and_a_frame_holds_all() -> None:
    table = table_of(("angle", "rad", np.arange(1000.0)), ("word", "", ["none"]))
    assert len(str(table).splitlines()) < 20
    assert "1000 rows" in str(table)
    frame = table.frame()
    assert list(frame) == ["angle_rad", "word"]
    assert len(frame) == 1000
    assert frame["word"].isna().sum() == 999


def test_words_in_a_table_are_no_markup() -> None:
    assert "<script>" not in table_of(("name", "", ["<script>"]))._repr_html_()


def test_scenes_and_bearings_are_said_in_a_line() -> None:
    assert repr(FAN_RIG.bearing) == "<Bearing: 14 balls of 8 mm on 45 mm>"
    assert repr(presets["nu208"].bearing) == "<Bearing: 14 rollers of 11 mm on 60.5 mm>"
    line = repr(presets["1208"])
    assert line.startswith("<Scene: 16 balls of 8.731 mm on 59.16 mm, 10°, 2 rows; fy = -1000; ")
    assert line.endswith("1500 rpm; outer race damaged over 8°, 100 µm deep>")


def test_the_stiffness_is_a_table_to_copy_at_an_angle_or_on_average() -> None:
    state = equilibrium(LIEW_LIM, [0.0, 0.1, 0.2])
    at = state.stiffness_table(1)
    assert list(at["load"]) == ["fx [N]", "fy [N]", "fz [N]", "mx [N·m]", "my [N·m]"]
    columns = ["per_m_x", "per_m_y", "per_m_z", "per_rad_rx", "per_rad_ry"]
    assert list(at)[1:] == columns
    np.testing.assert_array_equal(np.stack([at[c] for c in columns], 1), state.stiffness[1])
    mean = state.stiffness_table()
    expected = np.average(state.stiffness, axis=0, weights=(1.0, 2.0, 1.0))
    np.testing.assert_allclose(np.stack([mean[c] for c in columns], 1), expected, 1e-12, 1e-6)
    lines = list(csv.reader(io.StringIO(at.csv())))
    assert (len(lines), len(lines[0])) == (6, 6)
    loose = equilibrium(FAN_RIG.replace(fy=0.0), [0.0]).stiffness_table()
    assert np.isnan(loose["per_m_x"]).all()
    with pytest.raises(ValueError, match="i is 3; allowed: a whole number from 0 to 2"):
        state.stiffness_table(3)


def _sweep() -> list[np.ndarray]:
    over = {"extent": [0.1, 0.2, 0.3], "fy": [-2000.0, -1800.0]}
    status, numbers = Grid.of(LIEW_LIM, over, ["k_yy_*", "band_*"]).compute()
    return [status, *(numbers[name] for name in sorted(numbers))]


def _diagnosis() -> list[np.ndarray]:
    noise = np.random.default_rng(1).standard_normal((2**15, 1))
    diagnosis = diagnose(Recording(noise, 12_000.0, ("y",)), presets["6205"].bearing, 180.0)
    return [np.array([part.level for part in diagnosis.evidence])]


ANSWERS: dict[str, Callable[[], list[np.ndarray]]] = {
    "equilibrium": lambda: [equilibrium(LIEW_LIM).stiffness, equilibrium(LIEW_LIM).displacement],
    "maps": lambda: [stiffness_maps(LIEW_LIM, [0.2, 0.4, 0.6]).stiffness],
    "positions": lambda: [ball_positions(presets["6205"].replace(shaft_speed=900.0)).load],
    "modes": lambda: [modes(FAN_RIG).undamped_frequency, modes(FAN_RIG).shape],
    "motion": lambda: [simulate(FAN_RIG, 0.05).outer_acceleration],
    "five directions": lambda: [simulate(LIEW_LIM, 0.02).outer_acceleration],
    "with mass": lambda: [simulate(FAN_RIG.replace(balls="with mass"), 0.01).outer_acceleration],
    "orbit": lambda: [orbit(FAN_RIG).history, orbit(FAN_RIG).multipliers],
    "spectrum": lambda: [spectrum(simulate(FAN_RIG, 0.05).outer_acceleration, 65536.0).density],
    "life": lambda: [np.array(life(presets["6205"], 14_800.0).million_revolutions)],
    "sweep": _sweep,
    "diagnosis": _diagnosis,
}


def print_of(name: str) -> str:
    """A fingerprint of all bytes of an answer."""
    digest = hashlib.sha256()
    for array in ANSWERS[name]():
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


@pytest.fixture(scope="module")
def first() -> dict[str, str]:
    """All, one after the other."""
    return {name: print_of(name) for name in ANSWERS}


@pytest.mark.proof
def test_the_same_again_in_two_threads(first: dict[str, str]) -> None:
    names = [*ANSWERS, *reversed(ANSWERS)]  # others beside each the second time
    with ThreadPoolExecutor(2) as threads:
        again = list(zip(names, threads.map(print_of, names), strict=True))
    assert [(name, first[name]) for name in names] == again


@pytest.mark.proof
def test_the_same_in_another_process(first: dict[str, str]) -> None:
    """Another order of hashes and of everything in memory."""
    ask = (
        "from tests.bearingcore.common.test_table import ANSWERS, print_of\n"
        "for name in reversed(ANSWERS): print(name, print_of(name), sep='=')"
    )
    said = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True)
    other = dict(line.rsplit("=", 1) for line in said.stdout.splitlines())
    assert other == first
