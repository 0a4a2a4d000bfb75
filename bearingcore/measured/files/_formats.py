"""Contents of text, WAV, MATLAB and HDF5 files. This code runs only in the process of `_child`.

Each reader returns the fields of `_contents.FileColumns`: words and single numbers, and a matrix.
Fields of structs are named as in MATLAB: "bearing.gs", "runs(2).gs", "parts{3}".
"""

from __future__ import annotations

import gzip
import importlib.util
import io
import re
import warnings
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import _checks as checks
from bearingcore.measured.files import _libraries as libraries
from bearingcore.measured.files._text import read_text
from bearingcore.measured.files._variables import (
    LONGEST_TEXT,
    MOST_COLUMNS,
    MOST_NUMBERS,
    Answer,
    Variables,
    check_depth,
    check_size,
)


def read(name: str, content: bytes) -> Answer:
    """Read the contents of a file, whose first bytes show its format; see `_child.read_file`.

    Raises
    ------
    FieldError
        for a damaged, empty or mis-shaped file.
    """
    if not content:
        raise checks.refuse("file", name, "one that is not empty")
    if content[:4] == b"PK\x03\x04" and not libraries.is_npz(content):
        if "xl/workbook.xml" in libraries.names_in(content):
            _need("openpyxl", name, "Excel file")
            sheet, notes = libraries.longest_sheet(name, content)
            about, columns = read_text(name, sheet)
            return about | {"notes": notes + about.get("notes", [])}, columns
        names, content = libraries.unzip(name, content)
        if len(names) > 1:
            return {"inside": names}, np.empty((0, 0))
        about, columns = read(names[0], content)
        return {"name": f"{name.removesuffix('/' + names[0])}/{names[0]}", **about}, columns
    if content[:2] == b"\x1f\x8b":
        name = re.sub(r"(?i)\.gz$", "", name)
        return read(name, _gunzip(name, content))
    if content[:4] in (b"RIFF", b"RIFX", b"RF64"):
        return _wav(name, content)
    variables = Variables()
    file_format = _format_of(name, content)
    if file_format is None:
        return read_text(name, content)
    kind, walk = file_format
    wanted = f"a whole {kind}; this has a damaged or unknown part"
    with libraries.damage_refused(name, wanted), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        walk(content, variables)
    return variables.table(name, kind)


Walk = Callable[[bytes, "Variables"], None]
"""Function that adds the matrices, numbers and words of a file's bytes to a `Variables`."""


def _format_of(name: str, content: bytes) -> tuple[str, Walk] | None:
    """Return name and reader of a format, by the first bytes; None for text with numbers.

    Raises
    ------
    FieldError
        if the format's library is not installed.
    """
    for mark, kind, walk, package in _FORMATS:
        if re.match(mark, content, re.DOTALL):
            _need(package, name, kind)
            return kind, walk
    if content[:4] == b"\xd0\xcf\x11\xe0":
        raise checks.refuse("file", name, "no old office document (.xls): save it as .xlsx or CSV")
    if re.match(rb'\s*(\{\s*"|\[\s*[\[{])', content) and content.rstrip()[-1:] in b"]}":
        raise checks.refuse("file", name, "a table: save the columns of a JSON file as CSV")
    if re.search(rb"[\"\t;,] ?\[[-+\d.eE,;\s]{500}", content[:100_000]):
        raise checks.refuse("file", name, "a number in each cell, not a whole signal in one")
    if content[:6] == b"Octave" or content[:19] == b"# Created by Octave":
        raise checks.refuse("file", name, "no format of Octave's own: save -v7 in its place")
    is_matlab = content[:6] == b"MATLAB" or content[126:128] in (b"IM", b"MI")
    return ("MATLAB file", _walk_matlab) if is_matlab or name.lower().endswith(".mat") else None


def _need(package: str, name: str, kind: str) -> None:
    """Refuse a file whose package is not installed."""
    if package and importlib.util.find_spec(package.lower()) is None:
        article = "an" if kind[0] in "AEIOU" else "a"
        wanted = (
            f"{article} {kind} only where the package {package} is installed (pip install "
            f"{package}); else export it as CSV from the program that wrote it"
        )
        raise checks.refuse("file", name, wanted)


def _gunzip(name: str, content: bytes) -> bytes:
    """Unpack a file of gzip, up to the largest size."""
    with libraries.damage_refused(name, "a whole file of gzip"):
        unpacked = gzip.GzipFile(fileobj=io.BytesIO(content)).read(libraries.MOST_UNPACKED + 1)
    libraries.check_unpacked(name, "a file", len(unpacked))
    return unpacked


def _wav(name: str, content: bytes) -> Answer:
    """Read a WAV file; whole numbers become parts of full scale, −1 to 1."""
    from scipy.io import wavfile

    try:
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")  # to notice a file that is cut off
            rate, data = wavfile.read(io.BytesIO(content))
    except MemoryError:
        raise
    except Exception as error:  # a damaged file raises almost anything in there
        why = f" ({error})" if type(error) is ValueError else ""
        raise checks.refuse("file", name, f"a whole WAV file{why}") from None
    data = np.atleast_2d(np.asarray(data).T).T
    check_size(name, len(data), data.shape[1], MOST_NUMBERS, MOST_COLUMNS)
    if rate <= 0 or data.size == 0:
        raise checks.refuse("file", name, "a WAV file with samples and a sample rate")
    columns = data.astype(float)
    if data.dtype.kind == "u":
        columns = columns / 128.0 - 1.0
    elif data.dtype.kind == "i":
        columns /= float(np.iinfo(data.dtype).max) + 1.0
    names = [f"channel {i + 1}" for i in range(columns.shape[1])]
    about = {"names": names, "sample_rate": float(rate), "headed": False, "full_scale_known": False}
    if any("EOF" in str(warning.message) for warning in warned):
        about["notes"] = ["The file is cut off: its head says that it was longer."]
    return about, columns


