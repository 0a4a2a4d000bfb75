"""Reads numbers and words out of an HDF5 file, in a process of its own: see `hdf5_file`.

Takes the file from the standard input. Writes a line of JSON and then the numbers, one array after
the other. Imports nothing of the package, as it is run as a script.
"""

from __future__ import annotations

import io
import json
import sys
from typing import Any

MOST_ELEMENTS = 10_000
DEEPEST = 8
LONGEST_TEXT = 1000
MOST_MEMORY = 2**30
"""[bytes] of the process, libraries and all."""

MOST_SECONDS = 20
"""Of the processor."""


class TooMuchError(Exception):
    """The file passes a limit."""


class Reader:
    """Walks through a file and keeps what a measurement can be.

    Only what lies in the file itself: links to other files, data kept elsewhere and views of other
    data sets are passed over, as they would name files of this machine.
    """

    def __init__(self, file: Any, most_numbers: int) -> None:
        self.numbers: dict[str, Any] = {}
        self.texts: dict[str, str] = {}
        self._file = file
        self._left = most_numbers
        self._elements = 0

    def group(self, group: Any, path: str, depth: int) -> None:
        """Everything in a group, which is how a struct is kept."""
        import h5py

        self._count(depth)
        for name in group:
            if path == "" and name.startswith("#"):
                continue  # where MATLAB keeps what cells point at
            if not isinstance(group.get(name, getlink=True), h5py.HardLink):
                continue
            self.item(group[name], f"{path}.{name}" if path else name, depth + 1)
        self._attributes(group, path)

    def item(self, item: Any, path: str, depth: int) -> None:
        """A group or a data set."""
        import h5py

        self._count(depth)
        if isinstance(item, h5py.Group):
            self.group(item, path, depth)
        elif isinstance(item, h5py.Dataset):
            self._dataset(item, path, depth)

    def _dataset(self, data: Any, path: str, depth: int) -> None:
        import h5py

        if data.external or data.is_virtual or data.shape is None or "MATLAB_empty" in data.attrs:
            return
        kind = _text(data.attrs.get("MATLAB_class", b""))
        if h5py.check_ref_dtype(data.dtype) is not None:
            if data.size > MOST_ELEMENTS:
                raise TooMuchError(f"over {MOST_ELEMENTS} parts")
            for index, reference in enumerate(data[()].ravel()):
                if reference:
                    inside = f"{path}{{{index + 1}}}" if data.size > 1 else path
                    self.item(self._file[reference], inside, depth + 1)
        elif kind == "char" or h5py.check_string_dtype(data.dtype) is not None:
            if data.size <= LONGEST_TEXT:
                self.texts[path] = _text(data[()])
        elif data.dtype.kind in "iuf" and kind != "logical" and len(data.shape) <= 2:
            self._left -= data.size
            if self._left < 0:
                raise TooMuchError("more numbers than are taken")
            self.numbers[path] = data[()]
            self._attributes(data, path)

    def _attributes(self, item: Any, path: str) -> None:
        """Single numbers and words that stand beside a data set."""
        import numpy as np

        for name in list(item.attrs)[:100]:
            if name.startswith(("MATLAB_", "H5PATH", "CLASS", "DIMENSION")):
                continue
            value = np.asarray(item.attrs[name])
            full = f"{path}.{name}" if path else name
            if value.size == 1 and value.dtype.kind in "iuf":
                self.numbers[full] = value
            elif value.size == 1 and value.dtype.kind in "OSU":
                self.texts[full] = _text(value)

    def _count(self, depth: int) -> None:
        self._elements += 1
        if self._elements > MOST_ELEMENTS:
            raise TooMuchError(f"over {MOST_ELEMENTS} parts")
        if depth > DEEPEST:
            raise TooMuchError(f"parts inside one another deeper than {DEEPEST}")


def _text(value: Any) -> str:
    import numpy as np

    array = np.asarray(value)
    if array.dtype.kind in "iu":
        return "".join(map(chr, array.T.ravel().tolist())).strip()
    first = array.ravel()[0] if array.size else b""
    text = first.decode("utf-8", "replace") if isinstance(first, bytes) else str(first)
    return text[:LONGEST_TEXT].strip()


def limit() -> None:
    """Bound memory and time of this process, where the system can."""
    try:
        import resource
    except ImportError:
        return  # not on Windows: the parent bounds the time
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def answer(content: bytes, most_numbers: int) -> tuple[dict[str, Any], list[bytes]]:
    """The line that tells what was found, and the numbers that follow it."""
    import h5py
    import numpy as np

    try:
        with h5py.File(io.BytesIO(content), "r") as file:
            reader = Reader(file, most_numbers)
            reader.group(file, "", 0)
    except TooMuchError as error:
        return {"wrong": str(error)}, []
    except MemoryError:
        return {"wrong": "more in it than this server can unpack"}, []
    except Exception:  # a damaged file raises almost anything in there
        return {"wrong": "a damaged or unknown part"}, []
    arrays = [np.ascontiguousarray(array) for array in reader.numbers.values()]
    head = {
        "numbers": [
            [name, array.dtype.str, list(array.shape)]
            for name, array in zip(reader.numbers, arrays, strict=True)
        ],
        "texts": reader.texts,
    }
    return head, [array.tobytes() for array in arrays]


if __name__ == "__main__":
    limit()
    about, parts = answer(sys.stdin.buffer.read(), int(sys.argv[1]))
    sys.stdout.buffer.write(json.dumps(about).encode() + b"\n")
    for part in parts:
        sys.stdout.buffer.write(part)
