"""Every dotted name in backticks, in docstrings and documents, names something that there is."""

import ast
import importlib
import inspect
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
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
FILE_ENDS = {
    "py",
    "md",
    "toml",
    "json",
    "js",
    "css",
    "csv",
    "html",
    "ipynb",
    "ini",
    "zarr",
    "h5",
    "mat",
}
LIBRARIES = {
    "np": "numpy",
    "pn": "panel",
    "hv": "holoviews",
    "figure": "bokeh.plotting.figure",
    "Document": "bokeh.document.Document",
}
NOT_INSTALLED_BY_TESTS = {"ross"}
KEYS = {"compare1.label"}
"""Of links: not names of the program."""


@dataclass
class Definitions:
    """Names of a module or class, those of classes inside it, and the classes it derives from."""

    names: set[str] = field(default_factory=set)
    inside: dict[str, "Definitions"] = field(default_factory=dict)
    bases: list[str] = field(default_factory=list)


def define(body: list[ast.stmt]) -> Definitions:
    """What statements define, at whatever depth of `if`, `with` and `try`."""
    names = Definitions()
    for node in body:
        if isinstance(node, ast.ClassDef):
            own = define(node.body)
            own.bases = [ast.unparse(base).split("[")[0].split(".")[-1] for base in node.bases]
            names.names.add(node.name)
            names.inside[node.name] = own
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            names.names.add(node.name)
            names.names |= {
                part.attr
                for part in ast.walk(node)
                if isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Store)
            }
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names.names |= {(alias.asname or alias.name).split(".")[0] for alias in node.names}
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            parts = (part for target in targets for part in ast.walk(target))
            names.names |= {part.id for part in parts if isinstance(part, ast.Name)}
        elif isinstance(node, ast.If | ast.With | ast.Try | ast.For):
            nested = define([*node.body, *getattr(node, "orelse", [])])
            names.names |= nested.names
            names.inside |= nested.inside
    return names


@cache
def modules() -> dict[str, Definitions]:
    """All modules by their names."""
    return {module_of(file): define(ast.parse(_listed(file)).body) for file in SOURCES}


def _listed(file: Path) -> str:
    """The text of a module, or of the stub that lists what it imports when it is used."""
    stub = file.with_suffix(".pyi")
    return (stub if stub.exists() else file).read_text(encoding="utf-8")


def module_of(file: Path) -> str:
    """The name that a file is imported by."""
    parts = file.relative_to(ROOT).with_suffix("").parts
    parts = parts[1:] if parts[0] == "app" else parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def called(path: str) -> list[Definitions]:
    """Modules whose names are or end with a path."""
    return [own for name, own in modules().items() if _bare(name).endswith(_bare(path))]


def _bare(name: str) -> str:
    """A dotted name without the underscores of private modules, which sentences leave out."""
    return f".{name}".replace("._", ".")


@cache
def classes() -> dict[str, list[Definitions]]:
    """All classes by their names, at whatever depth."""
    owners: dict[str, list[Definitions]] = {}

    def collect(inside: dict[str, Definitions]) -> None:
        for name, own in inside.items():
            owners.setdefault(name, []).append(own)
            collect(own.inside)

    for module in modules().values():
        collect(module.inside)
    return owners


def has(owner: Definitions, rest: list[str], depth: int = 0) -> bool:
    """Whether a class has an attribute, of itself or of a class that it derives from.

    What the attribute is, and so what it has, is not known here: one is looked for.
    """
    if not rest or rest[0] in owner.names:
        return True
    bases = [base for name in owner.bases for base in classes().get(name, [])]
    known = all(name in classes() or name in {"Generic", "Protocol"} for name in owner.bases)
    outside = bool(owner.bases) and not known  # of a library's class all is allowed
    return outside or (depth < 8 and any(has(base, rest, depth + 1) for base in bases))


def is_in_project(name: str) -> bool:
    """Whether a name leads to a module, a name in one, or an attribute of a class.

    Modules may be named by their last parts, objects by their class in lower case.
    """
    parts = name.split(".")
    for cut in range(len(parts), 0, -1):
        rest = parts[cut:]
        for own in called(".".join(parts[:cut])):
            if not rest or (rest[0] in own.names and (len(rest) == 1 or is_of_class(rest))):
                return True
    return is_of_class(parts)


def is_of_class(parts: list[str]) -> bool:
    """Whether the first part is a class, or an object of one, that has the second."""
    first = parts[0]
    camel = "".join(word.capitalize() for word in first.strip("_").split("_"))
    owners = [own for name in {first, camel} for own in classes().get(name, [])]
    return any(has(own, parts[1:]) for own in owners)


def is_in_library(name: str) -> bool:
    """Whether a name leads to something in an installed package."""
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


def is_file(name: str) -> bool:
    """Whether a name is that of a file, of this tree or of a kind that users have."""
    return name.rsplit(".", 1)[1] in FILE_ENDS


def docstrings(file: Path) -> Iterator[tuple[int, str]]:
    """Texts that stand as statements of their own, with their lines."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            yield value.lineno, value.value


def is_of_self(name: str, own: Iterable[Definitions]) -> bool:
    """Whether a name is that of an attribute of one of the classes beside it."""
    first, *rest = name.split(".")
    return first == "self" and any(has(one, rest) for one in own)


def wrong(text: str, own: Iterable[Definitions] = ()) -> list[str]:
    """Dotted names of a text that lead nowhere; `own` are the classes of its file."""
    return [
        name
        for name in NAME.findall(text)
        if not (name in KEYS or is_file(name) or is_of_self(name, own))
        if not (is_in_project(name) or is_in_library(name))
    ]


@pytest.mark.parametrize("package", ["bearingcore", "app"])
def test_names_in_docstrings_lead_somewhere(package: str) -> None:
    dead_ends = [
        f"{file.relative_to(ROOT)}:{line} {name}"
        for file in SOURCES
        if file.relative_to(ROOT).parts[0] == package
        for line, text in docstrings(file)
        for name in wrong(text, modules()[module_of(file)].inside.values())
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
