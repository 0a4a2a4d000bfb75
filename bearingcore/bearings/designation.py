"""A bearing by its designation: "6208-2RS/C3", "7208 BEP", "NU 208", "2206", "30206 DB".

The basic number gives boundary dimensions (ISO 15, ISO 355), the suffix the contact angle of
angular-contact bearings, the class of radial clearance (ISO 5753-1) and the arrangement of two
tapered roller bearings. The inside is estimated from the ratings of a catalogue, see
`bearingcore.bearings.inside`: the bearing says so itself (`Bearing.estimated`).

Understood are deep groove bearings 60, 62, 63, 64, 160, 618, 619, angular-contact ones 70, 72, 73,
self-aligning ones 12, 13, 22, 23, cylindrical rollers NU, N, NJ, NUP of the series 2, 3, 10, 22, 23
and tapered rollers 302, 303, 322, 323, with bores of 10 to 100 mm (rollers from 20 mm). Tapered
rollers with steeper cups (B, C, D behind the number) are other bearings, and are not.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import NamedTuple

from bearingcore.bearings import ratings
from bearingcore.bearings.ball import USUAL_GROOVES
from bearingcore.bearings.bearing import Bearing
from bearingcore.bearings.catalogue import CatalogueBearing
from bearingcore.bearings.inside import (
    Inside,
    accuracy,
    balls_from_ratings,
    rollers_from_raceways,
    tapered_rollers_from_ratings,
)
from bearingcore.bearings.self_aligning import USUAL_GROOVE
from bearingcore.common import checks
from bearingcore.common.numbers import number

DEEP_GROOVE, ANGULAR_CONTACT = "deep groove ball bearing", "angular-contact ball bearing"
SELF_ALIGNING, ROLLERS = "self-aligning ball bearing", "cylindrical roller bearing"
TAPERED = "tapered roller bearing"

SERIES: Mapping[str, str] = {
    **dict.fromkeys(("60", "62", "63", "64", "160", "618", "619"), DEEP_GROOVE),
    **dict.fromkeys(("70", "72", "73"), ANGULAR_CONTACT),
    **dict.fromkeys(("12", "13", "22", "23"), SELF_ALIGNING),
    **dict.fromkeys(("NU2", "NU3", "NU10", "NU22", "NU23"), ROLLERS),
    **dict.fromkeys(("302", "303", "322", "323"), TAPERED),
}
"""Kind of bearing of each series; N, NJ and NUP have the dimensions of NU."""

CATALOGUE_ANGLE = math.radians(30.0)
"""Contact angle for which the table has the ratings of angular-contact bearings."""

ANGLES = {"ACD": 25, "AC": 25, "A5": 25, "CD": 15, "A": 30, "B": 40, "C": 15, "E": 25}
"""Contact angle [degrees] by the letters behind the number; the longer ones first."""

CLEARANCE_CLASSES = ("C2", "CN", "C3", "C4", "C5")

ROWS_OF_ROLLERS = 7.0 / 9.0
"""Power with which C_r of ISO 281 grows with the rows of rollers."""

LONGEST_DESIGNATION = 60

_FORM = re.compile(
    r"(?:(?!NUP|NU|NJ|NF)[A-Z]{2,8}[ -]+)?"  # the maker
    r"(?P<letters>NUP|NU|NJ|NF|N|B|HR)?[ -]?(?P<number>\d{3,5})(?P<suffix>\D.*)?"
)
_CLEARANCE = re.compile(r"C([2345N])(?!\d)")
_ANGLE = re.compile(r"[ /-]*(ACD|AC|A5|CD|A|B|C(?![2345N])|E)")

_PAIR = re.compile(r"D(?P<letter>[BF])|(?P<words>BACK|FACE)[ -]TO[ -](?P=words)")
_STEEP = re.compile(r"[ /-]*[BCD]")

_CLEARANCE_KIND = {DEEP_GROOVE: "ball", SELF_ALIGNING: "self-aligning", ROLLERS: "roller"}


class Boundary(NamedTuple):
    """A line of the table of designations, in SI; what a series does not have is NaN."""

    bore: float
    outside_diameter: float
    width: float
    dynamic_rating: float
    static_rating: float
    factor: float
    inner_raceway: float
    outer_raceway: float
    axial_factor: float
    cone_width: float
    cup_width: float
    thrust_limit: float


_UNITS = Boundary(1e-3, 1e-3, 1e-3, 1e3, 1e3, 1.0, 1e-3, 1e-3, 1.0, 1e-3, 1e-3, 1.0)
"""Factors from the columns of the table to SI."""


@dataclass(frozen=True)
class Designation:
    """A bearing as its designation gives it.

    Attributes
    ----------
    name
        as it was given, in capitals but for an arrangement in words.
    basic
        the number without suffix, as the table has it: "6208", "NU208", "61804".
    kind
        out of the values of SERIES.
    bore, outside_diameter, width
        boundary dimensions [m] by ISO 15, of tapered rollers by ISO 355: T of one bearing.
    dynamic_load_rating
        C_r [N] of the catalogue, at the contact angle of the designation; of a pair that of both
        rows, by ISO 281.
    clearance_class
        out of CLEARANCE_CLASSES; empty for angular-contact and tapered bearings, which have none.
    bearing
        with estimated inside dimensions.
    assumed
        what the designation does not say, in words.
    """

    name: str
    basic: str
    kind: str
    bore: float
    outside_diameter: float
    width: float
    dynamic_load_rating: float
    clearance_class: str
    bearing: Bearing
    assumed: tuple[str, ...]

    @property
    def entry(self) -> CatalogueBearing:
        """The same as an entry of a list of bearings."""
        kind = self.kind[0].upper() + self.kind[1:]
        if self.bearing.rows:
            kind = f"Two {self.kind}s, {self.bearing.arrangement.replace('-', ' ')}"
        tapered = self.kind == TAPERED
        digits = 3 if tapered else 5
        note = (
            f"{kind}. By ISO {355 if tapered else 15}: bore {number(1e3 * self.bore, 4)} mm, "
            f"outside diameter {number(1e3 * self.outside_diameter, 4)} mm, width "
            f"{number(1e3 * self.width, 4)} mm. Estimated, as makers do not print it: "
            f"{self.bearing.n_balls} {self.bearing.kind.elements} of "
            f"{number(1e3 * self.bearing.ball_diameter, digits)} mm, from the load ratings of the "
            f"JTEKT (Koyo) catalogue. {accuracy(tapered)}"
        )
        return CatalogueBearing(
            self.name, self.bearing, self.dynamic_load_rating, note, self.assumed
        )


@cache
def boundaries() -> Mapping[str, Boundary]:
    """Boundary dimensions and ratings by basic number."""
    found = {}
    for row in _rows("designations.csv"):
        values = [float(cell) if cell else math.nan for cell in list(row.values())[1:]]
        scaled = (value * unit for value, unit in zip(values, _UNITS, strict=True))
        found[row["designation"]] = Boundary(*scaled)
    return found


def clearance(kind: str, bore: float, clearance_class: str) -> tuple[float, float]:
    """Least and greatest radial internal clearance [m] of ISO 5753-1.

    From contact to contact, as a bearing is delivered: fits and warmth take some of it away.

    Parameters
    ----------
    kind
        DEEP_GROOVE, SELF_ALIGNING or ROLLERS.
    bore
        [m], cylindrical.
    clearance_class
        out of CLEARANCE_CLASSES.

    Raises
    ------
    ValueError
        for a kind or a bore that the table does not have.
    """
    checks.choice("clearance class", clearance_class, CLEARANCE_CLASSES)
    name = _CLEARANCE_KIND[checks.choice("kind", kind, tuple(_CLEARANCE_KIND))]
    for row in _rows("clearances.csv"):
        over, up_to = float(row["bore_over_mm"]), float(row["bore_up_to_mm"])
        if row["kind"] == name and over < 1e3 * bore <= up_to * (1.0 + 1e-9):
            least, most = map(float, row[clearance_class].split())
            return 1e-6 * least, 1e-6 * most
    raise checks.refuse("bore", bore, "6 to 100 mm, where clearance classes are tabulated", "m")


def read_designation(text: str) -> Designation:
    """The bearing of a designation; case, spaces and the maker's name do not matter.

    Raises
    ------
    ValueError
        for what is no designation, or one of another series or size.
    """
    name = " ".join(text.upper().replace("–", "-").split())
    form = _FORM.fullmatch(name) if len(name) <= LONGEST_DESIGNATION else None
    basic = None if form is None else _basic(form["letters"] or "", form["number"])
    if form is None or basic is None or _is_steep(basic, form["suffix"] or ""):
        raise checks.refuse(
            "designation", text[:LONGEST_DESIGNATION], f"a bearing of the series {series_words()}"
        )
    suffix = form["suffix"] or ""
    kind, size = _kind_of(basic), boundaries()[basic]
    assumed: list[str] = []
    angle = _angle(kind, size, suffix, assumed)
    given = _CLEARANCE.search(suffix)
    none = kind in (ANGULAR_CONTACT, TAPERED)
    clearance_class = "" if none else f"C{given[1]}" if given else "CN"
    play = 0.0
    if clearance_class:
        least, most = clearance(kind, size.bore, clearance_class)
        play = 0.5 * (least + most)
        assumed.append(
            f"a clearance of {number(1e6 * play)} µm, the middle of {clearance_class} "
            f"({number(1e6 * least)} to {number(1e6 * most)} µm)"
        )
    inside = inside_of(basic)
    bearing = _built(kind, inside, angle, play, assumed)
    rating = size.dynamic_rating * _rating_at(kind, inside, angle)
    if kind == TAPERED:
        bearing = _mounted(bearing, size, suffix, assumed)
        rating *= len(bearing.all_rows) ** ROWS_OF_ROLLERS
    return Designation(
        _PAIR.sub(lambda pair: pair[0].lower() if pair["words"] else pair[0], name),
        basic,
        kind,
        size.bore,
        size.outside_diameter,
        size.width,
        rating,
        clearance_class,
        bearing,
        tuple(assumed),
    )


def designations(beginning: str = "") -> Iterator[str]:
    """Basic numbers of the table that begin so; "nu 2" is as good as "NU2", and N and NJ as NU."""
    wanted = re.sub(r"^(NUP|NJ|N)(?=\d)", "NU", beginning.upper().replace(" ", ""))
    return (basic for basic in boundaries() if basic.startswith(wanted))


def series_words() -> str:
    """The series that are known by number, in words."""
    names = {kind: [s for s, of in SERIES.items() if of == kind] for kind in SERIES.values()}
    listed = "; ".join(f"{', '.join(of)} ({kind}s)" for kind, of in names.items())
    return f"{listed}; bores of 10 to 100 mm, of rollers from 20 mm"


@cache
def inside_of(basic: str) -> Inside:
    """Estimated rolling elements of a basic number of the table."""
    size, kind = boundaries()[basic], _kind_of(basic)
    if kind == TAPERED:
        return tapered_rollers_from_ratings(
            size.bore,
            size.outside_diameter,
            size.dynamic_rating,
            size.static_rating,
            _rated_angle(kind, size),
        )
    if kind == ROLLERS:
        alike = [
            other.static_rating
            for name, other in boundaries().items()
            if name != basic
            and (other.inner_raceway, other.outer_raceway)
            == (size.inner_raceway, size.outer_raceway)
        ]
        ratings_of_all = (size.static_rating, *alike)
        return rollers_from_raceways(size.inner_raceway, size.outer_raceway, ratings_of_all)
    return balls_from_ratings(
        size.bore,
        size.outside_diameter,
        size.dynamic_rating,
        size.static_rating,
        _rated_angle(kind, size),
        None if math.isnan(size.factor) else size.factor,
        kind == SELF_ALIGNING,
    )


@cache
def _rows(name: str) -> list[dict[str, str]]:
    """Lines of a table of this package by their headings."""
    text = resources.files("bearingcore.bearings").joinpath(name).read_text("utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter=";"))


def _basic(letters: str, digits: str) -> str | None:
    """The number as the table has it; None where it has it not."""
    if letters in ("NU", "N", "NJ", "NUP"):
        digits = f"NU{digits}"
    elif letters == "NF" or (letters == "HR" and SERIES.get(digits[:-2]) != TAPERED):
        return None
    elif len(digits) == 4 and digits[:2] in ("68", "69"):  # as Japanese makers shorten 618, 619
        digits = f"61{digits[1:]}"
    return digits if digits in boundaries() else None


def _kind_of(basic: str) -> str:
    return SERIES[basic[:-2]]


def _is_steep(basic: str, suffix: str) -> bool:
    """Whether letters behind the number of tapered rollers make it another bearing."""
    return _kind_of(basic) == TAPERED and _STEEP.match(_PAIR.sub("", suffix)) is not None


def _rated_angle(kind: str, size: Boundary) -> float:
    """Contact angle [rad] for which the table has the ratings."""
    if kind == SELF_ALIGNING:
        return ratings.contact_angle_of(size.axial_factor)
    if kind == TAPERED:
        return ratings.tapered_angle_of(size.thrust_limit)
    return CATALOGUE_ANGLE if kind == ANGULAR_CONTACT else 0.0


def _angle(kind: str, size: Boundary, suffix: str, assumed: list[str]) -> float:
    """Contact angle [rad] of a designation."""
    if kind != ANGULAR_CONTACT:
        return _rated_angle(kind, size)
    letters = _ANGLE.match(suffix)
    if letters is None:
        assumed.append("a contact angle of 30°, as no letter says it (B is 40°, AC 25°, C 15°)")
        return CATALOGUE_ANGLE
    return math.radians(ANGLES[letters[1]])


def _rating_at(kind: str, inside: Inside, angle: float) -> float:
    """C_r at a contact angle over that of the catalogue, by ISO 281; 1 where there is one angle."""
    if kind != ANGULAR_CONTACT:
        return 1.0

    def rated(at: float) -> float:
        cosine = math.cos(at)
        gamma = inside.ball_diameter * cosine / inside.pitch_diameter
        f_c = ratings.capacity_factor(gamma, USUAL_GROOVES["inner"], USUAL_GROOVES["inner"])
        return float(ratings.dynamic_rating(f_c, inside.n_balls, inside.ball_diameter, cosine))

    return rated(angle) / rated(CATALOGUE_ANGLE)


def _built(kind: str, inside: Inside, angle: float, play: float, assumed: list[str]) -> Bearing:
    """The bearing, with `play` [m] from contact to contact; adds what is assumed of its grooves."""
    count, D, pitch = inside.n_balls, inside.ball_diameter, inside.pitch_diameter
    estimated = ("n_balls", "ball_diameter", "pitch_diameter")
    if inside.roller_length is not None:
        if kind == ROLLERS:
            made = Bearing.cylindrical(count, D, inside.roller_length, pitch, 0.5 * play)
            return made.replace(estimated=("n_balls", "roller_length"))
        made = Bearing.tapered(count, D, inside.roller_length, pitch, angle)
        return made.replace(estimated=(*estimated, "roller_length"))
    if kind == SELF_ALIGNING:
        assumed.append(f"inner grooves of {USUAL_GROOVE:g} ball diameters")
        sphere = 0.5 * pitch / math.cos(angle) + 0.5 * D
        made = Bearing.self_aligning(count, D, sphere, USUAL_GROOVE * D, angle, 0.5 * play)
        return made.replace(estimated=estimated)
    inner, outer = USUAL_GROOVES["inner"], USUAL_GROOVES["outer"]
    assumed.append(f"grooves of {inner:g} (inner) and {outer:g} (outer) ball diameters")
    made = Bearing.from_drawing(
        count, D, pitch, inner * D, outer * D, contact_angle=angle, diametral_clearance=play
    )
    return made.replace(estimated=estimated)


def _mounted(bearing: Bearing, size: Boundary, suffix: str, assumed: list[str]) -> Bearing:
    """Tapered rollers as the suffix arranges them; adds what is assumed of their mounting.

    Back to back the cups touch, face to face the cones; rollers are in the middle of their cup.
    """
    pair = _PAIR.search(suffix)
    if pair is None:
        assumed.append("neither clearance nor preload, which are set as it is mounted")
        return bearing
    back = (pair["letter"] or pair["words"]).startswith("B")
    distance = size.cup_width if back else 2.0 * size.width - size.cup_width
    touching = "cups" if back else "cones"
    assumed.append(
        f"rows {number(1e3 * distance, 4)} mm apart, as {touching} that touch each other, without "
        "clearance or preload"
    )
    return bearing.paired(distance, "back-to-back" if back else "face-to-face")
