"""No capability without a witness, and no digit in a document that no test holds."""

from __future__ import annotations

import ast
import fnmatch
import inspect
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.outside.capabilities import ROOT, capabilities
from tests.outside.trust import NOT_CHECKED, as_markdown, claims, witnesses
from tests.outside.witness import Claim

DOCUMENT = ROOT / "assets/docs/TRUST.md"


def numbers_in(node: ast.AST) -> Iterator[float]:
    """Numbers of a piece of a program, but for those of claims."""
    if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "witness":
        return
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        yield float(node.value)
    for child in ast.iter_child_nodes(node):
        yield from numbers_in(child)


def numbers_of(file: Path) -> set[float]:
    return set(numbers_in(ast.parse(file.read_text(encoding="utf-8"))))


@pytest.mark.parametrize("heading", list(capabilities()))
def test_every_capability_has_a_witness(heading: str) -> None:
    bare = [name for name, held in witnesses()[heading].items() if not held]
    assert [name for name in bare if name not in NOT_CHECKED] == []
    assert [name for name in NOT_CHECKED if name in witnesses()[heading] and name not in bare] == []


def test_every_claim_is_of_something_and_says_what_by_what_and_how_closely() -> None:
    known = [name for names in capabilities().values() for name in names]
    for claim in claims():
        for pattern in claim.capabilities:
            assert fnmatch.filter(known, pattern), (claim.place, pattern)
        assert claim.by
        assert claim.compared
        assert claim.within


@pytest.mark.parametrize("claim", claims(), ids=lambda claim: claim.place)
def test_the_claimed_number_stands_in_the_test(claim: Claim) -> None:
    if isinstance(claim.within, float):
        tree = ast.parse(inspect.getsource(inspect.getmodule(claim.test)))  # type: ignore[arg-type]
        assert claim.within in set(numbers_in(tree))


def test_the_document_is_what_is_generated() -> None:
    """`python -m tests.outside.trust > assets/docs/TRUST.md` makes it."""
    assert DOCUMENT.read_text(encoding="utf-8") == as_markdown()


HELD = {
    "1e-10": "tests/bearingcore/statics/test_static_reference.py",
    "1e-6": "tests/bearingcore/statics/test_published_tables.py",
    "5e-5": "tests/bearingcore/bearings/test_hertz.py",
    "7e-5": "tests/bearingcore/statics/test_life.py",
}
"""Digits that documents claim in words, and the tests that hold them."""


@pytest.mark.parametrize(
    "document", ["README.md", *(f"assets/docs/{name}.md" for name in ("MODEL", "LIFE", "SWEEPS"))]
)
def test_no_document_states_a_digit_that_no_test_holds(document: str) -> None:
    text = (ROOT / document).read_text(encoding="utf-8")
    for digits in re.findall(r"(?:\bto|within|and) (\d(?:\.\d+)?e-\d+)", text):
        assert digits in HELD, (document, digits)
        assert float(digits) in numbers_of(ROOT / HELD[digits]), digits


def test_rows_of_trust_in_the_readme_name_tests_that_exist() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    table = text.partition("## How far to trust it")[2].partition("\n\n| truth")[0]
    rows = [line for line in table.splitlines() if line.startswith("| ")][2:]
    assert len(rows) >= 8
    for row in rows:
        places = re.findall(r"`(tests/[\w/.]+)`", row)
        assert places, row
        for place in places:
            assert (ROOT / place).exists(), place
