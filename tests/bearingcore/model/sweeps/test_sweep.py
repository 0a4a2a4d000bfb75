"""Sweeps: the numbers of single scenes, and nothing lost or done twice whatever is killed."""

import errno
import hashlib
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from hypothesis import given, settings as hypothesis_settings, strategies as st

from bearingcore import Scene, modes, orbit, presets
from bearingcore.errors import FieldError
from bearingcore.model.statics._status import StaticStatus
from bearingcore.model.sweeps import (
    OUTPUTS,
    STATUSES,
    Grid,
    Settings,
    SweepStatus,
    _grid as grid_module,
    _store as stores,
    program_version,
    sweep,
)
from bearingcore.model.sweeps._status import OF_STATICS

RIG = presets["fan-rig"]
ANGULAR = presets["liew-lim"]
COARSE = Settings(cage_angles=13, duration=0.05)
STATIC = ("k_*", "loaded_balls_*", "ball_load_greatest", "converged_share")

LOADS = np.linspace(-200.0, -50.0, 60)
OVER = {"extent": np.linspace(0.0, 1.5, 20), "fy": LOADS}
FEW = ("k_yy_*", "loaded_balls_mean")
TASK = 20
"""Scenes in a task of OVER: 60 regions."""
FEW_SCENES = {"extent": [0.1, 0.2, 0.3], "fy": LOADS[:4]}


def code(name: str) -> int:
    return STATUSES.index(name)


# ------------------------------------------------------------------------------ numbers


