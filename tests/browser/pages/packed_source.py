"""A page that draws 40 packets as fast as it can, each from a worker thread."""

import asyncio

import numpy as np
import panel as pn
from bearing_explorer.results.executors import in_thread
from bearing_explorer.serve.live import on_loop, one_message, send_at_once
from bearing_explorer.serve.packed_source import PackedSource
from bearing_explorer.views.base import View
from bokeh.plotting import figure

from bearingcore import presets


class Height(float):
    """Results with nothing but a number."""

    scene = presets["fan-rig"]
    reference_caption = ""


class Line(View):
    name = "line"
    title = "A line"
    about = "Whatever the last packet said."
    needs = frozenset()

    def build(self, packed):
        plot = figure(
            width=400, height=200, y_range=packed.range("y", 0, 1), x_range=(0, 10), name="plot"
        )
        plot.line("x", "y", source=packed.source("line", "x", "y"), name="drawn")
        return plot

    def data(self, results):
        y = np.array([results, np.nan, results + 0.5, 4])[: 3 + int(results) % 2]
        return {"line": {"x": np.arange(y.size), "y": y}}, {"y": (-results, 2 * results)}

    def sentence(self, results):
        return f"The line is at {results:.0f}."

    def table(self, results):
        return {"height_m": np.array([results, 2.5])}


packed = PackedSource()
view = Line(packed)
doc = pn.state.curdoc
nodelay = pn.pane.Str("0", css_classes=["nodelay"])


async def draw(value):
    data, ranges = await in_thread(view.data, Height(value))

    def change():
        packed.send(data, ranges, mark=value)
        view.say(Height(value), view.sentence(Height(value)))

    await one_message(doc, change)


async def work(last):
    for value in range(1, last + 1):
        await draw(value)


tasks = []


def ready():
    nodelay.object = str(send_at_once(doc))
    tasks.append(asyncio.get_running_loop().create_task(work(40)))


pn.state.onload(lambda: on_loop(doc, ready))
pn.Column(view.panel, nodelay, pn.pane.Bokeh(packed.anchor)).servable()
