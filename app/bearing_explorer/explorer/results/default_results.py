"""Results of the default scene that come with the package: pictures before kernels are compiled.

After a change of numbers, ``python -m bearing_explorer.default_results`` makes them again.
"""

from __future__ import annotations

import logging
import lzma
import pickle
from collections.abc import Hashable
from pathlib import Path
from typing import Any

from bearing_explorer.kit.assets import asset_path
from bearing_explorer.kit.compute.cache import keep_results, kept_results

log = logging.getLogger(__name__)

NAME = "default_results.xz"
LARGEST = 500_000
"""Most bytes of a stored result: whole motions are left out, results made of them are not."""


def collect() -> dict[tuple[Hashable, ...], Any]:
    """Results in the cache of at most `LARGEST` bytes."""
    return {key: result for key, (result, size) in kept_results().items() if size <= LARGEST}


def write(path: Path) -> None:
    """Write the collected results to a file."""
    path.write_bytes(lzma.compress(pickle.dumps(collect(), protocol=5)))


def read() -> dict[tuple[Hashable, ...], Any]:
    """Read the stored results."""
    results: dict[tuple[Hashable, ...], Any] = pickle.loads(
        lzma.decompress(asset_path(NAME).read_bytes())
    )
    return results


def keep() -> None:
    """Put the stored results into the cache; without them first pictures wait for kernels."""
    try:
        keep_results(read())
    except Exception:  # another version of a library may not unpickle them
        log.exception("the stored default results cannot be read")
