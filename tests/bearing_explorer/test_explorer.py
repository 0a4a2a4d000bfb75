"""A session without a browser: what its messages do, and that strangers' messages do nothing."""

import asyncio
import math
from collections.abc import Callable

import numpy as np
import pytest
from bearing_explorer.compute.results import Results
from bearing_explorer.session import Explorer, Section
from bearing_explorer.views.base import View

from bearingcore import presets
from tests.bearing_explorer.loops import run


class Depth(View):
    name = "depth"
    title = "Depth"
    needs = frozenset({"equilibrium"})

    def build(self, wire):
        from bokeh.models import Spacer

        self.drawn: list[float] = []
        self.source = wire.source(f"{self.name}", "depth")
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
def told(monkeypatch: pytest.MonkeyPatch) -> list[dict]:
    """What the controls were told."""
    news: list[dict] = []
    monkeypatch.setattr(
        "bearing_explorer.widgets.controls.Controls.tell", lambda self, **n: news.append(n)
    )
    return news


def session(*acts: Callable[[Explorer], None], rest: bool = False) -> Explorer:
    """A session in which `acts` happened and all was drawn, also for the hand's `rest`."""

    async def live() -> Explorer:
        explorer = Explorer(SECTIONS)
        explorer.draw()
        await idle(explorer)
        for act in acts:
            act(explorer)
            await idle(explorer)
        while rest and not explorer._rest.idle:
            await asyncio.sleep(0.002)
        await idle(explorer)
        return explorer

    async def idle(explorer: Explorer) -> None:
        while not explorer._worker.idle:
            await asyncio.sleep(0.002)

    return run(live())


def drawn(explorer: Explorer, section: str) -> list[float]:
    return explorer._views[section][0].drawn  # type: ignore[attr-defined]


def test_a_slider_reaches_the_view(told: list[dict]) -> None:
    explorer = session(lambda e: e._asked({"mark": 4, "set": {"depth_um": 80}}))
    assert explorer.scene.defect.depth == pytest.approx(80e-6)
    assert drawn(explorer, "one")[-1] == explorer.scene.defect.depth
    assert explorer._drawn_mark == 4
    assert told == [], "a control that moved itself is not moved again"
    assert explorer._views["one"][0].csv() == "depth_m\n8e-05\n"
    assert explorer.status.line["mood"] == "good"


def test_only_what_is_on_screen_is_made_and_drawn(told: list[dict]) -> None:
    explorer = session(lambda e: e._asked({"mark": 1, "set": {"depth_um": 80}}))
    assert "two" not in explorer._views
    shown = session(lambda e: e._tab_asked({"show": "two"}))
    assert drawn(shown, "two") == [pytest.approx(50e-6)], "a view that appears is up to date"
    assert len(drawn(shown, "one")) == 1, "a view that went is left alone"


def test_a_typed_number_is_confirmed_and_a_bad_one_refused(told: list[dict]) -> None:
    explorer = session(lambda e: e._asked({"mark": 1, "typed": {"extent_deg": "33,5"}}))
    assert explorer.values["extent_deg"] == 33.5
    assert len(told) == 1
    assert told[0]["state"]["values"] == {"extent_deg": 33.5}
    told.clear()
    before = presets["fan-rig"]
    explorer = session(lambda e: e._asked({"mark": 9, "typed": {"extent_deg": "500"}}))
    assert explorer.scene.defect.extent == pytest.approx(before.defect.extent)
    assert list(told[0]["refused"]) == ["extent_deg"]
    assert explorer._drawn_mark == 9, "a refusal is answered too, or the browser would wait"


