"""The claims of tests: which capability a test holds against the outside, by what, how closely.

A claim stands over its test:

    @witness("ball: statics", by="SciPy: least energy", compared="loads", within=1e-7)

Capabilities are those of `tests.outside.capabilities`; `*` stands for any letters. `within` is the
greatest relative difference that the test allows, or its words; numbers must stand in the test.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

Test = TypeVar("Test", bound=Callable[..., Any])


@dataclass(frozen=True)
class Claim:
    """What one test holds against the outside."""

    capabilities: tuple[str, ...]
    by: str
    compared: str
    within: float | str
    test: Callable[..., Any]

    @property
    def place(self) -> str:
        """Where the test is: file, then function."""
        return f"{self.test.__module__.rpartition('.')[2]}.{self.test.__name__}"


CLAIMS: list[Claim] = []


def witness(
    *capabilities: str, by: str, compared: str, within: float | str
) -> Callable[[Test], Test]:
    """Enter a test in the list of witnesses; the test itself stays as it is."""

    def entered(test: Test) -> Test:
        CLAIMS.append(Claim(capabilities, by, compared, within, test))
        return test

    return entered
