"""The rim of what was found, pixel by pixel of the small picture: a random walk among the pixels of the superpixels
about it, with models of the colours nearby."""

from __future__ import annotations

import numpy as np
from scipy import ndimage, sparse

from engine.texture.mattes.belonging import Belonging
from engine.texture.mattes.conjugate import Until, descended
from engine.texture.mattes.patchwork import Patchwork

_AROUND = 5  # superpixels: as far as colours are nearby
_FAR = 0.25  # how much the models of the whole picture count beside those nearby
_PRIOR = 0.6  # how much a pixel's colour counts beside its neighbours
_UNTIL = Until(60, 5e-3)
_RARE = 3e-3  # of any kind of colour
_SPECK, _PINHOLE = 0.015, 0.0008  # of the largest part, and of all that belongs: what is smaller is none
_CLIP = 4.0  # of a logarithm of likelihoods
_MIXED = 0.05  # how much a superpixel at the rim counts for the models, which may hold something of both
_TURNS, _STILL = 3, 0.02  # how often it walks, as long as so much of the band goes over to the other side
_WIDE = 12  # pixels about the rim of superpixels that are looked at anew


def traced(patches: Patchwork, found: Belonging, marks: np.ndarray) -> np.ndarray:
    """Returns how far each pixel of the small picture belongs: float32 (h, w) in 0..1.  `marks`: int8 (h, w), where the
    artist said that it does, 1, or does not, -1."""
    first = (found.inside > 0.5)[patches.labels]
    first = np.where(marks, marks > 0, first)
    out = first.astype(np.float32)
    if found.whole:
        return out
    likely = _likely(patches, found)
    for _ in range(_TURNS):
        band = _band(patches, first) & (marks == 0)
        if not band.any():
            break
        out[band] = _walked(patches.lab, band, first, likely[band])
        moved = (out > 0.5) != first
        first = first ^ moved
        if moved.sum() < _STILL * band.sum():
            break
    return _without_specks(out, marks)


def _without_specks(out: np.ndarray, marks: np.ndarray) -> np.ndarray:
    """Takes away specks of what belongs, and of what does not, but for those that were marked."""
    inside = out > 0.5
    parts, count = ndimage.label(inside)
    if count:
        sizes = np.bincount(parts.ravel())[1:]
        _drop(out, parts, sizes < _SPECK * sizes.max(), marks > 0, 0.0)
    holes, count = ndimage.label(~inside)
    if count:
        sizes = np.bincount(holes.ravel())[1:]
        _drop(out, holes, sizes < _PINHOLE * inside.sum(), marks < 0, 1.0)
    return out


def _drop(out: np.ndarray, parts: np.ndarray, small: np.ndarray, marked: np.ndarray, value: float) -> None:
    gone = np.concatenate([[False], small])
    gone[parts[marked]] = False
    out[gone[parts]] = value


def _band(patches: Patchwork, inside: np.ndarray) -> np.ndarray:
    """Tells which pixels are looked at: those of superpixels that touch the other side, and some about these."""
    edge = _differs(inside)
    touched = np.zeros(patches.count, np.bool_)
    touched[patches.labels[edge]] = True
    around = ndimage.binary_dilation(touched[patches.labels], iterations=_WIDE)
    found: np.ndarray = around & ~patches.holes[patches.labels]
    return found


def _differs(inside: np.ndarray) -> np.ndarray:
    """Tells which pixels have a neighbour on the other side."""
    found = np.zeros(inside.shape, np.bool_)
    across, down = inside[:, 1:] != inside[:, :-1], inside[1:] != inside[:-1]
    found[:, 1:] |= across
    found[:, :-1] |= across
    found[1:] |= down
    found[:-1] |= down
    return found


def _likely(patches: Patchwork, found: Belonging) -> np.ndarray:
    """Returns the logarithm of how much likelier a pixel's colour is inside than on the ground, (h, w)."""
    mixing = patches.graph.copy()
    mixing.data = np.ones_like(mixing.data)
    mixing = (mixing + sparse.identity(patches.count)).tocsr()
    mixing = sparse.diags(1.0 / np.asarray(mixing.sum(axis=1)).ravel()) @ mixing
    inside = found.inside > 0.5
    mixed = np.zeros(patches.count, np.bool_)
    mixed[patches.labels[_differs(inside[patches.labels])]] = True
    clear = np.where(mixed, _MIXED, 1.0) * patches.areas
    kinds, models = patches.coloured, []
    for which in (inside, ~inside & ~patches.holes):
        counts = kinds.shares * (which * clear)[:, None]
        everywhere = counts.sum(axis=0) @ kinds.alike
        for _ in range(_AROUND):
            counts = mixing @ counts
        counts = counts @ kinds.alike
        near = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1e-9)
        models.append((1 - _FAR) * near + _FAR * everywhere / max(everywhere.sum(), 1e-9) + _RARE)
    of_kinds = np.clip(np.log(models[0] / models[1]), -_CLIP, _CLIP)
    likely: np.ndarray = of_kinds[patches.labels, kinds.codes]
    return likely


def _walked(lab: np.ndarray, band: np.ndarray, inside: np.ndarray, likely: np.ndarray) -> np.ndarray:
    """Returns how far each pixel of the band belongs, (n,), where all others are as they are."""
    number = np.full(band.shape, -1, np.int64)
    count = int(band.sum())
    number[band] = np.arange(count)
    belongs = 1.0 / (1.0 + np.exp(-likely))
    weight = _PRIOR * np.abs(2.0 * belongs - 1.0) + 1e-4
    diagonal, target = weight.copy(), weight * (belongs > 0.5)
    rows, columns, values = [], [], []
    usual = _usual_step(lab)
    for axis in (0, 1):
        low, high = _pair(axis)
        step = np.exp(-((lab[low] - lab[high]) ** 2).sum(axis=-1) / usual) + 1e-3
        for here, there in ((low, high), (high, low)):
            mine, other, outer = number[here], number[there], inside[there]
            among = mine >= 0
            diagonal[mine[among]] += step[among]  # no pixel twice
            known = among & (other < 0)
            target[mine[known]] += step[known] * outer[known]
            both = among & (other >= 0)
            rows.append(mine[both])
            columns.append(other[both])
            values.append(-step[both])
    linked = sparse.coo_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (count, count)
    )
    solved = descended(linked.tocsr(), diagonal, target, (belongs > 0.5).astype(np.float64), _UNTIL)
    return np.asarray(np.clip(solved, 0.0, 1.0), np.float32)


def _pair(axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Returns where pixels are, and their next ones along an axis."""
    less, more, every = slice(None, -1), slice(1, None), slice(None)
    return ((less, every), (more, every)) if axis == 0 else ((every, less), (every, more))


def _usual_step(lab: np.ndarray) -> float:
    """Returns the mean of squared steps from pixel to pixel, less than which is none."""
    steps = [
        float(((lab[low] - lab[high]) ** 2).sum(axis=-1).mean()) for low, high in (_pair(0), _pair(1)) if lab[low].size
    ]
    return max(2.0 * sum(steps) / max(1, len(steps)), 1e-6)
