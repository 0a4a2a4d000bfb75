"""Files as programs, loggers and instruments lay them out, and what must come out of them."""

import csv
import gzip
import io
import math
from collections.abc import Callable
from typing import Any

import h5py
import numpy as np
import pandas as pd
import pytest
from scipy.io import savemat, wavfile

from bearingcore import join_tables, read_recording, read_table
from bearingcore.measured.files import Column, _facts as facts, _table as table
from tests.helpers.saved import matlab, saved, zipped

pytestmark = pytest.mark.usefixtures("files_read_here")

N, RATE = 2000, 8000.0
SIGNAL = np.random.default_rng(11).standard_normal((N, 2)).round(4)
TIME = np.arange(N) / RATE
DATES = pd.date_range("2024-01-01", periods=N, freq="125us")
FRAME = pd.DataFrame({"time": TIME, "acc": SIGNAL[:, 0]})
XY = {"x": 0, "y": 1}
REMARKS = ("Sample Rate\t8000", '"Sample rate","8000 Hz"', "fs 8000", "fs = 8000", "Fs,8000,8000",
           "Sample interval 1.25E-4 s", "# fs = 8000\n# block 0", "fs,8000\nunit,g")  # fmt: skip


def rows(*columns: Any, heading: str = "", delimiter: str = ",", digits: int = 6) -> bytes:
    numbers = np.column_stack(columns).tolist()
    line = delimiter.join([f"%.{digits}f"] * len(numbers[0]))
    lines = [line % tuple(values) for values in numbers]
    return "\n".join([heading, *lines] if heading else lines).encode()


def read(content: bytes | str, name: str = "a.csv") -> Any:
    return read_table(name, content.encode() if isinstance(content, str) else content)


def check_one_signal(read_one: Any, rate: float | None = RATE) -> None:
    """One signal of the whole length is chosen, and the rate is said."""
    contents = read_one.contents
    (index,) = contents.choice.columns.values()
    np.testing.assert_allclose(read_one.columns[:, index], SIGNAL[:, 0], atol=1e-6)
    actual = contents.sample_rate
    assert (actual is None) if rate is None else actual.stated
    assert rate is None or actual.value == pytest.approx(rate, rel=1e-5)


@pytest.mark.parametrize(("unit", "a_second"), [("ms", 1e3), ("µs", 1e6), ("ns", 1e9)])
def test_a_rate_that_no_recorder_has_is_a_question(unit: str, a_second: float) -> None:
    made = read(rows(TIME * a_second, SIGNAL[:, 0], heading="time,acc"))
    rate = made.contents.sample_rate
    assert (rate.value, rate.stated) == (pytest.approx(RATE), False)
    assert f"if it is in {unit};" in rate.reason
    with pytest.raises(ValueError, match=r"sample_rate is missing: pass sample_rate=..., a number"):
        made.recording([1], ["y"], "g")
    by_hand = read_recording(
        "a.csv", rows(TIME * a_second, SIGNAL[:, 0], heading="time,acc"), time_unit=unit, unit="g"
    )
    assert by_hand.sample_rate == pytest.approx(RATE)


@pytest.mark.parametrize("count", [100, 1023])
def test_of_many_columns_all_are_read_under_their_names(count: int) -> None:
    channels = np.tile(SIGNAL[:300, :1], count)
    names = [f"channel {i}" for i in range(count)]
    made = read(rows(TIME[:300], channels, heading=",".join(["time", *names]), digits=6))
    assert made.names == ("time", *names)
    assert "Which is at this bearing?" in made.contents.choice.question
    got = made.with_columns({count: Column("", "signal", "g", "y")}).recording([count], ["y"])
    assert got.sample_rate == pytest.approx(RATE)
    np.testing.assert_allclose(got.acceleration[:, 0], SIGNAL[:300, 0] * 9.80665)


@pytest.mark.parametrize("gap", ["nan", "NaN", "", "-", "NULL", "n/a", "?", "overrun"])
def test_the_longest_part_without_a_missing_number_is_used(gap: str) -> None:
    lines = rows(TIME, SIGNAL[:, 0], heading="time,acc [g]").decode().splitlines()
    for index in range(1201, 1205):
        lines[index] = lines[index].partition(",")[0] + f",{gap}"
    got = read("\n".join(lines)).recording([1], ["y"])
    np.testing.assert_allclose(got.acceleration[:, 0], SIGNAL[:1200, 0] * 9.80665)
    assert "rows 1 to 1200 of 2000" in " ".join(got.notes)


@pytest.mark.parametrize("kept", [-3, -9, -12, -16])
def test_a_last_line_that_is_cut_off_is_left_out(kept: int) -> None:
    content = rows(TIME, SIGNAL[:, 0], heading="time;acc [g]", delimiter=";")[:kept]
    got = read(content).recording([1], ["y"])
    assert len(got.acceleration) in (N - 1, N)
    assert got.sample_rate == pytest.approx(RATE)
    assert (kept in (-3, -9)) or "is cut off" in got.notes[0]  # these are whole rows, or a gap


def test_words_in_many_lines_are_still_refused_with_the_first() -> None:
    lines = rows(TIME, SIGNAL[:, 0]).decode().splitlines()
    lines[500:600] = ["some words"] * 100
    with pytest.raises(ValueError, match=r"line 501 of a\.csv is 'some words'"):
        read("\n".join(lines))


def lines(row: Any, heading: str = "") -> str:
    return "\n".join([*([heading] if heading else []), *(row(i, *SIGNAL[i]) for i in range(N))])


SLOW = 0.5 + np.arange(N) / 99.7


@pytest.mark.parametrize(
    ("text", "rate", "stated", "unit", "signals"),
    [
        (
            lines(lambda i, x, y: f"{x},{y},", "CH1,CH2,Start,Increment,\nVolt,Volt,-0.1,1.25e-4"),
            RATE, True, "V", ["CH1 [Volt]", "CH2 [Volt]"],
        ),
        (
            lines(
                lambda i, x, y: f"{17 * 10**17 + int(1e9 * SLOW[i])},{SLOW[i]:.9f},{y},{x}",
                "time,seconds_elapsed,y,x",
            ),
            99.7, True, None, ["y", "x"],
        ),
        (
            lines(
                lambda i, x, y: f"2024-01-01 10:00:{i // 100:02d},{1 + 10 * i},{x},{y}",
                "Timestamp,Milliseconds,X,Y",
            ),
            100.0, True, None, ["X", "Y"],
        ),
        (
            lines(
                lambda i, x, y: f"{TIME[i]:.6f},{x},{y},{9 * y},{x},{x}",
                "time,accX,GyroX,gyro_z,MagX,X (rad/s)",
            ),
            RATE, True, None, ["accX"],
        ),
        (
            lines(lambda i, x, y: f"{i / 51.63:.6f},{x}", "Time (s),X (m/s^2)"),
            51.63, False, "m/s²", ["X (m/s^2)"],
        ),
        (
            lines(lambda i, x, y: f"{1e-9 * i:.3e},{x}", "x-axis,1\nsecond,Volt"),
            1e9, False, "V", ["column 2 [V]"],
        ),
        (lines(lambda i, x, y: f"{5035400 * i},{x}"), 198.594, False, None, ["column 2"]),
        (
            ";Headers, time,acc\n"
            + lines(lambda i, x, y: f"{1.7e9 + (i + 3 * math.sin(0.11 * i)) / 1690:.6f},{x}"),
            1690, False, None, ["acc"],
        ),
        (f"{N}\n" + lines(lambda i, x, y: f"{TIME[i]:.6f} {x} {y}"), RATE, True, None,
         ["column 2", "column 3"]),
        (
            lines(
                lambda i, x, y: f"2024-1-01 10:0:{TIME[i]:.6f} -0700,my phone,192.168.1.1,{x}",
                "time,device,address,acc",
            ),
            RATE, True, None, ["acc"],
        ),
        (
            lines(lambda i, x, y: f"00:08,{TIME[i]:.6f},{x},,,", "Duration,time,acc,watch"),
            RATE, True, None, ["acc"],
        ),
    ],
)  # fmt: skip
def test_files_of_scopes_phones_and_loggers(text, rate, stated, unit, signals) -> None:
    made = read(text, "run 1 1600Hz.csv" if rate == 1690 else "a.csv").contents
    assert (made.sample_rate.value, made.sample_rate.stated) == (
        pytest.approx(rate, rel=1e-3), stated,
    )  # fmt: skip
    assert (made.unit.value if made.unit.supported else None) == unit  # 1 is usual in g and m/s²
    chosen = made.choice.columns.values() or made.choice.options
    assert {made.columns[index].name for index in chosen} == set(signals)
    assert made.shaft_speed is None


