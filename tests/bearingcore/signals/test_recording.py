"""Files with signals: what is read from good ones, and what is said about bad ones."""

import contextlib
import io
import random
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.io import savemat, wavfile

from bearingcore.signals import recording
from bearingcore.signals.recording import Recording, read_table

RATE = 12_800.0
N = 3000
SIGNAL = np.random.default_rng(5).standard_normal((N, 2))
TIME = np.arange(N) / RATE


def text(rows, delimiter=",", heading="", decimal=".") -> bytes:
    lines = [delimiter.join(f"{v:.9g}".replace(".", decimal) for v in row) for row in rows]
    return (heading + "\n".join(lines)).encode()


def wav(data, rate=12_800) -> bytes:
    buffer = io.BytesIO()
    wavfile.write(buffer, rate, data)
    return buffer.getvalue()


def matlab(variables, **options) -> bytes:
    buffer = io.BytesIO()
    savemat(buffer, variables, **options)
    return buffer.getvalue()


TABLE = np.column_stack([TIME, SIGNAL])


@pytest.mark.parametrize(
    "content",
    [
        text(TABLE),
        text(TABLE, heading="time,x,y\n"),
        text(TABLE, heading="# a remark\r\n\r\nRig 7, run 3\ntime [s],horizontal,vertical\n"),
        text(TABLE, delimiter=";", decimal=",", heading="Zeit;x;y\n"),
        text(TABLE, delimiter="\t", heading="t\tx\ty\n"),
        text(TABLE, delimiter="  "),
        text(TABLE, delimiter=";").replace(b"\n", b";\n"),
        b"\xef\xbb\xbf" + text(TABLE, heading="time,x,y\n"),
        text(TABLE).decode().encode("utf-16"),
        text(TABLE, heading="Neigung 3\u00b0\nt,x,y\n").decode().encode("latin-1"),
        text(np.column_stack([TIME * 1e3, SIGNAL]), heading="time [ms],x,y\n"),
    ],
)
def test_text_in_many_habits_gives_the_same_recording(content):
    table = read_table("rig.csv", content)
    assert table.time_column == 0
    assert table.suggested_rate == pytest.approx(RATE, rel=1e-5)
    got = table.recording([1, 2], ["x", "y"], "m/s²")
    assert got.sample_rate == pytest.approx(RATE, rel=1e-5)
    np.testing.assert_allclose(got.acceleration, SIGNAL, rtol=1e-7, atol=1e-9)


def test_headings_name_the_columns_and_g_is_standard_gravity():
    table = read_table("rig.csv", text(TABLE, heading="time,horizontal,vertical\n"))
    assert table.names == ("time", "horizontal", "vertical")
    got = table.recording(["vertical"], ["y"], "g", full_scale=2.0)
    np.testing.assert_allclose(got.acceleration[:, 0], SIGNAL[:, 1] * 2.0 * 9.80665, rtol=1e-7)
    assert got.directions == ("y",)
    assert got.duration == pytest.approx(N / RATE, rel=1e-5)


def test_a_file_without_a_rate_asks_for_it():
    table = read_table("rig.csv", text(SIGNAL))
    assert table.suggested_rate is None
    with pytest.raises(ValueError, match="sample_rate is None"):
        table.recording([0], ["y"], "g")
    assert table.recording([0], ["y"], "g", sample_rate=500.0).sample_rate == 500.0


def test_dropped_samples_are_no_even_time():
    short = np.delete(TABLE, slice(1000, 1010), axis=0)
    table = read_table("rig.csv", text(short, heading="t,x,y\n"))
    assert table.suggested_rate is None


def test_gaps_matter_only_in_the_columns_taken():
    lines = text(TABLE).decode().splitlines()
    lines[700] = lines[700].rsplit(",", 1)[0] + ","
    table = read_table("rig.csv", "\n".join(lines).encode())
    assert table.recording([1], ["x"], "g").duration > 0.0
    with pytest.raises(ValueError, match="not a finite number in 1 samples, first in number 701"):
        table.recording([2], ["y"], "g")


@pytest.mark.parametrize(
    ("data", "one"),
    [
        ((SIGNAL * 3000.0).astype(np.int16), 32768.0),
        ((SIGNAL * 1e8).astype(np.int32), 2.0**31),
        ((SIGNAL * 20.0 + 128.0).clip(0, 255).astype(np.uint8), None),
        (SIGNAL.astype(np.float32), 1.0),
    ],
)
def test_wav(data, one):
    table = read_table("rig.wav", wav(data))
    assert table.suggested_rate == 12_800.0
    wanted = data / one if one else data / 128.0 - 1.0
    got = table.recording([0, 1], ["x", "y"], "m/s²", full_scale=50.0)
    np.testing.assert_allclose(got.acceleration, wanted * 50.0, rtol=1e-6)


@pytest.mark.parametrize("options", [{}, {"do_compression": True}, {"format": "4"}])
def test_matlab(options):
    variables = {"DE_time": SIGNAL[:, :1], "FE_time": SIGNAL[:, 1], "fs": RATE, "rpm": 420.0}
    if "format" not in options:
        variables |= {"short": SIGNAL[:9], "words": "remark", "boxes": {"a": SIGNAL}}
    table = read_table("rig.mat", matlab(variables, **options))
    assert table.names == ("DE_time", "FE_time")
    assert table.scalars == {"fs": RATE, "rpm": 420.0}
    got = table.recording(["DE_time", "FE_time"], ["y", "x"], "m/s²")
    assert got.sample_rate == RATE
    np.testing.assert_allclose(got.acceleration, SIGNAL)


