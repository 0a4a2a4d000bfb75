"""The shape of CHANGELOG.md: Keep a Changelog, short enough to be read."""

import re
from pathlib import Path

import bearingcore

TEXT = (Path(__file__).parents[1] / "CHANGELOG.md").read_text(encoding="utf-8")
RELEASES = re.split(r"^## ", TEXT, flags=re.MULTILINE)[1:]
HEADINGS = ["Fixed: numbers", "Added", "Changed", "Fixed", "Removed", "Where modules moved"]


def test_the_newest_release_is_the_version_of_the_program() -> None:
    assert RELEASES[0].startswith(f"[{bearingcore.__version__}]")


def test_each_release_has_the_headings_in_their_order() -> None:
    for release in RELEASES:
        assert re.match(r"\[\d+\.\d+\.\d+\]( - (unreleased|\d{4}-\d\d-\d\d))?\n", release)
        headings = re.findall(r"^### (.*)$", release, re.MULTILINE)
        assert headings == [heading for heading in HEADINGS if heading in headings]


def test_a_release_has_at_most_120_entries_of_at_most_30_words() -> None:
    for release in RELEASES:
        entries = re.findall(r"^- (.*(?:\n  .*)*)$", release, re.MULTILINE)
        assert 0 < len(entries) <= 120
        assert [entry for entry in entries if len(entry.split()) > 30] == []
        assert re.findall(r"^\* ", release, re.MULTILINE) == []
