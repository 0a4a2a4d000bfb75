"""A session without a browser: what its messages do, and that strangers' messages do nothing."""

import asyncio
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from bearing_explorer.explorer.messages import LinksChange, SceneChange
from bearing_explorer.kit.messages import take
from bearing_explorer.kit.session import Section
from bearing_explorer.kit.views.base import View

from bearingcore import presets
from tests.helpers.loops import run
from tests.helpers.sessions import SceneSession


class Depth(View):
    """A view that notes what it is asked to draw."""

    name = "depth"
    title = "Depth"
    needs = frozenset({"equilibrium"})

    def build(self, packed):
        from bokeh.models import Spacer

        self.drawn: list[float] = []
        self.source = packed.source(f"{self.name}", "depth")
        return Spacer()

    def data(self, results):
        depth = results.scene.defect.depth
        if depth > 300e-6:
            raise ValueError("depth is more than this view can show")
        if depth < 10e-6:
            raise RuntimeError("a bug")
        self.drawn.append(depth)
        return {self.name: {"depth": np.array([depth])}}, {}

    def sentence(self, results):
        return f"{results.scene.defect.depth:g}"

    def table(self, results):
        return {"depth_m": np.array([results.scene.defect.depth])}


class Other(Depth):
    name = "other"


SECTIONS = (Section("one", "One", (Depth,)), Section("two", "Two", (Other,)))


@pytest.fixture
def news(monkeypatch: pytest.MonkeyPatch) -> list[dict]:
    """What the controls were shown."""
    news: list[dict] = []
    monkeypatch.setattr(
        "bearing_explorer.explorer.widgets.controls.Controls.send", lambda self, n: news.append(n)
    )
    return news


def session(
    *acts: Callable[[SceneSession], None],
    rest: bool = False,
    sections: Sequence[Section] = SECTIONS,
    preset: str = "fan-rig",
) -> SceneSession:
    """A session in which `acts` happened and all was drawn, also for the hand's `rest`."""

    async def live() -> SceneSession:
        explorer = SceneSession(sections, preset)
        explorer.draw()
        await idle(explorer)
        for act in acts:
            act(explorer)
            await idle(explorer)
        while rest and not explorer._loop.idle:
            await asyncio.sleep(0.002)
        explorer._loop.stop()
        return explorer

    async def idle(explorer: SceneSession) -> None:
        while explorer.jobs.busy() or not explorer._loop.drawn:
            await asyncio.sleep(0.002)

    return run(live())


def changing(message: object) -> Callable[[SceneSession], None]:
    """The controls send a message, which is checked where it arrives."""
    return lambda explorer: take(explorer.change_scene, SceneChange, message)


def linking(message: object) -> Callable[[SceneSession], None]:
    """The bar above the controls sends one."""
    return lambda explorer: take(explorer.change_links, LinksChange, message)


def showing(tab: str) -> Callable[[SceneSession], None]:
    """A tab is opened."""
    return lambda explorer: explorer.show_tab({"show": tab})


def drawn(explorer: SceneSession, section: str) -> list[float]:
    return explorer._views[section][0].drawn  # type: ignore[attr-defined]


def test_a_slider_reaches_the_view_on_screen_and_no_other(
    news: list[dict], monkeypatch: pytest.MonkeyPatch
) -> None:
    # a kernel that is loaded first may take longer, and a tab is then drawn coarsely as well
    monkeypatch.setattr("bearing_explorer.kit.session._SOON", 60.0)
    explorer = session(changing({"mark": 4, "set": {"depth_um": 80}}))
    assert explorer.scene.defect.depth == pytest.approx(80e-6)
    assert drawn(explorer, "one")[-1] == explorer.scene.defect.depth
    assert explorer._drawn_mark == 4
    assert news == [], "a control that moved itself is not moved again"
    assert explorer._views["one"][0].csv() == "depth_m\n8e-05\n"
    assert explorer.status.line["mood"] == "good"
    assert "two" not in explorer._views
    shown = session(showing("two"))
    assert drawn(shown, "two") == [pytest.approx(50e-6)], "a view that appears is up to date"
    assert len(drawn(shown, "one")) == 1, "a view that went is left alone"


