"""Figures for paper: Matplotlib draws what Bokeh would, with the page's own words."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from bearing_explorer import figures
from bearing_explorer.explorer.plots.compared_curves import CurveKey
from bearing_explorer.kit.plots import printed, style
from bearing_explorer.kit.plots.layers import Words, by_number, curve, filled, strips, uprights
from bearing_explorer.kit.plots.without_browser import Scripts
from bokeh import models
from bokeh.plotting import figure
from matplotlib.colors import to_rgba

from bearingcore import Recording, presets
from bearingcore.errors import FieldError
from tests.helpers.measuring import signal

RIG = presets["fan-rig"]
WORDS_OF = {
    "stiffness": ["Loaded balls", "cage angle now", "N·m/rad", "Grey: the bearing"],
    "maps": ["Loaded balls", "0 by symmetry", "44.3 MN/m"],
    "bearing": ["Contact load Q (N)", "36.5 N", "270°"],
    "load_distribution": ["Angular position φ (°)", "Contact load Q (N)"],
    "modes": ["Natural frequency f (Hz)", "x₁ 365–480 Hz"],
    "vibration_spectrum": ["Frequency f (Hz)", "y₂"],
    "vibration_time": ["Time t (ms)", "ball 1 enters"],
    "depth_profile": ["Depth d (µm)"],
    "accuracy": ["Error of spectrum (dB)", "10⁻³", "scipy BDF", "in use: 32.8k"],
    "alternatives": ["Error over what is allowed", "quasi-static"],
    "explore": ["Load, downwards −Fy (N)", "k_yy, mean at load, downwards"],
}
"""Of each figure, some words that the page shows too."""


CLICKS = Recording(np.where(np.arange(8192) % 400, 0.01, 9.0)[:, None], 4096.0, ("y",))


def texts(svg: str) -> str:
    return "\n".join(re.findall(r"<text[^>]*>([^<]*)</text>", svg)).replace("\u00a0", " ")


@pytest.mark.parametrize("name", WORDS_OF)
def test_a_figure_says_on_paper_what_the_page_says(name: str, tmp_path: Path) -> None:
    drawn = getattr(figures, name)(RIG)
    drawn.save(tmp_path / "figure.svg")
    svg = (tmp_path / "figure.svg").read_text(encoding="utf-8")
    for words in WORDS_OF[name]:
        assert words in texts(svg)
    assert not re.search("no value|Click", texts(svg))
    width = float(re.search(r'width="([\d.]+)pt"', svg)[1])
    assert width / 72.0 * 25.4 == pytest.approx(180.0 if name in ("stiffness", "maps") else 88.0)
    if name == "stiffness":  # at the width of a column
        drawn.save(tmp_path / "figure.svg", width=printed.COLUMN)
        narrow = texts((tmp_path / "figure.svg").read_text(encoding="utf-8"))
        assert narrow.count("MN/m") == narrow.count("In MN/m, kN/rad, N·m/rad") == 1


@pytest.mark.parametrize(("suffix", "begins"), [(".pdf", b"%PDF"), (".png", b"\x89PNG")])
def test_the_suffix_decides(suffix: str, begins: bytes, tmp_path: Path) -> None:
    drawn = figures.load_distribution(RIG)
    page = drawn.page()
    drawn.save(tmp_path / f"figure{suffix}", width=120.0)
    assert (tmp_path / f"figure{suffix}").read_bytes().startswith(begins)
    drawn.save(tmp_path / "figure.html")
    assert len((tmp_path / "figure.html").read_text()) == len(page)


def test_what_cannot_be_printed_is_refused(tmp_path: Path) -> None:
    drawn = figures.load_distribution(RIG)
    for name in ("figure.eps", "figure"):
        with pytest.raises(FieldError, match=r"\.html, \.svg, \.pdf, \.png"):
            drawn.save(tmp_path / name)
    with pytest.raises(FieldError, match="width is 5"):
        drawn.save(tmp_path / "figure.pdf", width=5.0)
    with pytest.raises(FieldError, match="life has no figure"):
        figures.life(presets["6206"]).save(tmp_path / "life.pdf")
    with pytest.raises(FieldError, match="which-length has no figure"):
        figures.which_length(RIG, recording=CLICKS).save(tmp_path / "lengths.pdf")
    assert not list(tmp_path.iterdir())


def test_the_extra_is_named_where_it_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "py_mini_racer", None)
    with pytest.raises(ImportError, match=r"bearing-explorer\[figures\]"):
        figures.load_distribution(RIG).save(tmp_path / "figure.svg")


def test_colours_have_the_scale_of_the_numbers(tmp_path: Path) -> None:
    drawn = figures.measured_kurtogram(RIG, recording=CLICKS)
    drawn.save(file := tmp_path / "figure.svg")
    ticks = re.findall(r"^\d+$", texts(file.read_text(encoding="utf-8")), re.MULTILINE)
    assert drawn.table()["kurtosis"].max() < 2.0 * max(map(int, ticks))


def test_an_upper_axis_is_a_second_one(tmp_path: Path) -> None:
    figures.diagnosis(RIG, recording=signal().recording).save(file := tmp_path / "figure.svg")
    assert "50\nOrder: times a turn" in texts(file.read_text(encoding="utf-8"))


def test_layers_have_their_numbers_and_colours() -> None:
    plot = figure(x_range=models.Range1d(0.0, 4.0), y_range=models.Range1d(0.0, 20.0))
    data = {"x": [1.0, 2.0, 3.0], "y": [10.0, np.nan, 12.0], "low": [0.5, 1.5, 2.5]}
    source = models.ColumnDataSource(data | {"high": [1.0, 2.0, 3.0], "kind": [0.0, 1.0, 0.0]})
    for layer in (
        curve("", "x", "y", "#0072B2", 2.0, (6, 2)),
        strips("", by_number("kind", ["#ff0000", "#0000ff"]), 0.5, reads=("kind",)),
        uprights("", "low"),
        filled("", "#00ff00"),
        Words("", "x", 0.5, "return si(row.x*1000, 'N')", y_share=True),
    ):
        layer.add(plot, source)
    plot.title, source.name = None, "_compared_0"
    CurveKey(plot).show(["heavier"])
    scripts = Scripts(plot.references(), {plot.id: (300.0, 200.0)})
    axes = plt.figure().subplots()
    printed._Printed(plot, axes, scripts)
    (line,) = axes.lines
    np.testing.assert_array_equal(line.get_ydata(), [10.0, np.nan, 12.0])
    assert to_rgba(line.get_color()) == to_rgba("#0072B2")
    assert line.get_linewidth() == pytest.approx(2.0 * printed.POINT)
    bands, edges = axes.collections
    np.testing.assert_allclose(bands.get_facecolor()[1], [0.0, 0.0, 1.0, 0.5])
    np.testing.assert_allclose(bands.get_paths()[2].get_extents().intervalx, [2.5, 3.0])
    assert [path.vertices[0, 0] for path in edges.get_paths()] == data["low"]
    assert [text.get_text() for text in axes.texts] == ["1\u00a0kN", "2\u00a0kN", "3\u00a0kN"]
    assert to_rgba(axes.texts[0].get_color()) == to_rgba(style.INK)
    assert axes.get_xlim() == (0.0, 4.0)
    assert axes.get_legend().get_window_extent().y0 >= axes.get_window_extent().y1  # above it
    plt.close("all")
