"""What mean passes of several bands say together: made of bumps, without a signal."""

import math

import numpy as np
import pytest

from bearingcore.measured.diagnosis import ExtentStatus, MeanPass
from bearingcore.measured.diagnosis._extent.knocks import PLACES, compare_bands, two_peaks
from bearingcore.measured.signals._filter_bank import Band

FREQUENCY = 50.0
BANDS = (Band(200.0, 4000.0), Band(4000.0, 8000.0), Band(8000.0, 16_000.0), Band(200.0, 16_000.0))


def mean_pass(band: Band, *bumps: tuple[float, float], error: float = 0.002) -> MeanPass:
    """Bumps as (place, height), on a ball pass of length 1."""
    place = np.arange(PLACES) / PLACES
    envelope = np.zeros(PLACES)
    for at, height in bumps:
        envelope += height * np.exp(-0.5 * (((place - at + 0.5) % 1.0 - 0.5) / 0.008) ** 2)
    return MeanPass(band, "y", envelope, error)


def seen(*passes: MeanPass):
    return compare_bands(passes, FREQUENCY, 200)


def test_two_knocks_are_where_bands_show_them_at_the_same_places():
    knocks = seen(*(mean_pass(band, (0.3, 1.0), (0.4, 1.0)) for band in BANDS))
    assert knocks.status == ExtentStatus.MEASURED
    assert knocks.separation == pytest.approx(0.1, abs=0.002)
    # as far apart, but elsewhere in half of the bands: three lumps of which each shows two
    train = [mean_pass(band, (0.3, 1.0), (0.4, 1.0)) for band in BANDS[:2]]
    train += [mean_pass(band, (0.4, 1.0), (0.5, 1.0)) for band in BANDS[2:]]
    assert seen(*train).status == ExtentStatus.UNCLEAR


def test_bands_of_one_frequency_do_not_count():
    nested = [mean_pass(Band(200.0, high), (0.3, 1.0), (0.4, 0.5)) for high in (4e3, 8e3, 16e3)]
    assert seen(*nested).status == ExtentStatus.UNCLEAR


def test_a_train_of_peaks_speaks_against_two_knocks():
    pairs = [
        mean_pass(band, (0.3, 1.0), (0.4, high))
        for band, high in zip(BANDS[:2], (0.6, 1.0), strict=True)
    ]
    trains = [mean_pass(band, (0.3, 1.0), (0.4, 0.9), (0.5, 0.8)) for band in BANDS[:2]]
    assert two_peaks(trains[0], FREQUENCY).third > 0.6
    assert seen(*pairs).status == ExtentStatus.MEASURED
    assert seen(*pairs, *trains).status == ExtentStatus.UNCLEAR


def test_a_release_may_fade_above_the_bands_that_show_it():
    """Silent high bands are not asked; silent bands among those that show it are."""
    low = [mean_pass(BANDS[0], (0.3, 0.8), (0.4, 1.0)), mean_pass(BANDS[1], (0.3, 0.4), (0.4, 1.0))]
    silent = [mean_pass(Band(low, low + 2000.0), (0.4, 1.0)) for low in (9e3, 11e3, 13e3, 15e3)]
    assert seen(*low, *silent).status == ExtentStatus.MEASURED
    # backwards it is the later one that fades, as an echo does and no exit
    echo = [MeanPass(band.band, "y", band.envelope[::-1], band.error) for band in (*low, *silent)]
    assert seen(*echo).status == ExtentStatus.BOUNCES
    among = [mean_pass(Band(200.0, high), (0.4, 1.0)) for high in (2e3, 3e3, 5e3, 6e3)]
    assert seen(*low, *among).status != ExtentStatus.MEASURED


def test_which_peak_is_the_entry_is_open_but_of_a_spall_that_nearly_reaches_the_next_ball():
    """No matter which grows with frequency: with mass it is the exit, without the entry."""

    def growing(apart: float, power: float):
        heights = ((BANDS[0], 0.3**power), (BANDS[1], 1.0), (BANDS[2], 3.0**power))
        return seen(*(mean_pass(band, (0.3, h), (0.3 + apart, 1.0)) for band, h in heights))

    for power in (-1.0, 0.5, 1.0):
        knocks = growing(0.3, power)
        assert knocks.status == ExtentStatus.EITHER
        assert knocks.separation == pytest.approx(0.3, abs=0.01)
    assert growing(0.1, -1.0).status == ExtentStatus.MEASURED
    assert growing(0.1, 1.0).status == ExtentStatus.BOUNCES  # an echo


def test_one_knock_hides_another_only_where_it_rings():
    knocks = seen(*(mean_pass(band, (0.3, 1.0)) for band in BANDS))
    assert knocks.status == ExtentStatus.ONE_KNOCK
    assert 0.01 < knocks.hidden < 0.05
    # a lowest band in noise shows nothing, and where a release shows best it would not
    noisy = [mean_pass(BANDS[0], (0.3, 1.0), error=0.05)]
    noisy += [mean_pass(band, (0.3, 1.0)) for band in BANDS[1:3]]
    assert math.isnan(seen(*noisy).hidden)
