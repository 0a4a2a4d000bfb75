"""The explorer with a watch on its event loop, started for somebody who measures."""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.browser.helpers import Server, free_port


def watched_server() -> tuple[Server, Callable[[], dict[str, Any]]]:
    """A server that is not started yet, and what tells of its event loop and then forgets it.

    It is told anew once a second, see `tests.fuzz.watched_server`.
    """
    report = Path(tempfile.mkstemp(suffix=".json")[1])
    port = free_port()
    command = [sys.executable, "-m", "tests.fuzz.watched_server", str(report)]
    server = Server([*command, "--port", str(port), "--no-browser"], port)

    def told() -> dict[str, Any]:
        found: dict[str, Any] = json.loads(report.read_text(encoding="utf-8"))
        report.unlink()
        return found

    return server, told
