"""A measurement of one's own: brought in pieces, judged, asked about; and simulated ones."""

import asyncio
import math
import struct
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from bearing_explorer.diagnosis.form import AS_HEADED, change_role, read_form
from bearing_explorer.diagnosis.machine import Machine
from bearing_explorer.diagnosis.model import NOT_TAKEN, WANTED, Model
from bearing_explorer.diagnosis.reading import MOST_NUMBERS, read_file
from bearing_explorer.diagnosis.session import RECORDS, Measurement
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.signal_form import AS_GIVEN, EARLIER_SCENE
from bearing_explorer.diagnosis.simulated import simulated
from bearing_explorer.diagnosis.upload import (
    LONGEST_NAME,
    MOST_BYTES,
    NAME_IN_LINE,
    PIECE,
    shown_name,
    without_middle,
)
from bearing_explorer.diagnosis.views.measured_spectrum import MeasuredSpectrum
from bearing_explorer.diagnosis.views.measured_view import recording_lines
from bearing_explorer.diagnosis.views.part_words import assumptions
from bearing_explorer.diagnosis.widgets.machine_form import MachineForm, kept_html
from bearing_explorer.diagnosis.widgets.measurement_form import columns_as_said
from bearing_explorer.kit.compute.jobs import READING
from bearing_explorer.kit.serve.packed_source import PackedSource
from scipy.io import wavfile

from bearingcore import Scene, catalogue, presets
from tests.helpers.loops import run
from tests.helpers.measuring import measuring, signal
from tests.helpers.saved import matlab, saved, zipped

pytestmark = pytest.mark.usefixtures("files_read_here")

RIG = presets["fan-rig"]
NOISE = np.random.default_rng(2).standard_normal((2000, 2))


def csv_of(columns: np.ndarray, heading: str = "", rate: float = 10_000.0) -> bytes:
    time = np.arange(len(columns)) / rate
    rows = [",".join(f"{v:.6g}" for v in (t, *row)) for t, row in zip(time, columns, strict=True)]
    return "\n".join([heading, *rows] if heading else rows).encode()


async def settled(measurement: Measurement) -> None:
    while measurement._jobs.busy(READING):
        await asyncio.sleep(0.005)


async def bring(measurement: Measurement, name: str, content: bytes) -> None:
    """As the browser does: the pieces that are asked for, one after the other."""
    wanted: list[tuple[int, int]] = []
    measurement.want = lambda begin, of: wanted.append((begin, of))
    measurement.begin_upload(name, len(content))
    while wanted:
        begin, of = wanted.pop()
        measurement.take_piece(content[begin : begin + PIECE], of)
    await settled(measurement)


def brought(
    name: str,
    content: bytes,
    before: Measured | None = None,
    scene: Callable[[], Scene] = lambda: presets["fan-rig"],
) -> Measurement:
    async def all_of_it() -> Measurement:
        made = measuring(before, scene)
        await bring(made, name, content)
        return made

    return run(all_of_it())


# -- good files ------------------------------------------------------------------------------------


def test_large_files_come_in_pieces_that_the_websocket_takes():
    columns = np.random.default_rng(0).standard_normal((400_000, 2))
    content = saved(wavfile.write, 51_200, columns.astype(np.float32))
    assert len(content) > 3 * PIECE
    made = brought("long.wav", content)
    assert "nothing says where" in made.state.reasons["columns"]  # they may be of two places
    answer(made, columns="x;y")
    assert made.measured is not None
    np.testing.assert_allclose(made.measured.recording.acceleration, columns, rtol=1e-6)
    assert made.state.scaled
    assert made.state.open == ["unit"]
    assert made.state.proposed == ""  # what full scale stands for may be anything
    answer(made, unit="g", full_scale="50")
    assert not made.state.open
    np.testing.assert_allclose(
        made.measured.recording.acceleration, 50.0 * 9.80665 * columns, rtol=1e-6
    )


