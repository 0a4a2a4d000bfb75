"""The machine of a measurement: its bearing, its shaft speed, and the source of each.

A fact that neither the file nor a person states stays unknown. The scene's bearing and speed are
taken only where a person chose them. Only `scene_machine` reads a scene.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from bearing_explorer.kit.bearing_list import find_bearing
from bearing_explorer.kit.sentences import number_of, sentence_of
from bearingcore import Bearing, Scene
from bearingcore.bearings import FREQUENCIES, bearing_of_frequencies
from bearingcore.common import choice, number, span
from bearingcore.measured.files import FileContents, Finding

NOT_KNOWN = ""
FILE, GIVEN, ROUGH, SCENE, SIMULATED = "file", "given", "rough", "scene", "simulated"
"""Sources of a shaft speed. A person types GIVEN and ROUGH ones; ROUGH is good to `TOLERANCE`."""
BY_DESIGNATION, BY_FREQUENCIES = "designation", "frequencies"
"""Ways to name the bearing, in addition to SCENE and the name of a listed one."""
TOLERANCE = 0.1
"""Fraction by which a rough shaft speed may be off."""
SAME_ORDERS = 0.01
"""Relative difference up to which a bearing's frequencies count as those of a file."""
PITCH_DIAMETER = 39e-3
"""Diameter [m] for the picture of a bearing known by its frequencies: no answer depends on it."""
SPEEDS = (1e-3, 1e4)
"""Least and greatest shaft speed [Hz] that may be typed."""

RATIOS = (0.01, 100.0)
"""Least and greatest ratio of the speed of a bearing's shaft to the measured one."""

FASTEST_BARE = 300.0
"""Frequency [Hz] above which a number without a unit may be meant in rpm: 18,000 rpm."""

FIELDS = ("bearing", "designation", *FREQUENCIES, "speed", "shaft_speed", "ratio")
"""Fields of the form that describes the machine."""

GROUPS = {
    "bearing": ("bearing", "designation", *FREQUENCIES),
    "speed": ("speed", "shaft_speed", "ratio"),
}
"""Fields of each question, by the name of the first field."""

TYPED = (GIVEN, ROUGH)
MEASURED = (FILE, *TYPED)
"""Sources of a speed that may be that of another shaft, which drives the bearing's."""
SPEED_SOURCES = {
    FILE: "from the file", GIVEN: "given", ROUGH: "given, good to 10 %",
    SCENE: "the scene's, as chosen", SIMULATED: "of the simulation",
}  # fmt: skip
"""Sources of a shaft speed, in words."""
BEARING_SOURCES = {
    FILE: "from the file", GIVEN: "given", SCENE: "the scene's, as chosen",
    SIMULATED: "of the simulation",
}  # fmt: skip
"""Sources of a bearing, in words."""

OWN_FREQUENCIES = " Choose “by its frequencies” to type them."
"""Sentence after the refusal of a bearing that is not in the table."""


class Turning(NamedTuple):
    """A bearing at a shaft speed [rad/s], both known."""

    bearing: Bearing
    shaft_speed: float


