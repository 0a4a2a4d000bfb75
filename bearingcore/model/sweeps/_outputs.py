"""Outputs of a sweep: names, units, and the computation of each.

An output is one number per scene. Band edges have a number for each mode, and records have one for
each sample.
"""

from __future__ import annotations

import fnmatch
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.common import Array, Progress, _checks as checks
from bearingcore.common._arrays import least_and_greatest
from bearingcore.model.dynamics import BandSearch, PathEffects, orbit, simulate, simulated_record
from bearingcore.model.dynamics._ball_comparison import mass_share
from bearingcore.model.dynamics._low_pass import PASSED
from bearingcore.model.dynamics._modes import stiffness_terms
from bearingcore.model.dynamics._speed_runs import SETTLING_SHARE
from bearingcore.model.scene import DOF_NAMES, DOF_SYMBOLS, MASSLESS, Scene
from bearingcore.model.statics import (
    BALL_LOAD,
    ROUNDS,
    STIFFNESS_TERMS,
    TERM_SYMBOLS,
    TERM_UNITS,
    StaticRanges,
    contact_pressures,
    dynamic_load_rating,
    equilibrium,
    life,
    static_ranges,
    static_state,
    stiffness_maps,
)
from bearingcore.model.statics._positions import extremes, over_all_positions, positions
from bearingcore.model.statics._status import StaticStatus
from bearingcore.model.sweeps._status import OF_MOTION, OF_ORBIT, OF_STATICS, STATUSES, SweepStatus
from bearingcore.recordings._recording import DIRECTIONS

STATICS, PRESSURE, LIFE, MODES = "statics", "pressure", "life", "modes"
MOTION, ORBIT, MASS, RECORD = "motion", "orbit", "mass", "record"
MOVING = frozenset({MOTION, ORBIT, MASS, RECORD})
"""Computations of motions."""

SECONDS = {STATICS: 4e-4, PRESSURE: 4e-4, LIFE: 1e-3, MODES: 5e-4}
SECONDS |= {MOTION: 2e-2, ORBIT: 1e-2, MASS: 0.2, RECORD: 0.1}
"""Rough time [s] of each computation for one scene in two directions; it determines the number of
scenes in a task. Motions in five directions take about ten times as long. With a defect of the
inner race statics and modes take thirty times as long, life fifteen times."""

SECONDS_IN_A_ROW = {STATICS: 1e-4, MODES: 4e-4}
"""Time [s] per scene if the extent varies, as a row of extents is solved together."""

_STATIC_CODES = np.array([OF_STATICS[code].code for code in sorted(OF_STATICS)], np.int8)
"""Code of a sweep for each status of a static state."""

MODE = "mode"
"""Name of the dimension of the band edges."""

SAMPLE = "sample"
"""Name of the dimension of records; its coordinate is the time [s]."""

SEED = "seed"
"""Name of the dimension of records that are drawn with several seeds."""

MOST_SEEDS = 100_000


@dataclass(frozen=True)
class Output:
    """A quantity that a sweep can compute.

    Attributes
    ----------
    unit, meaning
        unit and meaning for people; the unit of a ratio or a count is "1".
    group, label
        heading for lists, and a few words for lists and axes. If there is a number for each mode,
        "{}" in the label stands for the mode.
    needs
        necessary computation: "statics", "pressure", "life", "modes", "motion", "orbit", "mass" or
        "record".
    dof
        direction that must be free; empty if there is none.
    per_mode, per_sample
        True if there is a number for each mode, or for each sample of a record.
    """

    unit: str
    meaning: str
    group: str
    label: str
    needs: str
    dof: str = ""
    per_mode: bool = False
    per_sample: bool = False


def mode_symbol(label: str) -> str:
    """Return the symbol of a mode by its label: "x₁" for "x1"."""
    return DOF_SYMBOLS[label[:-1]] + label[-1].translate(_LOWERED)