def cells(*each: Any) -> Any:
    made = np.empty(len(each), dtype=object)
    made[:] = each
    return made


@pytest.mark.parametrize(
    "variables",
    [
        {"data": cells({"name": "DE", "y": SIGNAL[:, 0]}, {"name": "NDE", "y": SIGNAL[:, 1]})},
        {"s": {"DE": {"acc": SIGNAL[:, 0]}, "FE": {"acc": SIGNAL[:, 1]}}},
        {"a": {"x": SIGNAL[:, 0], "unit": "g"}, "b": {"x": SIGNAL[:, 1], "unit": "g"}},
    ],
)
def test_signals_that_have_names_of_places_are_asked_about(variables: dict) -> None:
    choice = read(matlab(**variables), "a.mat").contents.choice
    assert not choice.columns
    assert choice.options == (0, 1)
    assert ("several places" in choice.question) == ("a" not in variables)


def hdf5(**sets: tuple[Any, dict[str, Any]]) -> bytes:
    """Data sets, each with what stands beside it."""
    buffer = io.BytesIO()
    with h5py.File(buffer, "w") as file:
        for name, (data, beside) in sets.items():
            made = file.create_dataset(name.replace("__", "/"), data=data)
            made.attrs.update(beside)
    return buffer.getvalue()


def tdms() -> bytes:
    nptdms = pytest.importorskip("nptdms")
    buffer = io.BytesIO()
    said = {"wf_increment": 1.0 / RATE, "unit_string": "g"}
    slow = nptdms.ChannelObject("Slow", "t", np.arange(20.0), {"wf_increment": 0.1})
    with nptdms.TdmsWriter(buffer) as writer:
        writer.write_segment([slow, nptdms.ChannelObject("Vib", "DE", SIGNAL[:, 0], said)])
    return buffer.getvalue()


def uff(tmp_path: Any, binary: int = 0) -> bytes:
    pyuff = pytest.importorskip("pyuff")
    path = tmp_path / "a.uff"
    data_set = {
        "type": 58, "func_type": 1, "binary": binary, "id1": "Bearing DE", "rsp_node": 1,
        "rsp_dir": 2, "ref_node": 1, "ref_dir": 0, "data": SIGNAL[:, 0], "x": TIME,
        "abscissa_inc": 1.0 / RATE, "abscissa_min": 0.0, "abscissa_spacing": 1, "num_pts": N,
        "ordinate_axis_units_lab": "g", "orddenom_spec_data_type": 0,
        "ordinate_spec_data_type": 12, "abscissa_spec_data_type": 17, "z_axis_axis_lab": "NONE",
    }  # fmt: skip
    path.unlink(missing_ok=True)
    pyuff.UFF(str(path)).write_sets([data_set], "add")
    return bytes(path.read_bytes())


def test_formats_of_other_libraries_are_read(tmp_path) -> None:
    check_one_signal(read(tdms(), "a.tdms"))
    for binary in (0, 1):
        made = read(uff(tmp_path, binary), "a.uff")
        check_one_signal(made)
        assert (made.contents.unit.value, made.contents.columns[0].direction) == ("g", "y")
    pytest.importorskip("pyarrow")
    frame = pd.DataFrame({"acc": SIGNAL[:, 0], "word": "x"}, index=DATES)
    check_one_signal(read(saved(frame.to_parquet), "a.parquet"))


def test_a_file_in_a_zip_is_read_and_one_of_several_by_its_name() -> None:
    text = FRAME.to_csv().encode()
    made = read(zipped(run_csv=text), "rig.zip")
    check_one_signal(made)
    assert made.name == "rig.zip/run.csv"
    two = zipped(a_csv=text, b_npy=saved(np.save, SIGNAL[:, 0]))
    with pytest.raises(ValueError, match=r"not of 2 \(a\.csv, b\.npy\).*rig\.zip/a\.csv"):
        read(two, "rig.zip")
    assert table.files_inside("RIG.ZIP", two)[0] == "RIG.zip/a.csv"
    assert table.files_inside("rig.zip", two) == ["rig.zip/a.csv", "rig.zip/b.npy"]
    assert table.files_inside("a.csv", text) == ["a.csv"]
    check_one_signal(read(two, "rig.zip/a.csv"))
    check_one_signal(read(zipped(a_csv=text, README=b"of the rig"), "rig.zip"))
    check_one_signal(read(two, "rig.zip/b.npy"), None)
    with pytest.raises(ValueError, match="unpack it"):
        read(zipped(a_zip=two), "rig.zip")
    with pytest.raises(ValueError, match="a whole zip"):
        read(two[:2000], "rig.zip")


