"""Colours, light and dark: text is readable, lines are seen, colour-blind eyes tell them apart."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from bearing_explorer.diagnosis.views.frequency_lines import FAMILIES
from bearing_explorer.explorer.plots import compared_curves
from bearing_explorer.explorer.views import work_precision
from bearing_explorer.kit.assets import asset_text
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.theme import DARK_COLORS, DARK_PALETTES, dark_properties

from bearingcore.model.experiments import METHODS

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
