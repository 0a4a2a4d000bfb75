"""``bearing-explorer``: compile and warm the kernels, then serve the page."""

from __future__ import annotations

import argparse
import gc
import os
import re
import signal
import sys
import time
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

# Set before numpy is loaded. The page has threads of its own. Threads of the linear algebra would
# compete with them over matrices of ten rows, and cost four times the time that they save.
for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

from bearing_explorer.kit.serve.log import LEVELS, begin  # noqa: E402

NOT_KEPT = (
    "Compiled kernels cannot be kept, because neither the program's folder nor the home can be "
    "written: each start compiles them again. Set NUMBA_CACHE_DIR to a folder that can be written."
)


READ_FROM_DISK = 5.0
"""Longest wait [s] at the start for machine code that is read from disk."""
LOADS_HOLOVIEWS = 10.0
"""Delay [s] after which HoloViews is loaded: the first picture is drawn, and no tab waits later."""


def options(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        prog="bearing-explorer",
        description="Serve the Bearing explorer: a page with a damaged ball bearing and sliders.",
    )
    parser.add_argument(
        "--port", type=_number(0, 65_535), default=5006, help="port to listen on (5006)"
    )
    parser.add_argument(
        "--address",
        default="localhost",
        help="address to listen on (localhost: this machine only; 0.0.0.0: all networks)",
    )
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser")
    parser.add_argument(
        "--allow-websocket-origin",
        action="append",
        type=_host,
        metavar="HOST[:PORT]",
        help="host name under which browsers reach the page, where it is not localhost; repeatable",
    )
    parser.add_argument(
        "--num-procs", type=_number(1, 99_999), default=1, help="processes that share the port (1)"
    )
    parser.add_argument(
        "--root-path",
        type=_matching(r"[\w.~/-]*", "a path of letters, digits, and the characters / . _ ~ -"),
        default="",
        help="path in front of the page behind a proxy, such as /lab",
    )
    parser.add_argument(
        "--frame-ancestor",
        action="append",
        type=_matching(
            r"(https?://)?[\w.*-]+(:(\d+|\*))?(/[\w.~/-]*)?",
            "an origin, such as https://lms.example.org",
        ),
        metavar="ORIGIN",
        help="another site that may show the page in a frame, such as https://lms.example.org; "
        "repeatable",
    )
    parser.add_argument(
        "--max-sessions",
        type=_number(1, 99_999),
        default=100,
        metavar="N",
        help="sessions at once in a process (100); later ones are asked to come back",
    )
    parser.add_argument(
        "--max-message-mb",
        type=_number(1, 99_999),
        default=4,
        metavar="N",
        help="megabytes that a browser may send in one message (4)",
    )
    parser.add_argument(
        "--idle-minutes",
        type=_number(1, 99_999),
        default=60,
        metavar="N",
        help="minutes after which an unused page is closed (60)",
    )
    parser.add_argument(
        "--log-level",
        choices=LEVELS,
        default="warning",
        help="info writes a line for each update, with session, scene, view and milliseconds",
    )
    parser.add_argument(
        "--lessons",
        type=Path,
        metavar="DIR",
        help="folder with lessons of your own (*.md), instead of those that come along",
    )
    return parser.parse_args(arguments)


def _number(at_least: int, at_most: int) -> Callable[[str], int]:
    """Return a function that reads a whole number between two limits."""

    def read(text: str) -> int:
        if not (text.isascii() and text.isdecimal() and at_least <= int(text[:9]) <= at_most):
            _refuse(text, f"a whole number from {at_least} to {at_most}")
        return int(text)

    return read


def _matching(pattern: str, allowed: str) -> Callable[[str], str]:
    """Return a function that takes a text only if all of it matches a pattern."""
    return lambda text: text if re.fullmatch(pattern, text, re.ASCII) else _refuse(text, allowed)


def _host(text: str) -> str:
    from bearing_explorer.kit.serve.hosts import origins_of

    try:
        origins_of(text)
    except ValueError:
        _refuse(text, "a host, such as lab.example.org:8443 or https://lab.example.org")
    return text


