"""Figures in exported notebooks need nothing from outside: their style sheets come along.

HoloViews has Panel name its style sheets by an address of the web, also where the scripts are told
to stand in the notebook.
"""

from __future__ import annotations

import sys
from typing import Any

from bokeh.models import UIElement

from bearing_explorer.server.bokeh_private import before_showing

try:
    from panel.io.notebook import patch_inline_stylesheets
except ImportError:  # a version of Panel that does without
    patch_inline_stylesheets = None


def bring_style_sheets() -> None:
    """Have figures carry their style sheets in a notebook; elsewhere a server serves them."""
    shell = sys.modules.get("IPython")  # it is there in every notebook
    in_notebook = shell is not None and shell.get_ipython() is not None
    if in_notebook and patch_inline_stylesheets is not None:
        before_showing(_inlined)


def _inlined(_: Any, root: Any) -> None:
    for part in root.select({"type": UIElement}):
        patch_inline_stylesheets(part)