def test_what_the_scene_refuses_stays_as_it_was(
    told: list[dict], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise ValueError("extent is 3; allowed: less")

    def act(explorer: Explorer) -> None:
        monkeypatch.setattr("bearing_explorer.state.scene_editor.scene_with_fields", refuse)
        explorer._asked({"mark": 1, "set": {"extent_deg": 40}})

    explorer = session(act)
    assert explorer.values["extent_deg"] == pytest.approx(12.9)
    assert "allowed: less" in told[0]["refused"]["extent_deg"]


def test_choosing_a_preset_brings_its_values_and_ranges(told: list[dict]) -> None:
    explorer = session(lambda e: e._asked({"mark": 1, "choose": {"preset": "liew-lim"}}))
    assert explorer.scene.bearing == presets["liew-lim"].bearing
    assert told[0]["state"]["values"]["fy_n"] == -2000
    assert told[0]["state"]["limits"]["fy_n"]["most"] >= 2000
    explorer = session(lambda e: e._asked({"mark": 1, "choose": {"edge": "exact"}}))
    assert explorer.scene.defect.edge == "exact"


def test_reset_brings_the_preset_back(told: list[dict]) -> None:
    def act(explorer: Explorer) -> None:
        explorer._asked({"mark": 1, "set": {"extent_deg": 90}})
        explorer._asked({"mark": 2, "reset": True})

    explorer = session(act)
    assert explorer.values["extent_deg"] == pytest.approx(12.9)
    assert told[-1]["state"]["values"]["extent_deg"] == pytest.approx(12.9)


@pytest.mark.parametrize(
    ("depth_um", "words"), [(400, "more than this view can show"), (5, "could not be computed")]
)
def test_a_view_that_fails_says_so_and_keeps_its_picture(
    told: list[dict], depth_um: float, words: str
) -> None:
    explorer = session(lambda e: e._asked({"mark": 3, "set": {"depth_um": depth_um}}))
    view = explorer._views["one"][0]
    assert words in view._sentence.text
    assert "Traceback" not in view._sentence.text
    assert "a bug" not in view._sentence.text
    assert view.csv() == "depth_m\n5e-05\n", "the table is that of the picture"
    assert explorer._drawn_mark == 3


@pytest.mark.parametrize(
    "message",
    [
        None,
        "set",
        [1],
        {},
        {"mark": "x", "set": {"extent_deg": {}}},
        {"mark": -1, "set": {"nothing": 1}},
        {"mark": 1e99, "set": {1: 2, None: 3}},
        {"set": {f"extent_{i}": i for i in range(1000)}},
        {"choose": {"preset": ["fan-rig"], "edge": {"exact": 1}}},
        {"choose": {"preset": "../../etc/passwd"}},
        {"typed": {"extent_deg": "9" * 100000}},
        {"reset": "yes"},
        {"floor": "1 2"},
        {"floor": {"name": 5, "text": "1 2\n3 4"}},
        {"floor": {"name": "x", "text": ["1 2"]}},
        {"floor": {}},
        {"choose": {"defect": ["add"], "dofs": {"x": 1}, "race": 7, "numbers": "none"}},
        {"set": {"n_balls": -5, "ball_diameter_mm": {}, "stiffness_x": "", "seed": "1e99"}},
    ],
)
def test_strangers_messages_change_nothing(told: list[dict], message: object) -> None:
    explorer = session(lambda e: e._asked(message))
    untouched = session(lambda e: None)
    assert explorer.scene == untouched.scene
    assert explorer.inputs.mark == 0


@pytest.mark.parametrize("message", [None, {}, {"show": "nowhere"}, {"show": ["one"]}, 5])
def test_strangers_tabs_do_not_exist(told: list[dict], message: object) -> None:
    assert session(lambda e: e._tab_asked(message))._shown == "one"


def test_a_file_becomes_a_floor_and_a_bad_one_a_sentence(told: list[dict]) -> None:
    text = "250 0\n265 60\n280 0\n"

    async def live(text: str) -> Explorer:
        explorer = Explorer(SECTIONS)
        explorer._asked({"mark": 2, "floor": {"name": "wear.txt", "text": text}})
        while explorer._tasks or not explorer._worker.idle:
            await asyncio.sleep(0.002)
        return explorer

    explorer = run(live(text))
    assert explorer.scene.defect.floor is not None
    assert explorer.values["extent_deg"] == pytest.approx(30.0)
    assert told[-1]["state"]["floor"]["words"] == "wear.txt: 3 points"
    assert drawn(explorer, "one")[-1] == pytest.approx(60e-6)
    explorer = run(live("nothing"))
    assert explorer.scene == presets["fan-rig"]
    assert told[-1]["state"]["floor"]["bad"]


def test_what_is_told_names_the_change_it_answers(told: list[dict]) -> None:
    """The browser passes over it where a hand has moved on meanwhile."""
    session(lambda e: e._asked({"mark": 7, "typed": {"extent_deg": "20"}}))
    assert told[-1]["state"]["mark"] == 7


def test_limits_are_looked_at_when_the_hand_rests(
    told: list[dict], monkeypatch: pytest.MonkeyPatch
) -> None:
    looked: list[float] = []
    real = Results.limits.func

    def looking(results: Results) -> object:
        looked.append(results.scene.load.fy)
        return real(results)

    monkeypatch.setattr(Results.limits, "func", looking)
    monkeypatch.setattr("bearing_explorer.session._LIMITS_EVERY", math.inf)
    calm = session(lambda e: e._asked({"mark": 1, "choose": {"preset": "6205"}}), rest=True)
    assert {row["state"] for row in calm.limits.rows} == {"kept"}
    looked.clear()
    heavy = session(
        *(
            lambda e, fy=fy: e._asked({"mark": 1, "typed": {"fy_n": f"{fy}"}})
            for fy in (-120, -130, -140, -20000)
        ),
        rest=True,
    )
    assert heavy.limits.rows[0]["state"] == "crossed"
    assert looked[-1] == -20000.0
    assert not {-130.0, -140.0} & set(looked), "not while it moves"
