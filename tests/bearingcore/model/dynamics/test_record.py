"""Simulated records: what is drawn is the scene's, each effect does what it says."""

import dataclasses
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

from bearingcore import diagnose, scene_of, simulated_record, spectrum
from bearingcore.model.dynamics import PathEffects
from bearingcore.model.sweeps import OUTPUTS, Settings, sweep
from bearingcore.model.sweeps._outputs import chosen_outputs

SCENE = scene_of("6205").replace(extent=0.03, depth=5e-5, center=math.radians(270.0))
BARE = PathEffects(0.0, (), 0.0, shaft_tones=0.0, noise=None)


def rms(record) -> float:
    return float(np.sqrt(np.mean(record.acceleration**2)))


def test_equal_scenes_give_equal_records_and_a_seed_another_one() -> None:
    record = simulated_record(SCENE, duration=0.3)
    np.testing.assert_array_equal(
        record.acceleration, simulated_record(SCENE.replace(), duration=0.3).acceleration
    )
    assert record.shaft_speed == SCENE.shaft_speed
    for other in (
        simulated_record(SCENE, duration=0.3, seed=1),
        simulated_record(SCENE.replace(fy=-900.0), duration=0.3),
    ):
        assert not np.allclose(other.acceleration, record.acceleration, rtol=0.1)


@pytest.mark.proof
def test_a_seed_of_a_sweep_keeps_the_path_and_several_are_a_dimension() -> None:
    """A path drawn anew for each scene hides what the length of a spall does to the level."""
    lengths = np.linspace(0.01, 0.12, 16)
    kept: dict[str, Any] = {"duration": 0.4, "sample_rate": 20_480.0}

    def level(**drawn: Any) -> xarray.DataArray:
        records = sweep(SCENE, {"extent": lengths}, ["record_y"], **kept, **drawn)["record_y"]
        return np.sqrt((records**2).mean("sample"))

    assert abs(np.corrcoef(level(), lengths)[0, 1]) < 0.6
    levels = level(seed=(1, 2))
    assert levels.dims == ("extent", "seed")
    assert levels["seed"].values.tolist() == [1, 2]
    for seed in (1, 2):
        assert np.corrcoef(levels.sel(seed=seed), lengths)[0, 1] > 0.9
    np.testing.assert_array_equal(levels.sel(seed=2), level(seed=2))
    bare = level(seed=5, effects=BARE)
    single = simulated_record(SCENE.replace(extent=lengths[3]), BARE, 0.4, seed=5)
    assert bare[3] == pytest.approx(np.sqrt(np.mean(single.acceleration[:, 1] ** 2)), rel=1e-12)


def test_effects_add_what_they_say() -> None:
    bare = simulated_record(SCENE, BARE, 0.5, seed=3)
    for below, share in ((20.0, 0.1), (6.0, 0.5)):
        noisy = simulated_record(SCENE, dataclasses.replace(BARE, noise=below), 0.5, seed=3)
        added = np.sqrt(np.mean((noisy.acceleration - bare.acceleration) ** 2))
        assert added / rms(bare) == pytest.approx(share, rel=0.01)
    behind = dataclasses.replace(BARE, background=2.0)
    added = simulated_record(SCENE, behind, 0.5, seed=3).acceleration - bare.acceleration
    np.testing.assert_allclose(np.sqrt(np.mean(added**2, axis=0)), 2.0, rtol=0.01)
    ringing = simulated_record(SCENE, dataclasses.replace(BARE, knock=5.0), 0.5, seed=3)
    shown = spectrum(ringing.acceleration[:, 1] - bare.acceleration[:, 1], ringing.sample_rate)
    assert shown.frequency[shown.density.argmax()] == pytest.approx(4700.0, rel=0.04)


def test_blows_of_an_inner_race_come_and_go_with_its_load() -> None:
    """A defect of the inner race strikes where balls carry load: below, once a turn."""
    knocking = dataclasses.replace(BARE, knock=50.0)
    record = simulated_record(SCENE.replace(race="inner"), knocking, 0.5, seed=3)
    turn = SCENE.shaft_speed * np.arange(len(record.acceleration)) / record.sample_rate
    energy = record.acceleration[:, 1] ** 2
    once_a_turn = abs(np.mean(energy * np.exp(-1j * turn))) / np.mean(energy)
    standing = simulated_record(SCENE, knocking, 0.5, seed=3).acceleration[:, 1] ** 2
    assert once_a_turn > 0.3
    assert abs(np.mean(standing * np.exp(-1j * turn))) / np.mean(standing) < 0.1


@pytest.mark.parametrize("race", ["outer", "inner"])
def test_such_a_record_is_diagnosed_as_what_it_is(race: str) -> None:
    assert diagnose(simulated_record(SCENE.replace(race=race)), "6205").fault == f"{race} race"


def test_a_sweep_keeps_records_with_their_times(tmp_path: Path) -> None:
    settings = Settings(duration=0.1, sample_rate=8192.0)
    over = {"race": ["outer", "inner"], "extent": [0.0, 0.03]}
    dataset = sweep(SCENE, over, ["record_*"], settings=settings)
    assert dataset["record_y"].dims == ("race", "extent", "sample")
    np.testing.assert_array_equal(dataset["sample"], np.arange(819) / 8192.0)
    assert dataset["sample"].attrs["units"] == "s"
    alone = simulated_record(
        SCENE.replace(race="inner", extent=0.03), duration=0.1, sample_rate=8192.0
    )
    np.testing.assert_array_equal(dataset["record_x"][1, 1], alone.acceleration[:, 0])
    kept = sweep(SCENE, over, ["record_*"], settings=settings, store=tmp_path / "r.zarr")
    np.testing.assert_array_equal(kept["record_y"].values, dataset["record_y"].values)


def test_records_are_no_part_of_all_outputs_unless_they_are_asked_for() -> None:
    assert not any(OUTPUTS[name].per_sample for name in chosen_outputs("*"))
    assert chosen_outputs("record_*") == ("record_x", "record_y")
