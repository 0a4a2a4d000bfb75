"""Files that are made to take all time and memory of whoever reads them."""

import io
import struct
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from bearingcore.measured.files import (
    _child as child,
    _libraries as libraries,
    _table as table,
    read_file,
    read_table,
    read_text,
)
from tests.helpers.saved import zipped

SIGNAL = np.random.default_rng(5).standard_normal((3000, 2))
TIME, MEMORY = r"read within \d+ s", r"read in \d+ MB"


def element(kind: int, data: bytes) -> bytes:
    """A part of a MATLAB file of version 5."""
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(flags: int, shape: list[int], name: bytes, inside: bytes) -> bytes:
    """A matrix of class `flags` in such a file."""
    size = struct.pack(f"<{len(shape)}i", *shape)
    described = element(6, struct.pack("<II", flags, 0)) + element(5, size) + element(1, name)
    return element(14, described + inside)


def version_5(content: bytes) -> bytes:
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + content


def cell_of_many_dimensions(count: int) -> bytes:
    return version_5(matrix(1, [1] * count, b"a", b""))


def long_name_of_many_texts() -> bytes:
    """A cell whose name of 12 MB would be the beginning of 9000 names."""
    texts = matrix(4, [1, 3], b"", element(16, b"abc")) * 9000
    return version_5(matrix(1, [1, 9000], b"n" * 12_000_000, texts))


def million_empty_variables() -> bytes:
    return (struct.pack("<5i", 0, 0, 0, 0, 2) + b"a\x00") * 1_000_000


def empty_chunks() -> bytes:
    head = b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 1, 1, 8000, 16000, 2, 16)
    body = head + b"LIST\x00\x00\x00\x00" * 3_000_000
    return b"RIFF" + struct.pack("<I", len(body)) + body


def attributes_under_many_names() -> bytes:
    buffer = io.BytesIO()
    with h5py.File(buffer, "w") as file:
        data = file.create_dataset("d", data=np.arange(4.0))
        for index in range(90):
            data.attrs[f"a{index}"] = 1.0
        for index in range(4000):
            file[f"n{index}"] = data
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "allowed"),
    [
        ("a.mat", lambda: cell_of_many_dimensions(6_000_000), "a whole MATLAB file"),
        ("a.mat", long_name_of_many_texts, f"{MEMORY}|{TIME}"),
        ("a.mat", million_empty_variables, f"{TIME}|vector or matrix"),
        ("a.wav", empty_chunks, f"{TIME}|a whole WAV file"),
        ("a.h5", attributes_under_many_names, f"{TIME}|number of rows"),
        ("a.csv", lambda: b"12:00:00,2\n" * 4_000_000 + b"x", f"{TIME}|{MEMORY}|line 4000001"),
    ],
)
@pytest.mark.skipif(sys.platform != "linux", reason="the system sets no limit of memory")
@pytest.mark.proof
def test_hostile_files_end_in_a_sentence(name, content, allowed, monkeypatch, tmp_path) -> None:
    """Computing is bounded more tightly here, so that this takes less time."""
    monkeypatch.setattr(child, "PROCESSOR_SECONDS", 2)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with pytest.raises(ValueError, match=allowed):
        read_table(name, content())
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform == "win32", reason="signals end a process differently")
@pytest.mark.parametrize(
    ("program", "allowed"),
    [
        ("import os; os.abort()", "damaged"),
        ("while True: pass", "within"),
        ("print('[' * 10**8)", "damaged"),
        ("print('{\"shape\": [9, 9]}')", "damaged"),
        ("print('{\"shape\": [1000000000, 9]}')", "damaged"),
    ],
)
def test_whatever_the_process_does_is_survived(program, allowed, monkeypatch, tmp_path) -> None:
    script = Path(tmp_path) / "program.py"
    script.write_text(program)
    monkeypatch.setattr(child, "_PROGRAM", script)
    if allowed == "within":
        monkeypatch.setattr(child, "WALL_SECONDS", 1.0)
    with pytest.raises(ValueError, match=f"file is 'a.csv'.*{allowed}"):
        read_file("a.csv", b"1,2\n" * 10**6)


