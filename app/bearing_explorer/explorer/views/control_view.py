"""Views that contain controls."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from bearing_explorer.explorer.state.field_values import SHOWN_FIELDS
from bearing_explorer.explorer.widgets.controls import Rows
from bearing_explorer.kit.views.base import SessionParts, View


def table_of_fields(groups: Sequence[str], values: Mapping[str, float]) -> dict[str, np.ndarray]:
    """Fields of some groups as columns: label, value of its key, unit."""
    rows = [field for field in SHOWN_FIELDS if field.group in groups]
    numbers = [values[field.key] for field in rows]
    return {
        "quantity": np.array([field.label for field in rows]),
        "value": np.array(["" if math.isnan(v) else f"{v:.9g}" for v in numbers]),
        "unit": np.array([field.shown_unit for field in rows]),
    }


class ControlView(View):
    """A view with a panel of controls, `rows`; `build` makes it with the callback `forward`."""

    rows: Rows

    def attach(self, parts: SessionParts) -> None:
        """Show the scene of the session and join its panels of controls."""
        super().attach(parts)
        self.rows.state = self.parts.editor.state()
        self.parts.panels.append(self.rows)

    def forward(self, message: Any) -> None:
        """Pass a message of the browser to the session."""
        if self.parts is not None:
            self.parts.change_scene(message)
