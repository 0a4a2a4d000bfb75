"""Matrices of real numbers out of MATLAB files, versions 4 to 7.

scipy's reader brings the whole program down on some damaged files, which a program that takes
files from strangers cannot afford. This one reads real numeric matrices, nothing else, and never
further than the file or `most_bytes` goes.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

HEADER = 128
"""Bytes before the first element of version 5 to 7; text, version and byte order."""

_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8"}
_NUMBERS |= {13: "u8"}
_MATRIX, _COMPRESSED = 14, 15
_NUMERIC_CLASSES = range(6, 16)
_COMPLEX, _LOGICAL = 0x0800, 0x0200
_VERSION_4_NUMBERS = ("f8", "f4", "i4", "i2", "u2", "u1")


def read_matrices(content: bytes, most_bytes: int) -> dict[str, NDArray[np.float64]]:
    """Real matrices of two dimensions in a file, by name; whatever else it holds is passed over.

    Raises
    ------
    ValueError
        saying in a few words what is wrong.
    """
    if content[:4] == b"\x89HDF" or b"MATLAB 7.3" in content[:HEADER]:
        raise ValueError("version 7.3; save it with '-v7'")
    order = {b"IM": "<", b"MI": ">"}.get(content[126:128])
    if order is not None:
        return dict(_version_5(content[HEADER:], order, most_bytes))
    return dict(_version_4(content))


def _version_5(
    content: bytes, order: str, most_bytes: int
) -> Iterator[tuple[str, NDArray[np.float64]]]:
    unpacked = 0
    for kind, data in _elements(content, order):
        if kind == _COMPRESSED:
            unpacker = zlib.decompressobj()
            try:
                data = unpacker.decompress(data, most_bytes - unpacked + 1)
            except zlib.error:
                raise ValueError("a compressed part that does not unpack") from None
            unpacked += len(data)
            if unpacked > most_bytes:
                raise ValueError(f"over {most_bytes // 2**20} MB once unpacked")
            kind, data = next(_elements(data, order), (0, b""))
        if kind == _MATRIX:
            matrix = _matrix(data, order)
            if matrix is not None:
                yield matrix


def _elements(content: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """(type, data) of the elements that follow one another, each filled up to 8 bytes."""
    place = 0
    while place + 8 <= len(content):
        kind, size = struct.unpack_from(order + "II", content, place)
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


def _matrix(data: bytes, order: str) -> tuple[str, NDArray[np.float64]] | None:
    """Name and numbers of a matrix, or None where it is not a real one of two dimensions."""
    parts = _elements(data, order)
    flags, shape, name = (next(parts, (0, b""))[1] for _ in range(3))
    if len(flags) < 4 or len(shape) % 4:
        raise ValueError("a matrix without its description")
    word = struct.unpack_from(order + "I", flags)[0]
    size = np.frombuffer(shape, order + "i4").tolist()
    if word & 0xFF not in _NUMERIC_CLASSES or word & (_COMPLEX | _LOGICAL) or len(size) != 2:
        return None
    kind, numbers = next(parts, (0, b""))
    return name.decode("latin-1"), _shaped(numbers, _NUMBERS.get(kind), order, size)


def _version_4(content: bytes) -> Iterator[tuple[str, NDArray[np.float64]]]:
    place = 0
    while place < len(content):
        if place + 20 > len(content):
            raise ValueError("a part that goes on beyond the end of the file")
        order = "<" if content[place + 2 : place + 4] == b"\x00\x00" else ">"
        kind, rows, columns, imaginary, length = struct.unpack_from(order + "5i", content, place)
        machine, precision, use = kind // 1000, kind // 10 % 10, kind % 10
        known = machine == (order == ">") and precision < len(_VERSION_4_NUMBERS)
        if not known or min(rows, columns) < 0 or not 0 < length <= 256:
            raise ValueError("no beginning of a MATLAB file")
        place += 20
        number = _VERSION_4_NUMBERS[precision]
        size = rows * columns * int(number[1])
        whole = size * (2 if imaginary else 1)
        if place + length + whole > len(content):
            raise ValueError("a part that goes on beyond the end of the file")
        name = content[place : place + length].rstrip(b"\x00").decode("latin-1")
        place += length
        if use == 0 and not imaginary:
            yield name, _shaped(content[place : place + size], number, order, [rows, columns])
        place += whole


def _shaped(data: bytes, number: str | None, order: str, size: list[int]) -> NDArray[np.float64]:
    """Numbers as a matrix, laid out column after column in the file."""
    if number is None or len(data) != size[0] * size[1] * int(number[1]) or min(size) < 0:
        raise ValueError("a matrix whose numbers do not fill it")
    with np.errstate(invalid="ignore"):  # signalling NaNs in damaged files
        return np.frombuffer(data, order + number).astype(float).reshape(size, order="F")
