"""Work off the event loop."""

import threading

from bearing_explorer.results.executors import in_thread

from tests.helpers.loops import run


def test_work_in_a_thread_leaves_the_event_loop_free() -> None:

    async def where() -> tuple[str, str]:
        return threading.current_thread().name, await in_thread(
            lambda: threading.current_thread().name
        )

    here, there = run(where())
    assert here != there
    assert there.startswith("compute")
