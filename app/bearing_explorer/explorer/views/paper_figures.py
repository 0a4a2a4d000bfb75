"""Figures 3 to 10 of the paper: their scenes, printed values, and the tabs that draw them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearing_explorer.explorer.results import statics
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.address import Place, write
from bearing_explorer.explorer.state.references import Reference, usual_name
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.levels import decibels
from bearingcore import STIFFNESS_TERMS, Maps, Scene, presets, stiffness_maps
from bearingcore.common import cached_property, number, prefixed_span, span
from bearingcore.model.statics import TERM_UNITS, crossings

Array = NDArray[np.float64]
_SLIPS = "## Errors in the paper"


class Printed(NamedTuple):
    """A number or statement of the paper, and the function that computes our value from scenes."""

    name: str
    paper: str
    ours: Callable[[Sequence[Scene]], str]


@dataclass(frozen=True)
class PaperFigure:
    """A figure of the paper: its scenes by preset and extents (0: no defect), and its numbers.

    `tab` names the tab of the page that draws the figure live.
    """

    number: int
    title: str
    preset: str
    extents_deg: tuple[float, ...]
    printed: tuple[Printed, ...]
    tab: str

    @property
    def scenes(self) -> list[Scene]:
        """A scene for each extent."""
        return [self.scene(extent) for extent in self.extents_deg]

    def scene(self, extent_deg: float) -> Scene:
        """The preset with a defect of this extent, or without one for 0."""
        scene = presets[self.preset]
        return scene.replace(extent=math.radians(extent_deg)) if extent_deg else scene.healthy()

    @cached_property
    def rows(self) -> list[tuple[str, str, str]]:
        """Name, printed and computed value of each number; all sessions share them."""
        return [(entry.name, entry.paper, entry.ours(self.scenes)) for entry in self.printed]

    @property
    def slip(self) -> str:
        """The sentence of MODEL.md on a mistake of the paper in this figure; else empty."""
        section = asset_text("docs/MODEL.md").partition(_SLIPS)[2].partition("\n## ")[0]
        head = f"* Figure {self.number}: "
        lines = [line for line in section.splitlines() if line.startswith(head)]
        return lines[0].removeprefix(head) if lines else ""

    @property
    def link(self) -> str:
        """Address that shows the last scene on the tab, compared with the others with a defect."""
        others = [scene for scene in self.scenes[:-1] if scene.defects]
        drawn = tuple(Reference(scene, usual_name(scene)) for scene in others)
        return write(Place(self.scenes[-1], self.preset, tab=self.tab, compared=drawn))


# Curves


def _loads(scene: Scene) -> Array:
    return Results(scene).load_curves[0][1]


def _term(term: str, first: float, last: float, scene: Scene) -> Array:
    return statics.curves(scene, math.radians(first), math.radians(last), 361).term(term)


def _acceleration(column: int, scene: Scene) -> Array:
    """Acceleration of the housing between 0.745 and 0.775 s, the printed stretch."""
    motion = Results(scene).motion
    return motion.outer_acceleration[slice(*np.searchsorted(motion.time, (0.745, 0.775))), column]


def _levels(dof: str, scene: Scene) -> Array:
    frequency, density = Results(scene).late_spectra[dof]
    return np.asarray(decibels(density[(frequency >= 300.0) & (frequency <= 2100.0)]))


# Numbers


def _ends(values: Array, unit: str) -> str:
    """Range from the least to the greatest value, in words."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    return prefixed_span(low, high, unit)


def _range_of(curve: Callable[[Scene], Array], unit: str, scenes: Sequence[Scene]) -> str:
    """Range over the curves of all scenes, in words."""
    return _ends(np.concatenate([curve(scene) for scene in scenes]), unit)


def _range_of_terms(terms: Sequence[str], scenes: Sequence[Scene]) -> str:
    curves = [_term(term, 15.0, 45.0, scene) for term in terms for scene in scenes]
    return _ends(np.concatenate(curves), TERM_UNITS[terms[0]])


