"""A cursor in a spectrum, with its harmonics and sidebands, in the browser alone.

A click puts it on the highest line nearby; a click on it takes it away. Its reading is the
frequency, the order and the amplitude.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from bokeh.events import Tap
from bokeh.models import ColumnDataSource, CustomJS, Div, RadioButtonGroup, Row
from bokeh.plotting import figure

from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource

SIDEBANDS = ("Harmonics", "and ± shaft", "and ± cage")
"""Lines that go with the cursor, to choose from."""
HINT = "Click on a line for its harmonics, sidebands, order and amplitude."
COLOR = "#0072B2"
_TURNING = ("shaft", "cage", "hertz")


class FrequencyCursor:
    """The cursor of figures that show the same spectrum in several scales.

    Parameters
    ----------
    prefix
        of the source, one per session.
    plots
        figures by the column of `curve` that they draw over its "frequency".
    """

    def __init__(
        self,
        packed: PackedSource,
        prefix: str,
        plots: Mapping[str, figure],
        curve: ColumnDataSource,
    ) -> None:
        self._name = f"{prefix}_turning"
        turning = packed.source(self._name, *_TURNING)
        lines = ColumnDataSource({"at": [], "main": [], "dash": [], "alpha": []}, syncable=False)
        words = f"{style.HTML_FONT};color:{style.css_color(style.FAINT_INK)};padding:6px 4px"
        reading = Div(text=HINT, styles={"font": "12.5px/1.45 system-ui"}, syncable=False)
        reading.styles = dict(part.split(":", 1) for part in words.split(";"))
        buttons = RadioButtonGroup(
            labels=list(SIDEBANDS), active=0, syncable=False, stylesheets=[style.BUTTONS]
        )
        args = {
            "turning": turning,
            "curve": curve,
            "lines": lines,
            "reading": reading,
            "buttons": buttons,
            "hint": HINT,
            "plots": list(plots.values()),
            "columns": list(plots),
        }
        code = style.JS_PREFIX + asset_text("frequency_cursor.js")
        move = CustomJS(args=args, code=code)
        for plot in plots.values():
            plot.vspan(
                "at", source=lines, line_color=COLOR, line_dash="dash", line_alpha="alpha",
                line_width=1.3,
            )  # fmt: skip
            plot.js_on_event(Tap, move)
        buttons.js_on_change("active", move)
        turning.js_on_change("data", move)
        self.controls = Row(
            children=[buttons, reading],
            stylesheets=[style.WRAPPED],
            sizing_mode="stretch_width",
            margin=(2, 5, 6, 5),
        )

    def columns(self, shaft: float, cage: float, per: float) -> dict[str, dict[str, np.ndarray]]:
        """The source: turns a second of shaft and cage, and the hertz that a 1 on the axis is."""
        values = (shaft / per, cage / per, per)
        return {self._name: {n: np.array([v]) for n, v in zip(_TURNING, values, strict=True)}}
