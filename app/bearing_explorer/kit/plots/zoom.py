"""Every figure zooms and pans: with Ctrl and the wheel, two fingers, a box, and back at two clicks.

One finger goes on scrolling the page, and so does the wheel alone. Ranges from the server move the
axes of a figure only while it is not zoomed; back is always where they would be then (see
`serve.packed_source`).
"""

from __future__ import annotations

from bokeh.models import BoxZoomTool, CustomJS, PanTool, Plot, ResetTool, WheelZoomTool

_FINGERS = """
if (matchMedia("(pointer: coarse)").matches) box.active = false
"""
_STAY = "if (cb_obj.start != start || cb_obj.end != end) cb_obj.setv({start, end})"


def zoomable(plot: Plot, equal_aspect: bool = False) -> None:
    """Give a figure the tools to zoom and pan. Its ranges for places of words stay as they are.

    With `equal_aspect` a box that is drawn keeps circles round.
    """
    box = BoxZoomTool(match_aspect=equal_aspect)
    wheel = WheelZoomTool(modifiers="ctrl")
    plot.add_tools(wheel, box, PanTool(), ResetTool())
    if plot.toolbar.active_drag == "auto":
        plot.toolbar.active_drag = box
    plot.toolbar.active_scroll = wheel
    plot.js_on_event("doubletap", CustomJS(args={"plot": plot}, code="plot.reset.emit()"))
    plot.js_on_change("inner_width", CustomJS(args={"box": box}, code=_FINGERS))
    for shown in (plot.x_range, plot.y_range):
        if shown.reset_start is None:  # or nothing would lead back before the first numbers
            shown.update(reset_start=shown.start, reset_end=shown.end)
    for words in (*plot.extra_x_ranges.values(), *plot.extra_y_ranges.values()):
        stay = CustomJS(args={"start": words.start, "end": words.end}, code=_STAY)
        words.js_on_change("start", stay)
        words.js_on_change("end", stay)