_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def _table() -> dict[str, Output]:
    table: dict[str, Output] = {}
    positions = "over all positions of the balls and of a defect that turns"
    for term in STIFFNESS_TERMS:
        for which in ("mean", "least", "greatest"):
            table[f"{term}_{which}"] = Output(
                TERM_UNITS[term],
                f"{which} stiffness {term} {positions}",
                f"Stiffness, {which}",
                f"{TERM_SYMBOLS[term]}, {which}",
                STATICS,
            )
    for which in ("mean", "least", "greatest"):
        table[f"loaded_balls_{which}"] = Output(
            "1",
            f"{which} number of balls that carry load {positions}",
            "Balls",
            f"loaded balls, {which}",
            STATICS,
        )
    table["ball_load_greatest"] = Output(
        "N", f"greatest load of a ball {positions}", "Balls", "greatest ball load", STATICS
    )
    table["converged_share"] = Output(
        "1",
        "share of the positions with a single static state that the solver reached",
        "Balls",
        "positions with a static state, share",
        STATICS,
    )
    for race in ("inner", "outer"):
        table[f"contact_pressure_{race}"] = Output(
            "Pa",
            f"greatest contact pressure of a ball on the {race} race {positions}",
            "Balls",
            f"contact pressure, {race} race",
            PRESSURE,
        )
    left_out = "; pressure and impacts at the edges of a defect are left out: an upper bound"
    for unit, name in (("1", "turns"), ("h", "hours")):
        reached = f"{name} that 9 of 10 bearings reach"
        table[f"life_{name}"] = Output(
            unit, f"{reached}, by ISO 16281{left_out}", "Life", reached, LIFE
        )
    share = "life over that of the healthy bearing"
    table["life_share_of_healthy"] = Output("1", share + left_out, "Life", share, LIFE)
    for which in ("least", "greatest"):
        table[f"band_{which}"] = Output(
            "Hz",
            f"{which} natural frequency of each mode, damping left out, {positions}",
            "Natural frequencies",
            f"mode {{}}, {which}",
            MODES,
            per_mode=True,
        )
    for dof in DOF_NAMES:
        unit, way = ("rad/s²", "about") if dof.startswith("r") else ("m/s²", "along")
        along = f"of the housing {way} {dof[-1]} in the settled part of a simulated motion"
        for which, words, short in (
            ("rms", "root mean square acceleration", "RMS"),
            ("greatest", "greatest acceleration, either way,", "greatest"),
        ):
            table[f"acceleration_{which}_{dof}"] = Output(
                unit,
                f"{words} {along}",
                "Vibration of the housing",
                f"acceleration {way} {dof[-1]}, {short}",
                MOTION,
                dof,
            )
    for dof in DIRECTIONS:
        table[f"record_{dof}"] = Output(
            "m/s²",
            f"record of a sensor along {dof}: the settled motion of the housing behind a path, with"
            " a cage that wanders, tones of the shaft and noise, drawn with the settings' seed",
            "Records",
            f"record along {dof}",
            RECORD,
            dof,
            per_sample=True,
        )
    table["mass_share"] = Output(
        "1",
        "share of the housing's power along x and y in the settings' band that the balls' mass "
        "adds, in simulated motions with and without it",
        "Vibration of the housing",
        "share of the power that the balls' mass adds",
        MASS,
    )
    table["floquet_multiplier_greatest"] = Output(
        "1",
        "size of the largest Floquet multiplier of the periodic motion; "
        "above 1 a disturbance of it grows",
        "Motion that repeats",
        "largest Floquet multiplier |μ|",
        ORBIT,
    )
    return table


OUTPUTS: Mapping[str, Output] = _table()
"""All outputs by name."""

_SHOWN = 6
_EXAMPLES = (
    ", ".join([*dict.fromkeys(("k_yy_mean", *OUTPUTS))][:_SHOWN])
    + f" and {len(OUTPUTS) - _SHOWN} more that bearingcore.model.sweeps.OUTPUTS lists"
)


