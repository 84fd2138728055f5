"""Masks in packs: they come back, wherever they lie, and packs that lie are refused."""

import json
import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map
from isal import isal_zlib

from engine.archive import maskpacks
from engine.files.fault import FileError
from engine.texture.example.tiles import TILE_SIDE, sealed


@given(st.sets(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=1), st.integers(0, 1 << 70), st.randoms())
@settings(deadline=None, max_examples=20)
def test_masks_come_back(places, far, rng):
    rng = np.random.default_rng(rng.randrange(1 << 30))
    tiles = {}
    for row, column in places:
        tile = (
            np.ones((1, TILE_SIDE, TILE_SIDE), np.uint8)
            if rng.random() < 0.5
            else rng.integers(0, 2, (1, TILE_SIDE, TILE_SIDE), np.uint8)
        )
        tiles[row - far, column + far] = sealed(tile)
    keys = next(maskpacks.grouped(Map(tiles)))
    found = maskpacks.unpack(maskpacks.pack(tiles, keys), "a", len(keys))
    assert set(found) == set(tiles)
    assert all(np.array_equal(found[key].data, tiles[key].data) for key in tiles)


def test_many_tiles_are_cut_into_packs(monkeypatch):
    monkeypatch.setattr(maskpacks, "TILES", 3)
    tile = sealed(np.ones((1, TILE_SIDE, TILE_SIDE), np.uint8))
    masks = Map({(0, n): tile for n in range(7)})
    parts = [maskpacks.unpack(maskpacks.pack(masks, keys), "a", len(keys)) for keys in maskpacks.grouped(masks)]
    assert [len(part) for part in parts] == [3, 3, 1]
    assert set(maskpacks.joined(parts, "a")) == set(masks)
    with pytest.raises(FileError, match="out of order"):
        maskpacks.joined(parts[::-1], "a")


def pack(runs, plain, stream=None):
    head = json.dumps(runs).encode()
    stream = isal_zlib.compress(plain, 1) if stream is None else stream
    return maskpacks.MAGIC + struct.pack("<I", len(head)) + head + stream


FULL = b"\xff" * maskpacks.PLAIN
BAD_PACKS = {
    "nothing": (b"", 1),
    "other magic": (b"inkfall\x02" + pack([["0", "0", 1]], FULL)[8:], 1),
    "head beyond the end": (maskpacks.MAGIC + struct.pack("<I", 1 << 31) + b"[]", 1),
    "head of numbers": (pack(3, FULL), 1),
    "run of text": (pack(["x"], FULL), 1),
    "run of none": (pack([["0", "0", 0]], FULL), 1),
    "run of a thousand million": (pack([["0", "0", 10**9]], FULL), 1),
    "row of no digits": (pack([["zero", "0", 1]], FULL), 1),
    "row of too many digits": (pack([["1" * 9000, "0", 1]], FULL), 1),
    "a tile twice": (pack([["0", "0", 2], ["0", "1", 1]], FULL * 3), 3),
    "tiles out of order": (pack([["1", "0", 1], ["0", "0", 1]], FULL * 2), 2),
    "fewer bytes": (pack([["0", "0", 2]], FULL), 2),
    "empty tile": (pack([["0", "0", 1]], bytes(maskpacks.PLAIN)), 1),
    "no stream": (pack([["0", "0", 1]], b"", b""), 1),
    "damaged stream": (pack([["0", "0", 1]], b"", b"x\x9c\xff\xff\xff"), 1),
    "too many tiles": (pack([["0", "0", maskpacks.TILES + 1]], FULL), maskpacks.TILES + 1),
}


@pytest.mark.parametrize("name", BAD_PACKS)
def test_packs_that_lie(name):
    data, count = BAD_PACKS[name]
    with pytest.raises(FileError) as caught:
        maskpacks.unpack(data, "a.ora: member m", count)
    assert str(caught.value).startswith("a.ora: member m: ")
    assert "\n" not in str(caught.value)


def test_a_bomb_takes_no_more_than_its_tiles_do():
    """A stream goes on beyond what the tiles take: the rest is not read."""
    data = pack([["0", "0", 1]], FULL * (1 << 16))
    assert list(maskpacks.unpack(data, "a", 1)) == [(0, 0)]
