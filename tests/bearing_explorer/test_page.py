"""What holds for every view of the page, and for its colours in light and dark."""

import csv
import io
import itertools
import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from bearing_explorer.diagnosis.diagnoses import Question, diagnosis_of, extent_of
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.frequency_lines import FAMILIES
from bearing_explorer.diagnosis.views.measured_view import MeasuredView
from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.views import work_precision
from bearing_explorer.explorer.views.control_view import ControlView
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.pictures import BROKEN, drawing_of
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.theme import DARK_COLORS, DARK_PALETTES, dark_properties
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View, parts_of
from bearing_explorer.kit.views.job_view import JobView
from bearing_explorer.page import SECTIONS

from bearingcore import Defect, RoughFloor, presets
from bearingcore.model.experiments import METHODS
from tests.helpers.measuring import measuring, signal

VIEWS = [view for section in SECTIONS for view in section.views]
ALIKE = {
    *("6203", "6206", "209", "seven-ball", "7208-15deg", "7208-40deg"),
    *("7208-face-to-face", "7208-tandem", "3208"),
}
"""Presets of a kind that another one stands for."""
EVERY_DAY = ("fan-rig", "7208-back-to-back", "nu208", "1208", "axial", "both races")
"""Scenes of each kind that stand for the others where time is short."""
WITH_A_SIGNAL = ("fan-rig", "both races")
"""Scenes beside which views of a measured signal are drawn, of which little depends on them."""
SCENES = {
    **{name: scene for name, scene in presets.items() if name not in ALIKE},
    "healthy": presets["fan-rig"].healthy(),
    "axial": presets["fan-rig"].replace(fz=50.0),
    "inner": presets["fan-rig"].replace(race="inner"),
    "both races": presets["fan-rig"].replace(
        defect=(Defect(0.3, 50e-6, 4.7), Defect(0.2, 30e-6, 1.0, "inner"))
    ),
    "rough": presets["fan-rig"].replace(floor=RoughFloor(5e-6, 100e-6)),
    "all around": presets["fan-rig"].replace(extent=2.0 * math.pi),
}

diagnosed, measured_extent = cache(diagnosis_of), cache(extent_of)
"""Answers about a bearing, which several scenes have."""


def test_captions_begin_with_a_short_sentence_and_the_rest_opens() -> None:
    """It fits one line on a phone too; the key of a figure is seen."""
    views = [view for view in VIEWS if not view.compact]
    lines = {view.name: re.split(r"(?<=\.) ", view.about)[0] for view in views}
    assert {name: line for name, line in lines.items() if not 8 < len(line) <= 54} == {}
    text = "One, 0.5 of it. More. Grey: re 1 (m/s²)². “Three”."
    assert parts_of(text, key_alone=False) == (
        "One, 0.5 of it. Grey: re 1 (m/s²)².",
        "More. “Three”.",
    )
    assert parts_of(text, key_alone=True)[0] == "Grey: re 1 (m/s²)²."
    for view in VIEWS:
        rest = parts_of(view.about, key_alone=True)[1]
        assert not re.search(r"\b(Grey|Shaded|Dashed|Blue|Dots): ", rest)


