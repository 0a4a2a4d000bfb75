"""Lessons: what they claim is what the core computes; what is wrong with a file is said."""

import json
import math
import os
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from bearing_explorer.__main__ import options
from bearing_explorer.explorer.results.ball_mass import BallMass
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state import lessons
from bearing_explorer.explorer.state.lessons import (
    Fault,
    Lesson,
    LessonError,
    Part,
    lessons_in,
    read_lesson,
    shipped_folder,
    shipped_lessons,
)
from bearing_explorer.explorer.state.scene_editor import SceneEditor
from bearing_explorer.page import SECTIONS, TABS
from hypothesis import given, settings, strategies as st

from bearingcore import (
    DOF_NAMES,
    EDGES,
    STIFFNESS_TERMS,
    Equilibrium,
    Scene,
    Spectrum,
    equilibrium,
    limits,
    orbit,
    presets,
    simulate,
    spectrum,
)
from bearingcore.measured.diagnosis import SLIP
from bearingcore.model.dynamics import contact_resonance_band
from bearingcore.model.experiments._motions import motion_experiment
from tests.helpers.contact_law import Balls, newton
from tests.helpers.sessions import SceneSession

FILES = [
    path
    for path in sorted(shipped_folder().glob("*.md"))
    if "diagnosis" in dict(TABS)
    or not re.search("diagnosis|simulate:", path.read_text(encoding="utf-8"))
]
FAN, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]
RATE = 65536.0


# --- what the lessons claim -----------------------------------------------------------------------


def pass_states(scene: Scene, n: int = 721) -> Equilibrium:
    return equilibrium(scene, np.linspace(0.0, scene.bearing.ball_spacing, n))


loads = cache(pass_states)


def fan(extent_deg: float = 12.9, **fields: float) -> Scene:
    return FAN.replace(extent=math.radians(extent_deg), **fields)


def liew_lim(extent_deg: float = 40.0, **fields: float) -> Scene:
    return LIEW_LIM.replace(extent=math.radians(extent_deg), **fields)


def light(extent_deg: float = 40.0, **fields: float) -> Scene:
    """The scene of the lessons that stay inside the limits of the model."""
    return liew_lim(extent_deg, fy=-500.0, **fields)


def first_warned() -> float:
    """The extent, in steps of 10°, from which on the page warns."""
    crossed = (x for x in range(0, 100, 10) if any(one.crossed for one in limits(light(x + 4.0))))
    return float(next(crossed))


@cache
def shown_bands(extent_deg: float) -> dict[str, tuple[float, float]]:
    """Bands of the natural frequencies as the page shows them when the hand rests."""
    return Results(fan(extent_deg)).bands


def below(scene: Scene, beside: int = 0) -> float:
    """Load [N] of the ball at 270°, or of the one `beside` it, as one stands there."""
    state = equilibrium(scene, [0.5 * scene.bearing.ball_spacing])
    middle = int(np.argmin(np.abs(state.ball_angle[0] - 1.5 * math.pi)))
    return float(state.ball_load[0, middle + beside])


def sunk(scene: Scene) -> float:
    """How far [µm] the ring is down as a ball stands at 270°."""
    state = equilibrium(scene, [0.5 * scene.bearing.ball_spacing])
    return -1e6 * float(state.displacement[0, 1])


def drop_in_the_middle(extent_deg: float) -> float:
    """How far [µm] a ball sinks in the middle of a defect of the fan rig."""
    path = fan(extent_deg).defect.path(np.array([1.5 * math.pi]), FAN.bearing)
    return 1e6 * float(path[0])


PAIR = {way: presets[f"7208-{way}"].replace(extent=0.0) for way in ("back-to-back", "face-to-face")}


def pair_mean(way: str, term: str) -> float:
    """A stiffness term of a healthy pair, averaged over a ball spacing."""
    return float(loads(PAIR[way]).term(term).mean())


def centres_apart(way: str) -> float:
    """Distance [m] of the points in which the lines of contact of two rows meet the shaft.

    From where each line goes: the ball's centre is half a pitch diameter up, and the line leans.
    """
    bearing = PAIR[way].bearing
    lean = 0.5 * bearing.pitch_diameter * math.tan(bearing.contact_angle)
    low, high = (row.place - row.facing * lean for row in bearing.rows)
    return abs(high - low)


def tilted_by(moment: float, way: str) -> float:
    """By how much [mrad] a moment [N·m] about x tilts a pair further."""
    before, after = (
        pass_states(PAIR[way].replace(mx=m), 181).displacement[:, 3].mean() for m in (0.0, moment)
    )
    return 1e3 * float(after - before)


@cache
def fewest(edge: str) -> tuple[float, float]:
    """Extents [deg] at which fewest balls carry load and k_yy is least, on average."""
    extents = np.arange(59.0, 67.01, 0.25)
    states = [pass_states(liew_lim(x, edge=edge), 361) for x in extents]
    balls = [e.loaded_balls[:-1].mean() for e in states]
    stiffness = [e.term("k_yy")[:-1].mean() for e in states]
    return float(extents[np.argmin(balls)]), float(extents[np.argmin(stiffness)])


