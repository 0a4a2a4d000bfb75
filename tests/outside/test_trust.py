"""No capability without a witness, and no digit in a document that no test holds."""

from __future__ import annotations

import ast
import fnmatch
import inspect
import math
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
    """In the test itself, or in what its module gives a name that stands in it."""
    tree = ast.parse(inspect.getsource(inspect.getmodule(claim.test)))  # type: ignore[arg-type]
    own = next(one for one in tree.body if getattr(one, "name", "") == claim.test.__name__)
    named = {one.id for one in ast.walk(own) if isinstance(one, ast.Name)}
    held = set(numbers_in(own))
    for one in tree.body:
        if isinstance(one, ast.Assign | ast.FunctionDef):
            names = {getattr(one, "name", ""), *map(ast.unparse, getattr(one, "targets", ()))}
            held |= set(numbers_in(one)) if names & named else set()
    words = re.findall(r"(\d[\d.]*)( %|)", claim.within) if isinstance(claim.within, str) else ()
    claimed = [0.01 * float(number) if percent else float(number) for number, percent in words]
    for number in claimed or [claim.within] * isinstance(claim.within, float):
        assert any(math.isclose(number, one, rel_tol=1e-9) for one in held), number


def test_the_document_is_what_is_generated() -> None:
    """`python -m tests.outside.trust > assets/docs/TRUST.md` makes it."""
    assert DOCUMENT.read_text(encoding="utf-8") == as_markdown()


HELD = {
    "README": {
        "1e-10": "tests/bearingcore/model/statics/test_static_reference.py",
        "5e-5": "tests/bearingcore/bearings/test_hertz.py",
        "7e-5": "tests/bearingcore/model/statics/test_life.py",
        "1.8 %": "tests/bearingcore/bearings/test_designation.py",
        "3.5 %": "tests/bearingcore/bearings/test_designation.py",
    },
    "MODEL": {
        "1e-10": "tests/bearingcore/model/statics/test_static_reference.py",
        "1e-8": "tests/outside/test_charts.py",
        "1e-6": "tests/outside/test_statics.py",
        "1 %": "tests/bearingcore/bearings/test_designation.py",
        "4 %": "tests/bearingcore/bearings/test_designation.py",
        "0.6 %": "tests/bearingcore/bearings/test_designation.py",
        "3.5 %": "tests/bearingcore/bearings/test_designation.py",
        "5 %": "tests/outside/test_jones.py",
        "12 %": "tests/outside/test_jones.py",
        "7 %": "tests/outside/test_tapered_pairs.py",
    },
    "LIFE": {
        "7e-5": "tests/bearingcore/model/statics/test_life.py",
        "0.5 %": "tests/bearingcore/bearings/test_catalogue.py",
        "0.2 %": "tests/outside/test_ratings.py",
        "0.1 %": "tests/outside/test_roller_life.py",
        "0.4 %": "tests/outside/test_pairs.py",
        "1.2 %": "tests/outside/test_designations.py",
    },
    "ACCURACY": {
        "0.1 dB": "tests/outside/test_sampling.py",
        "1 %": "tests/outside/test_turning_defects.py",
        "2 %": "tests/bearingcore/model/statics/test_friswell.py",
        "5 %": "tests/bearingcore/model/experiments/test_alternatives.py",
    },
    "DIAGNOSIS": {
        "0.2 %": "tests/outside/test_mains_hum.py",
        "1 %": "tests/outside/test_mains_hum.py",
    },
    "SWEEPS": {},
    "OPERATING": {},
    "TEACHING": {},
}
"""Closeness that documents claim in words, and the tests that hold it."""

CLAIMED = re.compile(
    r"\b(?:within|met to|agree to|err by|wrong by|off by(?: up to)?|are up to|changes at most|and) "
    r"(\d[\d.]*(?: %| dB|e-\d+))"
)


def claimed(document: str) -> set[str]:
    """What a document claims in prose; its generated tables are held by other tests."""
    text = (ROOT / document).read_text(encoding="utf-8")
    return set(
        CLAIMED.findall(re.sub(r"(?s)<!-- tables.*?begin -->.*?<!-- tables.*?end -->", "", text))
    )


@pytest.mark.parametrize("name", HELD)
def test_no_document_states_a_digit_that_no_test_holds(name: str) -> None:
    stated = claimed("README.md" if name == "README" else f"assets/docs/{name}.md")
    assert stated == set(HELD[name])
    for digits, test in HELD[name].items():
        value = float(digits.split()[0]) * (0.01 if "%" in digits else 1.0)
        held = numbers_of(ROOT / test)
        assert any(math.isclose(value, one, rel_tol=1e-9) for one in held), digits


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
