"""Formats that other libraries read: UFF, TDMS, Parquet, Excel, NumPy's own; a zip of one file.

This code runs only in the process of `_child`. The libraries come with the extra `files`.
"""

from __future__ import annotations

import io
import os
import re
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any
from unittest.mock import patch

import numpy as np

from bearingcore.common import _checks as checks
from bearingcore.errors import FieldError
from bearingcore.measured.files._other_kinds import BRING
from bearingcore.measured.files._text import refuse_mixed_rows
from bearingcore.measured.files._variables import Variables

MOST_UNPACKED = 2**28
"""Size [bytes] of the largest file in a zip."""

MOST_TOGETHER = 2**30
"""Greatest size [bytes] of all files in a zip that are to be read."""

MOST_INSIDE = 1000
"""Greatest number of files in a zip that are named."""

DOCUMENT = re.compile(
    r"(?i)(^|/)(readme|licen[cs]e)(\.(txt|rst))?$"
    r"|\.(md|rst|pdf|docx?|pptx?|html?|py|ipynb|png|jpe?g|svg)$"
)
"""Names of documents and pictures beside signals in a zip or a folder."""

MOST_FACTS = 100
"""Most rows of a sheet, or of a data frame with signals in its cells, that describe signals."""

_NO_FILE = re.compile(r"^$|/$|(^|/)(\.|__MACOSX/)")
"""Names of folders and hidden files."""

_TIME_RESPONSE = (0, 1)
"""Function types of data set 58 that are signals over time: general ones, and time responses."""

_FREQUENCY = 18
"""Type of the abscissa of spectra in data set 58."""


@contextmanager
def damage_refused(name: str, wanted: str) -> Iterator[None]:
    """Refuse a damaged file, for which a library may raise almost any exception."""
    try:
        yield
    except (FieldError, MemoryError, ImportError):
        raise
    except Exception:
        raise checks.refuse("file", name, wanted) from None


def unzip(name: str, content: bytes) -> tuple[list[str], bytes]:
    """Return the names of the files in a zip, and the content of the one that is to be read.

    That file is the only one, or the one at the end of `name`. For several files without such a
    name the content is empty.

    Raises
    ------
    FieldError
        for a damaged zip, or an empty one.
    """
    with (
        damage_refused(name, "a whole zip without a password"),
        zipfile.ZipFile(io.BytesIO(content)) as packed,
    ):
        files = _readable_files(name, packed.infolist())
        if len(files) > 1:
            return [file.filename for file in files[:MOST_INSIDE]], b""
        inside = packed.read(files[0])
        if inside[:4] == b"PK\x03\x04" and not is_npz(inside):
            raise checks.refuse("file", name, "no zip inside a zip: unpack it")
        return [files[0].filename], inside


def _readable_files(name: str, packed: list[zipfile.ZipInfo]) -> list[zipfile.ZipInfo]:
    """Return the file in a zip that `name` ends with, else all that may hold a table.

    FieldError if there is none, or if they are too large.
    """
    files = [file for file in packed if not _NO_FILE.search(file.filename)]
    if any(file.filename == "[Content_Types].xml" for file in files):
        raise checks.refuse("file", name, "no office document: save its sheet as CSV")
    named = [file for file in files if name.endswith(f".zip/{file.filename}")]
    files = named or [file for file in files if not DOCUMENT.search(file.filename)] or files
    if not files:
        raise checks.refuse("file", name, "a zip with a file in it")
    size = sum(file.file_size for file in files)
    check_unpacked(name, "a zip", size, MOST_TOGETHER if len(files) > 1 else MOST_UNPACKED)
    return files


def check_unpacked(name: str, kind: str, size: int, most: int = MOST_UNPACKED) -> None:
    """Refuse a file that is too large [bytes] when unpacked: a small zip may hold terabytes."""
    if size > most:
        raise checks.refuse("file", name, f"{kind} of at most {most >> 20} MB unpacked")


def is_npz(content: bytes) -> bool:
    """Return True if a zip holds NumPy's arrays."""
    names = names_in(content)
    return bool(names) and all(name.endswith(".npy") for name in names)


