"""Squares of what is drawn are drawn once: what took long outlasts its turn in memory, on disk."""

import numpy as np
import pytest

from engine.keeping import spill as spill_module
from engine.keeping.spill import Spill
from engine.numeric.address import TILE, Rect
from engine.texture.expression import kept_squares as module

SQUARE = Rect.at(0, 0, TILE, TILE)
BYTES = 4 * TILE * TILE


@pytest.fixture
def disk(tmp_path):
    made = Spill(tmp_path)
    yield made
    made.close()


@pytest.fixture
def squares(monkeypatch, disk):
    """Three fit in memory, and five on disk; all of them took long."""
    monkeypatch.setattr(module, "_KEPT", 3 * BYTES)
    monkeypatch.setattr(module, "_AWAY", 5 * BYTES)
    monkeypatch.setattr(module, "_DEAR", 0.0)
    made = module.KeptSquares()
    made.put = disk.put
    monkeypatch.setattr(module, "SQUARES", made)
    return made


@pytest.fixture
def draw():
    """Tells in `asked` what it was asked for."""

    def drawn(name, rect):
        drawn.asked.append((name, rect))
        down, across = np.mgrid[rect.y0 : rect.y1, rect.x0 : rect.x1]
        return (name + down / 7.0 + across / 3.0).astype(np.float32)[None]

    drawn.asked = []
    return drawn


def test_what_left_memory_comes_from_disk_with_the_same_bits(squares, draw, disk):
    first = [module.from_squares(draw, (name,), 1, SQUARE).tobytes() for name in range(5)]
    assert [module.from_squares(draw, (name,), 1, SQUARE).tobytes() for name in range(5)] == first
    assert len(draw.asked) == 5
    for name in range(5, 25):
        module.from_squares(draw, (name,), 1, SQUARE)
    assert squares.held == 3 * BYTES
    assert disk.length <= 7 * BYTES  # what is lost makes room for what comes


def test_a_strip_beside_what_is_known_is_not_drawn_anew(squares, draw):
    whole = module.from_squares(draw, (0,), 1, SQUARE)
    strip = Rect.at(5, 3, TILE - 5, 1)
    assert module.from_squares(draw, (0,), 1, strip).tobytes() == whole[:, 3:4, 5:].tobytes()
    assert len(draw.asked) == 1
    module.from_squares(draw, (1,), 1, strip)
    assert draw.asked[-1] == (1, strip)  # of what is not known only that


@pytest.mark.parametrize("fault", ["no disk", "cheap", "full", "torn"])
def test_what_is_not_on_disk_is_drawn_again(squares, draw, disk, monkeypatch, fault):
    if fault == "no disk":
        squares.put = None
    elif fault == "cheap":
        monkeypatch.setattr(module, "_DEAR", 1e9)
    elif fault == "full":
        monkeypatch.setattr(spill_module, "_SPARE", 1 << 62)
        squares.put = disk.put_spare
    whole = [module.from_squares(draw, (name,), 1, SQUARE) for name in range(4)]
    if fault == "torn":
        monkeypatch.setattr(disk, "piece", lambda at, size: bytes(size))
    assert module.from_squares(draw, (0,), 1, SQUARE).tobytes() == whole[0].tobytes()
    assert len(draw.asked) == 5
