"""Everything that the program gives a number for, read from the program itself."""

from __future__ import annotations

import dataclasses
import importlib
import inspect
import json
import pkgutil
from collections.abc import Iterator
from pathlib import Path

import bearing_explorer.explorer.views.paper_figures as paper

import bearingcore
from bearingcore import recordings
from bearingcore.bearings import BALL_MATERIALS, KINDS
from bearingcore.measured import signals
from bearingcore.measured.signals import Indicators
from bearingcore.model.scene import CONTACT_LAWS, DOF_NAMES, EDGES, RACES, MeasuredFloor, RoughFloor
from bearingcore.model.scene._scene import BALLS
from bearingcore.model.sweeps import OUTPUTS

ROOT = Path(__file__).parents[2]

ASPECTS = (
    *("statics", "stiffness", "natural frequencies", "ball-pass frequencies", "motion"),
    *("life", "pressure", "film", "limits"),
)
"""What a kind of bearing is computed for."""

NOT_A_NUMBER = {"warm"}
"""Functions of the front that give no number: kernels compiled ahead."""

LISTED_BY_RESULT = {
    *("sweep", "measure", "alternatives"),
    *("order_map", "spectrogram", "severity_zone"),
}
"""Functions whose numbers have rows of their own: outputs of sweeps, charts, signals."""

PARTS = {
    *("check_directions", "hann", "split", "downsample", "coefficients"),
    *("least_passes", "lines_that_count", "third_octave_edges", "smooth_lag", "oversample"),
    "resample_over_turns",
    *("follow_lags", "load_zone_weights", "local_median", "line_levels", "squared_envelopes"),
    *("whiten", "density_difference", "resample_over_turns"),
}
"""Functions of `signals` whose results are shown nowhere by themselves: they serve others there and
the diagnosis, which are listed."""


def functions_of_signals() -> Iterator[str]:
    """Public functions of both packages of signals, each where it is defined."""
    packages = (signals, recordings)
    modules = [(one, module) for one in packages for module in pkgutil.iter_modules(one.__path__)]
    for package, module in modules:
        found = importlib.import_module(f"{package.__name__}.{module.name}")
        for name, what in vars(found).items():
            own = inspect.isfunction(what) and what.__module__ == found.__name__
            if own and not name.startswith("_") and name not in PARTS:
                yield name


def charts() -> list[str]:
    """Experiments and orbits in the charts of speed against accuracy that are shipped."""
    shipped = [json.loads(file.read_text()) for file in (ROOT / "assets/accuracy").glob("*.json")]
    names = {name for chart in shipped for name in chart["experiments"]}
    names |= {name for chart in shipped for name in ("orbits", "stability") if chart[name]}
    return sorted(names)


def capabilities() -> dict[str, list[str]]:
    """Capabilities by the heading that they stand under."""
    words = ("directions", "velocity_reason")
    fields = [one.name for one in dataclasses.fields(Indicators) if one.name not in words]
    front = [
        name
        for name in bearingcore.__all__
        if name.islower() and callable(getattr(bearingcore, name)) and name not in NOT_A_NUMBER
        if name not in LISTED_BY_RESULT
    ]
    choices = {
        "edge": EDGES,
        "race": RACES,
        "floor": ("flat", RoughFloor.kind, MeasuredFloor.kind),
        "law": CONTACT_LAWS,
        "balls": BALLS,
        "material": BALL_MATERIALS,
        "direction": DOF_NAMES,
        "defects": ("several",),
        "load": [*(field.name for field in dataclasses.fields(bearingcore.Load)), "unbalance"],
    }
    printed = [(one.number, row.name) for one in paper.FIGURES for row in one.printed]
    return {
        "Kinds of bearing": [f"{kind} bearing: {aspect}" for kind in KINDS for aspect in ASPECTS],
        "Functions": [f"function: {name}" for name in front],
        "Model choices": [f"{kind}: {one}" for kind, names in choices.items() for one in names],
        "Outputs of sweeps": [f"output: {name}" for name in OUTPUTS],
        "Signals": [
            *(
                f"indicator: {name}"
                for name in fields
                if name not in ("directions", "velocity_reason")
            ),
            *(f"signal: {name}" for name in functions_of_signals()),
        ],
        "Charts of accuracy": [f"chart: {name}" for name in charts()],
        "Numbers beside the paper's": [f"figure {number}: {name}" for number, name in printed],
    }
