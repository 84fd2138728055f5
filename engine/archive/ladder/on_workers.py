"""What a worker of a cluster does: it opens the painting once, and writes block after block of a ladder.

A block is the same whoever writes it, however often; its files are renamed into their places.
"""

from __future__ import annotations

import asyncio
import os
import socket
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from engine.archive.export import Picture, lighting_of, shown_root
from engine.archive.ladder.blocks import Source
from engine.archive.ladder.ladder_files import FOLDERS
from engine.archive.ladder.rungs import Block, Ladder
from engine.archive.opening import open_painting
from engine.files.fault import Cancelled, WriteError
from engine.kernel_cache import stamp
from engine.light.light import Light

_HELD = 2  # paintings that a worker keeps open
_ENDING = 60.0  # seconds in which a block that is given up ends, at the latest
_NAP = 0.02


@dataclass(frozen=True, slots=True)
class Order:
    """What is to be written: a ladder of one layer, or of all, in the place `target`, of a format by its `ending`.

    `number`: none other has it; `version`: of the program that gave the order; `light`, `transparent`: of the picture.
    """

    number: str
    ladder: Ladder
    layer: str | None
    target: str
    ending: str
    version: str
    light: Light | None = None
    transparent: bool = False


def version() -> str:
    """Returns a hash of all of the program that makes pixels."""
    return stamp(Path(__file__))


class _State:
    """What a worker's process knows: sources by the numbers of orders, the blocks in work, the orders given up."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.opening = threading.Lock()
        self.sources: dict[str, Source] = {}
        self.working: Counter[str] = Counter()
        self.ended: set[str] = set()


_state = _State()


def write_block(block: Block, order: Order, painting: bytes) -> int:
    """Writes one block of an order, `painting` being the bytes of its file; returns the pixels of the block.

    WriteError if this worker cannot; Cancelled if the order was given up.
    """
    with _at_work(order.number):
        source = _source(order, painting)
        form = FOLDERS[order.ending]
        pixels = source.pixels(block.rung, form.reach(order.ladder, block), lambda: order.number in _state.ended)
        form.put(Path(order.target), order.ladder, block, pixels)
    return block.rect.area


async def end_order(number: str) -> None:
    """Returns when nothing of an order is being written here, nor will be; or a minute later."""
    _state.ended.add(number)
    latest = time.monotonic() + _ENDING
    while _state.working[number] and time.monotonic() < latest:
        await asyncio.sleep(_NAP)
    _state.sources.pop(number, None)


@contextmanager
def _at_work(number: str) -> Iterator[None]:
    with _state.lock:
        if number in _state.ended:
            raise Cancelled
        _state.working[number] += 1
    try:
        yield
    finally:
        with _state.lock:
            _state.working[number] -= 1


def _source(order: Order, painting: bytes) -> Source:
    """Returns what pixels are taken from, opened by the first block that comes here; its kernels are ready, too."""
    with _state.opening:
        found = _state.sources.get(order.number)
        if found is None:
            _check(order)
            while len(_state.sources) >= _HELD:
                _state.sources.pop(next(iter(_state.sources)), None)
            found = _opened(order, painting)
            found.prepare()
            _state.sources[order.number] = found
        return found


def _check(order: Order) -> None:
    """Raises WriteError if what is written here would lie elsewhere, or look otherwise."""
    here = socket.gethostname()
    if order.version != version():
        raise WriteError(order.target, f"found another version of Inkfall on the worker {here}, expected the same one")
    if not os.path.exists(order.target):
        raise WriteError(order.target, f"not seen by the worker {here}, expected a folder that all workers share")


def _opened(order: Order, painting: bytes) -> Source:
    with tempfile.TemporaryDirectory(prefix="inkfall-") as folder:
        path = Path(folder) / "painting.ora"
        path.write_bytes(painting)
        found = open_painting(path).painting
    picture = Picture(found, layer=order.layer, transparent=order.transparent, light=order.light)
    return Source(shown_root(picture), order.ladder, lighting_of(picture))