@cache
def edges_freed(edge: str) -> tuple[float, float]:
    """How far [deg] inside an edge a third ball frees two others: as it comes, as it goes."""
    angles = np.arange(0.0, 15.0, 0.01)

    def freed(extent_deg: float) -> float:
        """Cage angle [deg] from which on six balls carry; at 0° three are around the middle."""
        count = equilibrium(liew_lim(extent_deg, edge=edge), np.radians(angles)).loaded_balls
        assert count[-1] == 6
        return float(angles[np.flatnonzero(count != 6)[-1] + 1])

    return freed(60.0), 0.5 * (66.0 - 60.0) - freed(66.0)


IN_DEFECT = slice(8, 11)
"""The three balls around the middle of the defect at a cage angle of 0."""


def sunk_at(extent_deg: float, angle_deg: float) -> float:
    """How far [µm] the shaft of the paper's scene has sunk."""
    state = equilibrium(liew_lim(extent_deg), [math.radians(angle_deg)])
    return -1e6 * float(state.displacement[0, 1])


@cache
def motion_spectrum(extent_deg: float, step_rate: float | None = None) -> Spectrum:
    motion = simulate(fan(extent_deg), 1.4, RATE, step_rate=step_rate)
    return spectrum(motion.outer_acceleration, motion.sample_rate)


def peak(extent_deg: float, dof: int) -> tuple[float, float]:
    """Frequency [Hz] and level [dB] of the highest peak from 0.3 to 2.1 kHz."""
    frequency, density = motion_spectrum(extent_deg)
    band = (frequency >= 300.0) & (frequency <= 2100.0)
    at = int(np.argmax(np.where(band, density[:, dof], 0.0)))
    return float(frequency[at]), 10.0 * math.log10(density[at, dof])


@cache
def step_errors() -> dict[float, float]:
    """Errors of the spectrum [dB] by steps a second, as “Measure” on the page finds them."""
    experiment = motion_experiment(FAN, duration=0.1, methods=["RK4"])
    return {point.value: point.errors["spectrum"] for point in experiment.of("RK4")}


def greatest_coupling(extent_deg: float) -> float:
    return float(np.abs(loads(light(extent_deg)).term("k_xy")).max())


def between(values: np.ndarray) -> tuple[float, float]:
    return float(np.min(values)), float(np.max(values))


def radial_parts(extent_deg: float) -> tuple[float, float]:
    """Sum [N] of all ball loads, which are radial here."""
    return between(loads(fan(extent_deg)).ball_load.sum(axis=1))


def passage(extent_deg: float) -> float:
    """Time [ms] between a ball entering and the next that leaves."""
    spacing = math.degrees(FAN.bearing.ball_spacing)
    return 1e3 * math.radians(extent_deg % spacing) / FAN.cage_speed


def crushed(scene: Scene) -> float:
    """What the printed formula lets a ball carry at most [kN], started from the right answer."""
    angles = np.arange(120) * (scene.bearing.ball_spacing / 120)
    ours = equilibrium(scene, angles)
    lever = np.array([1.0, 1.0, 1.0, *[scene.bearing.groove_center_radius] * 2])
    greatest = 0.0
    for angle, moved in zip(angles[::4], ours.displacement[::4], strict=True):
        balls = Balls(scene, angle, as_printed=True)
        q = newton(balls, moved * lever).q
        greatest = max(greatest, float(balls.ball_load(q).max()))
    return 1e-3 * greatest


@cache
def with_mass(scene: Scene) -> BallMass:
    return Results(scene).ball_mass


def mass_shares(scene: Scene, low: float, high: float = math.inf) -> np.ndarray:
    """Shares [%] of the power that mass adds, in octaves from `low` to `high` [Hz]."""
    answer = with_mass(scene)
    inside = (answer.octaves[:-1] >= low) & (answer.octaves[1:] <= high)
    return 100.0 * answer.share[inside]


def struck_after(scene: Scene, race: str) -> float:
    """Time [ms] from a ball's entry to its first hard strike."""
    return 1e3 * min(s.time for s in with_mass(scene).strikes if s.race == race)


FAST_FAN = FAN.replace(shaft_speed=2.0 * math.pi * 30.0)
PIT = presets["6205"].replace(extent=math.radians(1.2), edge="exact", depth=100e-6)
LIGHT_PIT = PIT.replace(fy=-50.0)
HEALTHY = fan(0.0)
MOTOR, TURN = presets["6205"], 2.0 * math.pi
E = math.radians

