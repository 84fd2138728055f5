"""Thick paint and painted masks are counted, made smaller and put away as all paint is, and are what they were."""

import numpy as np
import pytest
from stepped import contents, stroke, thick

from engine.canvas import layers
from engine.canvas.tile_cache import TileCache
from engine.keeping.spill import Spill
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session import old_commits, paging
from engine.session.coding import coded_records, made_again, paged_records
from engine.session.coding.coded_records import CodedData
from engine.session.differing import difference
from engine.session.held_pyramids import pyramids
from engine.session.line import counted
from engine.session.paging import Paging
from engine.session.session import Session
from engine.studio.held.holding import held_by

FULL = c.parse({"do": "layer", "set": "Layer 1", "mask": {"op": "full"}})


def on_mask(n):
    points = [[9.0 * n, 10.0], [50.0, 7.0 * n]]
    told = {"do": "stroke", "layer": "Layer 1", "points": points, "brush": {"radius": 9}, "onto": "mask"}
    return c.parse(told)


COMMANDS = (stroke(0), thick(1), thick(2), FULL, on_mask(1), on_mask(2), thick(3), thick(0, "erase"), on_mask(3))


@pytest.fixture
def disk(tmp_path, monkeypatch):
    spill = Spill(tmp_path)
    for module in (coded_records, paged_records):
        monkeypatch.setattr(module, "spill", lambda: spill)
    yield spill
    spill.close()


def painted(commands=COMMANDS):
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for command in commands:
        session.do(command)
    return session


def kept(root):
    """All pyramids of a state of the layers."""
    found = list(layers.layers(root))
    masks = [layer.mask.pyramid for layer in found if layer.mask is not None]
    return [layer.pyramid for layer in found] + [heap for layer in found for heap in layer.heaps.values()] + masks


def records(painting):
    """All records of a painting."""
    return [record for pyramid in kept(painting.root) for _, record in pyramid.all_records()]


def beside_paint(painting):
    """Records of heaps and masks."""
    paint = {id(record) for layer in layers.layers(painting.root) for _, record in layer.pyramid.all_records()}
    return [record for record in records(painting) if id(record) not in paint]


def test_what_is_heaped_and_masked_is_counted():
    session = painted()
    (layer,) = layers.layers(session.painting.root)
    stored = kept(session.painting.root)
    assert len(stored) > 2
    assert set(map(id, stored)) == set(map(id, pyramids(session.painting.root).values()))
    assert dict(held_by(session))["Painting"] == sum(pyramid.nbytes for pyramid in stored)
    assert layer.pyramid.nbytes < 0.8 * sum(pyramid.nbytes for pyramid in stored)


def test_a_step_holds_the_heaps_and_masks_that_it_changed():
    session = painted()
    for step in map(counted, session.history.steps.done):  # since it was done, what it left was made smaller
        before, after = (set(map(id, records(end))) for end in (step.before, step.after))
        lost = sum(record.nbytes for record in records(step.before) if id(record) not in after)
        gained = sum(record.nbytes for record in records(step.after) if id(record) not in before)
        waits = [[w.nbytes for one in kept(end.root) for w in one.waiting()] for end in (step.before, step.after)]
        assert lost <= step.lost <= lost + sum(waits[0])
        assert gained <= step.gained <= gained + sum(waits[1])
    assert difference(session.painting.root, layers.EMPTY)[0] >= sum(
        record.nbytes for record in records(session.painting)
    )


@pytest.mark.usefixtures("disk")
def test_steps_of_heaps_and_masks_are_coded_put_away_and_undone_as_they_were():
    session = painted(())
    states = [contents(session.painting)]
    for command in COMMANDS:
        session.do(command)
        states.append(contents(session.painting))
    line = session.history._done
    old = [record for step in session.history.steps.done[:-2] for record in beside_paint(step.before)]
    gone = [record for record in old if not any(record is one for one in records(session.painting))]
    while line.plain:
        line.code()
    assert gone
    large = [record for record in gone if record.data.nbytes > 4096]
    assert large
    assert any(isinstance(record.held, CodedData) for record in large)
    while line.in_memory:
        line.put_away()
    made_again.forget_made(1 << 40)
    for wanted in states[-2::-1]:
        session.do(c.Undo(1))
        assert contents(session.painting) == wanted
    for wanted in states[1:]:
        session.do(c.Redo(1))
        assert contents(session.painting) == wanted


def test_heaps_and_masks_are_paged_as_paint_is(disk, monkeypatch):
    monkeypatch.setattr(paging, "_OF_LATE", 1)
    session, pages = painted(), Paging()
    before, held = contents(session.painting), dict(held_by(session))["Painting"]
    pages.want(session.painting.root, 0, 1 << 30)
    while pages.wanted > 0:
        pages.step(1 << 16)
    assert all(isinstance(r.held, CodedData) or r.data.nbytes < 2048 for r in records(session.painting))
    assert any(isinstance(record.held, CodedData) for record in beside_paint(session.painting))
    assert dict(held_by(session))["Painting"] < held / 2
    assert disk.held > 0
    session.cache.clear()
    assert contents(session.painting) == before
    session.do(thick(4))
    plain = painted((*COMMANDS, thick(4)))
    assert all(
        np.array_equal(a.data, b.data) for a, b in zip(records(session.painting), records(plain.painting), strict=True)
    )


def test_commits_that_led_to_old_heaps_are_forgotten(monkeypatch):
    monkeypatch.setattr(old_commits, "EACH", 2)
    session = painted(())
    session.history._keep, session.history._bytes_cap = 0, 0
    for n in range(9):
        session.do(thick(n % 3))
    for pyramid in kept(session.painting.root):
        change, count = pyramid.last, 0
        while change is not None:
            change, count = change.before, count + 1
        assert count <= 5
