"""Detail by vector quantisation, as Perlin & Velho 1995 sketch it in section 7.2: codes, and a table of predictions.

Plain NumPy, the peer of `engine.texture.learnt`.  A code is a neighbourhood of 3 x 3 pixels of all axes of colour, less
the one in the middle, and as strong as any other; the table has for each code what the finer pixels of its like
differed by, in parts of how strong they were: their mean, which is foretold, and each of them, of which one is drawn by
chance where a texture is made.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CODES, TURNS, SIDE = 1024, 12, 3
_AT_ONCE = 4096


@dataclass(frozen=True, eq=False)
class Codebook:
    """`codes` (K, n); of each the mean of what is finer, `means` (K, 3 R), and what was `seen`, (m, 3 R)."""

    codes: np.ndarray
    means: np.ndarray
    seen: list[np.ndarray]


def trained(fine: np.ndarray) -> Codebook:
    """Returns the codebook of planes (R, 2h, 2w)."""
    coarse = halved(fine)
    near, found = _neighbourhoods(coarse), _differences(fine)[SIDE // 2 : -(SIDE // 2), SIDE // 2 : -(SIDE // 2)]
    near, found = near.reshape(-1, near.shape[-1]), found.reshape(-1, found.shape[-1])
    strong = _strength(near)
    near, found = near / strong, found / strong
    random = np.random.default_rng(0)
    codes = near[random.choice(len(near), min(CODES, len(near)), replace=False)].copy()
    for _ in range(TURNS):
        which = _nearest(near, codes)
        counts = np.bincount(which, minlength=len(codes))
        sums = np.zeros_like(codes)
        np.add.at(sums, which, near)
        codes[counts > 0] = (sums / np.maximum(counts, 1)[:, None])[counts > 0]
    which = _nearest(near, codes)
    seen = [found[which == k] if (which == k).any() else found[:1] for k in range(len(codes))]
    return Codebook(codes, np.stack([one.mean(axis=0) for one in seen]), seen)


def finer(coarse: np.ndarray, book: Codebook, drawn: bool) -> np.ndarray:
    """Returns planes (R, 2h, 2w) of (R, h, w), which goes on at its edges as at the others; `drawn` or foretold."""
    around = np.pad(coarse, ((0, 0), (SIDE // 2,) * 2, (SIDE // 2,) * 2), mode="wrap")
    near = _neighbourhoods(around)
    near = near.reshape(-1, near.shape[-1])
    strong = _strength(near)
    which = _nearest(near / strong, book.codes)
    if drawn:
        chance = np.random.default_rng(1).random(which.size)
        found = np.stack([book.seen[k][int(c * len(book.seen[k]))] for k, c in zip(which, chance, strict=True)])
    else:
        found = book.means[which]
    found = found * strong
    axes, height, width = coarse.shape
    p, q, r = np.moveaxis(found.reshape(height, width, 3, axes), (2, 3), (0, 1))
    out = np.empty((axes, 2 * height, 2 * width))
    out[:, ::2, ::2], out[:, ::2, 1::2] = coarse + p + q + r, coarse - p + q - r
    out[:, 1::2, ::2], out[:, 1::2, 1::2] = coarse + p - q - r, coarse - p - q + r
    return out


def halved(fine: np.ndarray) -> np.ndarray:
    return (fine[:, ::2, ::2] + fine[:, ::2, 1::2] + fine[:, 1::2, ::2] + fine[:, 1::2, 1::2]) / 4


def _differences(fine: np.ndarray) -> np.ndarray:
    """What four pixels differ by from their mean, across, down and crosswise: (h, w, 3 R)."""
    a, b, c, d = fine[:, ::2, ::2], fine[:, ::2, 1::2], fine[:, 1::2, ::2], fine[:, 1::2, 1::2]
    found = np.stack([a - b + c - d, a + b - c - d, a - b - c + d]) / 4
    return np.moveaxis(found.reshape(-1, *found.shape[2:]), 0, -1)


def _neighbourhoods(planes: np.ndarray) -> np.ndarray:
    """What pixels around each inner one differ by from it: (h, w, n)."""
    seen = np.lib.stride_tricks.sliding_window_view(planes, (SIDE, SIDE), axis=(1, 2))
    less = seen - seen[..., SIDE // 2, SIDE // 2][..., None, None]
    return np.moveaxis(less, 0, 2).reshape(*less.shape[1:3], -1)


def _strength(near: np.ndarray) -> np.ndarray:
    return np.sqrt(np.square(near).sum(axis=1, keepdims=True)) + 1e-6


def _nearest(vectors: np.ndarray, codes: np.ndarray) -> np.ndarray:
    out = np.empty(len(vectors), np.int64)
    size = np.square(codes).sum(axis=1)
    for first in range(0, len(vectors), _AT_ONCE):
        out[first : first + _AT_ONCE] = np.argmin(size - 2 * vectors[first : first + _AT_ONCE] @ codes.T, axis=1)
    return out
