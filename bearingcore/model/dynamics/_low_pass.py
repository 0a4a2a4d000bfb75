"""Accelerations as a recorder takes them: filtered, so that no high frequencies fold back.

Acceleration jumps when balls touch, so it has power far above half of any sample rate. Between the
ends of a step a polynomial follows from displacement, velocity and acceleration at both ends. The
filter is applied to this polynomial, exactly and without delay, before samples are taken:

    a_k = ∫ a(t) g(t_k − t) dt,    g(t) = windowed sinc,

which is a weighted sum of the numbers kept at the steps around t_k.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial

from bearingcore.common import Array
from bearingcore.model import _kernels as kernels

PASSED = 0.4
"""Share of the sample rate, and of the step rate, up to which spectra of accelerations are right
within 0.1 dB at the default steps (fan-rig, liew-lim, 6205, nu208, 7208-25deg; the 6203's loudest
direction within 0.14 dB). Fewer steps, set by hand, have errors up to 0.25 dB near this frequency.
Above half the sample rate the filter leaves a thousandth of an amplitude."""

# share of the sample rate, and [dB]: the filter's gain falls between 0.4 and 0.5 of the rate
_CUTOFF, _ATTENUATION = 0.45, 60.0
_BETA = 0.1102 * (_ATTENUATION - 8.7)
REACH = math.ceil((_ATTENUATION - 7.95) / (2.285 * 2.0 * math.pi * (0.5 - PASSED)) / 2.0)
"""Number of samples before and after a moment over which its acceleration is spread."""

QUINTIC = 0.75
"""Weight of the quintic through x, v, a at both ends of a step; the cubic through x and v has the
rest. The quintic makes a jump within a step too sharp, the cubic too smooth: on the fan rig their
errors are +0.12 and −0.3 dB at 0.4 of the step rate, and 0.04 dB together."""

_POWERS = (0, 1, 2, 0, 1, 2)
_QUINTIC = [
    Polynomial(coefficients)
    for coefficients in (
        [1, 0, 0, -10, 15, -6],
        [0, 1, 0, -6, 8, -3],
        [0, 0, 0.5, -1.5, 1.5, -0.5],
        [0, 0, 0, 10, -15, 6],
        [0, 0, 0, -4, 7, -3],
        [0, 0, 0, 0.5, -1, 0.5],
    )
]
_CUBIC = [
    Polynomial(coefficients)
    for coefficients in ([1, 0, -3, 2], [0, 1, -2, 1], [0], [0, 0, 3, -2], [0, 0, -1, 1], [0])
]
_BETWEEN = [
    (QUINTIC * quintic.deriv(2) + (1.0 - QUINTIC) * cubic.deriv(2))
    for quintic, cubic in zip(_QUINTIC, _CUBIC, strict=True)
]
"""Acceleration within a step of length 1, for a unit of x, v, a at its start and at its end."""


def hermite_weights(fraction: Array, derivative: int, h: float) -> Array:
    """Return quintic weights (n, 6) of x, v, a at both ends of a step of h [s], at fractions (n,).

    `derivative` 0, 1, 2 gives displacement, velocity, acceleration.
    """
    return np.stack(
        [
            (p.deriv(derivative) if derivative else p)(fraction) * h ** (power - derivative)
            for p, power in zip(_QUINTIC, _POWERS, strict=True)
        ],
        axis=1,
    )


def bandwidth(sample_rate: float, step_rate: float) -> float:
    """Return the frequency [Hz] up to which a sampled acceleration is complete."""
    return PASSED * min(sample_rate, step_rate)


PASSED_OF_ORBITS = 0.15
"""Share of the step rate for periodic motions. Balls touch at the same place of a step in each
period, so that jumps too sharp and too smooth do not average out as in other motions."""


def acceleration_lines(history: Array, body: int, step: float, count: int) -> Array:
    """Return Fourier coefficients (count, directions) of a body's periodic acceleration, from 0 on.

    history (steps + 1, 6, directions) is a period in steps of `step` [s], with equal ends. The
    coefficients belong to the polynomials within steps, not to samples, so nothing folds back.
    """
    steps = len(history) - 1
    number = np.arange(count)
    turn = 2j * math.pi * number / steps
    part, weight = _step_quadrature()
    waves = np.exp(-np.outer(turn, part)) * weight
    first = history[0, body : body + 3] * np.array([[1.0], [0], [0]])  # constant: no acceleration
    sums = np.fft.fft(history[:-1, body : body + 3] - first, axis=0)[number % steps] / steps
    lines = np.zeros((count, history.shape[2]), dtype=complex)
    for column, (polynomial, power) in enumerate(zip(_BETWEEN, _POWERS, strict=True)):
        moment = waves @ polynomial(part) * step ** (power - 2)
        if column >= 3:  # numbers at the end of a step are those at the start of the next
            moment = moment * np.exp(turn)
        lines += moment[:, None] * sums[:, column % 3]
    return lines


def _step_quadrature() -> tuple[Array, Array]:
    """Return Gauss-Legendre places in a step of length 1, and their weights in an integral."""
    part, weight = np.polynomial.legendre.leggauss(8)
    return 0.5 + 0.5 * part, 0.5 * weight


class _Filter(NamedTuple):
    """Weights (phases, rows, 3) of x, v, a around a sample, for each phase of samples in a step.

    `before` of the rows precede the step; the next group of samples is `stride` rows later.
    """

    weights: Array
    before: int
    stride: int


@lru_cache(maxsize=32)
def _filter(sample_rate: float, step_rate: float) -> _Filter:
    """Return the filter of a history with a row per step; one rate is a multiple of the other."""
    phases = max(round(sample_rate / step_rate), 1)
    stride = max(round(step_rate / sample_rate), 1)
    samples = sample_rate / step_rate  # in a step
    before = math.ceil(REACH / samples) + 1
    part, weight = _step_quadrature()
    step = np.arange(-before, before + 1)
    weights = np.zeros((phases, len(step) + 1, 3))
    for phase in range(phases):
        weighted = _kernel((step[:, None] + part) * samples - phase) * weight * samples
        for number, (polynomial, power) in enumerate(zip(_BETWEEN, _POWERS, strict=True)):
            rows = slice(number // 3, number // 3 + len(step))  # the start of steps, or their end
            scale = step_rate ** (2 - power)
            weights[phase, rows, number % 3] += weighted @ (polynomial(part) * scale)
    return _Filter(weights, before, stride)


def _kernel(time: Array) -> Array:
    """Return g at times in samples: a sinc in Kaiser's window."""
    inside = np.maximum(1.0 - (time / REACH) ** 2, 0.0)
    window = np.where(inside > 0.0, np.i0(_BETA * np.sqrt(inside)) / np.i0(_BETA), 0.0)
    return np.asarray(2.0 * _CUTOFF * np.sinc(2.0 * _CUTOFF * time) * window)


