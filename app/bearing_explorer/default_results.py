"""``python -m bearing_explorer.default_results``: store results of the default scene."""

from __future__ import annotations

import sys
from pathlib import Path

from bearing_explorer.explorer.results.default_results import NAME, write
from bearing_explorer.kit.compute import cache
from bearing_explorer.kit.pictures import Picture, picture_of
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.page import SECTIONS, Halves

TABS = ("overview", "load", "stiffness", "modes", "vibration")
"""Tabs that are drawn before kernels are compiled."""


def draw_all() -> list[Picture]:
    """Draw the default scene on `TABS`, while a slider moves and at rest."""
    moving = Halves().session.content
    pictures = []
    for section in SECTIONS:
        if section.name in TABS:
            views = [view(PackedSource()) for view in section.views]
            for rested in (False, True):
                content = moving.at_rest(rested)
                pictures.append(picture_of(content, views, warnings=True))
    return pictures


def main() -> int:
    """Write the file into the assets of this checkout."""
    path = Path(__file__).resolve().parents[2] / "assets" / NAME
    cache.clear()
    draw_all()
    write(path)
    print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
