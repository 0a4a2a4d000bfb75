"""Figures in exported notebooks and saved files need nothing from outside: styles come along.

HoloViews has Panel name its style sheets by an address of the web, also where the scripts are told
to stand in the notebook or in the file.
"""

from __future__ import annotations

from typing import Any

import panel as pn
from bokeh.models import UIElement

from bearing_explorer.serve.bokeh_private import before_showing

try:
    from panel.io.notebook import patch_inline_stylesheets
except ImportError:  # a version of Panel that does without
    patch_inline_stylesheets = None


def bring_style_sheets() -> None:
    """Have figures carry their style sheets, but for those of a page: a server serves them."""
    if patch_inline_stylesheets is not None:
        before_showing(_inlined)


def _inlined(_: Any, root: Any) -> None:
    doc = pn.state.curdoc
    if doc is not None and doc.session_context is not None:
        return
    for part in root.select({"type": UIElement}):
        patch_inline_stylesheets(part)
