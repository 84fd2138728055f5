"""Maps maps_fitted to a picture: how its pixels follow from those twice as large.

For each kind of neighbourhood least squares tell what the finer pixels differ by; a kind that is seldom seen leans on
the map of all, and that on plain expansion.  What the maps leave over, a neighbourhood's covariance has told: its root
makes the like of white noise.  Of that, large parts count little: an edge that is foretold a little wrong is no grain.

A picture whose finest octave is blurred away is looked at from the first on that is not.  What is added is no
stronger than the slope of the picture's octaves tells.  Print and lone hairs are too fine for their pixels: there the
last octave is the roughest, and its steps and rows, learnt, would come again half as large; so little is made of them.
The same bits on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.colour_axes import axes_of
from engine.numeric.hashing import hash_plane
from engine.numeric.matrices import combinations, products
from engine.numeric.pyramid import reduce
from engine.numeric.solving import solved
from engine.numeric.symmetric import eigenvectors, product
from engine.texture.continuation import slope_of
from engine.texture.learnt.kinds import LOOKED_ROUND, kinds_of, liveliness
from engine.texture.learnt.maps import NEIGHBOURHOODS, NOISY, TAPPED, TAPS, Maps, nothing_learnt, rounded
from engine.texture.learnt.refining import along_axes, refined

LOOKED_AT = 512  # pixels of a picture each way that are learnt from
_LARGE = 1024  # pixels along a side of a picture that is learnt from in several places
_STEEPER = (0.3, 0.6, 0.85)  # parts of all pixels that are less steep, between kinds
_LEANING = 300.0  # pixels that the map of all counts for beside those of a kind
_GRAINS = 120.0  # the same, of what is left over
_RIDGE = 1e-3  # of a neighbourhood's variance, for plain expansion
_FEW = 8
_DULLEST = np.float32(0.2)  # part of the usual noise below which what is left over tells nothing
_TRIED = 96  # pixels each way on which the strength of what comes out is measured
_LOUD = 0.65, 0.5  # of the slope, how strong noise is in each octave


def pieces(width: int, height: int) -> list[Rect]:
    """Returns the parts of a picture that are learnt from: all of it, its middle, or of a large one four parts."""
    across, down = width, height
    if max(width, height) <= _LARGE:
        across, down = min(width, LOOKED_AT), min(height, LOOKED_AT)
        return [Rect.at((width - across) // 2, (height - down) // 2, across, down)]
    across, down = min(width // 2, LOOKED_AT // 2), min(height // 2, LOOKED_AT // 2)
    corners = [(x, y) for y in _quarters(height, down) for x in _quarters(width, across)]
    return [Rect.at(x, y, max(across, 1), max(down, 1)) for x, y in corners]


def _quarters(size: int, part: int) -> tuple[int, int]:
    return (size // 4 - part // 2, size - size // 4 - part // 2 - 1)


def maps_fitted(pictures: Sequence[np.ndarray]) -> Maps:
    """Returns the maps of parts of a picture, all of one size: (C, h, w), float32 in 0..1, grey, RGB or premultiplied
    RGBA."""
    whole = np.concatenate(list(pictures), axis=2)
    axes = _unit_axes(whole)
    finest, slope = slope_of(pictures[-1], EVERYWHERE)
    fine = [along_axes(picture, axes) for picture in pictures]
    for _ in range(finest):
        fine = [_halved(planes) for planes in fine]
    maps = _calmed(_learnt(fine, axes), fine)
    strong = math.sqrt(sum(_roughness(planes) ** 2 for planes in fine) / len(fine))
    return _quietened(maps, pictures[-1], finest, slope, strong)


def _middle(picture: np.ndarray, side: int) -> np.ndarray:
    top, left = (max(0, (n - side) // 2) for n in picture.shape[1:])
    return np.ascontiguousarray(picture[:, top : top + side, left : left + side])


def _unit_axes(picture: np.ndarray) -> np.ndarray:
    """Returns the axes of a picture's colours, (R, C), the longest first."""
    found = axes_of(picture, EVERYWHERE).axes.astype(np.float64)
    long = np.sqrt(sum((row * row for row in found), np.zeros(found.shape[1])))
    return rounded(np.ascontiguousarray((found / np.maximum(long, 1e-12)).T))


def _halved(planes: np.ndarray) -> np.ndarray:
    return reduce(_even(planes))


