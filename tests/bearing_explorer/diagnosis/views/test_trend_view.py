"""Several files as a trend: good ones read, bad ones named, numbers as a table and in Python."""

import asyncio
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.session import Measurement
from bearing_explorer.diagnosis.upload import PIECE
from bearing_explorer.diagnosis.views.trend import NO_LEVELS, TrendOfFiles, trend_words
from bearing_explorer.kit.compute.jobs import READING, Work
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import presets
from tests.helpers.loops import run
from tests.helpers.measuring import measuring, signal
from tests.helpers.reading import read_in_this_process
from tests.helpers.saved import saved

MODEL = Model(presets["fan-rig"])


RATE = 5000.0
LOUD = (1.0, 2.0, 6.0)
"""Loudness of the good files, in their order."""


@cache
def files() -> dict[str, bytes]:
    """Three recordings of 1 s, louder and louder, between them one that cannot be read."""
    rng = np.random.default_rng(3)
    time = np.arange(int(RATE)) / RATE
    made = {}
    for day, loud in enumerate(LOUD, 1):
        noise = rng.standard_normal(time.size)
        signal = loud * (noise - noise.mean()) / noise.std()
        table, head = np.column_stack([time, signal]), "time (s),y (m/s2)"
        made[f"day{day}.csv"] = saved(np.savetxt, table, "%.7g", ",", header=head, comments="")
    first, *others = made.items()
    return dict([first, ("broken.csv", b"x,y\n1,2\nhello,3"), *others])


async def bring_all(made: Measurement, after: Callable[[int], None] = lambda number: None) -> None:
    """As the browser does; `after` is called when a file is read and the next may come."""
    waiting = list(enumerate(files().items(), 1))
    current = b""

    def begin() -> None:
        nonlocal current
        number, (name, current) = waiting.pop(0)
        made.begin_upload(name, len(current), number, len(files()), len(files()))

    def want(begin: int, of: int) -> None:
        made.take_piece(current[begin : begin + PIECE], of)

    def more() -> None:
        after(len(files()) - len(waiting))
        begin()

    made.want, made.more = want, more
    begin()
    while made._jobs.busy(READING):
        await asyncio.sleep(0.005)


@cache
def brought() -> Measurement:
    made = measuring()
    with pytest.MonkeyPatch.context() as patched:
        read_in_this_process(patched)
        run(bring_all(made))
    return made


def computed(view: TrendOfFiles) -> str:
    """The job of the view here and now: its sentence."""
    work = Work()
    words = view.prepare({}, MODEL)(work)
    (view.job_result,) = work.take_results()
    return words


def view_of(made: Measurement) -> TrendOfFiles:
    view = TrendOfFiles(PackedSource())
    view.measure(made)
    view.say(MODEL, view.sentence(MODEL))
    return view


@pytest.fixture(scope="module")
def view() -> TrendOfFiles:
    made = view_of(brought())
    assert computed(made) == "3 of 3 files are in the trend."
    return made


def test_a_bad_file_among_good_ones_is_named_and_nothing_is_lost(view: TrendOfFiles) -> None:
    made = brought()
    assert [table.name for table in made.series.tables] == ["day1.csv", "day2.csv", "day3.csv"]
    assert made.measured is not None
    assert made.measured.recording.name == "day3.csv"
    sentence = view.sentence(MODEL)
    assert "3 recordings. " in sentence
    assert "6 times that of the baseline, day1.csv" in sentence
    assert "Left out: broken.csv" in sentence
    sources, ranges = view.data(MODEL)
    rms = sources["trend"]["rms"]
    np.testing.assert_allclose(rms / rms[0], LOUD, rtol=1e-4)
    assert ranges["trend_rms"][1] > rms[-1]
    assert len(view.table(MODEL)["rms_m_per_s2"]) == 3
    words = trend_words(view.job_result.trend, in_si=False)
    assert NO_LEVELS in words
    assert "times" not in words


@pytest.mark.usefixtures("files_read_here")
def test_cancel_while_files_are_read_keeps_the_signal_before() -> None:
    made = measuring(signal())
    read: list[int] = []

    def cancel(number: int) -> None:
        read.append(number)
        made.cancel()

    run(bring_all(made, cancel))
    assert read == [1]
    assert made.measured is signal()
    assert made.series.tables == ()
    assert not made.state.busy
    assert made.state.words == f"Cancelled. {signal().recording.name} stays."
