"""Planes of heaps that are the same are held once: what is seen, painted over, undone and saved is what it was."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_laid_maps import RECT, painting, seen

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.store import Record
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.coding.coded_records import coded_alone, decode, encode
from engine.terrain.plane import land
from engine.texture.even_planes import EvenPlanes

EVERYWHERE = Rect(-(1 << 20), -(1 << 20), 1 << 20, 1 << 20)


def laid(tmp_path):
    session = painting(tmp_path / "map.tif")
    session.do(c.parse({"do": "ground", "texture": "map", "rect": [0, RECT.x0, RECT.y0, RECT.width, RECT.height]}))
    return session


def records(session):
    heaps = session.painting.root.children[0].heaps.values()
    return [r for heap in heaps for k in heap.levels for _, r in heap.records(k, EVERYWHERE.zoomed(k))]


@given(st.integers(0, 3), st.integers(1, 9), st.integers(1, 9), st.randoms(use_true_random=False))
@settings(deadline=None, max_examples=30)
def test_planes_come_back_as_they_were(inks, height, width, random):
    told = [[random.randint(-9, 9) for _ in range(height * width)] for _ in range(1 + inks)]
    planes = [np.array(one, np.int16).reshape(height, width) for one in told]
    data = np.stack([*[planes[0]] * 3, np.zeros_like(planes[0]), *(one for one in planes[1:] for _ in range(3))])
    held = EvenPlanes.of(data)
    assert np.array_equal(held.made(), data)
    assert held.made().dtype == data.dtype
    assert (held.nbytes, held.itemsize) == (data.nbytes * (1 + inks) // (4 + 3 * inks), 2)
    data[random.randrange(len(data)), 0, 0] += 1
    assert EvenPlanes.of(data) is None


def test_heaps_hold_them_once_and_are_painted_over_undone_and_saved(tmp_path):
    session = laid(tmp_path)
    before = seen(session)
    assert all(isinstance(record.held, EvenPlanes) for record in records(session))
    session.do(c.parse({"do": "stroke", "points": [[20, 20]], "brush": {"radius": 9, "height": 3}}))
    after = seen(session)
    assert (after - before).max() == pytest.approx(3.0, abs=0.2)
    session.do(c.Undo())
    assert np.array_equal(seen(session), before)
    session.do(c.Redo())
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    assert np.array_equal(land(open_painting(tmp_path / "a.ora").painting, "Land").height(0, RECT), after)


def test_they_are_coded_and_put_away_as_all_records(tmp_path):
    session = laid(tmp_path)
    before = seen(session)
    for record in records(session):
        data = record.data.copy()
        assert np.array_equal(coded_alone(Record(record.rect, record.held, record.inks, 0))[0].made(), data)
        if encode(record, None):
            assert record.held.nbytes < data.nbytes // 4
            assert np.array_equal(record.data, data)
            decode(record)
            assert np.array_equal(record.data, data)
            encode(record, None)
    assert np.array_equal(seen(session), before)
