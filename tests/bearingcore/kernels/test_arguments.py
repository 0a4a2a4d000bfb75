"""Compiled functions stay small to call: structs, not lists of arguments."""

from __future__ import annotations

import importlib
import inspect
import pkgutil

from numba.extending import is_jitted

import bearingcore

MOST_ARGUMENTS = 8


def test_no_compiled_function_takes_more_than_eight_arguments() -> None:
    counts: dict[str, int] = {}
    for module in pkgutil.walk_packages(bearingcore.__path__, "bearingcore."):
        for name, value in vars(importlib.import_module(module.name)).items():
            if is_jitted(value):
                counts[name] = len(inspect.signature(value.py_func).parameters)
    assert len(counts) > 40
    assert {name: n for name, n in counts.items() if n > MOST_ARGUMENTS} == {}
