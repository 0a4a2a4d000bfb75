"""When balls enter and leave a defect, from the signal alone.

An edge knocks at the rings: what rings afterwards is the resonances' and predictable, the knock
itself is not. So the mean ball pass is freed of what a linear prediction gives, and what is left
occurs at the two edges. Its direction distinguishes the edges, and more: a ball on its way into the
defect hits the housing along the line from the shaft to that edge. The directions of the two knocks
enclose the whole extent, not only its remainder after ball spacings. They are rough; the time
between the knocks is fine.

The knocks occur where a ball loses its load and takes it up again, a little inside the edges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearingcore.scene.packing import typical_compression
from bearingcore.scene.scene import Scene
from bearingcore.signals.averaging import BallPasses
from bearingcore.statics.equilibrium import equilibrium

PREDICTED_FROM = 16
"""Coefficients of the linear prediction: two for each resonance and some to spare."""

SMOOTHED_OVER = math.radians(0.4)
"""Cage angle [rad] over which the strength of knocks is smoothed."""

LEAST_DISTANCE = 1.0 / 15.0
"""Of the two knocks, as a fraction of a ball pass: closer ones are one."""

SAMPLES = 2048
"""In a ball pass."""

DRAWS = 16
"""Noisy repetitions from which the uncertainty is taken."""


@dataclass(frozen=True)
class Events:
    """Entry into and exit from a defect, as they show in the mean ball pass.

    Attributes
    ----------
    entry_phase, exit_phase
        [rad] of the ball pass, 2π a pass, from the beginning of the signal.
    told_apart
        whether the knocks' directions say which one is the entry; without them the stronger one
        is taken for the exit.
    time_difference, time_uncertainty
        Δt from entry to exit and its standard deviation [s].
    remainder, remainder_uncertainty
        extent less the whole ball spacings in it [rad]: ω_c Δt and what a ball turns unloaded
        away from the edges.
    direction_extent
        the angle [rad] between the knocks' directions; None with a single direction.
    ball_spacing
        [rad]
    strength : (SAMPLES,)
        of the knocks over a ball pass, relative to its mean.
    """

    entry_phase: float
    exit_phase: float
    told_apart: bool
    time_difference: float
    time_uncertainty: float
    remainder: float
    remainder_uncertainty: float
    direction_extent: float | None
    ball_spacing: float
    strength: NDArray[np.float64]

    @property
    def turns(self) -> int | None:
        """Whole ball spacings in the extent, by the knocks' directions; None without them."""
        if self.direction_extent is None:
            return None
        return max(0, round((self.direction_extent - self.remainder) / self.ball_spacing))


@dataclass(frozen=True)
class _Knocks:
    phases: tuple[float, float]
    told_apart: bool
    extent: float | None
    strength: NDArray[np.float64]


def find_events(passes: BallPasses, scene: Scene, directions: tuple[str, ...]) -> Events:
    """Entry and exit in the mean ball pass of a housing's acceleration along `directions`.

    `scene` gives bearing, load and the centre of the defect; not its extent.
    """
    spacing = scene.bearing.ball_spacing
    (defect,) = scene.defects
    found = _knocks(passes.harmonics, passes.scatter, directions, defect.center, spacing)
    unloaded = unloading_angle(scene)
    rng = np.random.default_rng(0)
    turns = []
    for _ in range(DRAWS):
        noise = rng.standard_normal((2, *passes.harmonics.shape)) * np.sqrt(0.5 * passes.scatter)
        again = _knocks(
            passes.harmonics + noise[0] + 1j * noise[1],
            passes.scatter,
            directions,
            defect.center,
            spacing,
        )
        turns.append(again.phases[1] - again.phases[0])
    between = found.phases[1] - found.phases[0]
    strays = np.angle(np.exp(1j * (np.array(turns) - between)))
    # a draw whose knocks are elsewhere altogether widens the uncertainty; and no time is better
    # known than what it was smoothed over
    noisy = float(np.sqrt(np.mean(strays**2))) * spacing / (2.0 * math.pi)
    spread = math.hypot(noisy, 0.3 * SMOOTHED_OVER)
    between = (between % (2.0 * math.pi)) / (2.0 * math.pi)
    cage_speed = passes.frequency * spacing
    return Events(
        entry_phase=found.phases[0] % (2.0 * math.pi),
        exit_phase=found.phases[1] % (2.0 * math.pi),
        told_apart=found.told_apart,
        time_difference=between / passes.frequency,
        time_uncertainty=spread / cage_speed,
        remainder=(between * spacing + 2.0 * unloaded) % spacing,
        remainder_uncertainty=math.hypot(spread, 0.5 * unloaded),
        direction_extent=found.extent,
        ball_spacing=spacing,
        strength=found.strength,
    )


