"""Indicators and pictures of signals that are known by closed form, and files of other writers."""

import io
import math
import sys
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from scipy.io import savemat, wavfile
from scipy.signal import freqs

from bearingcore import (
    Bearing,
    Recording,
    indicators,
    kurtogram,
    presets,
    read_catalogue,
    read_table,
    to_ross,
    trend,
    trend_point,
)
from bearingcore.measured.signals import average_passes, spectrogram
from bearingcore.measured.signals._dropouts import signal_faults
from bearingcore.model.dynamics import Resonance
from bearingcore.model.dynamics._record import TWO_RESONANCES
from bearingcore.recordings._spectrum_difference import spectrum_difference
from bearingcore.sizing import LINES
from tests.outside.elements import Array
from tests.outside.test_kinds import CASES
from tests.outside.witness import witness

RATE = 12_000.0
TIME = np.arange(24_000) / RATE
TURN = 2.0 * math.pi


def wave(frequency: float, size: float = 1.0, phase: float = 0.0) -> Array:
    return size * np.sin(TURN * frequency * TIME + phase)


@witness(
    "function: indicators", "signal: indicators", "indicator: rms", "indicator: peak",
    "indicator: crest_factor", "indicator: kurtosis",
    by="closed form: a sine, two sines, a burst", compared="root mean square, peak, crest factor",
    within=1e-3,
)  # fmt: skip
def test_indicators() -> None:
    """A sine: A/√2, A, √2, 3/2. Two alike of other frequencies: A, 2 A, 2, 9/4."""
    burst = np.where(TIME < 0.02, 5.0, 0.0) * np.sign(wave(600.0, 1.0, 1.0))
    signal = np.stack([wave(100.0, 3.0), wave(100.0) + wave(1050.5)], axis=1)
    levels = indicators(Recording(signal, RATE, ("x", "y")))
    assert levels.rms == pytest.approx([3.0 / math.sqrt(2.0), 1.0], rel=1e-3)
    assert levels.peak == pytest.approx([3.0, 2.0], rel=2e-3)
    assert levels.crest_factor == pytest.approx([math.sqrt(2.0), 2.0], rel=2e-3)
    assert levels.kurtosis == pytest.approx([1.5, 2.25], rel=1e-3)
    once = indicators(Recording(burst[:, None], RATE, ("y",)))
    assert once.kurtosis[0] == pytest.approx(100.0, rel=1e-3)  # of a hundredth of the time
    assert once.rms[0] == pytest.approx(0.5, rel=1e-3)


@witness(
    "function: kurtogram", "signal: kurtogram",
    by="closed form: (1 + m cos)² has 1 + 3 m² + 3 m⁴/8 over (1 + m²/2)² as its second moment",
    compared="kurtosis of a modulated tone in bands that hold it, of a steady one, of noise",
    within=0.02,
)  # fmt: skip
@pytest.mark.parametrize("m", [0.0, 0.5, 1.0])
def test_kurtosis_of_modulated_tones(m: float) -> None:
    noise = 1e-4 * np.random.default_rng(1).standard_normal(TIME.size)
    chart = kurtogram((1.0 + m * np.cos(TURN * 40.0 * TIME)) * wave(2250.0) + noise, RATE)
    own = (1.0 + 3.0 * m**2 + 0.375 * m**4) / (1.0 + 0.5 * m**2) ** 2 - 2.0
    holding = [low < 2100.0 and high > 2400.0 for low, high in chart.bands]
    assert sum(holding) >= 5
    assert chart.kurtosis[holding] == pytest.approx(own, abs=0.02)
    empty = [low > 3000.0 and high - low > 700.0 for low, high in chart.bands]
    assert np.abs(chart.kurtosis[empty]).max() < 0.3


@witness(
    "function: kurtogram", "signal: kurtogram",
    by="scatter over 60 signals of noise", compared="deviation in bands of eight widths",
    within=0.12,
)  # fmt: skip
def test_kurtosis_of_noise_scatters_as_said() -> None:
    noise = np.random.default_rng(7).standard_normal((60, 2**14))
    charts = [kurtogram(one, RATE) for one in noise]
    ratio = np.std([one.kurtosis for one in charts], axis=0) / charts[0].deviation
    for parts in np.unique(charts[0].parts):
        own = ratio[charts[0].parts == parts]
        within = 0.12 + 0.3 / math.sqrt(own.size)  # sixty signals know a deviation to a tenth
        assert math.sqrt(np.mean(own**2)) == pytest.approx(1.0, abs=within)


