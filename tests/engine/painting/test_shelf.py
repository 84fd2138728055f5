"""Tiles of a file are decoded when they are looked at, and what nobody painted on is saved as it lay there."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive import opening, packing, tilecode
from engine.archive.opening import open_painting
from engine.archive.packing import pack, unpack
from engine.archive.saving import Snapshot, save
from engine.archive.shelves import filed_pages
from engine.archive.shelves.filed_pages import Gathered
from engine.archive.shelves.shelf import DECODED, Block, Filed, Recent
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.canvas.store import Record
from engine.files.fault import FileError, TooMuch
from engine.keeping.spill import Spilled
from engine.numeric.address import Rect, TileKey
from engine.painting.commands import parse
from engine.session.apply import Painting, apply
from engine.session.paging import Paging
from engine.session.session import Session

AREA = Rect(0, 0, 300, 200)
PLAIN = {"radius": 40, "hardness": 0.4, "colour": "#c06030"}
ROCK = {"radius": 30, "colour": "#306090", "ink": [{"texture": "rock", "amount": 0.4, "period": 40}]}


def painted(*brushes):
    painting = Painting(AREA, 3)
    for number, brush in enumerate(brushes):
        points = [[40, 40 + 60 * number], [250, 90 + 60 * number]]
        painting = apply(painting, parse({"do": "stroke", "points": points, "brush": brush}))
    return painting


def pyramid_of(painting):
    return next(layers(painting.root)).pyramid


def values(painting, level):
    return evaluate(pyramid_of(painting), level, AREA.zoomed(level)).data


def records(painting):
    return {key: record.data for key, record in pyramid_of(painting).all_records()}


@pytest.fixture
def decoded(monkeypatch):
    """The tiles that were decoded, block by block."""
    counts = []
    form, whole = packing._FORMATS[packing._MAGIC], tilecode.decoded

    def counting(raw, tiles):
        counts.append(len(tiles))
        return whole(raw, tiles)

    monkeypatch.setitem(packing._FORMATS, packing._MAGIC, replace(form, decoded=counting))
    return counts


def test_what_is_more_than_the_machine_has_once_decoded_opens(tmp_path, monkeypatch):
    """Three layers, of which there is room for one and for the file."""
    session = Session(painted(PLAIN))
    for name in ("b", "c"):
        session.do(parse({"do": "layer", "add": name}))
        session.do(parse({"do": "stroke", "points": [[40, 40], [250, 90]], "brush": PLAIN}))
    save(tmp_path / "a.ora", Snapshot(session.painting, None))
    sizes = [
        sum(record.plain_size for _, record in layer.pyramid.all_records()) for layer in layers(session.painting.root)
    ]
    monkeypatch.setattr(opening, "memory_cap", lambda: max(sizes) + (tmp_path / "a.ora").stat().st_size)
    found = open_painting(tmp_path / "a.ora").painting
    for one, other in zip(layers(session.painting.root), layers(found.root), strict=True):
        saved, read = ([(key, record.data) for key, record in each.pyramid.all_records()] for each in (one, other))
        assert all(
            key == other_key and np.array_equal(a, b) for (key, a), (other_key, b) in zip(saved, read, strict=True)
        )
    monkeypatch.setattr(opening, "memory_cap", lambda: max(sizes) - 1)
    with pytest.raises(TooMuch):
        open_painting(tmp_path / "a.ora")


@pytest.fixture(params=["in memory", "on disk, by pages"])
def where(request, monkeypatch):
    """Where what a file holds lies once it is open."""
    if request.param != "in memory":
        monkeypatch.setattr(opening, "_FILE_PART", 1 << 60)
        monkeypatch.setattr(filed_pages, "MANY", 1)
    return request.param


@pytest.mark.parametrize("brushes", [[PLAIN], [PLAIN, ROCK]], ids=["plain", "rock"])
def test_nothing_is_lost_though_the_file_goes_once_it_is_open(tmp_path, brushes, decoded, where):
    painting, path = painted(*brushes), tmp_path / "a.ora"
    save(path, Snapshot(painting))
    found = open_painting(path).painting
    path.unlink()
    before, opened = sum(decoded), pyramid_of(found)
    held = [record.held for _, record in opened.all_records()]
    blocks = {getattr(each, "filed", each).block for each in held}
    assert any(isinstance(block.held, Spilled) for block in blocks) == (where != "in memory")
    assert sum(1 for _ in opened.all_records()) > before  # what ink implies is tried on one tile
    assert opened.nbytes < pyramid_of(painting).nbytes
    for level in (-2, 0, 1):
        assert np.array_equal(values(found, level), values(painting, level))
    assert sum(decoded) > before
    mine, theirs = records(painting), records(found)
    assert mine.keys() == theirs.keys()
    assert all(np.array_equal(data, theirs[key]) for key, data in mine.items())
    paging = Paging()
    paging.want(found.root, None, 1 << 30)
    paging.step(1 << 30)
    assert any(isinstance(block.held, Spilled) for block in blocks)
    DECODED.shrink(1 << 30)
    theirs = records(found)
    assert all(np.array_equal(data, theirs[key]) for key, data in mine.items())


@pytest.mark.parametrize("brushes", [[PLAIN], [PLAIN, ROCK]], ids=["plain", "rock"])
def test_what_nobody_painted_on_is_saved_as_it_lay_there(tmp_path, brushes, monkeypatch, where):
    save(tmp_path / "a.ora", Snapshot(painted(*brushes)))
    found = open_painting(tmp_path / "a.ora").painting
    monkeypatch.delattr(tilecode, "encoded")
    save(tmp_path / "b.ora", Snapshot(found))
    assert (tmp_path / "a.ora").read_bytes() == (tmp_path / "b.ora").read_bytes()


@pytest.mark.parametrize("brushes", [[PLAIN], [PLAIN, ROCK]], ids=["plain", "rock"])
@pytest.mark.parametrize("level", [-1, 0, 1])
def test_what_is_painted_on_an_opened_painting_is_saved(tmp_path, brushes, level, where):
    painting = painted(*brushes)
    save(tmp_path / "a.ora", Snapshot(painting))
    points = [[60 * 2.0**level, 50 * 2.0**level], [90 * 2.0**level, 70 * 2.0**level]]
    more = parse({"do": "stroke", "points": points, "level": level, "brush": {"radius": 12, "colour": "#ffffff"}})
    wanted, found = apply(painting, more), apply(open_painting(tmp_path / "a.ora").painting, more)
    save(tmp_path / "b.ora", Snapshot(found))
    again = open_painting(tmp_path / "b.ora").painting
    for k in (-1, 0, 2):
        assert np.array_equal(values(wanted, k), values(again, k))


def tiles_of(count, spread):
    rng = np.random.default_rng(spread)
    data = rng.integers(-spread, spread + 1, (count, 4, 9, 11)).astype(np.int32)
    return [(TileKey(0, i, 0), Record(Rect(0, 0, 11, 9), data[i], (), 0), None) for i in range(count)]


def put_off(data):
    return unpack(data, "a", lambda key: pytest.fail("no ink"), None, at_once=False)


PLACED = st.tuples(st.sampled_from([0, 3]), st.integers(-9, 9), st.integers(-5, 20) | st.just(1 << 70))


@given(st.lists(PLACED, unique=True, max_size=40), st.integers(0, 7), st.sampled_from([1, 8, 4096]))
@settings(max_examples=40)
def test_tiles_of_a_file_are_what_they_were_by_pages_and_none_is_there_twice(places, depth, many):
    tiles = [(TileKey(*place), record, None) for place, (_, record, _) in zip(places, tiles_of(40, 9), strict=False)]
    read = [
        tile if n % 5 == 4 else filed for n, (tile, filed) in enumerate(zip(tiles, put_off(pack(tiles)), strict=True))
    ]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(filed_pages, "MANY", many)
        gathered = Gathered("a.ora", len(read), [tile[:2] for tile in read])
        for key, record, _ in read:
            with pytest.raises(FileError, match="is there twice"):
                gathered.add(key, record)
        levels = gathered.levels(depth)
    found = {(level, *place): record for level, stored in levels.items() for place, record in stored.items()}
    assert found.keys() == set(places)
    assert all((level, *place) in found for level, stored in levels.items() for place in stored)
    for key, record, _ in tiles:
        there = found[tuple(key)]
        assert (there.rect, there.inks, there.depth) == (record.rect, record.inks, depth)
        assert np.array_equal(there.data, record.data)


def test_a_block_is_kept_together_where_a_tile_before_it_is_painted_anew(monkeypatch):
    monkeypatch.setattr(packing, "TILES", 4)
    found = put_off(pack(tiles_of(12, 50)))
    changed = [(found[1][0], tiles_of(1, 9)[0][1], None), *found[2:]]
    coded, encoded = [], tilecode.encoded
    monkeypatch.setattr(tilecode, "encoded", lambda run: coded.append(len(run)) or encoded(run))
    back = put_off(pack(changed))
    assert sum(coded) == 3
    assert all(np.array_equal(a[1].data, b[1].data) for a, b in zip(changed, back, strict=True))


def test_a_residual_larger_than_may_be_is_taken_for_the_largest():
    huge = tiles_of(1, 4 * packing.RESIDUAL_CAP)
    (tile,) = put_off(pack(huge))
    wanted = np.clip(huge[0][1].data, -packing.RESIDUAL_CAP, packing.RESIDUAL_CAP)
    assert np.array_equal(tile[1].data, wanted)


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(1, 40)), max_size=60), st.integers(1, 120))
@settings(deadline=None, max_examples=60)
def test_what_was_made_of_late_takes_no_more_than_it_may(kept, most):
    recent = Recent(lambda: most)
    known = {}
    for key, size in kept:
        recent.keep(key, (key, size), size)
        known = {k: v for k, v in known.items() if k != key} | {key: size}
        while sum(known.values()) > most and len(known) > 1:
            del known[next(iter(known))]
        assert recent._held == sum(known.values())
    assert {key: recent.get(key) for key in range(10)} == {
        key: (key, known[key]) if key in known else None for key in range(10)
    }
    recent.shrink(1 << 20)
    assert len(recent._made) <= 1


def test_a_block_is_decoded_once_for_all_of_its_tiles():
    asked = []
    block = Block(
        lambda stored: asked.append(1) or [np.full((4, 2, 2), n, np.int16) for n in range(3)],
        3,
        96,
        memoryview(b"x" * 30),
    )
    held = [Filed(block, n, 16) for n in range(3)]
    assert [int(h.made()[0, 0, 0]) for h in held] == [0, 1, 2]
    assert len(asked) == 1
    held[1].forget()
    assert int(held[1].made()[0, 0, 0]) == 1
    assert len(asked) == 2
