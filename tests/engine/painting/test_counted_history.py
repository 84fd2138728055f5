"""The history counts what leads to its steps alone: whatever was coded, copied, undone and done again."""

import random

import pytest
from stepped import ROCK, stroke

from engine.canvas import layers
from engine.canvas.node_checks import LayerError
from engine.canvas.store import RECORD_OVERHEAD
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting, Refusal
from engine.session.line import STEP_OVERHEAD
from engine.session.session import Session
from engine.texture.sparse_planes import SparsePlanes


def parts_of(root):
    """The bytes of all that the layers hold, each part once."""
    found = {}
    for pyramid in (layer.pyramid for layer in layers.layers(root)):
        found.update((id(waits), waits.nbytes) for waits in pyramid.waiting())
        for _, record in pyramid.all_records():
            planes = isinstance(record.held, SparsePlanes)
            found[id(record)] = RECORD_OVERHEAD if planes else record.nbytes
            found.update((id(sheet), sheet.nbytes) for sheet in (record.held._sheets if planes else ()))
    return found


def found(session):
    """The bytes of what the steps hold and the present does not."""
    steps, now = session.history.steps, parts_of(session.painting.root)
    far = [step.before.root for step in steps.done] + [step.after.root for step in steps.undone]
    there = {part: size for root in far for part, size in parts_of(root).items()}
    return sum(size for part, size in there.items() if part not in now)


def said(session):
    history = session.history
    return history.held - STEP_OVERHEAD * (history.undo_count + history.redo_count)


def coded(session, pieces):
    """Some of what is done while nobody paints, and as much again of steps that are at hand."""
    for _ in range(pieces):
        if session.history.pending:
            session.history.step()
        if session.history._done.plain:
            session.history._done.code(1)


def acted(session, chance, number):
    """One thing that somebody does, or that is done meanwhile."""
    kind = chance.choices("supcrk", (10, 2, 2, 1, 1, 4))[0]
    if kind == "s":
        marks = chance.choice([(), ROCK])
        act = stroke(chance.randrange(10), chance.randint(-2, 2), chance.choice([2.0, 9.0, 30.0]), marks)
    elif kind in "up":
        act = (c.Undo if kind == "u" else c.Redo)(chance.randint(1, 6))
    elif kind == "c":
        act = c.DuplicateLayer("Layer 1", f"Copy {number}")
    elif kind == "r":
        act = c.RemoveLayer(chance.choice([layer.name for layer in layers.layers(session.painting.root)][1:] or ["?"]))
    else:
        coded(session, chance.choice([1, 5, 1000]))
        return
    session.do(act)


@pytest.mark.parametrize("tight", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_the_bytes_said_are_those_found(seed, tight):
    chance, session = random.Random(seed), Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    session.history.tight = tight
    if tight:
        session.history._limit = 1 << 14
    for number in range(25):
        try:
            acted(session, chance, number)
        except (LayerError, Refusal):
            continue  # nothing there to undo, or to remove
        assert said(session) == pytest.approx(found(session), rel=0.03, abs=600)


def test_what_a_copy_of_a_layer_shares_counts_when_both_have_lost_it():
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    session.do(stroke(1, radius=30.0))
    session.do(c.DuplicateLayer("Layer 1", "Copy"))
    for act in (stroke(2, radius=30.0), c.RemoveLayer("Copy"), c.Undo(2), c.Redo(2)):
        session.do(act)
        assert said(session) == pytest.approx(found(session), rel=0.03)
