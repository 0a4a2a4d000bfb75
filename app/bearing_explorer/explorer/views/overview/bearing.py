"""A small drawing of the bearing with the loads of its balls."""

from __future__ import annotations

from bokeh.models import LinearColorMapper, Range1d
from bokeh.plotting import figure

from bearing_explorer.explorer.results import reasons
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.bearing import BearingDrawing
from bearing_explorer.kit.plots import style


class OverviewBearing(BearingDrawing):
    """The drawing of the bearing, without its scale of colours."""

    name = "overview-bearing"
    prefix = "overview_bearing"
    title = "Ball loads"
    compact = True
    leads_to = "load"

    def sentence(self, results: Results) -> str:
        drop = results.drop["outer"] + results.drop["inner"]
        why = reasons.most_loaded(results.scene, results.now, 0, drop, briefly=True)
        return why or super().sentence(results)

    def _figure(self, x: Range1d, y: Range1d) -> figure:
        plot = style.bare_figure(x, y, height=150, min_width=240)
        plot.min_border_top = 8  # for the words about the load
        return plot

    def _add_scale(self, plot: figure, colors: LinearColorMapper, load: Range1d) -> None:
        """Add no scale: the bars show the loads, and a scale would take a tenth of the height."""
