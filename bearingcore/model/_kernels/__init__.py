"""Compiled code: small structs of numbers and arrays in, arrays out; one module a subject.

Nothing here knows of the rest of bearingcore, and no compiled function takes more than eight
arguments. `compiling` says how functions are compiled and kept on disk. Numba is imported when the
first compiled function is asked for, so that scenes can be made and files be judged without it.
"""

from typing import Any

import lazy_loader

_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    value = globals()[name] = _load(name)  # kept: `_load` looks in the modules each time
    return value
