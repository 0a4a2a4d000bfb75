"""No file imports one that imports it, also through others."""

import ast
import importlib.util
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

PACKAGES = ("bearingcore", "bearing_explorer")


def files_of(package: str) -> dict[str, Path]:
    """The files of a package by the names of their modules."""
    spec = importlib.util.find_spec(package)
    assert spec is not None
    assert spec.origin is not None
    root = Path(spec.origin).parent
    files = {}
    for path in root.rglob("*.py"):
        parts = path.relative_to(root.parent).with_suffix("").parts
        files[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return files


def imports_of(path: Path, files: dict[str, Path]) -> set[str]:
    """Modules that a file imports: inside functions too, and for the checker of types alone.

    `from package import name` counts as the module of that name where there is one, else as the
    package.
    """
    imports = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            imports |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names = [f"{node.module}.{alias.name}" for alias in node.names]
            imports |= {name if name in files else node.module for name in names}
    return imports & files.keys()


@pytest.mark.parametrize("package", PACKAGES)
def test_no_files_import_each_other_in_a_circle(package: str) -> None:
    files = files_of(package)
    graph = {module: imports_of(path, files) for module, path in files.items()}
    assert sum(map(len, graph.values())) > len(files), "imports are seen"
    order = list(TopologicalSorter(graph).static_order())  # refuses a circle, and names it
    assert set(order) == set(files)


def test_the_kinds_of_bearing_stand_below_the_bearing() -> None:
    files = files_of("bearingcore")
    of_bearing = imports_of(files["bearingcore.bearings._bearing"], files)
    assert {"bearingcore.bearings._kinds", "bearingcore.bearings._tapered"} <= of_bearing
