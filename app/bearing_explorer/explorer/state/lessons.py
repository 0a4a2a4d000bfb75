"""Lessons: text files that ask, set a scene, say what to drag and what to look at, and answer.

A lesson is a text file in Markdown with a head in TOML::

    +++
    title = "What a ball carries"
    tab = "load"                       # what is on screen: a tab of the page
    preset = "fan-rig"                 # the scene to begin with ...
    drag = ["fy_n", "cage_angle_deg"]  # the controls shown with the words
    watch = ["load-distribution"]      # the figures to look at, on whichever tab; they are marked
    term = "k_yy"                      # or "loaded_balls": alone on a projector; may be left out

    [scene]                            # ... and what is changed in it
    extent_deg = 0
    edge = "chord"

    [result]                           # ... and then, once a prediction is made; may be left out
    extent_deg = 40

    [predict]                          # before the answer; may be left out
    ask = "Which ball carries most?"
    choose = ["the first", "the lowest", "all the same"]
    right = 2                          # counted from 1
    hint = "Where is it pressed?"      # after a first wrong one; may be left out
    veil = ["load-distribution"]       # figures that have the answer; if left out, all of `watch`
    +++
    ## Question
    Which ball carries most?
    ## Answer
    The last part is hidden behind a button.

A prediction can be a number instead: ``unit``, ``right`` and ``within`` in place of ``choose``.

Parts begin with ``##``. Formulas are between dollar signs, ``$Q = K\\delta^{3/2}$``; a link to
``set:extent_deg=64&edge=chord`` is a button that changes the scene, one to ``show:maps`` a button
that opens a tab. A link to ``simulate:noise=20&race=inner`` is a button that changes the scene, if
the link has changes, simulates a measurement of it, and opens Diagnosis. Files are read in the
order of their names. The name of a lesson, by which the page's address names it, is the name of its
file without the leading number.

Lessons may come from people who are not trusted: HTML is shown as text, pictures are not loaded,
and formulas become MathML of known elements. The sentence on a fault has the name and the line of
the file.
"""

from __future__ import annotations

import difflib
import html
import json
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cache, cached_property, lru_cache
from pathlib import Path
from typing import Annotated, Any, TypeVar
from urllib.parse import parse_qsl, unquote, urlencode

import msgspec
import tomli
from latex2mathml.converter import convert_to_element
from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin
from msgspec import Meta
from msgspec.structs import fields

from bearing_explorer.explorer.state.address import OTHER_NAMES_OF_TABS
from bearing_explorer.explorer.state.choice_list import CHOICE_LIST
from bearing_explorer.explorer.state.field_values import FIELD_BY_KEY, SCENE_GROUPS, SHOWN_FIELDS
from bearing_explorer.explorer.state.scene_editor import LONGEST_NAME, SceneEditor
from bearing_explorer.kit.assets import asset_path
from bearing_explorer.kit.simulated_signals import NOISES
from bearingcore import presets
from bearingcore.model.statics import TERM_SYMBOLS

_Entries = TypeVar("_Entries", bound=msgspec.Struct)

Tabs = tuple[tuple[str, tuple[str, ...]], ...]
"""Names of the tabs, each with the names of its views."""

LONGEST_FILE = 20_000  # bytes
LONGEST_FORMULA = 400  # characters
MOST_LESSONS = 60
_MOST_LISTED = 16

CHOICES: Mapping[str, Sequence[str]] = {
    choice.name: choice.names for choice in CHOICE_LIST if choice.in_lessons
}
"""Choices that a lesson may make, and their options."""

CELLS = {"": "", **TERM_SYMBOLS, "loaded_balls": "Loaded balls"}
"""Names of the cells that a lesson may show alone, by the `term` in its head."""

DRAGGED = (
    *(field.key for field in SHOWN_FIELDS if field.group in SCENE_GROUPS),
    *(choice.name for choice in CHOICE_LIST if choice.lesson_control),
)
"""Controls that can be shown with the words."""

_FENCE = "+++"
_MATHML_ELEMENTS = (
    "math mrow mi mn mo mtext mspace msub msup msubsup mfrac msqrt mroot mover munder munderover "
    "mtable mtr mtd mstyle mpadded mphantom"
)
_MATHML_ATTRIBUTES = (
    "xmlns display mathvariant stretchy fence separator form lspace rspace width height depth "
    "minsize maxsize linethickness columnalign rowspacing columnspacing displaystyle scriptlevel "
    "accent accentunder movablelimits largeop symmetric voffset"
)