def rows_needed(n: int, sample_rate: float, step_rate: float) -> int:
    """Return the number of rows that n filtered samples need, with those after the last sample."""
    phases = max(round(sample_rate / step_rate), 1)
    low_pass = _filter(sample_rate, step_rate)
    return (n - 1) // phases * low_pass.stride + low_pass.weights.shape[1] - low_pass.before


def low_passed(history: Array, body: int, n: int, sample_rate: float, step_rate: float) -> Array:
    """Return filtered accelerations (n, directions) of a body from a history (rows, 6, directions).

    They are complete up to PASSED of the sample rate, and zero from half of it on. The history has
    a row for each step, at most `rows_needed` rows; the body rests before the first one. body: 0
    for the inner and 3 for the outer ring. Samples within reach of a row that is not finite are
    NaN.
    """
    low_pass = _filter(sample_rate, step_rate)
    phases, taps = low_pass.weights.shape[:2]
    if not np.isfinite(history[0]).all():
        return np.full((n, history.shape[2]), math.nan)
    groups = -(-n // phases)
    nd, stride, columns = history.shape[2], low_pass.stride, -(-taps // low_pass.stride)
    out = np.empty((groups, phases, nd))
    rows = np.zeros((nd, 3 * stride, groups + columns))
    kernels.lay_side_by_side(history, body, low_pass.before, rows)
    # weights (phases, 3 stride, columns) in the order in which `lay_side_by_side` puts the rows
    padded = np.pad(low_pass.weights, ((0, 0), (0, columns * stride - taps), (0, 0)))
    joined = padded.reshape(phases, columns, stride, 3).transpose(0, 3, 2, 1)
    weights = joined.reshape(phases, 3 * stride, columns)
    for direction in range(nd):
        for phase in range(phases):
            sums = np.zeros(groups)
            kernels.sliding_sums(rows[direction], weights[phase], sums)
            out[:, phase, direction] = sums
    return out.reshape(-1, nd)[:n]
