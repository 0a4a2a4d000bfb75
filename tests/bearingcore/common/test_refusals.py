"""What cannot be is refused before anything is computed: the field, its value and what is allowed.

A refusal a line: what is asked, and what is said. A value of a wrong type is a TypeError too. A
refusal that takes more than a call stands with its part. What has no answer is no bad input: it
comes back as a status, never as an exception and never as a number.
"""

import copy
import dataclasses
import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

import bearingcore as core
from bearingcore import DOF_NAMES, Defect, Scene, contact_damping, equilibrium, modes, simulate
from bearingcore.bearings import Row, bearing_of, bearing_of_frequencies
from bearingcore.bearings._hertz import race_contact
from bearingcore.common import LARGEST_TEXT, _checks as checks
from bearingcore.errors import FieldError
from bearingcore.measured.files._text import read_text
from bearingcore.measured.signals import order_map, severity_zone, spectrogram
from bearingcore.model import _kernels as kernels
from bearingcore.model.dynamics import speed_run, to_ross
from bearingcore.model.dynamics._problem import motion_problem
from bearingcore.model.experiments._motions import motion_experiment
from bearingcore.model.experiments._statics import statics_experiment
from bearingcore.model.statics import ball_drop
from bearingcore.model.sweeps import sweep
from bearingcore.sizing import read_floor
from tests.helpers.judge import verdict
from tests.helpers.saved import matlab

NAN, INF = math.nan, math.inf
DRAWN, RIG, LIEW_LIM = (core.presets[name] for name in ("6205", "fan-rig", "liew-lim"))
"""One that is drawn, and two whose grooves are not known."""
OTHER_STATE = core.equilibrium(core.presets["6206"])
MOTOR, PAIR = DRAWN.bearing, core.presets["7208-back-to-back"].bearing
HEALTHY, STILL = DRAWN.healthy(), RIG.replace(shaft_speed=0.0)
RNG = np.random.default_rng(5)
NOISE = core.Recording(RNG.standard_normal((12_000, 1)), 12_000.0, ("y",))
TWO = RNG.standard_normal((3000, 2))
TIME = np.arange(48_000) / 6000.0

oil = partial(core.film, DRAWN, viscosity=0.02, pressure_viscosity=2e-8)
record = partial(core.Recording, sample_rate=12_800.0, directions=("x", "y"))
contact = partial(race_contact, contact_angle=0.0, youngs_modulus=210e9, poisson=0.3)
envelope = partial(core.envelope_spectrum, np.zeros(1000), 20_000.0)
diagnosis = partial(core.diagnose, NOISE, MOTOR)
extent = partial(core.measure_extent, NOISE, MOTOR, 94.0)
lasts = partial(core.life, core.presets["6206"])
maps = partial(core.stiffness_maps, RIG)
parts = partial(bearing_of_frequencies, pitch_diameter=0.04)
moved = partial(core.simulate, RIG)
TABLE = b"time,x,y\n" + "".join(f"{k / 8e3},{x},{y}\n" for k, (x, y) in enumerate(TWO)).encode()
NUMBERS = core.presets["fan-rig"].to_data()


def text(content: str) -> object:
    return read_text("t", content.encode(), most_numbers=10**6, most_columns=20)


def taken(*asked: object) -> core.Recording:
    return core.read_table("a.csv", TABLE).recording(*asked)


def swept(over: Any = None, outputs: Any = ("k_yy_*",), **more: Any) -> object:
    return sweep(RIG, {"extent": [0.1]} if over is None else over, outputs, **more)


def nested(depth: int) -> dict[str, object]:
    """Structs inside one another."""
    return {"s": nested(depth - 1)} if depth else {"a": TWO}


def data(part: str = "", **changes: object) -> core.Scene:
    """The scene of a file in which a part, or the whole, says something else."""
    whole = copy.deepcopy(NUMBERS)
    (whole["defect"][0] if part == "defect" else whole[part] if part else whole).update(changes)
    return core.Scene.from_data(whole)