class LessonError(ValueError):
    """A fault of a lesson in a sentence; `line` counts from 1."""

    def __init__(self, line: int, words: str) -> None:
        super().__init__(words)
        self.line = line


@dataclass(frozen=True)
class Part:
    """A part of a lesson: its heading, and its words as safe HTML."""

    heading: str
    html: str


Text = Annotated[str, Meta(min_length=1, max_length=200)]
Number = Annotated[float, Meta(ge=-1e12, le=1e12)]


class Prediction(msgspec.Struct, frozen=True):
    """A question that the head of a lesson asks before the answer is shown.

    With choices, `right` is the number of the right one, counted from 1. Without choices, the
    answer is a number in `unit`, right from `right` − `within` to `right` + `within`. After a first
    wrong prediction the `hint` is shown, and the person may predict again. The figures in `veil`
    show the answer, so they are veiled until then; None: all figures that the lesson marks.
    """

    ask: Text
    right: Number
    choose: Annotated[tuple[Text, ...], Meta(min_length=2, max_length=6)] = ()
    unit: Annotated[str, Meta(max_length=20)] = ""
    within: Annotated[float, Meta(ge=0.0, le=1e12)] = 0.0
    hint: Annotated[str, Meta(max_length=200)] = ""
    veil: tuple[str, ...] | None = None


class _Head(msgspec.Struct):
    """The head of a lesson in its file."""

    title: Annotated[str, Meta(min_length=1, max_length=90)]
    tab: str
    preset: str
    drag: tuple[str, ...] = ()
    watch: tuple[str, ...] = ()
    term: str = ""
    scene: dict[str, str | int | float] = {}
    result: dict[str, str | int | float] = {}
    predict: dict[str, Any] | None = None


@dataclass(frozen=True)
class Lesson:
    """One lesson. `values` and `choices` change the scene of `preset`, by names of the page.

    `result` is the message that changes it further, to show the answer of the prediction; it is
    empty if the scene shows the answer already. The page's address contains the lesson's `name`.
    """

    title: str
    tab: str
    preset: str
    values: Mapping[str, float]
    choices: Mapping[str, str]
    drag: tuple[str, ...]
    watch: tuple[str, ...]
    parts: tuple[Part, ...]
    result: Mapping[str, Any]
    predict: Prediction | None = None
    term: str = ""
    name: str = ""

    def begin(self, editor: SceneEditor) -> None:
        """Set the scene with which the lesson begins."""
        editor.take_preset(self.preset)
        editor.choose(self.choices)
        editor.set(self.values)

    def browser_data(self, number: int) -> dict[str, Any]:
        """The lesson for the page's script; `number` counts from 0."""
        return {
            "number": number,
            "title": self.title,
            "drag": list(self.drag),
            "watch": list(self.watch),
            "parts": [asdict(part) for part in self.parts],
            "predict": msgspec.to_builtins(self.predict),
            "result": self.result,
            "cell": CELLS[self.term],
            "name": self.name,
        }


@dataclass(frozen=True)
class Fault:
    """A file that is no lesson, and the reason in a sentence with its name and line."""

    title: str
    sentence: str


def shipped_folder() -> Path:
    """The folder of the lessons that come with the program."""
    return asset_path("lessons")


def lessons_in(folder: Path, tabs: Tabs) -> list[Lesson | Fault]:
    """All lessons of a folder, in the order of their files' names; changed files are read again.

    A folder that cannot be read, or has no lesson, is one fault.
    """
    try:
        files = sorted(path for path in folder.iterdir() if path.suffix == ".md")
    except OSError as error:
        return [_fault(str(folder), f"the folder cannot be read ({error.strerror or error})")]
    if not files:
        return [_fault(str(folder), "the folder holds no file that ends in .md")]
    lessons: list[Lesson | Fault] = []
    for path in files[:MOST_LESSONS]:
        try:
            about = path.stat()
            lessons.append(_read_file(path, about.st_mtime_ns, about.st_size, tabs))
        except OSError as error:
            lessons.append(_fault(path.name, f"cannot be read ({error.strerror or error})"))
    if len(files) > MOST_LESSONS:
        lessons.append(_fault(folder.name, f"holds {len(files)} lessons; allowed: {MOST_LESSONS}"))
    return lessons


def shipped_lessons(tabs: Tabs) -> list[Lesson | Fault]:
    """The program's own lessons, without those on a tab that this page lacks."""
    return [lesson for lesson in lessons_in(shipped_folder(), tabs) if isinstance(lesson, Lesson)]


