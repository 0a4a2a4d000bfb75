"""A bearing by its designation: "6208-2RS/C3", "7208 BECBP DB", "NU 208", "2206", "30206 DB".

The basic number gives boundary dimensions (ISO 15, ISO 355), the suffix the contact angle of
angular-contact bearings, a reinforced inside, the class of clearance (ISO 5753-1), balls of silicon
nitride and the arrangement of two angular-contact or tapered bearings: see
`bearingcore.bearings._suffix`. The inside is estimated from the ratings of a catalogue, see
`bearingcore.bearings._inside`: the bearing says so itself (`Bearing.estimated`).

Understood are deep groove bearings 60, 62, 63, 64, 160, 618, 619, angular-contact ones 70, 72, 73,
719, self-aligning ones 12, 13, 22, 23, cylindrical rollers NU, N, NJ, NUP of the series 2, 3, 10,
22, 23 and tapered rollers 302, 303, 320, 322, 323, with bores of 10 to 100 mm (604 to 609 and 623
to 629 below, rollers from 20 mm; 719 from 10 mm is 79 of other makers). Tapered
rollers with steeper cups (B, C, D behind the number) are other bearings, and are not.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache

from bearingcore.bearings import _ratings as ratings
from bearingcore.bearings._bearing import Bearing
from bearingcore.bearings._catalogue import CatalogueBearing
from bearingcore.bearings._designation_tables import (
    Boundary,
    boundaries,
    clearance,
    matched_clearance,
    rows_of,
    series_of,
)
from bearingcore.bearings._drawing import USUAL_GROOVES
from bearingcore.bearings._inside import (
    Inside,
    accuracy,
    balls_from_ratings,
    rollers_from_raceways,
    tapered_rollers_from_ratings,
)
from bearingcore.bearings._material import BALL_MATERIALS
from bearingcore.bearings._self_aligning import USUAL_GROOVE
from bearingcore.bearings._suffix import (
    ANGULAR_CONTACT,
    BEFORE,
    DEEP_GROOVE,
    REINFORCED,
    ROLLERS,
    SELF_ALIGNING_BALLS,
    TAPERED_ROLLERS,
    Suffix,
    is_reinforced,
    is_steep,
    lower_arrangement,
    read_suffix,
    unknown_letters,
)
from bearingcore.common import _checks as checks, number

SERIES: Mapping[str, str] = {
    **dict.fromkeys(("60", "62", "63", "64", "160", "618", "619"), DEEP_GROOVE),
    **dict.fromkeys(("70", "72", "73", "719"), ANGULAR_CONTACT),
    **dict.fromkeys(("12", "13", "22", "23"), SELF_ALIGNING_BALLS),
    **dict.fromkeys(("NU2", "NU3", "NU10", "NU22", "NU23"), ROLLERS),
    **dict.fromkeys(("302", "303", "320", "322", "323"), TAPERED_ROLLERS),
}
"""Kind of bearing of each series; N, NJ and NUP have the dimensions of NU."""

CATALOGUE_ANGLE = math.radians(30.0)
"""Contact angle for which the table has the ratings of angular-contact bearings."""

OTHER_ANGLES = {"719": math.radians(15.0)}
"""That angle for series whose ratings are for another one."""

ROWS_OF_BALLS, ROWS_OF_ROLLERS = 0.7, 7.0 / 9.0
"""Powers with which C_r of ISO 281 grows with the rows of balls and of rollers."""

LONGEST_DESIGNATION = 60

_FORM = re.compile(
    BEFORE + r"(?:(?P<letters>NUP|NU|NJ|NF|N|B|HR)[ -]?)?(?P<number>\d{3,5})(?P<suffix>\D.*)?"
)
_ROWS_OF = {ANGULAR_CONTACT: ROWS_OF_BALLS, TAPERED_ROLLERS: ROWS_OF_ROLLERS} | dict.fromkeys(
    (DEEP_GROOVE, SELF_ALIGNING_BALLS, ROLLERS), 0.0
)
"""Power of the number of rows in C_r; the rating of the others is that of the whole bearing."""


@dataclass(frozen=True)
class Designation:
    """A bearing known by its designation.

    Attributes
    ----------
    name
        as given, in capitals except for an arrangement in words.
    basic
        the number without suffix, as the table has it: "6208", "NU208", "61804".
    kind
        out of the values of SERIES.
    bore, outside_diameter, width
        boundary dimensions [m] by ISO 15, of tapered rollers by ISO 355: T of one bearing.
    dynamic_load_rating
        C_r [N] of the catalogue, at the contact angle of the designation; of a pair that of both
        rows, by ISO 281. None where it is not known: of hybrid bearings, and of a class of steel
        that its maker rates higher.
    clearance_class
        out of CLEARANCE_CLASSES; empty for angular-contact and tapered bearings, which have none.
    bearing
        with estimated inside dimensions.
    assumed
        assumptions beyond the designation, in words.
    reinforced
        letters of a reinforced inside, such as "BECB"; empty for the plain one.
    unread
        letters behind the number without a known meaning.
    """

    name: str
    basic: str
    kind: str
    bore: float
    outside_diameter: float
    width: float
    dynamic_load_rating: float | None
    clearance_class: str
    bearing: Bearing
    assumed: tuple[str, ...]
    reinforced: str = ""
    unread: str = ""

    @property
    def entry(self) -> CatalogueBearing:
        """The bearing as an entry of a list of bearings."""
        kind = self.kind[0].upper() + self.kind[1:]
        if self.bearing.arrangement:
            stand = self.bearing.arrangement.replace("-", " ").replace("tandem", "in tandem")
            kind = f"Two {self.kind}s, {stand}"
        tapered = self.kind == TAPERED_ROLLERS
        digits = 3 if tapered else 5
        note = (
            f"{kind}. By ISO {355 if tapered else 15}: bore {number(1e3 * self.bore, 4)} mm, "
            f"outside diameter {number(1e3 * self.outside_diameter, 4)} mm, width "
            f"{number(1e3 * self.width, 4)} mm. Estimated, as makers do not print it: "
            f"{self.bearing.n_balls} {self.bearing.kind.elements} of "
            f"{number(1e3 * self.bearing.ball_diameter, digits)} mm, from the load ratings of the "
        )
        note += (
            f"SKF catalogue for the reinforced inside ({self.reinforced}). How good that is has "
            "not been measured, and makers differ: count the balls."
            if self.reinforced
            else "JTEKT (Koyo) catalogue; nine of ten of other makers' are from 10 % below to 15 % "
            "above, some of small or thin bearings 35 % below or above. "
            f"{accuracy(self.bearing.kind, self.bearing.contact_angle)}"
        )
        return CatalogueBearing(
            self.name, self.bearing, self.dynamic_load_rating, note, self.assumed, self.unread
        )


def read_designation(text: str) -> Designation:
    """Return the bearing of a designation; case, spaces and the maker's name do not matter.

    Raises
    ------
    ValueError
        for a text that is no designation, or one of an unknown series or size.
    """
    checks.instance("designation", text, str, 'text such as "6205-2RS/C3"')
    form, basic = _parse(text)
    # the table has no steep tapered rollers, whose other angle makes another inside
    steep = form and basic and _kind_of(basic) == TAPERED_ROLLERS and is_steep(form["suffix"] or "")
    if not form or not basic or steep:
        allowed = f"a bearing of the series {series_words()}; {BY_FREQUENCIES}"
        raise checks.refuse("designation", text[:LONGEST_DESIGNATION], allowed)
    name, letters, suffix = form.string, form["letters"] or "", form["suffix"] or ""
    kind, size = _kind_of(basic), boundaries()[basic]
    said = read_suffix(name, kind, suffix, form["count"] or "", form["ceramic"] is not None)
    if said.inside:
        size = _reinforced(name, basic, size, said.inside)
    elif _has_plain_rollers(basic) and is_reinforced(suffix):
        raise checks.refuse("designation", name, REINFORCED)
    assumed: list[str] = []
    angle = _angle(basic, size, said.angle, assumed)
    has_clearance = kind not in (ANGULAR_CONTACT, TAPERED_ROLLERS)  # theirs is set at mounting
    clearance_class = (said.clearance_class or "CN") if has_clearance else ""
    play = _play(kind, size, clearance_class, assumed) if has_clearance else 0.0
    inside = _inside(kind, size, angle) if said.inside else inside_of(basic)
    bearing = _built(kind, inside, angle, play, assumed)
    if unread := unknown_letters(kind, suffix):
        assumed.append(f"that {unread}, which is not known here, changes nothing")
    if kind == ROLLERS:
        assumed += _flange_words(letters, basic, suffix)
    if said.is_ceramic:
        ceramic = BALL_MATERIALS["silicon nitride"]
        bearing = bearing.with_balls_of(ceramic)
        assumed.append(
            f"balls of silicon nitride with {number(1e-9 * (ceramic.youngs_modulus or 0.0))} GPa; "
            "their load rating (ISO 20056) is not known here"
        )
    elif said.has_better_steel:
        assumed.append("no load rating: that of X-life is its maker's")
    bearing = _mounted(bearing, kind, size, said, assumed)
    rating = size.dynamic_rating * (1.0 if said.inside else _rating_at(basic, inside, angle))
    rating *= len(bearing.all_rows) ** _ROWS_OF[kind]
    known = None if said.is_ceramic or said.has_better_steel else rating
    return Designation(
        lower_arrangement(name),
        basic,
        kind,
        size.bore,
        size.outside_diameter,
        size.width,
        known,
        clearance_class,
        bearing.replace(dynamic_load_rating=known),
        tuple(assumed),
        said.inside,
        unread,
    )


def _parse(text: str) -> tuple[re.Match[str] | None, str | None]:
    """Parts of a designation in capitals, and its basic number in the table; None where none is."""
    name = " ".join(text.upper().replace("–", "-").split())
    name = re.sub(r"^(\d{2,3}) (\d{2})\b", r"\1\2", name)  # "320 08": series, then bore
    form = _FORM.fullmatch(name) if len(name) <= LONGEST_DESIGNATION else None
    return form, form and _basic(form["letters"] or "", form["number"])


def _play(kind: str, size: Boundary, clearance_class: str, assumed: list[str]) -> float:
    """Clearance [m] in the middle of a class, which is added to what is assumed."""
    least, most = clearance(kind, size.bore, clearance_class)
    play = 0.5 * (least + most)
    assumed.append(
        f"a clearance of {number(1e6 * play)} µm, the middle of {clearance_class} "
        f"({number(1e6 * least)} to {number(1e6 * most)} µm)"
    )
    return play


def is_known(text: str) -> bool:
    """Return True if a text names a bearing of the table, also one whose suffix is refused."""
    return _parse(text)[1] is not None


def designations(beginning: str = "") -> Iterator[str]:
    """Basic numbers of the table that begin so; "nu 2" is as good as "NU2".

    Those of N, NJ and NUP, which the table has as NU, are given with their own letters.
    """
    wanted = beginning.upper().replace(" ", "")
    match = re.match(r"NUP|NJ|N(?=\d)", wanted)
    letters = match[0] if match else ""
    table = f"NU{wanted.removeprefix(letters)}" if letters else wanted
    basics = (basic for basic in boundaries() if basic.startswith(table))
    return (letters + basic.removeprefix("NU") if letters else basic for basic in basics)


BY_FREQUENCIES = (
    "another bearing has other frequencies, however alike: say its own (BPFO, BPFI, BSF, FTF), "
    "which are in the maker's sheet"
)


def series_words() -> str:
    """The series that are known by number, in words."""
    names = {kind: [s for s, of in SERIES.items() if of == kind] for kind in SERIES.values()}
    listed = "; ".join(f"{', '.join(of)} ({kind}s)" for kind, of in names.items())
    return f"{listed}; bores of 10 to 100 mm, of 60 and 62 from 3 mm, of rollers from 20 mm"


@cache
def inside_of(basic: str) -> Inside:
    """Estimated rolling elements of a basic number of the table."""
    size, kind = boundaries()[basic], _kind_of(basic)
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
    return _inside(kind, size, _rated_angle(basic, size))


def _inside(kind: str, size: Boundary, angle: float) -> Inside:
    """Balls or tapered rollers with the ratings of a line of the table at an angle [rad]."""
    rated = size.dynamic_rating, size.static_rating
    if kind == TAPERED_ROLLERS:
        return tapered_rollers_from_ratings(size.bore, size.outside_diameter, *rated, angle)
    return balls_from_ratings(
        size.bore,
        size.outside_diameter,
        *rated,
        angle,
        None if math.isnan(size.factor) else size.factor,
        kind == SELF_ALIGNING_BALLS,
    )


def _reinforced(name: str, basic: str, size: Boundary, inside: str) -> Boundary:
    """A line of the table with the ratings of a reinforced inside; refused where not tabulated."""
    rows = [row[inside] for row in rows_of("reinforced.csv") if row["designation"] == basic]
    if not rows or not rows[0]:
        raise checks.refuse("designation", name, REINFORCED)
    C, C_0, *Y_1 = map(float, rows[0].split())
    axial = Y_1[0] if Y_1 else size.axial_factor
    return size._replace(
        dynamic_rating=1e3 * C, static_rating=1e3 * C_0, axial_factor=axial, factor=math.nan
    )


def _basic(letters: str, digits: str) -> str | None:
    """The number as the table has it; None where it has it not."""
    if letters in ("NU", "N", "NJ", "NUP"):
        digits = f"NU{digits}"
    elif letters == "NF" or (letters == "HR" and SERIES.get(series_of(digits)) != TAPERED_ROLLERS):
        return None
    elif len(digits) == 4 and digits[:2] in ("68", "69", "79"):  # 618, 619, 719 of Japanese makers
        digits = f"{digits[0]}1{digits[1:]}"
    return digits if digits in boundaries() else None


def _kind_of(basic: str) -> str:
    return SERIES[series_of(basic)]


def _rated_angle(basic: str, size: Boundary) -> float:
    """Contact angle [rad] for which the table has the ratings."""
    kind = _kind_of(basic)
    if kind == SELF_ALIGNING_BALLS:
        return math.atan(0.42 / size.axial_factor)  # Y_1 of ISO 281 is 0.42 cot α
    if kind == TAPERED_ROLLERS:
        return math.atan(size.thrust_limit / 1.5)  # e of ISO 281 is 1.5 tan α
    angle = OTHER_ANGLES.get(series_of(basic), CATALOGUE_ANGLE)
    return angle if kind == ANGULAR_CONTACT else 0.0


def _angle(basic: str, size: Boundary, said: float | None, assumed: list[str]) -> float:
    """Contact angle [rad] of a designation that says an angle [degrees], or none."""
    rated = _rated_angle(basic, size)
    if _kind_of(basic) != ANGULAR_CONTACT:
        return rated
    if said is None:
        angle = number(math.degrees(rated))
        assumed.append(
            f"a contact angle of {angle}°, as no letter says it (B is 40°, AC 25°, C 15°)"
        )
        return rated
    return math.radians(said)


def _rating_at(basic: str, inside: Inside, angle: float) -> float:
    """C_r at a contact angle over that of the catalogue, by ISO 281; 1 where there is one angle."""
    if _kind_of(basic) != ANGULAR_CONTACT:
        return 1.0

    def rated(at: float) -> float:
        cosine = math.cos(at)
        gamma = inside.ball_diameter * cosine / inside.pitch_diameter
        f_c = ratings.capacity_factor(gamma, USUAL_GROOVES["inner"], USUAL_GROOVES["inner"])
        return float(ratings.dynamic_rating(f_c, inside.n_balls, inside.ball_diameter, cosine))

    return rated(angle) / rated(OTHER_ANGLES.get(series_of(basic), CATALOGUE_ANGLE))


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
    if kind == SELF_ALIGNING_BALLS:
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


def _flange_words(letters: str, basic: str, suffix: str) -> list[str]:
    """Words on the flanges and the inside of cylindrical rollers."""
    assumed = []
    if letters in ("NJ", "NUP"):
        ways = "one way" if letters == "NJ" else "both ways"
        assumed.append(f"no load along the shaft, which the flanges of {letters} carry {ways}")
    if _has_plain_rollers(basic):
        assumed.append("the plain inside: a reinforced one (E) has other rollers")
    elif not is_reinforced(suffix):
        assumed.append("the reinforced inside (E) that makers deliver today")
    return assumed


def _has_plain_rollers(basic: str) -> bool:
    """Return True if the table has cylindrical rollers without the usual reinforced inside."""
    return basic.startswith("NU10") or basic == "NU2319"


def _mounted(
    bearing: Bearing, kind: str, size: Boundary, said: Suffix, assumed: list[str]
) -> Bearing:
    """The bearing alone or as the suffix arranges two; adds what is assumed of their mounting.

    Back to back outer rings touch, face to face inner ones. Balls are in the middle of their
    width. The pressure centres of tapered rollers are `pressure_center` from the back of the cup:
    the lines of contact, through the middles of the rollers, meet the shaft there.
    """
    if not said.arrangement:
        if kind == TAPERED_ROLLERS:
            assumed.append("neither clearance nor preload, which are set as it is mounted")
        elif said.matched:
            assumed.append(f"no clearance, as {said.matched} is that of two such bearings")
        return bearing
    distance = size.width
    words = f"rows {number(1e3 * distance, 4)} mm apart, as rings that touch"
    if said.arrangement == "tandem":
        assumed.append(words)
        return bearing.paired(distance, said.arrangement)
    back = said.arrangement == "back-to-back"
    reach = bearing.pitch_diameter * math.tan(bearing.contact_angle)
    if kind == TAPERED_ROLLERS:
        centers = 2.0 * (size.pressure_center if back else size.width - size.pressure_center)
        distance = centers - reach if back else centers + reach
        words = (
            f"pressure centres {number(1e3 * centers, 3)} mm apart, as "
            f"{'cups' if back else 'cones'} that touch"
        )
    preload, clearance_words = _set(size, said)
    assumed.append(f"{words}, {clearance_words}")
    return bearing.paired(distance, said.arrangement, preload)


def _set(size: Boundary, said: Suffix) -> tuple[float, str]:
    """Preload [m] of a pair, below 0 an axial clearance, and both in words."""
    play, words = said.axial_play, ""
    if said.matched:
        least, most = matched_clearance(size.bore, said.matched)
        play = 0.5 * (least + most)
        words = f", the middle of {said.matched} ({number(1e6 * least)} to {number(1e6 * most)} µm)"
    if not play:
        return 0.0, f"without clearance or preload{words}"
    name = "preload" if play < 0.0 else "clearance"
    return -play, f"an axial {name} of {number(1e6 * abs(play))} µm{words}"
