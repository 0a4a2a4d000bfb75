"""Messages to a browser."""

from bearing_explorer.server.live import one_message, send_at_once

from tests.helpers.loops import run


def test_without_a_session_there_is_nothing_to_send_to() -> None:
    assert send_at_once(None) == 0
    changes: list[int] = []
    run(one_message(None, lambda: changes.append(1)))
    assert changes == [1]