def _even(planes: np.ndarray) -> np.ndarray:
    _, height, width = planes.shape
    return np.ascontiguousarray(planes[:, : height // 2 * 2, : width // 2 * 2])


def _learnt(parts: Sequence[np.ndarray], axes: np.ndarray) -> Maps:
    """Returns maps from parts of planes (R, h, w) along the axes."""
    count = len(axes)
    maps = nothing_learnt(axes)
    maps.sharp[..., :3] = rounded(_plain())
    parts = [_even(fine) for fine in parts]
    coarse = [reduce(fine) for fine in parts]
    if not count or min(coarse[0].shape[1:]) < 2 * LOOKED_ROUND + _FEW:
        return maps
    steep = np.concatenate([kinds_of(planes[0], maps.edges)[1].reshape(-1) for planes in coarse])
    ordered = np.sort(np.sqrt(steep))
    edges = rounded(ordered[[int(part * ordered.size) for part in _STEEPER]])
    kinds = np.concatenate([kinds_of(planes[0], edges)[0].reshape(-1) for planes in coarse])
    lively = np.maximum(liveliness(steep, edges), _DULLEST)
    for axis in range(count):
        seen = [_near(planes[axis], fine[axis]) for planes, fine in zip(coarse, parts, strict=True)]
        near, found = (np.concatenate(one, axis=1) for one in zip(*seen, strict=True))
        left = _learn(near, found, kinds, maps.sharp[:, axis, :, :3])
        size = coarse[0].shape[1] - 2 * LOOKED_ROUND, coarse[0].shape[2] - 2 * LOOKED_ROUND
        _learn_noise((left / lively).reshape(3, len(parts), *size), kinds, maps.rough[:, axis, :, :3])
    return replace(maps, edges=edges)


def _calmed(maps: Maps, parts: Sequence[np.ndarray]) -> Maps:
    """Returns maps that are nearer to plain expansion, the more the finest octave is rougher than the next one."""
    rough, next_ = (sum(_roughness(p) ** 2 for p in some) for some in (parts, [_halved(p) for p in parts]))
    if rough <= next_ or next_ <= 0.0:
        return maps
    part = next_ / rough * math.sqrt(next_ / rough)
    sharp = maps.sharp.copy()
    sharp[..., :3] = rounded(_plain() + part * (maps.sharp[..., :3] - _plain()))
    return replace(maps, sharp=sharp, rough=rounded(part * maps.rough))


def _near(coarse: np.ndarray, fine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns what neighbours of the inner pixels of a plane differ by from these, (TAPS, pixels), and what their finer
    pixels differ by, (3, pixels)."""
    inner = slice(LOOKED_ROUND, -LOOKED_ROUND)
    near = _places(coarse, TAPPED) - coarse[inner, inner].reshape(1, -1)
    return near, np.ascontiguousarray(_differences(fine)[:, inner, inner]).reshape(3, -1)


def _learn(near: np.ndarray, found: np.ndarray, kinds: np.ndarray, sharp: np.ndarray) -> np.ndarray:
    """Writes the maps along one axis, of all kinds; returns what they leave over, (3, pixels)."""
    count, ridge = near.shape[1], np.eye(TAPS)
    all_, to = products(near, near) / count, products(near, found) / count
    size = max(float(np.trace(all_)) / TAPS, 1e-12)
    ridge *= _RIDGE * size
    usual = solved(all_ + ridge, to + product(ridge, _plain()))
    left = found.copy()
    for kind in range(NEIGHBOURHOODS):
        which = np.flatnonzero(kinds == kind)
        own, seen = np.ascontiguousarray(near[:, which]), np.ascontiguousarray(found[:, which])
        among = products(own, own) if which.size else np.zeros((TAPS, TAPS))
        between = products(own, seen) if which.size else np.zeros((TAPS, 3))
        part = float(np.trace(among)) / TAPS / max(which.size, 1) / size if which.size else 1.0
        lean = (all_ + ridge) * (_LEANING * max(part, 1e-6))
        sharp[kind] = rounded(solved(among + lean, between + product(lean, usual)))
        if which.size:
            left[:, which] -= combinations(np.ascontiguousarray(sharp[kind].T), own)
    return left


def _learn_noise(left: np.ndarray, kinds: np.ndarray, rough: np.ndarray) -> None:
    """Writes the maps from noise, of all kinds; `left` (3, parts, h, w): what the others leave over."""
    padded = np.pad(left, ((0, 0), (0, 0), (1, 1), (1, 1)), mode="reflect")
    around = np.stack([np.concatenate([_places(one, 3) for one in part], axis=1) for part in padded], axis=1)
    around = around.reshape(3 * NOISY, kinds.size)  # the three numbers of a pixel together
    own = slice(3 * (NOISY // 2), 3 * (NOISY // 2) + 3)
    every = products(around, around) / around.shape[1]
    size = max(float(np.trace(every[own, own])), 1e-20)
    for kind in range(NEIGHBOURHOODS):
        which = np.flatnonzero(kinds == kind)
        if which.size <= _FEW:
            continue
        seen = np.ascontiguousarray(around[:, which])
        energy = sum((row * row for row in seen[own].astype(np.float64)), np.zeros(which.size))
        usual = float(np.sort(energy)[which.size // 2])
        weight = 1.0 / (1.0 + energy / (2.0 * usual + 1e-12))
        total = sum(weight.tolist())
        weighted = (seen * np.sqrt(weight)).astype(np.float32)
        mine = products(weighted, weighted) / total
        like = every * (float(np.trace(mine[own, own])) / size)
        mixed = (mine * which.size + like * _GRAINS) / (which.size + _GRAINS)
        rough[kind] = rounded(_root(mixed)[:, own])


def _root(matrix: np.ndarray) -> np.ndarray:
    """Returns the symmetric root of a covariance."""
    values, vectors = eigenvectors(matrix)
    return product(np.ascontiguousarray(vectors * np.sqrt(np.maximum(values, 0.0))), np.ascontiguousarray(vectors.T))


def _places(plane: np.ndarray, side: int) -> np.ndarray:
    """Returns the neighbourhoods of the inner pixels of a plane: float32 (side side, pixels)."""
    height, width = plane.shape[0] - side + 1, plane.shape[1] - side + 1
    parts = [plane[j : j + height, i : i + width].reshape(-1) for j in range(side) for i in range(side)]
    return np.ascontiguousarray(np.stack(parts), np.float32)


def _differences(fine: np.ndarray) -> np.ndarray:
    """Returns what four pixels of a plane differ by from their mean, across, down and crosswise: float32 (3, h, w)."""
    a, b, c, d = fine[::2, ::2], fine[::2, 1::2], fine[1::2, ::2], fine[1::2, 1::2]
    quarter = np.float32(0.25)
    out: np.ndarray = np.stack([(a - b) + (c - d), (a - c) + (b - d), (a - b) - (c - d)]) * quarter
    return out


def _plain() -> np.ndarray:
    """Returns the map that expansion is: float64 (TAPS, 3)."""
    slope, middle = np.array([0.0, 1.0, 0.0, -1.0, 0.0]) / 8.0, np.array([0.0, 1.0, 6.0, 1.0, 0.0]) / 8.0
    maps = [middle[:, None] * slope, slope[:, None] * middle, slope[:, None] * slope]
    return np.stack([one.reshape(-1) for one in maps], axis=1)


def _roughness(fine: np.ndarray) -> float:
    """Tells how strong the finest octave of planes is: the standard deviation of their differences."""
    return _spread(np.stack([_differences(plane) for plane in _even(fine)])) if fine.size else 0.0


def _spread(values: np.ndarray) -> float:
    flat = np.ascontiguousarray(values.reshape(1, -1), np.float32)
    return math.sqrt(float(products(flat, flat)[0, 0]) / max(flat.size, 1))


def _quietened(maps: Maps, picture: np.ndarray, finest: int, slope: float, strong: float) -> Maps:
    """Returns maps whose octaves, tried on the picture, are no stronger than the slope tells: `strong` is the octave
    that they were learnt from."""
    planes = _middle(picture, _TRIED)
    for octave, part in enumerate(_LOUD):
        loud = part * slope
        wanted = strong * slope ** (finest + octave + 1)
        without, with_ = (
            _tried(planes, replace(maps, loud=np.full(2, amount, np.float32)), octave) for amount in (0.0, loud)
        )
        grain = max(with_**2 - without**2, 0.0)
        if with_ > wanted and grain > 0.0:
            loud *= math.sqrt(min(max(wanted**2 - without**2, 0.0) / grain, 1.0))
        maps.loud[octave] = rounded(np.array([loud]))[0]
        planes = _octave(planes, maps, octave)
    return maps


def _tried(planes: np.ndarray, maps: Maps, octave: int) -> float:
    fine = along_axes(_octave(planes, maps, octave), maps.axes)
    return _roughness(fine)


def _octave(planes: np.ndarray, maps: Maps, octave: int) -> np.ndarray:
    """Returns the finer pixels of planes within their rim."""
    if min(planes.shape[1:]) <= 2 * LOOKED_ROUND:
        return planes
    height, width = planes.shape[1] - 2 * LOOKED_ROUND, planes.shape[2] - 2 * LOOKED_ROUND
    hashes = hash_plane(octave, 0, 0, width + 2, height + 2)
    return refined(np.ascontiguousarray(planes), hashes, maps, octave)
