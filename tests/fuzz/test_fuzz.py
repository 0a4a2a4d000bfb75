"""Broken inputs: ``FUZZ_INPUTS=100000 pytest -n 0 -m proof tests/fuzz/test_fuzz.py``."""

import os
import warnings

import pytest

from tests.fuzz.targets import targets
from tests.helpers.reading import read_in_this_process

INPUTS = int(os.environ.get("FUZZ_INPUTS", "150"))


@pytest.mark.parametrize("name", [target.name for target in targets()])
@pytest.mark.proof
def test_broken_inputs_are_taken_or_refused_in_a_sentence(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a library that a file may crash is given its own process, and takes fewer
    inputs = INPUTS // 7 if name == "mat" else INPUTS
    if name != "mat":
        read_in_this_process(monkeypatch)
    [target] = [target for target in targets() if target.name == name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for number in range(10_000_000, 10_000_000 + inputs):
            target.run(number)
    assert not target.faults, "\n".join(target.faults)
    assert target.refused + target.taken == inputs
    assert target.refused or name == "address"
