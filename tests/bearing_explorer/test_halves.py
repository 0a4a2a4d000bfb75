"""What passes between the halves, each half without the other, and the command line.

`.ci/run` runs the tests of each half, and of the kit, without the other half.
"""

import dataclasses
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from bearing_explorer.__main__ import options
from bearing_explorer.diagnosis.measurement_state import NOT_YET
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.views import frequency_lines
from bearing_explorer.diagnosis.views.frequency_lines import row_frequencies
from bearing_explorer.explorer.messages import LessonChange
from bearing_explorer.explorer.state.lessons import Lesson
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.explorer.views.vibration_spectrum import pass_frequencies, passed_races
from bearing_explorer.kit.messages import take
from bearing_explorer.page import Halves, lessons_of

from bearingcore import diagnose, presets
from bearingcore.bearings import read_designation

FAN_RIG, MOTOR = presets["fan-rig"], presets["6205"]


def test_a_button_of_a_lesson_simulates_the_scene_that_it_sets():
    halves = Halves()
    explorer = halves.explorer
    halves.session.draw = lambda: None  # type: ignore[method-assign]
    wishes = []
    halves.diagnosis.measurement.simulate = lambda *wish: wishes.append(  # type: ignore[method-assign]
        (wish, explorer.scene.defects[0].race)
    )
    wish = {"noise": "20"}
    change = explorer.change_lesson
    for junk in ("now", None, 3):
        take(change, LessonChange, {"mark": 1, "simulate": junk})
    take(change, LessonChange, {"mark": 2, "choose": {"race": "inner"}, "simulate": wish})
    assert wishes == [(("20",), "inner")]


def test_a_report_that_is_out_of_date_is_refused_in_a_sentence() -> None:
    halves = Halves()
    halves.session.draw = lambda: None  # type: ignore[method-assign]
    halves.diagnosis.measurement.measured = simulated(MOTOR, 20.0, 1)
    halves.explorer.change_links({"report": "http://localhost"})
    assert halves.explorer.bookmarks.state()["said"]["words"] == f"No report: {NOT_YET}"


def test_the_signals_of_the_lesson_on_parts_are_told_apart() -> None:
    """What its buttons simulate is diagnosed as its answer says, sidebands and all."""
    lesson = next(one for one in lessons_of() if one.name == "from-a-signal-to-a-part")
    assert isinstance(lesson, Lesson)
    html = "".join(part.html for part in lesson.parts[:-1])
    buttons = ElementTree.fromstring(f"<div>{html}</div>").iter("button")
    every = [json.loads(button.attrib["data-ask"]) for button in buttons]
    asked = [message for message in every if "simulate" in message]
    assert {message["show"] for message in every} == {"diagnosis"}
    found = {}
    for message in asked:
        editor = SceneEditor("liew-lim")
        lesson.begin(editor)
        editor.choose(message["choose"])
        editor.set(message["typed"])
        assert message["simulate"] == {"noise": "20"}
        made = simulated(editor.scene, 20.0, 1)
        found[made.true_part] = diagnose(made.recording, MOTOR.bearing, made.shaft_speed)
    assert {truth: one.fault for truth, one in found.items()} == {
        "outer race": "outer race", "inner race": "inner race", "none": "none seen",
    }  # fmt: skip
    inner, outer = found["inner race"].of("inner race"), found["outer race"].of("outer race")
    assert inner.sideband_spacing == pytest.approx(29.95, abs=0.1)
    assert inner.sidebands[:3].mean() > 6.0
    assert outer.sidebands[:3].mean() < 3.0


def test_lines_of_an_estimated_inside_have_their_error() -> None:
    assert not pass_frequencies(FAN_RIG, 2500.0)["spread"].any()
    bearing = read_designation("6208").bearing
    scene = presets["6205"].replace(bearing=bearing)
    spread = pass_frequencies(scene, 2500.0)["spread"]
    assert spread[0] == pytest.approx(bearing.bpfo(scene.shaft_speed) * 0.0146, rel=0.02)
    inner = bearing.bpfi(scene.shaft_speed) * bearing.frequency_spread("bpfi")
    assert row_frequencies(scene)[0]["bpfi_spread"] == pytest.approx(inner)
    columns = frequency_lines.columns("lines", row_frequencies(scene), ("bpfi",), 1000.0, 200.0)
    assert columns["lines_bpfi_names"]["spread"][0] == pytest.approx(inner)


def test_rows_that_are_not_alike_have_pass_frequencies_of_their_own() -> None:
    pair = presets["7208-back-to-back"]
    assert len(passed_races(pair)) == 1
    low, high = pair.bearing.rows
    rows = (low, dataclasses.replace(high, n_balls=11))
    scene = pair.replace(bearing=pair.bearing.replace(rows=rows), row=None)
    rates = [scene.bearing.of_row(k).bpfo(scene.shaft_speed) for k in range(2)]
    assert passed_races(scene) == [("outer", 1, rates[0]), ("outer", 2, rates[1])]
    assert passed_races(scene.replace(row=1)) == [("outer", 2, rates[1])]
    columns = frequency_lines.columns("own", row_frequencies(scene), ("bpfo",), 3000.0, 400.0)
    names = columns["own_bpfo_names"]
    assert set(names["of"]) == {1.0, 2.0}
    assert np.unique(names["row"]).size == 2, "each row has its names at a height of their own"


