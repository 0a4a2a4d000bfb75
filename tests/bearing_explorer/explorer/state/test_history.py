"""Steps back and forth, by hand and against a plain list."""

from bearing_explorer.explorer.state.history import History
from hypothesis import given, strategies as st


def test_what_ends_where_it_began_is_no_step() -> None:
    history = History(0)
    history.moved(1, "extent")
    history.moved(0, "extent")
    assert not history.can_undo
    history.settle()
    history.step(0)
    assert history.undo() is None


def test_only_so_many_steps_are_kept() -> None:
    history = History(0, most=3)
    for now in range(1, 10):
        history.step(now)
    assert [history.undo() for _ in range(4)] == [8, 7, 6, None]


@given(st.lists(st.one_of(st.integers(0, 3), st.sampled_from(["undo", "redo"])), max_size=40))
def test_as_a_list_and_a_place_in_it(acts: list) -> None:
    history, states, at = History(0), [0], 0
    for act in acts:
        if act == "undo":
            entry = history.undo()
            assert entry == (states[at - 1] if at else None)
            at = max(at - 1, 0)
        elif act == "redo":
            entry = history.redo()
            assert entry == (states[at + 1] if at + 1 < len(states) else None)
            at = min(at + 1, len(states) - 1)
        else:
            history.step(act)
            if act != states[at]:
                states[at + 1 :] = [act]
                at += 1
        assert (history.can_undo, history.can_redo) == (at > 0, at + 1 < len(states))
