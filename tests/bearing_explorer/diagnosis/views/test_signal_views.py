"""What the Diagnosis tab draws of a signal over time and frequency."""

import dataclasses
import math
import re

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import diagnosis_of
from bearing_explorer.diagnosis.model import Model
from bearing_explorer.diagnosis.signal import Measured, Origin
from bearing_explorer.diagnosis.views.frequency_lines import (
    FAMILIES,
    MOST_LINES,
    NAME_WIDTH,
    ORDER_WIDTH,
    labelled,
    orders,
)
from bearing_explorer.diagnosis.views.frequency_view import Shown, shown_curve
from bearing_explorer.diagnosis.views.measured_envelope import MeasuredEnvelope, highest_line
from bearing_explorer.diagnosis.views.measured_spectrum import MeasuredSpectrum
from bearing_explorer.diagnosis.views.measurement import MeasuredSignal
from bearing_explorer.kit.serve.packed_source import PackedSource

from bearingcore import Recording, Spectrum, presets
from tests.helpers.measuring import at, measuring, signal

RIG = presets["fan-rig"]
MODEL = Model(RIG)


def view_of(kind, measured: Measured | None = None):
    made = kind(PackedSource())
    made.measure(measuring(measured))
    return made


# -- lines and their names -------------------------------------------------------------------------


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
@pytest.mark.parametrize("top", [100.0, 346.0, 2500.0, 12_000.0])
@pytest.mark.parametrize("first", [0.4, 2.878, 40.29, 57.7, 900.0])
def test_names_of_a_family_stand_clear_of_each_other(family, first, top):
    multiples = orders(family, first, top)
    assert (multiples * first <= top * (1.0 + 1e-9)).all()
    shown = labelled(multiples, first, top)
    assert set(shown) <= set(multiples)
    places = shown * first
    if len(shown):
        assert shown[0] == multiples[0]  # the one that says what the family is
    if len(shown) > 1:
        assert places[1] - places[0] >= NAME_WIDTH * top * (1.0 - 1e-9)
        assert np.diff(places[1:]).min(initial=math.inf) >= ORDER_WIDTH * top * (1.0 - 1e-9)


def test_a_peak_of_a_fine_spectrum_is_not_lost():
    frequency = np.arange(10 * MOST_LINES) * 0.01
    density = np.ones(frequency.size)
    density[12_345] = 100.0
    drawn = shown_curve(Spectrum(frequency, density), 1e9, 2.0, "linear")
    assert drawn["frequency"].size <= MOST_LINES
    assert drawn["amplitude"].max() == pytest.approx(20.0 * math.sqrt(3.0 * 0.01))
    assert drawn["frequency"][drawn["amplitude"].argmax()] == frequency[12_345]


def test_the_amplitude_of_a_tone_is_read_off():
    """In the unit of the file: 0.5 g of a sine are 0.5 g at its line, and -6 dB re 1 g."""
    time = np.arange(51_200) / 25_600.0
    tone = 0.5 * 9.80665 * np.sin(2.0 * math.pi * 3008.0 * time)  # on a line
    origin = Origin("a.csv", (0,), "g", 1.0)
    recording = Recording(tone[:, None], 25_600.0, ("y",))
    view = view_of(MeasuredSpectrum, Measured(recording, at(RIG), origin=origin))
    sources, ranges = view.all_data(MODEL)
    drawn = sources["measured_spectrum_measured"]
    assert drawn["amplitude"].max() == pytest.approx(20.0 * math.log10(0.5), abs=0.01)
    assert ranges["measured_spectrum_frequency"] == (0.0, 12_800.0)
    assert "at 3008 Hz (0.5 g)" in view.sentence(MODEL)
    view.look_changed("axis", "orders")
    view.look_changed("scale", "linear")
    sources, ranges = view.all_data(MODEL)
    assert sources["measured_spectrum_measured"]["amplitude"].max() == pytest.approx(0.5, rel=1e-3)
    assert ranges["measured_spectrum_frequency"][1] == pytest.approx(12_800.0 / 7.0)
    assert sources["measured_spectrum_turning"]["shaft"] == pytest.approx([1.0])


# -- spectrum and envelope -------------------------------------------------------------------------


def test_envelopes_are_taken_in_the_band_of_the_diagnosis():
    """Once it is there; before that where the kurtogram is highest."""
    measured = signal()
    view = view_of(MeasuredEnvelope, measured)
    assert "where the kurtogram is highest" in view.sentence(MODEL)
    question = view.measurement.question()
    diagnosis = diagnosis_of(question)
    view.measurement.diagnoses.keep(question, diagnosis)
    assert "the band of the diagnosis" in view.sentence(MODEL)
    shown = view.shown(MODEL, measured)
    assert shown.band[0] == diagnosis.spectrum.band.low
    assert shown.direction == diagnosis.spectrum.direction
    view.say(MODEL, "")
    again = view_of(MeasuredEnvelope, measured)
    again.choose(view.choices(), MODEL)  # as exported lines do, without a diagnosis
    assert again.shown(MODEL, measured).band == shown.band


