"""A file is diagnosed without the other half; a half that is broken is not left out.

`.ci/run` runs the tests of each half, and of the kit, without the other half.
"""

import subprocess
import sys

import pytest

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
