"""The lines of Python beside a figure run as they stand and give its numbers."""

import ast
import dataclasses
import re
import sys
import tomllib
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from bearing_explorer.export.python_lines import lines_of
from bearing_explorer.export.python_script import FILE
from bearing_explorer.page import SECTIONS
from bearing_explorer.results.results import Results
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.state.reference import Reference
from bearing_explorer.views.base import View
from bearing_explorer.views.stability_map import OrbitStability

from bearingcore import Defect, MeasuredFloor, RoughFloor, presets
from tests.helpers.stability import found_map

mpl.use("agg")

FAN_RIG = presets["fan-rig"].replace(extent=np.radians(38.6), fy=-120.0, contact_damping=130.0)
SCENES = {
    "dragged": (FAN_RIG, 0.1, None),
    "inner race": (presets["6205"].replace(race="inner", extent=0.1), 5.0, None),
    "two defects": (
        presets["liew-lim"].replace(
            defect=(Defect(0.3, 50e-6, 4.7), Defect(0.2, 30e-6, 1.0, floor=RoughFloor(2e-6, 2e-4)))
        ),
        0.05,
        None,
    ),
    "balls with mass": (
        presets["7208-25deg"].replace(shaft_speed=1500.0, balls="with mass"),
        0.05,
        None,
    ),
    "pinned": (FAN_RIG, 0.0, Reference(presets["fan-rig"].replace(n_balls=11, depth=9e-6), "x")),
}
VIEWS = {
    view.name: view
    for section in SECTIONS
    for view in section.views
    if view.name
    in ("bearing", "load-distribution", "depth-profile", "stiffness", "maps", "modes", "orbit",
        "vibration-time", "vibration-spectrum", "mass-time", "mass-spectrum", "mechanism")
}  # fmt: skip


def run(lines: str, monkeypatch: pytest.MonkeyPatch) -> dict:
    monkeypatch.setattr("matplotlib.pyplot.show", lambda: None)
    namespace: dict = {}
    exec(compile(lines, "<lines>", "exec"), namespace)
    mpl.pyplot.close("all")
    return namespace


def compare(name: str, table: dict[str, np.ndarray], columns: dict[str, np.ndarray]) -> None:
    assert set(columns) <= set(table)
    assert len(columns) >= 2
    if name == "load-distribution":  # which keeps one ball where two stood, or the most of many
        for kind in {key.removesuffix("ball_load_n") for key in columns if "load" in key}:
            angle, load = (table[f"{kind}{what}"] for what in ("ball_angle_deg", "ball_load_n"))
            ours = columns[f"{kind}ball_angle_deg"], columns[f"{kind}ball_load_n"]
            order = np.argsort(ours[0])
            assert load.max() == pytest.approx(ours[1].max())
            if angle.size != 720:
                at = np.interp(ours[0][order], angle, np.arange(angle.size))
                near = np.abs(at - np.round(at)) < 1e-6
                assert near.mean() > 0.99
                rows = np.round(at[near]).astype(int)
                same = np.isclose(load[rows], ours[1][order][near], rtol=1e-9, atol=1e-9)
                assert same.mean() > 0.98, "all but where two balls meet at a step"
        return
    if name == "depth-profile":  # which has more points at the walls
        rows = np.searchsorted(table["angle_deg"], columns["angle_deg"] - 1e-9)
        table = {key: values[np.minimum(rows, values.size - 1)] for key, values in table.items()}
    for key, values in columns.items():
        assert np.shape(values) == np.shape(table[key]), key
        if np.asarray(values).dtype.kind == "U":
            assert (values == table[key]).all()
        else:
            scale = np.nanmax(np.abs(values), initial=1e-300)
            np.testing.assert_allclose(
                values, table[key], rtol=1e-7, atol=1e-9 * scale, err_msg=key
            )


CASES = [
    *(("dragged", name, False) for name in VIEWS),
    *(("dragged", name, True) for name in VIEWS if VIEWS[name].plans),
    *(("pinned", name, False) for name in ("load-distribution", "stiffness", "vibration-spectrum")),
    *(("two defects", name, False) for name in ("depth-profile", "maps", "vibration-time")),
    *(("inner race", name, False) for name in ("load-distribution", "depth-profile", "modes")),
    ("inner race", "vibration-spectrum", True),
    *(("balls with mass", name, False) for name in ("bearing", "load-distribution", "stiffness")),
]