def chosen_outputs(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names of outputs for patterns with `*` and `?`, in the order of OUTPUTS.

    Records, which are long, are chosen only by a pattern that begins with "record".

    Raises
    ------
    ValueError
        for a name or pattern that fits no output, or if there are no patterns.
    """
    patterns = [names] if isinstance(names, str) else list(names)
    chosen: set[str] = set()
    for pattern in patterns:
        fitting = [
            name
            for name in (fnmatch.filter(OUTPUTS, pattern) if isinstance(pattern, str) else [])
            if not OUTPUTS[name].per_sample or pattern.startswith(RECORD)
        ]
        if not fitting:
            raise checks.refuse("name in outputs", pattern, _EXAMPLES)
        chosen.update(fitting)
    if not chosen:
        raise checks.refuse("outputs", patterns, "at least one of " + _EXAMPLES)
    return tuple(name for name in OUTPUTS if name in chosen)


def mode_labels(dofs: Iterable[str]) -> tuple[str, ...]:
    """Return the labels of the modes of `bearingcore.modes`, two for each direction."""
    return tuple(f"{dof}{number}" for dof in dofs for number in (1, 2))


@dataclass(frozen=True)
class Settings:
    """Resolution of the computations.

    Parameters
    ----------
    cage_angles
        number of cage angles in a period, ends included. With an inner-race defect, a quarter as
        many per ball spacing over a whole turn, for each defect angle with a ball at an edge; least
        and greatest values are then searched between the angles too. Otherwise they are those at
        the angles. If few balls carry load, as under a light or tilting load, stiffness may vary by
        a few per cent more between the angles.
    duration
        [s] of simulated motions and records; the first half of a motion is left out as transient.
    sample_rate
        [Hz] of simulated motions and records.
    dynamic_load_rating
        C_r [N] for lives. None takes the rating of each bearing, by the catalogue if its number is
        known, otherwise by ISO 281.
    band_low, band_high
        ends [Hz] of the band for the share of the power that mass adds.
    seed
        seed of the random numbers of records, the same for all scenes: records then differ by the
        scenes alone. Several seeds draw each scene several times, and records have the further
        dimension "seed". None makes a seed from each scene, so that each has another path; use it
        to learn from records.
    effects
        effects of the path to the sensor in records; None draws them, see `simulated_record`.
    """

    cage_angles: int = 121
    duration: float = 1.4
    sample_rate: float = 65536.0
    dynamic_load_rating: float | None = None
    band_low: float = 2100.0
    band_high: float = 10_000.0
    seed: int | tuple[int, ...] | None = None
    effects: PathEffects | None = None

    def __post_init__(self) -> None:
        angles = checks.whole_number("cage_angles", self.cage_angles, at_least=3, at_most=10_000)
        checks.keep(self, cage_angles=angles)
        checks.keep_number(self, "duration", above=0.0, at_most=60.0, unit="s")
        checks.keep_number(self, "sample_rate", above=0.0, at_most=1e7, unit="Hz")
        checks.keep_number(self, "band_low", above=0.0, unit="Hz")
        checks.keep_number(self, "band_high", above=self.band_low, unit="Hz")
        checks.keep_number(self, "dynamic_load_rating", optional=True, above=0.0, unit="N")
        if self.effects is not None:
            checks.instance("effects", self.effects, PathEffects, "PathEffects, or None")
        if self.seed is not None:
            several = isinstance(self.seed, Iterable)
            seeds = tuple(
                checks.whole_number("seed", seed, at_least=0, at_most=2**32 - 1)
                for seed in (self.seed if isinstance(self.seed, Iterable) else (self.seed,))
            )
            if not 1 <= len(set(seeds)) == len(seeds) <= MOST_SEEDS:
                raise checks.refuse("seed", self.seed, f"1 to {MOST_SEEDS:,} different ones")
            checks.keep(self, seed=seeds if several else seeds[0])

    @property
    def seeds(self) -> tuple[int | None, ...]:
        """Seeds of the draws of each record."""
        return self.seed if isinstance(self.seed, tuple) else (self.seed,)

    @property
    def has_several_seeds(self) -> bool:
        """True if seeds are a dimension of records, even with a single seed in a list."""
        return isinstance(self.seed, tuple)

    @property
    def record_time(self) -> Array:
        """(n,) [s] times of the samples of a record."""
        return np.arange(round(self.duration * self.sample_rate)) / self.sample_rate


Numbers = dict[str, Array]


def of_scene(
    scene: Scene,
    needs: Iterable[str],
    labels: tuple[str, ...],
    settings: Settings,
    outputs: Iterable[str] = OUTPUTS,
    progress: Progress | None = None,
) -> tuple[int, Numbers]:
    """Return the status code of one scene, and the outputs of the computations in `needs`.

    `labels` are the modes of the band edges. If a defect turns, extremes between the positions are
    searched only for stiffness in `outputs`. `progress` is called during motions.
    """
    statuses: list[SweepStatus] = []
    numbers: Numbers = {}
    if STATICS in needs or MODES in needs:
        ranges = static_ranges(
            scene,
            [
                name
                for name in (*STIFFNESS_TERMS, BALL_LOAD)
                if {f"{name}_least", f"{name}_greatest"} & set(outputs)
            ],
            settings.cage_angles,
            rounds=ROUNDS if scene.defect_turns else 0,
        )
        code, numbers = _statics_of_ranges(ranges)
        statuses.append(STATUSES[int(code)])
    computations: dict[str, Callable[[], SweepStatus]] = {
        PRESSURE: lambda: _pressure(scene, settings, numbers),
        LIFE: lambda: _life(scene, settings, numbers),
        MODES: lambda: _bands_over_all_positions(ranges, labels, settings.cage_angles, numbers),
        MOTION: lambda: _motion(scene, settings, numbers, progress),
        RECORD: lambda: _record(scene, settings, numbers, progress),
        MASS: lambda: _mass(scene, settings, numbers, progress),
        ORBIT: lambda: _orbit(scene, numbers, progress),
    }
    for name, compute in computations.items():
        if name not in needs:
            continue
        try:  # separately, so that a refusal of one leaves the others as they are
            statuses.append(compute())
        except ValueError:
            statuses.append(SweepStatus.COMPUTATION_REFUSED)
        except (ArithmeticError, np.linalg.LinAlgError):
            statuses.append(SweepStatus.ARITHMETIC_FAILED)
    complete = SweepStatus.COMPLETE
    return next((status for status in statuses if status is not complete), complete).code, numbers


def _statics_of_ranges(ranges: StaticRanges) -> tuple[NDArray[np.int8], Numbers]:
    """Return `_statics` of one scene, with the extremes between the positions."""
    state = ranges.state
    terms = stiffness_terms(state)
    greatest_load = state.ball_load.max(axis=1)
    code, numbers = _statics(state.status, terms, state.loaded_balls, greatest_load, state.shares)
    for which, ends in (("least", ranges.least), ("greatest", ranges.greatest)):
        for name, value in ends.items():
            key = f"{name}_{which}"
            if key in numbers and np.isfinite(numbers[key]):
                numbers[key] = np.array(value)
    return code, numbers


def _bands_over_all_positions(
    ranges: StaticRanges, labels: tuple[str, ...], n: int, numbers: Numbers
) -> SweepStatus:
    """Put the edges (len(labels),) of the frequency bands of one scene into `numbers`."""
    scene = ranges.state.scene.replace(balls=MASSLESS)  # frequencies leave out the balls' mass
    if scene != ranges.state.scene:
        ranges = static_ranges(scene, (), n, rounds=0)
    terms = stiffness_terms(ranges.state)
    if not scene.defect_turns:
        bands = _bands(scene, terms[:, None], labels)
        numbers |= {name: values[0] for name, values in bands.items()}
        return SweepStatus.COMPLETE
    search = BandSearch(scene, terms, ranges.state.shares)

    def evaluate(cage_angles: Array, shaft_angles: Array) -> Array:
        state = equilibrium(scene, cage_angles, shaft_angles=shaft_angles)
        return search.frequencies(stiffness_terms(state))

    ends = extremes(positions(scene, n), search.frequencies(terms), evaluate)
    edges = [dict(zip(search.labels, end.tolist(), strict=True)) for end in ends[:2]]
    for which, edge in zip(("least", "greatest"), edges, strict=True):
        numbers[f"band_{which}"] = np.array([edge.get(label, math.nan) for label in labels])
    return SweepStatus.COMPLETE


IN_ROWS = frozenset({STATICS, MODES})
"""Computations that `of_row` does."""


def of_row(
    scene: Scene, extents: Array, needs: Iterable[str], labels: tuple[str, ...], settings: Settings
) -> tuple[NDArray[np.int8], Numbers]:
    """Return codes (m,) and outputs (m, ...) of `scene` with each extent, solved together.

    `needs` are out of IN_ROWS, `labels` the modes of the band edges. No defect turns.
    """
    grid = positions(scene, settings.cage_angles)
    maps = stiffness_maps(scene, extents, grid.cage_angles)
    codes, numbers = _statics(
        maps.status, maps.stiffness, maps.loaded_balls, maps.greatest_load, grid.weights
    )
    if MODES in needs:
        try:
            numbers |= _bands(scene, maps.stiffness, labels)
        except ValueError:
            complete = codes == SweepStatus.COMPLETE.code
            codes = np.where(complete, SweepStatus.COMPUTATION_REFUSED.code, codes)
    return codes, numbers


def _bands(scene: Scene, terms: Array, labels: tuple[str, ...]) -> Numbers:
    """Return edges (m, len(labels)) of bands from stiffness terms (15, m, n) of m scenes."""
    edges = np.full((2, terms.shape[1], len(labels)), math.nan)
    for i, row in enumerate(np.moveaxis(terms, 1, 0)):
        search = BandSearch(scene, row, np.ones(row.shape[1]))
        ends = np.array(least_and_greatest(search.frequencies(row), 1))
        for name, mode in zip(search.labels, ends.T, strict=True):
            if name in labels:
                edges[:, i, labels.index(name)] = mode
    return {"band_least": edges[0], "band_greatest": edges[1]}


def _statics(
    status: NDArray[np.int8],
    stiffness: Array,
    loaded_balls: NDArray[np.int64],
    greatest_load: Array,
    weights: Array,
) -> tuple[NDArray[np.int8], Numbers]:
    """Return codes and numbers (...) from positions (..., n) with weights (n,).

    stiffness is (15, ..., n). A statistic is NaN if any position is NaN, because a mean over the
    known positions alone would look like that of all.
    """
    gone = status >= StaticStatus.NOT_CARRIED
    balls = np.where(gone, math.nan, loaded_balls)
    known = status == StaticStatus.CONVERGED
    numbers: Numbers = {
        "ball_load_greatest": np.where(gone, math.nan, greatest_load).max(axis=-1),
        "converged_share": np.where(known.all(axis=-1), 1.0, known @ weights),
        "loaded_balls_mean": np.asarray(balls @ weights),
        "loaded_balls_least": balls.min(axis=-1),
        "loaded_balls_greatest": balls.max(axis=-1),
    }
    statistics = (
        ("mean", stiffness @ weights),
        ("least", stiffness.min(axis=-1)),
        ("greatest", stiffness.max(axis=-1)),
    )
    for which, values in statistics:
        numbers |= {
            f"{term}_{which}": value for term, value in zip(STIFFNESS_TERMS, values, strict=True)
        }
    # the greatest code of the solver is the one with the least known
    return _STATIC_CODES[status.max(axis=-1)], numbers


def _life(scene: Scene, settings: Settings, numbers: Numbers) -> SweepStatus:
    """Put the life into `numbers` and return its status.

    It is averaged over all cage angles, so that healthy and damaged bearings can be compared.
    Infinite lives of unloaded bearings are NaN, as maps cannot show them.
    """
    known_rating = scene.bearing.dynamic_load_rating
    rating = settings.dynamic_load_rating or known_rating or dynamic_load_rating(scene.bearing)
    rated = life(scene, rating)
    turns = 1e6 * rated.million_revolutions
    known = math.isfinite(turns)
    numbers["life_turns"] = np.array(turns if known else math.nan)
    numbers["life_hours"] = np.array(rated.hours if known else math.nan)
    numbers["life_share_of_healthy"] = np.array(rated.share_of_healthy if known else math.nan)
    if math.isinf(turns):
        return SweepStatus.NOTHING_TOUCHES
    if known and math.isnan(rated.hours):
        return SweepStatus.COMPUTATION_REFUSED
    return OF_STATICS[StaticStatus(rated.status)]


def _pressure(scene: Scene, settings: Settings, numbers: Numbers) -> SweepStatus:
    """Put the pressures on both races into `numbers` and return their status."""
    state = over_all_positions(scene, settings.cage_angles, static_state)
    pressures = contact_pressures(scene, state)
    for contact in (pressures.inner, pressures.outer):
        numbers[f"contact_pressure_{contact.race}"] = np.array(contact.greatest_pressure)
    return OF_STATICS[StaticStatus(int(state.status.max()))]


def _mass(
    scene: Scene, settings: Settings, numbers: Numbers, progress: Progress | None
) -> SweepStatus:
    """Put the share that the balls' mass adds into `numbers`."""
    if settings.band_high > PASSED * settings.sample_rate:
        raise checks.refuse(
            "band_high", settings.band_high, f"at most {PASSED:g} of the sample_rate"
        )
    band = settings.band_low, settings.band_high
    share = mass_share(scene, *band, settings.duration, settings.sample_rate, progress)
    numbers["mass_share"] = np.array(share)
    return SweepStatus.COMPLETE


def _orbit(scene: Scene, numbers: Numbers, progress: Progress | None) -> SweepStatus:
    """Put the largest multiplier of the orbit into `numbers` and return its status."""
    motion = orbit(scene, progress=progress)
    numbers["floquet_multiplier_greatest"] = np.array(motion.largest_multiplier)
    return OF_ORBIT[motion.status]


def _record(
    scene: Scene, settings: Settings, numbers: Numbers, progress: Progress | None
) -> SweepStatus:
    """Put records (n,), or (seeds, n), along each direction into `numbers`."""
    effects, duration, rate = settings.effects, settings.duration, settings.sample_rate
    records = [
        simulated_record(scene, effects, duration, rate, seed=seed, progress=progress)
        for seed in settings.seeds
    ]
    signals = np.stack([record.acceleration for record in records])  # (seeds, n, directions)
    drawn = signals if settings.has_several_seeds else signals[0]
    for axis, name in enumerate(records[0].directions):
        numbers[f"record_{name}"] = drawn[..., axis]
    return SweepStatus.COMPLETE


def _motion(
    scene: Scene, settings: Settings, numbers: Numbers, progress: Progress | None
) -> SweepStatus:
    """Put the accelerations of the motion into `numbers` and return its status."""
    motion = simulate(scene, settings.duration, settings.sample_rate, progress=progress)
    late = motion.outer_acceleration[round(SETTLING_SHARE * len(motion.time)) :]
    for i, dof in enumerate(motion.dofs):
        numbers[f"acceleration_rms_{dof}"] = np.sqrt(np.mean(late[:, i] ** 2))
        numbers[f"acceleration_greatest_{dof}"] = np.abs(late[:, i]).max()
    return OF_MOTION[motion.status]
