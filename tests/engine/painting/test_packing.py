"""Packs of tiles: every integer comes back, wherever the tile lies; and packs that lie."""

import contextlib
import json
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive import packing
from engine.archive.implied import TERM_CAP, Implied
from engine.archive.packing import grouped, pack, unpack
from engine.canvas.store import Record
from engine.files.fault import FileError
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.table import from_key, instance


def ink_of(key):
    return from_key(key, {})


INKS = tuple(
    sorted(
        (
            instance("rock", {"period": 9.5, "roughness": 0.3, "seed": (1 << 64) - 1}, 3, 5),
            instance("stripes", {"angle": 33.3}, -2, 5),
            instance("white", {}, 0, 0),
        ),
        key=lambda ink: ink.key[0],
    )
)


def tile(key, rect, inks=(), dtype=np.int16, seed=0, spread=None):
    rng = np.random.default_rng(seed)
    shape = (4 + 3 * len(inks), rect.height, rect.width)
    limit = spread or (np.iinfo(np.int16).max if dtype == np.int16 else packing.RESIDUAL_CAP)
    return key, Record(rect, rng.integers(-limit, limit + 1, shape).astype(dtype), inks, 7), None


def same(a, b):
    return (
        a[0] == b[0]
        and a[2] == b[2]
        and a[1].rect == b[1].rect
        and a[1].inks == b[1].inks
        and a[1].data.dtype == b[1].data.dtype
        and np.array_equal(a[1].data, b[1].data)
    )


@settings(deadline=None, max_examples=60)
@given(
    level=st.integers(-packing.LEVEL_CAP, packing.LEVEL_CAP),
    x=st.integers(-(1 << 300), 1 << 300),
    corners=st.tuples(st.integers(0, 20), st.integers(0, 20), st.integers(1, 20), st.integers(1, 20)),
    inks=st.sets(st.sampled_from(INKS)),
    dtype=st.sampled_from([np.int16, np.int32]),
    spread=st.sampled_from([1, 40, None]),
    seed=st.integers(0, 2**32),
    closely=st.booleans(),
)
def test_round_trip(level, x, corners, inks, dtype, spread, seed, closely):
    left, top, width, height = corners
    inks = tuple(ink for ink in INKS if ink in inks)
    rect = Rect.at(left, top, width, height)
    tiles = [tile(TileKey(level, x + i, -x), rect, inks, dtype, seed + i, spread) for i in range(3)]
    data = pack(tiles, closely)
    back = unpack(data, "a", ink_of)
    assert all(same(a, b) for a, b in zip(tiles, back, strict=True))
    assert all(record.depth == 0 and not record.data.flags.writeable for _, record, _ in back)
    assert pack(back, closely) == data


def implying(tile, terms, crc=7, inks=INKS[:1]):
    return *tile[:2], Implied(inks, terms, crc)


@given(st.lists(st.integers(-TERM_CAP, TERM_CAP), min_size=9, max_size=9), st.integers(0, (1 << 32) - 1))
@settings(deadline=None, max_examples=30)
def test_what_is_implied_comes_back(terms, crc):
    one = implying(tile(TileKey(3, 1, -2), Rect(0, 0, 4, 4)), tuple(terms), crc)
    other = tile(TileKey(3, 2, -2), Rect(0, 0, 4, 4), INKS[1:2])
    back = unpack(pack([one, other]), "a", ink_of)
    assert same(one, back[0])
    assert same(other, back[1])
    assert not back[0][1].data.flags.writeable


def test_groups_keep_order_and_size():
    tiles = [tile(TileKey(0, i, 0), Rect(0, 0, 1, 1))[:2] for i in range(600)]
    groups = list(grouped(tiles))
    assert [len(g) for g in groups] == [256, 256, 88]
    assert [t for g in groups for t in g] == tiles
    assert list(grouped([])) == []


def test_a_tile_of_many_inks_fills_a_block_of_its_own():
    inks = tuple(instance("rock", {"seed": i}, 0, 0) for i in range(40))
    big = tile(TileKey(0, 0, 0), Rect(0, 0, 128, 128), inks, np.int32)
    tiles = [big, tile(TileKey(0, 1, 0), Rect(0, 0, 2, 2))]
    assert all(same(a, b) for a, b in zip(tiles, unpack(pack(tiles), "a", ink_of), strict=True))


# ---- what lies ----

GOOD = pack(
    [
        tile(TileKey(2, -3, 4), Rect(1, 2, 4, 6), INKS[:1]),
        implying(tile(TileKey(2, -2, 4), Rect(0, 0, 3, 3)), tuple(range(9))),
    ]
)


def remade(change, body=None):
    """The good pack with its head changed."""
    (length,) = struct.unpack_from("<I", GOOD, 8)
    head = json.loads(GOOD[12 : 12 + length])
    head = change(head) or head
    text = json.dumps(head).encode()
    return GOOD[:8] + struct.pack("<I", len(text)) + text + (GOOD[12 + length :] if body is None else body)


def setting(*path, value):
    def change(head):
        place = head
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = value

    return remade(change)