def _mean(term: str, scenes: Sequence[Scene]) -> str:
    means = [float(_term(term, 0.0, 30.0, scene)[:-1].mean()) for scene in scenes]
    return " → ".join(style.with_prefix(mean, TERM_UNITS[term]) for mean in means)


def _mean_mode(label: str, scenes: Sequence[Scene]) -> str:
    results = [Results(scene).modes for scene in scenes]
    means = [modes.frequency[:, list(modes.label).index(label)][:-1].mean() for modes in results]
    return " → ".join(f"{mean:.0f} Hz" for mean in means)


def _band(label: str, scenes: Sequence[Scene]) -> str:
    return " → ".join(span(*Results(scene).bands[label], "Hz") for scene in scenes)


def _counts(scenes: Sequence[Scene]) -> str:
    """Least and greatest number of balls in the defect of each scene."""
    words = []
    for scene in scenes:
        if not scene.defects:
            continue
        defect, spacing = scene.defects[0], scene.bearing.ball_spacing
        cage = np.linspace(0.0, spacing, 361)[:, np.newaxis]
        angle = cage + spacing * np.arange(scene.bearing.n_balls)
        off = (angle - defect.center + math.pi) % (2.0 * math.pi) - math.pi
        count = (np.abs(off) < 0.5 * defect.extent).sum(axis=1)
        words.append(f"{count.min()} or {count.max()}")
    return ", ".join(words)


@cache
def _maps_near_64() -> Maps:
    scene = presets["liew-lim"]
    cage = np.arange(240) * scene.bearing.ball_spacing / 240
    return stiffness_maps(scene, np.radians(np.arange(60.0, 67.0, 0.25)), cage)


def _least(quantity: str, _: Sequence[Scene]) -> str:
    """Extent at which the mean of a stiffness term, or of the number of loaded balls, is least."""
    maps = _maps_near_64()
    values = maps.term(quantity) if quantity in STIFFNESS_TERMS else maps.loaded_balls
    return f"{math.degrees(maps.extents[int(np.argmin(values.mean(axis=1)))]):.2f}°"


def _spacing(scenes: Sequence[Scene]) -> str:
    return f"{math.degrees(scenes[0].bearing.ball_spacing):.4g}°"


def _entry_to_exit(scenes: Sequence[Scene]) -> str:
    between = [
        math.fmod(s.defects[0].extent, s.bearing.ball_spacing) / s.cage_speed for s in scenes
    ]
    return ", ".join(f"{1e3 * time:.2f} ms" for time in between)


def _next_to_leave(scenes: Sequence[Scene]) -> str:
    """Number of the first ball that leaves after ball 9 has entered."""
    words = []
    for scene in scenes:
        events = crossings(scene, 0.0, 4.0 * math.pi)
        entry = next(i for i, event in enumerate(events) if event.enters and event.ball == 8)
        words.append(next(str(event.ball + 1) for event in events[entry:] if not event.enters))
    return ", ".join(words)


def _text(attribute: Callable[[Scene], float], unit: str) -> Callable[[Sequence[Scene]], str]:
    """Make the function that writes a number of the first scene with its unit."""
    return lambda scenes: style.with_prefix(attribute(scenes[0]), unit)


# The figures

_EXTENTS = (12.9, 38.6)