@dataclass(frozen=True)
class Machine:
    """The machine on which a signal was measured, as far as it is known.

    Attributes
    ----------
    shaft_speed
        [rad/s] of the bearing's shaft; None where it is not known.
    bearing
        None where nothing says which it is.
    speed_source
        one of SPEED_SOURCES; NOT_KNOWN without a speed.
    bearing_source
        FILE, GIVEN, SCENE or SIMULATED; NOT_KNOWN without a bearing.
    bearing_name
        name of the bearing on the page; empty for that of the scene.
    guessed
        "bearing" and "speed", if a file only suggests them.
    kept
        "bearing" and "speed", if a person gave them for the previous file.
    by_frequencies
        True where only the frequencies of the bearing's parts are known; it then has no size.
    unread
        letters of the bearing's designation whose meaning is not known.
    ratio
        turns of the bearing's shaft for each turn of the shaft whose speed was measured.
    """

    shaft_speed: float | None = None
    bearing: Bearing | None = None
    speed_source: str = GIVEN
    bearing_source: str = GIVEN
    bearing_name: str = ""
    guessed: frozenset[str] = frozenset()
    kept: frozenset[str] = frozenset()
    by_frequencies: bool = False
    unread: str = ""
    ratio: float = 1.0

    def __post_init__(self) -> None:
        if self.shaft_speed is None:
            object.__setattr__(self, "speed_source", NOT_KNOWN)
        if self.bearing is None:
            object.__setattr__(self, "bearing_source", NOT_KNOWN)

    def replace_speed(self, speed: float | str) -> Machine:
        """Return the machine with its shaft speed ROUGH, "unknown", or another number [rad/s]."""
        if speed in ("unknown", NOT_KNOWN):
            return dataclasses.replace(self, shaft_speed=None)
        if isinstance(speed, str):
            return dataclasses.replace(self, speed_source=choice("speed", speed, TYPED))
        return dataclasses.replace(self, shaft_speed=speed)

    @property
    def ratio_words(self) -> str:
        """Relation to the speed of the measured shaft, after a comma; empty without a gear."""
        if self.ratio == 1.0 or self.shaft_speed is None:
            return ""
        measured = number(30.0 / math.pi * self.shaft_speed / self.ratio, 4)
        return f", {number(self.ratio, 4)} times the {measured} of the measured shaft"

    def source_of(self, name: str) -> str:
        """Source of "bearing" or "speed", in words; empty where it is not known."""
        if name in self.guessed:
            return "assumed, a guess from the file"
        if name in self.kept:
            return "assumed, kept from the previous file"
        source = self.bearing_source if name == "bearing" else self.speed_source
        return (BEARING_SOURCES if name == "bearing" else SPEED_SOURCES).get(source, "")

    @property
    def speed_range(self) -> float | tuple[float, float] | None:
        """The shaft speed [rad/s], or its least and greatest, for `bearingcore.diagnose`."""
        if self.shaft_speed is None or self.speed_source != ROUGH:
            return self.shaft_speed
        return (1.0 - TOLERANCE) * self.shaft_speed, (1.0 + TOLERANCE) * self.shaft_speed

    @property
    def exact_speed(self) -> float | None:
        """The shaft speed [rad/s]; None where it is known only roughly, or not at all."""
        return None if self.speed_source == ROUGH else self.shaft_speed


def scene_machine(scene: Scene, source: str = SCENE) -> Machine:
    """Return the bearing and the shaft speed of a scene: all that a measurement takes from it."""
    return Machine(scene.shaft_speed, scene.bearing, source, source)


class FormError(ValueError):
    """Refused answers of a form: sentences by field."""

    def __init__(self, sentences: Mapping[str, str]) -> None:
        super().__init__(" ".join(sentences.values()))
        self.sentences = dict(sentences)


def guess(contents: FileContents) -> dict[str, str]:
    """Return the first values of the form: facts of the file, and NOT_KNOWN for all others."""
    speed = contents.shaft_speed
    return {
        "speed": FILE if speed is not None and speed.taken else NOT_KNOWN,
        "shaft_speed": "" if speed is None else speed_text(speed),
        "ratio": "",
        "designation": "",
        **_bearing(contents),
    }


def kept_answers(first: Mapping[str, str], before: Mapping[str, str]) -> dict[str, str]:
    """Return the answers for the file `before` that the `first` ones of this file lack.

    >>> kept_answers({"bearing": "", "speed": "file"}, {"speed": "given", "shaft_speed": "25"})
    {}
    """
    missing = [name for name in GROUPS if first[name] == NOT_KNOWN and name in before]
    return {field: before[field] for name in missing for field in GROUPS[name]}


