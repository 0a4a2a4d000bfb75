"""The lines of Python that views export run as they stand, and give the numbers of the view.

All of them run in one fresh interpreter, each in a namespace of its own.
"""

import ast
import dataclasses
import os
import pickle
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bearing_explorer.diagnosis.form import read_form
from bearing_explorer.diagnosis.reading import read_file
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import Reference
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View
from bearing_explorer.kit.views.python_lines import FILE, scene_code
from bearing_explorer.page import SECTIONS
from scipy.io import wavfile

from bearingcore import Defect, MeasuredFloor, RoughFloor, Scene, presets, scene_of
from tests.helpers.measuring import at, measuring, signal
from tests.helpers.saved import saved
from tests.helpers.timing import measure_once

FAN_RIG = presets["fan-rig"].replace(extent=np.radians(38.6), fy=-120.0, contact_damping=130.0)
COMPARED = [
    Reference(presets["fan-rig"].replace(n_balls=11), 'a "name"'),
    Reference(presets["liew-lim"], "another"),
]
TWO = (Defect(0.3, 50e-6, 4.7), Defect(0.2, 30e-6, 1.0, floor=RoughFloor(2e-6, 2e-4)))
HEAVY = presets["7208-25deg"].replace(shaft_speed=1500.0, balls="with mass")
SCENES: dict[str, tuple[Scene, float, list[Reference]]] = {
    "dragged": (FAN_RIG, 0.1, []),
    "compared": (FAN_RIG, 0.0, COMPARED),
    "inner race": (presets["6205"].replace(race="inner", extent=0.1), 5.0, []),
    "two defects": (presets["liew-lim"].replace(defect=TWO), 0.05, []),
    "balls with mass": (HEAVY, 0.05, []),
}
VIEWS = {view.name: view for section in SECTIONS for view in section.views}
PLANE = {"x": "extent_deg", "x_from": "10", "x_to": "40", "y": "shaft_speed_hz", "y_from": "8",
         "y_to": "12", "grid": "8"}  # fmt: skip
CHOICES: dict[str, dict[str, Any]] = {
    "explore": PLANE | {"output": "k_xx_mean"},
    "speed-run": {"from": "7", "to": "9", "count": "25"},
    "accuracy": {"experiment": "statics"},
    "diagnosis": {"speed": "rough"},
    "measured-spectrum": {"direction": "x", "scale": "linear"},
    "measured-envelope": {"low": "400", "high": "3000"},
}
CASES = [
    *(("dragged", name) for name in VIEWS),
    *(("compared", name) for name in ("load-distribution", "stiffness", "vibration-spectrum")),
    *(("two defects", name) for name in ("depth-profile", "maps", "vibration-time")),
    *(("inner race", name) for name in ("load-distribution", "modes", "vibration-spectrum")),
    *(("balls with mass", name) for name in ("bearing", "stiffness")),
]
RECORDED = 'it\'s "a" file.wav'


@cache
def recorded() -> tuple[bytes, Measured]:
    """A file with a signal of 2 s, and what the page has read in it."""
    acceleration = signal().recording.acceleration[: 2 * 25_600]
    file = saved(wavfile.write, 25_600, acceleration.astype(np.float32))
    read = read_file(RECORDED, file, at(presets["fan-rig"]))
    asked = read_form(
        read.table, {**read.form, "columns": "x;y", "unit": "m/s²"}, at(presets["fan-rig"])
    )
    machine = at(presets["fan-rig"])
    return file, Measured(asked.recording, machine, origin=asked.origin)


@cache
def shown(case: tuple[str, str]) -> tuple[View, Results]:
    """A view with all that it shows, as it is when its lines are asked for."""
    name = case[1]
    scene, cage_angle, compared = SCENES[case[0]]
    choices = CHOICES.get(name, {})
    results = Results(scene, cage_angle, compared=compared)
    view = VIEWS[name](PackedSource())
    if isinstance(view, MeasuredView):
        results = Results(presets["fan-rig"])
        view.measure(measuring(recorded()[1]))
    if choices or view.computes:
        view.choose(choices, results)
    view.say(results, view.sentence(results))
    return view, results


RUN = """
import pickle, sys, webbrowser
from bearingcore.model.experiments._points import least_time
least_time.__kwdefaults__["budget"] = 0.0  # work is not repeated for the sake of its time
webbrowser.open = lambda address: True
with open("scripts", "rb") as file:
    scripts = pickle.load(file)
for key, lines in scripts.items():
    namespace = {}
    try:
        exec(compile(lines, str(key), "exec"), namespace)
    except Exception as error:
        scripts[key] = f"{type(error).__name__}: {error}\\n{lines}"
    else:
        scripts[key] = namespace["scene"], namespace["columns"]
with open("made", "wb") as file:
    pickle.dump(scripts, file)
"""


