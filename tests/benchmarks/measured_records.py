"""Records of real machines: finding them in a folder, and what is true of each.

What is true follows from the names of four public collections: Case Western Reserve University
(`cwru`), Society for Machinery Failure Prevention Technology (`mfpt`), FEMTO-ST (`femto`) and
HIT-SM (`hitsm`, with spalls of known length on both races). Three further machines had no part in
choosing anything of the diagnosis: HIT-SM's own rig (`hitsm-self-built`), a machinery fault
simulator at Limerick (`limerick`, github.com/analogdevicesinc/CbM-Datasets), and a rig of the
University of Electronic Science and Technology of China (`uestc`,
github.com/ChangLiu2024/UESTC-Bearing-Dataset).
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.io import loadmat

from bearingcore import Bearing, Recording
from bearingcore.measured.files import UNITS

HEALTHY, UNKNOWN = "healthy", "unknown"


@dataclass(frozen=True)
class Record:
    """A measured signal and what is true of the machine."""

    name: str
    truth: str
    machine: str
    bearing: Bearing
    shaft_speed: float
    """[rad/s]"""
    recording: Recording
    spall_extent_deg: float | None = None
    """Of a spall or pit on either race, where it is known."""
    grade: str = ""
    """By hand, of the drive end at 12 kHz: see `GRADES`."""


def ball_bearing(
    n_balls: int, ball_mm: float, pitch_mm: float, contact_angle_deg: float = 0.0
) -> Bearing:
    """A bearing of usual grooves."""
    ball = 1e-3 * ball_mm
    return Bearing.from_drawing(
        n_balls,
        ball,
        1e-3 * pitch_mm,
        0.52 * ball,
        0.53 * ball,
        contact_angle=math.radians(contact_angle_deg),
    )


CWRU = (9, 7.94, 39.04)
CWRU_FAN_END = (8, 6.746, 28.50)
CWRU_RPM = {"0": 1797.0, "1": 1772.0, "2": 1750.0, "3": 1730.0}
CWRU_EXTENT_DEG = {
    "OR": {"007": 0.43, "014": 0.87, "021": 1.30},
    "IR": {"007": 0.66, "014": 1.31, "021": 1.97, "028": 2.62},
}
MFPT = (8, 0.235 * 25.4, 1.245 * 25.4)
FEMTO = (13, 3.5, 25.6)
GRADES = {
    "Y1": "130 131 132 133 156 209 210 211 212",
    "Y2": "105 106 107 108 121 144 145 146 147 158 159 160 169 170 171 172 197 222 223 234 235 236 "
    "237 246 247 248 249 258 259 260 261 3005 3006 3007 3008",
    "P1": "199",
    "P2": "185 186 187 188 198",
    "N1": "118 119 120 200 224 225 3001 3002 3003 3004",
}
"""Records of the drive end at 12 kHz, by how Smith and Randall graded them by hand (Mechanical
Systems and Signal Processing 64-65, 2015): Y1, Y2 clear, P1, P2 probable, N1 not possible."""

ER_12K = (8, 0.3125 * 25.4, 1.318 * 25.4)
"""The fault simulator's bearing by its maker, with a shaft of 3/4 inch. The collection does not
name it; the lines of its damaged races are those of this one, and not of the ER-16K."""
UC_204 = (8, 7.938, 33.5)
"""The collection names the series alone; of it, the lines of the damaged races are this one's."""
LIMERICK = {"G": HEALTHY, "IR": "inner race", "OR": "outer race", "BF": "ball"}
UESTC = {"N": HEALTHY, "I": "inner race", "O": "outer race", "B": "ball"}

HITSM = re.compile(r"([IO])R(\d+)_(\d+)")
FEMTO_RPM = {"Bearing1": 1800.0, "Bearing2": 1650.0}


def records(folder: Path) -> Iterator[Record]:
    """The records of a folder and its folders, in the order of their names."""
    for path in sorted(folder.rglob("*")):
        if path.parent.name == "limerick":
            yield _limerick(path)
        elif path.parent.parent.name == "uestc":
            yield _uestc(path)
        elif path.suffix == ".mat":
            yield _mat(path)
        elif path.suffix == ".csv" and "_acc_" in path.name:
            yield _femto(path)


def _speed(turns_a_minute: float) -> float:
    return 2.0 * math.pi * turns_a_minute / 60.0


def _mat(path: Path) -> Record:
    if "vload" in path.name or "baseline" in path.name:
        return _mfpt(path)
    spall = HITSM.fullmatch(path.stem)
    if spall:
        race, extent_deg, turns = spall.groups()
        return _hitsm(path, {"I": "inner race", "O": "outer race"}[race], turns, float(extent_deg))
    if path.parent.name.startswith("hitsm"):  # healthy by its label, with lines of both races in it
        return _hitsm(path, UNKNOWN, path.stem.rpartition("_")[2], None)
    return _cwru(path)


