"""How the page is put together."""

from __future__ import annotations

import logging

import panel as pn

from app.assets import asset_text
from app.explorer import Explorer, Section
from app.views.stiffness import Stiffness

SECTIONS = (Section("stiffness", "Stiffness", (Stiffness,)),)

log = logging.getLogger(__name__)


def page() -> pn.Template:
    """The page of a new session."""
    explorer = Explorer(SECTIONS)
    template = pn.Template(asset_text("page.html"))
    template.add_variable("style", asset_text("page.css"))
    template.add_variable("logo", asset_text("logo.svg"))
    template.add_panel("tabs", explorer.tabs)
    template.add_panel("controls", explorer.controls)
    template.add_panel("main", explorer.main)
    template.add_panel("status", explorer.status)
    template.add_panel("wire", pn.pane.Bokeh(explorer.wire.anchor, margin=0))
    pn.state.onload(explorer.start)
    pn.state.on_session_destroyed(lambda _: explorer.stop())
    if (doc := pn.state.curdoc) is not None:
        doc.title = "Bearing explorer"
    return template