HOSTILE = {
    "empty": b"",
    "magic": b"x" + GOOD[1:],
    "head beyond the end": GOOD[:8] + b"\xff\xff\xff\xff" + GOOD[12:],
    "head is no JSON": GOOD[:12] + b"}" + GOOD[13:],
    "head is a list": remade(lambda head: [1]),
    "no tiles": remade(lambda head: {"inks": [], "blocks": []}),
    "level": setting("tiles", 0, 0, value=1 << 20),
    "level as text": setting("tiles", 0, 0, value="2"),
    "level is true": setting("tiles", 0, 0, value=True),
    "address as number": setting("tiles", 0, 1, value=3),
    "address with underscore": setting("tiles", 0, 1, value="4_0"),
    "address with a prefix": setting("tiles", 0, 1, value="0x40"),
    "address in other digits": setting("tiles", 0, 1, value="٤"),
    "address without end": setting("tiles", 0, 1, value="f" * 40000),
    "empty rectangle": setting("tiles", 0, 5, value=1),
    "rectangle beyond the tile": setting("tiles", 0, 5, value=129),
    "negative corner": setting("tiles", 0, 3, value=-1),
    "bits": setting("tiles", 0, 7, value=64),
    "ink that is not there": setting("tiles", 0, 8, value=[1]),
    "ink twice": setting("tiles", 0, 8, value=[0, 0]),
    "unknown texture": setting("inks", 0, 0, value="marble"),
    "texture that is no list": setting("inks", 0, value=5),
    "block of too few tiles": setting("blocks", 0, 0, value=1),
    "block of too many bytes": setting("blocks", 0, 1, value=1 << 40),
    "block beyond the end": setting("blocks", 0, 2, value=1 << 40),
    "block of negative tiles": setting("blocks", 0, 0, value=-1),
    "block missing": setting("blocks", value=[]),
    "bytes left over": GOOD + b"x",
    "not deflate": remade(lambda head: None, body=bytes(200)),
    "tile list cut": setting("tiles", 0, value=[1, 2]),
    "no ink implies": setting("tiles", 1, 9, value=[]),
    "unknown ink implies": setting("tiles", 1, 9, value=[1]),
    "ink of a level far below implies": setting("tiles", 1, 0, value=0),
    "too few terms": setting("tiles", 1, 10, value=[0] * 8),
    "terms as numbers": setting("tiles", 1, 10, value=[0.5] * 9),
    "term beyond the range": setting("tiles", 1, 10, value=[1 << 41] * 9),
    "terms missing": setting("tiles", 1, 10, value=None),
    "CRC": setting("tiles", 1, 11, value=-1),
    "implied list cut": setting("tiles", 1, value=[2, "-2", "4", 0, 0, 3, 3, 16, [], [0]]),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile(name):
    with pytest.raises(FileError) as caught:
        unpack(HOSTILE[name], "a.ora: member m", ink_of)
    assert str(caught.value).startswith("a.ora: member m: ")
    assert len(str(caught.value)) < 300
    assert str(caught.value).isprintable()


def test_residuals_beyond_the_range_of_values_are_refused():
    huge = TileKey(0, 0, 0), Record(Rect(0, 0, 1, 1), np.full((4, 1, 1), 1 << 23, np.int32), (), 0), None
    with pytest.raises(FileError, match="largest residual"):
        unpack(pack([huge]), "a", ink_of)


def test_packs_may_be_closer():
    """By a tenth where what is left is small and by chance, as on the coarse grid."""
    rng = np.random.default_rng(5)
    noise = [np.rint(rng.normal(0, 0.5, (4, TILE, TILE))).astype(np.int16) for _ in range(12)]
    tiles = [(TileKey(0, n, 0), Record(Rect(0, 0, TILE, TILE), data, (), 0), None) for n, data in enumerate(noise)]
    close = pack(tiles, closely=True)
    assert len(close) < 0.95 * len(pack(tiles))
    assert all(same(a, b) for a, b in zip(tiles, unpack(close, "a", ink_of), strict=True))


def test_streams_of_few_bytes_are_zlibs():
    """isal's depend on what lies in memory beside them: the same painting gave other bytes, now and then."""
    few = [tile(TileKey(level, 0, 0), Rect(0, 0, 2 + level, 3), seed=level, spread=1 + level) for level in range(9)]
    data = pack(few)
    (length,) = struct.unpack_from("<I", data, 8)
    at, blocks = 12 + length, json.loads(data[12 : 12 + length])["blocks"]
    assert len(blocks) == 9
    for _, _, stored in blocks:
        assert data[at : at + stored] == zlib.compress(zlib.decompress(data[at : at + stored]), 1)
        at += stored


def test_every_truncation_is_refused():
    for length in range(len(GOOD)):
        with pytest.raises(FileError):
            unpack(GOOD[:length], "a", ink_of)


@settings(deadline=None, max_examples=200)
@given(st.lists(st.floats(0, 0.99999), min_size=1, max_size=3))
def test_flipped_bits_raise_nothing_else(places):
    data = bytearray(GOOD)
    for place in places:
        bit = int(place * 8 * len(data))
        data[bit // 8] ^= 1 << bit % 8
    with contextlib.suppress(FileError):
        unpack(bytes(data), "a", ink_of)
