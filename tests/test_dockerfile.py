"""The image without an engine: what can be held of its steps against the tree.

`.ci/run` follows them further: it installs from a folder that holds no more than is copied, serves
from there, and asks the health check. Never tried here: the base image, and building the image.
"""

import json
import re
from pathlib import Path

from bearing_explorer.__main__ import options

ROOT = Path(__file__).resolve().parents[1]
TEXT = (ROOT / "Dockerfile").read_text(encoding="utf-8")
STEPS = [
    line.split(None, 1)
    for line in re.sub(r"\\\n\s*", " ", TEXT).splitlines()
    if line and not line.startswith("#")
]


def steps(kind: str) -> list[str]:
    return [rest for name, rest in STEPS if name == kind]


def test_every_stage_starts_from_a_slim_image_of_a_python_it_allows() -> None:
    bases = [rest.split()[0] for rest in steps("FROM")]
    assert len(bases) == 2
    assert bases[0] == bases[1]
    assert re.fullmatch(r"python:3\.1[1-3]\.\d+-slim-\w+", bases[0]), (
        "a version, not what is newest"
    )


def test_what_is_copied_is_there_and_is_all_that_the_package_is_made_of() -> None:
    copied = [name for rest in steps("COPY") if "--from" not in rest for name in rest.split()[:-1]]
    for name in copied:
        assert (ROOT / name).exists(), name
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    packages = re.search(r"packages = \[(.*)\]", project)
    included = re.search(r"force-include\]\n\"(\w+)\"", project)
    assert packages is not None
    assert included is not None
    for name in (*re.findall(r'"(\w+)', packages[1]), included[1], "LICENSE", "README.md"):
        assert name in copied, name


def test_it_runs_without_rights_on_a_program_and_kernels_of_root() -> None:
    kinds = [name for name, _ in STEPS]
    last_user = max(i for i, name in enumerate(kinds) if name == "USER")
    assert STEPS[last_user][1] not in ("root", "0")
    assert kinds[last_user + 1 :].count("RUN") == kinds[last_user + 1 :].count("COPY") == 0
    assert "ENTRYPOINT" in kinds[last_user:]
    assert not re.search(r"chown|chmod", TEXT)
    [compiled] = [rest for name, rest in STEPS if name == "RUN" and "warm()" in rest]
    [build] = [rest for name, rest in STEPS if name == "RUN" and "pip install" in rest]
    assert '".[files]"' in build, "or it opens fewer kinds of files than the page says"
    cache = re.search(r"NUMBA_CACHE_DIR=(\S+)", " ".join(steps("ENV")))
    assert cache is not None
    assert f"NUMBA_CACHE_DIR={cache[1]} " in compiled
    [handed_on] = [rest for rest in steps("COPY") if "--from" in rest]
    source, target = handed_on.split()[-2:]
    assert source == target, "kernels are looked up by where their sources stand"
    assert cache[1].startswith(target + "/")


def test_what_it_starts_understands_its_options() -> None:
    command = json.loads(steps("ENTRYPOINT")[0])
    assert command[0] == "bearing-explorer"
    chosen = options(command[1:])
    assert chosen.address == "0.0.0.0"
    assert str(chosen.port) in steps("EXPOSE")[0]
    assert chosen.no_browser


def test_its_health_is_asked_where_the_server_answers() -> None:
    [check] = steps("HEALTHCHECK")
    command = json.loads(check.split("CMD", 1)[1])
    assert "http://localhost:5006/liveness" in " ".join(command)
    [allowed] = re.findall(r"--timeout=(\d+)s", check)
    [waits] = re.findall(r"timeout=(\d+)\)", " ".join(command))
    assert 5 < int(waits) < int(allowed), (
        "above the longest pauses, and less than the check may take"
    )
