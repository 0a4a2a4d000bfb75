"""Condition indicators of a measured signal, and its vibration severity, as facts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.measured_view import MeasuredView, named_columns, shown_unit
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.look_view import LookView
from bearing_explorer.kit.widgets.facts import Fact, facts_html, facts_pane
from bearing_explorer.kit.widgets.form import FieldSpec, stack
from bearingcore.measured.signals import DISPLACEMENT_ZONES, SHAFT_SPEEDS, ZONES, severity_zone

_WORDS = {
    "medium": "15 to 300 kW",
    "large": "over 300 kW",
    "rigid": "rigid",
    "flexible": "flexible",
}
MACHINE: FieldSpec = {
    "name": "machine",
    "label": "Machine and its support",
    "options": [
        ["", "needed for a zone"],
        *([name, ", ".join(_WORDS[part] for part in name.split(", "))] for name in ZONES),
    ],
}
HIGHEST = max(ends[-1] for ends in ZONES.values())
"""Velocity [m/s] above which a vibration is in zone D, whatever the machine."""

MEANING = {
    "A": "as of new machines",
    "B": "fit for long operation",
    "C": "not for long operation",
    "D": "may damage the machine",
}
"""Meaning of the zones of ISO 20816-3."""


class MeasuredIndicators(LookView, MeasuredView):
    """Root mean square, peak, crest factor, kurtosis, velocity and its zone."""

    name = "measured-indicators"
    title = "Condition indicators"
    about = (
        "Numbers of the whole signal. Crest factor and kurtosis rise with single knocks, which "
        "early damage makes, and may fall again as it grows; the velocity shows unbalance, "
        "misalignment and looseness. Its zones are those of ISO 20816-3, for machines above 15 kW "
        "and sensors on the bearing's housing."
    )
    look_fields = (MACHINE,)
    first_look: ClassVar[dict[str, Any]] = {"machine": ""}

    def build(self, packed: PackedSource) -> Any:
        self._facts = facts_pane(sizing_mode="stretch_width")
        self.hidden = stack(self.panel_of_look, self._facts, visible=False)
        return self.hidden

    def take_look(self, choices: Mapping[str, Any]) -> None:
        super().take_look(choices)
        self.measurement.machine_kind = self.look["machine"]

    def say(self, model: Model | None, sentence: str) -> None:
        super().say(model, sentence)
        if self.measured is not None:
            self._facts.object = facts_html(facts(self.measured))

    def words_of(self, model: Model, measured: Measured) -> str:
        return severity(measured, self.look["machine"])

    def columns_of(self, model: Model, measured: Measured) -> dict[str, np.ndarray]:
        return named_columns(measured.indicators.table(), measured.in_si)


def facts(measured: Measured) -> list[Fact]:
    """The numbers of a signal, for all its directions."""
    levels = measured.indicators
    unit, size = shown_unit(measured)

    def each(values: np.ndarray, words: str = "", digits: int = 3) -> str:
        several = len(levels.directions) > 1
        return ", ".join(
            f"{style.number(float(value), digits)}{f' {words}' if words else ''}"
            f"{f' along {along}' if several else ''}"
            for value, along in zip(values, levels.directions, strict=True)
        )

    listed = [
        Fact("Root mean square", each(levels.rms / size, unit)),
        Fact("Peak", each(levels.peak / size, unit)),
        Fact(
            "Crest factor", each(levels.crest_factor), "Peak over root mean square; 1.41: a sine."
        ),
        Fact("Kurtosis", each(levels.kurtosis), "1.5: a sine; 3: noise; more: knocks."),
    ]
    why = no_velocity(measured)
    words = f"not known: {why}" if why else each(1e3 * levels.velocity_rms, "mm/s")
    low, high = levels.band
    return [*listed, Fact(f"Velocity, {low:.0f} to {high:.0f} Hz, root mean square", words)]


def no_velocity(measured: Measured) -> str:
    """Reason why there is no velocity; empty where there is one."""
    if not measured.in_si:
        return "the unit of the signal is not known"
    return measured.indicators.velocity_reason


def zone_of(measured: Measured, machine: str) -> str:
    """The zone of the greatest velocity and displacement; empty where there is none."""
    if no_zone(measured, machine):
        return ""
    levels = measured.indicators
    velocity, displacement = float(levels.velocity_rms.max()), float(levels.displacement_rms.max())
    return severity_zone(velocity, machine, displacement) if machine else "D"


def no_zone(measured: Measured, machine: str) -> str:
    """Reason why there is no zone; empty where there is one."""
    why = no_velocity(measured)
    speed = measured.shaft_speed
    if not why and speed is None:
        unknown = "the number of tachometer pulses per turn is not known"
        why = "the shaft speed is not known" if measured.speeds is None else unknown
        why += ", and the band of the velocity depends on it"
    shaft = 0.0 if speed is None else speed / (2.0 * math.pi)
    if not why and not SHAFT_SPEEDS[0] <= shaft <= SHAFT_SPEEDS[1]:
        why = "the standard is for 120 to 30 000 rpm"
    if not why and not machine and float(measured.indicators.velocity_rms.max()) <= HIGHEST:
        why = "power and support of the machine are not known"
    return why


def severity(measured: Measured, machine: str) -> str:
    """Return words on the zone of the greatest velocity, or the reason why there is none."""
    if why := no_zone(measured, machine):
        return f"No zone of ISO 20816-3: {why}."
    velocity, zone = float(measured.indicators.velocity_rms.max()), zone_of(measured, machine)
    if not machine:
        return (
            "Zone D of ISO 20816-3 for every machine, with "
            f"{style.number(1e3 * velocity, 3)} mm/s: {MEANING[zone]}. "
            f"The highest boundary, {style.number(1e3 * HIGHEST, 3)} mm/s, is from its "
            "predecessor ISO 10816-3:2009; check it in ISO 20816-3 before you act on it."
        )
    power, support = (_WORDS[part] for part in machine.split(", "))
    size = f"{style.number(1e3 * velocity, 3)} mm/s"
    ends = f"{style.list_words([style.number(1e3 * end, 3) for end in ZONES[machine]])} mm/s"
    displacement = 1e6 * float(measured.indicators.displacement_rms.max())
    if zone != severity_zone(velocity, machine):
        size += f" and {style.number(displacement, 3)} µm"
        limits = [style.number(1e6 * end, 3) for end in DISPLACEMENT_ZONES[machine]]
        ends += f" and {style.list_words(limits)} µm, the worse of which counts,"
    return (
        f"Zone {zone} of ISO 20816-3 with {size}: {MEANING[zone]}. For "
        f"machines of {power} on a {support} support, boundaries {ends} from its predecessor "
        "ISO 10816-3:2009; check them in ISO 20816-3 before you act on them."
    )
