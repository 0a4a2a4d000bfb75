"""Compiled code: it takes small structs of numbers and arrays, and returns arrays.

Nothing here imports the rest of bearingcore, and no compiled function takes more than eight
arguments. `compiling` says how functions are compiled and kept on disk. Numba is imported when the
first compiled function is asked for: making a scene or diagnosing a file does not need it.
"""

from typing import Any

import lazy_loader

_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    value = globals()[name] = _load(name)  # kept, as `_load` searches the modules each time
    return value
