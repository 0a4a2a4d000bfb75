"""Plans on the page: what is chosen by hand, when the hand is at rest, and what is drawn then."""

from __future__ import annotations

import asyncio
import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
from bearing_explorer.results import idle_task, planning
from bearing_explorer.results.answers import plans
from bearing_explorer.results.motion_cost import is_costly
from bearing_explorer.results.planning import by_hand, chosen, plan_for, with_choices
from bearing_explorer.results.results import Results
from bearing_explorer.session import Explorer, Section
from bearing_explorer.state.settings import MotionPlanning, Settings
from bearing_explorer.views.base import View
from bearing_explorer.views.plan import PlanInFull, how_of, remarks_of
from bearing_explorer.widgets.status import status_of
from bokeh.models import Spacer

from bearingcore import equilibrium, presets
from bearingcore.plan import BUDGETS, SETTLED
from tests.helpers.loops import run

FAN_RIG, LIEW_LIM = presets["fan-rig"], presets["liew-lim"]

# --- chosen by hand


def test_what_nobody_chose_is_the_programs() -> None:
    settings = Settings()
    assert by_hand(settings) == []
    assert settings.planning("stiffness") == BUDGETS["stiffness"]
    assert with_choices(settings, chosen(settings)) == settings


def test_choices_are_taken_said_and_given_back() -> None:
    asked = {
        "curve_budget": "0.001",
        "cage_angles": "361",
        "vibration_budget": "0.5",
        "step_rate": "32768",
        "steady": "march",
        "balls_up_to": "5000",
    }
    settings = with_choices(Settings(step_rate=21845.0), asked)
    assert chosen(settings) == asked
    assert settings.planning("load") == 1e-3
    moving = settings.planning(SETTLED)
    assert isinstance(moving, MotionPlanning)
    assert (moving.budget, moving.steady, moving.step_rate) == (0.5, "march", 32768.0)
    assert moving.up_to == 5000.0
    words = "; ".join(by_hand(settings))
    for word in ("0.1 %", "361", "0.5 dB", "marched motion", "32768 Hz", "below 5 kHz"):
        assert word in words
    one_back = with_choices(settings, {"cage_angles": ""})
    assert one_back == dataclasses.replace(settings, cage_angles=None)
    assert with_choices(settings, {"own": True}) == Settings()


@pytest.mark.parametrize(
    "message",
    [
        {},
        {"cage_angles": "10000000"},
        {"cage_angles": 361},
        {"curve_budget": "1e-12"},
        {"vibration_budget": "nan"},
        {"steady": "orbit; import os"},
        {"steady": ["orbit"]},
        {"own": "true"},
        {5: None, "step_rate": "1"},
    ],
)
def test_strangers_choices_change_nothing(message: dict) -> None:
    assert with_choices(Settings(), message) == Settings()


# --- plans


def test_a_march_can_be_asked_for_where_an_orbit_would_do() -> None:
    orbital = plan_for(FAN_RIG, SETTLED, Settings(steady="orbit").planning(SETTLED))
    assert "stable orbit of 1 ball pass" in how_of(orbital)
    marched = plan_for(FAN_RIG, SETTLED, Settings(steady="march").planning(SETTLED))
    assert marched.orbit is None
    assert how_of(marched).startswith("march of")


