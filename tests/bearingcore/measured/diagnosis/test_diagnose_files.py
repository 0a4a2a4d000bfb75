"""A file, or a folder of files, is diagnosed in one call; what is missing is asked by name."""

import math
from pathlib import Path

import numpy as np
import pytest

from bearingcore import Recording, diagnose
from bearingcore.bearings import bearing_of

pytestmark = pytest.mark.usefixtures("files_read_here")

RATE, TURNS = 12_000.0, 30.0
SPEED = 2.0 * math.pi * TURNS


def outer_race_signal(seed: int = 1) -> np.ndarray:
    """Blows at the BPFO of a 6205, each ringing at 3 kHz, in noise."""
    rng = np.random.default_rng(seed)
    time = np.arange(int(2.0 * RATE)) / RATE
    signal = 0.1 * rng.standard_normal(len(time))
    passing = bearing_of("6205").bpfo(SPEED)
    for k in range(int(1.9 * passing)):
        since = time - (k + 0.004 * rng.standard_normal()) / passing - 0.01
        hit = (since >= 0.0) & (since < 0.01)
        signal[hit] += np.exp(-600.0 * since[hit]) * np.sin(2e3 * math.pi * 3.0 * since[hit])
    return signal


def write(path: Path, heading: str, *columns: np.ndarray) -> Path:
    table = np.stack(columns, axis=1)
    np.savetxt(path, table, "%.6g", ",", header=heading, comments="", encoding="utf-8")
    return path


SIGNAL = outer_race_signal()
TIME = np.arange(len(SIGNAL)) / RATE


def test_a_file_that_says_all_needs_its_bearing_alone(tmp_path: Path) -> None:
    path = write(tmp_path / "de_1800rpm.csv", "time (s),vertical (m/s²)", TIME, SIGNAL)
    diagnosis = diagnose(path, "6205")
    assert diagnosis.fault == "outer race"
    assert diagnosis.speed_source.startswith("assumed: “1800rpm” in the file's name")
    assert diagnosis.shaft_speed == pytest.approx(SPEED, rel=0.01)
    assert diagnose(str(path), bearing="6205").sentence == diagnosis.sentence
    same = diagnose(Recording(SIGNAL[:, None], RATE, ("y",)), "6205", SPEED)
    assert same.fault == diagnosis.fault
    assert diagnose(path, "6205", 2.0 * SPEED).shaft_speed != pytest.approx(SPEED, rel=0.1)


def test_what_a_file_does_not_say_is_asked_by_name_and_can_be_given(tmp_path: Path) -> None:
    path = write(tmp_path / "two.csv", "a,b", SIGNAL, np.roll(SIGNAL, 50))
    asked = r"columns is missing.* signals of 0 \(“a”\), 1 \(“b”\).*two.csv: .*holds 2 signals"
    with pytest.raises(ValueError, match=asked):
        diagnose(path, "6205", SPEED)
    with pytest.raises(ValueError, match=r"sample_rate is missing: pass sample_rate=..., a number"):
        diagnose(path, "6205", SPEED, columns=("b",))
    diagnosis = diagnose(path, "6205", SPEED, columns=("b",), sample_rate=RATE)
    assert diagnosis.fault == "outer race"
    in_g = diagnose(path, "6205", SPEED, columns=(0, 1), sample_rate=RATE, unit="g")
    assert in_g.fault == "outer race"


def test_a_folder_is_a_table_of_answers_and_says_what_was_not_read(tmp_path: Path) -> None:
    write(tmp_path / "b_1800rpm.csv", "time (s),vertical (m/s²)", TIME, SIGNAL)
    noise = np.random.default_rng(3).standard_normal(len(TIME))
    write(tmp_path / "a_1800rpm.csv", "time (s),vertical (m/s²)", TIME, noise)
    for name in ("notes.txt", ".hidden", "README.md", "readme.txt", "rig.png"):
        (tmp_path / name).write_text("Measured on a Monday.\n", encoding="utf-8")
    folder = diagnose(tmp_path, "6205")
    table = folder.table()
    assert list(table["file"]) == ["a_1800rpm.csv", "b_1800rpm.csv", "notes.txt"]
    assert table["fault"][1] == "outer race"
    assert table["fault"][0] != "outer race"
    assert table["fault"][2] == "not read"
    assert folder.answers[2] is None
    assert "notes.txt" in folder.sentences[2]
    assert repr(folder).startswith("FolderDiagnosis(names")
    assert np.isnan(table["probability"][2])
    assert table["sentence"][1] == folder.answers[1].sentence
    printed = " ".join(str(folder).split())
    assert all(f"{name}: {' '.join(words.split())}" in printed
               for name, words in zip(folder.names, folder.sentences, strict=True))  # fmt: skip


def test_an_empty_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="a folder with records in it"):
        diagnose(tmp_path, "6205")
