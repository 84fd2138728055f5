"""Pictures of a region at half the size: what lies outside the region takes no part, so its rim does not darken."""

from __future__ import annotations

import numpy as np

_KERNEL = (1.0, 3.0, 3.0, 1.0)  # binomial, centred on the four pixels that become one


def halved_region(mask: np.ndarray) -> np.ndarray:
    """A pixel belongs to the region if any of its four finer ones does: bool (h, w) -> ((h + 1) // 2, (w + 1) // 2)."""
    even = np.pad(mask, [(0, n & 1) for n in mask.shape]) if any(n & 1 for n in mask.shape) else mask
    out: np.ndarray = even[::2, ::2] | even[1::2, ::2] | even[::2, 1::2] | even[1::2, 1::2]
    return out


def halved(colours: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Means, under a binomial window, of the region's pixels: float32 (h, w, C) -> ((h + 1) // 2, (w + 1) // 2, C).

    0 where none of the 4 x 4 finer pixels belongs to `mask`, bool (h, w).
    """
    weight = mask.astype(np.float32)[..., None]
    both = np.concatenate([colours * weight, weight], axis=-1)
    for axis in (0, 1):
        both = _halved_along(both, axis)
    out: np.ndarray = both[..., :-1] / np.maximum(both[..., -1:], np.float32(1e-6))
    return out


def _halved_along(values: np.ndarray, axis: int) -> np.ndarray:
    count = (values.shape[axis] + 1) // 2
    sides = [(0, 0)] * values.ndim
    sides[axis] = (1, 2 * count + 2 - 1 - values.shape[axis])
    padded = np.moveaxis(np.pad(values, sides), axis, 0)
    out = np.zeros((count, *padded.shape[1:]), np.float32)
    for i, weight in enumerate(_KERNEL):
        out += np.float32(weight / 8.0) * padded[i : i + 2 * count - 1 : 2]
    return np.moveaxis(out, 0, axis)
