"""The steady orbit of the scene: its existence, its stability and its path."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource, Range1d, Scatter
from bokeh.plotting import figure
from numpy.typing import NDArray

from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views.comparing_view import ComparingView
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Glyph, curve, draw, filled
from bearing_explorer.kit.plots.levels import SHOWN
from bearing_explorer.kit.plots.ranges import ROOM, StickyRange
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import Ranges, Sources
from bearing_explorer.kit.widgets.form import stack
from bearingcore.common import table_of
from bearingcore.model.dynamics import OrbitStatus
from bearingcore.model.scene import MASSLESS

HEIGHT = 280
ORBIT_POINTS = 600
MARCHED_POINTS = 3000
MARCHED_PASSES = 8
"""Ball passes that are drawn of the motion integrated in time."""

_DOTS = {"size": 10, "fill_alpha": 0.85, "line_color": "white", "line_width": 1.0}
MULTIPLIERS = [
    Glyph(Scatter, name, ("x", "y"), {"fill_color": color, **_DOTS})
    for name, color in (("orbit_inside", style.DEFECTIVE), ("orbit_outside", "#D55E00"))
]
PATHS = [
    curve("orbit_marched", "x", "y", style.HEALTHY, 3.0),
    *compared_curves.curves("orbit_path", *SHOWN),
    curve("orbit_path", "x", "y", style.DEFECTIVE, 1.4),
]
"""Layers of the figures, from the lowest to the highest."""

_LOST_LONG = {
    "-1": (
        "The motion that repeats with each ball pass is unstable (period doubling): the machine "
        "settles to one that repeats after two passes or more, with lines at half the ball-pass "
        "frequency"
    ),
    "pair": (
        "The motion that repeats with each ball pass is unstable (Neimark–Sacker): a second "
        "frequency appears, and every line of the spectrum gets sidebands"
    ),
    "+1": (
        "The motion that repeats with each ball pass is unstable (fold): the machine jumps to "
        "another orbit, which depends on the state it comes from"
    ),
}


class SteadyOrbit(ComparingView):
    """Multipliers of the periodic steady state, and path of the inner ring."""

    name = "orbit"
    title = "Steady orbit"
    about = (
        "The motion that repeats with every ball pass. It is found by Newton's method, "
        "not by a long simulation. Its Floquet multipliers: factors by which a pass changes a "
        "small disturbance; inside the unit circle it dies out. Then the path of the inner "
        "ring. Grey: the motion integrated in time from rest."
    )
    needs = frozenset({"orbit", "motion"})

    def build(self, packed: PackedSource) -> Any:
        self._displacement = [StickyRange(-1.0, 1.0, least_span=0.02, room=ROOM) for _ in SHOWN]
        self._multiplier_range = StickyRange(-1.2, 1.2, anchor="symmetric", least_span=2.4)
        # a row that wraps: Panel's own asks for the width of all its parts together
        return stack(
            self._multipliers(packed),
            self._path(packed),
            stylesheets=[":host { flex-flow: row wrap; gap: 8px 16px; }"],
        )

    def _multipliers(self, packed: PackedSource) -> figure:
        plot = _square(
            style.AxisQuantity("Multipliers, real part", "", ""),
            style.AxisQuantity("Imaginary part", "", ""),
            packed.range("orbit_multipliers", -1.2, 1.2),
            packed.range("orbit_multipliers_up", -1.2, 1.2),
        )
        turn = np.linspace(0.0, 2.0 * math.pi, 121)
        circle = ColumnDataSource({"x": np.cos(turn), "y": np.sin(turn)})
        filled("", "#E6F3EE", line_color="#00704F", line_width=1.5).add(plot, circle)
        draw(plot, packed, MULTIPLIERS)
        return plot

    def _path(self, packed: PackedSource) -> figure:
        plot = _square(
            style.AxisQuantity("Inner ring along x", "", "µm"),
            style.AxisQuantity("Along y", "", "µm"),
            packed.range("orbit_x", -1.0, 1.0),
            packed.range("orbit_y", -1.0, 1.0),
        )
        draw(plot, packed, PATHS)
        return plot

    def data(self, results: Results) -> tuple[Sources, Ranges]:
        orbit = results.orbit
        multipliers = orbit.multipliers if orbit is not None else np.zeros(0, complex)
        reach = np.abs(np.concatenate([multipliers.real, multipliers.imag, [1.2]])).max()
        round_about = self._multiplier_range.fit(-1.05 * reach, 1.05 * reach)
        outside = np.abs(multipliers) >= 1.0
        path, marched = orbit_path(results), marched_path(results)
        paths = compared_curves.sources(
            "orbit_path",
            SHOWN,
            results.compared_results,
            orbit_path,
        )
        x_range, y_range = (
            fit.fit(path[dof], np.append(marched[dof], compared_curves.numbers(paths, dof)))
            for fit, dof in zip(self._displacement, SHOWN, strict=True)
        )
        return {
            **paths,
            "orbit_inside": _points(multipliers[~outside]),
            "orbit_outside": _points(multipliers[outside]),
            "orbit_path": path,
            "orbit_marched": marched,
        }, {
            "orbit_multipliers": round_about,
            "orbit_multipliers_up": round_about,
            "orbit_x": x_range,
            "orbit_y": y_range,
        }

    def sentence(self, results: Results) -> str:
        words = self._orbit_words(results)
        if results.scene.balls == MASSLESS:
            return words
        return f"{words} Orbits are computed with massless balls; grey includes their mass."

    def _orbit_words(self, results: Results) -> str:
        orbit = results.orbit
        if orbit is None:
            return (
                f"With {_turning_part(results)} the motion repeats only after "
                f"{results.ball_passes} ball passes, too many to search. Grey: the motion "
                "integrated in time."
            )
        if orbit.status is OrbitStatus.NO_PERIOD and not results.scene.bearing.has_one_cage_speed:
            return (
                "The cages of the rows turn at different speeds and have no common period: no "
                "motion repeats itself. Grey: the motion integrated in time."
            )
        if orbit.status is OrbitStatus.NO_PERIOD:
            return (
                f"With {_turning_part(results)} no motion repeats itself: shaft and cage have no "
                "common period. Grey: the motion integrated in time."
            )
        if orbit.status is OrbitStatus.NO_START:
            return (
                f"There is no static state to start from, so no orbit was searched: {orbit.cost}."
            )
        if orbit.status is OrbitStatus.TOO_MANY_STEPS:
            return f"The search would take too long: {orbit.cost}."
        if orbit.status is OrbitStatus.NOT_CONVERGED and results.moving:
            return (
                "A short search found no motion that repeats with every ball pass; it continues "
                "when the slider rests. Grey: the motion integrated in time."
            )
        if orbit.status is OrbitStatus.NOT_CONVERGED:
            return (
                "Newton's method found no motion that repeats with every ball pass. Grey: the "
                "motion integrated in time."
            )
        size = style.number(orbit.largest_multiplier, 3)
        if orbit.status is OrbitStatus.UNSTABLE:
            return f"{_LOST_LONG[orbit.through]}; disturbances grow {size} times per pass."
        percent = style.number(100.0 * orbit.largest_multiplier, 3)
        return f"Periodic with each ball pass; disturbances shrink to {percent} % per pass."

    def table(self, results: Results) -> dict[str, np.ndarray]:
        table = {} if results.orbit is None else results.orbit.table().named()
        for name, path in (("", orbit_path(results)), ("marched_", marched_path(results))):
            columns = [(f"{name}inner_{dof}", "µm", path[dof]) for dof in SHOWN]
            table |= table_of(*columns).named()
        return table


def orbit_path(results: Results) -> dict[str, NDArray[np.float64]]:
    """Path of the inner ring [µm] over the period, closed; empty where there is none."""
    orbit = results.orbit
    if orbit is None or not orbit.multipliers.size:
        return {dof: np.zeros(0) for dof in SHOWN}
    time = np.linspace(0.0, orbit.period, ORBIT_POINTS)
    return _along(orbit.dofs, orbit.inner_displacement(time))


def marched_path(results: Results) -> dict[str, NDArray[np.float64]]:
    """The last ball passes of the marched motion [µm]."""
    motion, scene = results.motion, results.scene
    passing = scene.bearing.bpfo(scene.shaft_speed)
    wanted = MARCHED_PASSES / passing if passing > 0.0 else math.inf
    count = int(min(0.5 * motion.time.size, wanted * motion.sample_rate))
    path = motion.inner_displacement[-max(count, 2) :]
    return _along(motion.dofs, path[:: max(1, len(path) // MARCHED_POINTS)])


def _along(dofs: tuple[str, ...], path: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Columns [µm] of the directions shown; one that cannot move stays at zero."""
    return {
        dof: 1e6 * path[:, dofs.index(dof)] if dof in dofs else np.zeros(len(path)) for dof in SHOWN
    }


def _points(numbers: NDArray[np.complex128]) -> dict[str, np.ndarray]:
    return {"x": numbers.real, "y": numbers.imag}


def _square(
    x: style.AxisQuantity, y: style.AxisQuantity, x_range: Range1d, y_range: Range1d
) -> figure:
    sizes: dict[str, Any] = {"height": HEIGHT + 40, "width": HEIGHT + 70, "min_width": HEIGHT + 70}
    plot = style.make_figure(x, y, x_range, y_range, sizing_mode="fixed", **sizes)
    plot.min_border_right = 8
    return plot


def _turning_part(results: Results) -> str:
    """The cause why a motion repeats later than with every ball pass, or never."""
    if results.over_shaft:
        return "a defect on the inner race, which turns with the shaft,"
    if results.scene.unbalance > 0.0:
        return "an unbalance, which turns with the shaft,"
    return "rows of unlike balls"
