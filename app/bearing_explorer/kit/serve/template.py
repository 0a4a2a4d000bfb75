"""The frame of the page as a Panel template, made cheaply: a class of thirty comes all at once."""

from __future__ import annotations

from typing import Any

import panel as pn
from bokeh.document import Document
from panel.io.resources import LOCAL_DIST


class PageTemplate(pn.Template):
    """Panel's template with its models counted once a page instead of once a part.

    Each root that is added makes Bokeh walk all models of the document, and each part that is
    named makes Panel write out the whole template as text.
    """

    def server_doc(self, doc: Document | None = None, *arguments: Any, **named: Any) -> Document:
        """The document of a session."""
        if doc is None:
            return super().server_doc(doc, *arguments, **named)
        # Panel sets this when it writes the page, which may be in another process than the session
        # of its websocket: style sheets would come from Panel's public site then, or not at all.
        doc.template_variables["dist_url"] = LOCAL_DIST
        with doc.models.freeze():
            return super().server_doc(doc, *arguments, **named)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(getattr(self, '_render_items', ()))})"