_FILE_DIAGNOSED = """
import asyncio, io, sys
import numpy as np
from bearing_explorer.diagnosis.upload import PIECE
from bearing_explorer.page import TABS, Halves, page
from scipy.io import wavfile
from bearingcore import presets

# knocks at the frequency of ball passes, and noise
rig = presets["fan-rig"]
time = np.arange(144_000) / 48e3
since = time % (1.0 / rig.bearing.bpfo(rig.shaft_speed))
knocks = np.exp(-800.0 * since) * np.sin(2.0 * np.pi * 3e3 * since)
file = io.BytesIO()
noise = 0.1 * np.random.default_rng(1).standard_normal(time.size)
wavfile.write(file, 48_000, (knocks + noise).astype("f4"))
content = file.getvalue()

async def main():
    page()
    halves = Halves("v=1&preset=fan-rig&tab=load")  # a tab of the other half
    session, brought = halves.session, halves.diagnosis.measurement
    assert halves.explorer is None
    assert [name for name, _ in TABS] == [session.shown] == ["diagnosis"]
    session.start()
    wanted = []
    brought.want = lambda begin, of: wanted.append((begin, of))
    brought.begin_upload("fan.wav", len(content))
    while wanted:
        begin, of = wanted.pop()
        brought.take_piece(content[begin : begin + PIECE], of)
    while session.jobs.busy():
        await asyncio.sleep(0.01)
    [form] = [view.form for view in session.views_made() if view.name == "measurement"]
    offered = [way for way in form.select() if "way" in way.css_classes and way.visible]
    compiler = "numba" in sys.modules  # before the length of the spall is asked for
    said = {"unit": "m/s²", "bearing": "scene", "speed": "scene"}
    brought.take_form({**brought.state.values, **said})
    session.draw()
    view = diagnosis = None
    while getattr(diagnosis, "fault", None) is None:
        await asyncio.sleep(0.05)
        views = [one for one in session.views_made() if one.name == "diagnosis"]
        diagnosis = views[0].answer() if views else None
    print(diagnosis.fault, len(offered), compiler, sep=", ")
    session.stop()

asyncio.run(main())
"""


def _without(half: str, script: str) -> str:
    """What a script prints where a half is not there."""
    hidden = f"import sys; sys.modules['bearing_explorer.{half}'] = None\n{script}"
    done = subprocess.run(
        [sys.executable, "-c", hidden], capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout.strip().splitlines()[-1]


@pytest.mark.proof
def test_a_file_is_diagnosed_without_the_half_of_the_scene() -> None:
    """Nothing is simulated then: neither is it offered, nor is a compiler loaded for it."""
    assert _without("explorer", _FILE_DIAGNOSED) == "outer race, 1, False"


_BROKEN = """
import sys

for broken in sys.argv[1:]:
    sys.modules[broken] = None
    try:
        import bearing_explorer.page
    except ModuleNotFoundError as error:
        print(error.name)
    for name in [name for name in sys.modules if name.startswith("bearing_explorer")]:
        del sys.modules[name]
"""


@pytest.mark.proof
def test_a_half_that_is_broken_is_not_left_out_unsaid() -> None:
    """A module that is missing inside it is an error of the program."""
    missing = [
        f"bearing_explorer.{name}" for name in ("explorer.half", "diagnosis.half", "kit.session")
    ]
    done = subprocess.run(
        [sys.executable, "-c", _BROKEN, *missing], capture_output=True, text=True, timeout=600
    )
    assert done.stdout.split() == missing, done.stderr


@pytest.mark.parametrize(
    ("option", "texts"),
    [
        ("--port", ("99999", "-1", "", "x", "5006.0", "५")),
        ("--num-procs", ("0", "-3", "two")),
        ("--max-sessions", ("0", "many", "1" * 5000)),
        ("--root-path", ("(", "/lab(.*)", "/a b", "/a?b", "/ä", "/a\n")),
        (
            "--allow-websocket-origin",
            ("", "http://a:b:c", "a b", "ftp://a", "a/b", "u@a", "a:99999", "*"),
        ),
        ("--frame-ancestor", ("", "https://a\r\nX-Mine: 1", "a; script-src *", "a b", "a,b")),
    ],
)
def test_a_bad_value_is_refused_with_what_is_allowed(
    option: str, texts: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    for text in texts:
        with pytest.raises(SystemExit) as refused:
            options([f"{option}={text}"])
        assert refused.value.code == 2
        said = capsys.readouterr().err.splitlines()[-1]
        assert re.search(f"argument {option}: '.*' cannot be used; allowed: ", said), text


def test_good_values_are_taken() -> None:
    line = (
        "--port=0 --root-path=/lab/bearing-1 --num-procs=2 --max-sessions=5 "
        "--allow-websocket-origin=lab.example.org:8443 --allow-websocket-origin=https://[::1] "
        "--frame-ancestor=https://*.example.org:8443 --frame-ancestor=example.org/course"
    )
    chosen = options(line.split())
    assert chosen.port == 0
    assert chosen.allow_websocket_origin == ["lab.example.org:8443", "https://[::1]"]
    assert len(chosen.frame_ancestor) == 2


def test_what_cannot_be_listened_on_or_read_is_said_without_a_traceback(tmp_path: Path) -> None:
    lessons = tmp_path / "lessons\udcff"
    lessons.mkdir()
    (lessons / "\udcfe.md").write_bytes(b"\xff")
    arguments = ["--address", "x" * 70, "--lessons", str(lessons), "--no-browser"]
    command = [sys.executable, "-m", "bearing_explorer", *arguments]
    told = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert told.returncode == 1
    assert "Cannot listen on xxx" in told.stdout
    assert "this is not text in UTF-8" in told.stdout
    assert "Traceback" not in told.stdout + told.stderr
