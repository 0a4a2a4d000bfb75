"""Draw the README's charts of speed against accuracy: ``python -m tests.benchmarks.charts``.

Runs every experiment of `bearingcore.experiments` on the paper's scenes, prints all points as
tables and writes SVG figures to assets/figures/. Error is up, cost is to the right, both
logarithmic, once as time and once as evaluations. A method that failed stands as a cross on the
upper edge, with its name; the grey band is where the two families of the reference differ.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bearingcore import presets
from bearingcore.experiments import (
    Experiment,
    Point,
    StabilityChart,
    angles_experiment,
    models_experiment,
    motion_experiment,
    stability_chart,
    statics_experiment,
)
from bearingcore.experiments.stability import VERDICTS
from tests.benchmarks.machine import pace

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FIGURES = Path(__file__).parents[2] / "assets" / "figures"
# Okabe and Ito's colours, which colour-blind people tell apart
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999")
MARKERS = ("o", "s", "^", "D", "v", "P", "*")
VERDICT_COLOURS = dict(zip(VERDICTS, ("#0072B2", "#56B4E9", "#E69F00", "#D55E00"), strict=True))


def _style(number: int) -> dict[str, str]:
    """Colour and marker; after all colours the markers change, so that no two are alike."""
    return {
        "color": COLOURS[number % len(COLOURS)],
        "marker": MARKERS[(number + number // len(COLOURS)) % len(MARKERS)],
    }


def _points(axes: Axes, experiment: Experiment, error: str, cost: str) -> None:
    """One chart of work against precision."""

    def place(point: Point) -> tuple[float, float]:
        value = getattr(point, cost)
        return (1e3 * value if cost == "seconds" else value), point.errors.get(error, math.nan)

    shown = [place(point) for point in experiment.points if not point.failed]
    finite = [e for _, e in shown if 0.0 < e < math.inf]
    top = 10.0 * max(finite)
    for number, method in enumerate(experiment.methods):
        style = _style(number)
        points = experiment.of(method)
        good = [place(p) for p in points if not p.failed and place(p)[1] < math.inf]
        if good:
            axes.plot(*np.array(good).T, lw=1, ms=4, label=method, **style)
        beyond = [p for p in points if p.failed or place(p)[1] == math.inf]
        for point in beyond:
            spent = place(point)[0]
            if spent > 0.0 and math.isfinite(spent):
                axes.plot(spent, top, "x", color=style["color"], ms=7, clip_on=False)
        if beyond and not good:
            axes.plot([], [], "x", color=style["color"], label=f"{method}: {_why(beyond)}")
    floor = max(r.agreement.get(error, 0.0) for r in experiment.references.values())
    if floor > 0.1 * min(finite):
        axes.axhspan(0.0, floor, color="0.9", zorder=0)
    axes.set(xscale="log", yscale="log", ylim=(None, top))
    low, high = axes.get_xlim()
    if high < 100.0 * low:  # or the labels of its ticks overlap
        axes.set_xlim(math.sqrt(low * high) / 10.0, math.sqrt(low * high) * 10.0)
    unit = "time [ms]" if cost == "seconds" else experiment.evaluations
    axes.set_xlabel(f"cost: {unit}")
    axes.grid(alpha=0.3, lw=0.5)


def _why(beyond: list[Point]) -> str:
    """What a cross on the upper edge means: a failure, or an answer without any vibration."""
    return "failed" if any(point.failed for point in beyond) else "does not vibrate"


def draw_experiment(experiment: Experiment, name: str, title: str, errors: Iterable[str]) -> None:
    """Errors down, the two costs across."""
    from matplotlib.figure import Figure

    names = list(errors)
    figure = Figure(figsize=(11.0, 3.4 * len(names)), layout="constrained")
    grid = figure.subplots(len(names), 2, squeeze=False, sharey="row")
    for row, error in zip(grid, names, strict=True):
        for axes, cost in zip(row, ("seconds", "evaluations"), strict=True):
            _points(axes, experiment, error, cost)
        row[0].set_ylabel(_short(error))
    figure.suptitle(title)
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right center", frameon=False, fontsize=8)
    _save(figure, name)


def _short(error: str) -> str:
    return {
        "spectrum": "error of the spectrum [dB]",
        "level": "error of the level [dB]",
        "acceleration": "error of acceleration, over its r.m.s.",
        "displacement": "error of displacement, over its swing",
        "stiffness": "error of stiffness, over the term",
        "load": "error of ball loads, over the greatest",
        "trace": "error of the curves, over their swing",
        "mean": "error of the mean stiffness",
    }[error]


def draw_stability(charts: dict[str, StabilityChart]) -> None:
    """Methods down, steps across, the linear limit drawn over what was found."""
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    figure = Figure(figsize=(11.0, 3.2), layout="constrained")
    row = figure.subplots(1, len(charts), squeeze=False)[0]
    for axes, (scene, chart) in zip(row, charts.items(), strict=True):
        methods = list(dict.fromkeys(trial.method for trial in chart.trials))
        for verdict in VERDICTS:
            found = [t for t in chart.trials if t.verdict == verdict]
            axes.scatter(
                [t.step_rate / chart.highest_frequency for t in found],
                [methods.index(t.method) for t in found],
                c=VERDICT_COLOURS[verdict], marker="s", s=70, label=verdict,
            )  # fmt: skip
        for place, method in enumerate(methods):
            limit = chart.linear_limit[method] / chart.highest_frequency
            if limit > 0.0:
                axes.plot([limit, limit], [place - 0.4, place + 0.4], "k-", lw=2)
        axes.set(xscale="log", title=scene, yticks=range(len(methods)), yticklabels=methods)
        axes.set_xlabel(f"steps in a period of {chart.highest_frequency:.0f} Hz")
    handles, labels = row[0].get_legend_handles_labels()
    handles.append(Line2D([], [], color="k", lw=2))
    figure.legend(
        handles, [*labels, "linear limit"], loc="outside right center", frameon=False, fontsize=8
    )
    _save(figure, "stability")


def _save(figure, name: str) -> None:  # type: ignore[no-untyped-def]
    FIGURES.mkdir(parents=True, exist_ok=True)
    # no date and no random names inside, so that equal charts are equal files
    figure.savefig(FIGURES / f"{name}.svg", metadata={"Date": None})
    print(f"wrote {FIGURES / name}.svg", flush=True)


def main() -> None:
    """Measure, print and draw."""
    import matplotlib

    matplotlib.rcParams.update(
        {"svg.hashsalt": "bearing", "svg.fonttype": "none", "font.family": "sans-serif"}
    )
    parser = argparse.ArgumentParser(description="Charts of speed against accuracy.")
    parser.add_argument("--duration", type=float, default=1.4, help="seconds of motion")
    duration = parser.parse_args().duration
    fan_rig, liew_lim = presets["fan-rig"], presets["liew-lim"]
    for name, scene in (("fan-rig", fan_rig), ("liew-lim", liew_lim)):
        statics = statics_experiment(scene)
        angles = angles_experiment(scene)
        motion = motion_experiment(scene, duration=duration)
        models = models_experiment(scene, duration=duration)
        for experiment, errors in (
            (statics, ("stiffness", "load")),
            (angles, ("trace", "mean")),
            (motion, ("spectrum", "acceleration", "displacement")),
            (models, ("spectrum", "level")),
        ):
            print(f"{experiment.title}\n{experiment.table().csv()}\n{pace()}\n", flush=True)
            title = f"{name}: {experiment.title}"
            draw_experiment(experiment, f"{name}-{experiment.name}", title, errors)
    charts = {name: stability_chart(presets[name]) for name in ("fan-rig", "liew-lim")}
    for name, chart in charts.items():
        print(f"{name}\n{chart.table().csv()}", flush=True)
    draw_stability(charts)


if __name__ == "__main__":
    main()