@pytest.mark.parametrize(("soon", "resting"), [(60.0, [True]), (0.0, [False, True])])
def test_a_tab_opens_with_its_fine_picture_where_that_is_there_soon(
    monkeypatch: pytest.MonkeyPatch, soon: float, resting: list[bool]
) -> None:
    monkeypatch.setattr("bearing_explorer.kit.session._SOON", soon)
    shown: list[dict] = []
    monkeypatch.setattr(
        "bearing_explorer.kit.widgets.status.StatusLine.put", lambda self, **n: shown.append(n)
    )
    session(rest=True)
    assert [one["line"]["resting"] for one in shown if "line" in one] == resting


def test_the_first_picture_of_a_change_has_the_limits_of_its_scene() -> None:
    """A typed load may be far over them; those of a drag that goes on follow each second."""
    explorer = session(rest=True)
    moving = explorer.content
    assert moving.moving
    explorer._moved_at -= 2.0
    assert [explorer._warnings_due(moving) for _ in range(3)] == [True, False, False]


def test_a_typed_number_is_confirmed_and_a_bad_one_refused(news: list[dict]) -> None:
    explorer = session(changing({"mark": 1, "typed": {"extent_deg": "33,5"}}))
    assert explorer.editor.values["extent_deg"] == 33.5
    assert len(news) == 1
    assert news[0]["state"]["values"] == {"extent_deg": 33.5}
    assert news[0]["state"]["mark"] == 1, "a hand that has moved on meanwhile passes over it"
    news.clear()
    before = presets["fan-rig"]
    explorer = session(changing({"mark": 9, "typed": {"extent_deg": "500"}}))
    assert explorer.scene.defect.extent == pytest.approx(before.defect.extent)
    assert list(news[0]["refused"]) == ["extent_deg"]
    assert explorer._drawn_mark == 9, "a refusal is answered too, or the browser would wait"


@pytest.mark.parametrize(
    ("depth_um", "words"), [(400, "more than this view can show"), (5, "could not be computed")]
)
def test_a_view_that_fails_says_so_and_keeps_its_picture(
    news: list[dict], depth_um: float, words: str
) -> None:
    explorer = session(changing({"mark": 3, "set": {"depth_um": depth_um}}))
    view = explorer._views["one"][0]
    assert words in view._sentence.text
    assert "Traceback" not in view._sentence.text
    assert "a bug" not in view._sentence.text
    assert view.csv() == "depth_m\n5e-05\n", "the table is that of the picture"
    assert explorer._drawn_mark == 3


SENSELESS: tuple[dict, ...] = (
    {"mark": -1, "set": {"nothing": 1}},
    {"set": {f"extent_{i}": i for i in range(1000)}},
    {"choose": {"preset": "../../etc/passwd"}},
    {"choose": {"numbers": "none", "race": "both", "defect": "9", "dofs": "q"}},
    {"set": {"n_balls": -5, "ball_diameter_mm": {}, "stiffness_x": "", "seed": "1e99"}},
)
"""Messages of the form that the page's have; others are ignored, as `test_messages` shows."""
SENSELESS_LINKS: tuple[dict, ...] = (
    {"mark": 2, "open": {"name": "x", "text": "v=1&n_balls=1e99"}},
    {"mark": 2, "open": {"name": "x", "text": "[" * 100_000}},
    {"mark": 2, "compare": {"name": "x", "text": "v=1&floor=measured&points=" + "A" * 100_000}},
    {"want": "../../etc/passwd"},
)


def test_senseless_messages_change_nothing(news: list[dict]) -> None:
    explorer = session(
        *(changing(message) for message in SENSELESS),
        *(linking(message) for message in SENSELESS_LINKS),
        *(showing(tab) for tab in ("nowhere", "", "overview")),
    )
    assert explorer.scene == presets["fan-rig"]
    assert explorer.content.compared == ()
    assert explorer._shown == "one"
    assert len(explorer.share.state["said"]["words"]) < 400


def test_one_report_at_a_time(news: list[dict], monkeypatch: pytest.MonkeyPatch) -> None:
    answers: list[dict] = []
    monkeypatch.setattr(
        "bearing_explorer.explorer.widgets.share.ShareBar.answer",
        lambda self, **news: answers.append(news),
    )

    def ask_twice(explorer: SceneSession) -> None:
        explorer.explorer.report_on_signal = lambda about: lambda: {"link": about.link}
        for _ in range(2):
            explorer.change_links({"report": "http://localhost:5006/"})

    session(ask_twice)
    assert [list(news) for news in answers] == [["report"]]
    assert answers[0]["report"]["link"].startswith("http://localhost:5006/?v=1&preset=fan-rig")
