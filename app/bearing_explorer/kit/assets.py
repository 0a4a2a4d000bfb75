"""Asset files of the page: styles, scripts, the logo."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]
_PLACES = (_PACKAGE / "_assets", _PACKAGE.parents[1] / "assets")  # installed; in a checkout
_FOLDERS = {".js": "scripts", ".css": "styles"}


def asset_path(name: str) -> Path:
    """Path of the asset called `name`, a file or a folder."""
    for place in _PLACES:
        path = place / _FOLDERS.get(Path(name).suffix, "") / name
        if path.exists():
            return path
    raise FileNotFoundError(f"asset {name!r} is in none of {[str(place) for place in _PLACES]}")


@cache
def asset_text(name: str) -> str:
    """The text of the asset called `name`."""
    return asset_path(name).read_text(encoding="utf-8")


def scripts(*names: str) -> str:
    """Join assets into one script of a component: its own comes after those that it calls.

    Comments are left out, because each page loads the script of each component. An HTML file
    becomes a constant that the script fills: ``caption.html`` is ``CAPTION``.
    """
    text = "".join(
        f"const {Path(name).stem.upper()} = {json.dumps(asset_text(name))}\n"
        if name.endswith(".html")
        else asset_text(name)
        for name in names
    )
    return re.sub(r"^ *//.*\n", "", text, flags=re.MULTILINE)