REFUSED: dict[str, list[tuple[Callable[[], object], str]]] = {
    "rows": [
        (lambda: Row(facing=0), "facing of a row is 0; allowed: 1 or -1"),
        (lambda: Row(place=INF), "place of a row"),
        *((lambda angle=angle: Row(contact_angle=angle), "contact_angle of a row")
          for angle in (-0.1, 2.0, NAN, "steep")),
        (lambda: Row(clearance=1.0), "clearance of a row"),
        (lambda: PAIR.replace(rows=(Row(), Row(n_balls=40))), "row 2: n_balls is 40"),
        (lambda: PAIR.replace(rows=(Row(), Row(ball_diameter=0.07))), "row 2: ball_diameter is 0"),
        (lambda: PAIR.replace(rows=(Row(), Row(inner_groove_radius=5e-3))), "row 2: inner_groove"),
        (lambda: PAIR.replace(row_distance=-1.0), "row_distance is -1; allowed: a finite"),
        (lambda: core.presets["7208-tandem"].replace(preload_force=1.0), "preload_force is 1; a"),
    ],
    "kinds": [
        (lambda: dataclasses.replace(MOTOR, kind="thrust"), "kind is 'thrust'"),
        (lambda: dataclasses.replace(MOTOR, kind="rows"), "^(number of )?rows "),
        (lambda: dataclasses.replace(MOTOR, kind="self-aligning"), "^(number of )?rows "),
        (lambda: dataclasses.replace(MOTOR, kind="roller"), "^roller_length "),
        (lambda: core.presets["nu208"].bearing.replace(roller_length=None), "^roller_length "),
        *((lambda name=name: core.presets[name].bearing.replace(roller_length=0.01),
           "^roller_length is 0.01") for name in ("fan-rig", "1208")),
    ],
    "drawings": [
        (lambda: contact("inner", 11.5e-3, 43.5e-3, 5.7e-3), r"inner_groove_radius is 0.0057; .*"),
        (lambda: contact("outer", 11.5e-3, 43.5e-3, 30e-3), r"is 0.03; .*below 0.0275 m"),
        (lambda: RIG.bearing.replace(radial_clearance=60e-6).free_contact_angle,
         r"radial_clearance is 6e-05; allowed: at most 5e-05 m"),
        (lambda: RIG.bearing.replace(inner_groove_radius=4.2e-3), "outer_groove_radius is None"),
    ],
    "frequencies of parts": [
        (lambda: parts({}), "BPFO and BPFI"),
        (lambda: parts({"bpfo": 3.2}), "BPFO and BPFI"),
        (lambda: parts({"bpfo": 3.2, "bpfi": 5.3}), "nearly a whole number"),
        (lambda: parts({"bpfo": 4.8, "bpfi": 3.2}), "more than BPFO"),
        (lambda: parts({"bpfo": 0.2, "bpfi": 0.4}), "nearly a whole number"),
        (lambda: parts({"bpfo": NAN, "bpfi": 4.8}), "finite"),
    ],
    "designations": [
        *((lambda text=text: core.read_designation(text), "is the number of another")
          for text in ("6205 6206", "6205-2RS1/6206", "6205, NU 206")),
        *((lambda text=text: core.read_designation(text), "allowed: a bearing of the series")
          for text in ("HK 1210", "NA 6904", "CSK 6205")),
        *((lambda text=text: core.read_designation(text), "302, 303, 320, 322, 323")
          for text in ("32206 B", "30308DJR", "30206 C", "HR6208")),
    ],
    "floors": [
        (lambda: read_floor("1 2\n3 x\n"), "line 2"),
        (lambda: read_floor("1 2 3\n4 5 6\n"), "number of columns in the floor is 3"),
        (lambda: read_floor("1 2\n1 3\n"), "different angles"),
        (lambda: read_floor("1 -2\n2 -3\n"), "into the ring"),
        (lambda: read_floor("1 0\n2 0\n"), "not 0 everywhere"),
        (lambda: read_floor("0 1\n400 1\n"), "within one turn"),
        (lambda: RIG.replace(defect=(core.Defect(0.2, 5e-5, 0.0),
                                     core.Defect(0.2, 5e-5, 0.1, edge="exact"))),
         "run into one another"),
    ],
    "depths of defects": [
        (lambda: Defect(1.0, 5e-3, 0.0).path(0.0, LIEW_LIM.bearing), "^depth is 0.005; "),
        (lambda: LIEW_LIM.replace(defect=(LIEW_LIM.defect, Defect(0.1, 4e-3, 0.0))),
         "^depth is 0.004; "),
    ],
    "maps": [
        (lambda: ball_drop(RIG, 0.0, race="middle"), "race is 'middle'; allowed: outer, inner"),
        (lambda: maps(extents=[-0.1]), "extents"),
        (lambda: maps(extents=[NAN]), "extents"),
        (lambda: maps(extents=[7.0]), "extents"),
        (lambda: maps(cage_angles=[INF]), "cage_angles"),
        (lambda: maps(dofs=("x", "q")), "dofs"),
    ],
    "film, pressure and life": [
        (lambda: oil(viscosity=0.0), "viscosity"),
        (lambda: oil(pressure_viscosity=-1.0), "pressure_viscosity"),
        (lambda: oil(roughness_ball=NAN), "roughness_ball"),
        (lambda: oil(roughness_ball=0.0, roughness_inner=0.0), "roughness_inner"),
        (lambda: core.film(RIG, viscosity=0.02, pressure_viscosity=2e-8), "inner_groove_radius"),
        (lambda: oil(state=OTHER_STATE), "state"),
        (lambda: core.contact_pressures(RIG), "inner_groove_radius"),
        (lambda: core.contact_pressures(DRAWN, OTHER_STATE), "state"),
        (lambda: core.life(LIEW_LIM, 36e3), "inner_groove_radius"),
        (lambda: lasts(0.0), "dynamic_load_rating"),
        (lambda: lasts(14e3, positions="load line"), "positions"),
        (lambda: lasts(14e3, positions="some"), "positions"),
    ],
    "limits": [
        (lambda: core.limits(HEALTHY, step_rate=0.0), "step_rate is 0; "),
    ],
    "motions": [
        (lambda: core.orbit(RIG.replace(balls="with mass")), "massless"),
        (lambda: core.orbit(RIG.replace(contact_law="no tension")), "^contact_law is 'no tension"),
        (lambda: core.orbit(STILL), "shaft_speed"),
        (lambda: core.orbit(RIG).spectrum(duration=1e9), "^duration is"),
        (lambda: core.orbit(RIG).spectrum(resolution=1e-6), "^resolution is"),
        (lambda: speed_run(RIG, [0.0, 10.0]), "shaft_speeds"),
        (lambda: speed_run(RIG, [260.0], duration=1e9), "^duration is"),
        (lambda: speed_run(RIG, [260.0], resolution=1e-6), "^resolution is"),
        (lambda: core.simulated_record(DRAWN.replace(shaft_speed=0.0)), "shaft_speed is 0"),
    ],
    "samples and steps of motions": [
        (lambda: simulate(STILL, 0.01), "^shaft_speed is 0; .*above 0"),
        (lambda: moved(0.0), "^duration is 0; .*above 0"),
        (lambda: moved(INF), "^duration is inf; .*finite"),
        (lambda: moved(1e6, 65536.0), r"^duration is 1e\+06; .*sample_rate"),
        (lambda: moved(0.01, 0.0), "^sample_rate is 0; .*above 0"),
        (lambda: moved(0.01, 65536.0, step_rate=0.0), "^step_rate is 0; .*above 0"),
        (lambda: moved(0.01, 65536.0, step_rate=98304.0), "^step_rate is 98304; .*whole fraction"),
        (lambda: moved(0.01, 65536.0, step_rate=26214.4), "^step_rate is 26214.4; .*whole fract"),
    ],
    "sweeps": [
        (lambda: swept({}), "over is"),
        (lambda: swept({"extend": [0.1]}), "extend"),
        (lambda: swept({"extent": []}), "number of values of extent"),
        (lambda: swept({"extent": [0.1, 0.1]}), "different"),
        (lambda: swept({"extent": [NAN]}), "extent"),
        (lambda: swept({"edge": ["round"]}), "edge is 'round'; allowed"),
        (lambda: swept({"n_balls": [3.5]}), "n_balls"),
        (lambda: swept(outputs=[]), "outputs"),
        (lambda: swept(outputs=["k_yy"]), "k_yy_mean"),
        (lambda: swept(outputs=["acceleration_rms_z"]), "directions"),
        (lambda: swept({"shaft_speed": [0.0]}, ["acceleration_rms_y"]), "shaft_speed"),
        (lambda: swept({"depth": [0.0]}), "no defect"),
        (lambda: swept(dict.fromkeys(("fx", "fy", "fz", "mx"), np.arange(400.0))),
         "number of scenes"),
        (lambda: swept({"fx": np.arange(9e3), "fy": np.arange(9e3)}, ["*_mean"]), "give a store"),
        (lambda: swept(outputs=["life_turns"]), "inner_groove_radius"),
        (lambda: swept(seed=-1), "seed is"),
        (lambda: swept(seed=(1, 1)), "different"),
        (lambda: swept(seed=()), "different"),
        (lambda: swept(effects=3.0), "PathEffects"),
        (lambda: swept(durration=1.0), "durration.*duration"),
    ],
    "scenes of files": [
        (lambda: data(version=2), "version is 2"),
        (lambda: data(speed=1.0), "field of scene"),
        (lambda: data("bearing", n_balls=0), "n_balls"),
        (lambda: data("load", fy="nan"), "fy"),
        (lambda: data("defect", race="middle"), "race"),
        (lambda: data("defect", floor={"kind": "lunar"}), "kind of the floor"),
        (lambda: data(defect=[NUMBERS["defect"][0]] * 21), "at most 20"),
        (lambda: data(dofs="xy"), "dofs"),
        (lambda: data(dofs=["w"]), "dofs"),
        (lambda: data(shaft_speed=10**400), "shaft_speed|scene"),
        (lambda: core.Scene.from_data({n: v for n, v in NUMBERS.items() if n != "bearing"}),
         "bearing"),
        (lambda: core.Scene.from_toml("#" * (LARGEST_TEXT + 1)), "length of the text"),
    ],
    "texts with numbers": [
        (lambda: text("1,2\n3,x"), "line 2 of t is '3,x'; allowed: numbers"),
        (lambda: text("a,b\n1,2\n3"), "line 3 of t is '3'; allowed: 2 columns"),
        (lambda: text("1_000"), "start of t"),
        (lambda: text("2024-99-01T12:00:00,1\n"), "start of t"),
        (lambda: text("," * 30 + "1"), "number of columns in t is 31"),
        (lambda: text("1 " * 40_000 + "\n1 2\n"), "number of columns in t"),
        (lambda: text("\n" * 500_001), "lines of numbers"),
        (lambda: text("1\n" * 1_000_001), "count of numbers"),
    ],
    "files with signals": [
        (lambda: core.read_table("a.csv", b""), "allowed: one that is not empty"),
        (lambda: core.read_table("a.csv", b"words\n" * 5000), "a table of numbers"),
        (lambda: core.read_table("a.csv", b"1,2\n" * 20), "number of rows in a.csv is 20"),
        (lambda: core.read_table("a.png", b"\x89PNG\r\n\x1a\n" + bytes(9)), "text with numbers"),
        (lambda: core.read_table("a.wav", b"RIFF\0\0\0\0WAVE"), "a whole WAV file"),
        (lambda: core.read_table("a.mat", b"MATLAB 5.0 MAT-file"), "MATLAB file"),
        (lambda: core.read_table("a.mat", b"MATLAB 7.3 MAT-file".ljust(600)), "MATLAB file"),
        (lambda: core.read_table("a.mat", b"\x89HDF\r\n\x1a\n".ljust(600)), "damaged or unk"),
        (lambda: core.read_table("a.mat", matlab(**nested(13))), "structs inside one another"),
        (lambda: core.read_table("a.mat", matlab(a=TWO * 1j)), "vector or matrix"),
        (lambda: core.read_table("a.mat", matlab(a=np.zeros((1030, 1030)))),
         "number of columns in a.mat is 1030"),
        (lambda: taken([5], ["y"], "g"), "column is 5"),
        (lambda: taken(["z"], ["y"], "g"), "column is 'z'"),
        (lambda: taken([True, 1], ["x"], "g"), "columns"),
        (lambda: taken([1, 1], ["x", "y"], "g"), "different ones, one a direction"),
        (lambda: taken([1], ["y"]), r"unit is missing: pass unit=..., one of m/s², g"),
        (lambda: taken([1], ["y"], "mV"), "sensitivity is missing: pass sensitivity="),
    ],
    "experiments": [
        (lambda: motion_experiment(RIG, methods=("Euler",)), "method is 'Euler'"),
        (lambda: motion_experiment(STILL), "shaft_speed is 0"),
        (lambda: motion_problem(RIG.replace(fy=0.0)), "static state"),
        (lambda: statics_experiment(RIG.replace(fy=0.0)), "static state"),
    ],
    "recordings": [
        (lambda: record(TWO, sample_rate=0.0), "sample_rate is 0"),
        (lambda: record(TWO, directions=("y", "z")), "x, y or both"),
        (lambda: record(TWO[:, 0]), "a column for each direction: x, y"),
        (lambda: record(TWO[:100]), "100 samples long"),
        (lambda: record(TWO * [1.0, INF]), "finite"),
        (lambda: record(TWO * [1.0, 0.0]), "the same number throughout along y"),
        (lambda: record(TWO * [1.0, 1e-300]), "swinging by .*e-300 along y"),
        (lambda: record(TWO * 1e300), "swinging by .*e.300 along x"),
        (lambda: severity_zone(1e-3, "small"), "machine"),
        (lambda: severity_zone(NAN, "large, rigid"), "velocity"),
    ],
    "spectra": [
        (lambda: core.spectrum(np.zeros(100), 65536.0), "^signal is .*; allowed: "),
        (lambda: core.spectrum(np.full(4096, NAN), 65536.0), "^signal is .*; allowed: "),
        (lambda: core.spectrum(np.zeros(4096), NAN), "^sample_rate is .*; allowed: "),
        (lambda: core.spectrum(np.zeros(4096), 65536.0, 40e3), "^resolution is .*; allowed: "),
        (lambda: envelope((3000.0, 2000.0)), "upper end of the band is 2000"),
        (lambda: envelope((0.0, 2000.0)), "lower end of the band is 0"),
        (lambda: envelope((100.0, 10_000.0)), "below 10000"),
        (lambda: core.envelope_spectrum(np.zeros(10), 2e4, (100.0, 200.0)), "at least 64 samples"),
        (lambda: core.envelope_spectrum(np.full(1000, NAN), 2e4, (100.0, 200.0)), "finite"),
        (lambda: core.kurtogram(np.zeros(100), 25_600.0), r"signal is .*\(100,\)"),
        (lambda: core.kurtogram(np.zeros(4096), 25_600.0), "same number throughout"),
        (lambda: core.kurtogram(np.zeros((4096, 2)), 25_600.0), r"\(4096, 2\)"),
        (lambda: core.kurtogram(np.zeros(4096), 0.0), "sample_rate"),
        (lambda: spectrogram(np.zeros(1000), 6000.0, 10.0), "at least 2400 samples"),
        (lambda: spectrogram(np.full(9000, NAN), 6000.0, 10.0), "finite"),
        (lambda: order_map(TIME, 6000.0, [0.0], [0.0]), "speeds above 0"),
        (lambda: order_map(TIME, 6000.0, [8.0, 0.0], [30.0, 20.0]), "a later time for each speed"),
        (lambda: order_map(TIME, 6000.0, [0.0, 4.0, 8.0], [20.0, 30.0]), "a later time for each"),
        (lambda: order_map(TIME, 6000.0, [0.0, NAN], [20.0, 30.0]), "time"),
        (lambda: order_map(TIME, 6000.0, [0.0, 8.0], [1e-4, 30.0]), "leave out its slower parts"),
        (lambda: order_map(TIME[:, None], 6000.0, [0.0], [20.0]), "a row"),
        (lambda: order_map(TIME[:0], 6000.0, [0.0], [20.0]), "a row"),
        (lambda: order_map(TIME * NAN, 6000.0, [0.0], [20.0]), "finite"),
    ],
    "forces in time": [
        (lambda: core.ForceSamples([[0.0, NAN]], 1e3), "samples"),
        (lambda: core.ForceSamples([0.0, 1.0], 1e3), "of shape \\(n, 2\\)"),
        (lambda: core.ForceSamples(np.zeros((0, 2)), 1e3), "of shape \\(n, 2\\)"),
        (lambda: core.ForceSamples("much", 1e3), "finite numbers"),
        (lambda: core.ForceSamples([[0.0, -1e300]], 1e3), "samples is 'up to 1e\\+300'"),
        (lambda: core.ForceSamples([[0.0, 1.0]], 0.0), "sample_rate"),
        (lambda: core.ForceSamples([[0.0, 1.0]], 1e3, ("x", "x")), "different names"),
        (lambda: core.simulate(RIG, force=core.ForceSamples([1.0], 1e3, "z")), "moves: x, y"),
        (lambda: core.simulate(RIG, force=core.ForceSamples([[1.0, 2.0]], 1e9)), "of the force"),
        (lambda: core.simulate(RIG, force=[[1.0, 2.0]]), "a ForceSamples"),
    ],
    "diagnoses": [
        (lambda: diagnosis(0.0), "shaft_speed is 0"),
        (lambda: diagnosis((3.0, 2.0)), "upper shaft_speed is 2"),
        (lambda: diagnosis((0.0, 2.0)), "lower shaft_speed is 0"),
        (lambda: diagnosis((1.0, 2.0, 3.0)), "shaft_speed"),
        (lambda: diagnosis(150.0, slip=-0.01), "slip"),
        (lambda: diagnosis(150.0, slip=0.2), "slip"),
        (lambda: diagnosis(150.0, speed_source="rumour"), "speed_source is 'rumour'"),
        (lambda: diagnosis(150.0, bearing_source="rumour"), "bearing_source is 'rumour'"),
        (lambda: diagnosis(150.0, unit="g"), "unit is 'g'; allowed: None for a recording"),
        (lambda: core.diagnose("no/such.csv", "6205"), "one to read \\(No such file"),
        (lambda: core.size_defect(NOISE, STILL), "shaft_speed"),
        (lambda: core.size_defect(NOISE, RIG.replace(dofs=("x",))), "dofs"),
        (lambda: core.size_defect(NOISE, RIG.replace(stiffness_x=None), support_known=True),
         "stiffness"),
        (lambda: extent(race="cage"), "race"),
        (lambda: extent(load=0.0), "load"),
        (lambda: extent(clearance=-1e-6), "clearance"),
        (lambda: extent(edge="sharp"), "edge"),
    ],
}  # fmt: skip


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        pytest.param(*case, id=f"{about} {number}")
        for about, cases in REFUSED.items()
        for number, case in enumerate(cases)
    ],
)
@pytest.mark.usefixtures("files_read_here")
def test_what_cannot_be_is_refused(ask: Callable[[], object], words: str) -> None:
    with pytest.raises(FieldError, match=words) as refused:
        ask()
    assert "\n" not in str(refused.value)
    assert refused.value.field
    assert refused.value.allowed_text


