"""Zooming of all figures: with Ctrl and the wheel, two fingers, or a box; a button resets it.

One finger still scrolls the page, and so does the wheel alone. Ranges from the server move the axes
of a figure only while it is not zoomed. A reset always goes to the newest ranges from the server
(see `serve.packed_source`).
"""

from __future__ import annotations

from bokeh.events import RangesUpdate
from bokeh.models import BoxZoomTool, CustomJS, PanTool, Plot, ResetTool, WheelZoomTool

from bearing_explorer.kit.assets import asset_text

_FINGERS = """
if (matchMedia("(pointer: coarse)").matches) box.active = false
"""
MOVES = "moves"
"""Tag of a further range that zooms and follows the server as the figure's own ranges do."""
_STAY = "if (cb_obj.start != start || cb_obj.end != end) cb_obj.setv({start, end})"


def make_zoomable(plot: Plot) -> None:
    """Give a figure tools to zoom. Extra ranges, which place words, zoom only if tagged `MOVES`.

    With `active_drag` None, as in a drawing with handles, no drag zooms or pans the figure.
    """
    wheel = WheelZoomTool(modifiers="ctrl")
    plot.add_tools(wheel, ResetTool())
    if plot.toolbar.active_drag is not None:
        box = BoxZoomTool()
        plot.add_tools(box, PanTool())
        if plot.toolbar.active_drag == "auto":
            plot.toolbar.active_drag = box
        plot.js_on_change("inner_width", CustomJS(args={"box": box}, code=_FINGERS))
    plot.toolbar.active_scroll = wheel
    plot.js_on_event("doubletap", CustomJS(args={"plot": plot}, code="plot.reset.emit()"))
    home = CustomJS(args={"plot": plot}, code=asset_text("zoom.js"))
    plot.js_on_event(RangesUpdate, home)
    plot.js_on_change("inner_width", home)
    for shown in (plot.x_range, plot.y_range):
        if shown.reset_start is None:  # otherwise a reset would fail before the first numbers
            shown.update(reset_start=shown.start, reset_end=shown.end)
    for fixed in (*plot.extra_x_ranges.values(), *plot.extra_y_ranges.values()):
        if MOVES in fixed.tags:
            continue
        stay = CustomJS(args={"start": fixed.start, "end": fixed.end}, code=_STAY)
        fixed.js_on_change("start", stay)
        fixed.js_on_change("end", stay)