@witness(
    "signal: spectrogram",
    by="closed form: a chirp from 1 to 4 kHz, power A²/2", compared="its line and power in time",
    within=0.01,
)  # fmt: skip
def test_spectrogram_of_a_chirp() -> None:
    chirp = 2.0 * np.sin(TURN * (1000.0 * TIME + 0.5 * 1500.0 * TIME**2))
    time, frequency, density = spectrogram(chirp, RATE, 50.0)
    power = density if density.shape == (time.size, frequency.size) else density.T
    line = (power * frequency).sum(axis=1) / power.sum(axis=1)
    assert line == pytest.approx(1000.0 + 1500.0 * time, rel=0.01)
    assert power.sum(axis=1) * frequency[1] == pytest.approx(2.0, rel=0.01)


@witness(
    "signal: average_passes",
    by="closed form: cosines at harmonics of a known frequency",
    compared="ball-pass frequency, amplitude of harmonics", within=0.01,
)  # fmt: skip
def test_averages_over_passes() -> None:
    passing = 107.36
    signal = sum(wave(k * passing, a, k) for k, a in ((2, 1.0), (3, 0.7), (5, 0.4)))
    noise = 0.3 * np.random.default_rng(2).standard_normal(TIME.size)
    passes = average_passes((signal + noise)[:, None], RATE, 107.0, 0.02, 150.0, 1000.0, 1200.0)
    assert passes.frequency == pytest.approx(passing, rel=2e-4)
    sizes = 2.0 * np.abs(passes.harmonics[:, 0])
    assert sizes[[1, 2, 4]] == pytest.approx([1.0, 0.7, 0.4], abs=0.01 + 0.3 / math.sqrt(200.0))


@witness(
    "signal: signal_faults", "signal: spectrum_difference",
    by="closed form: runs put in, a factor of the amplitude",
    compared="share of dropped samples and of clipped ones; 20 log10 of the factor", within=1e-9,
)  # fmt: skip
def test_faults_and_differences() -> None:
    noise = np.random.default_rng(3).standard_normal(TIME.size)
    held = noise.copy()
    held[1000:1240] = held[1000]
    assert signal_faults(held).dropped_share == pytest.approx(0.01, rel=1e-9)
    limit = 1.5
    clipped = np.clip(noise, -limit, limit)
    beyond = np.abs(noise) >= limit
    alone = beyond & ~np.roll(beyond, 1) & ~np.roll(beyond, -1)  # one sample at the rail is none
    share = signal_faults(clipped).clipped_share
    same_side = np.abs(np.diff(clipped)) == 0.0
    pairs = np.zeros(TIME.size, dtype=bool)
    pairs[1:] |= same_side
    pairs[:-1] |= same_side
    assert share == pytest.approx((beyond & pairs & ~alone).mean(), rel=1e-9)
    both = np.stack([noise, noise], axis=1)
    apart = spectrum_difference(1.1 * both, both, RATE, 3000.0)
    assert apart == pytest.approx(20.0 * math.log10(1.1), rel=1e-9)


@witness(
    "function: trend", "function: trend_point",
    by="closed form: a tone of 3 kHz whose square swells with BPFO",
    compared="amplitude of the outer race's line in the envelope, root mean square", within=0.02,
)  # fmt: skip
def test_trends() -> None:
    bearing, speed = presets["6205"].bearing, TURN * 25.0
    bpfo = 9 * 0.5 * 25.0 * (1.0 - 7.94 / 39.04)
    recordings = []
    for depth in (0.2, 0.5):
        swell = 2.0 * (1.0 + depth * np.cos(TURN * bpfo * TIME))
        recordings.append(Recording((swell * wave(3000.0))[:, None], RATE, ("y",)))
    history = trend(recordings, bearing, speed, band=(2500.0, 3500.0))
    outer = history.column("lines")[:, LINES.index("bpfo")]
    assert outer == pytest.approx([0.4, 1.0], rel=0.02)
    rms = [math.sqrt(2.0 * (1.0 + 0.5 * depth**2)) for depth in (0.2, 0.5)]
    assert history.column("rms") == pytest.approx(rms, rel=1e-3)
    one = trend_point(recordings[1], bearing, speed, "y", (2500.0, 3500.0))
    assert one.lines[LINES.index("bpfo")] == pytest.approx(1.0, rel=0.02)
    # five vanes beside the 4.98 turns of an outer race
    ball = 8e-3
    near = Bearing.from_drawing(12, ball, ball / 0.17, 0.52 * ball, 0.52 * ball, contact_angle=0.0)
    vanes = 2.0 * (1.0 + 0.3 * np.cos(TURN * 5.0 * 25.0 * TIME))
    sound = Recording((vanes * wave(3000.0))[:, None], RATE, ("y",))
    seen = trend_point(sound, near, speed, "y", (2500.0, 3500.0))
    assert np.isnan(seen.lines[LINES.index("bpfo")])