NOT_A_SCENE = ("scene", 'a Scene, such as scene_of("6205")')
WRONG: list[tuple[Callable[[], object], str, str]] = [
    *(
        (lambda of=of: of("6205"), *NOT_A_SCENE)
        for of in (
            core.equilibrium, core.modes, core.frequency_bands, core.contact_damping, core.orbit,
            core.simulate, core.life, core.limits, core.stiffness_maps, core.contact_pressures,
            core.ball_positions, core.static_state,
        )
    ),
    (lambda: core.film(MOTOR, viscosity=0.01), *NOT_A_SCENE),
    (lambda: to_ross(None, [100.0]), *NOT_A_SCENE),
    (lambda: core.size_defect(NOISE, MOTOR), *NOT_A_SCENE),
    (lambda: core.size_defect(DRAWN, DRAWN), "recording", "a Recording"),
    (lambda: core.measure_extent([1.0], MOTOR, 100.0), "recording", "a Recording"),
    (lambda: core.indicators(np.zeros(4096)), "recording", "a Recording"),
    (lambda: core.diagnose(np.zeros(4096), MOTOR, 100.0), "recording", "a Recording"),
    (lambda: core.trend([1.0], MOTOR, 100.0, direction="y"), "recordings", "of Recording"),
    (lambda: core.diagnose(NOISE, 6205, 100.0), "bearing", "a designation"),
    (lambda: core.diagnose(NOISE, DRAWN, 100.0), "bearing", "a designation"),
    (lambda: core.dynamic_load_rating(None), "bearing", "a designation"),
    (lambda: core.read_designation(6205), "designation", "text"),
    (lambda: core.diagnose(NOISE, MOTOR, "fast"), "shaft_speed", "a finite number"),
    (lambda: core.simulate(DRAWN, "long"), "duration", "a finite number"),
    (lambda: core.Load(fy="abc"), "fy", "a finite number"),
    (lambda: DRAWN.replace(bearing=6205), "bearing", "a designation"),
    (lambda: DRAWN.replace(defect=0.2), "defect", "a Defect"),
    (lambda: DRAWN.replace(load=(0.0, -100.0)), "load", "a Load"),
    (lambda: DRAWN.replace(defect={}), "defect", "a Defect"),
    *((lambda name=name: DRAWN.replace(**{name: "1"}), name, "number") for name in (
        "fy", "shaft_speed", "extent", "row", "n_balls", "density", "inner_mass",
    )),
    (lambda: DRAWN.replace(depth=b"1"), "depth", "a finite number"),
    (lambda: DRAWN.replace(fy=np.bool_(True)), "fy", "a finite number"),
    (lambda: MOTOR.replace(estimated=1), "estimated", "n_balls"),
    (lambda: Row(facing="1"), "facing of a row", "a whole number"),
    (lambda: DRAWN.replace(contact_law=3), "contact_law", "published"),
    (lambda: checks.whole_number("n", "abc", at_least=1, at_most=9), "n", "a whole number"),
]  # fmt: skip


