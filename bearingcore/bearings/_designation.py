"""A bearing by its designation: "6208-2RS/C3", "7208 BECBP DB", "NU 208", "2206", "30206 DB".

The basic number gives boundary dimensions (ISO 15, ISO 355). The suffix gives the contact angle of
angular-contact bearings, a reinforced inside, the class of clearance (ISO 5753-1), balls of silicon
nitride and the arrangement of two angular-contact or tapered bearings: see
`bearingcore.bearings._suffix`. The inside is estimated from the ratings of a catalogue, see
`bearingcore.bearings._inside`; `Bearing.estimated` names the estimates.

The known series are deep groove 60, 62, 63, 64, 160, 618, 619; angular-contact 70, 72, 73, 719 (79
of other makers); self-aligning 12, 13, 22, 23; cylindrical rollers NU, N, NJ, NUP 2, 3, 10, 22, 23;
and tapered rollers 302, 303, 320, 322, 323. Bores are 10 to 100 mm; 604 to 609 and 623 to 629 have
smaller ones, rollers begin at 20 mm. Tapered rollers with steeper cups (B, C, D behind the number)
are other bearings and not known.
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
"""Exceptions to CATALOGUE_ANGLE, by series."""

ROWS_OF_BALLS, ROWS_OF_ROLLERS = 0.7, 7.0 / 9.0
"""Exponents of the number of rows in C_r of ISO 281, for balls and for rollers."""

LONGEST_DESIGNATION = 60

_FORM = re.compile(
    BEFORE + r"(?:(?P<letters>NUP|NU|NJ|NF|N|B|HR)[ -]?)?(?P<number>\d{3,5})(?P<suffix>\D.*)?"
)
_ROW_EXPONENTS = {ANGULAR_CONTACT: ROWS_OF_BALLS, TAPERED_ROLLERS: ROWS_OF_ROLLERS} | dict.fromkeys(
    (DEEP_GROOVE, SELF_ALIGNING_BALLS, ROLLERS), 0.0
)
"""Exponent of the number of rows in C_r by kind; 0 where the table rates the whole bearing."""


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
        C_r [N] of the catalogue, at the contact angle of the designation; for a pair that of both
        rows, by ISO 281. None where it is not known: for hybrid bearings, and for a class of steel
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
            words = self.bearing.arrangement.replace("-", " ").replace("tandem", "in tandem")
            kind = f"Two {self.kind}s, {words}"
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
    # steep tapered rollers are not in the table: with another angle they have another inside
    steep = form and basic and _kind_of(basic) == TAPERED_ROLLERS and is_steep(form["suffix"] or "")
    if not form or not basic or steep:
        allowed = f"a bearing of the series {series_words()}; {BY_FREQUENCIES}"
        raise checks.refuse("designation", text[:LONGEST_DESIGNATION], allowed)
    name, letters, suffix = form.string, form["letters"] or "", form["suffix"] or ""
    kind, size = _kind_of(basic), boundaries()[basic]
    meaning = read_suffix(name, kind, suffix, form["count"] or "", form["ceramic"] is not None)
    if meaning.inside:
        size = _reinforced(name, basic, size, meaning.inside)
    elif _has_plain_rollers(basic) and is_reinforced(suffix):
        raise checks.refuse("designation", name, REINFORCED)
    assumed: list[str] = []
    angle = _angle(basic, size, meaning.angle, assumed)
    has_clearance = kind not in (ANGULAR_CONTACT, TAPERED_ROLLERS)  # theirs is set at mounting
    clearance_class = (meaning.clearance_class or "CN") if has_clearance else ""
    play = _play(kind, size, clearance_class, assumed) if has_clearance else 0.0
    inside = _inside(kind, size, angle) if meaning.inside else inside_of(basic)
    bearing = _build(kind, inside, angle, play, assumed)
    if unread := unknown_letters(kind, suffix):
        assumed.append(f"that {unread}, which is not known here, changes nothing")
    if kind == ROLLERS:
        assumed += _flange_words(letters, basic, suffix)
    if meaning.is_ceramic:
        ceramic = BALL_MATERIALS["silicon nitride"]
        bearing = bearing.with_balls_of(ceramic)
        assumed.append(
            f"balls of silicon nitride with {number(1e-9 * (ceramic.youngs_modulus or 0.0))} GPa; "
            "their load rating (ISO 20056) is not known here"
        )
    elif meaning.has_better_steel:
        assumed.append("no load rating: only its maker knows that of X-life")
    bearing = _mount(bearing, kind, size, meaning, assumed)
    rating = size.dynamic_rating * (1.0 if meaning.inside else _rating_ratio(basic, inside, angle))
    rating *= len(bearing.all_rows) ** _ROW_EXPONENTS[kind]
    known_rating = None if meaning.is_ceramic or meaning.has_better_steel else rating
    return Designation(
        lower_arrangement(name),
        basic,
        kind,
        size.bore,
        size.outside_diameter,
        size.width,
        known_rating,
        clearance_class,
        bearing.replace(dynamic_load_rating=known_rating),
        tuple(assumed),
        meaning.inside,
        unread,
    )


def _parse(text: str) -> tuple[re.Match[str] | None, str | None]:
    """Return the parts of a designation in capitals, and its basic number; None if not listed."""
    name = " ".join(text.upper().replace("–", "-").split())
    name = re.sub(r"^(\d{2,3}) (\d{2})\b", r"\1\2", name)  # "320 08": series, then bore
    form = _FORM.fullmatch(name) if len(name) <= LONGEST_DESIGNATION else None
    return form, form and _basic(form["letters"] or "", form["number"])


def _play(kind: str, size: Boundary, clearance_class: str, assumed: list[str]) -> float:
    """Return the clearance [m] in the middle of a class, and add it to `assumed`."""
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
    """Return the basic numbers of the table with a beginning such as "62", "NU2" or "nu 2".

    The table lists N, NJ and NUP as NU; they are returned with their own letters.
    """
    wanted = beginning.upper().replace(" ", "")
    match = re.match(r"NUP|NJ|N(?=\d)", wanted)
    letters = match[0] if match else ""
    table = f"NU{wanted.removeprefix(letters)}" if letters else wanted
    basics = (basic for basic in boundaries() if basic.startswith(table))
    return (letters + basic.removeprefix("NU") if letters else basic for basic in basics)


BY_FREQUENCIES = (
    "even a similar bearing has other frequencies: enter its own (BPFO, BPFI, BSF, FTF) from the "
    "maker's sheet"
)


def series_words() -> str:
    """Return the series that are known by number, in words."""
    kinds = {kind: [s for s in SERIES if SERIES[s] == kind] for kind in SERIES.values()}
    listed = "; ".join(f"{', '.join(series)} ({kind}s)" for kind, series in kinds.items())
    return f"{listed}; bores of 10 to 100 mm, of 60 and 62 from 3 mm, of rollers from 20 mm"


@cache
def inside_of(basic: str) -> Inside:
    """Return the estimated rolling elements of a basic number of the table."""
    size, kind = boundaries()[basic], _kind_of(basic)
    if kind == ROLLERS:
        of_same_raceways = [
            other.static_rating
            for name, other in boundaries().items()
            if name != basic
            and (other.inner_raceway, other.outer_raceway)
            == (size.inner_raceway, size.outer_raceway)
        ]
        ratings_of_all = (size.static_rating, *of_same_raceways)
        return rollers_from_raceways(size.inner_raceway, size.outer_raceway, ratings_of_all)
    return _inside(kind, size, _rated_angle(basic, size))


def _inside(kind: str, size: Boundary, angle: float) -> Inside:
    """Return balls or tapered rollers with the ratings of a table's line at an angle [rad]."""
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
    """Return a table's line with the ratings of a reinforced inside; FieldError without them."""
    rows = [row[inside] for row in rows_of("reinforced.csv") if row["designation"] == basic]
    if not rows or not rows[0]:
        raise checks.refuse("designation", name, REINFORCED)
    C, C_0, *Y_1 = map(float, rows[0].split())
    axial = Y_1[0] if Y_1 else size.axial_factor
    return size._replace(
        dynamic_rating=1e3 * C, static_rating=1e3 * C_0, axial_factor=axial, factor=math.nan
    )


