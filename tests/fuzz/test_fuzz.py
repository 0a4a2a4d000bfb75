"""Broken inputs: ``FUZZ_INPUTS=100000 pytest -n 0 -m proof tests/fuzz/test_fuzz.py``."""

import os
import random
import time
import warnings

import pytest

from tests.fuzz.targets import targets, unclear
from tests.helpers.reading import read_in_this_process

INPUTS = int(os.environ.get("FUZZ_INPUTS", "150"))
LONGEST = 3.0  # [s] of processor time that one input may take


@pytest.mark.parametrize("name", targets())
@pytest.mark.proof
def test_broken_inputs_are_taken_or_refused_in_a_sentence(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a library that a file may crash is given its own process, and takes fewer
    inputs = INPUTS // 7 if name == "mat" else INPUTS
    if name != "mat":
        read_in_this_process(monkeypatch)
    make, meet = targets()[name]
    refusals = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for number in range(10_000_000, 10_000_000 + inputs):
            broken = make(random.Random(f"{name} {number}"))
            began = time.process_time()
            try:
                meet(broken)
            except ValueError as error:
                refusals.append(f"{error}")
            except Exception as error:
                error.add_note(f"input {number}: {broken!r}"[:300])
                raise
            assert time.process_time() - began < LONGEST, number
    assert refusals
    assert [words for words in refusals if unclear(words)] == []