@pytest.mark.parametrize(
    ("speed", "said"),
    [
        (7.0, r"is (2×)?(3×)?BPFO\."),
        (7.12, r"BPFO, 1\.[5-9] % below"),
        (8.7, "none of the bearing's"),
    ],
)
def test_the_envelope_says_what_knocks(speed, said):
    measured = Measured(signal().recording, at(RIG, 2.0 * math.pi * speed))
    view = view_of(MeasuredEnvelope, measured)
    sentence = view.sentence(MODEL)
    assert "where the kurtogram is highest" in sentence
    assert re.search(said, sentence), sentence


AT_29_5_HZ = {"bpfo": 105.4, "bpfi": 160.1, "bsf": 68.5, "ftf": 11.7, "shaft": 29.5}


@pytest.mark.parametrize(
    ("peak", "step", "fault", "said"),
    [
        (139.0, 0.6, "ball", r"is 2×BSF, 1\.6 % above the frequency by the geometry"),
        (318.0, 0.6, "", r"is 3×BPFO, 0\.57 % above"),
        (318.0, 0.6, "inner race", r"is 2×BPFI, 0\.69 % below"),
        (29.5, 0.6, "", r"is the shaft's turn\."),
        (82.0, 0.6, "ball", "none of the bearing's"),
        (None, 0.6, "ball", "No line stands out"),
        (150.0, 26.0, "", "may be BPFI or 2×BSF: lines here are 26 Hz apart"),
    ],
)
def test_the_highest_line_is_named_only_as_far_as_it_is_known(peak, step, fault, said):
    frequency = np.arange(0.0, 900.0, step)
    density = np.random.default_rng(2).exponential(size=frequency.size)
    if peak is not None:
        density[np.abs(frequency - peak).argmin()] = 1e4
    shown = Shown("y", 900.0, Spectrum(frequency, density), step, (2000.0, 4000.0))
    sentence = highest_line(shown, [AT_29_5_HZ], "g", 1.0, fault)
    assert re.search(said, sentence), sentence


def test_a_band_that_was_typed_is_that_of_no_other_file():
    view = view_of(MeasuredEnvelope, signal())
    view.look_changed("low", "1000")
    view.look_changed("high", "3000")
    assert "as chosen" in view.sentence(MODEL)
    recording = dataclasses.replace(signal().recording, name="another.csv")
    view.measure(
        view_of(MeasuredEnvelope, Measured(recording, at(RIG, 14.0 * math.pi))).measurement
    )
    assert "where the kurtogram is highest" in view.sentence(MODEL)
    view.say(MODEL, "")
    assert (view.look["low"], view.look["high"]) == ("", "")


def test_an_envelope_is_drawn_as_far_as_its_band_is_wide():
    view = view_of(MeasuredEnvelope, signal())
    view.look_changed("low", "2000")
    view.look_changed("high", "2050")
    _, ranges = view.all_data(MODEL)
    assert ranges["measured_envelope_frequency"] == (0.0, 50.0)
    assert "no lines above 50 Hz, the width of that band" in view.sentence(MODEL)


def test_a_band_of_ones_own_is_taken_and_an_impossible_one_told():
    view = view_of(MeasuredEnvelope, signal())
    view.look_changed("low", "1000")
    view.look_changed("high", "3 000 Hz")
    assert "between 1000 and 3000 Hz, as chosen" in view.sentence(MODEL)
    view.look_changed("low", "5000")
    with pytest.raises(ValueError, match="5000 to 3000 Hz is empty"):
        view.all_data(MODEL)
    view.look_changed("low", "")
    view.look_changed("high", "40000")
    with pytest.raises(ValueError, match="faster sample rate"):
        view.all_data(MODEL)
    view.look_changed("high", "")
    assert "where the kurtogram is highest" in view.sentence(MODEL)


@pytest.mark.parametrize("rate", [400.0, 1e6])
def test_odd_recordings_are_drawn_too(rate):
    """256 samples of noise, sampled far too slowly or too fast for this bearing."""
    noise = np.random.default_rng(3).standard_normal(256) * 1e-9
    measured = Measured(Recording(noise, rate, ("y",)), at(RIG))
    for kind in (MeasuredSignal, MeasuredSpectrum, MeasuredEnvelope):
        view = view_of(kind, measured)
        data, _ = view.all_data(MODEL)
        assert view.sentence(MODEL).endswith(".")
        assert any(column.size for columns in data.values() for column in columns.values())


# -- units ----------------------------------------------------------------------------------------


def test_a_signal_is_drawn_in_the_unit_of_its_file():
    """In g where the file has g, on an axis without a unit where that is not known."""
    known = dataclasses.replace(signal(), origin=Origin("a.csv", (1, 2), "g", 1.0))
    view = view_of(MeasuredSignal, known)
    view.say(MODEL, view.sentence(MODEL))
    assert [plot.yaxis[0].axis_label for plot in view.figures] == ["Acceleration a (g)"] * 2
    drawn = view.data(MODEL)[0]["measurement_all"]["y"]
    assert drawn.max() == pytest.approx(known.column("y").max() / 9.80665)
    origin = Origin("a.csv", (1, 2), "", 1.0)
    view = view_of(MeasuredSignal, dataclasses.replace(signal(), in_si=False, origin=origin))
    sentence = view.sentence(MODEL)
    view.say(MODEL, sentence)
    assert "m/s²" not in sentence
    for plot in view.figures:
        assert plot.yaxis[0].axis_label == "Value (units of the file)"
    assert list(view.table(MODEL)) == ["time_s", "signal_x", "signal_y"]
    assert "in_si=False" in view.python()