def unloading_angle(scene: Scene) -> float:
    """Angle [rad] from an edge where the most loaded ball of a healthy bearing loses its load."""
    (defect,) = scene.defects
    state = equilibrium(scene.healthy())
    load = np.nan_to_num(state.ball_load).max()
    compression = typical_compression(scene.bearing, load)
    radius = scene.bearing.ball_radius
    chord = math.sqrt(max(2.0 * radius * compression - compression**2, 0.0))
    factor = 2.0 if defect.edge == "published" else 1.0
    return factor * chord / defect.raceway_radius(scene.bearing)


def _knocks(
    harmonics: NDArray[np.complex128],
    scatter: NDArray[np.float64],
    directions: tuple[str, ...],
    center: float,
    spacing: float,
) -> _Knocks:
    """The two strongest knocks of a ball pass, the entry first."""
    left = _unpredicted(harmonics, scatter)
    spread = np.maximum(left.std(axis=0), 1e-300)
    width = SMOOTHED_OVER / spacing * SAMPLES
    strength = _smoothed(((left / spread) ** 2).mean(axis=1), width)
    first = int(strength.argmax())
    away = np.abs((np.arange(SAMPLES) - first + SAMPLES // 2) % SAMPLES - SAMPLES // 2)
    second = int(np.where(away > LEAST_DISTANCE * SAMPLES, strength, -1.0).argmax())
    at = np.array([second, first])  # the exit tends to be the stronger one
    extent = None
    if set(directions) == {"x", "y"}:
        x, y = left[:, directions.index("x")], left[:, directions.index("y")]
        along = x * math.cos(center) + y * math.sin(center)
        across = -x * math.sin(center) + y * math.cos(center)
        both = _smoothed(along * across, 0.75 * width)[at]
        squares = [_smoothed(part**2, 0.75 * width)[at] for part in (along, across)]
        slope = both / np.sqrt(squares[0] * squares[1])
        # the entry is at an angle before the defect's middle, the exit after it
        order = np.argsort(slope)
        angle = 0.5 * np.arctan2(2.0 * both, squares[0] - squares[1])[order]
        at = at[order]
        extent = float(abs(angle[1] - angle[0]))
    phases = 2.0 * math.pi * at / SAMPLES
    return _Knocks((float(phases[0]), float(phases[1])), extent is not None, extent, strength)


def _unpredicted(
    harmonics: NDArray[np.complex128], scatter: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Residual of a linear prediction of the mean pass, (SAMPLES, d)."""
    from scipy.linalg import solve_toeplitz  # imported late: see `spectrum`

    count = min(len(harmonics), SAMPLES // 2 - 1)
    size = np.abs(harmonics[:count]) ** 2
    noise = 2.0 * scatter[:count]
    clean = harmonics[:count] * np.maximum(1.0 - noise / np.maximum(size, 1e-300), 0.0)
    n = 2 * count + 2
    turn = np.exp(-2j * math.pi * np.arange(1, count + 1) / n)
    order = min(PREDICTED_FROM, count)
    left = np.zeros((SAMPLES // 2 + 1, harmonics.shape[1]), dtype=complex)
    for column in range(harmonics.shape[1]):
        power = np.zeros(n // 2 + 1)
        power[1 : count + 1] = np.abs(clean[:, column]) ** 2
        lags = np.fft.irfft(power, n)
        lags[0] = lags[0] * (1.0 + 1e-4) + 1e-300
        coefficients = solve_toeplitz(lags[:order], lags[1 : order + 1])
        factor = 1.0 - (turn[:, None] ** np.arange(1, order + 1)) @ coefficients
        left[1 : count + 1, column] = clean[:, column] * factor
    return np.fft.irfft(left, SAMPLES, axis=0) * SAMPLES


def _smoothed(values: NDArray[np.float64], width: float) -> NDArray[np.float64]:
    """Values around a ball pass, smoothed by a Gaussian of `width` samples."""
    frequency = np.fft.rfftfreq(len(values))
    window = np.exp(-2.0 * (math.pi * width * frequency) ** 2)
    return np.fft.irfft(np.fft.rfft(values) * window, len(values))
