"""Tables of bearings: those that come with it, and those of users."""

import math

import pytest

from bearingcore import presets
from bearingcore.bearings import catalogue, read_catalogue
from bearingcore.model.statics import dynamic_load_rating

HEAD = "name;balls;ball_diameter_mm;pitch_diameter_mm"


def test_every_published_bearing_has_a_source() -> None:
    assert len(catalogue()) >= 10
    for entry in catalogue().values():
        assert "Printed" in entry.note, entry.name


@pytest.mark.parametrize(
    ("name", "outer", "inner"),
    [
        ("6205-2RS, CWRU drive end", 3.5848, 5.4152),
        ("6203-2RS, CWRU fan end", 3.0530, 4.9469),
        ("ER-16K, Ottawa", 3.57, 5.43),
    ],
)
def test_published_defect_frequencies(name: str, outer: float, inner: float) -> None:
    """Times the shaft's, as printed with the data, to their digits (fan end: 2 in the last)."""
    bearing = catalogue()[name].bearing
    digit = 3e-4 if outer == 3.0530 else 0.6 * 10.0 ** -len(str(outer).split(".")[1])
    assert bearing.bpfo(2.0 * math.pi) == pytest.approx(outer, abs=digit)
    assert bearing.bpfi(2.0 * math.pi) == pytest.approx(inner, abs=digit)


@pytest.mark.parametrize("name", ["6804RS, FEMTO-ST", "UER204, XJTU-SY"])
def test_printed_ratings_are_those_of_iso_281(name: str) -> None:
    """Balls, sizes and rating were printed by others: they fit each other."""
    entry = catalogue()[name]
    assert entry.dynamic_load_rating is not None
    assert dynamic_load_rating(entry.bearing) == pytest.approx(entry.dynamic_load_rating, rel=5e-3)


def test_raceways_of_the_209_and_the_218() -> None:
    """Printed raceway diameters: 52.291 and 77.706 mm, 102.79 and 147.73 mm."""
    b = catalogue()["209, Harris"].bearing
    play = b.diametral_play
    assert 2e3 * b.inner_raceway_radius - 5e2 * play == pytest.approx(52.291, abs=2e-3)
    assert 2e3 * b.outer_raceway_radius + 5e2 * play == pytest.approx(77.706, abs=2e-3)
    c = catalogue()["218, Harris"].bearing
    play = c.diametral_play
    assert 2e3 * c.inner_raceway_radius - 5e2 * play == pytest.approx(102.79, abs=0.02)
    assert 2e3 * c.outer_raceway_radius + 5e2 * play == pytest.approx(147.73, abs=0.02)


def test_what_is_assumed_is_said() -> None:
    assert any("groove of 0.52" in told for told in catalogue()["NICE, MFPT"].assumed)
    assert catalogue()["209, Harris"].assumed == ()


@pytest.mark.parametrize(
    "table",
    [
        f"{HEAD}\n6205;9;7,94;39,04\n",
        f"\ufeff{HEAD}\r\n\r\n# ours\r\n6205 ; 9 ; 7.94 ; 39.04;;;\r\n".encode(),
        "Name\tBalls\tBall diameter mm\tPitch-diameter mm\n6205\t9.0\t7,94\t39.04\n",
        "pitch_diameter_mm,name,balls,ball_diameter_mm\n39.04,6205,9,7.94\n",
        f"{HEAD};note\n6205;9;7.94;39.04;für Prüfstand\n".encode("cp1252"),
        f'{HEAD};note\n"6205";9;7.94;39.04;"press; shop"\n',
        f"{HEAD};inner_groove_radius_mm;outer_groove_ratio;diametral_clearance_µm\n"
        "6205;9;7.94;39.04;4.1288;0.53;10\n",
    ],
)
def test_ways_to_write_a_table(table: str | bytes) -> None:
    (entry,) = read_catalogue(table).values()
    assert entry.name == "6205"
    expected = presets["6205"].bearing
    assert entry.bearing.n_balls == 9
    for field in ("load_deflection_factor", "radial_clearance", "inner_groove_radius"):
        assert getattr(entry.bearing, field) == pytest.approx(getattr(expected, field), rel=1e-9)


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ("", ["empty"]),
        (HEAD, ["headings, and a line"]),
        ("name;balls\na;9", ["without ball_diameter_mm, pitch_diameter_mm"]),
        (f"{HEAD};clearence\na;9", ["column 5", "clearence", "diametral_clearance_um"]),
        (f"{HEAD};balls\na;9", ["column 5", "balls", "once"]),
        (f"{HEAD}\na;9;x;39", ["line 2, column ball_diameter_mm", "'x'", "a number"]),
        (f"{HEAD}\n\na;8.5;7;39", ["line 3, column balls", "8.5", "whole number"]),
        (f"{HEAD}\na;12;12;39", ["line 2, column balls", "do not overlap"]),
        (f"{HEAD}\na;9;7;39\na;9;7;39", ["line 3, column name", "a different name"]),
        (f"{HEAD}\na;9;7;39;1", ["cells in table of bearings: line 2 is 5", "4"]),
        ("name,balls,ball_diameter_mm,pitch_diameter_mm\na,9,7,94,39", ["decimal comma"]),
        (f'{HEAD}\n"a;9;7;39', ["cells that csv can read"]),
        (f"{HEAD};inner_groove_ratio\na;9;7;39;0.3", ["line 2, column inner_groove", "above"]),
        (
            f"{HEAD};inner_groove_ratio;inner_groove_radius_mm\na;9;7;39;0.52;3.7",
            ["line 2, column inner_groove_ratio", "nothing where"],
        ),
        (f"{HEAD};diametral_clearance_um\na;9;7;39;-8000", ["clearance_um", "at least -0.007"]),
        (f"{HEAD};dynamic_load_rating_kn\na;9;7;39;0", ["load_rating_kn", "above 0"]),
        (f"{HEAD}\na;9;7;39\nb;9;y;39\nc;x;7;39", ["line 3, column ball_diam"]),
    ],
)
def test_faults_are_named(table: str | bytes, told: list[str]) -> None:
    with pytest.raises(ValueError, match=r"table of bearings|heading") as refused:
        read_catalogue(table)
    for words in told:
        assert words in str(refused.value)
    assert len(str(refused.value)) < 700
