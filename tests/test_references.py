"""Every dotted name in backticks, in docstrings and documents, names something that there is."""

import ast
import importlib
import inspect
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SOURCES = sorted([*ROOT.glob("bearingcore/**/*.py"), *ROOT.glob("app/bearing_explorer/**/*.py")])
GENERATED = {"API.md", "CHANGELOG.md"}
DOCUMENTS = [
    file
    for file in sorted([*ROOT.glob("*.md"), *ROOT.glob("assets/docs/**/*.md")])
    if file.name not in GENERATED
]
NAME = re.compile(r"(?<![`\w])`([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)+)(?:\(.*?\))?`")
FILE = re.compile(r".*\.(py|md|toml|json|js|css|csv|html|ipynb|ini|zarr|h5|mat)")
LIBRARIES = {
    "np": "numpy",
    "pn": "panel",
    "hv": "holoviews",
    "figure": "bokeh.plotting.figure",
    "Document": "bokeh.document.Document",
}
NOT_INSTALLED_BY_TESTS = {"ross"}
KEYS_OF_LINKS = {"compare1.label"}
"""Not names of the program."""


def bare(name: str) -> str:
    """Return a name without underscores and capitals: sentences leave them out."""
    return name.replace("_", "").lower()


def names_in(tree: ast.AST) -> set[str]:
    """Return the bare names that a module or class binds, at whatever depth."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            names.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            names.add(node.attr)
        elif isinstance(node, ast.alias):
            names.add((node.asname or node.name).split(".")[0])
    return {bare(name) for name in names}


@cache
def tree_of(file: Path) -> ast.Module:
    """Return the statements of a file."""
    return ast.parse(file.read_text(encoding="utf-8"))


@cache
def members() -> tuple[dict[str, set[str]], dict[str, set[str]]]:
    """Names inside every package, module and class, and the bases of classes, by bare names."""
    inside: dict[str, set[str]] = defaultdict(set)
    bases: dict[str, set[str]] = defaultdict(set)
    for file in SOURCES:
        module = file.parent if file.stem == "__init__" else file
        inside[bare(module.parent.name)].add(bare(module.stem))
        stub = file.with_suffix(".pyi")  # lists what is imported when it is used
        inside[bare(module.stem)] |= names_in(tree_of(stub if stub.exists() else file))
        for node in ast.walk(tree_of(file)):
            if isinstance(node, ast.ClassDef):
                names = names_in(node)
                inside[bare(node.name)] |= names
                inside["self"] |= names
                parents = (ast.unparse(base).split("[")[0].split(".")[-1] for base in node.bases)
                bases[bare(node.name)] |= {bare(parent) for parent in parents}
    return inside, bases


def has(owner: str, name: str) -> bool:
    """Return True if a module or class has a name, of itself or of a class it derives from.

    A class of a library is taken to have every name.
    """
    inside, bases = members()
    parents = bases.get(owner, set()) - {"generic", "protocol", owner}
    return name in inside.get(owner, set()) or any(
        parent not in inside or has(parent, name) for parent in parents
    )


def is_in_project(name: str) -> bool:
    """Return True if each part of a name is in the one before it, where that one is known."""
    inside, _ = members()
    parts = [bare(part) for part in name.split(".")]
    return parts[0] in inside and all(
        has(owner, part) for owner, part in pairwise(parts) if owner in inside
    )


def is_in_library(name: str) -> bool:
    """Return True if a name leads to something in an installed package."""
    first, rest = name.split(".", 1)
    if first in NOT_INSTALLED_BY_TESTS:
        return True
    parts = [*LIBRARIES.get(first, first).split("."), *rest.split(".")]
    for cut in range(len(parts), 0, -1):
        try:
            thing: object = importlib.import_module(".".join(parts[:cut]))
        except ImportError:
            continue
        for part in parts[cut:]:
            if isinstance(thing, type) and f"self.{part} = " in inspect.getsource(thing):
                return True
            if not hasattr(thing, part):
                return False
            thing = getattr(thing, part)
        return True
    return False


def docstrings(file: Path) -> Iterator[tuple[int, str]]:
    """Texts that stand as statements of their own, with their lines."""
    for node in ast.walk(tree_of(file)):
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value.lineno, value.value


def wrong(text: str) -> list[str]:
    """Dotted names of a text that lead nowhere."""
    return [
        name
        for name in NAME.findall(text)
        if not (name in KEYS_OF_LINKS or FILE.fullmatch(name))
        if not (is_in_project(name) or is_in_library(name))
    ]


@pytest.mark.parametrize("package", ["bearingcore", "app"])
def test_names_in_docstrings_lead_somewhere(package: str) -> None:
    dead_ends = [
        f"{file.relative_to(ROOT)}:{line} {name}"
        for file in SOURCES
        if file.relative_to(ROOT).parts[0] == package
        for line, text in docstrings(file)
        for name in wrong(text)
    ]
    assert not dead_ends, "\n".join(dead_ends)


@pytest.mark.parametrize("file", DOCUMENTS, ids=lambda file: file.name)
def test_names_in_documents_lead_somewhere(file: Path) -> None:
    assert wrong(file.read_text(encoding="utf-8")) == []


def test_the_test_tells_names_that_are_from_those_that_are_not() -> None:
    text = (
        "`bearingcore.equilibrium` `statics.positions` `Bearing.of_row` `np.linspace` `scene.load`"
    )
    assert wrong(text) == []
    text = "`bearingcore.hertz` `compute.results` `Bearing.no_such` `np.no_such` `scene.no_such`"
    assert len(wrong(text)) == 5