def test_a_unit_that_the_file_does_not_say_is_asked_and_never_guessed():
    """Its numbers are taken as they stand, for what does not depend on it, until it is answered."""
    made = brought("a.csv", csv_of(0.1 * NOISE, "time,x,y"), signal())
    assert made.measured is not None
    assert not made.measured.in_si
    assert not made.state.bad
    np.testing.assert_allclose(made.measured.recording.acceleration, 0.1 * NOISE, rtol=1e-5)
    assert made.state.open == ["unit"]
    assert made.state.proposed == "g"
    assert "g is likely: a root mean square of 0.1" in made.state.words
    answer(made, sure="yes")  # agreeing to guesses is no answer to this
    assert made.state.open == ["unit"]
    assert not made.measured.in_si
    answer(made, unit="g")
    assert made.measured.in_si
    assert not made.state.open
    np.testing.assert_allclose(
        made.measured.recording.acceleration, 0.1 * 9.80665 * NOISE, rtol=1e-5
    )
    answer(made, unit="")  # taken back
    assert not made.measured.in_si
    assert brought("a.csv", csv_of(NOISE, "time,x,y")).state.proposed == "", "1 is usual in both"
    said = brought("a.csv", csv_of(NOISE, "time,x [g],y [g]"))  # not asked where the file says it
    assert said.measured is not None
    assert said.measured.in_si
    assert not said.state.open


@pytest.mark.parametrize(
    ("field", "text", "told"),
    [
        ("sample_rate", "fast", "must be a number, not “fast”"),
        ("sample_rate", "12000 rpm", "in Hz, not in turns a minute"),
        ("sample_rate", "-5", "possible: 1 to 1·10⁷ Hz"),
        ("shaft_speed", "0", "possible:"),
        ("shaft_speed", "rpm", "is missing"),
        ("shaft_speed", "1797", "107820 rpm. Did you mean 1797 rpm?"),
        ("full_scale", "0", "possible"),
        ("unit", "furlongs", "one of m/s², g, mg"),
        ("columns", "time;y;y;", "Two columns are the signal"),
        ("columns", "time;x;y", "has other columns"),
        ("columns", "time;x;y;furlong", "has other columns"),
        ("columns", "time;x;;y", "same number throughout"),
    ],
)
def test_a_form_that_makes_no_sense_is_told_beside_its_field(field, text, told):
    columns = np.hstack([NOISE, np.ones((len(NOISE), 1))])
    made = brought("a.csv", csv_of(columns, "time,x,y,still"))
    before = made.measured
    answer(made, **{field: text})
    assert made.measured is before is not None
    assert made.state.bad
    assert any(told in sentence for sentence in made.state.refused.values())