@pytest.mark.parametrize(("scene", "name", "planned"), CASES)
def test_the_lines_give_the_numbers_of_the_figure(
    scene: str, name: str, planned: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown, cage_angle, pinned = SCENES[scene]
    plans = VIEWS[name].plans[:1] if planned else ()
    results = Results(shown, cage_angle, planned=plans, pinned=pinned)
    view: View = VIEWS[name](PackedSource())
    lines = lines_of(view, results)
    namespace = run(lines, monkeypatch)
    assert namespace["scene"] == shown
    compare(name, view.table(results), namespace["columns"])
    assert max(map(len, lines.splitlines())) <= 100
    assert "app" not in lines.replace("append", "").split()


@pytest.mark.parametrize("view", [v for s in SECTIONS for v in s.views], ids=lambda v: v.name)
def test_every_view_has_lines_that_run(view: type[View], monkeypatch: pytest.MonkeyPatch) -> None:
    lines = lines_of(view(PackedSource()), Results(presets["fan-rig"], 0.1))
    assert 'presets["fan-rig"]' in lines
    if view.name not in VIEWS:
        assert run(lines, monkeypatch)["scene"] == presets["fan-rig"]


def installed() -> set[str]:
    """What the README's install brings, by the names of imports."""
    project = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text())["project"]
    names = {re.split(r"[<>=\[]", one)[0] for one in project["dependencies"]}
    return {*names, *sys.stdlib_module_names, "bearingcore", "bearing_explorer"}


@pytest.mark.parametrize("view", [v for s in SECTIONS for v in s.views], ids=lambda v: v.name)
def test_lines_import_what_is_installed_or_say_how_to_get_it(view: type[View]) -> None:
    lines = lines_of(view(PackedSource()), Results(presets["fan-rig"], 0.1))
    told = " ".join(line for line in lines.splitlines() if line.startswith("# beside"))
    for node in ast.walk(ast.parse(lines)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = [node.module] if isinstance(node, ast.ImportFrom) else [
                alias.name for alias in node.names
            ]  # fmt: skip
            for name in names:
                assert name is not None
                assert name.partition(".")[0] in installed() or name.partition(".")[0] in told
                assert not name.startswith("bearingcore.sweep") or "[scale]" in told


def test_what_a_job_found_is_made_again(monkeypatch: pytest.MonkeyPatch) -> None:
    view = OrbitStability(PackedSource())
    view.found = found_map()
    namespace = run(lines_of(view, Results(presets["6205"])), monkeypatch)
    assert namespace["scene"] == view.found.map.scene
    np.testing.assert_allclose(
        namespace["columns"]["largest_multiplier"], view.found.map.multiplier.ravel(), rtol=1e-9
    )


@pytest.mark.parametrize(
    "scene",
    [
        *presets.values(),
        presets["6205"].replace(ball_diameter=8e-3),
        presets["6205"].replace(
            bearing=dataclasses.replace(presets["6205"].bearing, load_deflection_factor=9e9)
        ),
        presets["7208-25deg"].replace(dofs=None, contact_law="no tension", contact_damping=None),
        presets["fan-rig"].replace(
            floor=MeasuredFloor((-1.0, 0.1, 1.0), (0.0, 1.0, 0.25)), extent=1 / 3
        ),
    ],
)
def test_every_scene_can_be_said_in_python(
    scene, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    from bearing_explorer.views.model_editor import ModelEditor

    assert run(lines_of(ModelEditor(PackedSource()), Results(scene)), monkeypatch)["scene"] == scene


def test_a_long_floor_comes_from_a_file() -> None:
    n = 500
    floor = MeasuredFloor(tuple(np.linspace(-1, 1, n)), (0.5,) * n)
    scene = presets["fan-rig"].replace(floor=floor)
    lines = lines_of(VIEWS["bearing"](PackedSource()), Results(scene))
    assert FILE in lines
    assert len(lines) < 2000


@pytest.mark.parametrize("name", ["bearing", "load-distribution"])
def test_rows_that_are_not_alike(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    pair = presets["7208-back-to-back"]
    low, high = pair.bearing.rows
    rows = (low, dataclasses.replace(high, n_balls=11, contact_angle=0.7, turn=0.1))
    scene = pair.replace(bearing=pair.bearing.replace(rows=rows))
    results, view = Results(scene, 0.2), VIEWS[name](PackedSource())
    lines = lines_of(view, results)
    assert "Row(" in lines
    namespace = run(lines, monkeypatch)
    assert namespace["scene"] == scene
    compare(name, view.table(results), namespace["columns"])
