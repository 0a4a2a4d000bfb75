"""The parsers of inputs from outside; each returns a result or raises a ValueError."""

import io
import random
import wave
from collections.abc import Callable
from importlib import resources
from typing import Any

import h5py
import numpy as np
from bearing_explorer.diagnosis import form as forms
from bearing_explorer.diagnosis.machine import Machine
from scipy.io import savemat

from bearingcore import Scene, presets, read_catalogue, read_floor
from bearingcore.measured.files import read_table
from tests.fuzz.inputs import bytes_like, text_like
from tests.helpers.saved import saved, zipped

LONGEST_SENTENCE = 700  # characters


def unclear(sentence: str) -> str | None:
    """Return why a sentence cannot be shown to people; None where it can."""
    if not sentence.strip():
        return "no words"
    if len(sentence) > LONGEST_SENTENCE:
        return "too many words"
    if "Traceback" in sentence or " object at 0x" in sentence or "/site-packages/" in sentence:
        return "words for programmers"
    return None


def _texts() -> list[str]:
    return [scene.to_toml() for scene in list(presets.values())[:6]]


def _floors() -> list[str]:
    rows = [(k * 0.5, 20 + 5 * (k % 7)) for k in range(40)]
    return [
        "\n".join(f"{angle} {depth}" for angle, depth in rows),
        "# angle;depth\n" + "\n".join(f"{angle};{depth:.1f}" for angle, depth in rows),
        "angle,depth\n" + "\n".join(f"{angle},{depth}" for angle, depth in rows),
    ]


def _bearings() -> list[str]:
    shipped = resources.files("bearingcore.bearings").joinpath("bearings.csv")
    small = "name,balls,ball_diameter_mm,pitch_diameter_mm,note\na,9,7.94,39.04,ours\nb,8,7,30,"
    german = "name;balls;ball_diameter_mm;pitch_diameter_mm\n6205;9;7,94;39,04"
    return [shipped.read_text("utf-8"), small, german]


def _signal(n: int = 600) -> np.ndarray:
    return np.random.default_rng(1).normal(size=n)


def csv_texts() -> list[str]:
    times, signal = np.arange(600) / 8192.0, _signal()
    plain = "\n".join(f"{value:.5f}" for value in signal)
    pairs = "\n".join(f"{t:.7f},{v:.5f}" for t, v in zip(times, signal, strict=True))
    german = pairs.replace(",", ";").replace(".", ",")
    stamps = "\n".join(
        f"2024-02-29T23:59:{59 + t:09.6f},{v:.5f}" for t, v in zip(times, signal, strict=True)
    )
    clock = "\n".join(f"9,39,39,{65_664 + 39 * k},{v:.3f},{-v:.3f}" for k, v in enumerate(signal))
    gapped = "\n".join(pairs.splitlines()[:300] + pairs.splitlines()[305:])
    said = "Sample rate: 25.6 kHz\nSpeed = 1500 rpm\nLoad; 2,5 kN\nacc [mg]\n" + plain
    return [
        plain,
        "time [s],acc x [g]\n" + pairs,
        "Zeit;ax\n" + german,
        "when,v [mm/s]\n" + stamps,
        clock,
        "t,x\n" + gapped,
        said,
        "# " + pairs.replace(",", "\t"),
    ]


def wav_files() -> list[bytes]:
    made = []
    for width, channels in ((1, 1), (2, 1), (2, 2), (3, 1), (4, 2)):
        file = io.BytesIO()
        with wave.open(file, "wb") as writer:
            writer.setnchannels(channels)
            writer.setsampwidth(width)
            writer.setframerate(25600)
            writer.writeframes(np.random.default_rng(2).bytes(width * channels * 400))
        made.append(file.getvalue())
    return made


