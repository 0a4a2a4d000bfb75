"""Accelerations as a recorder takes them: nothing above half the sample rate folds back.

Acceleration jumps as balls touch, so that it has power far above half of any sample rate. Between
steps a motion is known by displacement, velocity and acceleration at both ends; the filter is
applied to the polynomial through them, exactly and without delay, before samples are taken:

    a_k = ∫ a(t) g(t_k − t) dt,    g(t) = windowed sinc,

which is a weighted sum of what was kept at the steps around t_k.
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
within 0.1 dB at the program's own steps (fan-rig, liew-lim, 6205, nu208, 7208-25deg; the 6203's
loudest direction within 0.14 dB). Fewer steps, set by hand, err by up to 0.25 dB near the end.
Above half the sample rate the filter leaves a thousandth of an amplitude."""

_CUTOFF, _ATTENUATION = 0.45, 60.0  # of the rate, and [dB]: Kaiser's window between 0.4 and 0.5
_BETA = 0.1102 * (_ATTENUATION - 8.7)
REACH = math.ceil((_ATTENUATION - 7.95) / (2.285 * 2.0 * math.pi * (0.5 - PASSED)) / 2.0)
"""Samples before and after a moment that its filtered acceleration takes part in."""

QUINTIC = 0.75
"""Weight of the quintic through x, v, a at both ends of a step; the rest has the cubic through x
and v. A jump within a step is made too sharp by the one and too smooth by the other: on the fan
rig they err by +0.12 and −0.3 dB at 0.4 of the step rate, and together by 0.04 dB."""

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
    (QUINTIC * five.deriv(2) + (1.0 - QUINTIC) * three.deriv(2))
    for five, three in zip(_QUINTIC, _CUBIC, strict=True)
]
"""Acceleration between the ends of a step of length 1, of x, v, a at its begin and at its end."""


def hermite_weights(fraction: Array, derivative: int, h: float) -> Array:
    """Quintic weights (n, 6) of x, v, a at both ends of a step of h [s], at fractions (n,) of it.

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
    """Frequency [Hz] up to which a sampled acceleration holds what the motion has."""
    return PASSED * min(sample_rate, step_rate)


PASSED_OF_ORBITS = 0.15
"""Share of the step rate for periodic motions: balls touch at the same place of a step each period,
and what is too sharp there and too smooth elsewhere does not average out as in a motion."""


def acceleration_lines(history: Array, body: int, step: float, count: int) -> Array:
    """Fourier coefficients 0 to count − 1, (count, directions), of a body's periodic acceleration.

    history (steps + 1, 6, directions) is a period in steps of `step` [s], its ends alike. The
    coefficients are those of the acceleration between steps, not of samples: nothing folds back,
    and they reach as far as `bandwidth` does.
    """
    steps = len(history) - 1
    number = np.arange(count)
    turn = 2j * math.pi * number / steps
    part, weight = _step_quadrature()
    waves = np.exp(-np.outer(turn, part)) * weight
    kept = history[:-1, body : body + 3] - history[0, body : body + 3] * np.array([[1.0], [0], [0]])
    sums = np.fft.fft(kept, axis=0)[number % steps] / steps
    lines = np.zeros((count, history.shape[2]), dtype=complex)
    for column, (polynomial, power) in enumerate(zip(_BETWEEN, _POWERS, strict=True)):
        moment = waves @ polynomial(part) * step ** (power - 2)
        if column >= 3:  # of the end of each step, the begin of the next
            moment = moment * np.exp(turn)
        lines += moment[:, None] * sums[:, column % 3]
    return lines


def _step_quadrature() -> tuple[Array, Array]:
    """Places in a step of length 1, and their weights in an integral over it."""
    part, weight = np.polynomial.legendre.leggauss(8)
    return 0.5 + 0.5 * part, 0.5 * weight


class _Filter(NamedTuple):
    """Weights (samples a step, rows, 3) of x, v, a in rows around a sample's step.

    `before` of the rows are before it; the next group of samples is `stride` rows on.
    """

    weights: Array
    before: int
    stride: int


@lru_cache(maxsize=32)
def _filter(sample_rate: float, step_rate: float) -> _Filter:
    """The filter of a history of one row a step; of both rates one is a multiple of the other."""
    a_step = max(round(sample_rate / step_rate), 1)
    stride = max(round(step_rate / sample_rate), 1)
    samples = sample_rate / step_rate  # in a step
    before = math.ceil(REACH / samples) + 1
    part, weight = _step_quadrature()
    step = np.arange(-before, before + 1)
    weights = np.zeros((a_step, len(step) + 1, 3))
    for phase in range(a_step):
        kept = _kernel((step[:, None] + part) * samples - phase) * weight * samples
        for number, (polynomial, power) in enumerate(zip(_BETWEEN, _POWERS, strict=True)):
            rows = slice(number // 3, number // 3 + len(step))  # of a step's begin, or of its end
            scale = step_rate ** (2 - power)
            weights[phase, rows, number % 3] += kept @ (polynomial(part) * scale)
    return _Filter(weights, before, stride)


def _kernel(time: Array) -> Array:
    """G at times in samples: a sinc in Kaiser's window."""
    inside = np.maximum(1.0 - (time / REACH) ** 2, 0.0)
    window = np.where(inside > 0.0, np.i0(_BETA * np.sqrt(inside)) / np.i0(_BETA), 0.0)
    return np.asarray(2.0 * _CUTOFF * np.sinc(2.0 * _CUTOFF * time) * window)


def rows_needed(n: int, sample_rate: float, step_rate: float) -> int:
    """Rows of a history that n filtered samples take: some beyond the last one."""
    a_step = max(round(sample_rate / step_rate), 1)
    kept = _filter(sample_rate, step_rate)
    return (n - 1) // a_step * kept.stride + kept.weights.shape[1] - kept.before


def low_passed(history: Array, body: int, n: int, sample_rate: float, step_rate: float) -> Array:
    """Accelerations (n, directions) of a body in a history (rows, 6, directions), one row a step.

    Up to PASSED of the sample rate they are those of the motion, from half of it on there is
    nothing. Before its first row the body rests. The history has `rows_needed` rows or ends there.
    body: 0 for the inner and 3 for the outer ring; NaN as far as the filter reaches from a row that
    is not finite.
    """
    kept = _filter(sample_rate, step_rate)
    a_step, taps = kept.weights.shape[:2]
    if not np.isfinite(history[0]).all():
        return np.full((n, history.shape[2]), math.nan)
    groups = -(-n // a_step)
    nd, stride, columns = history.shape[2], kept.stride, -(-taps // kept.stride)
    out = np.empty((groups, a_step, nd))
    rows = np.zeros((nd, 3 * stride, groups + columns))
    kernels.lay_side_by_side(history, body, kept.before, rows)
    padded = np.pad(kept.weights, ((0, 0), (0, columns * stride - taps), (0, 0)))
    joined = padded.reshape(a_step, columns, stride, 3).transpose(0, 3, 2, 1)
    weights = joined.reshape(a_step, 3 * stride, columns)
    for direction in range(nd):
        for phase in range(a_step):
            sums = np.zeros(groups)
            kernels.sliding_sums(rows[direction], weights[phase], sums)
            out[:, phase, direction] = sums
    return out.reshape(-1, nd)[:n]
