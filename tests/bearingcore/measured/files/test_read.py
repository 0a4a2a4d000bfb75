"""Files with signals: what is read from good ones, and what is said about bad ones."""

import io

import h5py
import numpy as np
import pytest
from scipy.io import savemat, wavfile

from bearingcore.measured.files import _child as child, _table as table, read_table
from tests.helpers.reading import read_in_this_process
from tests.helpers.saved import matlab, saved

RATE = 12_800.0
N = 3000
SIGNAL = np.random.default_rng(5).standard_normal((N, 2))
TIME = np.arange(N) / RATE


IN_A_PROCESS_OF_ITS_OWN = {
    "test_matlab_7_3_is_read_like_the_versions_before",
    "test_hdf5_names_no_other_files",
    "test_huge_files_are_refused_before_they_are_read",
}


@pytest.fixture(autouse=True)
def quickly(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """A process for each file is tested with some of them, and in `test_child.py`."""
    if request.function.__name__ not in IN_A_PROCESS_OF_ITS_OWN:
        read_in_this_process(monkeypatch)


def text(rows, delimiter=",", heading="", decimal=".") -> bytes:
    lines = [delimiter.join(f"{v:.9g}".replace(".", decimal) for v in row) for row in rows]
    return (heading + "\n".join(lines)).encode()


TABLE = np.column_stack([TIME, SIGNAL])


def test_gaps_matter_only_in_the_columns_taken():
    """The rows to the longest gap are left out, gaps of one are bridged, and notes say so."""
    lines = text(TABLE).decode().splitlines()
    for row in (700, 701, 2000, 2100):
        lines[row] = lines[row].rsplit(",", 1)[0] + ","
    table = read_table("rig.csv", "\n".join(lines).encode())
    assert len(table.recording([1], ["x"], "g").acceleration) == N
    got = table.recording([2], ["y"], "m/s²")
    expected = SIGNAL[702:, 1].copy()
    for row in (2000 - 702, 2100 - 702):
        expected[row] = 0.5 * (expected[row - 1] + expected[row + 1])
    np.testing.assert_allclose(got.acceleration[:, 0], expected, rtol=1e-7, atol=1e-9)
    assert "missing in 2 rows. Each is bridged by the mean" in got.notes[0]
    assert "missing in 2 rows. Only" in got.notes[0]
    assert "rows 703 to 3000 of 3000" in got.notes[0]


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
    variables = {"vertical": SIGNAL[:, :1], "horizontal": SIGNAL[:, 1], "fs": RATE, "rpm": 420.0}
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
    runs["gs"][0] = [SIGNAL[:, 0], SIGNAL[:2000, 1]]
    table = read_table("r.mat", matlab(runs=runs))
    assert table.names == ("runs(1).gs", "runs(2).gs")
    got = table.recording([1], ["y"], "g", 1000.0)
    np.testing.assert_allclose(got.acceleration[:, 0], SIGNAL[:2000, 1] * 9.80665)


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


def test_matlab_7_3_is_read_like_the_versions_before():
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


def test_a_cut_file_of_matlab_7_3_is_refused():
    with pytest.raises(ValueError, match="damaged or unknown part"):
        read_table("a.mat", hdf5(matlab_7_3)[:9000])


def test_huge_files_are_refused_before_they_are_read(monkeypatch):
    monkeypatch.setattr(table, "MOST_BYTES", 2**20)
    with pytest.raises(ValueError, match=r"size of a.csv is '2 MB'.*split it by rows .* join"):
        read_table("a.csv", bytes(2**21))
    monkeypatch.setattr(child, "MOST_NUMBERS", 5000)
    with pytest.raises(ValueError, match=r"count of numbers in a\.csv is 'over 5000'"):
        child.read_file("a.csv", text(TABLE))


def test_what_is_missing_is_counted_in_whole_steps_of_rounded_times():
    time = np.arange(24_000) / 12_000.0
    time[15_001:] += 0.5
    lines = "".join(f"{t:.6f},{np.sin(400.0 * t):.4f}\n" for t in time)
    table = read_table("gap.csv", ("t [s],ay [m/s²]\n" + lines).encode())
    assert "6\u202f000 samples are missing" in table.contents.sampling.trouble
