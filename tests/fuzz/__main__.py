"""``python -m tests.fuzz``: 100,000 inputs for each parser, 2,000 for the running server."""

from __future__ import annotations

import argparse
import asyncio
import sys
import time
import warnings

import bearingcore
from tests.fuzz.server import attack
from tests.fuzz.targets import Target, targets


async def meet(target: Target, first: int, inputs: int) -> None:
    """With a loop running, as there is one where messages arrive."""
    for number in range(first, first + inputs):
        target.run(number)
        if number % 200 == 0:
            await asyncio.sleep(0)
    for task in asyncio.all_tasks() - {asyncio.current_task()}:
        task.cancel()


def main() -> int:
    """Try, print what came of it, and say with the exit code whether something was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=100_000, help="for each parser")
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("--server", type=int, default=2_000, help="inputs for the running server")
    parser.add_argument("--only", nargs="*", help="names of parsers; `server` is one of them")
    chosen = parser.parse_args()
    warnings.simplefilter("ignore")
    bearingcore.warm(report=lambda _: None)  # or the first picture waits for the compiler
    found: list[str] = []
    print(f"{'':<10}{'inputs':>9}{'taken':>9}{'refused':>9}{'slowest':>11}{'found':>7}{'':>8}")
    for target in targets():
        if chosen.only and target.name not in chosen.only:
            continue
        began = time.perf_counter()
        asyncio.run(meet(target, chosen.first, chosen.inputs))
        print(
            f"{target.name:<10}{chosen.inputs:>9}{target.taken:>9}{target.refused:>9}"
            f"{1e3 * target.slowest:>8.0f} ms{len(target.found):>7}"
            f"{time.perf_counter() - began:>6.0f} s",
            flush=True,
        )
        found += target.found
    if chosen.server and (not chosen.only or "server" in chosen.only):
        found += asyncio.run(attack(chosen.server))
    for one in found:
        print(one)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
