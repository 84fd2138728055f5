"""Measuring times on a machine with noisy neighbours: in turns, and the best of several."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

Work = Callable[[], object]
FRAME = 1920 * 1080 * 4 * 4  # bytes of a picture of RGBA float32
FRAME_COPY = 1.4e-3  # seconds that copying it took where the other programs were measured (median of 1.2 to 1.6)


def seconds(work: Work) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def processor(work: Work) -> float:
    """Seconds of the processor's time that a work takes."""
    start = time.process_time()
    work()
    return time.process_time() - start


def best(repeats: int, *works: Work) -> list[float]:
    """The shortest time of each work, in seconds; they take turns, so that all meet the same neighbours."""
    for work in works:
        work()  # compiles, and touches the memory
    times = [[seconds(work) for work in works] for _ in range(repeats)]
    return [min(column) for column in zip(*times, strict=True)]


def copying(moved: int) -> Work:
    """Copies so many bytes that reading and writing them moves `moved`."""
    source = np.ones(max(1, moved // 8), np.float32)  # written once: unwritten pages would all be one page of zeros
    target = np.ones_like(source)
    return lambda: np.copyto(target, source)


def slowness(repeats: int = 25) -> float:
    """How many times longer copying takes now than where the other programs were measured."""
    return best(repeats, copying(2 * FRAME))[0] / FRAME_COPY


def second_core(repeats: int = 5) -> float:
    """How many times as fast two threads do plain work as one: 2 where a second core is free."""
    values = np.linspace(0.0, 1.0, 1 << 20)
    out = np.empty((2, values.size))
    with ThreadPoolExecutor(2) as pool:
        one, two = best(
            repeats,
            lambda: [np.sin(values, out=row) for row in out],
            lambda: list(pool.map(lambda row: np.sin(values, out=row), out)),
        )
    return one / two