def names_in(content: bytes) -> list[str]:
    """Return the names of the files in a zip; none for a damaged zip."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as packed:
            return packed.namelist()
    except Exception:  # a damaged zip may raise almost any exception
        return []


def longest_sheet(name: str, content: bytes) -> tuple[bytes, list[str]]:
    """Return the sheet with the most cells as CSV, below facts of the others; and a note on it."""
    import pandas as pd

    with damage_refused(name, "a whole Excel file; save its sheet as CSV"):
        with zipfile.ZipFile(io.BytesIO(content)) as packed:
            check_unpacked(name, "a workbook", sum(entry.file_size for entry in packed.infolist()))
        sheets = pd.read_excel(io.BytesIO(content), sheet_name=None, header=None, engine="openpyxl")
    longest = max(sheets, key=lambda name: int(sheets[name].count().sum()))
    table = sheets[longest].dropna(how="all").dropna(how="all", axis=1)
    notes = [f"Its longest sheet, “{longest}”, is read."] if len(sheets) > 1 else []
    facts = [line for name in sheets if name != longest for line in _facts_in(sheets[name])]
    head = "".join(f"# {line}\n" for line in facts[:MOST_FACTS])
    return (head + table.to_csv(index=False, header=False)).encode(), notes


def _facts_in(sheet: Any) -> list[str]:
    """Return names with their values on a short sheet, in two columns or in two rows."""
    if len(sheet) > MOST_FACTS:
        return []
    sheet = sheet.dropna(how="all")
    if len(sheet) == 2 and sheet.shape[1] > 2:
        sheet = sheet.T.dropna()
    rows = [row.dropna().astype(str).tolist() for _, row in sheet.iterrows()]
    return [f"{row[0]}: {' '.join(row[1:])}" for row in rows if len(row) > 1]


def arrays(content: bytes, variables: Variables) -> None:
    """Add the array of NumPy's `save`, or all arrays of its `savez`."""
    loaded = np.load(io.BytesIO(content), allow_pickle=False)
    if isinstance(loaded, np.ndarray):
        return variables.add("" if loaded.dtype.names else "array", loaded)
    for name in loaded.files:
        with suppress(ValueError):  # raised for pickled objects, which are not unpacked
            variables.add(name, loaded[name])


def data_frame(content: bytes, variables: Variables) -> None:
    """Add columns of numbers, dates and durations of a data frame, and signals in its cells."""
    import pandas as pd

    frame = pd.read_parquet(io.BytesIO(content), engine="pyarrow", use_threads=False)
    if not isinstance(frame.index, pd.RangeIndex):
        frame = frame.reset_index()
    for name in frame.columns:
        values = frame[name]
        first = values.iloc[0] if len(values) else None
        if isinstance(first, list | np.ndarray):
            for index, cell in enumerate(values):
                path = f"{name}({index + 1})" if len(values) > 1 else str(name)
                variables.add(path, np.asarray(cell, dtype=float))
        elif isinstance(first, str) and len(values) <= MOST_FACTS:
            variables.add(str(name), np.unique(values.to_numpy(dtype=str)))
        elif isinstance(first, str):
            numbers = frame.select_dtypes("number").to_numpy(dtype=float)
            refuse_mixed_rows(str(name), values.to_numpy(dtype=str), numbers.T)
        is_time = values.dtype.kind in "Mm"
        if is_time or values.dtype.kind in "iuf":
            column = values.to_numpy().astype(
                values.dtype.str.replace("tz", "") if is_time else float
            )
            variables.add(f"{name} [s]" if is_time else str(name), column)


def tdms(content: bytes, variables: Variables) -> None:
    """Add the channels of all groups, and the properties of each."""
    from nptdms import TdmsFile

    with TdmsFile.read(io.BytesIO(content)) as file:
        parts = [("", file), *((group.name, group) for group in file.groups())]
        for group in file.groups():
            for channel in group.channels():
                path = f"{group.name}.{channel.name}"
                variables.add(path, np.asarray(channel[:]))
                parts.append((path, channel))
        for path, part in parts:
            for name, value in part.properties.items():
                variables.add(f"{path}.{name}" if path else name, np.asarray(value))


def uff(content: bytes, variables: Variables) -> None:
    """Add signals over time, data set 58."""
    import pyuff

    # pyuff only takes names of files, and this process writes none
    with patch.object(pyuff.pyuff, "open", lambda *_: io.BytesIO(content), create=True):
        sets = pyuff.UFF(os.devnull).read_sets()
    sets = [part for part in (sets if isinstance(sets, list) else [sets]) if part.get("type") == 58]
    if sets and all(record["abscissa_spec_data_type"] == _FREQUENCY for record in sets):
        variables.instead = (
            f"a signal over time; this is a spectrum: export the waveform, or {BRING}"
        )
    sets = [record for record in sets if record["func_type"] in _TIME_RESPONSE]
    points = {record.get("rsp_node") for record in sets}
    for index, signal in enumerate(sets):
        parts = [_word(signal, "id1"), _AXES.get(abs(int(signal.get("rsp_dir", 0))), "")]
        parts += [f"point {signal['rsp_node']}"] if len(points) > 1 else []
        path = " ".join(filter(None, parts))
        if not path or path in variables.numbers:
            path = f"{path} signal {index + 1}".strip()
        variables.add(path, np.asarray(signal["data"]))
        if signal["abscissa_spacing"]:
            variables.add(f"{path}.dt", np.array(float(signal["abscissa_inc"])))
        else:
            variables.add(f"{path} time [s]", np.asarray(signal["x"]))
        words = [("unit", "ordinate_axis_units_lab"), ("date", "id3"), ("remark", "id2")]
        for name, key in words:
            if word := _word(signal, key):
                variables.add(f"{path}.{name}", np.array(word))


def _word(data_set: Mapping[str, Any], key: str) -> str:
    word = str(data_set.get(key, "")).strip()
    return "" if word == "NONE" else word


_AXES = {1: "x", 2: "y", 3: "z"}