#: what a lesson says, word for word, with every number in it computed here when asked for
CLAIMS: dict[str, Callable[[], list[tuple[str, tuple[float, ...]]]]] = {
    "01": lambda: [
        ("with 100 N", (-HEALTHY.load.fy,)),
        ("There are 14 balls", (HEALTHY.bearing.n_balls,)),
        ("500 N, and back to 100 N. At 0 N", (500, 100, 0)),
        ("How much does ball 11 carry, the lowest one?",
         (1 + int(np.argmax(equilibrium(HEALTHY, [E(12.86)]).ball_load[0])),)),
        ("Only 4 or 5 of the 14 balls carry load", (*between(loads(HEALTHY).loaded_balls), 14)),
        ("a ball at the very bottom carries 39 n", (below(HEALTHY),)),
        ("moves down by 6.7 µm", (sunk(HEALTHY),)),
        ("first 3 µm are the clearance", (1e6 * HEALTHY.bearing.radial_clearance,)),
        ("7 balls share the load and the greatest ball load is 31 N",
         (loads(fan(0.0, radial_clearance=0.0)).loaded_balls.max(),
          loads(fan(0.0, radial_clearance=0.0)).ball_load.max())),
        ("with 20 µm of clearance two or three balls carry all of it, up to 61 N each",
         (20, loads(fan(0.0, radial_clearance=20e-6)).ball_load.max())),
        ("171 N instead of 195 N",
         (loads(fan(0.0, fy=-500.0)).ball_load.max(), 5 * round(below(HEALTHY)))),
    ],
    "02": lambda: [
        ("12.9° long, 50 µm deep", (math.degrees(FAN.defect.extent), 1e6 * FAN.defect.depth)),
        ("The ball at 270°", (math.degrees(FAN.defect.center),)),
        ("compressed by 3.7 µm, the ring follows it down by 1.2 µm",
         (sunk(HEALTHY) - 3.0, sunk(fan()) - sunk(HEALTHY))),
        ("About 5 µm are enough", (sunk(fan()) - 3.0,)),
        ("4 µm leaves it 3.8 N of its 39 N", (4, below(fan(depth=4e-6)), below(HEALTHY))),
        ("5 µm leave it nothing, and 500 µm change nothing further", (5, 500)),
        ("45 N each instead of 29 N", (below(fan(), 1), below(HEALTHY, 1))),
        ("Eq. 6 of the paper; lesson 6 asks where the quarter comes from", (6, 6)),
        ("at 5° the ball meets the other edge after sinking 42 µm", (5, drop_in_the_middle(5.0))),
        ("About 5 µm About 50 µm About 500 µm", (5, 50, 500)),
        ("only from 5.5° on does it sink by 50 µm", (5.5, drop_in_the_middle(5.5))),
    ],
    "03": lambda: [
        ("the same 100 N as before", (-FAN.load.fy,)),
        ("5°, 40°, 60°", (5, 40, 60)),
        ("A defect of 60°", (60,)),
        ("again add up to 100 N", (100,)),
        ("add up to about 110 N; at 60° to 134–161 N",
         (radial_parts(0.0)[0], 60, *radial_parts(60.0))),
        ("none 39 N", (loads(HEALTHY).ball_load.max(),)),
        *((f"{x}° {said} N", (x, loads(fan(x)).ball_load.max()))
          for x, said in ((5, "46.5"), (40, "62.7"), (60, "82.5"))),
        ("loaded 2.1 times as heavily as the bottom ever was",
         (loads(fan(60.0)).ball_load.max() / loads(HEALTHY).ball_load.max(),)),
        ("shorter than the 25.7° between two balls", (math.degrees(FAN.bearing.ball_spacing),)),
    ],
    "04": lambda: [
        ("With a defect of 40°", (40,)),
        ("Make a defect 40° long", (40,)),
        ("stays at 187.6 MN/m", (1e-6 * loads(light(0.0)).term("k_yy").mean(),)),
        ("between 94 and 145 MN/m", between(1e-6 * loads(light()).term("k_yy"))),
        ("five directions and five loads, 25 terms", (len(DOF_NAMES) ** 2,)),
        ("so 15 of them are different", (len(STIFFNESS_TERMS),)),
        ("below 0.001 MN/m. With the defect it reaches 7.9 MN/m",
         (1e-6 * greatest_coupling(0.0), 1e-6 * greatest_coupling(40.0))),
        ("the contact angle is 30°", (math.degrees(LIEW_LIM.bearing.contact_angle),)),
    ],
    "05": lambda: [
        ("at 5° and make the defect longer, from 0° to 90°", (5, 0, 90)),
        ("The balls are 30° apart", (math.degrees(LIEW_LIM.bearing.ball_spacing),)),
        ("From 15° From 30° From 60°", (15, 30, 60)),
        ("From about 60° on", (first_warned(),)),
        ("length of 30° that is halfway, at a cage angle of 15°; for 60° it is at 0°, with a ball "
         "at either end; and for 90° halfway again", (30, 15, 60, 0, 90)),
    ],
    "06": lambda: [
        ("Why 64°, and not 60°?", (64, 60)),
        ("fewest loaded balls at about 64°", (64,)),
        ("three balls 30° apart take up 60°",
         (math.degrees(LIEW_LIM.bearing.ball_spacing), 60)),
        ("with its load of 2 kN", (-1e-3 * LIEW_LIM.load.fy,)),
        ("60° About 62° 64°, as in the paper", (60, fewest("exact")[0], 64)),
        ("the shaft has sunk by up to 38 µm", (sunk_at(64.0, 15.0),)),
        ("the shaft sinks by 55 µm", (sunk_at(70.0, 0.0),)),
        ("on its floor, 50 µm down", (1e6 * LIEW_LIM.defect.depth,)),
        ("at 64° they carry 523, 23 and 523 N",
         (64, *equilibrium(liew_lim(64.0), [0.0]).ball_load[0, IN_DEFECT])),
        ("Eq. 6 as published", (6,)),
        ("the factor 0.25 under the root", (0.25,)),
        ("= 2.4° and = 1.1°, and the fewest balls are at 63.5°",
         (*edges_freed("published"), fewest("published")[0])),
        ("the angles are 1.2° and 0.6°, and the extent is 61.75°",
         (*edges_freed("chord"), fewest("chord")[0])),
        ("(exact) gives 62°", (fewest("exact")[0],)),
        ("extents: 63.75°, 61.75° and 62°", tuple(fewest(edge)[1] for edge in EDGES)),
        ("so the sentence says 63° and 62°", (63, 62)),
    ],
    "07": lambda: [
        ("from 0° over 12.9° to 38.6°", (0, 12.9, 38.6)),
        *((f"{label} {x1} {y1}", (*numbers, *shown_bands(x)["x1"], *shown_bands(x)["y1"]))
          for label, numbers, x, x1, y1 in (
              ("none", (), 0.0, "365–436 Hz", "670–679 Hz"),
              ("12.9°", (12.9,), 12.9, "365–480 Hz", "615–679 Hz"),
              ("38.6°", (38.6,), 38.6, "476–571 Hz", "532–617 Hz"))),
    ],
    "08": lambda: [
        ("12.9° long, then 38.6°", (12.9, 38.6)),
        ("The balls are 25.7° apart", (math.degrees(FAN.bearing.ball_spacing),)),
        ("38.6° is 12.9° and one ball spacing more",
         (12.9 + math.degrees(FAN.bearing.ball_spacing), 12.9)),
        ("0 or 1. That gives 12.45 ms and 12.44 ms", (0, 1, passage(12.9), passage(38.6))),
        ("along y moves from 672 Hz down to 608 Hz", (peak(12.9, 1)[0], peak(38.6, 1)[0])),
        ("the highest peak grows by 14 dB", (peak(38.6, 0)[1] - peak(12.9, 0)[1],)),
    ],
    "09": lambda: [
        ("500 µm down", (500,)),
        ("where the points of RK4 are", (4,)),
        ("The point of RK4 furthest", (4,)),
        ("lets it carry 56 kN", (crushed(light(depth=500e-6)),)),
        ("the greatest load is 411 N", (loads(light()).ball_load.max(),)),
        ("At 30 Hz", (30,)),
        ("grows by a factor of 1.35",
         (orbit(FAN.replace(shaft_speed=2.0 * math.pi * 30.0)).largest_multiplier,)),
        ("At 7 Hz it shrinks to 0.34",
         (FAN.shaft_speed / (2.0 * math.pi), orbit(FAN).largest_multiplier)),
        ("With 8192 steps a second the spectrum is wrong by 4.6 dB", (8192, step_errors()[8192.0])),
        ("with 16 384 by 0.27 dB", (16, 384, step_errors()[16384.0])),
        ("with 65 536 by 0.0015 dB", (65, 536, step_errors()[65536.0])),
    ],
    "10": lambda: [
        ("noise 20 dB below the signal", (20,)),
        ("has 9 balls; its cage turns 0.4 times as fast", (9, MOTOR.bearing.ftf(TURN))),
        ("the cage makes 0.398 turns", (MOTOR.bearing.ftf(TURN),)),
        ("the 9 balls", (MOTOR.bearing.n_balls,)),
        ("or 3.58 times", (MOTOR.bearing.bpfo(TURN),)),
        ("the other 5.42 times: together they are 9",
         (MOTOR.bearing.bpfi(TURN), MOTOR.bearing.bpfo(TURN) + MOTOR.bearing.bpfi(TURN))),
        ("then the other, 4.71 times", (2.0 * MOTOR.bearing.bsf(TURN),)),
        ("At 29.95 turns a second these are 107.4, 162.2 and 141.2 Hz",
         (MOTOR.shaft_speed / TURN, MOTOR.bearing.bpfo(MOTOR.shaft_speed),
          MOTOR.bearing.bpfi(MOTOR.shaft_speed), 2.0 * MOTOR.bearing.bsf(MOTOR.shaft_speed))),
        ("sidebands 29.95 Hz away", (MOTOR.shaft_speed / TURN,)),
        ("For a ball they are 11.9 Hz away", (MOTOR.bearing.ftf(MOTOR.shaft_speed),)),
        ("up to 2 % away", (100.0 * SLIP,)),
    ],
    "11": lambda: [
        ("a spall 12.9° long, at 7 Hz; then at 30 Hz",
         (math.degrees(FAN.defect.extent), FAN.shaft_speed / TURN, 30)),
        ("A 6205 under 1 kN", (6205, -1e-3 * PIT.load.fy)),
        ("The same pit under 50 N", (-LIGHT_PIT.load.fy,)),
        ("on the floor after 2.7 ms and is pressed by the inner race again after 11.7 ms",
         (struck_after(FAN, "outer"), struck_after(FAN, "inner"))),
        ("Up to 4 kHz that changes next to nothing: mass adds at most 10 %",
         (4, mass_shares(FAN, 0.0, 4e3).max())),
        ("From 4 to 8 kHz it is 78 %, above that 96 % and more",
         (4, 8, mass_shares(FAN, 4e3, 8e3)[0], mass_shares(FAN, 8e3).min())),
        ("At 30 Hz the border lies an octave higher: from 4 to 8 kHz mass adds 11 %, "
         "above 8 kHz 92 %",
         (30, 4, 8, mass_shares(FAST_FAN, 4e3, 8e3)[0], 8, mass_shares(FAST_FAN, 8e3).min())),
        ("drawn below 2.1 kHz", (2.1,)),
        ("under 1 kN meets the far edge 0.14 ms", (1, 1e3 * with_mass(PIT).far_edge)),
        ("mass adds at most 2 %, and takes 15 % away from 16 kHz on",
         (mass_shares(PIT, 500.0).max(), -mass_shares(PIT, 16e3)[0], 16)),
        ("Under 50 N the same ball flies, and strikes: there mass adds 87 %",
         (50, mass_shares(LIGHT_PIT, 16e3)[0])),
        ("that is 20 to 29 kHz", tuple(1e-3 * f for f in contact_resonance_band(FAN))),
        ("a ball of 2.1 g hardly moves a housing of 2 kg",
         (1e3 * FAN.bearing.ball_mass, FAN.support.outer_mass)),
    ],
    "12": lambda: [
        ("18 mm apart", (1e3 * PAIR["back-to-back"].bearing.row_distance,)),
        ("leans by 25°", (math.degrees(PAIR["back-to-back"].bearing.contact_angle),)),
        ("moment of 20 N·m to either", (20,)),
        *((f"{said}", (value,)) for said, value in (
            ("401 MN/m", 1e-6 * pair_mean("back-to-back", "k_yy")),
            ("378 MN/m", 1e-6 * pair_mean("face-to-face", "k_yy")),
            ("220 kN·m/rad", 1e-3 * pair_mean("back-to-back", "k_rxrx")),
            ("16.6 kN·m/rad", 1e-3 * pair_mean("face-to-face", "k_rxrx")),
            ("13 times less",
             pair_mean("back-to-back", "k_rxrx") / pair_mean("face-to-face", "k_rxrx")),
            ("46.0 mm back to back", 1e3 * centres_apart("back-to-back")),
            ("10.0 mm face to face", 1e3 * centres_apart("face-to-face")))),
        ("moment of 20 N·m tilts the shaft by a further 0.12 mrad back to back, and by 0.98 mrad",
         (20, tilted_by(20.0, "back-to-back"), tilted_by(20.0, "face-to-face"))),
    ],
}  # fmt: skip


