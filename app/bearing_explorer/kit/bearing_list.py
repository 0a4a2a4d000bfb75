"""Bearings to choose from: presets, the published ones, designations."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from itertools import islice
from typing import Any

from bearing_explorer.kit.sentences import words_of
from bearingcore import (
    CatalogueBearing,
    Designation,
    catalogue,
    preset_notes,
    read_designation,
)
from bearingcore.bearings import designations, is_known, series_words
from bearingcore.common import number
from bearingcore.model.scene import preset_labels

MOST_ENTRIES = 60
"""Largest number of entries that a search lists."""
MOST_NUMBERS = 12
"""Largest number of listed designations that begin with the typed text."""
LONGEST_SEARCH = 60


def find_bearing(name: str) -> CatalogueBearing:
    """Return the published bearing of a name, or that of a designation; ValueError without one."""
    return catalogue().get(name) or read_designation(name).entry


def search_bearings(text: str) -> dict[str, Any]:
    """Search bearings for the browser; an empty text matches all but designations.

    Entries are {choose, label, words, mark}: the message that chooses the bearing, its name, its
    dimensions, and "estimated" or nothing. Without entries, `words` say why.
    """
    text = " ".join(text[:LONGEST_SEARCH].split())
    entries = list(islice(_matches(text), MOST_ENTRIES))
    words = "" if entries else _no_match(text)
    return {"text": text, "entries": entries, "words": words}


def _matches(text: str) -> Iterator[dict[str, Any]]:
    """Yield the entries that match a text, the best first."""
    by_number = _designation(text)
    wanted = text.lower() if by_number is None else by_number.basic.lower()
    ranked = _ranked(wanted)
    best = [entry for rank, entry in ranked if rank == 0]
    # Enter takes the first entry: the bearing of exactly this name, or else the designation, which
    # may be the first word of longer names; entries that only share its number come last
    named = [entry for entry in best if _rank(text.lower(), entry["label"], "") == 0]
    named.sort(key=lambda option: option["label"].lower() != text.lower())
    exact = sum(option["label"].lower() == text.lower() for option in named)
    yield from named[:exact]
    if by_number is not None:
        yield _estimated_entry(by_number)
    yield from named[exact:]
    yield from (entry for entry in best if entry not in named)
    if by_number is None and len(text) > 1:
        for basic in islice(designations(text), MOST_NUMBERS):
            yield _estimated_entry(read_designation(basic))
    yield from (entry for rank, entry in ranked if rank == 1)


def _ranked(wanted: str) -> list[tuple[int, dict[str, Any]]]:
    """Rank presets and bearings of the catalogue; 0 is the best."""
    ranked: list[tuple[int, dict[str, Any]]] = []
    for name, label in preset_labels.items():
        rank = _rank(wanted, label, preset_notes[name])
        ranked.append((rank, _entry({"preset": name}, label, "", "")))
    for bearing in catalogue().values():
        words = entry_words(bearing)
        rank = _rank(wanted, bearing.name, f"{words} {bearing.note}")
        ranked.append((rank, _entry({"bearing": bearing.name}, bearing.name, words, "")))
    return ranked


def _no_match(text: str) -> str:
    """Say why nothing matches; for an unknown suffix, say what may be written."""
    if is_known(text):
        try:
            read_designation(text)
        except ValueError as error:
            words = words_of(error)
            return f"{words[0].upper()}{words[1:]}."
    return f"No match. Known by number are the series {series_words()}."


def _designation(text: str) -> Designation | None:
    """Read a text as a designation; None if it is none."""
    try:
        return read_designation(text)
    except ValueError:
        return None


def _rank(wanted: str, name: str, note: str) -> int:
    """Return 0 if all words begin words of the name, 1 if some are in the note, else 2.

    Words also match together in a name without its spaces: "nu208" in "NU 208". Notes are searched
    for long words only.
    """
    words, low = wanted.split(), f" {name} ".lower()
    if "".join(words) in "".join(low.split()) and len(wanted) > 3:
        return 0
    begun = [re.search(rf"(?<!\w){re.escape(word)}", low) is not None for word in words]
    if all(begun):
        return 0
    noted = note.lower()
    inside = (
        len(word) > 2 and word in noted for word, hit in zip(words, begun, strict=True) if not hit
    )
    return 1 if all(inside) else 2


def _entry(choose: dict[str, str], label: str, words: str, mark: str) -> dict[str, Any]:
    return {"choose": choose, "label": label, "words": words, "mark": mark}


def _estimated_entry(designation: Designation) -> dict[str, Any]:
    return _entry(
        {"bearing": designation.name}, designation.name, entry_words(designation.entry), "estimated"
    )


def entry_words(entry: CatalogueBearing) -> str:
    """Describe a bearing in a line: balls, diameters, angle or clearance, rating."""
    bearing = entry.bearing
    rough = bearing.estimated and bearing.kind.estimate_spread is not None
    diameter = number(1e3 * bearing.ball_diameter, 3 if rough else 5)
    words = (
        f"{'two rows of ' if bearing.rows else ''}{bearing.n_balls} {bearing.kind.elements} of "
        f"{diameter} mm on {number(1e3 * bearing.pitch_diameter, 5)} mm"
    )
    if bearing.contact_angle:
        words += f", {number(math.degrees(bearing.contact_angle))}°"
    if bearing.radial_clearance:
        words += f", clearance {number(2e6 * bearing.radial_clearance)} µm"
    if entry.dynamic_load_rating is not None:
        words += f", dynamic rating {number(entry.dynamic_load_rating / 1e3, 4)} kN"
    return words


def origin_words(entry: CatalogueBearing) -> str:
    """Name the sources of the numbers of a bearing, and the assumptions."""
    assumed = f" Assumed here: {', '.join(entry.assumed)}." if entry.assumed else ""
    return f"{entry.note}{assumed}".strip()
