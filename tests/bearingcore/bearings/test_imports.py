"""How files of the package of bearings stand on each other."""

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import bearingcore.bearings

PACKAGE = "bearingcore.bearings"
FILES = {path.stem: path for path in Path(bearingcore.bearings.__path__[0]).glob("*.py")}


def imported(path: Path) -> set[str]:
    """Files of the package that a file imports, in functions too; not for the checker of types."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            node.body = []
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    inside = {name.removeprefix(f"{PACKAGE}.") for name in names if name.startswith(PACKAGE)}
    first = {name.partition(".")[0] for name in inside}
    return {name if name in FILES else "__init__" for name in first}


def test_no_files_of_bearings_stand_on_each_other_in_a_circle() -> None:
    graph = {name: imported(path) for name, path in FILES.items()}
    assert "_kinds" in graph["_bearing"]
    assert "_ball" in graph["_kinds"]
    order = list(TopologicalSorter(graph).static_order())  # refuses a circle, and names it
    assert order.index("_contact") < order.index("_ball") < order.index("_bearing")
