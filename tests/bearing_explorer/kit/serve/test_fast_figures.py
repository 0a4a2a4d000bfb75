"""The private names of BokehJS that `assets/scripts/fast_figures.js` uses."""

import re
from importlib.metadata import version
from pathlib import Path

import bokeh
from bearing_explorer.kit.assets import asset_text
from bokeh import models

SCRIPT = Path(bokeh.__file__).parent / "server" / "static" / "js" / "bokeh.min.js"


def test_this_version_of_bokehjs_has_them() -> None:
    """Which of them is gone, and of which version, is what this says when it fails."""
    named = set(re.findall(r'(?:method|getter)\(\w+, "(\w+)"\)', asset_text("fast_figures.js")))
    assert len(named) > 10, "the script is written differently now"
    library = SCRIPT.read_text(encoding="utf-8")
    gone = {name for name in named if not re.search(rf"\b{name}\(", library)}
    assert not gone, f"gone from BokehJS {version('bokeh')}: {sorted(gone)}"


def test_the_models_are_there_whose_views_are_changed() -> None:
    named = set(re.findall(r'(?:view_of|get)\("(\w+)"\)', asset_text("fast_figures.js")))
    assert {"GlyphRenderer", "Column"} <= named
    assert all(hasattr(models, name) for name in named)