def _hitsm(path: Path, truth: str, turns: str, extent_deg: float | None) -> Record:
    content = loadmat(path)
    signal = next(content[key] for key in content if not key.startswith("__"))
    own_rig = path.parent.name == "hitsm-self-built"
    recording = Recording(
        np.asarray(signal, dtype=float).reshape(-1) * UNITS["g"], 51_200.0, ("y",), path.name
    )
    return Record(
        path.stem, truth, "HIT-SM own rig" if own_rig else "HIT-SM 6205", ball_bearing(*CWRU),
        _speed(float(turns)), recording, extent_deg,
    )  # fmt: skip


def _limerick(path: Path) -> Record:
    """Of three directions the first two; the heading and the limits beside it are no samples."""
    turns, state, *_ = path.stem.split("_")
    signal = np.genfromtxt(path, delimiter=";", usecols=(1, 2), skip_header=1) * UNITS["g"]
    return Record(
        path.stem.removesuffix(".Wfm"), LIMERICK[state[1:] if state != "GoB" else "G"],
        "MFS Limerick", ball_bearing(*ER_12K), _speed(float(turns)),
        Recording(signal, 20_000.0, ("x", "y"), path.name),
    )  # fmt: skip


def _uestc(path: Path) -> Record:
    """The stated speeds are nominal; the shaft's own lines are up to 95 rpm beside them."""
    part, turns, _ = path.stem.split("_")
    signal = np.asarray(loadmat(path)["Data"], dtype=float).reshape(-1)
    return Record(
        path.stem, UESTC[part], "UESTC", ball_bearing(*UC_204), _speed(float(turns)),
        Recording(signal, 20_000.0, ("y",), path.name),
    )  # fmt: skip


def _cwru(path: Path) -> Record:
    content = loadmat(path)
    name = path.stem
    fan_end = "Fan_End" in name
    place = "_FE_time" if fan_end else "_DE_time"
    # the record's number stands before the load's digit in one store of them, behind it in another
    number = re.search(r"_(\d{2,4})(?:@\d+)?_(?:Normal_)?\d$", name) or re.search(
        r"_\d_(\d{3,4})$", name
    )
    load = re.search(r"_(\d)(?:_\d{3,4})?$", name)
    own = [key for key in content if key.endswith(place)]
    # a file may hold another's vectors too: its own carry its number
    named = [key for key in own if number and key.lstrip("X0").startswith(number.group(1))]
    variable = (named or own)[0]
    given = content.get(variable.replace(place, "RPM"))
    turns = (
        CWRU_RPM[load[1] if load else "0"]
        if given is None
        else float(np.asarray(given).reshape(-1)[0])
    )
    kind = re.search(r"_(IR|OR|B)_?(\d{3})", name)
    truth = {"IR": "inner race", "OR": "outer race", "B": "ball"}[kind[1]] if kind else HEALTHY
    rate = 48_000.0 if name.startswith(("48k", "Normal")) else 12_000.0
    extent = None
    if kind and not fan_end:
        extent = CWRU_EXTENT_DEG.get(kind[1], {}).get(kind[2])
    signal = np.asarray(content[variable], dtype=float).reshape(-1) * UNITS["g"]
    at_12_khz = number is not None and rate < 20_000.0 and not fan_end
    grade = next((g for g, files in GRADES.items() if number and number[1] in files.split()), "")
    return Record(
        name, truth, "CWRU 6203" if fan_end else "CWRU 6205",
        ball_bearing(*(CWRU_FAN_END if fan_end else CWRU)), _speed(turns),
        Recording(signal, rate, ("y",), path.name), extent, grade if at_12_khz else "",
    )  # fmt: skip


def _mfpt(path: Path) -> Record:
    inside = loadmat(path, squeeze_me=True)["bearing"]
    signal = np.asarray(inside["gs"].item(), dtype=float).reshape(-1) * UNITS["g"]
    truth = HEALTHY
    for part in ("inner", "outer"):
        if part in path.name.lower():
            truth = f"{part} race"
    return Record(
        path.stem, truth, "MFPT", ball_bearing(*MFPT), 2.0 * math.pi * float(inside["rate"].item()),
        Recording(signal, float(inside["sr"].item()), ("y",), path.name),
    )  # fmt: skip


def _femto(path: Path) -> Record:
    signal = np.loadtxt(path, delimiter=",", usecols=(4, 5)) * UNITS["g"]
    truth = HEALTHY if path.stem.endswith("_00001") else UNKNOWN
    return Record(
        path.stem, truth, "FEMTO", ball_bearing(*FEMTO), _speed(FEMTO_RPM[path.name[:8]]),
        Recording(signal, 25_600.0, ("x", "y"), path.name),
    )  # fmt: skip