@pytest.mark.parametrize(("call", "field", "wanted"), WRONG)
def test_a_wrong_type_is_refused_by_name(
    call: Callable[[], object], field: str, wanted: str
) -> None:
    with pytest.raises(TypeError) as caught:
        call()
    assert isinstance(caught.value, FieldError)
    assert isinstance(caught.value, ValueError), "who catches what a value was refused for"
    assert caught.value.field == field
    assert wanted in caught.value.allowed_text


def test_a_number_out_of_range_is_no_matter_of_type() -> None:
    for call in (lambda: core.Load(fy=float("nan")), lambda: MOTOR.replace(n_balls=-1)):
        with pytest.raises(ValueError, match="allowed") as caught:
            call()
        assert not isinstance(caught.value, TypeError)


def test_a_bearing_may_be_given_by_its_number() -> None:
    named = core.read_designation("6205-2RS/C3")
    assert bearing_of("6205-2RS/C3") == bearing_of(named) == bearing_of(named.entry)
    listed = core.catalogue()["6205-2RS, CWRU drive end"]
    assert bearing_of("6205-2RS, CWRU drive end") == bearing_of(listed) == listed.bearing
    assert DRAWN.replace(bearing="6206").bearing == core.read_designation("6206").bearing
    changed = DRAWN.replace(bearing="6206", radial_clearance=4e-6).bearing
    assert changed == core.read_designation("6206").bearing.replace(radial_clearance=4e-6)
    with pytest.raises(ValueError, match="designation is 'fan-rig'; allowed: a bearing of the ser"):
        bearing_of("fan-rig")


