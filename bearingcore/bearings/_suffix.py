"""Letters around the number of a designation: its inside, angle, arrangement, clearance and balls.

Makers write them in one word: "BECBP" is B, 40°; E, a reinforced inside; CB, the axial clearance of
a pair; P, the cage. Letters of cages, seals and tolerances change no answer here and are ignored.
Letters that make the bearing one that is not known are refused with a sentence.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from bearingcore.common import _checks as checks

DEEP_GROOVE, ANGULAR_CONTACT = "deep groove ball bearing", "angular-contact ball bearing"
SELF_ALIGNING_BALLS, ROLLERS = "self-aligning ball bearing", "cylindrical roller bearing"
TAPERED_ROLLERS = "tapered roller bearing"

CLEARANCE_CLASSES = ("C2", "CN", "C3", "C4", "C5")

ANGLES = {"AC": 25, "A5": 25, "A": 30, "B": 40, "C": 15, "E": 25}
"""Contact angle [degrees] by the letters behind the number."""

BEFORE = (
    r"(?:(?P<count>\d) ?[X×Х*] ?)?"
    r"(?:(?:SKF|FAG|INA|SCHAEFFLER|NSK|RHP|NTN|SNR|KOYO|JTEKT|NACHI|TIMKEN|FAFNIR|MRC|SNFA|BARDEN|GMN"
    r"|IBC|NKE|ZVL|ZKL|URB|FKL|FLT|LFD|RIV|ISB|ORS|CX|KBC|NBC|NRB|ARB|TATA|HRB|ZWZ|LYC|C&U|TMB|KG|NMB"
    r"|NIS|FBJ|EZO|PEER|PFI|RKB|CRAFT|ROLLWAY|HOFFMANN|STEYR|GPZ|MPZ|SLF|DKF)[ -]*)?"
    r"(?P<ceramic>(?:HCB?|3NC|5S)[ -]?)?"
)
"""Text that may precede letters and number. Many other words name another kind of bearing, as in
HK 1210 and NA 6904."""

_PAIR = re.compile(
    r"D(?P<letter>[BFT])(?:C(?P<play>\d{2,4}))?|(?P<words>BACK|FACE)[ -]TO[ -](?P=words)|TANDEM"
)
_SETS = re.compile(r"[TQ][BF][CT]|(?<![A-Z])[TQ]T(?![A-Z])|D(?:[BF][DT]|T[DT])(?![A-Z])")
_TWO = re.compile(r"\b(?:PAIR|PAAR|SET|MATCHED|DUPLEX)\b")
_UNIVERSAL_PAIR = re.compile(r"(?<!D)DU")
_SECOND = re.compile(r"(?<![A-Z\d])(?:(?:NUP|NU|NJ|NF|N)[ -]?)?\d{3,5}(?!\d)")
_SPACER = re.compile(r"\+|^T\d{2,3}\b")
_CLEARANCE = re.compile(r"C([2345N])(?!\d)")
_CERAMIC = re.compile(r"(?<![A-Z])(?:HC5?|SN24)(?=$|[^A-Z]|C[2345N])")
_BETTER_STEEL = re.compile(r"(?<![A-Z])XL(?![A-Z])")
_PRECISION = re.compile(r"[ /-]*(?:A?C[BDE]|C[AC](?![A-Z0-9]))")
_ANGULAR = re.compile(
    r"[ /-]*(?:(?P<reinforced>BE)|(?P<angle>AC|A5|A|B|C(?![2345N])|E))?"
    r"[ /-]*(?P<matched>[CG][ABC])?[ /-]*(?P<brass>Y)?"
)
_REINFORCED = re.compile(r"[ /-]*E")
_SEALED = re.compile(r"2?RS|LL[UB]|DDU")
_OF_ANOTHER_MAKER = re.compile(r"[ /-]*BEA")

_BORE = re.compile(r" ?/ ?(?!2[ -]?[RZ])\d+(?:[.,]\d+)?(?=$|[ -])")
"""A bore [mm] behind the number, as in 628/8-2Z and 32307/37 BJ2; not the seals of 6205/2RS."""

_CYRILLIC = re.compile(r"[А-ЯЁ]")

_STEEP = re.compile(r"[ /-]*[BCD]")

ONE_OF_TWO = (
    "one with the arrangement of both bearings: DB (back to back), DF (face to face) or DT (tandem)"
)
SETS = "a single bearing, or a pair (DB, DF, DT): sets of three and more are not known by number"
ONLY_PAIRS_OF = "a single bearing: pairs are known of angular-contact and tapered bearings"
NO_TANDEM = "DB (back to back) or DF (face to face) of tapered roller bearings"
ONE_NUMBER = "one bearing, as {} is the number of another"
GOST = (
    "a number of ISO, in Latin letters: with Cyrillic ones it is of GOST 3189, in which the same "
    "digits may be another bearing"
)
BORE = "one whose number states the bore: bores behind a slash, as in 32307/37, are not known"
SPACED = (
    "one without spacers, as their width is not stated: take the pair and change the distance of "
    "its rows"
)
PRECISION = (
    "one whose inside is known: designs CB, CD, CE of super-precision bearings are not. Before a "
    "clearance class CA, CB or CC stands the letter of the contact angle, as in BECB"
)
REINFORCED = (
    "the number without E, or the dimensions: no ratings of this reinforced inside are known, and "
    "its rolling elements differ from those of the plain one"
)
SEALED = "the open one: sealed self-aligning bearings have smaller balls, which are not known here"
CERAMIC_ROLLERS = "steel rollers: the stiffness of ceramic ones is not known here"


class Suffix(NamedTuple):
    """Meaning of the letters around a number.

    Attributes
    ----------
    angle
        contact angle [degrees] of angular contact, or None where no letter states it.
    inside
        column of `reinforced.csv`; empty: the plain inside.
    arrangement
        of a pair; empty for a single bearing.
    matched
        class of axial clearance of a pair, "CA" to "GC"; empty where none is stated.
    axial_play
        [m] of a pair whose letters state it, as in DFC120; else None.
    clearance_class
        out of CLEARANCE_CLASSES; empty where none is stated.
    is_ceramic
        balls of silicon nitride.
    has_better_steel
        a class of its maker (X-life) that raises the rating by an amount not known here.
    """

    angle: float | None = None
    inside: str = ""
    arrangement: str = ""
    matched: str = ""
    axial_play: float | None = None
    clearance_class: str = ""
    is_ceramic: bool = False
    has_better_steel: bool = False


def is_steep(suffix: str) -> bool:
    """Return True if letters behind the number of tapered rollers make it another bearing."""
    return _STEEP.match(_PAIR.sub("", suffix)) is not None


def is_reinforced(suffix: str) -> bool:
    """Return True if letters behind the number begin with E, of a reinforced inside."""
    return _REINFORCED.match(suffix) is not None


_IGNORED = re.compile(
    r"[A-DHJLMNPRY]|(?:(?:2?-?(?:H?RS[1-9RHLJTD]?|RSH2|RSL|ZZ?|RZ|Z[RN]|DDU?|LL[BUH]|LU|LB|VV|UU|EE)"
    r"|NSL|DSD|JR|TN[9HG]?|TVPB?|TVHB?|T[VWX]?|JP?|M[AB]?|F[AB]?|PH?|Y|NR?|ECM?[LPJA]?|E[MT]?[12P]?"
    r"|P[2456]X?|P6[23]|P5[23]|C[2345N]M?|CM|K(?:30)?|W(?:20|33|64)?|WT|[HLM]T\d*|GJ[NHB]|G[ABC]"
    r"|LHT\d*|V[AELQ]\d*|S[0-4]|SQ1|Q\d?|XL|HC5?|SN24|BE[AP]?|AC|A5|D[BFTU]|U[ALO]|C[ABC])\d?)+"
)
"""Known letters of cages, seals, tolerances and grease, and those that are read above."""


def unknown_letters(kind: str, text: str) -> str:
    """Return the parts of a suffix without a known meaning; empty where there are none."""
    rest = _PAIR.sub(" ", text)
    parts = [part for part in re.split(r"[ /,.()+-]+", rest) if part]
    known = {"X"} if kind == TAPERED_ROLLERS else set()  # outside as in ISO 355
    return " ".join(part for part in parts if part not in known and not _IGNORED.fullmatch(part))


def lower_arrangement(name: str) -> str:
    """Return a name in capitals, but with the words of an arrangement in small letters."""
    return _PAIR.sub(lambda pair: pair[0] if pair["letter"] else pair[0].lower(), name)


def read_suffix(name: str, kind: str, text: str, count: str, is_ceramic: bool) -> Suffix:
    """Return the meaning of `text` behind the number of a `kind`, for `count` bearings.

    Raises
    ------
    FieldError
        for letters of a bearing that is not known; its `allowed` says what to write instead.
    """
    try:
        return _suffix_of(kind, text, count, is_ceramic)
    except ValueError as why:
        raise checks.refuse("designation", name, str(why)) from None


def _suffix_of(kind: str, text: str, count: str, is_ceramic: bool) -> Suffix:
    """Read a suffix like `read_suffix`; ValueError with what is allowed."""
    if second := _SECOND.search(text):
        raise ValueError(ONE_NUMBER.format(second[0]))
    if _BORE.match(text):
        raise ValueError(BORE)
    if _CYRILLIC.search(text):
        raise ValueError(GOST)
    pair = _PAIR.search(text)
    arrangement = _arrangement(kind, text, count, pair)
    rest = _PAIR.sub(" ", text, count=1) if pair else text
    is_ceramic = is_ceramic or _CERAMIC.search(rest) is not None
    rest = _CERAMIC.sub(" ", rest)
    match = _CLEARANCE.search(rest)
    meaning = Suffix(
        arrangement=arrangement,
        axial_play=1e-6 * float(pair["play"]) if pair and pair["play"] else None,
        clearance_class=f"C{match[1]}" if match else "",
        is_ceramic=is_ceramic,
        has_better_steel=_BETTER_STEEL.search(rest) is not None,
    )
    return _with_inside(kind, meaning, rest)


def _with_inside(kind: str, meaning: Suffix, rest: str) -> Suffix:
    """Add a reinforced inside to a meaning; ValueError with what is allowed."""
    if meaning.is_ceramic and kind in (ROLLERS, TAPERED_ROLLERS):
        raise ValueError(CERAMIC_ROLLERS)
    if kind == ANGULAR_CONTACT:
        return _with_angular_inside(meaning, rest)
    if kind == SELF_ALIGNING_BALLS and _SEALED.search(rest):
        raise ValueError(SEALED)
    if kind == SELF_ALIGNING_BALLS and is_reinforced(rest):
        return meaning._replace(inside="E")
    if kind == DEEP_GROOVE and is_reinforced(rest):
        if not re.match(r"[ /-]*ETN9", rest):
            raise ValueError(REINFORCED)
        return meaning._replace(inside="ETN9")
    return meaning


def _with_angular_inside(meaning: Suffix, rest: str) -> Suffix:
    """Add angle, reinforced inside and class of a pair to a meaning of angular contact."""
    if _PRECISION.match(rest):
        raise ValueError(PRECISION)
    if _OF_ANOTHER_MAKER.match(rest):
        raise ValueError(REINFORCED)
    letters = _ANGULAR.match(rest)
    assert letters is not None  # all of it is optional
    matched = letters["matched"] or ""
    if letters["reinforced"]:
        inside = "BEY" if letters["brass"] else "BECB" if matched else "BE"
        return meaning._replace(angle=40.0, inside=inside, matched=matched)
    angle = ANGLES.get(letters["angle"] or "")
    return meaning._replace(angle=angle, matched=matched)


def _arrangement(kind: str, text: str, count: str, pair: re.Match[str] | None) -> str:
    """Return the arrangement, out of ARRANGEMENTS, or empty; ValueError with what is allowed."""
    if count not in ("", "1", "2") or _SETS.search(text):
        raise ValueError(SETS)
    if pair is None:
        universal = kind == ANGULAR_CONTACT and _UNIVERSAL_PAIR.search(text)
        if count != "2" and not universal and not _TWO.search(text):
            return ""
        raise ValueError(
            ONE_OF_TWO if kind in (ANGULAR_CONTACT, TAPERED_ROLLERS) else ONLY_PAIRS_OF
        )
    first = (pair["letter"] or pair[0])[0]
    if kind not in (ANGULAR_CONTACT, TAPERED_ROLLERS):
        raise ValueError(ONLY_PAIRS_OF)
    if kind == TAPERED_ROLLERS and first == "T":
        raise ValueError(NO_TANDEM)
    if _SPACER.search(text):
        raise ValueError(SPACED)
    return {"B": "back-to-back", "F": "face-to-face", "T": "tandem"}[first]
