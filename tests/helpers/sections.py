"""Two tabs with a view each, which notes what it is asked to draw."""

import numpy as np
from bearing_explorer.kit.half import Section
from bearing_explorer.kit.views.base import View


class Depth(View):
    name = "depth"
    title = "Depth"
    needs = frozenset({"equilibrium"})

    def build(self, packed):
        from bokeh.models import Spacer

        self.drawn: list[float] = []
        self.source = packed.source(f"{self.name}", "depth")
        return Spacer()

    def data(self, results):
        depth = results.scene.defect.depth
        if depth > 300e-6:
            raise ValueError("depth is more than this view can show")
        if depth < 10e-6:
            raise RuntimeError("a bug")
        self.drawn.append(depth)
        return {self.name: {"depth": np.array([depth])}}, {}

    def sentence(self, results):
        return f"{results.scene.defect.depth:g}"

    def table(self, results):
        return {"depth_m": np.array([results.scene.defect.depth])}


class Other(Depth):
    name = "other"


SECTIONS = (Section("one", "One", (Depth,)), Section("two", "Two", (Other,)))
