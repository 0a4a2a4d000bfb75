"""Results of the default scene that come with the package: pictures before kernels are compiled.

``python -m bearing_explorer.default_results`` makes them anew, which a change of numbers takes.
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
"""Bytes of a result that comes along: whole motions do not, only what is made of them."""


def collected() -> dict[tuple[Hashable, ...], Any]:
    """All results in the cache, but the largest."""
    return {key: result for key, (result, size) in kept_results().items() if size <= LARGEST}


def write(path: Path) -> None:
    """Write all results in the cache."""
    path.write_bytes(lzma.compress(pickle.dumps(collected(), protocol=5)))


def read() -> dict[tuple[Hashable, ...], Any]:
    """The results that come along."""
    results: dict[tuple[Hashable, ...], Any] = pickle.loads(
        lzma.decompress(asset_path(NAME).read_bytes())
    )
    return results


def keep() -> None:
    """Put them into the cache; without them first pictures wait for their kernels."""
    try:
        keep_results(read())
    except Exception:  # another version of a library may not know its own old numbers
        log.exception("the results that come along cannot be read")
