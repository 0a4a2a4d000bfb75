"""Reading measured signals from files.

A file is read in two steps, as it seldom says all that is needed. `read_table` finds its columns
of numbers, and `Table.contents` what the file says about them; `Table.recording` makes a
`Recording` of the columns that are the housing's acceleration, once what is missing is given.

Whatever is wrong with a file is said in one sentence, as a ValueError.
"""

from __future__ import annotations

import io
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import checks
from bearingcore.common.number_table import read_numbers
from bearingcore.files.contents import MOST_COLUMNS, MOST_NUMBERS
from bearingcore.files.hdf5_file import is_hdf5, read_hdf5
from bearingcore.files.matlab_file import Variables, read_matlab
from bearingcore.files.table import Table
from bearingcore.signals.recording import FEWEST_SAMPLES

MOST_BYTES = 64 * 2**20
"""Of a file."""

MOST_EXPANSION = 10
"""A compressed file may hold so many times as much as it is long; more is no signal."""

LEAST_EXPANDED = 8 * 2**20
"""[bytes] that any file may unpack to, however short it is."""

MOST_SCALARS = 200
"""Single numbers and words of a file that are kept."""


def read_table(name: str, content: bytes) -> Table:
    """The columns of numbers in a file: text (CSV), WAV, MATLAB or HDF5.

    What it is shows in its first bytes; `name` names it and may hold a hint ("12k", "1797rpm").

    Raises
    ------
    ValueError
        saying what is wrong with a broken, empty, huge or mis-shaped file.
    """
    size = len(content)
    if size == 0:
        raise checks.refuse("file", name, "one that is not empty")
    if size > MOST_BYTES:
        raise checks.refuse(
            f"size of {name}", f"{size / 2**20:.0f} MB", f"at most {MOST_BYTES // 2**20} MB"
        )
    if content[:4] in (b"RIFF", b"RIFX", b"RF64"):
        return _wav(name, content)
    if is_hdf5(content):
        return _variables(name, content, "HDF5 file")
    marked = content[:6] == b"MATLAB" or content[126:128] in (b"IM", b"MI")
    if marked or name.lower().endswith(".mat"):
        return _variables(name, content, "MATLAB file")
    return _text(name, content)


def _text(name: str, content: bytes) -> Table:
    found = read_numbers(name, content, most_numbers=MOST_NUMBERS, most_columns=MOST_COLUMNS)
    headed = found.headings is not None
    names = found.headings or tuple(f"column {i + 1}" for i in range(found.columns.shape[1]))
    return Table(
        names,
        found.columns,
        name=name,
        remarks=found.remarks,
        headed=headed,
        stamps=found.stamps,
    )


def _wav(name: str, content: bytes) -> Table:
    """Whole numbers come out as parts of full scale, −1 to 1."""
    from scipy.io import wavfile  # imported late: it would double the time to import this package

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # chunks with remarks that it does not know
            rate, data = wavfile.read(io.BytesIO(content))
    except Exception as error:  # a broken file raises almost anything in there
        raise checks.refuse("file", name, f"a whole WAV file ({error})") from None
    data = np.atleast_2d(np.asarray(data).T).T
    if data.size > MOST_NUMBERS:
        raise checks.refuse(f"count of numbers in {name}", data.size, f"at most {MOST_NUMBERS}")
    if data.dtype.kind == "u":
        columns = data / 128.0 - 1.0
    elif data.dtype.kind == "i":
        columns = data / float(np.iinfo(data.dtype).max + 1)
    else:
        columns = data.astype(float)
    if rate <= 0 or columns.size == 0:
        raise checks.refuse("file", name, "a WAV file with samples and a sample rate")
    names = tuple(f"channel {i + 1}" for i in range(columns.shape[1]))
    return Table(names, columns, float(rate), name=name, headed=False, full_scale_known=False)


def _variables(name: str, content: bytes, kind: str) -> Table:
    """Vectors and matrices of real numbers, with the single numbers and words beside them."""
    most = min(max(MOST_EXPANSION * len(content), LEAST_EXPANDED), 8 * MOST_NUMBERS)
    try:
        if kind == "HDF5 file":
            found = read_hdf5(content, min(MOST_NUMBERS, most // 4))
        else:
            if b"MATLAB 7.3" in content[:116]:
                raise ValueError("the head of version 7.3 and nothing that belongs to it")
            found = read_matlab(content, most)
    except ValueError as error:
        raise checks.refuse("file", name, f"a whole {kind}; this has {error}") from None
    return _table_of(name, found, kind)


def _table_of(name: str, found: Variables, kind: str) -> Table:
    scalars: dict[str, float] = {}
    texts = dict(list(found.texts.items())[:MOST_SCALARS])
    parts: dict[str, NDArray[Any]] = {}
    for variable, matrix in found.numbers.items():
        if matrix.size == 1:
            if len(scalars) < MOST_SCALARS:
                with np.errstate(invalid="ignore"):  # signalling NaNs in damaged files
                    scalars[variable] = float(matrix[0, 0])
        elif matrix.size:
            parts[variable] = matrix.T if matrix.shape[0] < matrix.shape[1] else matrix
    if not parts:
        raise checks.refuse("file", name, f"a {kind} with a vector or matrix of real numbers")
    rows = max(len(part) for part in parts.values())
    # what is much shorter was measured otherwise, or is no signal
    least = max(FEWEST_SAMPLES, rows // 2) if rows >= FEWEST_SAMPLES else rows
    for variable, part in parts.items():
        if len(part) < least and len(texts) < MOST_SCALARS:
            texts[variable] = f"{len(part)} × {part.shape[1]} numbers, not used"
    parts = {variable: part for variable, part in parts.items() if len(part) >= least}
    width = sum(part.shape[1] for part in parts.values())
    if width > MOST_COLUMNS:
        raise checks.refuse(f"number of columns in {name}", width, f"at most {MOST_COLUMNS}")
    if width * rows > MOST_NUMBERS:
        raise checks.refuse(f"count of numbers in {name}", width * rows, f"at most {MOST_NUMBERS}")
    columns = np.full((rows, width), np.nan, order="F")
    place = 0
    with np.errstate(invalid="ignore"):
        for part in parts.values():
            columns[: len(part), place : place + part.shape[1]] = part
            place += part.shape[1]
    names = tuple(
        variable if part.shape[1] == 1 else f"{variable}(:,{i + 1})"
        for variable, part in parts.items()
        for i in range(part.shape[1])
    )
    return Table(names, columns, scalars=scalars, name=name, texts=texts)