@pytest.mark.parametrize(
    ("scene", "over"),
    [
        (RIG, {"extent": [0.3, 0.0, 9.0, 0.8], "fy": [-100.0, 0.0, 50.0]}),
        (RIG.replace(n_balls=2), {"depth": [0.0, 5e-5], "extent": [0.0, 0.2]}),
        (ANGULAR.replace(fx=0.0, fy=0.0), {"fz": [-300.0, 0.0, 300.0], "extent": [0.1, 0.2]}),
    ],
    ids=["some refused", "not carried", "thrust"],
)
def test_rows_of_extents_say_the_same_as_scene_after_scene(
    scene: Scene, over: dict[str, list[float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    grid = Grid.of(scene, over, (*STATIC, "band_*"), COARSE)
    assert grid.in_rows
    assert not Grid.of(scene, over, (*STATIC, "acceleration_rms_y"), COARSE).in_rows
    status, numbers = grid.compute()
    monkeypatch.setattr(Grid, "in_rows", False)
    other_status, other_numbers = grid.compute()
    np.testing.assert_array_equal(status, other_status)
    for name, values in numbers.items():
        scale = max(
            np.nanmax(np.abs(other_numbers[alike]), initial=0.0)
            for alike in numbers
            if OUTPUTS[alike].unit == OUTPUTS[name].unit
        )
        np.testing.assert_allclose(
            values, other_numbers[name], rtol=1e-8, atol=1e-11 * scale, err_msg=name
        )


def test_a_defect_that_turns_is_taken_over_all_turns_of_the_shaft() -> None:
    """Scene by scene, as positions depend on the extent; the same wherever the defect began."""
    over = {"extent": [0.0, 0.2], "center": [0.0, 1.7]}
    grid = Grid.of(RIG.replace(race="inner"), over, (*STATIC, "band_*"), Settings())
    assert not grid.in_rows
    assert not Grid.of(RIG.replace(race="inner", extent=0.0), over, STATIC, COARSE).in_rows
    status, numbers = grid.compute()
    assert (status == SweepStatus.COMPLETE.code).all()
    for name in ("k_xx_mean", "k_xx_least", "k_yy_greatest", "ball_load_greatest", "band_least"):
        first, second = np.moveaxis(numbers[name], 1, 0)
        np.testing.assert_allclose(first, second, rtol=2e-3, err_msg=name)


def test_bands_and_orbits_are_those_of_single_scenes() -> None:
    dataset = sweep(RIG, {"shaft_speed": [40.0, 60.0]}, ("band_*", "floquet_*"))
    for speed in (40.0, 60.0):
        scene, at = RIG.replace(shaft_speed=speed), dataset.sel(shaft_speed=speed)
        single = modes(scene)
        for label, undamped in zip(single.label, single.undamped_frequency.T, strict=True):
            assert at["band_least"].sel(mode=label) == pytest.approx(undamped.min(), rel=1e-10)
            assert at["band_greatest"].sel(mode=label) == pytest.approx(undamped.max(), rel=1e-10)
        multiplier = orbit(scene).largest_multiplier
        assert at["floquet_multiplier_greatest"] == pytest.approx(multiplier, rel=1e-9)


def test_what_of_a_life_is_not_known_is_no_number() -> None:
    over = {"fy": [-1000.0, 0.0], "shaft_speed": [0.0, 50.0]}
    settings = Settings(dynamic_load_rating=19_500.0)
    dataset = sweep(presets["6206"], over, ("life_*", "contact_pressure_*"), settings=settings)
    stands = dataset.sel(fy=-1000.0, shaft_speed=0.0)
    assert np.isnan(stands["life_hours"])
    assert np.isfinite(stands["life_turns"])
    assert stands["status"] == code("computation_refused")
    floats = dataset.sel(fy=0.0, shaft_speed=50.0)
    assert np.isnan(floats["life_turns"])
    assert floats["status"] == code("nothing_touches")


def test_failures_are_data() -> None:
    assert set(OF_STATICS) == set(StaticStatus) - {StaticStatus.NOT_COMPUTED}
    assert STATUSES[0] is SweepStatus.NOT_COMPUTED, "what an empty file says"
    over = {"shaft_speed": [0.0, 50.0], "extent": [0.2, 7.0], "fy": [-100.0, 0.0]}
    dataset = sweep(RIG, over, ["k_yy_mean", "acceleration_rms_y"], settings=COARSE)
    status = dataset["status"].sel(extent=0.2, fy=-100.0)
    assert status.values.tolist() == [code("computation_refused"), code("complete")]
    stands = dataset.sel(shaft_speed=0.0, extent=0.2, fy=-100.0)
    assert np.isfinite(stands["k_yy_mean"])
    assert np.isnan(stands["acceleration_rms_y"])
    assert (dataset["status"].sel(extent=7.0) == code("scene_refused")).all()
    assert np.isnan(dataset["k_yy_mean"].sel(extent=7.0)).all()
    floats = dataset.sel(shaft_speed=50.0, extent=0.2, fy=0.0)
    assert floats["status"] == code("nothing_touches")
    assert np.isnan(floats["k_yy_mean"])


def test_directions_appear_where_some_scene_needs_them() -> None:
    rig = RIG.replace(dofs="tilt free")
    dataset = sweep(rig, {"fz": [0.0, 40.0]}, ["band_least"], settings=COARSE)
    flat, pushed = dataset["band_least"].sel(fz=0.0), dataset["band_least"].sel(fz=40.0)
    assert dataset["mode"].values.tolist()[:2] == ["x1", "x2"]
    assert dataset.sizes["mode"] == 10
    known = [str(label) for label in flat["mode"].values[np.isfinite(flat)]]
    assert sorted(known) == sorted(modes(RIG).label)
    assert np.isfinite(pushed).sum() > 4


# ------------------------------------------------------------------------------ the Dataset


def test_the_dataset_says_what_it_is() -> None:
    dataset = sweep(RIG, {"extent": [0.1, 0.2], "n_balls": [10, 14]}, STATIC)
    assert Scene.from_toml(dataset.attrs["scene"]) == RIG
    assert dataset["extent"].attrs["units"] == "rad"
    assert dataset["n_balls"].dtype.kind == "i"
    assert dataset["k_rxry_greatest"].attrs["units"] == "N·m/rad"
    assert dataset["status"].attrs["flag_meanings"].split() == list(STATUSES)


@given(
    sizes=st.lists(st.integers(1, 40), min_size=1, max_size=4),
    scenes=st.one_of(st.none(), st.integers(1, 2000)),
    row=st.integers(0, 3),
)
@hypothesis_settings(max_examples=60, deadline=None)
def test_regions_cover_a_grid_once(sizes: list[int], scenes: int | None, row: int) -> None:
    names = ["fx", "fy", "fz", "mx"]
    if row < len(sizes):
        names[row] = "extent"
    over = {name: np.arange(1, n + 1) * 1e-3 for name, n in zip(names, sizes, strict=False)}
    grid = Grid.of(RIG, over, ["k_yy_mean"])
    shape = grid.region_shape(scenes)
    seen = np.zeros(grid.shape, dtype=int)
    for index in np.ndindex(*grid.region_counts(shape)):
        place = grid.region(shape, index)
        seen[place] += 1
        assert grid.part(place).size == seen[place].size
    assert (seen == 1).all()
    if scenes is not None:
        assert np.prod(shape) <= scenes


# ------------------------------------------------------------------------------ the store


def files_of(store: Path) -> dict[Path, tuple[int, int]]:
    """The chunks of all finished regions, with what changes when they are written again."""
    files = {}
    for mark in marks_of(store):
        index = mark.relative_to(store / "regions/finished/c")
        for chunk in store.glob("*/c"):
            file = chunk / index
            if file.is_file():
                files[file] = (file.stat().st_mtime_ns, file.stat().st_ino)
    return files


def marks_of(store: Path) -> list[Path]:
    folder = store / "regions/finished/c"
    return [file for file in folder.glob("*/*") if file.is_file() and "." not in file.name]


def until(is_so: Callable[[], bool], seconds: float = 300.0) -> None:
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.01)


@pytest.fixture(scope="module")
def reference() -> xarray.Dataset:
    return sweep(RIG, OVER, FEW, settings=COARSE, scenes_per_task=TASK)


@pytest.fixture(scope="module")
def finished_store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sweep") / "finished.zarr"
    sweep(RIG, FEW_SCENES, FEW, store=path, scenes_per_task=3)
    return path


def again(path: Path) -> xarray.Dataset:
    return sweep(RIG, FEW_SCENES, FEW, store=path)


@pytest.fixture
def copied(finished_store: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(finished_store, tmp_path / "copy.zarr"))


def test_a_store_holds_what_memory_would(reference: xarray.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "results.zarr"
    told: list[tuple[float, str]] = []
    dataset = sweep(
        RIG, OVER, FEW, store=path, settings=COARSE, scenes_per_task=TASK,
        progress=lambda part, words: told.append((part, words)),
    )  # fmt: skip
    xarray.testing.assert_equal(dataset.load(), reference)
    assert dataset.attrs == reference.attrs
    for name in reference.variables:
        assert dataset[name].attrs == reference[name].attrs
    assert [part for part, _ in told] == sorted(part for part, _ in told)
    assert told[-1] == (1.0, "1,200 of 1,200 scenes")
    assert len({part for part, _ in told if part > 0.0}) == 60, "each but those that waited"
    xarray.testing.assert_equal(xarray.open_zarr(path).load(), reference)


def test_words_and_modes_go_to_a_store_and_back(tmp_path: Path) -> None:
    over = {"edge": ["published", "exact"], "extent": [0.1, 0.2]}
    dataset = sweep(RIG, over, ["band_*"], store=tmp_path / "words.zarr", settings=COARSE)
    assert dataset["edge"].values.tolist() == ["published", "exact"]
    assert sorted(dataset["mode"].values.tolist()) == sorted(modes(RIG).label)
    xarray.testing.assert_allclose(dataset.load(), sweep(RIG, over, ["band_*"], settings=COARSE))


def test_nothing_finished_is_computed_again(copied: Path) -> None:
    before = files_of(copied)
    assert len(before) == 4 * 5  # regions times outputs and status
    told: list[str] = []
    sweep(RIG, FEW_SCENES, FEW, store=copied, progress=lambda _, words: told.append(words))
    assert files_of(copied) == before
    assert told[-1] == "12 of 12 scenes, 12 of them from before"


HARMS: dict[str, Callable[[Path], object]] = {
    "cut": lambda file: file.write_bytes(file.read_bytes()[:-5]),
    "empty": lambda file: file.write_bytes(b""),
    "removed": lambda file: file.unlink(),
    "another region's": lambda file: shutil.copyfile(file.parent / "1", file),
}


@pytest.mark.parametrize("harm", HARMS.values(), ids=HARMS)
@pytest.mark.parametrize("where", ["k_yy_mean/c", "regions/finished/c"])
def test_a_half_written_region_is_computed_again_and_no_other(
    copied: Path, harm: Callable[[Path], None], where: str
) -> None:
    whole = xarray.open_zarr(copied).load()
    before = files_of(copied)
    harmed = copied / where / "0/2"
    harm(harmed)
    healed = again(copied).load()
    xarray.testing.assert_identical(healed, whole)
    after = files_of(copied)
    assert after.keys() == before.keys()
    changed = {
        file.relative_to(copied).as_posix() for file in before if after[file] != before[file]
    }
    assert changed == {f"{name}/c/0/2" for name in whole.data_vars}


def test_a_mark_comes_after_all_numbers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is written last when a process dies, there is no mark before all the rest."""
    grid = Grid.of(RIG, {"extent": [0.1, 0.2], "fy": [-100.0]}, FEW, COARSE)
    path = tmp_path / "dies.zarr"
    shape = stores.prepare(path, grid, (1, 1))
    region = stores.region(path, grid, shape, (0, 0))

    def dies(*_: object) -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr(stores, "_checksum", dies)
    with pytest.raises(KeyboardInterrupt):
        stores.finish(region)
    monkeypatch.undo()
    assert len(list(path.glob("*/c/0/0"))) == 5
    assert marks_of(path) == []
    assert not stores.is_finished(region)
    assert stores.finish(region)
    assert stores.is_finished(region)


@pytest.mark.parametrize(
    ("scene", "over", "outputs", "settings", "words"),
    [
        (RIG.replace(depth=1e-4), {}, FEW, Settings(), "another scene"),
        (RIG, {}, FEW, COARSE, "settings"),
        (RIG, {}, ["k_yy_mean"], Settings(), "other outputs"),
        (RIG, {"fy": LOADS[1:5]}, FEW, Settings(), "other values of fy"),
        (RIG, {"fx": [0.0]}, FEW, Settings(), "other fields"),
    ],
)
def test_results_of_another_sweep_are_refused(
    finished_store: Path, scene: Scene, over: Any, outputs: Any, settings: Settings, words: str
) -> None:
    before = files_of(finished_store)
    with pytest.raises(ValueError, match=words):
        sweep(scene, FEW_SCENES | over, outputs, store=finished_store, settings=settings)
    assert files_of(finished_store) == before


def test_results_of_another_version_are_refused(
    finished_store: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stores, "program_version", lambda: "9.9")
    with pytest.raises(ValueError, match="results of version"):
        again(finished_store)


def test_other_sources_are_another_version() -> None:
    """A store that other code began is not resumed: numbers of two programs would be mixed."""
    version, _, digest = program_version().partition("+")
    assert version
    folder = Path(grid_module.__file__).parents[2]
    files = [path for path in sorted(folder.rglob("*")) if path.suffix in (".py", ".csv")]
    expected = hashlib.blake2b(digest_size=5)
    for file in files:
        expected.update(file.relative_to(folder).as_posix().encode() + b"\0" + file.read_bytes())
    assert digest == expected.hexdigest()
    assert len(files) > 100


def test_a_damaged_coordinate_names_the_folder_and_what_to_do(copied: Path) -> None:
    (chunk,) = (copied / "extent/c").iterdir()
    chunk.write_bytes(chunk.read_bytes()[:-3])
    with pytest.raises(ValueError, match="damaged in extent") as refused:
        again(copied)
    assert str(copied) in str(refused.value)
    assert "delete it" in str(refused.value)


def test_other_folders_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(ValueError, match="does not hold results of a sweep"):
        again(tmp_path)
    with pytest.raises(ValueError, match="does not hold results of a sweep"):
        again(tmp_path / "thesis.tex")
    assert [file.name for file in tmp_path.iterdir()] == ["thesis.tex"]
    with pytest.raises(ValueError, match="folder"):
        sweep(RIG, {"extent": [0.1]}, FEW, store="s3://bucket/results.zarr")
    for place in (tmp_path / "thesis.tex" / "results", "/proc/none/results", "a\0b", "x" * 300, 3):
        with pytest.raises(FieldError, match=r"store is .* allowed: a folder"):
            sweep(RIG, {"extent": [0.1]}, FEW, store=place)


# ------------------------------------------------------------------------------ killed


def dask_process(stack: ExitStack, *arguments: str) -> subprocess.Popen[bytes]:
    """A scheduler or a worker that ends with the test."""
    command = [sys.executable, "-m", *arguments]
    command += ["--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0"]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
    stack.callback(process.wait)
    stack.callback(process.kill)
    return process


class InBackground(threading.Thread):
    """A sweep that runs while the test kills what it runs on."""

    def __init__(self, store: Path, address: str) -> None:
        super().__init__(daemon=True)
        self.asked: dict[str, Any] = {"client": address, "store": store}
        self.error: BaseException | None = None
        self.start()

    def run(self) -> None:
        try:
            sweep(RIG, OVER, FEW, **self.asked, settings=COARSE, scenes_per_task=TASK)
        except BaseException as error:
            self.error = error


@pytest.mark.proof
def test_killed_workers_and_schedulers_lose_nothing(
    reference: xarray.Dataset, tmp_path: Path
) -> None:
    with ExitStack() as stack:
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        address = f"tcp://127.0.0.1:{port}"
        scheduler = dask_process(stack, "distributed.cli.dask_scheduler", "--port", str(port))
        workers = [
            dask_process(
                stack, "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny"
            )
            for _ in range(2)
        ]
        from distributed import Client

        with Client(address, set_as_default=False, timeout=300) as client:
            client.wait_for_workers(2, timeout=300)

        # a worker dies: the sweep comes to its end all the same
        first = tmp_path / "worker.zarr"
        running = InBackground(first, address)
        until(lambda: len(marks_of(first)) >= 5)
        workers[0].kill()
        done = files_of(first)
        assert 5 * 5 <= len(done) < 60 * 5
        running.join(300)
        assert running.error is None
        assert done.items() <= files_of(first).items()
        xarray.testing.assert_equal(xarray.open_zarr(first).load(), reference)

        # the scheduler dies: the sweep says so, and goes on elsewhere
        second = tmp_path / "scheduler.zarr"
        running = InBackground(second, address)
        until(lambda: len(marks_of(second)) >= 5)
        scheduler.kill()
        running.join(300)
        assert isinstance(running.error, ConnectionError)
        assert "is lost" in str(running.error)
    done = files_of(second)
    assert 5 * 5 <= len(done) < 60 * 5
    dataset = sweep(RIG, OVER, FEW, store=second, settings=COARSE)
    assert done.items() <= files_of(second).items()
    xarray.testing.assert_equal(dataset.load(), reference)


SCRIPT = f"""
import sys
import numpy as np
from bearingcore import presets
from bearingcore.model.sweeps import Settings, sweep
if __name__ == "__main__":
    sweep(
        presets["fan-rig"],
        {{"extent": np.linspace(0.0, 1.5, 20), "fy": np.linspace(-200.0, -50.0, 60)}},
        {FEW},
        store=sys.argv[1],
        settings=Settings(cage_angles=13, duration=0.05),
        workers=2,
        processes=True,
        scenes_per_task={TASK},
        progress=lambda part, words: print(words),
    )
"""


@pytest.mark.proof
def test_a_killed_program_goes_on_where_it_was(reference: xarray.Dataset, tmp_path: Path) -> None:
    file, out = tmp_path / "study.py", tmp_path / "results.zarr"
    file.write_text(SCRIPT)
    command = [sys.executable, str(file), str(out)]
    running = subprocess.Popen(command, start_new_session=True, stderr=subprocess.DEVNULL)
    try:
        until(lambda: len(marks_of(out)) >= 5)
    finally:
        os.killpg(running.pid, signal.SIGKILL)  # itself and its workers, as when the power fails
        running.wait()
    done = files_of(out)
    assert 5 * 5 <= len(done) < 60 * 5
    partial = xarray.open_zarr(out)["status"]
    assert (partial == code("not_computed")).any()
    second = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    assert second.returncode == 0, second.stderr
    last = second.stdout.splitlines()[-1]
    assert re.fullmatch(r"1,200 of 1,200 scenes, \d+ of them from before", last)
    assert int(re.findall(r"\d+", last)[-1]) >= 5 * TASK
    assert done.items() <= files_of(out).items()
    xarray.testing.assert_equal(xarray.open_zarr(out).load(), reference)


def test_a_scheduler_that_is_not_there_is_told() -> None:
    import dask

    with (
        dask.config.set({"distributed.comm.timeouts.connect": "500ms"}),
        pytest.raises(ConnectionError, match=r"no scheduler answers at tcp://127\.0\.0\.1:9"),
    ):
        sweep(RIG, {"extent": [0.1]}, FEW, client="tcp://127.0.0.1:9")


def test_a_worker_of_another_version_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    versions = iter(["0.1.0"])
    monkeypatch.setattr(
        "bearingcore.model.sweeps._run.program_version", lambda: next(versions, "another version")
    )
    with pytest.raises(ValueError, match="version of a worker"):
        sweep(RIG, {"extent": [0.1]}, FEW)


# ------------------------------------------------------------------------------ the extra

_WITHOUT = """
import sys
from bearingcore import presets, equilibrium
from bearingcore.model.sweeps import sweep
for name in ("xarray", "dask", "distributed", "zarr", "pandas"):
    assert name not in sys.modules, name
    sys.modules[name] = None
assert equilibrium(presets["fan-rig"], [0.0]).converged.all()
try:
    sweep(presets["fan-rig"], {"extent": [0.1]}, ["k_yy_mean"])
except ImportError as error:
    print(error)
"""


def test_without_the_extra_the_rest_works_and_sweeps_name_it() -> None:
    told = subprocess.run([sys.executable, "-c", _WITHOUT], capture_output=True, text=True)
    assert told.returncode == 0, told.stderr
    assert 'pip install "bearing-explorer[scale]"' in told.stdout


def test_a_full_disk_is_said_in_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def full(region: object, progress: object) -> bool:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(stores, "finish", full)
    with pytest.raises(OSError, match=r"the disk is full\. What is finished is kept") as refusal:
        sweep(presets["fan-rig"], {"fy": [-50.0, -100.0]}, ["k_xx_mean"], store=tmp_path / "r")
    assert refusal.value.filename == str(tmp_path / "r")
    said = capfd.readouterr()
    assert "Traceback" not in said.err + said.out
    assert "Compute Failed" not in said.err + said.out


@pytest.mark.parametrize("over", [{"extent": [0.1, 0.2]}, {"fx": [0.0]}], ids=["row", "single"])
def test_what_nothing_carries_has_no_numbers(over: dict[str, list[float]]) -> None:
    two_balls = RIG.replace(n_balls=2)  # the ring slips off sideways
    dataset = sweep(two_balls, over, STATIC, settings=COARSE)
    assert (dataset["status"] == code("load_not_carried")).all()
    assert (dataset["converged_share"] == 0.0).all()
    for name in dataset.data_vars:
        if name not in ("status", "converged_share"):
            assert np.isnan(dataset[name]).all(), name