@pytest.mark.parametrize(
    ("name", "view"),
    [
        pytest.param(
            name,
            view,
            id=f"{name}-{view.name}",
            marks=[pytest.mark.proof]
            * (name not in EVERY_DAY or ("ball_mass" in view.needs and name != "fan-rig")),
        )
        for name in SCENES
        for view in VIEWS
        if name in WITH_A_SIGNAL or not issubclass(view, MeasuredView)
    ],
)
def test_every_view_draws_every_scene(name: str, view: type[View]) -> None:
    """It fills the sources it declared, in words and as a table.

    Of slow answers it reads those alone that it says it needs: others would be computed among the
    quick ones and hold them up.
    """
    asked: set[str] = set()

    class Watched(Results):
        def __getattribute__(self, name: str) -> object:
            asked.add(name)
            return super().__getattribute__(name)

    results = Watched(SCENES[name], 0.1)
    packed = PackedSource()
    made = view(packed)
    if isinstance(made, MeasuredView):
        made.measure(measuring(signal()))
    if isinstance(made, PartDiagnosis | SpallExtent):  # whose answers come from the background
        about = Question.about(signal())
        made.measurement.diagnoses.keep(about, diagnosed(about))
    if isinstance(made, SpallExtent):
        question = made.question()
        made.measurement.extents.keep(question, measured_extent(question))
    if "ball_mass" in view.needs and results.scene.bearing.kind.mass_unknown:
        drawing = drawing_of(results, made)
        assert drawing.data is None
        assert drawing.sentence == (
            "Not shown for this scene: the model has no mass of tapered rollers: a rib holds them, "
            "which is left out."
        )
        return
    for plot in made.figures:
        for drawn in (plot.x_range, plot.y_range):
            way_back = drawn.reset_start, drawn.reset_end
            assert way_back == (drawn.start, drawn.end), "two clicks lead to the whole figure"
    data, ranges = made.all_data(results)
    assert packed.pack(data, ranges).size > 3 or isinstance(made, ControlView)
    assert all(np.isfinite(limits).all() and limits[0] != limits[1] for limits in ranges.values())
    assert made.sentence(results).endswith(".")
    assert asked & Results.slow <= view.needs
    made.say(results, "")
    rows = list(csv.reader(io.StringIO(made.csv())))
    if not isinstance(made, JobView):  # which has numbers when its job has been asked for
        assert len(rows) > 1
    assert len({len(row) for row in rows}) == 1


@pytest.mark.parametrize("view", VIEWS, ids=lambda view: view.name)
def test_a_scene_without_an_answer_gets_words_from_every_view(view: type[View]) -> None:
    results = Results(presets["fan-rig"].replace(fy=0.0), 0.1)
    made = view(PackedSource())
    if isinstance(made, MeasuredView):  # which say nothing before there is a signal
        made.measure(measuring(signal()))
    drawing = drawing_of(results, made)
    assert drawing.sentence.endswith(".")
    assert drawing.sentence != BROKEN


@pytest.mark.parametrize(
    "view", [view for view in VIEWS if issubclass(view, MeasuredView)], ids=lambda view: view.name
)
def test_that_there_is_no_signal_is_said_once_by_what_asks_for_it(view: type[MeasuredView]) -> None:
    results = Results(presets["fan-rig"])
    made = view(PackedSource())
    made.measure(measuring())
    assert made.sentence(results) == ""
    assert made.table(results) == {}
    drawn = [column for own in made.all_data(results)[0].values() for column in own.values()]
    assert not any(np.size(column) for column in drawn)
    made.say(results, "")
    assert not made.hidden.visible


def test_the_lines_of_python_on_the_first_page_run(capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(asset_text("notebooks/first_lines.py"), "first_lines.py", "exec"), {})
    said = capsys.readouterr().out
    assert "N at most on a ball" in said
    assert "y1" in said
    assert "loudest lines" in said


FIGURES = [Path(module.__file__).parent for module in (style, compared_curves, work_precision)]
#: what lies on top of pictures
FIXED = {style.LIGHT.upper(), style.SHADE.upper(), "#00000000"}