def _bearing(contents: FileContents) -> dict[str, str]:
    """Return the first values of the bearing and of its frequencies.

    Frequencies that the file states take precedence over those of the file's collection.
    """
    texts = dict.fromkeys(FREQUENCIES, "")
    stated, speed, listed = contents.frequencies, contents.shaft_speed, contents.bearing
    if {"bpfo", "bpfi"} <= set(stated):
        texts |= {name: f"{value:.6g} Hz" for name, value in stated.items()}
        if listed is None or speed is None or not _matches(listed.value, stated, speed.value):
            return {"bearing": BY_FREQUENCIES, **texts}
    named = contents.designation
    if listed is None and named is not None:
        try:
            find_bearing(named.value)
        except ValueError:  # the text names no bearing, or one that is not in the table
            return {"bearing": NOT_KNOWN, **texts}
        return {"bearing": BY_DESIGNATION, "designation": named.value, **texts}
    return {"bearing": NOT_KNOWN if listed is None else listed.value, **texts}


def _matches(name: str, stated: Mapping[str, float], speed: float) -> bool:
    """True where a listed bearing has the `stated` frequencies [Hz] at a speed [rad/s]."""
    bearing = find_bearing(name).bearing
    computed = {"bpfo": bearing.bpfo(speed), "bpfi": bearing.bpfi(speed)}
    return all(abs(stated[key] / value - 1.0) < SAME_ORDERS for key, value in computed.items())


def speed_text(speed: Finding[float]) -> str:
    """Write a speed in rpm if the file has it in rpm, otherwise in Hz."""
    if speed.file_unit == "rpm":
        return f"{speed.in_file_unit:.6g} rpm"
    return f"{speed.value / (2.0 * math.pi):.6g} Hz"


def read_machine(
    texts: Mapping[str, str],
    first: Mapping[str, str],
    contents: FileContents,
    scene: Machine,
) -> Machine:
    """Return the machine that a form describes; `FormError` with sentences if it describes none.

    Parameters
    ----------
    texts
        answers of the form, by `FIELDS`.
    first
        answers as the file filled them in.
    contents
        contents of the file.
    scene
        bearing and speed of the scene, see `scene_machine`: used only where the form chooses them.
    """
    speed, ratio = _speed_in(texts, contents, scene), _ratio_in(texts)
    speed = None if speed is None else ratio * speed
    bearing, name, source, unread = _bearing_in(texts, speed, scene)
    guessed = set()
    file_speed = contents.shaft_speed
    if texts["speed"] == FILE and file_speed is not None and not file_speed.stated:
        guessed.add("speed")
    if source == GIVEN and all(texts[field] == first[field] for field in GROUPS["bearing"]):
        source = FILE
        if not contents.frequencies and not texts["designation"]:
            guessed.add("bearing")  # the collection to which the file seems to belong has it
    return Machine(
        speed, bearing, texts["speed"], source, name, frozenset(guessed),
        by_frequencies=texts["bearing"] == BY_FREQUENCIES, unread=unread, ratio=ratio,
    )  # fmt: skip


def _speed_in(texts: Mapping[str, str], contents: FileContents, scene: Machine) -> float | None:
    """Return the shaft speed [rad/s] of a form; None where it is not known, or not typed yet."""
    source, text = texts["speed"], texts["shaft_speed"]
    if source == FILE and contents.shaft_speed is not None:
        return contents.shaft_speed.value
    if source in (GIVEN, ROUGH):
        try:
            return 2.0 * math.pi * read_speed(text) if text else None
        except ValueError as error:
            raise FormError({"shaft_speed": str(error)}) from None
    if source not in (SCENE, NOT_KNOWN):
        raise FormError({"speed": "The shaft speed has no such answer."})
    return scene.shaft_speed if source == SCENE else None


def _ratio_in(texts: Mapping[str, str]) -> float:
    """Return the gear ratio of a form; 1 if none is typed, or none applies to the speed."""
    if not texts["ratio"] or texts["speed"] not in MEASURED:
        return 1.0
    try:
        return read_ratio(texts["ratio"])
    except ValueError as error:
        raise FormError({"ratio": sentence_of(error)}) from None


def read_ratio(text: str) -> float:
    """Read the turns of the bearing's shaft for each turn of the measured shaft.

    >>> read_ratio("0.657"), read_ratio("23/46"), read_ratio("2 : 1")
    (0.657, 0.5, 2.0)
    """
    words, (least, most) = "The gear ratio", RATIOS
    top, _, bottom = text.replace(":", "/").partition("/")
    ratio = number_of(top, words, "", 1e-3, 1e6) / number_of(bottom or "1", words, "", 1e-3, 1e6)
    if not least <= ratio <= most:
        raise ValueError(f"{words} is {number(ratio, 4)}; possible: {span(least, most, 'times')}.")
    return ratio