FIGURES = (
    PaperFigure(
        3, "Load distribution", "liew-lim", (0.0, 5.0, 40.0, 70.0),
        (
            Printed("Balls in the defect at 5°, 40° and 70°", "0 or 1, 1 or 2, 2 or 3", _counts),
            Printed("Loads; the printed axis", "0 to 1.6 kN", partial(_range_of, _loads, "N")),
        ),
        "load",
    ),
    PaperFigure(
        4, "Varying stiffness", "liew-lim", (0.0, 5.0, 40.0, 70.0),
        (
            Printed("Stiffness repeats after", "30°", _spacing),
            Printed("Mean k_xx, healthy to 70°", "increases", partial(_mean, "k_xx")),
            Printed("Mean k_yy, healthy to 70°", "decreases up to 64°", partial(_mean, "k_yy")),
            Printed("Mean k_zz, healthy to 70°", "decreases", partial(_mean, "k_zz")),
            Printed("k_xx, k_yy, k_zz; the printed axis", "100 to 260 MN/m",
                    partial(_range_of_terms, ("k_xx", "k_yy", "k_zz"))),
            Printed("k_xy, k_xz, k_yz; the printed axis", "−30 to 30 MN/m",
                    partial(_range_of_terms, ("k_xy", "k_xz", "k_yz"))),
            Printed("k_θxθx, k_θyθy; the printed axis", "10 to 50 kN·m/rad",
                    partial(_range_of_terms, ("k_rxrx", "k_ryry"))),
        ),
        "stiffness",
    ),
    PaperFigure(
        5, "Stiffness over the extent", "liew-lim", (64.0,),
        (Printed("Mean k_yy is least at an extent of", "about 64°", partial(_least, "k_yy")),),
        "maps",
    ),
    PaperFigure(
        6, "Number of loaded balls", "liew-lim", (64.0,),
        (Printed("Fewest balls carry load at an extent of", "about 64°",
                 partial(_least, "balls")),),
        "maps",
    ),
    PaperFigure(
        7, "Model of the fan rig", "fan-rig", (12.9,),
        (
            Printed("Mass of rotor and inner ring", "2 kg", _text(lambda s: s.support.inner_mass,
                                                                "kg")),
            Printed("Mass of housing and outer ring", "2 kg", _text(lambda s: s.support.outer_mass,
                                                                  "kg")),
            Printed("Stiffness of the support", "212.2 MN/m", _text(lambda s: s.support.stiffness_y,
                                                                  "N/m")),
            Printed("Damping of the support", "1648.2 N·s/m",
                    lambda s: f"{number(s[0].support.damping_y, 5)} N·s/m"),
            Printed("Load, downwards", "100 N", _text(lambda s: -s.load.fy, "N")),
            Printed("Load-deflection factor", "5453 MN/m^1.5",
                    lambda s: f"{s[0].bearing.load_deflection_factor / 1e6:.4g} MN/m^1.5"),
        ),
        "model",
    ),
    PaperFigure(
        8, "Stiffness and natural frequencies", "fan-rig", (0.0, *_EXTENTS),
        (
            Printed("Ball spacing", "25.7°", _spacing),
            Printed("Mean ω_x1: healthy, 12.9°, 38.6°", "higher for 38.6°",
                    partial(_mean_mode, "x1")),
            Printed("Mean ω_x2", "higher for 38.6°", partial(_mean_mode, "x2")),
            Printed("Mean ω_y1", "lower for 38.6°", partial(_mean_mode, "y1")),
            Printed("Mean ω_y2", "lower for 38.6°", partial(_mean_mode, "y2")),
        ),
        "modes",
    ),
    PaperFigure(
        9, "Simulated vibration", "fan-rig", _EXTENTS,
        (
            Printed("From entry to exit", "0.013 s for both", _entry_to_exit),
            Printed("Ball that leaves after ball 9 has entered", "9, 10", _next_to_leave),
            Printed("Horizontal acceleration; the printed axis", "−2 to 2 m/s²",
                    partial(_range_of, partial(_acceleration, 0), "m/s²")),
            Printed("Vertical acceleration; the printed axis", "−4 to 4 m/s²",
                    partial(_range_of, partial(_acceleration, 1), "m/s²")),
        ),
        "vibration",
    ),
    PaperFigure(
        10, "Spectra", "fan-rig", _EXTENTS,
        (
            Printed("Level along x; the printed axis", "−80 to −30 dB",
                    partial(_range_of, partial(_levels, "x"), "dB")),
            Printed("Level along y; the printed axis", "−55 to −20 dB",
                    partial(_range_of, partial(_levels, "y"), "dB")),
            Printed("Band of ω_x1", "higher for 38.6°", partial(_band, "x1")),
            Printed("Band of ω_y1", "lower for 38.6°", partial(_band, "y1")),
        ),
        "vibration",
    ),
)  # fmt: skip
"""The figures, in the order of the paper."""
