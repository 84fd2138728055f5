"""The code of tiles: every integer comes back, pieces take as few bits as they need, and bytes that are no tiles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_format_text import decoded as stranger

from engine.archive import tilecode
from engine.archive.tilecode import decoded, encoded

SHAPES = st.tuples(st.sampled_from([4, 7, 10]), st.integers(1, 35), st.integers(1, 70))


def made(shape, dtype, spread, seed, slope=0):
    """Noise of |v| <= spread on a ramp that is `slope` times as steep in each plane as in the one before; `spread` 0:
    no noise."""
    rng = np.random.default_rng(seed)
    limit = np.iinfo(dtype).max
    ramp = np.multiply.outer(np.arange(1, 1 + shape[0]), np.multiply.outer(np.arange(shape[1]), np.arange(shape[2])))
    values = rng.integers(-spread, spread + 1, shape) + ramp * slope
    data = np.clip(values, -limit - 1, limit).astype(dtype)
    data.flags.writeable = False
    return data


def joined(tiles):
    return b"".join(encoded(tiles))


def back(raw, tiles):
    out = [np.full_like(tile, 77) for tile in tiles]
    return decoded(np.frombuffer(bytearray(raw), np.uint8), out), out


@settings(deadline=None, max_examples=120)
@given(
    st.lists(
        st.tuples(
            SHAPES,
            st.sampled_from([np.int16, np.int32]),
            st.sampled_from([0, 1, 2, 7, 8, 127, 128, 32767, 1 << 22]),
            st.integers(0, 1 << 30),
            st.sampled_from([0, 1, 9]),
        ),
        min_size=1,
        max_size=4,
    )
)
def test_every_integer_comes_back(rows):
    tiles = [made(*row) for row in rows]
    largest, out = back(joined(tiles), tiles)
    assert all(np.array_equal(a, b) for a, b in zip(tiles, out, strict=True))
    assert largest >= max(int(np.abs(tile.astype(np.int64) + (tile < 0)).max()) for tile in tiles)


@pytest.mark.parametrize("dtype", [np.int16, np.int32])
def test_the_extremes_come_back(dtype):
    """Differences wrap where they leave the range."""
    low, high = np.iinfo(dtype).min, np.iinfo(dtype).max
    rows = [[low, high, low, high], [high, low, high, low], [0, low, 0, high], [low, low, high, high]]
    planes = [rows, np.transpose(rows), rows, np.negative(rows).tolist() if dtype == np.int32 else rows]
    tiles = [np.array(planes, np.int64).astype(dtype), *(np.full((4, 1, 1), v, dtype) for v in (low, high))]
    _, out = back(joined(tiles), tiles)
    assert all(np.array_equal(a, b) for a, b in zip(tiles, out, strict=True))


@pytest.mark.parametrize(
    ("largest", "size"), [(0, 0), (1, 4), (2, 8), (7, 8), (8, 16), (127, 16), (128, 32), (32767, 32)]
)
def test_pieces_take_the_bits_they_need(largest, size):
    """A row alternating between -largest and largest is best left as it is; two of 16 pixels, in alpha alone."""
    data = np.zeros((4, 2, 16), np.int16)
    data[3] = [[largest, -largest] * 8, [-largest, largest] * 8]
    assert len(joined([data])) == 1 + 4 * 2 + 3 * 2 * 2 + 2 * size


def test_colour_that_follows_from_alpha_takes_no_bits():
    """Paint of one colour: alpha of any shape, and what is 3/4, 1/2 and -1/4 of it."""
    alpha = 4 * made((4, 128, 128), np.int32, 200, 3)[3]
    data = np.array([alpha * 3 // 4, alpha // 2, -alpha // 4, alpha])
    alone = np.array([0 * alpha, 0 * alpha, 0 * alpha, alpha])
    assert len(joined([data])) == len(joined([alone]))
    mixed = np.array([alpha, alpha // 2, alpha // 4, 0 * alpha])  # in full cover
    assert len(joined([mixed])) == len(joined([alone]))


@settings(deadline=None, max_examples=30)
@given(SHAPES, st.sampled_from([0, 3, 200, 1 << 20]), st.integers(0, 1 << 30), st.sampled_from([0, 9]))
def test_a_reader_that_follows_the_text_finds_the_same(shape, spread, seed, slope):
    data = made(shape, np.int32, spread, seed, slope)
    inks = list(range((shape[0] - 4) // 3))
    head = [0, "0", "0", 0, 0, shape[2], shape[1], 32, inks]
    ((_, _, found, _),) = stranger(joined([data]), [head])
    assert np.array_equal(found, data)


TILES = [made((4, 5, 6), np.int16, 40, 1), made((4, 3, 3), np.int32, 1 << 20, 2)]
GOOD = joined(TILES)
CODES = sum(tilecode.code_size(tile.shape) for tile in TILES)


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
    for place in range(CODES):
        assert back(GOOD[:place] + b"\x06" + GOOD[place + 1 :], TILES)[0] == -1
