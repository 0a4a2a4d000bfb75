"""The command line: what it refuses, in a line and before anything is loaded."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from bearing_explorer.__main__ import options


@pytest.mark.parametrize(
    ("option", "texts"),
    [
        ("--port", ("99999", "-1", "", "x", "5006.0", "५")),
        ("--num-procs", ("0", "-3", "two")),
        ("--max-sessions", ("0", "many", "1" * 5000)),
        ("--root-path", ("(", "/lab(.*)", "/a b", "/a?b", "/ä", "/a\n")),
        (
            "--allow-websocket-origin",
            ("", "http://a:b:c", "a b", "ftp://a", "a/b", "u@a", "a:99999", "*"),
        ),
        ("--frame-ancestor", ("", "https://a\r\nX-Mine: 1", "a; script-src *", "a b", "a,b")),
    ],
)
def test_a_bad_value_is_refused_with_what_is_allowed(
    option: str, texts: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    for text in texts:
        with pytest.raises(SystemExit) as refused:
            options([f"{option}={text}"])
        assert refused.value.code == 2
        said = capsys.readouterr().err.splitlines()[-1]
        assert re.search(f"argument {option}: '.*' cannot be used; allowed: ", said), text


def test_good_values_are_taken() -> None:
    line = (
        "--port=0 --root-path=/lab/bearing-1 --num-procs=2 --max-sessions=5 "
        "--allow-websocket-origin=lab.example.org:8443 --allow-websocket-origin=https://[::1] "
        "--frame-ancestor=https://*.example.org:8443 --frame-ancestor=example.org/course"
    )
    chosen = options(line.split())
    assert chosen.port == 0
    assert chosen.allow_websocket_origin == ["lab.example.org:8443", "https://[::1]"]
    assert len(chosen.frame_ancestor) == 2


def test_what_cannot_be_listened_on_or_read_is_said_without_a_traceback(tmp_path: Path) -> None:
    lessons = tmp_path / "lessons\udcff"
    lessons.mkdir()
    (lessons / "\udcfe.md").write_bytes(b"\xff")
    arguments = ["--address", "x" * 70, "--lessons", str(lessons), "--no-browser"]
    command = [sys.executable, "-m", "bearing_explorer", *arguments]
    told = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert told.returncode == 1
    assert "Cannot listen on xxx" in told.stdout
    assert "this is not text in UTF-8" in told.stdout
    assert "Traceback" not in told.stdout + told.stderr