def test_a_process_ends_once_its_answer_is_not_wanted(monkeypatch, tmp_path) -> None:
    script = Path(tmp_path) / "program.py"
    script.write_text("while True: pass")
    monkeypatch.setattr(child, "_PROGRAM", script)
    asked: list[bool] = []
    began = time.monotonic()
    with pytest.raises(ValueError, match="allowed"):
        read_file("a.csv", b"1,2\n", give_up=lambda: asked.append(True) or len(asked) > 2)
    assert time.monotonic() - began < child.WALL_SECONDS / 2
    assert len(asked) == 3


def test_a_zip_is_bounded_as_a_whole(monkeypatch) -> None:
    content = zipped(a_csv=b"1\n" * 600, b_csv=b"1\n" * 600)
    monkeypatch.setattr(libraries, "MOST_TOGETHER", 2_000)
    with pytest.raises(ValueError, match="a zip of at most"):
        libraries.unzip("rig.zip", content)
    assert libraries.unzip("rig.zip/a.csv", content)[0] == ["a.csv"]


def hdf5(fill) -> bytes:
    """A file of MATLAB's version 7.3: HDF5 after 512 bytes of text."""
    buffer = io.BytesIO()
    with h5py.File(buffer, "w", userblock_size=512) as file:
        fill(file)
    content = bytearray(buffer.getvalue())
    content[:116] = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116)
    content[124:128] = b"\x00\x02IM"
    return bytes(content)


def matlab_7_3(file) -> None:
    """Write a struct `bearing` with numbers and words, and a cell that points, as MATLAB does."""
    bearing = file.create_group("bearing")
    bearing.attrs["MATLAB_class"] = b"struct"
    bearing["gs"] = SIGNAL[:, :1].T  # MATLAB's columns are rows here
    bearing["sr"] = np.array([[48_828]], dtype="u2")
    bearing["rate"] = np.array([[25.0]])
    bearing["load"] = np.array([[ord(letter)] for letter in "150"], dtype="u2")
    bearing["load"].attrs["MATLAB_class"] = np.bytes_(b"char")
    kept = file.create_group("#refs#").create_dataset("b", data=SIGNAL[:, 1:].T)
    file.create_dataset("cell", data=np.array([[kept.ref]], dtype=h5py.ref_dtype))


def test_matlab_7_3_is_read_like_the_versions_before_and_refused_where_it_is_cut():
    with pytest.raises(ValueError, match="damaged or unknown part"):
        read_table("a.mat", hdf5(matlab_7_3)[:9000])
    table = read_table("new.mat", hdf5(matlab_7_3))
    assert table.names == ("bearing.gs", "cell")
    assert table.scalars == {"bearing.sr": 48_828.0, "bearing.rate": 25.0}
    assert table.texts == {"bearing.load": "150"}
    np.testing.assert_array_equal(table.columns, SIGNAL)
    assert table.contents.sample_rate.value == 48_828.0


def test_hdf5_names_no_other_files(tmp_path):
    """External links, data kept outside and views of other files would read this machine."""
    (tmp_path / "secret").write_bytes(SIGNAL.tobytes())
    with h5py.File(tmp_path / "other.h5", "w") as other:
        other["a"] = SIGNAL

    def fill(file):
        file["linked"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "/a")
        file["soft"] = h5py.SoftLink("/own")
        external = [(str(tmp_path / "secret"), 0, SIGNAL.nbytes)]
        file.create_dataset("outside", SIGNAL.shape, "f8", external=external)
        layout = h5py.VirtualLayout(SIGNAL.shape, "f8")
        layout[:] = h5py.VirtualSource(str(tmp_path / "other.h5"), "a", SIGNAL.shape)
        file.create_virtual_dataset("view", layout)
        file["own"] = SIGNAL[:, 0]

    assert read_table("x.mat", hdf5(fill)).names == ("own",)


def test_huge_files_are_refused_before_they_are_read(monkeypatch):
    monkeypatch.setattr(table, "MOST_BYTES", 2**20)
    with pytest.raises(ValueError, match=r"size of a.csv is '2 MB'.*split it by rows .* join"):
        read_table("a.csv", bytes(2**21))
    with pytest.raises(ValueError, match=r"count of numbers in a\.csv is 'over 5000'"):
        read_text("a.csv", b"1,2\n" * 3000, 5000)
