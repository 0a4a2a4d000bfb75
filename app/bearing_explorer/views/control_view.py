"""Views with controls of their own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bearing_explorer.views.base import View
from bearing_explorer.widgets.controls import Rows


class ControlView(View):
    """A view with a panel of controls in it; `build` makes `rows` and gives it `forward`."""

    rows: Rows
    _asked: Callable[[Any], None] | None = None

    def listen(self, asked: Callable[[Any], None], state: dict[str, Any]) -> None:
        """From now on `asked` hears what is asked for; the controls stand as in `state`."""
        self._asked = asked
        self.rows.state = state

    def forward(self, message: Any) -> None:
        """Hand on a message of the browser."""
        if self._asked is not None:
            self._asked(message)