def test_an_orbit_can_be_asked_for_and_says_what_it_errs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where the program itself would march, which depends on how fast the machine is."""
    plan = planning.plan
    monkeypatch.setattr(planning, "plan", lambda *a, **k: plan(*a, **(k | {"march": True})))
    asked = plan_for(LIEW_LIM, SETTLED, Settings(steady="orbit").planning(SETTLED))
    assert asked.orbit is not None
    assert 0.0 < asked.predicted_error < 5.0
    assert asked.met == (asked.predicted_error <= asked.error_budget)
    assert "ball pass" in asked.sentence()


def test_where_no_orbit_holds_the_march_stays_and_says_why() -> None:
    never = LIEW_LIM.replace(race="inner", shaft_speed=40.0)
    made = plan_for(never, SETTLED, Settings(steady="orbit").planning(SETTLED))
    assert made.orbit is None
    assert "no orbit" in made.note
    assert any("no orbit" in words for words in remarks_of(made))


# --- what is drawn by a plan


@pytest.mark.parametrize("preset", ["fan-rig", "liew-lim"])
def test_curves_are_drawn_at_the_planned_angles_within_the_error(preset: str) -> None:
    scene = presets[preset]
    usual, planned = Results(scene), Results(scene, planned=("stiffness",))
    assert usual.plan is None
    assert planned.plan is not None
    nodes = planned.equilibrium.cage_angles
    np.testing.assert_array_equal(nodes, planned.plan.cage_angles)
    between = 0.5 * (nodes[1:] + nodes[:-1])[np.diff(nodes) > 1e-6]
    truth = equilibrium(scene, between).term("k_yy")
    drawn = np.interp(between, nodes, planned.equilibrium.term("k_yy"))
    assert np.abs(drawn - truth).max() < BUDGETS["stiffness"] * np.ptp(truth)
    assert planned.healthy_equilibrium.cage_angles.size != nodes.size, "planned on its own"
    coarse = np.interp(between, usual.equilibrium.cage_angles, usual.equilibrium.term("k_yy"))
    assert np.abs(coarse - truth).max() > np.abs(drawn - truth).max()


def test_angles_set_by_hand_are_drawn_moving_and_at_rest() -> None:
    settings = Settings(cage_angles=61)
    for results in (
        Results(FAN_RIG, settings=settings, moving=True),
        Results(FAN_RIG, settings=settings, planned=("load",)),
    ):
        assert results.equilibrium.cage_angles.size == 61
        assert results.plan is None
        assert "cage angles set by hand: 61" in status_of(results, 0.0)["details"]


def test_later_turns_of_the_shaft_are_not_drawn_by_the_plan_of_the_first() -> None:
    inner = FAN_RIG.replace(race="inner")
    first = Results(inner, planned=("modes",))
    assert first.plan is not None
    later = Results(inner, cage_angle=0.6 * 2.0 * math.pi, planned=("modes",))
    assert later.stretch[0] > 0.0
    assert later.plan is None
    assert later.modes.cage_angles[0] == pytest.approx(later.stretch[0])


@pytest.mark.parametrize("preset", ["fan-rig", "liew-lim", "6206"])
def test_nothing_jumps_when_the_planned_spectrum_replaces_the_live_one(preset: str) -> None:
    scene = presets[preset]
    planned = Results(scene, planned=(SETTLED,))
    for live in (Results(scene), Results(scene, moving=True)):
        assert live.excerpt.balls[0] == planned.excerpt.balls[0]
        assert live.excerpt.time[-1] == pytest.approx(planned.excerpt.time[-1], abs=1e-4)
        for dof in ("x", "y"):
            frequency, density = live.late_spectra[dof]
            other = np.interp(frequency, *planned.late_spectra[dof])
            seen = (frequency > 95.0) & (frequency < 2500.0) & (density > 1e-3 * density.max())
            apart = np.abs(10.0 * np.log10(other[seen] / density[seen]))
            assert apart.max() < 0.6, "dB: a pixel or two of the figure"


def test_motions_that_take_long_are_coarse_while_something_moves_and_only_then() -> None:
    assert not is_costly(FAN_RIG, 65536.0, 0.3)
    assert is_costly(FAN_RIG, 65536.0, 1.4), "10 ms of the 33 that a frame of a drag has"
    moving, still = Results(LIEW_LIM, moving=True), Results(LIEW_LIM)
    assert moving.coarse
    assert not still.coarse
    assert not Results(LIEW_LIM, moving=True, settings=Settings(step_rate=65536.0)).coarse
    shown = frozenset({"motion"})
    assert not moving.is_coarse(frozenset({"equilibrium"}))
    assert 0.4 < moving.motion.time[-1] / still.motion.time[-1] < 0.6
    assert moving.motion.step_rate < 0.6 * still.motion.step_rate
    assert any("coarse" in words for words in status_of(moving, 0.0, shown)["details"])
    assert not any("coarse" in words for words in status_of(still, 0.0, shown)["details"])


def test_motions_that_are_compared_are_marched_alike() -> None:
    """Radial motion is cheap and that in five directions dear: both are coarse or none is."""
    short = Settings(duration=0.3)
    moving = Results(FAN_RIG, moving=True, settings=short)
    still = Results(FAN_RIG, settings=short)
    assert not moving.coarse
    assert moving.is_coarse(frozenset({"dof_comparison"}))
    assert not still.is_coarse(frozenset({"dof_comparison"}))
    for results in (moving, still):
        assert max(results.dof_comparison.motion.values()) < 0.05


def test_the_plan_in_full_has_a_row_for_each_kind_of_picture() -> None:
    from bearing_explorer.serve.packed_source import PackedSource

    view = PlanInFull(PackedSource())
    results = Results(FAN_RIG, planned=PlanInFull.plans)
    view.data(results)
    view.say(results, view.sentence(results))
    shown = view._table.shown
    assert [row[0] for row in shown["rows"]] == [
        "Loads of the balls",
        "Stiffness",
        "Natural frequencies",
        "Settled vibration",
    ]
    assert {len(row) for row in shown["rows"]} == {len(shown["heads"])}
    view.say(Results(FAN_RIG, moving=True), "")
    assert view._table.shown == shown | {"stale": True}


# --- a session


class Curves(View):
    name = "curves"
    title = "Curves"
    needs = frozenset({"equilibrium"})
    plans = ("stiffness",)

    def build(self, packed):
        self.sizes: list[int] = []
        packed.source(self.name, "angle")
        return Spacer()

    def data(self, results):
        angles = results.equilibrium.cage_angles
        self.sizes.append(angles.size)
        return {self.name: {"angle": angles}}, {}

    def sentence(self, results):
        return "Curves."

    def table(self, results):
        return {"cage_angle_deg": np.degrees(results.equilibrium.cage_angles)}


def session(
    monkeypatch: pytest.MonkeyPatch, *acts: Callable[[Explorer], object]
) -> tuple[Explorer, list[str]]:
    """A session that rests after each act, and what its status line said, moving and at rest."""
    monkeypatch.setattr(
        "bearing_explorer.widgets.controls.Controls.show", lambda self, **news: None
    )
    monkeypatch.setattr(idle_task, "RESTS_AFTER", 0.01)
    said: list[str] = []

    async def live() -> Explorer:
        explorer = Explorer((Section("one", "One", (Curves,)),))
        explorer._idle_task._after = 0.02
        explorer.status.param.watch(lambda e: said.append(" · ".join(e.new["details"])), "line")
        for act in (Explorer.draw, *acts):
            said.append("")
            act(explorer)
            while not (explorer._worker.idle and explorer._idle_task.idle):
                await asyncio.sleep(0.002)
        return explorer

    return run(live()), said


def test_a_session_draws_at_once_and_by_plan_at_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    explorer, said = session(monkeypatch)
    assert len(said) == 3
    assert "121 cage angles" in said[1]
    made = plans(FAN_RIG, "stiffness", BUDGETS["stiffness"])
    assert made.sentence().replace("2 DOF", "2 DOF (x y)") in said[2]
    assert explorer._views["one"][0].sizes == [121, made.cage_angles.size]
    assert explorer.plan.state["plans"][0] == ["Stiffness", made.sentence()]


def test_what_is_planned_already_is_drawn_by_it_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    explorer, _ = session(
        monkeypatch,
        lambda e: e._asked({"mark": 1, "set": {"cage_angle_deg": 5.0}}),
        lambda e: e._asked({"mark": 2, "set": {"extent_deg": 20.0}}),
    )
    sizes = explorer._views["one"][0].sizes
    assert sizes[2] == sizes[1] != 121, "the cage turned: the plan stays"
    assert sizes[3] == 121, "another scene: at once, then by its plan"
    assert len(sizes) == 5


def test_a_session_is_overruled_and_gets_back(monkeypatch: pytest.MonkeyPatch) -> None:
    explorer, said = session(
        monkeypatch,
        lambda e: e._plan_asked({"cage_angles": "61"}),
        lambda e: e._plan_asked({"cage_angles": "a lot", "steady": 7}),
        lambda e: e._plan_asked("nonsense"),
        lambda e: e._plan_asked({"own": True}),
    )
    sizes = explorer._views["one"][0].sizes
    assert sizes[2:4] == [61, 61]
    assert sizes[-1] == sizes[1]
    assert any("cage angles set by hand: 61" in words for words in said)
    assert explorer.plan.state["by_hand"] == []
    assert "set by hand" not in said[-1]


def test_a_scene_that_cannot_be_planned_is_drawn_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(*_: object) -> None:
        raise ValueError("no plan")

    monkeypatch.setattr(Results, "plan_of", refuse)
    explorer, said = session(monkeypatch)
    assert explorer._views["one"][0].sizes == [121, 121]
    assert "121 cage angles" in said[-1]