def _refuse(text: str, allowed: str) -> NoReturn:
    raise argparse.ArgumentTypeError(f"{text!r} cannot be used; allowed: {allowed}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code."""
    chosen = options(arguments)
    begin(chosen.log_level)
    started = time.perf_counter()
    _say("Bearing explorer starts.")
    _say("Loading the page ...")
    gc.disable()  # imports leave no garbage, and looking for it takes an eighth of the time
    try:
        from bearing_explorer.kit.compute import compiling
        from bearing_explorer.kit.serve.serving import Limits, freeze_startup_objects, make_server
        from bearing_explorer.page import lessons_of, page, scene
    except ModuleNotFoundError as error:
        _say(f"The page needs {error.name}, which is not installed: pip install .")
        return 1
    for lesson in lessons_of(chosen.lessons):  # cached, so the first page need not read them
        if isinstance(lesson, scene.Fault):
            _say(f"Lessons: {lesson.sentence}")
    from bearingcore import model, warm

    gc.freeze()
    gc.enable()
    compiled = scene is None or compiling.all_on_disk()
    if scene is not None and not model.kept_on_disk():
        _say(NOT_KEPT)
    if not compiled:
        _say("Compiling the kernels, once; pages show the default scene meanwhile ...")
    if scene is not None and chosen.num_procs > 1:  # compile before the fork: no thread survives it
        warm(report=_say)

    # With several processes, this one only waits inside `make_server` until the others end.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        server = make_server(
            page=lambda: page(chosen.lessons),
            port=chosen.port,
            address=chosen.address,
            origins=chosen.allow_websocket_origin or (),
            root_path=chosen.root_path,
            num_procs=chosen.num_procs,
            frame_ancestors=chosen.frame_ancestor or (),
            limits=Limits(
                sessions=chosen.max_sessions,
                message=chosen.max_message_mb * 2**20,
                idle=60.0 * chosen.idle_minutes,
            ),
        )
    except (OSError, UnicodeError) as error:
        why = getattr(error, "strerror", None) or error
        _say(f"Cannot listen on {chosen.address} port {chosen.port}: {why}.")
        return 1

    loop = server.io_loop

    def stop(number: int, _: object) -> None:
        _say(f"{signal.Signals(number).name}: stopping.")
        loop.add_callback_from_signal(loop.stop)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    if chosen.num_procs > 1:
        _end_with_parent(loop)
    shown = "localhost" if chosen.address in ("0.0.0.0", "::", "127.0.0.1") else chosen.address
    url = f"http://{shown}:{server.port}{server.prefix}/"

    if scene is None:
        loop.add_callback(freeze_startup_objects)
    else:
        scene.begin_compiling(
            report=_say if chosen.num_procs == 1 else str,
            done=lambda: loop.add_callback(freeze_startup_objects),
        )
        # a later start reads machine code from disk: wait for it, so that all pages can compute
        compiling.wait(READ_FROM_DISK if compiled else 0.0)
    server.start()
    _say(f"Ready after {time.perf_counter() - started:.1f} s: {url} (Ctrl+C ends)")
    if scene is not None:
        # not in another thread: Panel, building a page, would meet HoloViews half loaded
        loop.call_later(LOADS_HOLOVIEWS, import_module, "bearing_explorer.explorer.plots.plane")
    if not chosen.no_browser:
        loop.add_callback(lambda: server.show("/"))
    try:
        loop.start()
    finally:
        server.stop()
    _say("Stopped.")
    sys.stderr.flush()
    os._exit(0)  # Python would wait, perhaps for minutes, until all threads have computed


def _end_with_parent(loop: Any) -> None:
    """Stop this process when its parent is gone: a killed parent cannot stop its children."""
    from tornado.ioloop import PeriodicCallback

    parent = os.getppid()

    def look() -> None:
        if os.getppid() != parent:
            loop.stop()

    PeriodicCallback(look, 500).start()


def _say(text: str) -> None:
    encoding = sys.stdout.encoding or "utf-8"
    print(text.encode(encoding, "backslashreplace").decode(encoding), flush=True)  # odd file names


if __name__ == "__main__":
    sys.exit(main())