def _basic(letters: str, digits: str) -> str | None:
    """Return the basic number as the table spells it; None if it is not in the table."""
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
    """Return the contact angle [rad] for which the table has the ratings."""
    kind = _kind_of(basic)
    if kind == SELF_ALIGNING_BALLS:
        return math.atan(0.42 / size.axial_factor)  # Y_1 of ISO 281 is 0.42 cot α
    if kind == TAPERED_ROLLERS:
        return math.atan(size.thrust_limit / 1.5)  # e of ISO 281 is 1.5 tan α
    angle = OTHER_ANGLES.get(series_of(basic), CATALOGUE_ANGLE)
    return angle if kind == ANGULAR_CONTACT else 0.0


def _angle(basic: str, size: Boundary, stated: float | None, assumed: list[str]) -> float:
    """Return the contact angle [rad]: the stated one [degrees], or that of the ratings."""
    rated = _rated_angle(basic, size)
    if _kind_of(basic) != ANGULAR_CONTACT:
        return rated
    if stated is None:
        angle = number(math.degrees(rated))
        assumed.append(
            f"a contact angle of {angle}°, as no letter states it (B is 40°, AC 25°, C 15°)"
        )
        return rated
    return math.radians(stated)


def _rating_ratio(basic: str, inside: Inside, angle: float) -> float:
    """Return C_r at a contact angle over that of the catalogue (ISO 281); 1 for other kinds."""
    if _kind_of(basic) != ANGULAR_CONTACT:
        return 1.0

    def rating(contact_angle: float) -> float:
        cosine = math.cos(contact_angle)
        gamma = inside.ball_diameter * cosine / inside.pitch_diameter
        f_c = ratings.capacity_factor(gamma, USUAL_GROOVES["inner"], USUAL_GROOVES["inner"])
        return float(ratings.dynamic_rating(f_c, inside.n_balls, inside.ball_diameter, cosine))

    return rating(angle) / rating(OTHER_ANGLES.get(series_of(basic), CATALOGUE_ANGLE))


