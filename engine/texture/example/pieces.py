"""Pieces of the example that are laid out at the coarsest level so that they fit one another.

The plane is a checkerboard of them.  Those on its dark squares are drawn by their place; of a light one as many are
drawn, and the one is taken that goes on best across its four edges.  So what lies where hangs on the place alone.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.hashing import hash_plane, mix64
from engine.numeric.kernel import Array, Int, inner_uncounted, kernel
from engine.texture.example.region_window import Example

TRIED = 8  # pieces for a light square
_ACROSS = 3  # pixels on both sides of an edge that are compared; at most PAD
_FAR = np.int64(2**62)
_GOLDEN = np.uint64(0x9E3779B97F4A7C15)


def squares_of(mask: np.ndarray, offset: tuple[int, int], block: int, size: tuple[int, int]) -> np.ndarray:
    """Tells which squares hold a pixel of a mask, `offset` being where its first one lies in the first of them: bool
    (rows, columns)."""
    rows, columns = size
    whole = np.zeros((rows * block, columns * block), bool)
    whole[offset[0] : offset[0] + mask.shape[0], offset[1] : offset[1] + mask.shape[1]] = mask
    return np.asarray(whole.reshape(rows, block, columns, block).any((1, 3)))


def fitting(
    key: int, squares: Rect, corners: np.ndarray, block: int, example: Example, wanted: np.ndarray
) -> np.ndarray:
    """Returns numbers, uint64 (rows, columns), whose remainders by `corners.size` are the pieces of some squares of the
    checkerboard, where `wanted`, bool (rows, columns)."""
    around = squares.grown(1)
    hashes = hash_plane(key, around.x0, around.y0, around.width, around.height) >> np.uint64(1)
    out = hashes[1:-1, 1:-1].copy()
    _fit(hashes, (squares.x0 + squares.y0) & 1, corners, block, example, wanted, out)
    return out


@kernel
def _fit(hashes: Array, parity: Int, corners: Array, block: Int, example: Example, wanted: Array, out: Array) -> None:
    """Replaces the numbers of light squares by those of pieces that fit."""
    size = np.uint64(corners.size)
    for y in range(out.shape[0]):
        for x in range((y + parity + 1) & 1, out.shape[1], 2):
            if not wanted[y, x]:
                continue
            h = out[y, x]
            least, best = _FAR, h % size
            for k in range(TRIED):
                drawn = mix64(h + np.uint64(k) * _GOLDEN) % size
                e = np.int64(_misfit(hashes, y, x, corners[drawn], corners, block, example))
                if e < least:
                    least, best = e, drawn
            out[y, x] = h - h % size + best


@inner_uncounted
def _misfit(hashes: Array, y: Int, x: Int, corner: Int, corners: Array, block: Int, example: Example) -> Int:
    """Returns how far a piece and its four neighbours are apart where each goes on across their edges, in the mean."""
    width, size = example.region.shape[1], np.uint64(corners.size)
    total, count = np.int64(0), np.int64(1)
    for side in range(4):
        dy, dx = (side & 1) * (side - 2), (1 - (side & 1)) * (side - 1)
        other = corners[hashes[y + 1 + dy, x + 1 + dx] % size]
        for along in range(block):
            for across in range(-_ACROSS, _ACROSS):
                row = along if dy == 0 else across + (block if dy > 0 else 0)
                column = along if dx == 0 else across + (block if dx > 0 else 0)
                r, c = (corner >> 16) + row, (corner & 0xFFFF) + column
                s, d = (other >> 16) + row - dy * block, (other & 0xFFFF) + column - dx * block
                if example.region[r, c] and example.region[s, d]:
                    count += 1
                    for n in range(4):
                        apart = np.int64(example.compared[4 * (r * width + c) + n])
                        apart -= example.compared[4 * (s * width + d) + n]
                        total += apart * apart
    return 256 * total // count