def refused(field: str, shown: str, act: Callable[[], object]) -> str:
    """Return the words on what is allowed, after checking that field and value are named."""
    with pytest.raises(ValueError, match=r"; allowed: .") as error:
        act()
    said = str(error.value)
    assert said.startswith(f"{field} is {shown}"), said
    return said.split("; allowed: ")[1]


@pytest.mark.parametrize(
    ("field", "value", "shown", "allowed"),
    [
        ("radial_clearance", -1.0, "-1", "at least -0.0"),
        ("radial_clearance", NAN, "nan", "finite"),
        ("radial_clearance", True, "True", "finite"),
        ("n_balls", 0, "0", "from 1"),
        ("n_balls", 7.5, "7.5", "whole number"),
        ("n_balls", True, "True", "whole number"),
        ("n_balls", 10**9, "1e+09", "500"),
        ("n_balls", 60, "60", "do not overlap"),
        ("contact_angle", math.radians(90.0), "1.5708", "80 degrees"),
        ("contact_angle", -0.1, "-0.1", "at least 0"),
        ("ball_diameter", 0.0, "0", "above 0"),
        ("ball_diameter", 0.04, "0.04", "pitch_diameter"),
        ("ball_diameter", "thick", "'thick'", "finite number"),
        ("groove_center_distance", -5e-5, "-5e-05", "above 0"),
        ("load_deflection_factor", 0.0, "0", "above 0"),
        ("load_deflection_factor", INF, "inf", "finite"),
        ("outer_raceway_radius", NAN, "nan", "finite"),
        ("inner_raceway_radius", 0.0227, "0.0227", "outer_raceway_radius"),
        # the defect
        ("extent", -0.1, "-0.1", "at least 0"),
        ("extent", 6.3, "6.3", "at most 6.28319"),
        ("depth", -1e-6, "-1e-06", "at least 0"),
        ("depth", 3.1e-3, "0.0031", "ball radius of 0.003 m"),
        ("center", INF, "inf", "finite"),
        ("race", "middle", "'middle'", "outer, inner"),
        ("edge", "round", "'round'", "published, chord, exact"),
        # the load
        ("fx", NAN, "nan", "finite"),
        ("mx", None, "None", "finite number"),
        # the support
        ("inner_mass", 0.0, "0", "above 0"),
        ("outer_mass", -2.0, "-2", "above 0"),
        ("stiffness_z", -1.0, "-1", "above 0"),
        ("damping_y", -1.0, "-1", "at least 0"),
        ("damping_rx", NAN, "nan", "at least 0"),
        ("inner_inertia", 0.0, "0", "above 0"),
        # the scene
        ("shaft_speed", -1.0, "-1", "at least 0"),
        ("contact_damping", -1.0, "-1", "at least 0"),
        ("contact_law", "sticky", "'sticky'", "published, no tension"),
        ("dofs", ("x", "y", "rz"), "('x', 'y', 'rz')", "x, y, z, rx, ry"),
        ("dofs", (), "()", "x, y, z, rx, ry"),
        ("dofs", ("x", "x"), "('x', 'x')", "different names"),
        ("dofs", "theta", "('theta',)", "x, y, z, rx, ry"),
        ("support", "rubber", "'rubber'", "Support"),
    ],
)
def test_a_field_that_cannot_be(field: str, value: object, shown: str, allowed: str) -> None:
    assert allowed in refused(field, shown, lambda: LIEW_LIM.replace(**{field: value}))


