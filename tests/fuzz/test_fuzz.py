"""A small share of ``python -m tests.fuzz``, other inputs than those it begins with."""

from __future__ import annotations

import warnings

import pytest

from tests.fuzz.__main__ import meet
from tests.fuzz.targets import targets
from tests.helpers.loops import run


@pytest.mark.parametrize("name", [target.name for target in targets()])
def test_what_strangers_send_is_taken_or_refused_in_a_sentence(name: str) -> None:
    [target] = [target for target in targets() if target.name == name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run(meet(target, 10_000_000, 150))
    assert not target.found, "\n".join(target.found)
    assert target.refused + target.taken == 150
    assert target.refused or name in ("address", "messages")
