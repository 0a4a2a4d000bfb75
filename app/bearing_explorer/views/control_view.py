"""Views with controls of their own."""

from __future__ import annotations

from typing import Any

from bearing_explorer.views.base import SessionParts, View
from bearing_explorer.widgets.controls import Rows


class ControlView(View):
    """A view with a panel of controls in it; `build` makes `rows` and gives it `forward`."""

    in_report = False
    rows: Rows

    def attach(self, parts: SessionParts) -> None:
        """Send changes to the session, and follow its scene."""
        super().attach(parts)
        self.rows.state = parts.editor.state()
        parts.add_controls(self.rows)

    def forward(self, message: Any) -> None:
        """Hand on a message of the browser."""
        if self.parts is not None:
            self.parts.ask(message)