@pytest.mark.parametrize("name", ["Fx", "", "displacement", "extent_deg"])
def test_a_field_that_does_not_exist(name: str) -> None:
    allowed = refused("name of a field", repr(name), lambda: LIEW_LIM.replace(**{name: 1.0}))
    for known in ("extent", "fy", "n_balls", "stiffness_x", "dofs"):
        assert known in allowed


def test_numbers_that_only_look_bad() -> None:
    """Values that a caller may mean: whole floats, NumPy numbers, integers, 360° as a decimal."""
    assert LIEW_LIM.replace(n_balls=12.0) == LIEW_LIM
    assert LIEW_LIM.replace(n_balls=np.int32(12), fy=np.float32(-2000.0)) == LIEW_LIM
    assert LIEW_LIM.replace(fy=-2000) == LIEW_LIM
    assert LIEW_LIM.replace(extent=6.2831853072).defect.extent == 2.0 * math.pi
    assert LIEW_LIM.replace(dofs=["ry", "x"]).dofs == ("x", "ry")
    assert LIEW_LIM.replace(depth=3e-3).defect.depth == 3e-3
    assert hash(LIEW_LIM.replace(defect=[LIEW_LIM.defect])) is not None


@pytest.mark.parametrize("function", [equilibrium, modes])
@pytest.mark.parametrize(
    "angles", [[0.0, NAN], [INF], NAN, "all", [[0.0], [1.0, 2.0]], [1j], object()]
)
def test_cage_angles_that_are_not_angles(function: Callable[..., object], angles: Any) -> None:
    with pytest.raises(ValueError, match=r"^cage_angles is .*; allowed: finite numbers"):
        function(LIEW_LIM, angles)


