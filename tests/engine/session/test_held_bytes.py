"""What the history says that its steps hold is what the interpreter has for them, about."""

import gc
import sys
from contextlib import closing
from types import BuiltinFunctionType, FunctionType, ModuleType
from weakref import ref

import numpy as np
from immutables import Map

from engine.brush.settings import Brush
from engine.keeping.spill import PLACE_OVERHEAD, Spill, Spilled
from engine.painting.commands import CopyPaint, DefineTexture, Redo, Stroke, Undo
from engine.session.coding import coded_records, made_again
from engine.session.session import Session
from engine.texture.image import ImageSource

_SHARED = type, ModuleType, FunctionType, BuiltinFunctionType, Spill


def found_from(root, seen):
    """Counts the bytes of all objects that one leads to and that were not seen yet."""
    size, todo = 0, [root]
    while todo:
        found = todo.pop()
        if id(found) in seen or isinstance(found, _SHARED):
            continue
        seen.add(id(found))
        size += PLACE_OVERHEAD if isinstance(found, Spilled) else sys.getsizeof(found)
        todo.extend(gc.get_referents(found))
    return size


def painted(count):
    """Strokes, each somewhere else."""
    session, random = Session(), np.random.default_rng(3)
    for n in range(count):
        points = np.ones((4, 6))
        points[:, :2] = np.cumsum(random.uniform(-4, 4, (4, 2)), axis=0)
        live = session.begin(0, (60 + 128 * (n % 7), 60 + 128 * (n // 7)), Brush(radius=4.0, hardness=0.7))
        live.add(points)
        session.finish(live)
    return session


def part_counted(session):
    made_again.forget_made(1 << 40)
    seen = set()
    for kept in (session.painting, session.log, session.cache):
        found_from(kept, seen)
    return session.history.held / found_from(session.history, seen)


def test_the_bytes_that_steps_hold_are_counted(monkeypatch, tmp_path):
    """As they are, coded, and on disk."""
    with closing(Spill(tmp_path)) as spill:
        monkeypatch.setattr(coded_records, "spill", lambda: spill)
        session = painted(20)
        line = session.history._done
        assert 0.8 < part_counted(session) < 1.25
        while line.plain:
            line.code()
        assert 0.8 < part_counted(session) < 1.25
        while line.in_memory:
            line.put_away()
        assert spill.held > 0
        assert 0.8 < part_counted(session) < 1.25


POINTS = np.array([[30.0, 30, 1, 0, 0, 0], [60, 30, 1, 0, 0, 0]])


def test_steps_do_not_hold_what_is_no_step():
    """Pictures of textures that were defined anew, and what was copied."""
    session, random = Session(), np.random.default_rng(4)
    held = []
    for _ in range(3):
        planes = np.ones((4, 9, 9), np.float32)
        planes[:3] = np.float32(1 / 256) * random.integers(0, 256, (9, 9))
        source = ImageSource.of("grit", planes)
        held.append(ref(source.pixels))
        session.do(DefineTexture("grit", "image", Map(path="p", sha=source.sha)), source)
        session.do(Stroke(0, (0, 0), POINTS, Brush(radius=4.0)))
        session.do(CopyPaint(session.painting.active))
        del planes, source
    gc.collect()
    assert [pixels() is None for pixels in held] == [True, True, False]
    now = session.painting
    session.do(Undo(3))
    session.do(Redo(2))
    assert (session.painting.textures, session.painting.copied) == (now.textures, now.copied)
