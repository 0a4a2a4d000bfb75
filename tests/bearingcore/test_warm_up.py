"""What compiles the kernels beforehand compiles what is called afterwards, once."""

from __future__ import annotations

import pytest

from bearingcore import kernels, warm, warm_up


def signatures() -> dict[str, int]:
    """How many versions of each kernel are in memory."""
    found = {name: getattr(getattr(kernels, name), "signatures", ()) for name in dir(kernels)}
    return {name: len(versions) for name, versions in found.items()}


def test_the_helper_compiles_what_motions_call() -> None:
    told: list[str] = []
    warm(told.append)
    before = signatures()
    assert min(before[name] for name in ("march", "turn_smooth", "elastic_loads")) > 0
    warm_up.compile_motions()
    assert signatures() == before
    assert len(told) == 6
    assert all(line.startswith("compiled: ") for line in told)


def test_the_helper_finds_what_it_is_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where it cannot, all is compiled by one process, in twice the time and without a word."""
    asked: list[str] = []
    monkeypatch.setattr(warm_up, "start_python", lambda lines, *_: asked.append(lines))
    warm_up._start_helper()
    module, call = asked[0].split("; ")
    assert call == "compile_motions()"
    monkeypatch.undo()
    helper = warm_up.start_python(module)
    assert helper is not None
    helper.communicate()
    assert helper.returncode == 0


def test_the_helper_leaves_statics_to_the_other_process(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("compiled twice")

    monkeypatch.setattr(kernels, "static_states", refuse)
    monkeypatch.setattr(kernels, "static_maps", refuse)
    warm_up.compile_motions()
