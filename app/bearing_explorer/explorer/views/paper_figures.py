"""Figures 3 to 10 of the paper as declarations: scenes, panels, curves, printed values."""

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
from bearing_explorer.explorer.state.compared import Compared, usual_name
from bearing_explorer.explorer.views.depth_profile import DEPTH
from bearing_explorer.explorer.views.modes import FREQUENCY, lines
from bearing_explorer.explorer.views.passage_view import TIME
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.levels import SHOWN, decibels, density_axis
from bearingcore import STIFFNESS_TERMS, Maps, Scene, presets, stiffness_maps
from bearingcore.common.numbers import number, prefixed_span, span
from bearingcore.statics.equilibrium import TERM_SYMBOLS, TERM_UNITS
from bearingcore.statics.passes import crossings

Array = NDArray[np.float64]
_SLIPS = "## Errors in the paper"


class Line(NamedTuple):
    """A curve of a panel, NaN where it has gaps; `width` in pixels."""

    x: Array
    y: Array
    width: float = 2.0


@dataclass(frozen=True)
class Panel:
    """A part of a figure.

    Parameters
    ----------
    title
        as in the paper.
    x, y
        its axes.
    shown
        first and last number of both, in units of the axes.
    curves
        the lines of a scene.
    extents_deg
        the scenes that it shows; None for all of the figure.
    shaded
        stretches of the horizontal axis that belong to a scene.
    grid
        quantity and values over `x` and `y`, drawn as a map instead of curves.
    """

    title: str
    x: style.AxisQuantity
    y: style.AxisQuantity
    shown: tuple[float, float, float, float]
    curves: Callable[[Scene], list[Line]] = lambda _: []
    extents_deg: tuple[float, ...] | None = None
    shaded: Callable[[Scene], list[tuple[float, float]]] = lambda _: []
    grid: tuple[style.AxisQuantity, Callable[[Scene], Array]] | None = None


class Printed(NamedTuple):
    """A number or statement of the paper, and the function of the scenes that gives ours."""

    name: str
    paper: str
    ours: Callable[[Sequence[Scene]], str]


@dataclass(frozen=True)
class PaperFigure:
    """A figure of the paper: its scenes by preset and extents (0: no defect), panels and numbers.

    `tab` is the one that shows the same live.
    """

    number: int
    title: str
    preset: str
    extents_deg: tuple[float, ...]
    columns: int
    panels: tuple[Panel, ...]
    printed: tuple[Printed, ...]
    tab: str

    @property
    def scenes(self) -> list[Scene]:
        """A scene for each extent."""
        return [self.scene(extent) for extent in self.extents_deg]

    def scene(self, extent_deg: float) -> Scene:
        """The preset with a defect of this extent; 0 for none."""
        scene = presets[self.preset]
        return scene.replace(extent=math.radians(extent_deg)) if extent_deg else scene.healthy()

    @property
    def slip(self) -> str:
        """The sentence of MODEL.md on a mistake of the paper in this figure; empty for none."""
        section = asset_text("docs/MODEL.md").partition(_SLIPS)[2].partition("\n## ")[0]
        head = f"* Figure {self.number}: "
        found = [line for line in section.splitlines() if line.startswith(head)]
        return found[0].removeprefix(head) if found else ""

    def link(self, tab: str, compared: bool) -> str:
        """The address of its last scene on a tab; with the others as compared ones, if wanted."""
        others = [one for one in self.scenes[:-1] if one.defects and compared]
        drawn = tuple(Compared(one, usual_name(one)) for one in others)
        return write(Place(self.scenes[-1], self.preset, tab=tab, compared=drawn))


# Curves


def _loads(scene: Scene) -> list[Line]:
    angle, load = Results(scene).load_curves[0]
    return [Line(np.degrees(angle), load)]


def _term(term: str, first: float, last: float, scene: Scene) -> list[Line]:
    found = statics.curves(scene, math.radians(first), math.radians(last), 361)
    return [Line(np.degrees(found.cage_angles), found.term(term))]


