"""The list of bearings by designation: the published ones, and those of a person's own table.

A table of one's own stays in the session. It is not trusted: it is refused as a whole,
with sentences, where it is not such a table.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from bearing_explorer.state.sentences import words_of
from bearingcore import CatalogueBearing, catalogue, read_catalogue
from bearingcore.bearings.catalogue import MOST_BYTES
from bearingcore.common.numbers import number


@dataclass
class BearingTable:
    """The bearings of the list; `version` rises with each change, `words` say what became of it."""

    own: dict[str, CatalogueBearing] = field(default_factory=dict)
    version: int = 0
    words: str = ""
    bad: bool = False

    def all(self) -> list[tuple[CatalogueBearing, bool]]:
        """Every bearing and whether it is a person's own; these first, in place of published ones
        of the same name.
        """
        published = [one for name, one in catalogue().items() if name not in self.own]
        return [(one, True) for one in self.own.values()] + [(one, False) for one in published]

    def find(self, name: str) -> CatalogueBearing:
        """The bearing of a name; ValueError where there is none."""
        found = self.own.get(name) or catalogue().get(name)
        if found is None:
            raise ValueError(f"bearing is {name[:60]!r}; allowed: one of the list")
        return found

    def take(self, file: str, found: dict[str, CatalogueBearing] | str) -> None:
        """Add what `read_table` made of a file."""
        self.version += 1
        shown = " ".join(file.split())[:40] or "The file"
        if isinstance(found, str):
            self.words, self.bad = f"{shown}: {found}", True
            return
        self.own |= found
        count = len(found)
        self.words = f"{shown}: {count} {'bearing' if count == 1 else 'bearings'} added"
        self.bad = False


def read_table(text: str) -> dict[str, CatalogueBearing] | str:
    """The bearings of a table, or sentences that say what is wrong. For any thread."""
    if len(text) > MOST_BYTES:
        return f"it is longer than {MOST_BYTES // 1000} kB."
    try:
        return read_catalogue(text)
    except ValueError as error:
        return f"{words_of(error)}."


def entry_words(one: CatalogueBearing) -> str:
    """A bearing of the list in a line: balls, diameters, angle or clearance, rating."""
    bearing = one.bearing
    words = (
        f"{bearing.n_balls} balls of {number(1e3 * bearing.ball_diameter, 5)} mm on "
        f"{number(1e3 * bearing.pitch_diameter, 5)} mm"
    )
    if bearing.contact_angle:
        words += f", {number(math.degrees(bearing.contact_angle))}°"
    if bearing.radial_clearance:
        words += f", clearance {number(2e6 * bearing.radial_clearance)} µm"
    if one.dynamic_load_rating is not None:
        words += f", dynamic rating {number(one.dynamic_load_rating / 1e3, 4)} kN"
    return words


def origin_words(one: CatalogueBearing, own: bool) -> str:
    """Sources of the numbers of a bearing, and assumptions."""
    source = one.note or ("From a table of your own." if own else "")
    assumed = f" Assumed: {', '.join(one.assumed)}." if one.assumed else ""
    return f"{source}{assumed}".strip()
