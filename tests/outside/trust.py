"""The list of witnesses: `python -m tests.outside.trust > assets/docs/TRUST.md`."""

from __future__ import annotations

import fnmatch
import importlib

from tests.outside.capabilities import ROOT, capabilities
from tests.outside.witness import CLAIMS, Claim

HEAD = """# What it is checked against

A witness is something outside this program with which a capability was compared: a published \
table or example, another program, a measured record, or a computation from first principles \
that shares no code and no constant with this program. The first table lists the witnesses, the \
compared quantities, the accuracy that a test demands, and the test that repeats the comparison. \
The tables after it list every capability with its witnesses. `python -m tests.outside.trust` \
prints this page from the tests and from the capabilities of the program. A capability without a \
witness fails a test, unless it is listed as not checked.
"""

NOT_CHECKED: dict[str, str] = {}
"""Capabilities without a witness, and where the program says so."""


def claims() -> list[Claim]:
    """All claims of tests, by importing those that make some."""
    for file in sorted((ROOT / "tests").rglob("test_*.py")):
        if "import witness" in file.read_text(encoding="utf-8"):
            importlib.import_module(".".join(file.relative_to(ROOT).with_suffix("").parts))
    return sorted(CLAIMS, key=lambda one: one.place)


def witnesses() -> dict[str, dict[str, list[Claim]]]:
    """Claims by capability, by heading."""
    known = claims()
    return {
        heading: {
            name: [
                one
                for one in known
                if any(fnmatch.fnmatchcase(name, pattern) for pattern in one.capabilities)
            ]
            for name in names
        }
        for heading, names in capabilities().items()
    }


def closeness(within: float | str) -> str:
    """In words for a cell."""
    return within if isinstance(within, str) else f"{within:.2g}"


def as_markdown() -> str:
    """The document."""
    held_by = witnesses()
    number: dict[str, int] = {}
    lines = [HEAD, "## Witnesses", ""]
    lines += ["| | witness | compared | within | test |", "| ---: | --- | --- | --- | --- |"]
    for one in (one for rows in held_by.values() for held in rows.values() for one in held):
        if one.place not in number:
            number[one.place] = len(number) + 1
            cells = (number[one.place], one.by, one.compared, closeness(one.within), one.place)
            lines.append("| " + " | ".join(map(str, cells)) + " |")
    for heading, rows in held_by.items():
        lines += ["", f"## {heading}", "", "| capability | witnesses |", "| --- | --- |"]
        for name, held in rows.items():
            numbers = ", ".join(str(number[one.place]) for one in held)
            lines.append(f"| {name} | {numbers or 'not checked: ' + NOT_CHECKED[name]} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(as_markdown(), end="")
