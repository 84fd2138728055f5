"""The code of tiles: every integer comes back, rows take as few bits as they need, and bytes that are no tiles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive import tilecode
from engine.archive.tilecode import decoded, encoded

SHAPES = st.tuples(st.integers(1, 8), st.integers(1, 9), st.integers(1, 21))


def made(shape, dtype, spread, seed, slope=0):
    """Noise of |v| <= spread on a ramp; `spread` 0: zeros."""
    rng = np.random.default_rng(seed)
    limit = np.iinfo(dtype).max
    ramp = np.add.outer(np.arange(shape[1]), np.arange(shape[2])) * slope
    values = rng.integers(-spread, spread + 1, shape) + ramp
    data = np.clip(values, -limit - 1, limit).astype(dtype)
    data.flags.writeable = False
    return data


def back(raw, tiles):
    out = [np.full_like(tile, 77) for tile in tiles]
    return decoded(np.frombuffer(raw, np.uint8), out), out


@settings(deadline=None, max_examples=120)
@given(
    st.lists(
        st.tuples(
            SHAPES,
            st.sampled_from([np.int16, np.int32]),
            st.sampled_from([0, 1, 2, 7, 8, 127, 128, 32767, 1 << 22]),
            st.integers(0, 1 << 30),
            st.sampled_from([0, 1, 300]),
        ),
        min_size=1,
        max_size=4,
    )
)
def test_every_integer_comes_back(rows):
    tiles = [made(*row) for row in rows]
    largest, out = back(encoded(tiles), tiles)
    assert all(np.array_equal(a, b) for a, b in zip(tiles, out, strict=True))
    assert largest >= max(int(np.abs(tile.astype(np.int64) + (tile < 0)).max()) for tile in tiles)


@pytest.mark.parametrize("dtype", [np.int16, np.int32])
def test_the_extremes_come_back(dtype):
    """Differences wrap where they leave the range."""
    low, high = np.iinfo(dtype).min, np.iinfo(dtype).max
    rows = [[low, high, low, high], [high, low, high, low], [0, low, 0, high], [low, low, high, high]]
    tiles = [np.array([rows, np.transpose(rows)], dtype), np.array([[[low]]], dtype), np.array([[[high]]], dtype)]
    _, out = back(encoded(tiles), tiles)
    assert all(np.array_equal(a, b) for a, b in zip(tiles, out, strict=True))


@pytest.mark.parametrize(
    ("largest", "size"), [(0, 0), (1, 4), (2, 8), (7, 8), (8, 16), (127, 16), (128, 32), (32767, 32)]
)
def test_rows_take_the_bits_they_need(largest, size):
    """A row alternating between -largest and largest is best left as it is; 16 pixels."""
    data = np.array([[[largest, -largest] * 8, [-largest, largest] * 8]], np.int16)
    assert len(encoded([data])) == 3 + 2 * size


def plain(data):
    """The code of one tile in NumPy, as the module tells it."""
    codes, streams = [], [b""] * 7
    for plane in data.astype(np.int64):
        before = np.vstack([np.zeros((1, plane.shape[1]), np.int64), plane[:-1]])
        chosen = slice(min(1, len(plane) - 1), None, tilecode.SAMPLED)
        beyond = np.vstack([plane[:1], plane[:-1]])  # a plane of one row: as if it had been the same before
        along = np.hstack([plane[:, :1], np.diff(plane, axis=1)])
        forms = [plane, along, plane - before, None]
        forms[3] = np.hstack([forms[2][:, :1], np.diff(forms[2], axis=1)])
        sampled = [plane, along, plane - beyond, None]
        sampled[3] = np.hstack([sampled[2][:, :1], np.diff(sampled[2], axis=1)])
        small = plane.min() >= -2 and plane.max() <= 1
        kind = 0 if small else int(np.argmin([np.abs(form[chosen]).sum() for form in sampled]))
        codes.append(kind)
        for row in forms[kind].astype(data.dtype).astype(np.int64):
            z = (row << 1) ^ (row >> 63)
            width = next(w for w in (0, 2, 4, 8, 16, 32) if z.max() < 1 << w)
            codes.append([0, 2, 4, 8, 16, 32].index(width))
            if 0 < width < 8:
                each = 8 // width
                padded = np.append(z, np.zeros(-len(z) % each, np.int64)).reshape(-1, each)
                streams[width // 4] += (padded << (width * np.arange(each))).sum(1).astype(np.uint8).tobytes()
            elif width:
                for b in range(width // 8):
                    streams[(2 if width == 8 else 3) + b] += (z >> 8 * b & 255).astype(np.uint8).tobytes()
    return bytes(codes) + b"".join(streams)


@settings(deadline=None, max_examples=60)
@given(SHAPES, st.sampled_from([1, 3, 9, 200, 5000]), st.integers(0, 1 << 30), st.sampled_from([0, 2, 900]))
def test_the_code_is_the_plain_form(shape, spread, seed, slope):
    data = made(shape, np.int32, spread, seed, slope)
    assert encoded([data]) == plain(data)


TILES = [made((2, 5, 6), np.int16, 40, 1), made((1, 3, 3), np.int32, 1 << 20, 2)]
GOOD = encoded(TILES)


def test_other_lengths_are_refused():
    for length in range(len(GOOD)):
        assert back(GOOD[:length], TILES)[0] == -1
    assert back(GOOD + b"x", TILES)[0] == -1


@settings(deadline=None, max_examples=200)
@given(st.integers(0, len(GOOD) - 1), st.integers(0, 255))
def test_other_bytes_give_tiles_or_none(place, value):
    raw = bytearray(GOOD)
    raw[place] = value
    largest, out = back(bytes(raw), TILES)
    assert largest == -1 or largest >= max(int(np.abs(t.astype(np.int64) + (t < 0)).max()) for t in out)


def test_codes_beyond_the_known_are_refused():
    count = sum(tilecode.code_size(tile.shape) for tile in TILES)
    for place in range(count):
        assert back(GOOD[:place] + b"\x06" + GOOD[place + 1 :], TILES)[0] == -1