def bomb() -> bytes:
    """A small MATLAB file that unpacks to a gigabyte."""
    packed = zlib.compress(struct.pack("<II", 14, 2**30) + bytes(2**29), 9)
    head = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM"
    return head + struct.pack("<II", 15, len(packed)) + packed


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("a.csv", b"", "allowed: one that is not empty"),
        ("a.csv", b"\n\n# nothing\n", "lines of numbers"),
        ("a.csv", b"hello\nworld\n", "a table of numbers"),
        ("a.csv", b"words\n" * 5000, "a table of numbers"),
        ("a.csv", text(TABLE) + b"\nseventeen,2,3\n", "line 3001 of a.csv"),
        ("a.csv", text(TABLE) + b"\n1,2\n", "3 columns as in the first"),
        ("a.csv", text(TABLE[:20]), "number of rows in a.csv is 20"),
        ("a.csv", b",".join([b"1"] * 100) + b"\n" + text(TABLE), "columns"),
        ("a.png", b"\x89PNG\r\n\x1a\n\x00\x00" + bytes(1000), "text with numbers"),
        ("a.wav", b"RIFF\x00\x00\x00\x00WAVE", "a whole WAV file"),
        ("a.wav", wav(SIGNAL.astype(np.float32))[:30], "a whole WAV file"),
        ("a.mat", b"MATLAB 5.0 MAT-file", "MATLAB file"),
        ("a.mat", b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(600), "'-v7'"),
        ("a.mat", b"\x89HDF\r\n\x1a\n".ljust(600), "'-v7'"),
        ("a.mat", b"random text that is no such file".ljust(600), "MATLAB file"),
        ("a.mat", matlab({"words": "only"}), "vector or matrix"),
        ("a.mat", matlab({"a": SIGNAL[:10]}), "number of rows in a.mat is 10"),
        ("a.mat", matlab({"a": SIGNAL * 1j}), "vector or matrix"),
        ("a.mat", matlab({"a": np.zeros((500, 400))}), "number of columns in a.mat is 400"),
    ],
)
def test_bad_files_are_refused_with_a_sentence(name, content, told):
    with pytest.raises(ValueError, match=told) as caught:
        read_table(name, content)
    assert "\n" not in str(caught.value)


def test_huge_files_are_refused_before_they_are_read(monkeypatch):
    monkeypatch.setattr(recording, "MOST_BYTES", 2**20)
    with pytest.raises(ValueError, match=r"size of a.csv is '2 MB'"):
        read_table("a.csv", bytes(2**21))
    with pytest.raises(ValueError, match="over 4 MB once unpacked"):
        read_table("a.mat", bomb())
    monkeypatch.setattr(recording, "MOST_NUMBERS", 5000)
    with pytest.raises(ValueError, match=r"count of numbers in a\.csv is 9000"):
        read_table("a.csv", text(TABLE))


@pytest.mark.parametrize(
    ("signal", "changes", "told"),
    [
        (SIGNAL, {"sample_rate": 0.0}, "sample_rate is 0"),
        (SIGNAL, {"sample_rate": float("nan")}, "sample_rate is nan"),
        (SIGNAL, {"directions": ("y",)}, "a column for each direction: y"),
        (SIGNAL, {"directions": ("y", "z")}, "x, y or both"),
        (SIGNAL[:, 0], {}, "a column for each direction: x, y"),
        (SIGNAL[:100], {}, "100 samples long"),
        (SIGNAL * [1.0, np.inf], {}, "finite"),
        (SIGNAL * [1.0, 0.0], {}, "the same number throughout along y"),
    ],
)
def test_recordings_refuse_what_is_no_signal(signal, changes, told):
    arguments = {"sample_rate": RATE, "directions": ("x", "y")} | changes
    with pytest.raises(ValueError, match=told):
        Recording(signal, **arguments)


@pytest.mark.parametrize(
    ("columns", "directions", "unit", "told"),
    [
        ([5], ["y"], "g", "column is 5"),
        (["z"], ["y"], "g", "column is 'z'"),
        ([True, 1], ["x"], "g", "columns"),
        ([1, 1], ["x", "y"], "g", "different ones, one a direction"),
        ([1], ["y"], "mm/s", "unit is 'mm/s'"),
    ],
)
def test_tables_refuse_what_they_do_not_have(columns, directions, unit, told):
    table = read_table("a.csv", text(TABLE, heading="time,x,y\n"))
    with pytest.raises(ValueError, match=told):
        table.recording(columns, directions, unit)


WHOLE = {
    "a.csv": text(TABLE[:400], heading="time,x,y\n"),
    "a.wav": wav((SIGNAL[:400] * 1000).astype(np.int16)),
    "a.mat": matlab({"a": SIGNAL[:400], "fs": RATE}, do_compression=True),
    "b.mat": matlab({"a": SIGNAL[:400], "fs": RATE}),
}


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(sorted(WHOLE)), st.integers(0, 2**32 - 1))
def test_damaged_files_are_read_or_refused_but_never_fail_otherwise(name, seed):
    draw = random.Random(seed)
    content = bytearray(WHOLE[name])
    for _ in range(draw.randint(1, 12)):
        reach = min(len(content), draw.choice([64, 400, 10**6]))
        content[draw.randrange(reach)] = draw.randrange(256)
    if draw.random() < 0.3:
        del content[draw.randrange(len(content)) :]
    with contextlib.suppress(ValueError):
        table = read_table(name, bytes(content))
        assert table.columns.shape[1] == len(table.names)
        assert table.columns.dtype == float