def matlab_table() -> bytes:
    """A table as version 7.3 keeps it: numbers that point into another part of the file."""
    points = np.array([[3707764736, 2, 1, 1, 1, 1]], dtype="u4")
    return hdf5(T=(points, {"MATLAB_object_decode": 3}))


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (zipped(**{"[Content-Types]_xml": b"", "a_xml": b""}), "save its sheet as CSV"),
        (
            f"fs,{','.join(f's{i}' for i in range(N))}\n8000,{','.join(map(str, TIME))}".encode(),
            "turn the table",
        ),
        (b"Octave-1-L\x00", "save -v7"),
        (b"# Created by Octave 8.4.0\n# name: fs\n", "save -v7"),
        (f'date,a\n2024-03-12,"{SIGNAL[:, 0].tolist()}"\n'.encode(), "a number in each cell"),
        (matlab_table(), r"T is a table or an object: save .* acc = T\.acc"),
        (b"\xd0\xcf\x11\xe0" + bytes(100), "save it as .xlsx or CSV"),
        (b"\x89PNG\r\n\x1a\n\x00", "UFF, TDMS, Parquet.*export it as CSV"),
        *(
            (FRAME.to_json(orient=way).encode(), "save the columns of a JSON file as CSV")
            for way in ("columns", "records", "values")
        ),
        (saved(np.save, cells({}, {})), "damaged or unknown part"),
    ],
)
def test_a_refusal_says_what_to_do(content: bytes, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        read(content)


def test_a_format_whose_library_is_not_there_names_it(monkeypatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    for mark, package in (
        (b"TDSm", "npTDMS"),
        (b"PAR1", "pyarrow"),
        (b"    -1\n    58\n", "pyuff"),
        (zipped(**{"xl/workbook.xml": b""}), "openpyxl"),
    ):
        with pytest.raises(ValueError, match=f"pip install {package}.*export it as CSV"):
            read(mark if package == "openpyxl" else mark + bytes(100))


def test_the_longest_sheet_of_excel_is_read() -> None:
    pytest.importorskip("openpyxl")
    made = io.BytesIO()
    with pd.ExcelWriter(made, engine="openpyxl") as book:
        pd.DataFrame({"Machine": ["pump"], "rpm": [1490]}).to_excel(book, sheet_name="Info")
        FRAME[:500].to_excel(book, sheet_name="Data", index=False, startrow=2)
    table = read(made.getvalue(), "a.xlsx")
    np.testing.assert_allclose(table.columns, FRAME[:500], atol=1e-9)
    assert table.contents.sample_rate.value == pytest.approx(RATE)
    assert table.notes == ("Its longest sheet, “Data”, is read.",)
    assert (FACTS["rpm"](table), FACTS["machine"](table)) == (1490.0, "pump")


# -- habits that were read wrongly ----------------------------------------------------------------


@pytest.mark.parametrize("heading", ["Time,Acc", "Time [s],Acc [g]"])
def test_headings_that_come_again_leave_no_gap_where_times_go_on(heading: str) -> None:
    pages = [rows(TIME[i : i + 500], SIGNAL[i : i + 500, 0], heading=heading) for i in (0, 500)]
    contents = read(b"\n".join(pages)).contents
    assert (contents.sampling.first, contents.sampling.last) == (0, 1000)
    anew = [rows(TIME[:500], SIGNAL[i : i + 500, 0], heading=heading) for i in (0, 500)]
    assert "jump once" in read(b"\n".join(anew)).contents.sampling.trouble


@pytest.mark.parametrize("share", [0.002, 0.2])
def test_words_in_place_of_numbers_are_missing_numbers(share: float) -> None:
    there = rows(TIME, SIGNAL[:, 0], heading="time,acc [g]").decode().splitlines()
    for index in range(1501, 1501 + round(share * N)):
        there[index] = there[index].partition(",")[0] + ",OVER"
    made = read("\n".join(there))
    assert made.contents.sampling.last == N  # its time is there
    assert len(made.recording([1], ["y"]).acceleration) == 1500
    coded = [f"{i:.6f},{int(4096 * abs(a)):04X}" for i, a in enumerate(SIGNAL[:, 0])]
    with pytest.raises(ValueError, match="allowed: numbers"):
        read("\n".join(coded))


BOTH = FRAME.assign(other=SIGNAL[:, 1])
LONG = BOTH.melt("time", var_name="place", value_name="v [g]")
LONG["place"] = LONG.place.replace({"acc": "DE", "other": "NDE"})
OF_SENSORS = {
    "blocks": LONG.to_csv(index=False),
    "in turn": LONG.sort_values("time", kind="stable").to_csv(index=False),
    "times apart": LONG.sort_values("time", kind="stable")
    .assign(time=np.arange(2 * N) / (2.0 * RATE)).to_csv(index=False),
    "no times": LONG.drop(columns="time").to_csv(index=False),
    "numbers": LONG.sort_values("time", kind="stable")
    .assign(place=[1, 2] * N).rename(columns={"place": "sensor_id"}).to_csv(index=False),
}  # fmt: skip


@pytest.mark.parametrize("content", OF_SENSORS.values(), ids=list(OF_SENSORS))
def test_rows_of_several_sensors_are_never_one_signal(content: str) -> None:
    with pytest.raises(ValueError, match="a column for each sensor, or a file for each"):
        read(content)


@pytest.mark.parametrize("block", [N // 2, N // 20])
def test_words_along_one_signal_are_no_sensors(block: int) -> None:
    words = np.where((np.arange(N) // block) % 2, "faulty", "sound")
    check_one_signal(read(FRAME.assign(label=words).to_csv(index=False)))


def test_a_column_with_one_number_is_a_fact() -> None:
    once = "\n".join(f"{a:.4f},{1772 if i == 0 else ''},8000" for i, a in enumerate(SIGNAL[:, 0]))
    made = read("acc,RPM,fs\n" + once)
    check_one_signal(made)
    assert made.contents.shaft_speed.value == pytest.approx(1772.0 * math.pi / 30.0)
    short = read(matlab(acc=SIGNAL[:, 0], fs=RATE, rpm=np.full(30, 1772.0)), "a.mat").contents
    assert short.shaft_speed.value == pytest.approx(1772.0 * math.pi / 30.0)
    ramp = read(matlab(acc=SIGNAL[:, 0], fs=RATE, rpm=np.arange(30.0)), "a.mat").contents
    assert ramp.shaft_speed is None  # thirty is how many, not how fast


@pytest.mark.parametrize("words", ["Sensitivity: 100 mV/g", "Sensor: 100 mV/g, S/N 1234"])
def test_the_sensitivity_that_a_file_names_is_used(words: str) -> None:
    volts = f"# {words}\n".encode() + rows(TIME, SIGNAL[:, 0], heading="t [s],ch 1 [mV]")
    got = read_recording("a.csv", volts).acceleration[:, 0]
    np.testing.assert_allclose(got, SIGNAL[:, 0] * 0.0980665, atol=1e-9)
    two = volts.replace(b"mV/g", b"mV/g\n# sensitivity 2: 10 mV/g")
    with pytest.raises(ValueError, match="sensitivity"):
        read_recording("a.csv", two)


def test_numbers_beside_each_other_in_one_array_are_columns() -> None:
    table = np.zeros(N, dtype=[("t", "f8"), ("acc", "f8")])
    table["t"], table["acc"] = TIME, SIGNAL[:, 0]
    for content in (hdf5(rig=(table, {})), saved(np.save, table)):
        check_one_signal(read(content))
    made = read(matlab(acc=SIGNAL.T[:, None, :], fs=RATE), "a.mat")
    np.testing.assert_array_equal(made.columns, SIGNAL)


# -- said by hand ----------------------------------------------------------------------------------

THREE = rows(TIME * 1e3, SIGNAL, heading="a,b,c")


def test_everything_can_be_said_by_hand_in_one_call() -> None:
    got = read_recording(
        "x.csv", THREE, columns={"time": "a", "signal": [1, 2]}, directions="xy", time_unit="ms",
        unit="g", shaft_speed=188.0,
    )  # fmt: skip
    np.testing.assert_allclose(got.acceleration, SIGNAL * 9.80665, atol=1e-5)
    assert (got.sample_rate, got.directions, got.shaft_speed) == (
        pytest.approx(RATE),
        ("x", "y"),
        188.0,
    )
    rate = read_recording("x.csv", THREE, columns={"time": None, "signal": 2}, unit="mV",
                          sensitivity=0.01, sample_rate=9000.0)  # fmt: skip
    assert rate.sample_rate == 9000.0
    np.testing.assert_allclose(rate.acceleration[:, 0], SIGNAL[:, 1] * 0.1, atol=1e-5)
    speed = rows(SIGNAL[:, 0], np.full(N, 25.0), heading="p,q")
    got = read_recording("x.csv", speed, columns={"signal": 0, "speed": 1}, unit="g",
                         speed_unit="Hz", sample_rate=RATE)  # fmt: skip
    assert got.shaft_speed == pytest.approx(50.0 * math.pi)


def test_the_hand_wins_over_what_headings_say() -> None:
    content = rows(TIME, SIGNAL, heading="DE [Hz],NDE [°C],time [s]")
    got = read_recording("x.csv", content, columns={"time": 0, "signal": [1, 2]}, time_unit="s",
                         unit="m/s²", directions=("y", "x"))  # fmt: skip
    np.testing.assert_allclose(got.acceleration, SIGNAL)
    assert got.sample_rate == pytest.approx(RATE)
    slow = read_recording(
        "x.csv", content, columns={"time": 0, "signal": 1}, time_unit="h", unit="g"
    )
    assert slow.sample_rate == pytest.approx(RATE / 3600.0)  # whatever is likely


def test_a_typed_rate_that_nothing_shows_or_the_times_contradict_is_said() -> None:
    alone = rows(SIGNAL[:, 0])
    got = read_recording("x.csv", alone, unit="g", sample_rate=RATE)
    assert "Nothing in the file confirms it" in got.notes[0]
    likely = read_recording("12k.csv", alone, unit="g", sample_rate=RATE)
    assert "“12k” in the file's name suggests 12000 Hz" in likely.notes[0]
    timed = rows(TIME, SIGNAL[:, 0], heading="t [s],a")
    assert read_recording("x.csv", timed, unit="g", sample_rate=RATE).notes == ()
    other = read_recording("x.csv", timed, unit="g", sample_rate=12e3)
    assert other.sample_rate == 12e3
    assert "typed as 12000 Hz; the time column says 8000 Hz" in other.notes[0]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({}, r"columns is missing.* signals of 1 \(“b”\), 2 \(“c”\).*Which is at this bearing"),
        ({"columns": {"signal": 1}}, r"unit is missing: pass unit="),
        ({"columns": {"tim": 1}}, "signal, time, speed, nothing"),
        ({"columns": {"signal": "d"}}, "one of a, b, c"),
        ({"columns": {"speed": 1}}, "speed_unit is missing"),
        ({"columns": {"time": 0}, "time_unit": "Hz"}, "unit is 'Hz'; allowed: s, ms"),
        ({"columns": {"time": [0, 1]}}, "one column of times"),
    ],
)
def test_what_is_still_to_be_said_is_asked_for(arguments: dict, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        read_recording("x.csv", THREE, **arguments)


def test_roles_over_the_columns_are_data_for_a_form() -> None:
    made = read(THREE)
    assert made.first_rows[1] == pytest.approx([0.125, *SIGNAL[1]])
    said = made.with_columns({0: Column("", "time", "ms"), 1: Column("", "other"),
                              "c": Column("", "signal", "g", "x")})  # fmt: skip
    contents = said.contents
    assert [column.role for column in contents.columns] == ["time", "other", "signal"]
    assert [column.name for column in contents.columns] == ["a", "b", "c"]
    assert contents.choice.columns == {"x": 2}
    assert contents.sample_rate.stated
    assert contents.unit.value == "g"
    assert not made.given


def test_a_file_or_one_in_a_zip_is_read_by_its_path_too(tmp_path) -> None:
    (tmp_path / "rig.zip").write_bytes(zipped(run_csv=FRAME.to_csv().encode(), b_csv=b"1"))
    packed = read_recording(tmp_path / "rig.zip" / "run.csv", unit="g")
    assert packed.sample_rate == pytest.approx(RATE)
    path = tmp_path / "run_1797rpm.csv"
    path.write_text(FRAME.to_csv())
    got = read_recording(path, unit="g")
    assert got.shaft_speed is None  # a name suggests it; it does not give it
    suggested = read_table(path.name, path.read_bytes()).contents.shaft_speed
    assert suggested.value == pytest.approx(1797.0 * math.pi / 30.0)
    assert (suggested.stated, suggested.taken) == (False, True)
    with pytest.raises(ValueError, match="No such file"):
        read_recording(tmp_path / "none.csv")


# -- one signal in several files -------------------------------------------------------------------


def parts(times: Any, heading: str = "time,acc [g]") -> list[Any]:
    return [
        read(rows(time, SIGNAL[i * 500 : i * 500 + 500, 0], heading=heading), f"{i}.csv")
        for i, time in enumerate(times)
    ]


def test_files_of_one_signal_are_joined() -> None:
    on = parts(TIME.reshape(4, 500))
    got = join_tables(on).recording([1], ["y"])
    np.testing.assert_allclose(got.acceleration[:, 0], SIGNAL[:, 0] * 9.80665)
    assert got.notes == ("4 files are joined.",)
    anew = join_tables(parts([TIME[:500]] * 4)).recording([1], ["y"])
    np.testing.assert_array_equal(anew.acceleration, got.acceleration)
    assert anew.notes == ("4 files are joined as if nothing were missing between them.",)
    assert on[3].columns[0, 0] == TIME[1500]  # the parts are as they were
    assert "1\u202f000 samples are missing" in join_tables([on[0], on[3]]).contents.sampling.trouble


def test_files_that_do_not_belong_together_are_not_joined(monkeypatch) -> None:
    on = parts(TIME.reshape(4, 500))
    for other, told in (
        (on[::-1], "order of their times"),
        ([on[0], parts([TIME[:500]], "time,b")[0]], "columns of 0.csv"),
        ([on[0], parts([TIME[:500] * 0.5])[0]], "sample rate of 0.csv"),
        ([], "one or more"),
    ):
        with pytest.raises(ValueError, match=told):
            join_tables(other)


# -- one signal ------------------------------------------------------------------------------------


def written(write: Callable[[float, float], str], heading: str = "Time,acc [g]") -> str:
    """A row for each time and acceleration, as `write` writes it."""
    rows = [write(t, a) for t, a in zip(TIME, SIGNAL[:, 0], strict=True)]
    return "\n".join([*([heading] if heading else []), *rows])


def clock_line(begin: float) -> Callable[[float, float], str]:
    def write(t: float, a: float) -> str:
        minute, second = divmod(begin * 60.0 + t, 60.0)
        hour, half = int(minute // 60), "AP"[int(minute >= 720.0)]
        return f"{(hour - 1) % 12 + 1}:{int(minute % 60):02d}:{second:09.6f} {half}M,{a:.4f}"

    return write


def since_1970(size: int) -> str:
    """Rows whose times count seconds of so many parts, to the microsecond."""

    def write(t: float, a: float) -> str:
        micro = 1_700_000_000_000_000 + round(1e6 * t)
        whole, rest = divmod(micro * size, 10**6)
        return f"{whole}.{rest:06d},{a:.4f}" if size < 10**6 else f"{whole},{a:.4f}"

    return written(write, "timestamp,acc")


def join_cells(values: Any, delimiter: str) -> str:
    return delimiter.join(f"{value:.6f}" for value in values)


ALONE = SIGNAL[:, 0]
#: files with one signal, each with its rate and, where it matters, its name
ONE_SIGNAL: list[tuple[Any, ...]] = [
    # the index of a data frame is no signal; an uptime is no time since 1970
    (FRAME.to_csv(), RATE),
    (FRAME.to_csv(sep=";", decimal=","), RATE),
    (FRAME.acc.to_csv(), None),
    (pd.Series(ALONE).to_csv(), None),
    (pd.Series(ALONE, index=TIME).to_csv(), RATE),
    (pd.Series(ALONE, index=DATES).to_csv(), RATE),
    (pd.DataFrame({"acc": ALONE}, index=DATES - DATES[0]).to_csv(), RATE),
    (pd.DataFrame(np.column_stack([TIME, ALONE])).to_csv(index=False), RATE),
    (FRAME.reset_index().to_csv(), RATE),
    (pd.DataFrame({"when": DATES, "acc": ALONE}).to_csv(), RATE),
    (FRAME.assign(time=TIME + 12_345.6).to_csv(), RATE),
    ("Unnamed: 0" + FRAME.to_csv(), RATE),
    (FRAME.to_csv(sep=";", decimal=",", quoting=csv.QUOTE_ALL), RATE),
    (written(lambda t, a: f'"{round(t * RATE) + 1}" {t:.6f} {a}', '"time" "acc"'), RATE),
    # signs of other tables than UTF-8, and remarks above the headings
    ("\ufeff" + FRAME.to_csv(), RATE),
    (FRAME.to_csv().encode("utf-16"), RATE),
    (("Neigung 3°\n" + FRAME.to_csv(index=False)).encode("latin-1"), RATE),
    ("# a remark\r\n\r\nRig 7, run 3\n" + FRAME.to_csv(index=False), RATE),
    # times are known by name and unit in any column
    *((rows(ALONE, TIME * a_second, heading=f"acc [g],{heading}"), RATE) for heading, a_second in (
        ("X_Value", 1.0), ("sec", 1.0), ("milliseconds", 1e3), ("micros", 1e6), ("millis()", 1e3),
        ("Zeitstempel", 1.0), ("elapsed [s]", 1.0), ("X [s]", 1.0), ("Timestamp (ns)", 1e9),
        ("host_time_ns", 1e9), ("Elapsed Time (ms)", 1e3), ("time/s", 1.0), ("TimeStamp", 1.0),
        ("us", 1e6), ("Zeit in ms", 1e3))),
    *((since_1970(size), RATE) for size in (1, 10**3, 10**6, 10**9)),
    # dates and durations as programs write them, a clock over noon and before it
    (written(lambda t, a: f"1/1/2024 10:00:00.{1e6 * t:06.0f} AM,{a}"), RATE),
    (written(lambda t, a: f"01-Jan-2024 10:00:00.{1e6 * t:06.0f},{a}"), RATE),
    (written(lambda t, a: f"0 days 00:00:00.{1e6 * t:06.0f},{a}"), RATE),
    (written(lambda t, a: f"01.01.2024 10:00:00.{1e6 * t:06.0f}+01:00,{a}"), RATE),
    (written(clock_line(12 * 60 + 59.999)), RATE),
    (written(clock_line(11 * 60 + 59.999)), RATE),
    (written(lambda t, a: f"{int(t * 8e3) // 480_000:02d}:{t % 60.0:09.6f},{a:.4f}"), RATE),
    # a column of words is left out, whichever rows have one
    *((written(lambda t, a, where=where: f"{t:.6f}\t{a}" + "\tok" * bool(t in where),
               "time\tacc\tComment"), RATE) for where in ([0.0], [TIME[700]], TIME)),
    # numbers in one row are a column
    *((join_cells(ALONE, delimiter), None) for delimiter in ",; "),
    *((f"time{d}{join_cells(TIME, d)}\nacc{d}{join_cells(ALONE, d)}", RATE) for d in ",; "),
    # a rate above columns that count
    *((written(lambda t, a: f"{round(t * RATE)},{a}", heading), RATE) for heading in (
        "X,CH1,Start,Increment\nSequence,Volt,-3.0e-3,1.25e-04", "# fs = 8000", "fs,8000")),
    # numbers as spreadsheets and programs write them
    (written(lambda t, a: f'"{t + 1.0:.6f}","{a:.4f}"', '"Time (s)","Acceleration, vertical (g)"'),
     RATE),
    (written(lambda t, a: f'"{t:.6f}","{a:.4f}"'.replace(".", ","), '"Time (s)","Acc (g)"'), RATE),
    (written(lambda t, a: f'"{1e3 * t + 2e3:,.3f}","{a:,.4f}"', "Time (ms),Acc (g)"), RATE),
    (written(lambda t, a: f"{1e3 * t + 2e3:,.3f};{a:,.4f}", "Time (ms);Acc (g)"), RATE),
    (written(lambda t, a: f"{1e3 * t + 2e3:,.3f};{a:.4f}".translate({44: 46, 46: 44}),
             "Zeit (ms);Acc (g)"), RATE),
    (written(lambda t, a: f"{1e3 * t + 2e3:,.3f};{a:.4f}".replace(",", "'"), "Time (ms);Acc (g)"),
     RATE),
    (written(lambda t, a: f"{t:.6f} {a:.4f}".replace(".", ","), ""), RATE),
    (written(lambda t, a: f"| {t:.6f} | {a:.4f} |", "| time | acc |\n|---|---|"), RATE),
    (written(lambda t, a: f"{t:.6f},{a:.4f}", "s,g"), RATE),
    (written(lambda t, a: f"{t:.6f},{a:.4f},{5 * (t % 0.03 < 0.01)}", "t,acc [g],Tacho [V]"), RATE),
    (gzip.compress(FRAME.to_csv().encode()), RATE),
    # arrays as NumPy and MATLAB show them, and as NumPy saves them
    *((f"[{delimiter.join(map(str, ALONE.tolist()))}]", None) for delimiter in (" ", ", ")),
    (saved(np.save, ALONE), None, "a.npy"),
    (saved(np.save, np.column_stack([TIME, ALONE]).T), RATE, "a.npy"),
    (saved(np.savez, acc=ALONE, fs=RATE, about=cells({})), RATE, "a.npz"),
    (saved(np.savez, acc=ALONE, fs=RATE, unit="g"), RATE, "a.npz"),
    (saved(np.savez, acc=ALONE, fs=RATE, unit="g"), RATE, "upload"),
]  # fmt: skip


@pytest.mark.parametrize("file", ONE_SIGNAL)
def test_one_signal_is_read_with_its_rate(file: tuple[Any, ...]) -> None:
    content, rate, *name = file
    check_one_signal(read(content, *name), rate)


@pytest.mark.parametrize(("unit", "size"), [("s", 1), ("ms", 10**3), ("µs", 10**6), ("ns", 10**9)])
def test_dates_that_count_from_1970_say_their_unit(unit: str, size: int) -> None:
    assert f"in {unit} since 1970" in read(since_1970(size)).contents.sample_rate.reason


# -- what is said, a file a line -------------------------------------------------------------------

#: a fact of a table by its name here; words are looked for in what is said
FACTS: dict[str, Callable[[Any], Any]] = {
    "names": lambda made: made.names,
    "roles": lambda made: [column.role for column in made.contents.columns],
    "units": lambda made: [column.unit for column in made.contents.columns],
    "places": lambda made: [column.place for column in made.contents.columns],
    "columns": lambda made: made.contents.choice.columns,
    "choice": lambda made: made.contents.choice.reason,
    "options": lambda made: made.contents.choice.options,
    "question": lambda made: made.contents.choice.question,
    "rate": lambda made: stated(made.contents.sample_rate),
    "likely": lambda made: stated(made.contents.sample_rate, False),
    "no rate": lambda made: made.contents.sample_rate,
    "reason": lambda made: made.contents.sample_rate.reason,
    "trouble": lambda made: made.contents.sampling.trouble,
    "unit": lambda made: stated(made.contents.unit),
    "rpm": lambda made: rpm_of(made.contents.shaft_speed),
    "guessed": lambda made: rpm_of(made.contents.shaft_speed, False),
    "why": lambda made: made.contents.shaft_speed.reason,
    "bearing": lambda made: stated(made.contents.designation),
    "machine": lambda made: stated(made.contents.machine),
    "point": lambda made: stated(made.contents.point),
    "recorded": lambda made: str(made.contents.recorded and made.contents.recorded.value),
    "load": lambda made: stated(made.contents.load),
    "note": lambda made: made.contents.choice.note,
}


def stated(fact: Any, sure: bool = True) -> Any:
    """The value of a fact that the file states, or of one that is only likely."""
    return fact.value if fact is not None and fact.stated == sure else None


def rpm_of(fact: Any, sure: bool = True) -> float | None:
    speed = stated(fact, sure)
    return speed if speed is None else round(speed * 30.0 / math.pi, 1)


def note(remark: str) -> bytes:
    """A remark above one signal."""
    return remark.encode() + b"\n" + rows(SIGNAL[:, 0])


def timed(remark: str) -> bytes:
    """A remark above times and a signal."""
    return f"{remark}\n".encode() + rows(TIME, SIGNAL[:, 0], heading="t [s],a [g]")


def two(heading: str) -> bytes:
    """Times and two signals under a heading."""
    return rows(TIME, SIGNAL, heading=heading)


LABVIEW = "LabVIEW Measurement\t\n{}Channels\t2\t\nSamples\t2000\t2000\t\nDelta_X\t{}\t{}\t\n"
LABVIEW += "Y_Unit_Label\tg\t{}\t\n***End_of_Header***\t\t\t\n"
VOLTS = LABVIEW.format("", "1.25E-4", "1.25E-4", "V").encode()
COMMAS = LABVIEW.format("Time\t10:00:00,45\n***End_of_Header***\t\n\n", "1,25E-4", "1,25E-4", "g")
COMMAS += "X_Value\tDE\tNDE\tComment\n"
BESIDE = ["Sample Interval,1.25e-04,", "Source,CH1,", "Vertical Units,V,", *[",,"] * (N - 3)]
DAYS = [f"{45292 + t / 86_400:.12f},{a}" for t, a in zip(TIME, SIGNAL[:, 0], strict=True)]
QUARTERS = [f"{d:%Y-%m-%d %H:%M:%S},{a}" for d, a in zip(
    pd.date_range("2024-01-01", periods=N, freq="6h"), SIGNAL[:, 0], strict=True)]  # fmt: skip
LINES, FIFTY, SPEED = np.arange(N) * 4.0, np.full(N, 50.0), np.full(N, 1480.0)
STEP = {"wf_increment": 1.0 / RATE}
ENVELOPE = np.abs(SIGNAL[:, 1]) + 0.01
SPECTRUM = ["" if i > 800 else f"{i},{v:.4f}" for i, v in enumerate(ENVELOPE)]
CSI = "Equipment: P-101\nMeas. Point: M1H\nDate/Time: 12-Mar-24  09:14:55\nRPM= 1797.  (30 Hz)\n"
CWRU = {f"X097_{side}_time": SIGNAL[:, :1] for side in ("DE", "FE")}

FILES: list[tuple[bytes | str, dict[str, Any]]] = [
    # remarks above one column are no names of it
    (note("# fs = 12000 Hz"), {"rate": 12e3, "rpm": None, "unit": None, "columns": {"y": 0}}),
    (note("# fs=12000,rpm=1797"), {"rate": 12e3, "rpm": 1797.0}),
    (note("# sampling rate 25.6 kHz, speed 1500 rpm"), {"rate": 25.6e3, "rpm": 1500.0}),
    (note("% bearing 6205 outer race, 1797 rpm, fs 12 000 Hz"), {"rate": 12e3, "rpm": 1797.0}),
    (note("rpm = 1797"), {"no rate": None, "rpm": 1797.0}),
    (note("data_rate = 4000.0 Hz"), {"rate": 4e3}),
    (note("# unit: g\n# fs [kHz] = 12"), {"rate": 12e3, "unit": "g"}),
    (note("# acc [g]\n# fs = 12000 Hz"), {"rate": 12e3, "unit": "g"}),
    (note("# load = 500 N"), {"no rate": None, "rpm": None, "unit": None, "columns": {"y": 0}}),
    (note("# duration = 0.5 s"), {"no rate": None, "columns": {"y": 0}}),
    (note("# time resolution 1.25e-4 s"), {"rate": RATE}),
    (note("# Δt = 125 µs"), {"rate": RATE}),
    (note("# sample_rate_Hz 12000"), {"rate": 12e3}),
    (note("Fs [Hz];12000"), {"rate": 12e3}),
    (note("# level 1797 today"), {"no rate": None, "rpm": None, "columns": {"y": 0}}),
    (note("# temperature: 45 °C"), {"no rate": None, "columns": {"y": 0}}),
    (note("# samples = 2000"), {"no rate": None, "columns": {"y": 0}}),
    (note("On Monday beside the temperature sensor"), {"no rate": None, "columns": {"y": 0}}),
    (rows(SIGNAL[:, 0], heading="Logger 7\nSample rate: 25.6 kHz\nShaft speed = 1500 rpm\n"
          "Load; 2,5 kN\nUnit: m/s^2\nvertical"),
     {"names": ("vertical",), "rate": 25.6e3, "rpm": 1500.0, "load": 2500.0, "unit": "m/s²"}),
    # the heading of a single column is kept and its unit used
    *((rows(SIGNAL[:, 0], heading=heading), {"names": (heading,), "unit": unit})
      for heading, unit in (
          ("acc (mg)", "mg"), ("Beschleunigung in m/s^2", "m/s²"), ("a [in/s2]", "in/s²"))),
    # rates that are not sure, or disagree
    (note("# fs = 12.000 Hz"), {"likely": 12e3}),
    (note("# fs: 64.0 Hz"), {"likely": 64.0}),
    (note("# 12 kHz"), {"likely": 12e3}),
    (note("# recorded at 12 kHz"), {"likely": 12e3}),
    (timed("# fs = 12000 Hz"), {"likely": RATE, "reason": "“fs” in the file is 12000 Hz"}),
    (rows(TIME, SIGNAL[:, 0], 2.0 * TIME, SIGNAL[:, 1], heading="t1 [s],a,t2 [s],b"),
     {"rate": None, "reason": "“t2 [s]” says 4000 Hz"}),
    ("Time,acc\n" + "\n".join(DAYS), {"likely": RATE}),
    ("Date,RMS [mm/s]\n" + "\n".join(QUARTERS), {"no rate": None, "trouble": "a trend"}),
    # speeds, of the shaft and of nothing
    (note("rotational speed 185.6 rad/s"), {"no rate": None, "rpm": 1772.3}),
    (note("Running speed: 1772 CPM"), {"no rate": None, "rpm": 1772.0}),
    (note("Nominal speed 1800 rpm"), {"rpm": None, "guessed": None}),
    (note("# Fmax: 20000 Hz"), {"no rate": None, "rpm": None}),
    (rows(TIME, SIGNAL[:, 0], np.full(N, 1480.0), heading="Zeit,Beschl,Drehzahl\ns,g,1/min"),
     {"names": ("Zeit [s]", "Beschl [g]", "Drehzahl [1/min]"), "rpm": 1480.0}),
    # bearings
    *((timed(line), {"bearing": name}) for line, name in (
        ("# Bearing: 6205", "6205"), ("Bearing:;SKF 6205-2RS C3;", "SKF 6205-2RS C3"),
        ("# speed: 1770 rpm, bearing 7208 BECBP", "7208 BECBP"), ("# Lager NJ 2210", "NJ 2210"),
        ("# bearing load 1200 N", None), ("# Bearing: 6205, bearing: 6203", None),
        ("# bearing temperature: 620 K", None))),
    # a remark above two columns names none of them
    *((remark.encode() + b"\n" + rows(SIGNAL, heading="x,y"), {"rate": RATE, "columns": XY})
      for remark in REMARKS),
    *((remark.encode() + b"\n" + rows(SIGNAL),
       {"names": ("column 1", "column 2"), "question": "Which is at this bearing?"})
      for remark in REMARKS),
    # directions and places in headings; V is no volt there
    *((two(heading), {"columns": columns, "unit": None}) for heading, columns in (
        ("t,DE H,DE V", {"x": 1, "y": 2}), ("t,H,V", {"x": 1, "y": 2}),
        ("t,accelX,accelY", {"x": 1, "y": 2}), ("t,DE x,NDE y", {}), ("t,Lager A,Lager B", {}),
        ("t,axial DE,axial NDE", {}), ("t,DE,NDE\n,x,x", {}), ("t,DE,DE\n,x,y", {"x": 1, "y": 2}))),
    # rows of units, and more headings than columns
    *((rows(TIME, SIGNAL, heading=heading, delimiter=";"),
       {"names": names, "rate": RATE, "question": "?"})
      for heading, names in (
          ("Time;Acc DE;Acc NDE\ns;g;g", ("Time [s]", "Acc DE [g]", "Acc NDE [g]")),
          ("Time;A;B\n(s);(g);(mg)\n", ("Time [s]", "A [g]", "B [mg]")),
          ("time;acc de;acc nde;Bemerkung;Flag", ("time", "acc de", "acc nde")),
          ("time;acc de;acc nde;Inspector;Shift", ("time", "acc de", "acc nde")),
          ("time;acc;acc", ("time", "acc, column 2", "acc, column 3")),
          ("time;acc de;acc nde;x", ("column 1", "column 2", "column 3")))),  # which is missing?
    # spectra are no signals over time, and the speed of a converter is not the shaft's
    (rows(LINES, SIGNAL[:, 0], heading="Frequency [Hz],Amplitude [g]"),
     {"question": "spectrum", "columns": {}, "rpm": None, "guessed": None}),
    (rows(LINES, SIGNAL[:, 0], heading="f,Amplitude [g]"), {"question": "spectrum", "columns": {}}),
    (rows(FIFTY, TIME, SIGNAL[:, 0], heading="Frequency [Hz],t1 [s],acc [g]"),
     {"columns": {"y": 2}, "rpm": None, "guessed": None}),
    # a column of words that few rows have
    (written(lambda t, a: f"{t:.6f}\t{a}" + "\tok" * bool(t == TIME[9]), "time\tacc\tComment"),
     {"names": ("time", "acc")}),
    # an oscilloscope writes its settings beside the numbers
    ("\n".join(f"{a},{t - 0.1:.6f},{v:.4f}," for a, t, v in zip(
        BESIDE, TIME, SIGNAL[:, 0], strict=True)),
     {"roles": ["time", "signal"], "rate": RATE, "unit": "V"}),
    # LabVIEW says step and units in its head; a first column may be empty, with decimal commas
    (VOLTS + rows(SIGNAL, heading="DE\tNDE\tComment", delimiter="\t"),
     {"units": ["g", "V"], "rate": RATE, "question": "several places"}),
    (VOLTS.replace(b"g\tV", b"g\tg") + rows(SIGNAL, delimiter="\t"), {"unit": "g"}),
    (COMMAS + "\n".join(f"\t{x:.4f}\t{y:.4f}".replace(".", ",") for x, y in SIGNAL),
     {"names": ("DE", "NDE"), "rate": RATE, "unit": "g"}),
    # collections: how the number of a Case Western file says it was sampled, and a file's name
    (matlab(**CWRU), {"file": "a.mat", "likely": 48e3}),
    (matlab(**CWRU), {"file": "12k_Drive_End_1.mat", "likely": 12e3, "reason": "12k",
                      "columns": {"y": 0}, "choice": "name says drive end"}),
    # what is no vibration over time is named, with what to bring; beside a signal it is left
    *((rows(LINES, SIGNAL[:, 0], heading=heading), {"question": "this is a spectrum"})
      for heading in ("Order,Amplitude [mm/s]", "Frequency [CPM],v [mm/s]", "X [Hz],Y [dB]")),
    *((rows(TIME, SIGNAL[:, 0], heading=f"t [s],{heading}"), {"question": f"is {kind}"})
      for heading, kind in (
          ("PeakVue (G-s)", "an envelope"), ("a [gE]", "an envelope"), ("I (A)", "a current"),
          ("disp [µm pk-pk]", "a displacement"), ("mic [Pa]", "a sound"), ("L [dB]", "a level"))),
    (note("# Signal type: envelope"), {"question": "“Signal type: envelope”: this is an envelope"}),
    (note("# Unit: A"), {"question": "“column 1” is a current"}),
    (note("# Envelope: off\n# FFT lines: 3200"), {"columns": {"y": 0}}),
    (rows(SIGNAL[:, 0] * 0.0 + ENVELOPE, SIGNAL[:, 0]), {"columns": {"y": 1}}),
    ("\n".join(f"{t:.6f},{a},{more or ','}" for t, a, more in zip(
        TIME, SIGNAL[:, 0], SPECTRUM, strict=True)),
     {"roles": ["time", "signal", "other", "other"], "rate": RATE, "columns": {"y": 1}}),
    # the one signal of a file is that signal, whatever its name
    *((rows(TIME, SIGNAL[:, 0], heading=f"time,{name}"), {"columns": {"y": 1}, "note": f"“{name}”"})
      for name in ("z", "acc_z", "axial", "load", "sample")),
    # units, rates and facts as tools name them
    (timed(CSI), {"rpm": 1797.0, "machine": "P-101", "point": "M1H",
                  "recorded": "2024-03-12 09:14:55"}),
    (timed("# Machine: P-1; Point: MDE-H; Date: 2026-06-01"),
     {"machine": "P-1", "point": "MDE-H", "recorded": "2026-06-01 00:00:00"}),
    (timed("x"), {"file": "P-1_2026-06-01.csv", "recorded": "2026-06-01 00:00:00"}),
    (timed("# Date: 03/04/2024"), {"recorded": "None"}),
    (note("# speed 1500 rpm\n# load 2 kN"), {"rpm": 1500.0, "load": 2e3, "columns": {"y": 0}}),
    (note("SampleRate=8000\nUnitName_1=mm/s²\nDataStart=0"), {"rate": RATE, "unit": "mm/s²"}),
    *((note(f"{words}\nQuantity: Acceleration, g"), {"rate": RATE, "unit": "g"})
      for words in ("SampleTime[ms];0.125", "NI_CM_Dt,1.25e-4", "accel_odr_hz: 8000")),
    (rows(TIME, SIGNAL[:, 0], heading="t [s],Accel (G-s)"), {"unit": "g"}),
    *((note(line), {"rate": RATE, "columns": {"y": 0}}) for line in (
        "LIS2DH12 ODR=8000Hz FS=±4g", "Interval: 125 us", "X-axis delta:\t1.25E-4")),
    # dates in one piece, rows that go on, three lines of headings
    (f"Number of points: {N}\nfs = 8000\n" + "\n".join(
        " ".join(map(str, row)) for row in SIGNAL[:, 0].reshape(-1, 5)),
     {"names": ("column 1",), "rate": RATE}),
    ("date,a\n" + "\n".join(
        f"{d:%Y%m%dT%H%M%S.%f}Z,{a}" for d, a in zip(DATES, SIGNAL[:, 0], strict=True)),
     {"rate": RATE}),
    (two("place,DE,NDE\nsensor,acc,acc\ntime,,"), {"question": "(drive end, non-drive end)"}),
    # speeds as they are measured: backwards, with lost marks, overflown, beside the set ones
    *((rows(TIME, SIGNAL[:, 0], speed, heading=f"time,acc_ms2,{name}"), {"rpm": 1480.0})
      for name, speed in (
          ("rpm", -SPEED), ("v [rev/s]", SPEED / 60.0), ("Frequency (rpm)", SPEED),
          *(("rpm", np.where(np.arange(N) % 9, SPEED, lost)) for lost in (0.0, 65_535.0)))),
    (rows(TIME, SIGNAL[:, 0], SPEED + 20.0, SPEED, heading="t,a,n_set [rpm],n_act [rpm]"),
     {"rpm": 1480.0}),
    (rows(SIGNAL[:, 0], SPEED + np.arange(N), heading="acc [g],speed [rpm]"),
     {"rpm": 2479.5, "why": "goes from 1480 to 3479"}),
    *((note(line), {"rpm": 1470.0}) for line in ("shaft: 24.5 Hz", "Unit,RPM\ng,1470")),
    (note("Drehzahl: 1.480 1/min"), {"rpm": None, "guessed": 1480.0}),
    (two("time,Tacho1,acc"), {"columns": {"y": 2}}),
    (rows(TIME, SIGNAL[:, 0], heading="t,strain [µm/m]"), {"question": "is a force or a strain"}),
    (timed("Units,mil pp").replace(b"a [g]", b"value"), {"question": "is a displacement"}),
    # a displacement or a temperature is no signal
    (rows(TIME, TIME, SIGNAL[:, 0], heading="gap [µm],temp [°C],acc [g]"),
     {"roles": ["other", "other", "signal"], "columns": {"y": 2}}),
    # two signals are two directions only where something says so
    *((two(f"time,{names}"), {"file": file, "columns": {}, "options": (1, 2)})
      for file in ("a.csv", "pump_de_nde_fe.csv")
      for names in ("Accel DE,Accel NDE", "DE,FE", "Acc 1,Acc 2", "inboard,outboard",
                    "drive end,opposite drive end", "ch DE,ch 2")),
    *((two(f"time,{names}"), {"columns": {"x": 1, "y": 2}})
      for names in ("acc x,acc y", "horizontal,vertical")),
    *((rows(*[SIGNAL] * (count // 2), *[SIGNAL[:, 0]] * (count % 2)),
       {"columns": {}, "options": tuple(range(count)), "question": f"holds {count} signals"})
      for count in (2, 3)),
    # structs of MATLAB and sets of HDF5, with facts beside each signal
    (matlab(a={n: {"unit": "g", "data": v} for n, v in zip(("DE", "NDE"), SIGNAL.T, strict=True)},
            speed={"value": 1480.0, "unit": "rpm"}, bearing="6205"),
     {"file": "a.mat", "units": ["g", "g"], "rpm": 1480.0, "bearing": "6205",
      "question": "several places"}),
    (hdf5(rig__DE=(SIGNAL[:, 0], STEP | {"unit_string": "g"}),
          rig__NDE=(SIGNAL[:, 1], STEP | {"unit_string": "V"})),
     {"units": ["g", "V"], "rate": RATE, "options": (0, 1)}),
    (hdf5(run__vertical=(SIGNAL[:, 0], {"sampling_rate": RATE, "unit": "mm/s²"})),
     {"names": ("run.vertical",), "rate": RATE, "unit": "mm/s²"}),
    (hdf5(time=(1e3 * TIME, {"units": "ms"}), ch1=(SIGNAL[:, 0], {"location": "DE"}),
          ch2=(SIGNAL[:, 1], {"location": "FE"})), {"rate": RATE, "options": (0, 1), "unit": None}),
]  # fmt: skip


@pytest.mark.parametrize(("content", "said"), FILES)
def test_what_a_file_says(content: bytes | str, said: dict[str, Any]) -> None:
    said = {"file": "a.csv", **said}
    made = read(content, said.pop("file"))
    missing = N - len(made.columns)  # the rows in which an oscilloscope has its settings
    assert missing in (0, 3)
    assert any(np.allclose(column, SIGNAL[missing:, 0], atol=1e-6) for column in made.columns.T)
    for name, expected in said.items():
        fact = FACTS[name](made)
        if name in ("question", "choice", "reason", "trouble", "why", "note"):
            assert expected in fact, name
        elif isinstance(expected, float):
            assert fact == pytest.approx(expected, rel=1e-4), name
        else:
            assert fact == expected, name


NOISE = np.random.default_rng(3).standard_normal((20_480, 8))


def test_case_western_variables_are_of_several_places() -> None:
    sides = {f"X130_{side}_time": NOISE[:5000, :1] for side in ("DE", "FE", "BA")}
    table = read_table("130.mat", matlab(**sides, X130RPM=np.array([[1796]], dtype="u2")))
    contents: Any = table.contents
    assert [column.place for column in contents.columns] == ["drive end", "fan end", "base"]
    assert contents.choice.columns == {"y": 0}  # the faults of this number are at the drive end
    assert not contents.choice.question
    assert contents.bearing.value == "6205-2RS, CWRU drive end"
    assert (contents.unit.value, contents.unit.stated, contents.unit.taken) == ("g", False, True)
    assert (contents.sample_rate.value, contents.sample_rate.stated) == (12_000.0, False)
    assert FACTS["rpm"](table) == 1796.0
    with pytest.raises(ValueError, match="sensors at two places"):
        table.recording(["X130_DE_time", "X130_FE_time"], ["x", "y"], "g", 12e3)
    with pytest.raises(ValueError, match="12000 is likely"):
        table.recording(["X130_DE_time"], ["y"], "g")
    got = table.recording(["X130_DE_time"], ["y"], "g", 12e3)
    assert got.shaft_speed == contents.shaft_speed.value


def test_mfpt_structs_tell_rate_and_speed() -> None:
    run = {"gs": NOISE[:, :1], "sr": 48_828, "rate": 25, "load": "150"}
    table = read_table("run.mat", matlab(bearing=run, BPFO=81.125))
    contents: Any = table.contents
    assert contents.unit.stated
    assert contents.unit.value == "g"
    assert contents.load is None  # nothing says whether it is in pounds
    assert contents.said["BPFO"] == "81.125"
    got = table.recording([0], ["y"])
    assert got.sample_rate == 48_828.0
    assert got.shaft_speed == pytest.approx(2.0 * math.pi * 25.0)
    np.testing.assert_allclose(got.acceleration[:, 0], NOISE[:, 0] * 9.80665)


@pytest.mark.parametrize(
    ("delimiter", "rounding", "begin"), [(",", 0, 65_664.0), (";", -1, 954_410.0)]
)
def test_femto_columns_of_clock_and_signals(delimiter: str, rounding: int, begin: float) -> None:
    """Hours, minutes, seconds, microseconds; some printed as 9.5441e+05. One passes midnight."""
    micro = np.round(begin + np.arange(2560) / 25_600.0 * 1e6, rounding)
    second = np.where(micro >= 1e6, 0.0, 59.0)
    clock = [np.where(second > 0.0, 23.0, 0.0), second, second, micro % 1e6]
    rows = np.column_stack([*clock, NOISE[:2560, :2]])
    told = [
        delimiter.join(
            [*(f"{v:.0f}" for v in row[:3]), f"{row[3]:.5g}", *(f"{v:.4g}" for v in row[4:])]
        )
        for row in rows
    ]
    table = read_table("acc_00001.csv", "\n".join(told).encode())
    contents: Any = table.contents
    assert [column.role for column in contents.columns] == ["time"] * 4 + ["signal"] * 2
    assert contents.choice.columns == {"x": 4, "y": 5}
    assert "FEMTO" in contents.choice.reason
    assert (contents.unit.value, contents.bearing.value) == ("g", "6804RS, FEMTO-ST")
    got = table.recording([4, 5], ["x", "y"], "g")
    assert got.sample_rate == 25_600.0
    assert got.duration == pytest.approx(0.1)


def test_channels_of_structs_are_called_by_their_names() -> None:
    """As the rig of Paderborn saves them: slow channels and currents beside the vibration."""
    channels = np.zeros((1, 3), dtype=[("Name", "O"), ("Type", "O"), ("Data", "O")])
    channels[0, 0] = ("force", "f", NOISE[None, :30, 0])
    channels[0, 1] = ("phase_current_1", "c", NOISE[None, :, 0])
    channels[0, 2] = ("vibration_1", "v", NOISE[None, :, 1])
    table = read_table("KA01_1.mat", matlab(KA01_1={"Info": "rig", "Y": channels}))
    assert table.names[table.contents.choice.columns["y"]] == "KA01_1.Y.vibration_1"


def test_a_velocity_is_differentiated_with_a_note() -> None:
    time = np.arange(4000) / 4000.0
    velocity = 1e3 * np.sin(2.0 * np.pi * 80.0 * time)  # [mm/s]
    content = rows(np.column_stack([time, velocity]), heading="time [s],v [mm/s]")
    got = read_table("v.csv", content).recording([1], ["y"])
    exact = 2.0 * np.pi * 80.0 * np.cos(2.0 * np.pi * 80.0 * time)
    inside = slice(20, -20)
    np.testing.assert_allclose(got.acceleration[inside, 0], exact[inside], atol=0.5)
    assert "differentiated" in got.notes[0]


def test_gravity_in_the_mean_tells_the_unit() -> None:
    shaken = 0.05 * NOISE[:600, :1]
    assert read_table("a.csv", rows(shaken + 1.0)).contents.unit.value == "g"
    assert read_table("a.csv", rows(shaken + 9.81)).contents.unit.value == "m/s²"


@pytest.mark.parametrize(
    ("name", "line", "number", "unit"),
    [
        ("a.csv", "speed: 1797 rpm", 1797.0, "rpm"),
        ("a.csv", "shaft speed = 29.95 Hz", 29.95, "Hz"),
        ("a.csv", "speed: 188 rad/s", 188.0, "rad/s"),
        ("a_1797rpm.csv", "no speed", 1797.0, "rpm"),
        ("a.csv", "shaft frequency: 29.95", 29.95, "Hz"),
    ],
)
def test_a_speed_is_in_si_and_names_the_unit_of_the_file(
    name: str, line: str, number: float, unit: str
) -> None:
    speed = facts.shaft_speed_in(facts.named_in([line]), name)
    assert speed is not None
    in_si = {"rpm": math.pi / 30.0, "Hz": 2.0 * math.pi, "rad/s": 1.0}[unit]
    assert (speed.file_unit, speed.value) == (unit, pytest.approx(number * in_si, rel=1e-12))
    assert speed.in_file_unit == pytest.approx(number, rel=1e-12)


@pytest.mark.parametrize("speed_first", [True, False])
def test_what_rises_like_a_speed_is_no_sure_clock(speed_first: bool) -> None:
    signal, speed = NOISE[:, :1], np.linspace(1200.0, 1800.0, len(NOISE))[:, None]
    both = [speed, signal] if speed_first else [signal, speed]
    rate: Any = read_table("run.csv", rows(np.hstack(both))).contents.sample_rate
    assert not rate.taken
    assert "if it is no speed: it rises from 1200 to 1800" in rate.reason
    time = np.arange(len(NOISE))[:, None] / 8000.0
    rate = read_table("a.csv", rows(np.hstack([time, signal, speed]))).contents.sample_rate
    assert (rate.value, rate.taken) == (8000.0, True)


def test_gaps_matter_only_in_the_columns_taken():
    """The rows to the longest gap are left out, gaps of one are bridged, and notes say so."""
    lines = rows(TIME, SIGNAL, digits=9).decode().splitlines()
    for row in (700, 701, 1500, 1600):
        lines[row] = lines[row].rsplit(",", 1)[0] + ","
    table = read_table("rig.csv", "\n".join(lines).encode())
    assert len(table.recording([1], ["x"], "g").acceleration) == N
    got = table.recording([2], ["y"], "m/s²")
    expected = SIGNAL[702:, 1].copy()
    for row in (1500 - 702, 1600 - 702):
        expected[row] = 0.5 * (expected[row - 1] + expected[row + 1])
    np.testing.assert_allclose(got.acceleration[:, 0], expected, rtol=1e-7, atol=1e-9)
    assert "missing in 2 rows. Each is bridged by the mean" in got.notes[0]
    assert "missing in 2 rows. Only" in got.notes[0]
    assert "rows 703 to 2000 of 2000" in got.notes[0]


@pytest.mark.parametrize(
    ("data", "full_scale"),
    [
        ((SIGNAL * 3000.0).astype(np.int16), 32768.0),
        ((SIGNAL * 1e8).astype(np.int32), 2.0**31),
        ((SIGNAL * 20.0 + 128.0).clip(0, 255).astype(np.uint8), None),
        (SIGNAL.astype(np.float32), 1.0),
    ],
)
def test_wav(data, full_scale):
    table = read_table("rig.wav", saved(wavfile.write, 12_800, data))
    assert table.contents.sample_rate.value == 12_800.0
    wanted = data / full_scale if full_scale else data / 128.0 - 1.0
    got = table.recording([0, 1], ["x", "y"], "m/s²", full_scale=50.0)
    np.testing.assert_allclose(got.acceleration, wanted * 50.0, rtol=1e-6)


@pytest.mark.parametrize("options", [{}, {"do_compression": True}, {"format": "4"}])
def test_matlab(options):
    variables = {
        "vertical": SIGNAL[:, :1],
        "horizontal": SIGNAL[:, 1],
        "fs": RATE,
        "rpm": 420.0,
    }
    if "format" not in options:
        variables |= {"short": SIGNAL[:9], "words": "remark", "turned": SIGNAL * 1j}
    table = read_table("rig.mat", saved(savemat, variables, **options))
    assert table.names == ("vertical", "horizontal")
    assert table.scalars == {"fs": RATE, "rpm": 420.0}
    if "format" not in options:
        assert table.texts == {"words": "remark", "short": "not used: 9 × 2 numbers"}
    got = table.recording(["vertical", "horizontal"], ["y", "x"], "m/s²")
    assert got.sample_rate == RATE
    assert got.shaft_speed == pytest.approx(2.0 * np.pi * 7.0)
    np.testing.assert_allclose(got.acceleration, SIGNAL)


def test_structs_and_cells_are_read_by_their_paths():
    run = {"gs": SIGNAL[:, :1], "sr": 48_828.0, "rate": 25.0, "load": "150"}
    parts = np.empty(2, dtype=object)
    parts[:] = [SIGNAL[:, :1], {"deep": SIGNAL[:, 1:], "word": "inside"}]
    held = {"bearing": run, "parts": parts}
    table = read_table("s.mat", saved(savemat, held, do_compression=True))
    assert table.names == ("bearing.gs", "parts{1}", "parts{2}.deep")
    assert table.scalars == {"bearing.sr": 48_828.0, "bearing.rate": 25.0}
    assert table.texts == {"bearing.load": "150", "parts{2}.word": "inside"}
    np.testing.assert_array_equal(table.columns, SIGNAL[:, [0, 0, 1]])


def test_a_struct_array_is_numbered_and_shorter_vectors_end_earlier():
    runs = np.empty((1, 2), dtype=[("gs", "O")])
    runs["gs"][0] = [SIGNAL[:, 0], SIGNAL[:1500, 1]]
    table = read_table("r.mat", matlab(runs=runs))
    assert table.names == ("runs(1).gs", "runs(2).gs")
    got = table.recording([1], ["y"], "g", 1000.0)
    np.testing.assert_allclose(got.acceleration[:, 0], SIGNAL[:1500, 1] * 9.80665)


def test_what_is_missing_is_counted_in_whole_steps_of_rounded_times():
    time = np.arange(24_000) / 12_000.0
    time[15_001:] += 0.5
    lines = "".join(f"{t:.6f},{np.sin(400.0 * t):.4f}\n" for t in time)
    table = read_table("gap.csv", ("t [s],ay [m/s²]\n" + lines).encode())
    assert "6\u202f000 samples are missing" in table.contents.sampling.trouble
