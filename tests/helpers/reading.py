"""Read files in the process of the tests, which is quicker than a child process."""

import warnings
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from bearingcore.measured.files import _formats as formats


def read_here(
    name: str, content: bytes, give_up: object = None
) -> tuple[dict[str, Any], NDArray[np.float64]]:
    """Do the work of `read_file` without its child process, which takes a third of a second."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return formats.read(name, content)


def read_in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Read tables by `read_here` during a test."""
    monkeypatch.setattr("bearingcore.measured.files._table.read_file", read_here)
