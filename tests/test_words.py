"""Words of the program: its docstrings, comments and strings are plain English."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FILES = sorted(
    str(path.relative_to(ROOT))
    for folder in ("app", "bearingcore")
    for path in (ROOT / folder).rglob("*.py")
)

REFUSED = re.compile(
    r"\b(told|tells|(?<!cannot )tell|telling|somebody|nobody|anybody|strangers?)\b", re.IGNORECASE
)
"""Verbs of speech for what data does, and people who are nobody in particular."""
QUESTION = re.compile(r"\s*(Who|What|How)\b")
"""A docstring says what a thing is, with a noun, or what a function does, with a verb."""


ANY = re.compile(rf"{REFUSED.pattern}|beside|[\"']\s*(Who|What|How)\b", re.IGNORECASE)
"""What a text without a fault has nowhere: most are not parsed at all."""


def faults_in(source: str) -> list[str]:
    """Words that are refused, each with the line it begins in."""
    if not ANY.search(source):
        return []
    tree = ast.parse(source)
    found = [
        f"line {node.lineno}: {match[0]}"
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
        for match in REFUSED.finditer(node.value)
    ]
    found += [
        f"line {number}: {match[0]}"
        for number, comment in _comments(source)
        for match in REFUSED.finditer(comment)
    ]
    found += [
        f"line {node.lineno}: begins with {match[1]}"
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
        and (match := QUESTION.match(node.value.value))
    ]
    return found + [f"{name}: beside" for name in _names(tree) if "beside" in name.lower()]


def _comments(source: str) -> Iterator[tuple[int, str]]:
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            yield token.start[0], token.string


def _names(tree: ast.AST) -> Iterator[str]:
    """Names that a module defines: of functions, classes, arguments and variables."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef):
            yield node.name
        elif isinstance(node, ast.arg):
            yield node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


@pytest.mark.parametrize("path", FILES)
def test_a_file_has_none_of_the_words(path: str) -> None:
    assert faults_in((ROOT / path).read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    "source",
    [
        '"""What is here."""',
        'x = 1\n"""How many."""',
        "# nobody waits\n",
        'say("this cannot be told")',
        "def beside(): ...",
    ],
)
def test_faults_are_found(source: str) -> None:
    assert len(faults_in(source)) == 1