def made_by_the_lines(folder: Path) -> dict[tuple[str, str], Any]:
    """Return the scene and the columns that the lines of each case make, or why they failed."""
    (folder / RECORDED).write_bytes(recorded()[0])
    scripts = {case: shown(case)[0].python() for case in CASES}
    (folder / "scripts").write_bytes(pickle.dumps(scripts))
    paths = os.pathsep.join(path for path in sys.path if path)
    subprocess.run(
        [sys.executable, "-c", RUN],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": paths, "TMPDIR": str(folder)},
        check=True,
        timeout=600,
    )
    return pickle.loads((folder / "made").read_bytes())


MEASURED_ANEW = {"accuracy": ("time_s",), "alternatives": ("time_s", "own_time_s")}
"""Columns that say how long something took."""


@pytest.mark.proof
def test_the_lines_give_the_numbers_of_the_view(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One test for all cases: parallel processes would each run all of the lines.

    They are few, and import the program alone.
    """
    measure_once(monkeypatch)
    made = made_by_the_lines(tmp_path)
    assert [lines for lines in made.values() if isinstance(lines, str)] == []
    for case, (scene, columns) in made.items():
        view, results = shown(case)
        lines = view.python()
        assert lines.count("\n") <= 30 or "from_toml" in lines, case
        assert modules_in(lines) <= {
            "bearing_explorer",
            "bearingcore",
            "dataclasses",
            "pathlib",
            "math",
        }, case
        assert scene == view.scene_drawn(results), case
        table = view.table(results)
        assert list(columns) == list(table), case
        for name in table.keys() - set(MEASURED_ANEW.get(case[1], ())):
            values, at = table[name], f"{case}: {name}"
            if np.asarray(values).dtype.kind == "f":
                near = 1e-9 * np.nanmax(np.abs(values), initial=1e-300)
                np.testing.assert_allclose(columns[name], values, rtol=1e-6, atol=near, err_msg=at)
            else:
                np.testing.assert_array_equal(columns[name], values, err_msg=at)


def modules_in(lines: str) -> set[str]:
    """Packages that lines of Python import from; `import math` is the only other way."""
    nodes = list(ast.walk(ast.parse(lines)))
    imported = {
        alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names
    }
    sources = {str(node.module) for node in nodes if isinstance(node, ast.ImportFrom)}
    return {name.partition(".")[0] for name in imported | sources}


@pytest.mark.parametrize("name", sorted(CHOICES.keys() - {"accuracy"}))  # which is shipped
def test_before_anything_is_computed_the_lines_say_so(name: str) -> None:
    view = VIEWS[name](PackedSource())
    view.say(Results(presets["fan-rig"]), "")
    lines = view.python()
    assert "#" in lines
    exec(compile(lines, name, "exec"), {})


@pytest.mark.parametrize(
    "scene",
    [
        *presets.values(),
        FAN_RIG,
        presets["6205"].replace(ball_diameter=8e-3),
        presets["6205"].replace(
            bearing=dataclasses.replace(presets["6205"].bearing, load_deflection_factor=9e9)
        ),
        presets["7208-25deg"].replace(
            dofs="tilt free", contact_law="no tension", contact_damping=None
        ),
        presets["fan-rig"].replace(
            floor=MeasuredFloor((-1.0, 0.1, 1.0), (0.0, 1.0, 0.25)), extent=1 / 3
        ),
        SCENES["two defects"][0],
    ],
)
def test_every_scene_can_be_written_in_python(scene: Scene) -> None:
    import math

    code = scene_code(scene)
    names = {"math": math, "presets": presets, "Scene": Scene, "scene_of": scene_of}
    assert eval(code, names) == scene


@pytest.mark.parametrize(
    ("code", "scene"),
    [
        ('scene_of("6208")', scene_of("6208")),
        ('scene_of("7208 B").replace(fy=-1000.0)', scene_of("7208 B").replace(fy=-1000.0)),
        ('scene_of("6208/C3")', scene_of("6208/C3")),
        ('scene_of("209, Harris")', scene_of("209, Harris")),
    ],
)
def test_a_bearing_by_its_number_is_written_so(code: str, scene: Scene) -> None:
    assert scene_code(scene) == code


def test_a_long_floor_comes_from_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    floor = MeasuredFloor(tuple(np.linspace(-1, 1, 500)), (0.5,) * 500)
    scene = presets["fan-rig"].replace(floor=floor)
    code = scene_code(scene)
    assert len(code) < 200
    (tmp_path / FILE).write_text(scene.to_toml())
    monkeypatch.chdir(tmp_path)
    assert eval(code, {"Path": Path, "Scene": Scene}) == scene