def linear(color: str) -> np.ndarray:
    coded = np.array([int(color[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0
    return np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)


def contrast(a: str, b: str) -> float:
    """As WCAG counts it."""
    bright, dim = sorted(float(linear(c) @ [0.2126, 0.7152, 0.0722]) for c in (a, b))[::-1]
    return (bright + 0.05) / (dim + 0.05)


def dark_color(color: str) -> str:
    return DARK_COLORS.get(color.upper(), color)


def properties(theme: str) -> dict[str, str]:
    """Colours of the page's style."""
    block = re.search(r':root\[data-theme="dark"\] \{(.*?)\}', asset_text("page.css"), re.DOTALL)
    light = asset_text("page.css").split(":root {")[1].split("}")[0]
    assert block is not None
    text = block[1] if theme == "dark" else light
    return dict(re.findall(r"--([a-z-]+): (#[0-9a-f]{6});", text))


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_text_of_the_page_is_readable(theme: str) -> None:
    colors = properties(theme)
    for text in ("ink", "ink-soft", "accent", "good", "bad", "warn"):
        for ground in ("card", "paper", "track-soft"):
            assert contrast(colors[text], colors[ground]) >= 4.5, (text, ground)
    for text, ground in (("accent", "accent-paper"), ("ink-soft", "accent-paper"),
                         ("ink", "accent-paper"), ("bad", "bad-paper"), ("ink", "bad-paper"),
                         ("ink", "warn-paper"), ("warn", "warn-paper"),
                         ("card", "accent")):  # fmt: skip
        assert contrast(colors[text], colors[ground]) >= 4.5, (text, ground)


@pytest.mark.parametrize("turned", [str, dark_color], ids=["light", "dark"])
def test_lines_and_text_of_figures_are_seen(turned: object) -> None:
    assert callable(turned)
    paper = turned(style.PAPER)
    for text in (style.INK, style.FAINT_INK):
        assert contrast(turned(text), paper) >= 4.5
    lines = {*style.DIRECTION_COLORS[:2], *style.BALL_COLORS, style.HEALTHY, *work_precision.COLORS}
    for line in lines:
        assert contrast(turned(line), paper) >= 3.0, line


def seen_by(kind: str, color: str) -> np.ndarray:
    """A colour in Oklab as colour-blind eyes see it (Viénot, Brettel and Mollon 1999)."""
    to_lms = np.array(
        [[17.8824, 43.5161, 4.11935], [3.45565, 27.1554, 3.86714], [0.0299566, 0.184309, 1.46709]]
    )
    blind = {
        "trichromat": np.eye(3),
        "protanope": np.array([[0.0, 2.02344, -2.52581], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        "deuteranope": np.array([[1.0, 0.0, 0.0], [0.494207, 0.0, 1.24827], [0.0, 0.0, 1.0]]),
    }[kind]
    rgb = np.clip(np.linalg.inv(to_lms) @ blind @ to_lms @ linear(color), 0.0, 1.0)
    cones = np.array(
        [[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
         [0.0883024619, 0.2817188376, 0.6299787005]]
    )  # fmt: skip
    lab = np.array(
        [[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099],
         [0.0259040371, 0.7827717662, -0.8086757660]]
    )  # fmt: skip
    return lab @ np.cbrt(cones @ rgb)


@pytest.mark.parametrize("turned", [str, dark_color], ids=["light", "dark"])
@pytest.mark.parametrize("kind", ["trichromat", "protanope", "deuteranope"])
def test_colors_that_mean_different_things_are_told_apart(kind: str, turned: object) -> None:
    assert callable(turned)
    one_figure = [
        (*style.DIRECTION_COLORS, style.HEALTHY),
        (style.DEFECTIVE, style.HEALTHY, *compared_curves.COLORS),
        style.BALL_COLORS,
        [family.color for family in FAMILIES],
        work_precision.COLORS,
    ]
    for colors in one_figure:
        for pair in itertools.combinations(dict.fromkeys(colors), 2):
            a, b = (seen_by(kind, turned(color)) for color in pair)
            assert np.linalg.norm(a - b) > 0.06, pair  # 0.02 is just seen


def test_each_method_has_a_colour_of_its_own() -> None:
    assert len(set(work_precision.COLORS)) >= len(METHODS)


def test_every_color_of_a_figure_has_its_dark_one() -> None:
    known = {*DARK_COLORS, *FIXED}
    odd = {
        f"{path.name}: {color}"
        for folder in FIGURES
        for path in folder.rglob("*.py")
        if path.name != "theme.py"
        for color in re.findall(r"[\"'](#[0-9A-Fa-f]{6,8})[\"']", path.read_text(encoding="utf-8"))
        if color.upper() not in known
    }
    assert not odd, "colours that would not follow the page into the dark"
    assert len(set(DARK_COLORS.values())) == len(DARK_COLORS), "or there is no way back"
    for light, dark in DARK_PALETTES:
        assert light != dark
    assert f"--in-dark-{style.INK[1:].upper()}" in dark_properties()