def _fault(name: str, why: str) -> Fault:
    return Fault(name, f"{name}: {why}.")


@lru_cache(maxsize=4 * MOST_LESSONS)
def _read_file(path: Path, changed: int, size: int, tabs: Tabs) -> Lesson | Fault:
    """Read the lesson in a file; the time of its last change and its size are keys of the cache."""
    try:
        lesson = read_lesson(_text(path, size), tabs)
        return replace(lesson, name=_name_of(path))
    except LessonError as error:
        return Fault(path.name, f"{path.name}, line {error.line}: {error}.")


def _name_of(path: Path) -> str:
    """Name of a lesson: that of its file without the leading number, in a to z, 0 to 9 and "-"."""
    plain = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-")
    return (re.sub(r"^\d+-", "", plain) or plain)[:LONGEST_NAME]


def _text(path: Path, size: int) -> str:
    if not path.is_file():
        raise LessonError(1, "this is not a regular file")
    if size > LONGEST_FILE:
        raise LessonError(1, f"the file is longer than {LONGEST_FILE} bytes")
    content = path.read_bytes()
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise LessonError(line, "this is not text in UTF-8") from None


def read_lesson(text: str, tabs: Tabs) -> Lesson:
    """Read a lesson; LessonError if `text` is no lesson."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    if lines[0].strip() != _FENCE:
        raise LessonError(1, f"a lesson begins with a line {_FENCE}")
    ends = [i for i, line in enumerate(lines) if i and line.strip() == _FENCE]
    if not ends:
        raise LessonError(len(lines), f"the head has no end: a second line {_FENCE} is missing")
    checks = _Checks(lines[1 : ends[0]], tabs)
    values, choices = checks.scene()
    names = ("title", "tab", "preset", "drag", "watch", "term")
    return Lesson(
        **{name: getattr(checks.head, name) for name in names},
        values=values,
        choices=choices,
        parts=_parts("\n".join(lines[ends[0] + 1 :]), ends[0] + 1, checks),
        result=checks.result(),
        predict=checks.prediction(),
    )


class _Checks:
    """The `lines` of the head of a lesson, checked against controls and `tabs` of the page."""

    def __init__(self, lines: list[str], tabs: Tabs) -> None:
        self._lines = lines
        self.tabs = dict(tabs)
        self.head = head = self._decoded()
        head.title = " ".join(head.title.split())
        head.tab = OTHER_NAMES_OF_TABS.get(head.tab, head.tab)
        self._require("tab", [head.tab], list(self.tabs), "a tab")
        self._require("preset", [head.preset], list(presets), "a preset")
        self._require("drag", head.drag, DRAGGED, "a control of the page")
        figures = [name for names in self.tabs.values() for name in names]
        self._require("watch", head.watch, figures, "a figure of the page")
        self._require("term", [head.term], list(CELLS), "a term of the stiffness")

    def _decoded(self) -> _Head:
        try:
            table = tomli.loads("\n".join(self._lines))
        except tomli.TOMLDecodeError as error:
            raise LessonError(error.lineno + 1, f"the head is not TOML: {error.msg}") from None
        except RecursionError:
            raise LessonError(1, "the head is not TOML: its lists are too deep") from None
        return self._entries(table, _Head)

    def _entries(self, table: dict[str, Any], kind: type[_Entries]) -> _Entries:
        """Convert a table of the head to `kind`; LessonError names the entry that is wrong."""
        known = {field.name: field for field in fields(kind)}
        for name, field in known.items():
            if field.required and name not in table:
                raise self.error("", f"{name} is missing")
        values = {}
        for name, value in table.items():
            if name not in known:
                raise self.error(
                    name, f"“{name[:40]}” is not an entry here; {_hint(name, list(known))}"
                )
            try:
                values[name] = msgspec.convert(value, known[name].type)
            except msgspec.ValidationError as error:
                raise self.error(name, f"{name} cannot be read: {error}") from None
        return kind(**values)

    def error(self, name: str, words: str) -> LessonError:
        """Make the error on the entry `name`, with its line."""
        begins = re.compile(rf"\s*[\[\"']*\s*{re.escape(name)}\b")
        number = next((i for i, line in enumerate(self._lines, 2) if begins.match(line)), 1)
        return LessonError(number if name else 1, words)

    def _require(self, entry: str, names: Sequence[str], known: Sequence[str], kind: str) -> None:
        for name in names:
            if name not in known:
                raise self.error(entry, f"“{name[:40]}” is not {kind}; {_hint(name, known)}")

    def scene(self) -> tuple[dict[str, float], dict[str, str]]:
        """The numbers and choices that change the scene of the preset."""
        return _changes(SceneEditor(self.head.preset), self.head.scene, self.error)

    def result(self) -> dict[str, Any]:
        """The message that sets the scene of the answer; empty where the head has none."""
        values, choices = _changes(self.editor(), self.head.result, self.error)
        return {"choose": choices, "typed": values} if self.head.result else {}

    def prediction(self) -> Prediction | None:
        """The prediction; LessonError if none of its choices is right."""
        if self.head.predict is None:
            return None
        prediction = self._entries(self.head.predict, Prediction)
        choices = prediction.choose
        if choices and prediction.right not in range(1, len(choices) + 1):
            raise self.error("right", "right counts the choices from 1")
        veiled = prediction.veil or ()
        self._require("veil", veiled, self.tabs[self.head.tab], "a figure of this tab")
        return prediction

    @cached_property
    def _first_editor(self) -> SceneEditor:
        editor = SceneEditor(self.head.preset)
        values, choices = self.scene()
        editor.choose(choices)
        editor.set(values)
        return editor

    def editor(self) -> SceneEditor:
        """The scene that the lesson begins with."""
        return self._first_editor.snapshot()


def _hint(name: str, known: Sequence[str]) -> str:
    """Words that name the nearest known name, or all of them if they are few."""
    if len(known) <= _MOST_LISTED:
        return f"possible: {', '.join(known)}"
    close = difflib.get_close_matches(name, known, 1, 0.3)
    return f"was {close[0]} meant?" if close else f"{len(known)} are possible, such as {known[0]}"


def _changes(
    editor: SceneEditor, values: Mapping[str, Any], error: Callable[[str, str], LessonError]
) -> tuple[dict[str, float], dict[str, str]]:
    """Numbers and choices of the changes of a scene, tried on `editor`.

    If a change fails, `error` makes the exception from its name and a sentence.
    """
    changes = {name: str(value) for name, value in values.items()}
    choices = {name: value for name, value in changes.items() if name in (*CHOICES, "preset")}
    for name, value in choices.items():
        options = CHOICES.get(name, list(presets))
        if value not in options:
            raise error(name, f"{name} is “{value[:40]}”; {_hint(value, options)}")
    numbers = {name: value for name, value in changes.items() if name not in choices}
    for name in numbers:
        if name not in FIELD_BY_KEY:
            known = _hint(name, [*FIELD_BY_KEY, *CHOICES])
            raise error(name, f"“{name[:40]}” is not a number or choice of the page; {known}")
    refused = editor.choose(choices) or editor.set(numbers)[0]
    for name, sentence in refused.items():
        raise error(name, sentence.rstrip("."))
    return {name: editor.values[name] for name in numbers}, choices


# Words: Markdown to safe HTML.


@cache
def _markdown() -> MarkdownIt:
    parser = MarkdownIt("commonmark", {"html": False, "maxNesting": 20})
    parser.enable(["table"]).disable(["image", "html_block", "html_inline", "lheading"])
    return parser.use(dollarmath_plugin, allow_space=False, double_inline=True)


def _parts(text: str, offset: int, checks: _Checks) -> tuple[Part, ...]:
    """The parts of a body whose first line is line `offset` + 1 of the file."""
    parser = _markdown()
    tokens = parser.parse(text)
    begins = [i for i, t in enumerate(tokens) if t.type == "heading_open" and t.tag == "h2"]
    if not begins or begins[0] > 0:
        raise LessonError(offset + 1, "words before the first part: parts begin with “## ”")
    if len(begins) < 2:
        raise LessonError(offset + 1, "a lesson has two parts at least, the last is the answer")
    line = offset + 1
    for token in tokens:
        line = offset + 1 + token.map[0] if token.map else line
        if token.type in ("heading_open", "heading_close"):
            # headings of parts are one level below the title of the lesson
            token.tag = f"h{min(max(int(token.tag[1]) + 1, 3), 6)}"
        if token.type in ("math_block", "math_block_label"):
            token.type, token.content = "html_block", _formula(token.content, True, line)
        if token.children:
            _convert_tokens(token.children, line, checks)
    sections = []
    for begin, end in zip(begins, [*begins[1:], len(tokens)], strict=True):
        words = tokens[begin + 1]
        rendered = parser.renderer.render(tokens[begin + 3 : end], parser.options, {})
        if not rendered.strip():
            raise LessonError(offset + 1 + (words.map or [0])[0], "this part is empty")
        sections.append(Part(words.content.strip(), rendered))
    return tuple(sections)


def _convert_tokens(tokens: list[Token], line: int, checks: _Checks) -> None:
    """Convert formulas to MathML and links to buttons; allow other links to http and https only."""
    closing = ""
    for token in tokens:
        if token.type == "softbreak":
            line += 1
        if token.type in ("math_inline", "math_inline_double"):
            double = token.type == "math_inline_double"
            token.type, token.content = "html_inline", _formula(token.content, double, line)
        elif token.type == "link_open":
            address = str(token.attrGet("href") or "")
            scheme, _, rest = address.partition(":")
            if scheme in _BUTTONS:
                message = html.escape(json.dumps(_BUTTONS[scheme](rest, line, checks)))
                token.type, closing = "html_inline", "</button>"
                token.content = f'<button type="button" class="do" data-ask="{message}">'
            elif scheme in ("http", "https"):
                token.attrSet("target", "_blank")
                token.attrSet("rel", "noopener noreferrer")
            else:
                known = "links go to set:, show:, simulate: or https:"
                raise LessonError(line, f"a link goes to “{address[:60]}”; {known}")
        elif token.type == "link_close" and closing:
            token.type, token.content, closing = "html_inline", closing, ""


def _set(rest: str, line: int, checks: _Checks) -> dict[str, Any]:
    """The message of a button that changes the scene."""
    if not rest:
        raise LessonError(line, "set: is followed by changes, as in set:extent_deg=64")
    changes = dict(parse_qsl(rest, keep_blank_values=True))
    values, choices = _changes(checks.editor(), changes, lambda _, words: LessonError(line, words))
    return {"choose": choices, "typed": values}


def _simulate(rest: str, line: int, checks: _Checks) -> dict[str, Any]:
    """The message of a button that simulates a measurement."""
    changes = dict(parse_qsl(rest, keep_blank_values=True))
    noise = changes.pop("noise", "20")
    if noise not in NOISES:
        raise LessonError(line, f"noise is “{noise[:40]}”; {_hint(noise, list(NOISES))}")
    scene = _set(urlencode(changes), line, checks) if changes else {"choose": {}, "typed": {}}
    shown = {"show": "diagnosis"} if "diagnosis" in checks.tabs else {}
    return {**scene, **shown, "simulate": {"noise": noise}}


def _show(rest: str, line: int, checks: _Checks) -> dict[str, Any]:
    """The message of a button that opens a tab."""
    name = OTHER_NAMES_OF_TABS.get(unquote(rest), unquote(rest))
    if name not in checks.tabs:
        raise LessonError(line, f"“{name[:40]}” is not a tab; {_hint(name, list(checks.tabs))}")
    return {"show": name}


_BUTTONS = {"set": _set, "simulate": _simulate, "show": _show}
"""Functions that make the message of a button, by the word before the colon of its link."""


def _formula(latex: str, display: bool, line: int) -> str:
    """Convert a formula in LaTeX to MathML of known elements, which browsers can typeset."""
    latex = latex.strip()
    if len(latex) > LONGEST_FORMULA:
        raise LessonError(line, f"a formula is longer than {LONGEST_FORMULA} characters")
    wrong = f"“{latex[:60]}” is not a formula that can be set"
    braces = re.findall(r"(?<!\\)[{}]", latex)
    if braces.count("{") != braces.count("}"):  # the converter would fill in what is missing
        raise LessonError(line, f"{wrong}: its braces do not match")
    try:
        root = convert_to_element(latex, display="block" if display else "inline")
    except (Exception, RecursionError):
        raise LessonError(line, wrong) from None
    for element in root.iter():
        unknown = [key for key in element.attrib if key not in _MATHML_ATTRIBUTES.split()]
        if element.tag not in _MATHML_ELEMENTS.split() or unknown:
            raise LessonError(line, f"“{latex[:60]}” has an element not allowed: {element.tag}")
        if element.text:  # the converter writes letters as references; the tree needs letters
            element.text = re.sub(
                r"&#x([0-9A-Fa-f]{1,6});", lambda code: chr(int(code[1], 16)), element.text
            )
    return ElementTree.tostring(root, encoding="unicode")
