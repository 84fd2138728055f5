"""Several things in one picture, each cut out by itself."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from engine.numeric.address import Rect

_MOST, _SMALLEST = 24, 0.03  # things of a picture; and of the largest: what is smaller goes with what is nearest
_AROUND = 4  # pixels left clear around each
_SMOOTH, _WIDE = 2.0, 0.32  # of a region: the blur, pixels, and what of it is inside


def things(pixels: np.ndarray) -> list[Rect]:
    """Returns the things of what is cut out, RGBA (h, w, 4), from the largest on, as the rectangles around them."""
    return [rect for rect, _ in _things(pixels)]


def cut_apart(pixels: np.ndarray) -> list[np.ndarray]:
    """Returns the same things, each with nothing beside it, RGBA (h, w, 4)."""
    found = []
    for rect, owned in _things(pixels):
        part = pixels[rect.y0 : rect.y1, rect.x0 : rect.x1].copy()
        part[~owned] = 0
        found.append(part)
    return found


def grown_region(pixels: np.ndarray) -> np.ndarray:
    """Returns the region of a thing as it is to be grown, bool (h, w): all of it that can be seen, rounded, and a
    little more."""
    seen = pixels[..., 3] > 0
    soft = ndimage.gaussian_filter(seen.astype(np.float32), _SMOOTH, mode="constant")
    found: np.ndarray = seen | (soft > _WIDE)
    return found


def _things(pixels: np.ndarray) -> list[tuple[Rect, np.ndarray]]:
    """Returns rectangles, and which of their pixels are the thing's, bool (h, w)."""
    seen = pixels[..., 3] > 0
    solid = pixels[..., 3] > np.iinfo(pixels.dtype).max // 2
    labels, count = ndimage.label(solid, np.ones((3, 3)))
    if not count:
        return []
    sizes = np.bincount(labels.ravel(), minlength=count + 1)
    sizes[0] = 0
    kept = [int(n) for n in np.argsort(-sizes, kind="stable")[:_MOST] if sizes[n] >= _SMALLEST * sizes.max()]
    labels[~np.isin(labels, kept)] = 0
    if len(kept) > 1:
        near = ndimage.distance_transform_edt(labels == 0, return_distances=False, return_indices=True)
        labels = labels[tuple(near)]
    else:
        labels = np.full(labels.shape, kept[0])
    labels = np.where(seen, labels, 0)
    whole = Rect(0, 0, seen.shape[1], seen.shape[0])
    boxes = ndimage.find_objects(labels)
    found = []
    for n in kept:
        rows, columns = boxes[n - 1]
        rect = Rect(columns.start, rows.start, columns.stop, rows.stop).grown(_AROUND).intersect(whole)
        found.append((rect, labels[rect.slices(whole)] == n))
    return found