def _bearing_in(
    texts: Mapping[str, str], speed: float | None, scene: Machine
) -> tuple[Bearing | None, str, str, str]:
    """The bearing of a form, its name, its source, and letters of the name that are not read."""
    name = texts["bearing"]
    try:
        if name == SCENE:
            return scene.bearing, "", SCENE, ""
        if name == BY_FREQUENCIES:
            turns = None if speed is None else speed / (2.0 * math.pi)
            typed = ", ".join(texts[name] for name in FREQUENCIES if texts[name])
            return _bearing_by_frequencies(texts, turns), f"frequencies {typed}", GIVEN, ""
        if name == BY_DESIGNATION:
            name = texts["designation"]
            if not name:  # the person has not typed it yet
                return None, "", GIVEN, ""
            entry = find_bearing(name)
            return entry.bearing, name, GIVEN, entry.unread
        return None if name == NOT_KNOWN else find_bearing(name).bearing, name, GIVEN, ""
    except ValueError as error:
        field = "designation" if texts["bearing"] == BY_DESIGNATION else "bearing"
        words = sentence_of(error) + OWN_FREQUENCIES * (field == "designation")
        raise FormError({field: words}) from None


def _bearing_by_frequencies(texts: Mapping[str, str], turns: float | None) -> Bearing | None:
    """Return the bearing with the typed frequencies; `turns` of the shaft per second, or None.

    None until two frequencies are typed. ValueError where no bearing can have them.
    """
    typed = [key for key in FREQUENCIES if texts[key]]
    if not {"bpfo", "bpfi"} & set(typed) or len(typed) < 2:
        return None
    orders = {key: _order(key, texts[key], turns) for key in typed}
    return bearing_of_frequencies(orders, PITCH_DIAMETER)


def _order(name: str, text: str, turns: float | None) -> float:
    """Return the order of a frequency, in turns of the shaft, from "81.1 Hz" or "3.245 x"."""
    bare = re.sub(r"\s*(x|×|orders?)$", "", text.lower())
    least, most = 1e-3, 1e5
    if bare != text.lower():
        return number_of(bare, name.upper(), "", least, most)
    if turns is None:
        raise ValueError(
            "Frequencies in Hz need the shaft speed: give it, or type them in turns of the shaft, "
            "such as 3.58 x."
        )
    return number_of(bare, name.upper(), "Hz", least, most) / turns


def read_speed(text: str) -> float:
    """Read a speed [Hz] from a number with its unit, or a bare one that is too low for rpm."""
    words, (least, most) = "The shaft speed", SPEEDS
    bare = text.lower()
    bare = re.sub(r"\s*(rpm|[ur1]?/min|min(-|\^-|⁻|−)[1¹])$", " rpm", bare)
    per_minute = bare.endswith(" rpm")
    bare = re.sub(r"(?<=[\d\s])hz$", "", bare.removesuffix(" rpm")).rstrip()
    if per_minute and re.fullmatch(r"\d{1,3}[.,]\d{3}", bare):
        raise ValueError(
            f"{words} is {bare} rpm: is that {re.sub('[.,]', '', bare)} rpm? Type it without the "
            "mark, or with another number of decimals."
        )
    value = number_of(bare, words, "rpm" if per_minute else "Hz", 0.0, math.inf)
    if bare == text.lower().strip() and FASTEST_BARE < value <= most:
        raise ValueError(
            f"A number alone is in Hz: {words.lower()} is {number(60.0 * value, 6)} rpm. Did you "
            f"mean {bare} rpm? Type it with its unit."
        )
    value = value / 60.0 if per_minute else value
    if not least <= value <= most:
        raise ValueError(
            f"{words} is {number(value, 6)} Hz; possible: {span(least, most, 'Hz', 6)}."
        )
    return value