def _build(kind: str, inside: Inside, angle: float, play: float, assumed: list[str]) -> Bearing:
    """Build a bearing with `play` [m] from contact to contact; add its grooves to `assumed`."""
    count, D, pitch = inside.n_balls, inside.ball_diameter, inside.pitch_diameter
    estimated = ("n_balls", "ball_diameter", "pitch_diameter")
    if inside.roller_length is not None:
        if kind == ROLLERS:
            bearing = Bearing.cylindrical(count, D, inside.roller_length, pitch, 0.5 * play)
            return bearing.replace(estimated=("n_balls", "roller_length"))
        bearing = Bearing.tapered(count, D, inside.roller_length, pitch, angle)
        return bearing.replace(estimated=(*estimated, "roller_length"))
    if kind == SELF_ALIGNING_BALLS:
        assumed.append(f"inner grooves of {USUAL_GROOVE:g} ball diameters")
        sphere = 0.5 * pitch / math.cos(angle) + 0.5 * D
        bearing = Bearing.self_aligning(count, D, sphere, USUAL_GROOVE * D, angle, 0.5 * play)
        return bearing.replace(estimated=estimated)
    inner, outer = USUAL_GROOVES["inner"], USUAL_GROOVES["outer"]
    assumed.append(f"grooves of {inner:g} (inner) and {outer:g} (outer) ball diameters")
    bearing = Bearing.from_drawing(
        count, D, pitch, inner * D, outer * D, contact_angle=angle, diametral_clearance=play
    )
    return bearing.replace(estimated=estimated)


def _flange_words(letters: str, basic: str, suffix: str) -> list[str]:
    """Return the assumptions on flanges and inside of cylindrical rollers, in words."""
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


def _mount(
    bearing: Bearing, kind: str, size: Boundary, meaning: Suffix, assumed: list[str]
) -> Bearing:
    """Return the bearing, or the pair that its suffix names; add the mounting to `assumed`.

    In a pair back to back the outer rings touch, in one face to face the inner rings. Balls are in
    the middle of their width. Lines of contact, through the middles of tapered rollers, meet the
    shaft at the pressure centre: it is `pressure_center` from the back of the cup.
    """
    if not meaning.arrangement:
        if kind == TAPERED_ROLLERS:
            assumed.append("neither clearance nor preload, which are set at mounting")
        elif meaning.matched:
            assumed.append(f"no clearance, as {meaning.matched} is that of two such bearings")
        return bearing
    distance = size.width
    words = f"rows {number(1e3 * distance, 4)} mm apart, as rings that touch"
    if meaning.arrangement == "tandem":
        assumed.append(words)
        return bearing.paired(distance, meaning.arrangement)
    back = meaning.arrangement == "back-to-back"
    reach = bearing.pitch_diameter * math.tan(bearing.contact_angle)
    if kind == TAPERED_ROLLERS:
        centers = 2.0 * (size.pressure_center if back else size.width - size.pressure_center)
        distance = centers - reach if back else centers + reach
        words = (
            f"pressure centres {number(1e3 * centers, 3)} mm apart, as "
            f"{'cups' if back else 'cones'} that touch"
        )
    preload, clearance_words = _pair_preload(size, meaning)
    assumed.append(f"{words}, {clearance_words}")
    return bearing.paired(distance, meaning.arrangement, preload)


def _pair_preload(size: Boundary, meaning: Suffix) -> tuple[float, str]:
    """Return the preload [m] of a pair, below 0 an axial clearance, and a phrase with it."""
    play, words, matched = meaning.axial_play, "", meaning.matched
    if matched:
        least, most = matched_clearance(size.bore, matched)
        play = 0.5 * (least + most)
        words = f", the middle of {matched} ({number(1e6 * least)} to {number(1e6 * most)} µm)"
    if not play:
        return 0.0, f"without clearance or preload{words}"
    name = "preload" if play < 0.0 else "clearance"
    return -play, f"an axial {name} of {number(1e6 * abs(play))} µm{words}"