def test_more_numbers_than_a_session_keeps_are_left_out():
    rows = MOST_NUMBERS // 2 + 1000
    signal = np.tile(NOISE, (rows // len(NOISE) + 1, 1))[:rows].astype(np.float32)
    content = saved(wavfile.write, 8000, signal)
    assert len(content) < MOST_BYTES
    table = read_file("long.wav", content, Machine())
    assert table.table.columns.size == MOST_NUMBERS
    assert "Only the first" in table.cut
    assert table.asks  # two channels: which are x and y is asked
    asked = read_form(table.table, {**table.form, "columns": "x;y"}, Machine())
    assert asked.recording.sample_rate == 8000.0


def answer(made: Measurement, **values: str) -> None:
    """The form with other values; `sure` presses the button below it.

    A shaft speed is given where nothing else is said of it.
    """
    if "shaft_speed" in values:
        values = {"speed": "given", **values}

    async def asked() -> None:
        sure = bool(values.pop("sure", ""))
        made.take_form({**made.state.values, **values}, sure)
        await settled(made)

    run(asked())


def case_western(**more: np.ndarray) -> bytes:
    """As the drive end, fan end and base of one motor are stored."""
    sides = {f"X105_{side}_time": NOISE[:, :1] * 0.3 for side in ("DE", "FE", "BA")}
    return matlab(**sides, X105RPM=np.array([[1797]], dtype="u2"), **more)


def test_a_known_collection_is_taken_at_once_and_each_guess_is_marked():
    made = brought("105.mat", case_western(), signal())
    assert made.measured is not None
    assert made.measured.bearing == catalogue()["6205-2RS, CWRU drive end"].bearing
    assert made.state.line == (
        "105.mat · 167 ms · 12 kHz? · 1797 rpm · g? · 6205-2RS, CWRU drive end?"
    )
    assert made.source_of("unit").startswith("A guess: variables named as in the Case Western")
    assert made.state.columns.places == ["drive end", "fan end", "base"]
    answer(made, sample_rate="48000", unit="m/s²", bearing="scene")
    assert made.source_of("unit") == "Given"
    assert made.state.line == "105.mat · 41.7 ms · 48 kHz · 1797 rpm · m/s² · the scene's bearing"
    assert made.state.whole_name == ""
    answer(made, columns="y;x;")  # the hand wins, and a note says what speaks against it
    assert "two places (drive end and fan end)" in made.state.remarks


def test_frequencies_of_a_file_and_typed_ones_count_as_the_bearing():
    run_ = {"gs": NOISE[:, :1], "sr": 48_828.0, "rate": 25.0, "load": "150"}
    made = brought("run.mat", matlab(bearing=run_, BPFO=81.125, BPFI=118.875, BSF=63.91))
    assert made.measured is not None
    assert made.measured.machine.bearing_name == "NICE, MFPT"  # which has these frequencies
    turn = 2.0 * math.pi
    made = brought("other.mat", matlab(bearing=run_, BPFO=76.3, BPFI=123.7, FTF=9.54))
    assert made.measured is not None
    bearing = made.measured.bearing
    assert bearing is not None
    assert bearing.n_balls == 8
    assert bearing.bpfo(25.0 * turn) == pytest.approx(76.3, rel=1e-3)
    assert made.state.values["bpfi"] == "123.7 Hz"
    answer(made, bpfo="3.585 x", bpfi="5.415x")
    assert made.measured.bearing is not None
    assert made.measured.bearing.n_balls == 9
    answer(made, bpfo="60")
    assert "nearly a whole number" in made.state.refused["bearing"]


def test_voltages_need_their_sensor():
    made = brought("v.csv", csv_of(NOISE[:, :1], "time [s],ch1 [mV]"))
    assert made.measured is not None
    assert made.state.open == ["sensitivity"]  # a voltage says nothing without it
    assert not made.measured.in_si
    answer(made, sensitivity="100")
    assert made.measured.in_si
    level = made.measured.recording.acceleration.std()
    assert level == pytest.approx(NOISE[:, 0].std() / 100.0 * 9.80665, rel=1e-4)
    answer(made, sensitivity="10 mV/g")
    assert made.measured.recording.acceleration.std() == pytest.approx(10.0 * level)
    answer(made, sensitivity="0")
    assert "sensitivity" in made.state.refused


def test_columns_in_two_units_are_each_read_in_their_own():
    made = brought("two.csv", csv_of(NOISE, "time,x [g],y [m/s²]"))
    assert made.state.values["unit"] == AS_HEADED
    read = made.measured.recording.acceleration
    np.testing.assert_allclose(read, NOISE * [9.80665, 1.0], rtol=1e-5)
    answer(made, unit="mm/s")  # which they are not
    assert "says g; mm/s is taken, as given" in made.state.remarks


def test_a_unit_chosen_over_a_column_is_that_of_all_until_another_has_its_own():
    made = brought("two.csv", csv_of(NOISE, "time,x,y"))

    def choose(*column: Any) -> np.ndarray:
        answer(made, **change_role(*columns_as_said(made.state), *column))
        return made.measured.recording.acceleration

    np.testing.assert_allclose(choose(1, "x", "g"), NOISE * 9.80665, rtol=1e-5)
    assert made.state.values["unit"] == "g"
    np.testing.assert_allclose(choose(2, "y", "m/s²"), NOISE * [9.80665, 1.0], rtol=1e-5)
    assert columns_as_said(made.state) == (["time", "x", "y"], ["", "g", "m/s²"])
    roles = made.measured.origin.given
    assert [roles[index].unit for index in (1, 2)] == ["g", "m/s²"]
    np.testing.assert_allclose(choose(1, "", "g")[:, 0], NOISE[:, 1], rtol=1e-5)
    assert made.state.values["unit"] == "m/s²"


@pytest.mark.parametrize(
    ("heading", "scale", "roles", "says"),
    [
        ("row,sensor", 1e3, "time ms;y", "10 kHz · speed? · unit?"),
        ("t [s],speed [Hz]", 1.0, "time s;y", "10 kHz · speed? · unit?"),
        ("count,a [g]", 1e9, "time ns;x", "10 kHz · speed? · g "),
    ],
)  # fmt: skip
def test_the_roles_that_a_person_gives_go_before_all_guesses(heading, scale, roles, says):
    """Rate, unit and speed follow from them; a rate that was typed stays."""
    rows = np.column_stack([scale * np.arange(2000) / 1e4, NOISE[:, 0]])
    content = (heading + "\n" + "\n".join(f"{t:.8g},{a:.6g}" for t, a in rows)).encode()
    made = brought("a.csv", content)
    assert not made.state.bad or made.state.columns is not None
    answer(made, columns=roles)
    assert says in made.state.line
    assert made.state.values["sample_rate"] == "10000"
    np.testing.assert_allclose(made.measured.recording.acceleration[:, 0] / (
        9.80665 if "[g]" in heading else 1.0), NOISE[:, 0], rtol=1e-4)  # fmt: skip
    answer(made, sample_rate="5000")
    answer(made, columns=f"time µs;{roles[-1]}")
    assert made.state.values["sample_rate"] == "5000"
    answer(made, columns=f"speed rpm;{roles[-1]}")  # which varies: it is followed
    assert any(words.startswith("from the file:") for _, words in made.state.speeds)


def test_a_rate_that_could_not_be_is_a_question_and_agreeing_settles_it():
    rows = "\n".join(f"{k / 8},{a:.6g}" for k, a in enumerate(NOISE[:, 0]))
    made = brought("a.csv", f"time,a [g]\n{rows}".encode())
    assert made.state.open == ["sample_rate"]
    assert "Is 8000 Hz the sample rate?" in made.state.reasons["sample_rate"]
    assert made.measured is None
    answer(made, sure="yes")
    assert made.measured.recording.sample_rate == 8000.0
    answer(made, unit="m/s²")  # which does not ask again
    assert not made.state.open
    answer(made, columns="time s;y")  # the hand wins, even so
    assert made.measured.recording.sample_rate == 8.0


def test_the_status_line_says_which_step_refuses_or_wants_an_answer():
    """A file that is read is not "not taken", and a refusal stands where the line says."""
    rows = "\n".join(f"{a:.6g},{b:.6g}" for a, b in NOISE)
    made = brought("a.csv", f"ch 1 [g],ch 2 [g]\n{rows}".encode(), signal())
    assert made.measured is None, "no old figure under a new name"
    assert "is read" in made.state.words
    assert made.at_work == WANTED
    answer(made, columns="y;")
    assert made.at_work == WANTED  # of the rate
    answer(made, sample_rate="abc")
    assert made.at_work == NOT_TAKEN.format(1)
    answer(made, sample_rate="8000")
    assert (made.at_work, made.state.reasons["sample_rate"]) == ("", AS_GIVEN)
    answer(made, bearing="designation", designation="22212")
    assert made.at_work == NOT_TAKEN.format(2)
    assert "by its frequencies" in made.state.refused["designation"]
    answer(made, designation="6205", shaft_speed="1.770 rpm")
    assert "1770 rpm?" in made.state.refused["shaft_speed"]
    answer(made, shaft_speed="1770 min-1")
    assert made.measured.shaft_speed == pytest.approx(59.0 * math.pi)


def test_a_bearing_that_the_file_names_is_taken_and_can_be_changed():
    content = b"# Bearing: 6205\n" + csv_of(NOISE[:, :1], "time [s],a [g]")
    made = brought("a.csv", content)
    machine = made.measured.machine
    assert (machine.bearing_name, machine.source_of("bearing")) == ("6205", "from the file")
    answer(made, designation="6206")
    assert made.measured.machine.source_of("bearing") == "given"


async def answered_first():
    """A measurement whose first file has a bearing and a speed by hand."""
    made = measuring()
    await bring(made, "first.csv", csv_of(NOISE[:, :1], "time [s],a [g]"))
    made.take_form({**made.state.values, "bearing": "designation", "designation": "6205",
                    "speed": "given", "shaft_speed": "1500 rpm"})  # fmt: skip
    await settled(made)
    return made


def test_bearing_and_speed_are_kept_for_the_next_file_unless_that_says_otherwise():
    async def steps() -> None:
        made = await answered_first()
        assert made.state.kept_from == ""
        await bring(made, "second.csv", csv_of(NOISE[::-1, :1], "time [s],a [g]"))
        assert made.measured.machine.kept == {"bearing", "speed"}
        assert made.measured.machine.source_of("speed") == "assumed, kept from the previous file"
        assert made.source_of("designation") == "Assumed, kept from the previous file, first.csv"
        assert "1500 rpm? · g · 6205?" in made.state.line
        assert "as for the previous file: the bearing (6205) and" in assumptions(made.question())
        content = b"# rpm = 1797\n" + csv_of(NOISE[:, :1], "time [s],a [g]")
        await bring(made, "third.csv", content)
        assert made.measured.machine.kept == {"bearing"}
        assert made.measured.machine.source_of("speed") == "from the file"
        made.confirm("bearing", "speed")
        await settled(made)
        assert (made.measured.machine.kept, made.state.kept_from) == (frozenset(), "")
        assert made.measured.machine.source_of("bearing") == "given"
        pulses = 5.0 * (np.arange(len(NOISE)) % 100 < 10)
        two = np.column_stack([NOISE[:, 0], pulses])
        await bring(made, "fourth.csv", csv_of(two, "time [s],a [g],tacho [V]"))
        assert made.measured.machine.kept == {"bearing"}, "the speed was the file's"
        made.take_form({**made.state.values, "speed": "given", "shaft_speed": "1500 rpm"})
        await settled(made)
        await bring(made, "fifth.csv", csv_of(two, "time [s],a [g],tacho [V]"))
        assert made.measured.machine.kept == {"bearing", "speed"}
        assert "another speed, from the tachometer: about 6000 rpm" in kept_html(made.state)
        made.forget_machine()
        await settled(made)
        assert (made.measured.bearing, made.state.kept_from) == (None, "")

    run(steps())


def test_an_answer_that_is_typed_again_or_confirmed_is_given_for_this_file():
    async def steps() -> None:
        made = await answered_first()
        await bring(made, "second.csv", csv_of(NOISE[::-1, :1], "time [s],a [g]"))
        for text in ("", "6205"):
            made.take_form({**made.state.values, "designation": text})
            await settled(made)
        assert made.measured.machine.kept == {"speed"}
        assert made.measured.machine.source_of("bearing") == "given"
        form = MachineForm(lambda: made)
        form.show(made.state)
        form._fields.widgets["shaft_speed"].param.trigger("enter_pressed")
        await settled(made)
        assert (made.measured.machine.kept, made.state.kept_from) == (frozenset(), "")
        await bring(made, "105.mat", case_western())
        assert made.measured.machine.guessed == {"bearing"}
        made.confirm("bearing")
        await settled(made)
        assert not made.measured.machine.guessed
        assert made.measured.machine.source_of("bearing") == "given"

    run(steps())


def test_a_gear_ratio_turns_the_measured_speed_into_that_of_the_bearing() -> None:
    pulses = 5.0 * (np.arange(len(NOISE)) % 100 < 10)
    content = csv_of(np.column_stack([NOISE[:, 0], pulses]), "time [s],a [g],tacho [V]")
    made = brought("a.csv", content)
    angle = made.measured.recording.shaft_angle
    answer(made, bearing="designation", designation="6205", speed="file", ratio="23/47")
    turned = made.measured
    assert turned.shaft_speed == pytest.approx(200.0 * math.pi * 23 / 47)
    np.testing.assert_allclose(turned.recording.shaft_angle, angle * 23 / 47)
    assert "2936 rpm (0.4894 ×)" in made.state.line
    spectrum = MeasuredSpectrum(PackedSource())
    spectrum.measure(made)
    drawn = spectrum.data(Model(RIG))[0]["shaft_speed"]
    np.testing.assert_allclose(drawn["rpm"], 6000.0 * 23 / 47, rtol=1e-3)
    spectrum.show_look()
    assert spectrum.speed_plot.visible
    (line,) = [line for line in recording_lines(turned) if "scale_shaft" in line]
    assert line == f"recording = recording.scale_shaft({23 / 47!r})"
    answer(made, ratio="0")
    assert "possible" in made.state.refused["ratio"]
    answer(made, speed="scene", ratio="23/47")  # which is that of the bearing
    assert made.measured.shaft_speed == pytest.approx(RIG.shaft_speed)
    np.testing.assert_allclose(made.measured.recording.shaft_angle, angle)


def test_a_simulated_signal_is_marked_where_its_scene_has_changed() -> None:
    scene = RIG
    made = measuring(simulated(RIG, 20.0, 1), lambda: scene)
    made.take_scene()
    assert made.state.remarks == ""
    scene = RIG.replace(fy=-50.0)
    made.take_scene()
    assert made.state.remarks == EARLIER_SCENE
    scene = RIG
    made.take_scene()
    assert made.state.remarks == ""


def test_one_of_several_recordings_in_a_file_is_chosen_and_columns_that_are_not_used_are_said():
    time = np.concatenate([np.arange(1200), np.arange(800)]) / 10_000.0
    pulses = 5.0 * (np.arange(2000) % 100 < 10)
    values = np.column_stack([time, NOISE, NOISE[::-1, 0], pulses])
    heading = "time [s],a x [g],a y [g],a z [g],tacho [V]"
    content = "\n".join([heading, *(",".join(f"{v:.6f}" for v in row) for row in values)]).encode()
    made = brought("two.csv", content)
    assert [value for value, _ in made.state.recordings] == ["", "1", "2"]
    assert "holds 2 recordings" in made.state.remarks
    assert made.state.line.startswith("two.csv, recording 1 of 2 · ")
    assert "“a z [g]” (along the shaft). The pulses in “tacho [V]”" in made.state.remarks
    assert "give the shaft's angle" in made.state.remarks
    assert ["file", "from the tachometer: about 6000 rpm"] in made.state.speeds
    answer(made, part="2")
    assert made.measured.recording.acceleration.shape == (800, 2)
    assert made.state.words.startswith("two.csv, recording 2 of 2: ")
    assert "one_of_recordings(2)" in "\n".join(recording_lines(made.measured))
    assert [value for value, _ in made.state.recordings] == ["", "1", "2"]
    answer(made, part="3")
    assert made.state.refused == {"part": "two.csv has no such recording."}


def test_columns_given_for_one_file_leave_others_as_they_propose_themselves():
    files = {"alone.csv": NOISE[:, :1], "two.csv": NOISE}
    heads = {"alone.csv": "time [s],a [g]", "two.csv": "time [s],a [g],b [g]"}
    made = brought("rig.zip", zipped(**{name.replace(".", "_"): csv_of(columns, heads[name])
                                        for name, columns in files.items()}))  # fmt: skip
    answer(made, columns="time s;y;")
    joined = made.recordings(made.measured, "y")
    assert [recording.name for recording in joined.recordings] == [
        "rig.zip/alone.csv",
        "rig.zip/two.csv",
    ]
    assert joined.left_out == ()


def test_dated_files_are_in_the_order_of_their_dates_and_the_newest_is_shown():
    dates = {"a_csv": "2026-06-02", "b_csv": "2026-05-01", "c_csv": "2026-05-20"}
    head = "# Machine: Fan 3\n# Point: DE-H\n# Date: {} 09:30\n"
    made = brought("rig.zip", zipped(**{
        name: head.format(date).encode() + csv_of(NOISE[:, :1], "time [s],a [g]")
        for name, date in dates.items()
    }, readme_csv=b"no numbers"))  # fmt: skip
    assert len(made.series.left_out) == 1
    assert made.measured.recording.name == "rig.zip/a.csv"
    series = made.recordings(made.measured, "y").recordings
    assert [recording.name[-5:] for recording in series] == ["b.csv", "c.csv", "a.csv"]
    about = made.known_about
    assert (about.machine, about.point) == ("Fan 3", "DE-H")
    assert about.date == "02 June 2026, 09:30, by the file"


# -- bad files -------------------------------------------------------------------------------------


def bomb() -> bytes:
    """A MATLAB file of some kB that unpacks to 64 MB."""
    packed = zlib.compress(bytes(2**26), 9)
    return b"MATLAB 5.0".ljust(124) + b"\x00\x01IM" + struct.pack("<II", 15, len(packed)) + packed


def text_of_gaps() -> bytes:
    lines = csv_of(NOISE, "time,x,y").decode().splitlines()
    lines[200::200] = [f"{line.partition(',')[0]},nan,inf" for line in lines[200::200]]
    return "\n".join(lines).encode()


BAD = {
    "words": ("w.csv", b"hello world\nhow are you", "a table of numbers"),
    "not finite": ("n.csv", text_of_gaps(), "is not a finite number in"),
    "still": ("k.csv", csv_of(np.ones((2000, 2)), "time,x,y"), "same number throughout"),
    "bomb": ("z.mat", bomb(), "damaged or unknown part"),
}


@pytest.mark.parametrize(("name", "content", "told"), BAD.values(), ids=BAD)
def test_a_bad_file_gets_a_sentence_and_the_signal_before_it_stays(name, content, told):
    made = brought(name, content, before := signal())
    assert made.measured is before
    assert made.state.bad
    assert not made.state.busy
    assert told in made.state.words
    assert name in made.state.words
    assert made.state.words.endswith(f"{before.recording.name} stays.")
    text = [] if name.endswith("mat") else content.decode().splitlines()
    assert made.state.lines.splitlines() == text[:5]  # a person sees why


def test_a_huge_file_is_refused_before_it_is_sent():
    made = measuring()
    wanted: list[int] = []
    made.want = lambda begin, of: wanted.append(begin)
    made.begin_upload("h.csv", MOST_BYTES + 1)
    assert "at most 24 MB" in made.state.words
    assert not wanted


@pytest.mark.parametrize("piece", [b"", bytes(PIECE + 1), bytes(101)])
def test_pieces_that_cannot_be_of_the_file_end_it(piece):
    made = measuring(signal())
    made.begin_upload("a.csv", 100)
    made.take_piece(piece, 1)
    assert "was not received in full" in made.state.words
    said = made.state.words
    made.take_piece(bytes(10), 1)  # nobody asked for it
    assert made.state.words == said


def test_what_is_not_offered_changes_nothing():
    made = measuring(signal())
    made.simulate("another")
    made.take_form({}, True)
    made.begin_upload("a", -3)
    assert "has no size" in made.state.words
    assert made.measured is signal()
    assert not made._jobs.busy()


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_that_comes_along_is_read_without_a_question(name):
    async def opened() -> Measurement:
        made = measuring()
        made.open_record("elsewhere.csv")
        assert made.measured is None
        made.open_record(name)
        await settled(made)
        return made

    made = run(opened())
    assert made.measured is not None
    assert made.measured.recording.sample_rate == pytest.approx(12_000.0)
    assert made.measured.bearing is not None
    assert "1772" in made.state.line + made.state.words
    assert not made.state.open


def test_names_of_files_are_shown_in_short_and_without_tricks():
    assert shown_name("  a \n b\x00\u202e.csv ") == "a b.csv"
    assert shown_name("") == "The file"
    long = shown_name("x" * 300 + "-end.csv")
    assert len(long) <= LONGEST_NAME
    assert long.endswith("-end.csv")
    name = "12k_Drive_End_Bearing_Fault_Data_IR_007_105_0.mat"
    head, tail = without_middle(name, NAME_IN_LINE).split("…")
    assert (name.startswith(head), tail) == (True, "7_105_0.mat")
    made = brought(name, case_western())
    assert made.state.line.startswith(f"{head}…{tail} · 167 ms")
    assert made.state.whole_name == name


def test_what_was_asked_last_wins():
    async def two() -> Measurement:
        made = measuring()
        first, second = csv_of(NOISE, "time,x,y"), csv_of(NOISE[:1000], "time,x,y")
        made.begin_upload("first.csv", len(first))
        made.take_piece(first, 1)  # is being read ...
        made.begin_upload("second.csv", len(second))
        made.take_piece(first, 1)  # late
        made.take_piece(second, 2)
        await settled(made)
        return made

    made = run(two())
    assert made.measured is not None
    assert made.measured.recording.name == "second.csv"
    assert made.state.words.startswith("second.csv")


# -- simulated measurements ------------------------------------------------------------------------


def test_a_simulated_measurement_has_its_noise_and_knows_its_truth():
    quiet = simulated(RIG, math.inf, 1)
    noisy = simulated(RIG, 20.0, 1)
    assert quiet.true_extent == RIG.defects[0].extent
    clean, with_noise = quiet.recording.acceleration, noisy.recording.acceleration
    ratio = np.std(with_noise - clean, axis=0) / np.sqrt(np.mean(clean**2, axis=0))
    assert ratio == pytest.approx([0.1, 0.1], rel=0.03)
    assert quiet.recording.duration * RIG.bearing.bpfo(RIG.shaft_speed) > 50.0


@pytest.mark.parametrize("scene", [RIG.replace(dofs=("z",), fz=10.0), RIG.replace(fy=0.0)])
def test_scenes_that_do_not_move_are_refused_in_a_sentence(scene):
    with pytest.raises(ValueError, match="Not possible"):
        simulated(scene, math.inf, 1)


def test_a_refused_file_says_whose_questions_stay() -> None:
    made = brought("silent.csv", b"time (s),y\n" + b"".join(
        b"%.6f,%.4f\n" % (k / 5000.0, math.sin(0.7 * k)) for k in range(5000)))  # fmt: skip
    made.measured = None
    run(bring(made, "words.txt", b"no numbers here"))
    assert made.state.bad
    assert "words.txt" in made.state.words
    assert made.state.words.endswith("The questions are still those about silent.csv.")