def _modes(dof: str, scene: Scene) -> list[Line]:
    modes = Results(scene).modes
    own = [i for i, label in enumerate(modes.label) if label[:-1] == dof]
    drawn = lines(np.degrees(modes.cage_angles), modes.frequency[:, own])
    return [Line(drawn["angle"], drawn["frequency"])]


def _depth(scene: Scene) -> list[Line]:
    angle = np.radians(np.linspace(180.0, 360.0, 721))
    drops = [defect.path(angle, scene.bearing) for defect in scene.defects]
    return [Line(np.degrees(angle), sum(drops, np.zeros(angle.size)))]


def _stretch(scene: Scene) -> slice:
    return slice(*np.searchsorted(Results(scene).motion.time, (0.745, 0.775)))


def _acceleration(column: int, scene: Scene) -> list[Line]:
    motion, cut = Results(scene).motion, _stretch(scene)
    return [Line(motion.time[cut], motion.outer_acceleration[cut, column], 1.2)]


def _contact_forces(scene: Scene) -> list[Line]:
    """Of balls that enter or leave, thick as they move and thin at rest."""
    motion, cut = Results(scene).motion, _stretch(scene)
    time, cage = motion.time[cut][::8], motion.cage_angle[cut]
    first, last = float(cage[0]), float(cage[-1])
    at_rest = statics.curves(scene, first, last, time.size).ball_load
    moving = motion.ball_loads(cut.start, cut.stop)[::8]
    balls = sorted({one.ball for one in crossings(scene, first, last)})
    thin = [Line(np.linspace(time[0], time[-1], time.size), at_rest[:, i], 0.8) for i in balls]
    return [*thin, *(Line(time, moving[:, i]) for i in balls)]


def _levels(dof: str, scene: Scene) -> list[Line]:
    frequency, density = Results(scene).late_spectra[dof]
    heard = (frequency >= 300.0) & (frequency <= 2100.0)
    return [Line(frequency[heard], decibels(density[heard]))]


def _bands(dof: str, scene: Scene) -> list[tuple[float, float]]:
    return [band for label, band in Results(scene).bands.items() if label[:-1] == dof]


def _defect(scene: Scene) -> list[tuple[float, float]]:
    return [
        tuple(np.degrees(d.center + 0.5 * d.extent * np.array([-1.0, 1.0])))  # type: ignore[misc]
        for d in scene.defects
    ]


def _grid(of: str, scene: Scene) -> Array:
    maps = Results(scene).maps
    return maps.term(of) if of in STIFFNESS_TERMS else maps.loaded_balls.astype(float)


def _circle(radius: float) -> Line:
    turn = np.linspace(0.0, 2.0 * math.pi, 181)
    return Line(radius * np.cos(turn), radius * np.sin(turn))


def _support(turned: bool) -> Line:
    """A spring from the outer ring to the ground, at its side or below."""
    along = np.array([2.7, 3.0, 3.1, 3.3, 3.5, 3.7, 3.8, 4.1])
    across = np.array([0.0, 0.0, 0.25, -0.25, 0.25, -0.25, 0.0, 0.0])
    return Line(-along, across) if turned else Line(across, -along)


def _diagram(scene: Scene) -> list[Line]:
    """Inner ring with the shaft, balls, outer ring on its springs; the defect is a thick arc."""
    angles = scene.bearing.ball_spacing * np.arange(scene.bearing.n_balls)
    balls = [
        Line(0.3 * c.x + 1.9 * math.cos(a), 0.3 * c.y + 1.9 * math.sin(a), 1.0)
        for c, a in ((_circle(1.0), angle) for angle in angles.tolist())
    ]
    (start, end), *_ = _defect(scene)
    arc = np.radians(np.linspace(start, end, 41))
    defect = Line(2.25 * np.cos(arc), 2.25 * np.sin(arc), 6.0)
    rings = [_circle(1.6), _circle(2.2), _circle(2.7)]
    return [*rings, *balls, defect, _support(turned=True), _support(turned=False)]


# Numbers


