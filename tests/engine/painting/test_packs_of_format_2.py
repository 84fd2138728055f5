"""Packs of the second format: what they held comes back, and bytes that are no tiles do not."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.earlier.packs_of_format_2 import code_size, most, rows_decoded

SHAPES = st.tuples(st.integers(1, 8), st.integers(1, 9), st.integers(1, 21))
SAMPLED = 4  # of the rows, by which differences were chosen


def made(shape, dtype, spread, seed, slope=0):
    """Noise of |v| <= spread on a ramp; `spread` 0: zeros."""
    rng = np.random.default_rng(seed)
    limit = np.iinfo(dtype).max
    ramp = np.add.outer(np.arange(shape[1]), np.arange(shape[2])) * slope
    values = rng.integers(-spread, spread + 1, shape) + ramp
    data = np.clip(values, -limit - 1, limit).astype(dtype)
    data.flags.writeable = False
    return data


def back(raw, tile):
    out = [np.full_like(tile, 77)]
    return rows_decoded(np.frombuffer(bytearray(raw), np.uint8), out), out[0]


def plain(data):
    """The code of one tile in NumPy, as the module tells it."""
    codes, streams = [], [b""] * 7
    for plane in data.astype(np.int64):
        before = np.vstack([np.zeros((1, plane.shape[1]), np.int64), plane[:-1]])
        chosen = slice(min(1, len(plane) - 1), None, SAMPLED)
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
@given(
    SHAPES,
    st.sampled_from([np.int16, np.int32]),
    st.sampled_from([0, 1, 3, 9, 200, 5000]),
    st.integers(0, 1 << 30),
    st.sampled_from([0, 2, 900]),
)
def test_what_the_second_format_wrote_is_read(shape, dtype, spread, seed, slope):
    data = made(shape, dtype, spread, seed, slope)
    raw = plain(data)
    largest, out = back(raw, data)
    assert np.array_equal(out, data)
    assert largest >= int(np.abs(data.astype(np.int64) + (data < 0)).max())
    assert len(raw) <= most(shape, 32)


TILE = made((2, 5, 6), np.int16, 40, 1)
GOOD = plain(TILE)


def test_other_lengths_and_codes_are_refused():
    for length in range(len(GOOD)):
        assert back(GOOD[:length], TILE)[0] == -1
    assert back(GOOD + b"x", TILE)[0] == -1
    for place in range(code_size(TILE.shape)):
        assert back(GOOD[:place] + b"\x06" + GOOD[place + 1 :], TILE)[0] == -1
