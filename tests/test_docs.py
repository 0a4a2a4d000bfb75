"""The documents beside the code: they speak of what there is."""

import inspect
import re
from pathlib import Path

import pytest

import bearingcore
from tests.benchmarks import charts
from tests.fields import as_markdown

ROOT = Path(__file__).parents[1]
DOCS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "assets/docs").glob("*.md"))]


@pytest.mark.parametrize("name", sorted(bearingcore.__all__))
def test_the_api_reference_holds_every_public_name_as_it_is(name: str) -> None:
    """With the arguments it has today: who changes one builds the reference anew."""
    text = (ROOT / "assets/docs/API.md").read_text(encoding="utf-8")
    _, heading, rest = text.partition(f"### `bearingcore.{name}`\n")
    assert heading, "see CONTRIBUTING.md for the command that builds it"
    own = rest.partition("\n### `")[0]
    thing = getattr(bearingcore, name)
    if inspect.isfunction(thing):
        wanted = list(inspect.signature(thing).parameters)
        assert all(re.search(rf"\b{one}\b", own) for one in wanted), wanted


@pytest.mark.parametrize("path", DOCS, ids=lambda path: path.name)
def test_links_between_documents_lead_somewhere(path: Path) -> None:
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", path.read_text(encoding="utf-8")):
        if ":" not in target:
            assert (path.parent / target).exists(), target


def test_the_table_of_fields_is_that_of_the_registry() -> None:
    """CONTRIBUTING.md has the command that writes it."""
    text = (ROOT / "assets/docs/FIELDS.md").read_text(encoding="utf-8")
    assert text.rstrip("\n") == as_markdown()


def test_the_citation_is_of_this_version() -> None:
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {bearingcore.__version__}\n" in text


def test_the_tables_of_accuracy_are_those_of_the_files() -> None:
    """The same files that the page draws: ``python -m tests.benchmarks.charts`` writes both."""
    text = charts.DOCUMENT.read_text(encoding="utf-8")
    assert charts.document(text) == text
    assert "CVODE Adams" in text


def test_paths_in_the_page_for_contributors_exist() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    known = {"tests/bearingcore/bearings/test_tapered.py", "bearingcore/bearings/_tapered.py"}
    paths = set(re.findall(r"`((?:bearingcore|tests|assets)/[\w/.]+)`", text)) - known
    paths |= {
        f"app/bearing_explorer/{path}"
        for path in re.findall(r"`((?:state|views|plots|results|serve)/[\w/.]+)`", text)
    }
    assert len(paths) > 10
    for path in paths:
        assert (ROOT / path).exists(), path
