"""How much of a texture is copied from its example, patch for patch."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.kernel import Array, dividing
from engine.numeric.matrices import combinations
from engine.texture.structure.nearest import principal
from engine.texture.structure.patches import gathered

SIDE_OF_COPIES = 7
_LOOKED_AT = 512  # patches of a texture
_DIRECTIONS = 16
_BAND = 64  # rows of an example that are compared at a time
_SAME = 0.1  # of the example's deviation: how far a copy may be off
_DOMAIN = 0x636F7079  # "copy"


def copied_share(example: np.ndarray, texture: np.ndarray) -> float:
    """Tells which part, 0..1, of the 7 x 7 patches of a texture (C, h, w), by a sample of them, is one of an example's
    (C', h, w), but for a tenth of its deviation; looked at in grey.  0 where either is smaller than a patch."""
    *_, share = counted_copies(example, texture)
    assert share is not None
    return share


def counted_copies(example: np.ndarray, texture: np.ndarray) -> Iterator[float | None]:
    """Yields None after each piece of work, and last what `copied_share` returns."""
    best = np.zeros(0, np.float32)
    for found in nearest_patches(example, texture):
        best = best if found is None else found
        yield None
    yield copied_part(example, best)


def copied_part(example: np.ndarray, best: np.ndarray) -> float:
    """Tells which part, 0..1, of patches are an example's, by how far each is from the nearest."""
    spread = float(_grey(example).std())
    return float((best < np.float32((_SAME * spread) ** 2)).mean()) if best.size else 0.0


def nearest_patches(example: np.ndarray, texture: np.ndarray) -> Iterator[np.ndarray | None]:
    """Yields None after each piece of work, and last how far, squared and for a pixel, each patch of a sample of those
    of a texture (C, h, w) is from the nearest of an example's (C', h, w), in grey: float32 (n,), none where either is
    smaller than a patch or the example is of one colour."""
    one, other = _grey(example), _grey(texture)
    side = SIDE_OF_COPIES
    if min(*one.shape, *other.shape) < side or float(one.std()) < 1e-6:
        yield np.zeros(0, np.float32)
        return
    even = np.full((side, side), 1.0 / side**2, np.float32)
    places = gathered(other[..., None], side, False, even)
    hashed = hash_plane(fold_key(_DOMAIN, 0), 0, 0, _LOOKED_AT, 1)[0] % np.uint64(places.shape[1])
    places = np.ascontiguousarray(places[:, hashed.astype(np.int64)])
    coarse = gathered(one[..., None], side, False, even)
    directions = principal(np.ascontiguousarray(coarse[:, :: coarse.shape[1] // 2048 + 1]), _DIRECTIONS)
    del coarse
    best = np.full(places.shape[1], np.float32(3e38))
    factors = np.ascontiguousarray(combinations(directions, places).T) * np.float32(-2.0)
    for top in range(0, one.shape[0] - side + 1, _BAND):
        patches = gathered(one[top : top + _BAND + side - 1, :, None], side, False, even)
        own = combinations(directions, patches)
        _look(combinations(factors, own), own, patches, places, best)
        yield None
    yield best


def _grey(picture: np.ndarray) -> np.ndarray:
    colours = picture[:3] if len(picture) > 2 else picture[:1]
    out: np.ndarray = colours.mean(axis=0, dtype=np.float32)
    return out


@dividing
def _look(products: Array, own: Array, patches: Array, places: Array, best: Array) -> None:
    """best (n,) = how far the nearest of the patches (d, m) is from each place (d, n), or what was there if less;
    `own` (few, m): the patches in a few directions, `products` (n, m): -2 times these by the places in them."""
    sizes = np.zeros(own.shape[1], np.float32)
    for k in range(own.shape[0]):
        for j in range(sizes.size):
            sizes[j] += own[k, j] * own[k, j]
    for i in range(best.size):
        row, nearest, which = products[i], np.float32(3e38), 0
        for j in range(sizes.size):
            if row[j] + sizes[j] < nearest:
                nearest, which = row[j] + sizes[j], j
        far = np.float32(0.0)
        for k in range(places.shape[0]):
            apart = places[k, i] - patches[k, which]
            far += apart * apart
        best[i] = min(best[i], far)
