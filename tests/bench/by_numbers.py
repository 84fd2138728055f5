"""Texture-by-numbers in a plain form (Hertzmann et al. 2001, "Image Analogies", sections 3 and 4), which Ritter et al.
2006, section 8, compare painting with examples with.

A pixel of the texture to be made is that of the example whose neighbourhood is most like its own: of label colours, and
of texture above and to the left, and all around under a level coarser.  Labels are compared as colours, so that an edge
between two of them is only known where the example has one of much the same colours.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from engine.numeric.halving import halved

RADIUS = 3
_DY, _DX = (n.reshape(-1) - RADIUS for n in np.indices((2 * RADIUS + 1, 2 * RADIUS + 1)))
_BEFORE = len(_DY) // 2  # pixels of a neighbourhood that are made before its middle
_WINDOW = np.exp(-(_DY**2 + _DX**2) / (2.0 * 2.0**2)).astype(np.float32) ** 0.5
_SAMPLES = 6000  # of which the axes are found
_AT_ONCE = 20000  # vectors
NEARLY = 1.0  # the nearest vector: at most so much farther than it


class Level(NamedTuple):
    """Labels, times their weight, and texture: float32 (h, w, 3), padded by RADIUS."""

    labels: np.ndarray
    texture: np.ndarray


class Data(NamedTuple):
    """What is searched: vectors of all pixels of a level of the example, row by row, along `axes` from `mean`."""

    tree: cKDTree
    mean: np.ndarray
    axes: np.ndarray


class Rules(NamedTuple):
    """`weight` of labels against texture; `kappa`: how much nearer the best match must be than what continues the
    neighbours; `every`: one pixel in so many is searched for in all the example; `axes` of the vectors compared."""

    weight: float = 2.0
    kappa: float = 2.0
    every: int = 4
    levels: int = 3
    axes: int = 32


RULES = Rules()


def sources(labels: np.ndarray, texture: np.ndarray, wanted: np.ndarray, rules: Rules = RULES) -> np.ndarray:
    """Where each pixel comes from in the example: int32 (h, w, 2), row and column.

    `labels`, `texture`: the example, float32 (H, W, 3) in 0..1; `wanted`: the labels to fill, (h, w, 3).  Outside both
    all is as in their upper left corner.
    """
    planes = [labels * rules.weight, texture, wanted * rules.weight, np.zeros_like(wanted)]
    pyramid = [planes]
    for _ in range(rules.levels - 1):
        planes = [halved(plane, np.ones(plane.shape[:2], bool)) for plane in planes]
        pyramid.append(planes)
    example: Level | None = None
    made: Level | None = None
    found = np.empty((0, 0, 2), np.int32)
    for n in reversed(range(rules.levels)):
        above = example, made
        labels, texture, wanted, _ = pyramid[n]
        example = Level(_padded(labels, labels), _padded(texture, texture))
        made = Level(_padded(wanted, wanted), _padded(np.zeros_like(wanted), texture))
        found = _fill(example, made, above, rules, n)
    return found


def _padded(plane: np.ndarray, like: np.ndarray) -> np.ndarray:
    """With a rim of the colour in the upper left corner of `like`."""
    out = np.empty((plane.shape[0] + 2 * RADIUS, plane.shape[1] + 2 * RADIUS, 3), np.float32)
    out[:] = like[0, 0]
    out[RADIUS:-RADIUS, RADIUS:-RADIUS] = plane
    return out


def _fill(example: Level, made: Level, above: tuple[Level | None, Level | None], rules: Rules, n: int) -> np.ndarray:
    """Makes a level in scanline order; pixels on a line x + 4 y = t need only those with a smaller t."""
    data = _data(example, above[0], rules.axes)
    height, width = (s - 2 * RADIUS for s in made.labels.shape[:2])
    columns = example.labels.shape[1] - 2 * RADIUS
    found = np.full((height + 2 * RADIUS, width + 2 * RADIUS, 2), -1, np.int32)
    searched = np.random.default_rng(n).random((height, width)) < 1.0 / rules.every
    closeness = 1.0 + rules.kappa * 2.0**-n
    ys, xs = np.indices((height, width)).reshape(2, -1)
    lines = xs + (RADIUS + 1) * ys
    order = np.argsort(lines, kind="stable")
    for line in np.split(order, np.flatnonzero(np.diff(lines[order])) + 1):
        y, x = ys[line], xs[line]
        vectors = (_vectors(made, above[1], y, x) - data.mean) @ data.axes
        best, distance = _continued(found, example, data, vectors, y, x)
        asked = searched[y, x] | np.isinf(distance)
        if asked.any():
            near, nearest = data.tree.query(vectors[asked], eps=NEARLY)[::-1]
            better = nearest**2 * closeness < distance[asked]
            best[np.flatnonzero(asked)[better]] = near[better]
        found[y + RADIUS, x + RADIUS] = source = np.stack([best // columns, best % columns], -1)
        made.texture[y + RADIUS, x + RADIUS] = example.texture[source[:, 0] + RADIUS, source[:, 1] + RADIUS]
    return found[RADIUS:-RADIUS, RADIUS:-RADIUS]


def _data(example: Level, above: Level | None, axes: int) -> Data:
    ys, xs = np.indices([s - 2 * RADIUS for s in example.labels.shape[:2]]).reshape(2, -1)
    random = np.random.default_rng(0)
    some = random.permutation(len(ys))[:_SAMPLES]
    sample = _vectors(example, above, ys[some], xs[some])
    mean = sample.mean(axis=0)
    spread = (sample - mean).T @ (sample - mean)
    found = random.standard_normal((len(spread), axes))
    for _ in range(8):  # orthogonal iteration
        found = np.linalg.qr(spread @ found)[0]
    found = found.astype(np.float32)
    parts = [slice(first, first + _AT_ONCE) for first in range(0, len(ys), _AT_ONCE)]
    vectors = np.concatenate([(_vectors(example, above, ys[part], xs[part]) - mean) @ found for part in parts])
    return Data(cKDTree(vectors, balanced_tree=False), mean, found)


def _vectors(own: Level, above: Level | None, y: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Weighted values of two-level neighbourhoods: float32 (n, V)."""
    parts = [_around(own.labels, y, x, len(_DY)), _around(own.texture, y, x, _BEFORE)]
    if above is not None:
        parts += [_around(plane, y >> 1, x >> 1, len(_DY)) for plane in above]
    return np.concatenate(parts, axis=1)


