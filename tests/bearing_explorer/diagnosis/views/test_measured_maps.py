"""Condition indicators, kurtogram and spectrogram of a measured signal."""

import math

import numpy as np
from bearing_explorer.diagnosis.machine import Machine
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured
from bearing_explorer.diagnosis.views.measured_indicators import MeasuredIndicators
from bearing_explorer.diagnosis.views.measured_kurtogram import CELLS, MeasuredKurtogram, picture
from bearing_explorer.diagnosis.views.measured_spectrogram import MeasuredSpectrogram
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import Recording, presets
from tests.helpers.measuring import measuring

MODEL = Model(presets["fan-rig"])
RATE = 6000.0
TIME = np.arange(int(8 * RATE)) / RATE
FIRST, LAST = 15.0, 35.0
"""[Hz] of a shaft that runs up evenly."""


def run_up(duration: float = 8.0, *, in_si: bool = True) -> Measured:
    """A tone at order 3.58 of that shaft in noise, with single knocks."""
    turns = FIRST * TIME + (LAST - FIRST) * TIME**2 / (2.0 * TIME[-1])
    signal = np.sin(2.0 * math.pi * 3.58 * turns)
    signal += 0.1 * np.random.default_rng(1).standard_normal(TIME.size)
    signal = signal[: round(duration * RATE)]
    recording = Recording(signal[:, None], RATE, ("y",))
    return Measured(recording, Machine(2.0 * math.pi * FIRST), in_si=in_si)


def view_of(kind: type[MeasuredView], measured: Measured | None) -> MeasuredView:
    view = kind(PackedSource())
    view.measure(measuring(measured))
    return view


def test_a_line_follows_the_speed_in_the_spectrogram():
    """From 3.58 times 15 Hz to 3.58 times 35 Hz."""
    table = view_of(MeasuredSpectrogram, run_up()).table(MODEL)
    columns = len(np.unique(table["time_s"]))
    frequency, level = (table[name].reshape(columns, -1) for name in ("frequency_hz", "level_db"))
    line = frequency[np.arange(columns), level.argmax(axis=1)]
    expected = 3.58 * np.linspace(FIRST, LAST, columns)
    assert np.abs(line - expected)[2:-2].max() < 2.0 * np.diff(frequency[0]).max()


def test_the_kurtogram_is_drawn_where_its_bands_are():
    measured = run_up()
    kurtogram = measured.kurtogram("y")
    cells = picture(kurtogram, 0.5 * RATE)
    middles = (np.arange(CELLS) + 0.5) * 0.5 * RATE / CELLS
    for band, kurtosis in zip(kurtogram.bands, kurtogram.kurtosis, strict=True):
        inside = (middles > band.low) & (middles < band.high)
        assert (cells[:, inside] == kurtosis).all(axis=1).any()
    view = view_of(MeasuredKurtogram, measured)
    (low,), (high,) = view.all_data(MODEL)[0]["kurtogram_band"].values()
    assert f"from {1e3 * low:.0f} to {1e3 * high:.0f} Hz" in view.sentence(MODEL)


def test_without_a_unit_there_is_neither_velocity_nor_zone():
    known, unknown = (view_of(MeasuredIndicators, run_up(in_si=si)) for si in (True, False))
    for view in (known, unknown):
        view.look_changed("machine", "medium, rigid")
        view.say(MODEL, view.sentence(MODEL))
    assert known.sentence(MODEL).startswith("Zone A of ISO 20816-3 with")
    assert "15 to 300 kW on a rigid support, boundaries 1.4, 2.8 and 4.5" in known.sentence(MODEL)
    assert "mm/s" in known._facts.object
    assert "unit of the signal is not known" in unknown.sentence(MODEL)
    assert "mm/s" not in unknown._facts.object
    assert not [name for name in unknown.table(MODEL) if "velocity" in name]
    assert "rms_as_in_file" in unknown.table(MODEL)
