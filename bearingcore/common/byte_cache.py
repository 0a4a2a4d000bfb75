"""Results that are kept for when they are asked for again, but no more bytes of them than agreed.

`functools.lru_cache` counts results. Where one may be a hundred bytes and another sixteen
megabytes, a count is no bound on memory.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, ParamSpec, TypeVar, cast

P = ParamSpec("P")
Result = TypeVar("Result")


def lru_cache_by_bytes(
    most: int,
    most_bytes: int,
    size: Callable[..., int],
    key: Callable[..., Hashable] | None = None,
) -> Callable[[Callable[P, Result]], Callable[P, Result]]:
    """Keep what a function returns, by its arguments, the least recently used going first.

    Parameters
    ----------
    most
        results that are kept.
    most_bytes
        of all that is kept. What is larger than half of it is not kept at all.
    size
        bytes of a result and what it keeps alive: called with the result, then the arguments.
    key
        what a result belongs to, of the arguments; None: the arguments themselves, which are kept.
    """

    def decorate(function: Callable[P, Result]) -> Callable[P, Result]:
        held: OrderedDict[Hashable, tuple[int, Any]] = OrderedDict()
        lock = threading.Lock()
        total = 0

        @wraps(function)
        def cached(*arguments: P.args, **named: P.kwargs) -> Result:
            nonlocal total
            of = key(*arguments, **named) if key else (arguments, tuple(named.items()))
            with lock:
                if of in held:
                    held.move_to_end(of)
                    return cast(Result, held[of][1])
            result = function(*arguments, **named)
            bytes_ = size(result, *arguments, **named)
            if 2 * bytes_ > most_bytes:
                return result
            with lock:
                if of not in held:
                    held[of] = (bytes_, result)
                    total += bytes_
                while len(held) > most or total > most_bytes:
                    _, (gone, _) = held.popitem(last=False)
                    total -= gone
            return result

        return cached

    return decorate