def _ends(values: Array, unit: str) -> str:
    """From the least to the greatest."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    return prefixed_span(low, high, unit)


def _drawn(curves: Callable[[Scene], list[Line]], unit: str, scenes: Sequence[Scene]) -> str:
    """Least and greatest number of the curves of scenes."""
    return _ends(np.concatenate([one.y for scene in scenes for one in curves(scene)]), unit)


def _terms(terms: Sequence[str], scenes: Sequence[Scene]) -> str:
    found = [_term(term, 15.0, 45.0, scene)[0].y for term in terms for scene in scenes]
    return _ends(np.concatenate(found), TERM_UNITS[terms[0]])


def _mean(term: str, scenes: Sequence[Scene]) -> str:
    means = [float(_term(term, 0.0, 30.0, one)[0].y[:-1].mean()) for one in scenes]
    return " → ".join(style.with_prefix(mean, TERM_UNITS[term]) for mean in means)


def _mean_mode(label: str, scenes: Sequence[Scene]) -> str:
    found = [Results(one).modes for one in scenes]
    means = [one.frequency[:, list(one.label).index(label)][:-1].mean() for one in found]
    return " → ".join(f"{mean:.0f} Hz" for mean in means)


def _band(label: str, scenes: Sequence[Scene]) -> str:
    return " → ".join(span(*Results(scene).bands[label], "Hz") for scene in scenes)


def _inside(scenes: Sequence[Scene]) -> str:
    """Balls in the defect at any one time."""
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
def _near_64() -> Maps:
    scene = presets["liew-lim"]
    cage = np.arange(240) * scene.bearing.ball_spacing / 240
    return stiffness_maps(scene, np.radians(np.arange(60.0, 67.0, 0.25)), cage)


def _least(of: str, _: Sequence[Scene]) -> str:
    maps = _near_64()
    means = (maps.term(of) if of in STIFFNESS_TERMS else maps.loaded_balls).mean(axis=1)
    return f"{math.degrees(maps.extents[int(np.argmin(means))]):.2f}°"


def _spacing(scenes: Sequence[Scene]) -> str:
    return f"{math.degrees(scenes[0].bearing.ball_spacing):.4g}°"


def _entry_to_exit(scenes: Sequence[Scene]) -> str:
    between = [
        math.fmod(s.defects[0].extent, s.bearing.ball_spacing) / s.cage_speed for s in scenes
    ]
    return ", ".join(f"{1e3 * time:.2f} ms" for time in between)


def _leaving(scenes: Sequence[Scene]) -> str:
    """The ball that leaves next after ball 9 has entered."""
    words = []
    for scene in scenes:
        found = crossings(scene, 0.0, 4.0 * math.pi)
        entry = next(i for i, one in enumerate(found) if one.enters and one.ball == 8)
        words.append(next(str(one.ball + 1) for one in found[entry:] if not one.enters))
    return ", ".join(words)


def _of(attribute: Callable[[Scene], float], unit: str) -> Callable[[Sequence[Scene]], str]:
    return lambda scenes: style.with_prefix(attribute(scenes[0]), unit)


# The figures

_TERMS_IN_ORDER = (
    *("k_xx", "k_yy", "k_zz", "k_xy", "k_xz", "k_yz", "k_xrx", "k_yry", "k_zry", "k_xry"),
    *("k_yrx", "k_zrx", "k_rxrx", "k_ryry", "k_rxry"),
)
_AXES_OF_4 = {
    "k_xx": (100e6, 260e6), "k_yy": (100e6, 260e6), "k_zz": (100e6, 260e6),
    "k_xy": (-30e6, 30e6), "k_xz": (-30e6, 30e6), "k_yz": (-30e6, 30e6),
    "k_xrx": (-0.3e6, 0.3e6), "k_yry": (-0.3e6, 0.3e6), "k_zry": (-0.3e6, 0.3e6),
    "k_xry": (-1.35e6, 0.9e6), "k_yrx": (-0.9e6, 1.35e6), "k_zrx": (-0.9e6, 1.35e6),
    "k_rxrx": (10e3, 50e3), "k_ryry": (10e3, 50e3), "k_rxry": (-5e3, 5e3),
}  # fmt: skip
_STIFFNESS = {
    term: style.AxisQuantity("Stiffness", "", unit, prefixed=True)
    for term, unit in TERM_UNITS.items()
}
_EXTENT = style.AxisQuantity("Extent", "Δφf", "°")
_ACCELERATION = style.AxisQuantity("Acceleration", "a", "m/s²")
_DENSITY = density_axis("")
_HERTZ = style.AxisQuantity("Frequency", "f", "Hz", prefixed=True)
_BALLS = style.AxisQuantity("Balls", "", "")
_NOTHING = style.AxisQuantity("", "", "")


def _lettered(number: int, words: str) -> str:
    return f"({chr(ord('a') + number)}) {words}"


def _stiffness_panel(number: int, term: str, shown: tuple[float, float, float, float]) -> Panel:
    title = _lettered(number, TERM_SYMBOLS[term])
    curves = partial(_term, term, shown[0], shown[1])
    return Panel(title, style.CAGE_ANGLE, _STIFFNESS[term], shown, curves)


def _map_panel(title: str, of: str) -> Panel:
    shown = (0.0, 30.0, 0.0, 90.0)
    return Panel(
        title,
        style.CAGE_ANGLE,
        _EXTENT,
        shown,
        grid=(_STIFFNESS.get(of, _BALLS), partial(_grid, of)),
    )


_TURN = (0.0, 360.0 / 14.0)
_SPAN = (0.745, 0.775)
_EXTENTS = (12.9, 38.6)

FIGURES = (
    PaperFigure(
        3, "Load distribution", "liew-lim", (0.0, 5.0, 40.0, 70.0), 3,
        tuple(
            Panel(_lettered(i, f"{extent:g}°"), style.BALL_ANGLE, style.BALL_LOAD,
                  (0.0, 360.0, 0.0, 1600.0), _loads, (0.0, extent), _defect)
            for i, extent in enumerate((5.0, 40.0, 70.0))
        ),
        (
            Printed("Balls in the defect at 5°, 40° and 70°", "0 or 1, 1 or 2, 2 or 3", _inside),
            Printed("Loads; the printed axis", "0 to 1.6 kN", partial(_drawn, _loads, "N")),
        ),
        "load",
    ),
    PaperFigure(
        4, "Varying stiffness", "liew-lim", (0.0, 5.0, 40.0, 70.0), 3,
        tuple(
            _stiffness_panel(i, term, (15.0, 45.0, *_AXES_OF_4[term]))
            for i, term in enumerate(_TERMS_IN_ORDER)
        ),
        (
            Printed("Stiffness repeats after", "30°", _spacing),
            Printed("Mean k_xx, healthy to 70°", "increases", partial(_mean, "k_xx")),
            Printed("Mean k_yy, healthy to 70°", "decreases up to 64°", partial(_mean, "k_yy")),
            Printed("Mean k_zz, healthy to 70°", "decreases", partial(_mean, "k_zz")),
            Printed("k_xx, k_yy, k_zz; the printed axis", "100 to 260 MN/m",
                    partial(_terms, _TERMS_IN_ORDER[:3])),
            Printed("k_xy, k_xz, k_yz; the printed axis", "−30 to 30 MN/m",
                    partial(_terms, _TERMS_IN_ORDER[3:6])),
            Printed("k_θxθx, k_θyθy; the printed axis", "10 to 50 kN·m/rad",
                    partial(_terms, _TERMS_IN_ORDER[12:14])),
        ),
        "stiffness",
    ),
    PaperFigure(
        5, "Stiffness over the extent", "liew-lim", (64.0,), 3,
        tuple(_map_panel(_lettered(i, TERM_SYMBOLS[t]), t) for i, t in enumerate(_TERMS_IN_ORDER)),
        (Printed("Mean k_yy is least at an extent of", "about 64°", partial(_least, "k_yy")),),
        "maps",
    ),
    PaperFigure(
        6, "Number of loaded balls", "liew-lim", (64.0,), 1,
        (_map_panel("Loaded balls", "balls"),),
        (Printed("Fewest balls carry load at an extent of", "about 64°",
                 partial(_least, "balls")),),
        "maps",
    ),
    PaperFigure(
        7, "Model of the fan rig", "fan-rig", (12.9,), 1,
        (Panel("", _NOTHING, _NOTHING, (-4.3, 4.3, -4.3, 3.0), _diagram),),
        (
            Printed("Mass of rotor and inner ring", "2 kg", _of(lambda s: s.support.inner_mass,
                                                                "kg")),
            Printed("Mass of housing and outer ring", "2 kg", _of(lambda s: s.support.outer_mass,
                                                                  "kg")),
            Printed("Stiffness of the support", "212.2 MN/m", _of(lambda s: s.support.stiffness_y,
                                                                  "N/m")),
            Printed("Damping of the support", "1648.2 N·s/m",
                    lambda s: f"{number(s[0].support.damping_y, 5)} N·s/m"),
            Printed("Load, downwards", "100 N", _of(lambda s: -s.load.fy, "N")),
            Printed("Load-deflection factor", "5453 MN/m^1.5",
                    lambda s: f"{s[0].bearing.load_deflection_factor / 1e6:.4g} MN/m^1.5"),
        ),
        "model",
    ),
    PaperFigure(
        8, "Stiffness and natural frequencies", "fan-rig", (0.0, *_EXTENTS), 2,
        (
            _stiffness_panel(0, "k_xx", (*_TURN, 0.0, 50e6)),
            Panel("(b) ωx1, ωx2", style.CAGE_ANGLE, FREQUENCY, (*_TURN, 300.0, 2100.0),
                  partial(_modes, "x")),
            _stiffness_panel(2, "k_yy", (*_TURN, 0.0, 50e6)),
            Panel("(d) ωy1, ωy2", style.CAGE_ANGLE, FREQUENCY, (*_TURN, 300.0, 2100.0),
                  partial(_modes, "y")),
            _stiffness_panel(4, "k_xy", (*_TURN, -3e6, 3e6)),
            Panel("(f) Depth profile", style.BALL_ANGLE, DEPTH, (180.0, 360.0, 0.0, 75e-6),
                  _depth),
        ),
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
        9, "Simulated vibration", "fan-rig", _EXTENTS, 2,
        (
            *(
                Panel(_lettered(2 * row + column, f"{('Horizontal', 'Vertical')[row]}, {extent}°"),
                      TIME, _ACCELERATION, (*_SPAN, -limit, limit),
                      partial(_acceleration, row), (extent,))
                for row, limit in enumerate((2.0, 4.0))
                for column, extent in enumerate(_EXTENTS)
            ),
            *(
                Panel(_lettered(4 + column, f"Contact force, {extent}°"), TIME, style.BALL_LOAD,
                      (*_SPAN, 0.0, top), _contact_forces, (extent,))
                for column, (extent, top) in enumerate(zip(_EXTENTS, (50.0, 90.0), strict=True))
            ),
        ),
        (
            Printed("From entry to exit", "0.013 s for both", _entry_to_exit),
            Printed("Ball that leaves after ball 9 has entered", "9, 10", _leaving),
            Printed("Horizontal acceleration; the printed axis", "−2 to 2 m/s²",
                    partial(_drawn, partial(_acceleration, 0), "m/s²")),
            Printed("Vertical acceleration; the printed axis", "−4 to 4 m/s²",
                    partial(_drawn, partial(_acceleration, 1), "m/s²")),
        ),
        "vibration",
    ),
    PaperFigure(
        10, "Spectra", "fan-rig", _EXTENTS, 2,
        tuple(
            Panel(_lettered(i, f"{dof}-direction"), _HERTZ, _DENSITY, (300.0, 2100.0, *shown),
                  partial(_levels, dof), None, partial(_bands, dof))
            for i, (dof, shown) in enumerate(zip(SHOWN, ((-80.0, -30.0), (-55.0, -20.0)),
                                                 strict=True))
        ),
        (
            Printed("Level along x; the printed axis", "−80 to −30 dB",
                    partial(_drawn, partial(_levels, "x"), "dB")),
            Printed("Level along y; the printed axis", "−55 to −20 dB",
                    partial(_drawn, partial(_levels, "y"), "dB")),
            Printed("Band of ω_x1", "higher for 38.6°", partial(_band, "x1")),
            Printed("Band of ω_y1", "lower for 38.6°", partial(_band, "y1")),
        ),
        "vibration",
    ),
)  # fmt: skip
"""The figures, in the order of the paper."""