def matlab_files() -> list[bytes]:
    data = {"DE_time": _signal(400)[:, None], "RPM": np.array([[1797.0]])}
    run = {"gs": _signal(400)[:, None], "sr": 48_828, "rate": 25.0, "load": "150"}
    cells = np.empty(2, dtype=object)
    cells[:] = [_signal(300), run]
    named = ({**data, "name": "text"}, {"bearing": run, "c": cells})
    compressed = (
        saved(savemat, each, do_compression=way) for way in (False, True) for each in named
    )
    return [saved(savemat, data, format="4"), *compressed]


def hdf5_files() -> list[bytes]:
    """Small files as measuring programs write them."""
    made = []
    for options in ({}, {"compression": "gzip", "chunks": (100,)}):
        file = io.BytesIO()
        with h5py.File(file, "w") as writer:
            data = writer.create_dataset("bearing/acc_y", data=_signal(400), **options)
            data.attrs["unit"], data.attrs["sample_rate"] = "g", 12_000.0
        made.append(file.getvalue())
    return made


def octave_texts() -> list[str]:
    values = "\n".join(f" {value:.5f}" for value in _signal(400))
    head = "# Created by Octave 8.4.0\n# name: fs\n# type: scalar\n8000\n\n\n"
    matrix = f"# name: acc\n# type: matrix\n# rows: 400\n# columns: 1\n{values}\n\n\n"
    words = "# name: unit\n# type: string\n# elements: 1\n# length: 1\ng\n\n\n"
    struct = "# name: s\n# type: scalar struct\n# ndims: 2\n 1 1\n# length: 2\n"
    steps = "# name: t\n# type: double_range\n# base, limit, increment\n0 0.1 0.00025\n\n\n"
    return [head + matrix, head + struct + matrix + words + steps]


def packed_files() -> list[bytes]:
    """Arrays of NumPy, and zips."""
    arrays = saved(np.savez, acc=_signal(400), fs=8000.0, unit="g")
    return [arrays, saved(np.save, _signal(400)), zipped(a_csv=csv_texts()[1].encode())]


def broken_files() -> dict[str, Callable[[random.Random], bytes]]:
    """A file of each format, of random numbers, by the ending of its name."""
    texts, waves, matrices, trees = csv_texts(), wav_files(), matlab_files(), hdf5_files()
    octaves, packed = octave_texts(), packed_files()
    return {
        "csv": lambda r: text_like(r, texts).encode("utf-8", "surrogatepass"),
        "wav": lambda r: bytes_like(r, waves),
        "mat": lambda r: bytes_like(r, matrices),
        "octave": lambda r: text_like(r, octaves).encode("utf-8", "surrogatepass"),
        "packed": lambda r: bytes_like(r, packed),
        "h5": lambda r: bytes_like(r, trees),
    }


def _table(content: bytes) -> object:
    table = read_table("a file", content)
    form = forms.guess(table)
    asked, reasons = forms.questions(table), forms.reasons(table)
    for words in (*asked.values(), *reasons.values(), forms.other_facts(table)):
        if words and (wrong := unclear(words)) is not None:
            raise AssertionError(f"{wrong}: {words[:200]!r}")
    roles = form["columns"].split(forms.SEPARATOR)
    if not {"x", "y"} & set(roles):
        roles[-1] = "y"
    told, form = forms.fill(table, {"columns": forms.SEPARATOR.join(roles)})
    form["sample_rate"] = form["sample_rate"] or "12000"
    return forms.read_form(told, form, Machine())


Target = tuple[Callable[[random.Random], Any], Callable[[Any], object]]
"""A maker of an input out of random numbers, and the parser that takes it."""


def targets() -> dict[str, Target]:
    """Return all parsers by name; of addresses `test_address.py` has its own."""
    scenes, floors, bearings = _texts(), _floors(), [text.encode() for text in _bearings()]
    files = broken_files()
    return {
        "scene": (lambda r: text_like(r, scenes), Scene.from_toml),
        "floor": (lambda r: text_like(r, floors), read_floor),
        "bearings": (lambda r: bytes_like(r, bearings), read_catalogue),
        **{name: (files[name], _table) for name in ("csv", "wav", "mat", "octave", "packed")},
    }