@witness(
    "function: read_table",
    by="files written by SciPy (MATLAB, WAV), h5py and NumPy",
    compared="every sample", within=1e-7,
)  # fmt: skip
@pytest.mark.parametrize("kind", ["mat", "wav", "h5", "csv"])
def test_files_of_other_writers(kind: str) -> None:
    signal, file = np.stack([wave(100.0, 0.5), wave(333.0, 0.25)], axis=1)[:3000], io.BytesIO()
    if kind == "mat":
        savemat(file, {"X_DE_time": signal[:, :1], "Y_DE_time": signal[:, 1:]})
    elif kind == "wav":
        wavfile.write(file, 12_000, signal.astype(np.float32))
    elif kind == "h5":
        with h5py.File(file, "w") as made:
            made["x"], made["y"] = signal.T
    else:
        np.savetxt(file, signal, "%.9e", ",", header="x,y", comments="")
    table = read_table(f"signal.{kind}", file.getvalue())
    assert np.asarray(table.columns) == pytest.approx(signal, abs=1e-7)


@witness(
    "function: read_catalogue",
    by="numbers written into a table here, frequencies of rolling without sliding",
    compared="balls, diameters and BPFO of an entry", within=1e-9,
)  # fmt: skip
def test_a_catalogue_of_ones_own() -> None:
    head = "name,balls,ball_diameter_mm,pitch_diameter_mm,contact_angle_deg\n"
    (entry,) = read_catalogue(head + "own,9,7.94,39.04,0\n").values()
    assert (entry.bearing.n_balls, entry.bearing.ball_diameter) == (9, pytest.approx(7.94e-3))
    own = 4.5 * (1.0 - 7.94 / 39.04)
    assert entry.bearing.bpfo(TURN) == pytest.approx(own, rel=1e-9)


@witness(
    "function: to_ross",
    by="mean stiffness of `elements.py` over 25 cage angles",
    compared="k_xx and k_yy that ROSS is given for a 6205 at rest", within=5e-3,
)  # fmt: skip
def test_the_bearing_that_ross_is_given(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(
        sys.modules, "ross", SimpleNamespace(BearingElement=SimpleNamespace, __version__="2.0")
    )
    case = CASES["ball"]
    rows = type(case.rows)(**{**vars(case.rows), "defect": None})
    cage = np.arange(72) * 2.0 * math.pi / 9 / 72
    _, stiffness = rows.curves(case.force, cage, case.free)
    bearing = to_ross(case.scene.healthy(), [0.0])
    assert bearing.kyy[0] == pytest.approx(stiffness[:, 1, 1].mean(), rel=5e-3)
    assert bearing.kxx[0] == pytest.approx(stiffness[:, 0, 0].mean(), rel=5e-3)


@pytest.mark.parametrize("one", TWO_RESONANCES)
def test_resonances_of_the_path_of_a_simulated_record(one: Resonance) -> None:
    """SciPy's freqs of an oscillator with one degree of freedom, in its damper's force."""
    frequency = np.array([0.1, 0.5, 0.98, 1.0, 1.02, 3.0]) * one.frequency
    w, damper = 2.0 * math.pi * one.frequency, 4.0 * math.pi * one.frequency * one.damping
    _, known = freqs([damper, 0.0], [1.0, damper, w * w], worN=2.0 * math.pi * frequency)
    assert one.transfer(frequency) == pytest.approx(known, rel=1e-9)
