"""Numbers and words out of HDF5 files, MATLAB's version 7.3 among them.

h5py reads them. Files that are damaged or crafted can bring its C library down, unpack to anything
or name other files of this machine, so it works in a process of its own with bounds on memory and
time, on the bytes alone, without plug-ins.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from bearingcore.files.matlab_file import Variables

LONGEST = 30.0
"""[s] that reading a file may take."""

_CHILD = Path(__file__).with_name("hdf5_child.py")
MARK = b"\x89HDF\r\n\x1a\n"


def is_hdf5(content: bytes) -> bool:
    """Whether a file is HDF5, at its beginning or after MATLAB's 512 bytes of text."""
    return MARK in (content[:8], content[512:520])


def read_hdf5(content: bytes, most_numbers: int) -> Variables:
    """Real arrays of up to two dimensions and words in a file; the rest is passed over.

    Raises
    ------
    ValueError
        saying in a few words what is wrong.
    """
    environment = {
        **os.environ,
        "HDF5_PLUGIN_PATH": "::",  # none is loaded
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
    }
    try:
        done = subprocess.run(
            [sys.executable, "-P", str(_CHILD), str(most_numbers)],
            input=content,
            capture_output=True,
            timeout=LONGEST,
            env=environment,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise ValueError(f"parts that take over {LONGEST:.0f} s to read") from None
    except OSError:
        raise ValueError(
            "version 7.3, for which this system starts no process to read it"
        ) from None
    line, found, rest = done.stdout.partition(b"\n")
    if done.returncode != 0 or not found:
        raise ValueError("a damaged or unknown part, or more in it than can be unpacked")
    about = json.loads(line)
    if "wrong" in about:
        raise ValueError(about["wrong"])
    variables = Variables(texts=about["texts"])
    place = 0
    data = memoryview(rest)
    for name, kind, shape in about["numbers"]:
        size = int(np.dtype(kind).itemsize * np.prod(shape, dtype=np.int64))
        array = np.frombuffer(data[place : place + size], kind).reshape(shape)
        variables.numbers[name] = np.atleast_2d(array)
        place += size
    return variables
