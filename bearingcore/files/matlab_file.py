"""Numbers and words out of MATLAB files, versions 4 to 7.

scipy's reader brings the whole program down on some damaged files, cannot be told how much it may
unpack, and in a process of its own would take half a second a file. This one is small because it
reads only what a measurement can be: real matrices and text, also inside structs and cells. It
never goes further than the file, `most_bytes` of unpacked data, `MOST_ELEMENTS` and `DEEPEST`
reach; scipy writes the files it is tested with. Version 7.3 is HDF5: see `hdf5_file`.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

HEADER = 128
"""Bytes before the first element of version 5 to 7; text, version and byte order."""

MOST_ELEMENTS = 10_000
"""Matrices in a file, those inside structs and cells among them."""

DEEPEST = 8
"""Structs and cells inside one another."""

LONGEST_TEXT = 1000
"""[characters] of words that are kept."""

UNPACKED_AT_ONCE = 2**20

_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8"}
_NUMBERS |= {13: "u8"}
_ENCODINGS = {1: "latin-1", 2: "latin-1", 4: "utf-16", 16: "utf-8", 17: "utf-16", 18: "utf-32"}
_MATRIX, _COMPRESSED = 14, 15
_CELL, _STRUCT, _CHAR = 1, 2, 4
_NUMERIC_CLASSES = range(6, 16)
_COMPLEX, _LOGICAL = 0x0800, 0x0200
_VERSION_4_NUMBERS = ("f8", "f4", "i4", "i2", "u2", "u1")


@dataclass
class Variables:
    """What a file names: matrices in the kind of number they are stored in, and words.

    Fields of structs are named as in MATLAB: "bearing.gs", "runs(2).gs", "parts{3}".
    """

    numbers: dict[str, NDArray[Any]] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)


def read_matlab(content: bytes, most_bytes: int) -> Variables:
    """Real matrices of two dimensions and words in a file; the rest is passed over.

    The matrices are views into `content` where it is not compressed.

    Raises
    ------
    ValueError
        saying in a few words what is wrong.
    """
    order = {b"IM": "<", b"MI": ">"}.get(content[126:128])
    if order is None:
        return _version_4(memoryview(content))
    reader = _Version5(order, most_bytes)
    reader.read(memoryview(content)[HEADER:])
    return reader.found


class _Version5:
    """Reads the elements of a file one after the other, within its limits."""

    def __init__(self, order: str, most_bytes: int) -> None:
        self.found = Variables()
        self._order = order
        self._most = most_bytes
        self._unpacked = 0
        self._elements = 0

    def read(self, content: memoryview) -> None:
        for kind, data in self._parts(content):
            if kind == _COMPRESSED:
                kind, data = next(self._parts(self._unpack(data)), (0, data))
            if kind == _MATRIX:
                self._matrix(data, "", 0)

    def _unpack(self, packed: memoryview) -> memoryview:
        """The element in a compressed one; no more of it than its own head says."""
        unpacker = zlib.decompressobj()
        out = bytearray()
        left = self._most - self._unpacked
        try:
            for begin in range(0, len(packed), 2**16):
                piece: bytes | memoryview = packed[begin : begin + 2**16]
                while piece:
                    out += unpacker.decompress(piece, UNPACKED_AT_ONCE)
                    if len(out) > left:
                        raise ValueError(f"over {self._most / 2**20:.0f} MB once unpacked")
                    piece = unpacker.unconsumed_tail
                if unpacker.eof:
                    break
        except zlib.error:
            raise ValueError("a compressed part that does not unpack") from None
        self._unpacked += len(out)
        return memoryview(out)

    def _parts(self, content: memoryview) -> Iterator[tuple[int, memoryview]]:
        """(type, data) of the elements that follow one another, each filled up to 8 bytes."""
        place = 0
        while place + 8 <= len(content):
            self._elements += 1
            if self._elements > 8 * MOST_ELEMENTS:
                raise ValueError(f"over {MOST_ELEMENTS} parts")
            kind, size = struct.unpack_from(self._order + "II", content, place)
            if kind >> 16:  # a short element keeps its size and data in the tag
                kind, size = kind & 0xFFFF, kind >> 16
                if size > 4:
                    raise ValueError("a part whose size makes no sense")
                yield kind, content[place + 4 : place + 4 + size]
                place += 8
                continue
            place += 8
            if place + size > len(content):
                raise ValueError("a part that goes on beyond the end of the file")
            yield kind, content[place : place + size]
            place += size if kind == _COMPRESSED else -(-size // 8) * 8

    def _matrix(self, data: memoryview, path: str, depth: int) -> None:
        """Keep what a matrix, a struct or a cell holds, under its path or its own name."""
        if depth > DEEPEST:
            raise ValueError(f"structs inside one another deeper than {DEEPEST}")
        if not data:
            return  # a field that was never filled
        parts = self._parts(data)
        flags, shape, name = (next(parts, (0, memoryview(b"")))[1] for _ in range(3))
        if len(flags) < 4 or len(shape) % 4:
            raise ValueError("a matrix without its description")
        word = struct.unpack_from(self._order + "I", flags)[0]
        size = np.frombuffer(shape, self._order + "i4").tolist()
        path = path or bytes(name).decode("latin-1")
        kind = word & 0xFF
        if min(size, default=-1) < 0:
            raise ValueError("a matrix whose size makes no sense")
        if kind == _STRUCT:
            self._struct(parts, path, math.prod(size), depth)
        elif kind == _CELL:
            for index, (_, inside) in zip(range(math.prod(size)), parts, strict=False):
                self._matrix(inside, f"{path}{{{index + 1}}}", depth + 1)
        elif kind == _CHAR:
            stored, letters = next(parts, (0, memoryview(b"")))
            self._text(path, stored, letters)
        elif kind in _NUMERIC_CLASSES and not word & (_COMPLEX | _LOGICAL) and len(size) == 2:
            stored, numbers = next(parts, (0, memoryview(b"")))
            self.found.numbers[path] = _shaped(numbers, _NUMBERS.get(stored), self._order, size)

    def _struct(
        self, parts: Iterator[tuple[int, memoryview]], path: str, count: int, depth: int
    ) -> None:
        length = bytes(next(parts, (0, b""))[1])
        letters = bytes(next(parts, (0, b""))[1])
        if len(length) != 4:
            raise ValueError("a struct without the names of its fields")
        (each,) = struct.unpack(self._order + "i", length)
        if not 0 < each <= 256:
            raise ValueError("a struct whose names of fields make no sense")
        names = [
            letters[begin : begin + each].partition(b"\x00")[0].decode("latin-1")
            for begin in range(0, len(letters) - each + 1, each)
        ]
        if not names:
            return
        for index, (_, inside) in enumerate(parts):
            element, field_index = divmod(index, len(names))
            if element >= count:
                break
            of = f"{path}({element + 1})" if count > 1 else path
            self._matrix(inside, f"{of}.{names[field_index]}", depth + 1)

    def _text(self, path: str, stored: int, letters: memoryview) -> None:
        encoding = _ENCODINGS.get(stored, "latin-1")
        if encoding in ("utf-16", "utf-32"):
            encoding += "-le" if self._order == "<" else "-be"
        text = bytes(letters[: 4 * LONGEST_TEXT]).decode(encoding, "replace")
        self.found.texts[path] = text[:LONGEST_TEXT].strip()


def _version_4(content: memoryview) -> Variables:
    found = Variables()
    place = 0
    while place < len(content):
        if place + 20 > len(content):
            raise ValueError("a part that goes on beyond the end of the file")
        order = "<" if content[place + 2 : place + 4] == b"\x00\x00" else ">"
        kind, rows, columns, imaginary, length = struct.unpack_from(order + "5i", content, place)
        machine, precision, use = kind // 1000, kind // 10 % 10, kind % 10
        known = machine == (order == ">") and 0 <= precision < len(_VERSION_4_NUMBERS)
        if not known or min(rows, columns) < 0 or not 0 < length <= 256:
            raise ValueError("no beginning of a MATLAB file")
        place += 20
        number = _VERSION_4_NUMBERS[precision]
        size = rows * columns * int(number[1])
        whole = size * (2 if imaginary else 1)
        if place + length + whole > len(content):
            raise ValueError("a part that goes on beyond the end of the file")
        name = bytes(content[place : place + length]).rstrip(b"\x00").decode("latin-1")
        place += length
        if use == 0 and not imaginary:
            data = content[place : place + size]
            found.numbers[name] = _shaped(data, number, order, [rows, columns])
        elif use == 1 and rows == 1 and columns <= LONGEST_TEXT:
            codes = _shaped(content[place : place + size], number, order, [rows, columns])
            with np.errstate(invalid="ignore"):
                text = codes.ravel().astype(np.uint8).tobytes().decode("latin-1")
            found.texts[name] = text.strip()
        place += whole
        if len(found.numbers) + len(found.texts) > MOST_ELEMENTS:
            raise ValueError(f"over {MOST_ELEMENTS} parts")
    return found


def _shaped(data: memoryview, number: str | None, order: str, size: list[int]) -> NDArray[Any]:
    """Numbers as a matrix, laid out column after column in the file."""
    if number is None or len(data) != size[0] * size[1] * int(number[1]) or min(size) < 0:
        raise ValueError("a matrix whose numbers do not fill it")
    return np.frombuffer(data, order + number).reshape(size, order="F")
