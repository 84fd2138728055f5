"""Freed pages: kept for the next array while there is room, given back with each large one where there is little."""

import ctypes
import sys

import numpy as np
import pytest

from engine import spare_memory
from engine.canvas.tile_cache import TileCache
from engine.keeping import memory
from engine.painting.value import Painting
from engine.session.history import History
from engine.session.room import Room

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="of glibc")
NAMES = "heaps", "free", "small", "maps", "mapped", "most", "fast", "used", "left", "top"
SIZE = 20 << 20  # bytes that are never written to


class Blocks(ctypes.Structure):
    _fields_ = tuple((name, ctypes.c_size_t) for name in NAMES)


def told():
    """What the C library tells: of its blocks, `mapped` are bytes of those mapped by themselves, which go back when
    they are freed, `left` those that are free."""
    asked = ctypes.CDLL(None).mallinfo2
    asked.restype = Blocks
    return asked()


@pytest.fixture(autouse=True)
def as_before():
    yield
    spare_memory(False)


def goes_back():
    """Whether large arrays are mapped by themselves."""
    before = told()
    arrays = [np.empty(SIZE, np.uint8) for _ in range(before.left // SIZE + 3)]  # more than fit what is free already
    grown = told().mapped - before.mapped
    del arrays
    assert told().mapped == before.mapped
    return grown >= SIZE


def test_large_arrays_are_mapped_by_themselves_where_memory_is_spared():
    for sparing in (False, True, True, False):
        spare_memory(sparing)
        assert goes_back() == sparing


def test_it_is_spared_from_three_quarters_of_what_the_process_may_take_until_half(monkeypatch):
    room, root = Room(TileCache(1 << 20), History()), Painting().root
    monkeypatch.setattr("engine.session.room._most", lambda: 100 << 20)
    for held, sparing in ((70, False), (80, True), (60, True), (40, False), (60, False), (120, True)):
        monkeypatch.setattr(memory, "resident", lambda held=held: held << 20)
        monkeypatch.setattr(memory, "peak", lambda held=held: held << 20)  # nothing came and went
        room.keep_within(root)
        assert goes_back() == sparing, held