def _around(plane: np.ndarray, y: np.ndarray, x: np.ndarray, count: int) -> np.ndarray:
    """The first `count` pixels, in scanline order, of neighbourhoods."""
    rows, columns = (at[:, None] + RADIUS + step[:count] for at, step in ((y, _DY), (x, _DX)))
    return (plane[rows, columns] * _WINDOW[:count, None]).reshape(len(y), -1)


def _continued(found, example, data, vectors, y, x) -> tuple[np.ndarray, np.ndarray]:
    """The coherence search (Ashikhmin 2001): the best of what goes on from the sources of pixels made before, as
    numbers of rows of the data, and its squared distance, inf where there is none."""
    height, width = (s - 2 * RADIUS for s in example.labels.shape[:2])
    dy, dx = _DY[:_BEFORE], _DX[:_BEFORE]
    before = found[y[:, None] + RADIUS + dy, x[:, None] + RADIUS + dx]
    rows, columns = before[..., 0] - dy, before[..., 1] - dx
    there = (before[..., 0] >= 0) & (rows < height) & (columns >= 0) & (columns < width)
    names = np.where(there, rows * width + columns, 0)
    distances = ((data.tree.data[names] - vectors[:, None]) ** 2).sum(-1)
    distances[~there] = np.inf
    least = distances.argmin(axis=1)
    return names[np.arange(len(y)), least], distances[np.arange(len(y)), least]
