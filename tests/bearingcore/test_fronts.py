"""Fronts of the core's packages list what somebody outside takes from them, and no more."""

import ast
import importlib
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CORE = ROOT / "bearingcore"
PACKAGES = sorted(path.parent.name for path in CORE.glob("*/__init__.py"))
TAKEN_AND_RETURNED = {
    "BallPositions", "Candidate", "Sizing", "Spectrogram", "Support", "TrendPoint",
}  # fmt: skip
"""Types of what the functions of `bearingcore` take and return: its reference describes them."""

FRONTS = ["bearingcore", *(f"bearingcore.{name}" for name in PACKAGES)]


def _python(path: Path) -> Iterator[str]:
    """The lines of Python in a module, a notebook or a document."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        yield from ("".join(cell["source"]) for cell in json.loads(text)["cells"])
    else:
        yield text


def _outside(package: str) -> Iterator[Path]:
    """The page and its tests, notebooks and documents; for a package the core around it too."""
    yield ROOT / "README.md"
    for folder in ("app", "assets/notebooks", "assets/docs", "assets/lessons", "tests"):
        for path in (ROOT / folder).rglob("*"):
            own = path.is_relative_to(ROOT / "tests/bearingcore") or path.name == "API.md"
            if path.suffix in (".py", ".ipynb", ".md") and not own:
                yield path
    if package != "bearingcore":
        inside = CORE / package.removeprefix("bearingcore.")
        yield from (path for path in CORE.rglob("*.py") if not path.is_relative_to(inside))


def _taken(package: str, text: str) -> Iterator[str]:
    """Names that a text takes from a front: `from front import name`, `front.name`."""
    for names in re.findall(rf"from {re.escape(package)} import (\([^)]*\)|[^\n(\"]+)", text):
        yield from re.findall(r"\w+", re.sub(r" as \w+", "", names))
    above, _, own = package.rpartition(".")
    called = {package}
    called |= set(re.findall(rf"import {package} as (\w+)", text))
    if above and re.search(rf"from {above} import [^\n]*\b{own}\b", text):
        called.add(own)
    for name in called:
        yield from re.findall(rf"\b{re.escape(name)}\.(\w+)", text)


def _listed(package: str) -> set[str]:
    """What a front shows: what it imports from the core."""
    file = importlib.import_module(package).__file__
    tree = ast.parse(Path(str(file)).read_text(encoding="utf-8"))
    return {
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("bearingcore")
        for alias in node.names
    }


@pytest.mark.parametrize("package", FRONTS)
def test_a_front_lists_what_is_taken_from_it_outside(package: str) -> None:
    texts = [text for path in _outside(package) for text in _python(path)]
    taken = {name for text in texts for name in _taken(package, text)}
    assert sorted(_listed(package) - taken - TAKEN_AND_RETURNED) == []