class Words(HTMLParser):
    """The words of some HTML without its formulas, one space between them."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self._found: list[str] = []
        self._formula = False
        self.feed(html)
        self.text = re.sub(r"\s+", " ", " ".join(self._found)).strip()
        self.text = re.sub(r" ([.,;:?)])", r"\1", self.text).replace("( ", "(")

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self._formula = self._formula or tag == "math"

    def handle_endtag(self, tag: str) -> None:
        self._formula = self._formula and tag != "math"

    def handle_data(self, data: str) -> None:
        if not self._formula:
            self._found.append(data)


def lesson_of(path: Path) -> Lesson:
    return read_lesson(path.read_text(encoding="utf-8"), TABS)


def words_of(lesson: Lesson) -> str:
    parts = " ".join(f"{part.heading} {part.html}" for part in lesson.parts)
    asked = lesson.predict
    prediction = "" if asked is None else " ".join([asked.ask, *asked.choose, asked.hint])
    return Words(f"{lesson.title} {prediction} {parts}").text


def decimals(text: str) -> int:
    return len(text.partition(".")[2])


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_number_of_a_lesson_is_what_the_core_computes(path: Path) -> None:
    said = words_of(lesson_of(path)).lower()
    left = said
    for claim, computed in CLAIMS[path.stem[:2]]():
        assert claim.lower() in said, f"the lesson no longer says {claim!r}"
        left = left.replace(claim.lower(), " ")
        numbers = re.findall(r"\d+(?:\.\d+)?", claim)
        assert len(numbers) == len(computed), claim
        for number, value in zip(numbers, computed, strict=True):
            off = abs(float(number) - float(value))
            assert off <= 0.5001 * 10.0 ** -decimals(number), f"{claim}: computed {value:.6g}"
    unchecked = re.findall(r".{0,20}\d.{0,20}", left)
    assert not unchecked, "numbers that nothing here checks"


def test_what_lessons_say_in_words() -> None:
    deep = [fan(depth=d * 1e-6) for d in (5.0, 50.0, 500.0)]
    assert [below(scene) for scene in deep] == [0.0, 0.0, 0.0]
    np.testing.assert_allclose([below(scene, 1) for scene in deep], below(deep[0], 1), rtol=1e-9)
    assert between(loads(fan(0.0, radial_clearance=20e-6)).loaded_balls) == (2, 3)
    assert loads(fan(0.0, radial_clearance=0.0)).loaded_balls.min() == 7
    assert loads(fan(0.0, fy=-500.0)).loaded_balls.max() > loads(HEALTHY).loaded_balls.max()
    right = {"01": below(HEALTHY), "10": MOTOR.bearing.bpfo(TURN)}
    for path, value in ((path, right[path.stem[:2]]) for path in FILES if path.stem[:2] in right):
        asked = lesson_of(path).predict
        assert asked is not None
        assert asked.right == pytest.approx(value, abs=0.5 * asked.within)
    # 2: from 5.5° on the floor is reached, and at 5.4° it is not
    assert drop_in_the_middle(5.4) < 49.9
    # 3: up to a ball spacing blue lies on grey at times, beyond it never
    for extent_deg, times in ((25.0, True), (26.5, False)):
        damaged, healthy = loads(fan(extent_deg)), loads(fan(0.0))
        same = np.abs(damaged.ball_load - healthy.ball_load).max(axis=1) < 1e-6
        assert same.any() == times
    # 4, by a third of its most; 5, always a ball inside from a ball spacing on
    damaged, healthy = loads(light()), loads(light(0.0))
    assert healthy.loaded_balls.min() == LIEW_LIM.bearing.n_balls
    assert greatest_coupling(0.0) < 0.001e6
    least, most = between(damaged.term("k_yy"))
    assert (most - least) / most == pytest.approx(1.0 / 3.0, abs=0.03)
    for length, always in ((29.0, False), (31.0, True)):
        angles = loads(light(length)).ball_angle
        inside = np.abs(angles % TURN - 1.5 * math.pi) < 0.5 * E(length)
        assert inside.any(axis=1).all() == always
    assert np.ptp(healthy.term("k_yy")) < 0.001 * healthy.term("k_yy").mean()
    assert min(np.abs(state.term("k_xry")).min() for state in (damaged, healthy)) > 0.5e6
    tied = [f"k_{a}{b}" for a in "xy" for b in ("z", "rx", "ry")]
    assert all(not loads(fan()).term(term).any() for term in tied)
    # 6
    for edge in EDGES:  # to the half degree of a map's steps
        assert 60.0 + sum(edges_freed(edge)) == pytest.approx(fewest(edge)[0], abs=0.25)
    turned = pass_states(liew_lim(64.0))
    assert 2 * np.count_nonzero(turned.loaded_balls == 6) > len(turned.loaded_balls)
    assert between(turned.loaded_balls) == (6, 10)
    for extent_deg in np.arange(60.0, 72.0, 0.5):  # three balls inside are never all free
        assert equilibrium(liew_lim(extent_deg), [0.0]).ball_load[0, IN_DEFECT].max() > 1.0
    maps = {edge: Results(liew_lim(edge=edge)).maps for edge in EDGES}
    least = {e: math.degrees(m.extents[np.nanargmin(m.mean_loaded_balls)]) for e, m in maps.items()}
    assert least == pytest.approx({"published": 63.0, "chord": 62.0, "exact": 62.0})
    # 7, 8
    assert passage(12.9) == pytest.approx(passage(38.6), abs=0.02)
    # 9
    shallow, deeper = loads(light()), loads(light(depth=500e-6))
    np.testing.assert_allclose(deeper.ball_load, shallow.ball_load, rtol=1e-9, atol=1e-9)
    assert orbit(FAN.replace(shaft_speed=2.0 * math.pi * 30.0)).residual < 1e-9
    nothing = equilibrium(FAN.replace(fy=0.0), [0.0])
    assert not nothing.converged.any()
    assert newton(Balls(HEALTHY, 0.0), np.zeros(5)).failure == "singular matrix"


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_scenes_of_lessons_lie_inside_the_limits_or_the_lesson_says_so(path: Path) -> None:
    """Where the page would warn in red, the words before the answer speak of the warning."""
    lesson = lesson_of(path)
    before = " ".join(Words(part.html).text for part in lesson.parts[:-1])
    buttons = [
        json.loads(button.attrib["data-ask"])
        for part in lesson.parts
        for button in ElementTree.fromstring(f"<div>{part.html}</div>").iter("button")
    ]
    for message in [{"choose": {}, "typed": {}}, *(b for b in buttons if "typed" in b)]:
        editor = SceneEditor("liew-lim")
        lesson.begin(editor)
        editor.choose(message["choose"])
        editor.set(message["typed"])
        crossed = [limit.name for limit in limits(editor.scene) if limit.crossed]
        assert not crossed or "page warns" in before, (message, crossed)


def test_words_asked_for_again_leave_the_scene_alone() -> None:
    explorer = SceneSession(SECTIONS, lessons=lessons_in(shipped_folder(), TABS))
    explorer.draw = lambda: None  # type: ignore[method-assign]
    explorer.change_scene({"mark": 1, "typed": {"fy_n": -77.0}})
    before = explorer.scene
    explorer.change_lesson({"mark": 2, "lesson": 2, "words_only": True})
    assert explorer.lesson.lesson["number"] == 2
    assert explorer.scene == before
    explorer.change_lesson({"mark": 3, "lesson": ""})
    assert explorer.scene == before
    assert "lesson" not in explorer.share.state["address"]
    explorer.change_lesson({"mark": 4, "lesson": 2})
    assert explorer.scene != before


# --- files ----------------------------------------------------------------------------------------


def test_the_lessons_that_come_along_are_in_order() -> None:
    lessons = shipped_lessons(TABS)
    assert len(lessons) == len(FILES), "one has a fault"
    assert 8 <= len(lessons) <= 16
    for lesson in lessons:
        assert isinstance(lesson, Lesson)
        assert [part.heading for part in lesson.parts] == ["Question", "Drag", "Look", "Answer"]
        assert lesson.drag
        assert lesson.watch
        assert lesson.predict is not None
        told = json.dumps(lesson.browser_data(0))
        assert len(told) < 20_000
        editor = SceneEditor("6205")
        lesson.begin(editor)
        assert editor.preset == lesson.preset
        assert {name: editor.values[name] for name in lesson.values} == lesson.values


GOOD = """+++
title = "A title"
tab = "load"
preset = "fan-rig"
drag = ["fy_n"]
watch = ["bearing"]

