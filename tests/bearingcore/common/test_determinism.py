"""Equal scenes give equal results, bit for bit: in one thread or two, in whichever process."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.helpers.prints import ANSWERS, print_of


@pytest.fixture(scope="module")
def first() -> dict[str, str]:
    """All, one after the other."""
    return {name: print_of(name) for name in ANSWERS}


@pytest.mark.proof
def test_the_same_again_in_two_threads(first: dict[str, str]) -> None:
    names = [*ANSWERS, *reversed(ANSWERS)]  # others beside each the second time
    with ThreadPoolExecutor(2) as threads:
        again = list(zip(names, threads.map(print_of, names), strict=True))
    assert [(name, first[name]) for name in names] == again


@pytest.mark.proof
def test_the_same_in_another_process(first: dict[str, str]) -> None:
    """Another order of hashes and of everything in memory."""
    ask = (
        "from tests.helpers.prints import ANSWERS, print_of\n"
        "for name in reversed(ANSWERS): print(name, print_of(name), sep='=')"
    )
    said = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True)
    other = dict(line.rsplit("=", 1) for line in said.stdout.splitlines())
    assert other == first
