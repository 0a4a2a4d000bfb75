"""A name of the core means one thing in its package."""

import ast
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

import bearingcore

ROOT = Path(bearingcore.__file__).parent
PACKAGES = sorted({file.parent for file in ROOT.rglob("*.py")})


def definitions(file: Path) -> Iterator[tuple[str, str]]:
    """Public top-level names of a file, and what makes them."""
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        names: list[str] = []
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names = [node.name]
        elif isinstance(node, ast.Assign):
            inside = (part for target in node.targets for part in ast.walk(target))
            names = [part.id for part in inside if isinstance(part, ast.Name)]
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            names = [node.target.id]
        yield from ((name, ast.unparse(node)) for name in names if not name.startswith("_"))


def twice(files: list[Path]) -> dict[str, list[str]]:
    """Names that files define differently, with the files; the same alias may stand in several."""
    found: dict[str, dict[str, str]] = defaultdict(dict)
    for file in files:
        for name, text in definitions(file):
            found[name][file.name] = text
    return {
        name: sorted(where)
        for name, where in found.items()
        if len(where) > 1 and len({*where.values()}) > 1
    }


@pytest.mark.parametrize("package", PACKAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_a_public_name_is_defined_once_in_a_package(package: Path) -> None:
    found = twice(sorted(package.glob("*.py")))
    assert not found


def test_the_test_sees_names_that_mean_two_things(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("LIMIT, Same = 1, 2\nArray = list\ndef _own(): ...\n")
    (tmp_path / "b.py").write_text("class Same: ...\nArray = list\ndef _own(): return 1\n")
    assert twice(sorted(tmp_path.glob("*.py"))) == {"Same": ["a.py", "b.py"]}
