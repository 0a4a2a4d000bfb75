"""Plans of the scene at hand: how they are made, and how a person overrules them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from bearing_explorer.state.settings import MotionPlanning, Settings
from bearingcore import Scene, orbit
from bearingcore.dynamics.modes import highest_natural_frequency
from bearingcore.plan import BUDGETS, CURVES, SETTLED, Plan, plan
from bearingcore.plan.motions import ORBIT_SAFETY
from bearingcore.plan.pilot import BAND, PILOT, spectra_apart
from bearingcore.scene.scene import WITH_MASS


def plan_for(scene: Scene, view: str, how: float | MotionPlanning) -> Plan:
    """The plan for a view; `how` is a budget, or for motions what `Settings.planning` says.

    ValueError where the scene has no such motion, or the steps set by hand do not fit.
    """
    if not isinstance(how, MotionPlanning):
        return plan(scene, view, how)
    made = plan(
        scene,
        view,
        how.budget,
        duration=0.5 * how.duration,
        sample_rate=how.sample_rate,
        step_rate=how.step_rate,
        march=how.steady == "march",
        up_to=how.up_to,
    )
    return _with_orbit(made, how) if how.steady == "orbit" and made.orbit is None else made


def _with_orbit(made: Plan, how: MotionPlanning) -> Plan:
    """The plan with the orbit that was asked for by hand, held against one in half the steps."""
    if made.scene.balls == WITH_MASS:
        note = "marched, as an orbit is looked for with massless balls only"
        return dataclasses.replace(made, note="; ".join(filter(None, (note, made.note))))
    found = orbit(made.scene, step_rate=how.step_rate)
    if not found.stable:
        return dataclasses.replace(made, note=f"marched, as there is no orbit: {found.status}")
    steps = len(found.history) - 1
    finer = orbit(made.scene, start=found, step_rate=2.0 * steps / found.period)
    error = math.inf
    if finer.stable:
        time = np.arange(round(PILOT * how.sample_rate)) / how.sample_rate
        signals = found.outer_acceleration(time), finer.outer_acceleration(time)
        band = BAND * highest_natural_frequency(made.scene)
        error = ORBIT_SAFETY * spectra_apart(*signals, how.sample_rate, band)
    a_call = made.seconds / max(made.evaluations, 1)
    return dataclasses.replace(
        made,
        orbit=found,
        step_rate=steps / found.period,
        tolerance=math.nan,
        drop=0.0,
        predicted_error=error,
        met=error <= made.error_budget,
        evaluations=found.right_hand_side_calls,
        seconds=a_call * found.right_hand_side_calls,
        note="",
    )


# --- the choice of a person -----------------------------------------------------------------------

_CURVE_BUDGETS = {"0.02": "2 % of their swing", "0.005": "0.5 %", "0.001": "0.1 %"}
_VIBRATION_BUDGETS = {"0.5": "0.5 dB", "0.1": "0.1 dB", "0.02": "0.02 dB"}

CHOICES: dict[str, tuple[str, dict[str, str]]] = {
    "curve_budget": ("Error of curves", _CURVE_BUDGETS),
    "cage_angles": (
        "Cage angles",
        {"": "automatic", **{str(n): f"{n} equally spaced" for n in (31, 61, 121, 361, 721)}},
    ),
    "vibration_budget": ("Error of spectra", _VIBRATION_BUDGETS),
    "step_rate": (
        "Steps of motions",
        {"": "automatic", **{str(2**k): f"{2**k / 1e3:.3g} kHz" for k in range(14, 19)}},
    ),
    "steady": (
        "Settled vibration",
        {"auto": "automatic", "orbit": "periodic orbit", "march": "marched motion"},
    ),
    "balls_up_to": (
        "Balls of settled vibration",
        {
            "": "as the scene has them",
            **{
                str(int(f)): f"with mass if asked for below {f / 1e3:g} kHz"
                for f in (2500.0, 5e3, 1e4, 2e4)
            },
        },
    ),
}
"""What can be chosen by hand, as the browser shows it: {name: (label, {value: words})}."""

_USUAL = {
    "curve_budget": f"{BUDGETS[CURVES[0]]:g}",
    "cage_angles": "",
    "vibration_budget": f"{BUDGETS[SETTLED]:g}",
    "step_rate": "",
    "steady": "auto",
    "balls_up_to": "",
}


def chosen(settings: Settings) -> dict[str, str]:
    """The values of CHOICES that settings stand for."""
    curve, vibration = settings.curve_budget, settings.vibration_budget
    return {
        "curve_budget": _USUAL["curve_budget"] if curve is None else f"{curve:g}",
        "cage_angles": "" if settings.cage_angles is None else str(settings.cage_angles),
        "vibration_budget": _USUAL["vibration_budget"] if vibration is None else f"{vibration:g}",
        "step_rate": "" if settings.step_rate is None else f"{settings.step_rate:.0f}",
        "steady": settings.steady,
        "balls_up_to": "" if settings.balls_up_to is None else f"{settings.balls_up_to:.0f}",
    }


def with_choices(settings: Settings, message: Mapping[Any, Any]) -> Settings:
    """Settings with choices of the browser, which is not to be trusted; `own` gives all back."""
    if message.get("own") is True:
        return dataclasses.replace(
            settings,
            cage_angles=None,
            step_rate=None,
            steady="auto",
            curve_budget=None,
            vibration_budget=None,
            balls_up_to=None,
        )
    fields: dict[str, Any] = {}
    for name, (_, options) in CHOICES.items():
        value = message.get(name)
        if not isinstance(value, str) or value not in options:
            continue
        if value == _USUAL[name]:
            fields[name] = "auto" if name == "steady" else None
        elif name == "steady":
            fields[name] = value
        else:
            fields[name] = int(value) if name == "cage_angles" else float(value)
    return dataclasses.replace(settings, **fields)


def by_hand(settings: Settings) -> list[str]:
    """What is not the program's own choice, in words."""
    words = []
    if settings.curve_budget is not None:
        words.append(f"error of curves set by hand: {100.0 * settings.curve_budget:g} %")
    if settings.cage_angles is not None:
        words.append(f"cage angles set by hand: {settings.cage_angles}")
    if settings.vibration_budget is not None:
        words.append(f"error of spectra set by hand: {settings.vibration_budget:g} dB")
    if settings.steady != "auto":
        words.append(f"{CHOICES['steady'][1][settings.steady]} set by hand")
    if settings.step_rate is not None:
        words.append(steps_by_hand(settings.step_rate))
    if settings.balls_up_to is not None:
        words.append(f"balls {CHOICES['balls_up_to'][1][f'{settings.balls_up_to:.0f}']}")
    return words


def steps_by_hand(step_rate: float) -> str:
    """That the steps [Hz] of motions are not the program's own choice."""
    return f"steps set by hand: {step_rate:.0f} Hz"
