"""Work that is cut in parts, one for each core: parts that do not hang on one another, so the results are the same.

For kernels, which let other threads run.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from itertools import pairwise

_MOST = 8  # parts
_LEAST = 1 << 18  # values of a part: fewer are sooner done than given away


def in_parts(work: Callable[[int, int], None], count: int, values: int, step: int = 1) -> None:
    """Calls `work` for the numbers from 0 to `count`, in parts [first, last) whose ends are multiples of `step`;
    `values`: how many there are to work on in all.  A part that no other thread has begun is done by this one, so
    parts may be cut in parts again."""
    parts = max(1, min(os.cpu_count() or 1, _MOST, values // _LEAST, -(-count // step)))
    edges = [min(k * count // parts // step * step, count) for k in range(parts)] + [count]
    given = [(_pool().submit(work, first, last), first, last) for first, last in pairwise(edges[1:]) if first < last]
    try:
        work(edges[0], edges[1])
    finally:
        left = [(first, last) for future, first, last in given if future.cancel()]
        done = [future.exception() for future, _, _ in given if not future.cancelled()]
    for first, last in left:
        work(first, last)
    for fault in done:
        if fault is not None:
            raise fault


@lru_cache(maxsize=1)
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(max(1, min(os.cpu_count() or 1, _MOST) - 1), "inkfall parts")