[scene]
extent_deg = 64
edge = "chord"

[predict]
ask = "Which?"
choose = ["this", "that"]
right = 2
+++
## Question
Words, [a button](set:extent_deg=62&edge=exact) and [another](show:maps).

$$Q = K\\delta^{3/2}$$
## Answer
So $x < y$ it is.
"""


def test_a_lesson_sets_a_scene_and_its_buttons_change_it() -> None:
    lesson = read_lesson(GOOD.replace("[predict]", "[result]\nextent_deg = 40\n[predict]"), TABS)
    assert (lesson.title, lesson.tab) == ("A title", "load")
    assert (lesson.drag, lesson.watch) == (("fy_n",), ("bearing",))
    editor = SceneEditor("liew-lim")
    lesson.begin(editor)
    assert editor.scene == FAN.replace(extent=math.radians(64.0), edge="chord")
    assert lesson.browser_data(0)["result"] == {"choose": {}, "typed": {"extent_deg": 40.0}}
    question, answer = lesson.parts
    buttons = ElementTree.fromstring(f"<div>{question.html}</div>").iter("button")
    assert [json.loads(button.attrib["data-ask"]) for button in buttons] == [
        {"choose": {"edge": "exact"}, "typed": {"extent_deg": 62.0}},
        {"show": "maps"},
    ]
    assert "<math" in question.html
    assert 'display="block"' in question.html
    assert "<mo>&lt;</mo>" in answer.html


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("+++\ntitle", "title", 1, "begins with a line +++"),
        ("+++\n##", "##", 22, "a second line +++ is missing"),
        ('"A title"', "A title", 2, "the head is not TOML"),
        ('title = "A title"', "", 1, "title is missing"),
        ('title = "A title"', 'titel = "A title"', 1, "title is missing"),
        ('tab = "load"', 'tab = "load"\ntap = "load"', 4, "“tap” is not an entry here"),
        ("right = 2", 'right = "2"', 15, "right cannot be read: Expected `float`, got `str`"),
        ('"load"', '"lode"', 3, "“lode” is not a tab; possible: overview, load"),
        ('["fy_n"]', '"fy_n"', 5, "Expected `array`, got `str`"),
        ('["fy_n"]', '["fy"]', 5, "“fy” is not a control of the page"),
        ('watch = ["bearing"]', 'term = "kyy"', 6, "“kyy” is not a term"),
        ("extent_deg = 64", "extent_deg = 640", 9, "640° is out of range: length of the defect"),
        ("extent_deg = 64", "extent = 64", 9, "“extent” is not a number or choice of the page"),
        ("## Question", "Question", 17, "parts begin with"),
        ("## Answer", "Answer", 17, "two parts at least"),
        ('choose = ["this", "that"]', 'choose = ["this"]', 14, "length >= 2"),
        ("right = 2", "right = 3", 15, "right counts the choices from 1"),
        ("right = 2", 'right = 2\nveil = ["maps"]', 16, "“maps” is not a figure of this tab"),
        ("So $x < y$ it is.", "", 21, "this part is empty"),
        ("set:extent_deg=62", "set:extent_deg=6200", 18, "6200° is out of range"),
        ("show:maps", "show:map", 18, "“map” is not a tab"),
        ("show:maps", "ftp://a/b", 18, "links go to set:, show:, simulate: or https:"),
        ("show:maps", "simulate:noise=5", 18, "noise is “5”; possible: 40, 20, 10, none"),
        ("3/2}", "3/2", 20, "its braces do not match"),
        ("So $x", "So\n$\\href{https://a}{x}$ $x", 23, "has an element not allowed"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_with_its_line(
    tmp_path: Path, old: str, new: str, line: int, words: str
) -> None:
    assert old in GOOD
    (tmp_path / "01-wrong.md").write_text(GOOD.replace(old, new, 1), encoding="utf-8")
    (fault,) = lessons_in(tmp_path, TABS)
    assert isinstance(fault, Fault)
    assert fault.sentence.startswith(f"01-wrong.md, line {line}: ")
    assert words in fault.sentence
    assert fault.sentence.endswith(".")


def test_a_teachers_folder_is_read_anew_when_a_file_changes(tmp_path: Path) -> None:
    (tmp_path / "02-b.md").write_text(GOOD, encoding="utf-8")
    (tmp_path / "01-a.md").write_bytes(GOOD.encode("utf-8").replace(b"Words", b"W\xe9rds"))
    (tmp_path / "notes.txt").write_text("not a lesson", encoding="utf-8")
    bad, good = lessons_in(tmp_path, TABS)
    assert bad == Fault("01-a.md", "01-a.md, line 18: this is not text in UTF-8.")
    assert isinstance(good, Lesson)
    (tmp_path / "01-a.md").write_text(GOOD.replace("A title", "Mended"), encoding="utf-8")
    mended, _ = lessons_in(tmp_path, TABS)
    assert isinstance(mended, Lesson)
    assert mended.title == "Mended"
    (tmp_path / "03-c.md").write_bytes(b"x" * (lessons.LONGEST_FILE + 1))
    assert "longer than" in str(lessons_in(tmp_path, TABS)[2])


def test_a_folder_without_lessons_is_one_fault(tmp_path: Path) -> None:
    for folder, words in ((tmp_path, "holds no file"), (tmp_path / "none", "cannot be read")):
        (fault,) = lessons_in(folder, TABS)
        assert isinstance(fault, Fault)
        assert words in fault.sentence


def test_a_teachers_folder_on_the_page(tmp_path: Path) -> None:
    (tmp_path / "1.md").write_text(GOOD, encoding="utf-8")
    (tmp_path / "2.md").write_text(GOOD.replace("show:maps", "show:nothing"), encoding="utf-8")
    assert options(["--lessons", str(tmp_path)]).lessons == tmp_path
    explorer = SceneSession(SECTIONS, lessons=lessons_in(tmp_path, TABS))
    panel = explorer.lesson
    assert [(title, name) for title, _, name in panel.titles] == [("A title", "1"), ("2.md", "")]
    assert panel.titles[1][1].startswith("2.md, line 18: “nothing” is not a tab")
    explorer.draw = lambda: None  # type: ignore[method-assign]
    for unknown in (1, 7, -1, "0", "2"):
        explorer.change_lesson({"lesson": unknown})
        assert panel.lesson == {}
        assert explorer.scene == FAN
    explorer.change_lesson({"mark": 1, "lesson": 0})
    assert panel.lesson["title"] == "A title"
    assert explorer.scene == FAN.replace(extent=math.radians(64.0), edge="chord")
    explorer.change_lesson({"show": "maps"})
    assert explorer._shown == "maps"
    assert explorer.scene.defect.edge == "chord"


# --- strangers ------------------------------------------------------------------------------------

HOSTILE = [
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "![x](https://example.org/x.png)",
    "[x](javascript:alert(1))",
    "[x](data:text/html,<script>alert(1)</script>)",
    '[x](show:maps"onclick="alert(1))',
    "$\\text{<script>alert(1)</script>}$",
    "$\\href{javascript:alert(1)}{x}$",
    "$\\text{&lt;script&gt;alert(1)&lt;/script&gt;}$",
    "<https://example.org/><iframe src='https://example.org'>",
    "## <b onmouseover=alert(1)>Heading",
]
ELEMENTS = {
    *("p", "em", "strong", "code", "pre", "ol", "ul", "li", "h3", "h4", "h5", "h6", "blockquote"),
    *("table", "thead", "tbody", "tr", "th", "td", "br", "hr", "a", "button"),
    *lessons._MATHML_ELEMENTS.split(),
}
ATTRIBUTES = {
    *("href", "title", "target", "rel", "type", "class", "data-ask", "style", "start"),
    *lessons._MATHML_ATTRIBUTES.split(),
}


class Judge(HTMLParser):
    """Finds what a lesson may never hold."""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag in ELEMENTS, tag
        for name, value in attrs:
            assert name in ATTRIBUTES, name
            assert name != "href" or str(value).startswith(("https://", "http://")), value
            assert name != "style" or re.fullmatch(r"text-align:\s*\w+", str(value)), value


def judge(text: str) -> None:
    parts: tuple[Part, ...] = ()
    line = 1
    try:
        parts = read_lesson(text, TABS).parts
    except LessonError as error:
        line = error.line
    assert 1 <= line <= text.count("\n") + 2
    for part in parts:
        Judge().feed(part.html)


@pytest.mark.parametrize("hostile", HOSTILE)
def test_nothing_a_stranger_writes_becomes_a_script(hostile: str) -> None:
    judge(GOOD.replace("Words", hostile))
    judge(GOOD.replace("Words", f"\n\n{hostile}\n\n"))
    judge(GOOD.replace("A title", hostile.replace('"', "'")))


@settings(max_examples=60, deadline=None)
@given(st.text(st.sampled_from("<>[]()$\\{}_^&;:=\"'#|-*`!a1 \n/+é\0"), max_size=120))
def test_any_text_is_a_lesson_or_refused(text: str) -> None:
    judge(text)
    judge(GOOD.replace("Words", text))
    judge(GOOD.replace("extent_deg = 64", text))


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="there is no endless file here")
def test_a_link_to_an_endless_file_is_no_lesson(tmp_path: Path) -> None:
    (tmp_path / "1.md").symlink_to("/dev/zero")
    os.mkfifo(tmp_path / "2.md")
    (tmp_path / "3.md").mkdir()
    with (tmp_path / "4.md").open("wb") as file:
        file.truncate(2**33)  # takes no room on the disk
    sentences = [fault.sentence for fault in lessons_in(tmp_path, TABS)]
    assert len(sentences) == 4, sentences
    assert "1.md, line 1: this is not a regular file." in sentences
    assert "2.md, line 1: this is not a regular file." in sentences
    assert any(sentence.startswith("3.md") for sentence in sentences)
    assert "4.md, line 1: the file is longer than 20000 bytes." in sentences