def test_the_least_sample_rate_is_twice_the_highest_natural_frequency() -> None:
    """The refusal names the rate that is enough, and just that one is."""
    allowed = refused("sample_rate", "1000", lambda: simulate(RIG, 0.01, 1000.0))
    enough = float(allowed.split()[2])
    highest = float(np.nanmax(modes(RIG).undamped_frequency))
    assert enough == pytest.approx(2.0 * highest, rel=2e-3)
    assert simulate(RIG, 0.01, enough + 1.0).completed
    refused("sample_rate", f"{enough - 1.0:g}", lambda: simulate(RIG, 0.01, enough - 1.0))


@pytest.mark.parametrize("function", [lambda scene: simulate(scene, 0.01), modes])
@pytest.mark.parametrize("missing", ["stiffness_z", "damping_rx", "inner_inertia"])
def test_a_support_that_is_not_known_where_it_is_needed(
    function: Callable[[Scene], object], missing: str
) -> None:
    unknown = LIEW_LIM.replace(**{missing: None})
    assert "free directions" in refused(missing, "None", lambda: function(unknown))
    assert equilibrium(unknown).converged.all()
    function(unknown.replace(dofs=("x", "y")))


@pytest.mark.parametrize(
    "scene",
    [
        RIG.replace(fy=0.0),
        LIEW_LIM.replace(fy=0.0, fz=0.0),
        LIEW_LIM.replace(dofs=("x", "rx")),
        RIG.replace(fy=0.0, radial_clearance=0.0),
    ],
    ids=["no load", "no load, five directions", "load only where it is held", "no clearance"],
)
def test_without_a_load_nothing_touches(scene: Scene) -> None:
    answer = equilibrium(scene)
    assert np.all(answer.status == kernels.NOTHING_TOUCHES)
    assert not answer.converged.any()
    assert answer.reason(0).startswith("nothing touches")
    assert np.isnan(answer.displacement).all()
    assert np.all(answer.ball_load == 0.0)
    assert verdict(answer, 0) == ""
    assert np.isnan(modes(scene).frequency).all()
    assert contact_damping(scene) == 0.0
    motion = simulate(scene, 0.001)
    assert not motion.completed
    assert motion.reason.startswith("no static state to start from: nothing touches")
    assert np.isnan(motion.outer_acceleration).all()


def test_free_directions_are_named_all_and_only() -> None:
    """Two loaded balls in five directions leave one motion free, of z and a tilt together."""
    scene = RIG.healthy().replace(radial_clearance=100e-6, fy=-1.0, dofs=DOF_NAMES)
    answer = equilibrium(scene, [1.5 * math.pi + 0.5 * scene.bearing.ball_spacing])
    assert answer.loaded_balls[0] == 2
    assert answer.reason(0) == "the ring can move without resistance along z, rx"
    assert np.array_equal(np.isnan(answer.displacement[0]), [False, False, True, True, False])