# -- MATLAB, versions 4 to 7 -----------------------------------------------------------------------


def _walk_matlab(content: bytes, variables: Variables) -> None:
    from scipy.io import loadmat

    for name, value in loadmat(cast(Any, io.BytesIO(content))).items():
        if not name.startswith("__"):
            _matlab(value, name, variables, 0)


def _matlab(value: Any, path: str, variables: Variables, depth: int) -> None:
    """Add a matrix, and the contents of a struct or cell."""
    from scipy.io.matlab import MatlabFunction, MatlabOpaque

    check_depth(depth)
    if isinstance(value, MatlabOpaque):
        variables.objects.append("a variable" if path == "None" else path)  # as SciPy names it
    if not isinstance(value, np.ndarray) or isinstance(value, MatlabFunction | MatlabOpaque):
        return
    if value.dtype.names:
        for index, element in enumerate(value.ravel(order="F")):
            parent = f"{path}({index + 1})" if value.size > 1 else path
            if label := _label(element, value.dtype.names):
                _matlab(element["Data"], f"{path}.{label}", variables, depth + 1)
                continue
            for name in value.dtype.names:
                _matlab(element[name], f"{parent}.{name}", variables, depth + 1)
    elif value.dtype == object:
        for index, inside in enumerate(value.ravel(order="F")):
            _matlab(inside, f"{path}{{{index + 1}}}", variables, depth + 1)
    else:
        variables.add(path, value)


def _label(element: Any, fields: Sequence[str]) -> str:
    """Name of a channel whose struct has a field for it, next to the data."""
    if not {"Name", "Data"} <= set(fields) or element["Name"].dtype.kind not in "SU":
        return ""
    return str(element["Name"].ravel()[0]).strip() if element["Name"].size else ""


# -- HDF5, including MATLAB's version 7.3 ----------------------------------------------------------


def _walk_hdf5(content: bytes, variables: Variables) -> None:
    import h5py

    with h5py.File(io.BytesIO(content), "r") as file:
        _hdf5(file, "", variables, 0)


def _hdf5(item: Any, path: str, variables: Variables, depth: int) -> None:
    """Add a group (a struct) or a data set, with its words and numbers.

    Only data of the file itself are added: external links, external data and views of other data
    sets could name files of this machine.
    """
    import h5py

    check_depth(depth)
    if isinstance(item, h5py.Group):
        for name in item:
            # MATLAB keeps the contents of cells in #refs#
            is_inside = isinstance(item.get(name, getlink=True), h5py.HardLink)
            if is_inside and not (depth == 0 and name.startswith("#")):
                _hdf5(item[name], f"{path}.{name}" if path else name, variables, depth + 1)
    elif not isinstance(item, h5py.Dataset) or item.external or item.is_virtual:
        return
    elif "MATLAB_object_decode" in item.attrs:
        variables.objects.append(path)
        return
    elif h5py.check_ref_dtype(item.dtype) is not None:
        references = item[()].ravel()
        for index, reference in enumerate(references):
            if reference:
                inside = f"{path}{{{index + 1}}}" if len(references) > 1 else path
                _hdf5(item.file[reference], inside, variables, depth + 1)
        return
    elif item.shape is not None and "MATLAB_empty" not in item.attrs:
        variables.add(path, _matlab_values(item))
    for name, value in item.attrs.items():
        is_fact = np.size(value) == 1 or np.asarray(value).dtype.kind in "OSU"
        if is_fact and not name.startswith(_OF_THE_FORMAT):
            variables.add(f"{path}.{name}" if path else name, np.asarray(value))


_OF_THE_FORMAT = ("MATLAB_", "H5PATH", "CLASS", "DIMENSION")
"""Beginnings of attributes that describe the storage."""


def _matlab_values(data: Any) -> NDArray[Any]:
    """Return the values of a data set; MATLAB stores letters and truth values as numbers."""
    kind = data.attrs.get("MATLAB_class", b"")
    values = np.asarray(data[()])
    if kind == b"char" and values.dtype.kind in "iu":
        return np.array("".join(map(chr, values.T.ravel()[:LONGEST_TEXT].tolist())))
    return values.astype(bool) if kind == b"logical" else values


_FORMATS: tuple[tuple[bytes, str, Walk, str], ...] = (
    # MATLAB 7.3 puts text before HDF5
    (rb"(.{512})?\x89HDF\r\n\x1a\n", "HDF5 file", _walk_hdf5, ""),
    (rb"\x93NUMPY|PK\x03\x04", "NumPy file", libraries.arrays, ""),
    (rb"PAR1", "Parquet file", libraries.data_frame, "pyarrow"),
    (rb"TDSm", "TDMS file", libraries.tdms, "npTDMS"),
    (rb"\s{0,200}-1 *\r?\n +\d{1,4}[ b]*\d*", "UFF file (data set 58)", libraries.uff, "pyuff"),
)
"""Formats: first bytes (a regular expression), name, reader, and the package that it needs."""
