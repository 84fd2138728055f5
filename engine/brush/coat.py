"""Kernels that turn a tile's coverage into the A and B of its stamp.  All results lie on the grid 2^-16."""

from __future__ import annotations

import numpy as np

from engine.numeric.address import TILE
from engine.numeric.grid import SNAP, snap
from engine.numeric.kernel import kernel
from engine.numeric.stand_in import or_plain

_ONE = np.float32(1.0)


def _keep_of(coverage: np.ndarray, keep: np.ndarray) -> bool:
    """As `keep_of`, plainly."""
    np.subtract(_ONE, (coverage + SNAP) - SNAP, out=keep)
    return bool((keep < _ONE).any())


@or_plain(_keep_of)
@kernel
def keep_of(coverage: np.ndarray, keep: np.ndarray) -> bool:
    """Returns a = 1 - snap(M) into `keep`; False if A is 1 everywhere.  Both float32 (h, w)."""
    covered = 0
    for y in range(coverage.shape[0]):
        m, a = coverage[y], keep[y]
        for x in range(m.shape[0]):
            a[x] = _ONE - snap(m[x])
            covered += a[x] < _ONE  # an integer sum vectorises, a float minimum does not
    return covered > 0


@kernel
def _weigh_locked(keep: np.ndarray, alpha: np.ndarray, weight: np.ndarray, add_alpha: np.ndarray) -> None:
    for y in range(keep.shape[0]):
        a, v, w, b = keep[y], alpha[y], weight[y], add_alpha[y]
        for x in range(a.shape[0]):
            w[x] = (_ONE - a[x]) * v[x]
            b[x] = v[x] - snap(a[x] * v[x])


def weigh(keep: np.ndarray, alpha: np.ndarray, locked: bool, add_alpha: np.ndarray) -> np.ndarray:
    """Returns the weight of new colour, float32 (h, w): M, or M times `alpha` where that is locked.

    Writes the alpha plane of B into `add_alpha`: M, or exactly what A takes from `alpha`.
    """
    weight = np.empty_like(keep)
    if locked:
        _weigh_locked(keep, np.ascontiguousarray(alpha), weight, add_alpha)
    else:
        np.subtract(_ONE, keep, out=weight)
        add_alpha[...] = weight
    return weight


@kernel
def wash(weight: np.ndarray, colour: np.ndarray, add: np.ndarray) -> None:
    """B = snap(weight * colour): `weight` float32 (h, w), `colour` float32 (n,), `add` float32 (n, h, w)."""
    for c in range(add.shape[0]):
        value = colour[c]
        for y in range(weight.shape[0]):
            w, b = weight[y], add[c, y]
            for x in range(w.shape[0]):
                b[x] = snap(w[x] * value)


@kernel
def glaze(weight: np.ndarray, colours: np.ndarray, add: np.ndarray) -> None:
    """B = snap(weight * colours): `weight` float32 (h, w), `colours` and `add` float32 (n, h, w)."""
    for c in range(add.shape[0]):
        for y in range(weight.shape[0]):
            w, p, b = weight[y], colours[c, y], add[c, y]
            for x in range(w.shape[0]):
                b[x] = snap(w[x] * p[x])


def _lay(keep: np.ndarray, colour: np.ndarray, add: np.ndarray) -> None:
    """As `lay`, plainly."""
    add[3] = _ONE - keep
    add[:3] = (add[3] * colour[:, None, None] + SNAP) - SNAP


@or_plain(_lay)
@kernel
def lay(keep: np.ndarray, colour: np.ndarray, add: np.ndarray) -> None:
    """B of plain paint in one pass, as `weigh` and `wash` make it: with M = 1 - A, add[0:3] = snap(M colour), add[3] =
    M.  `keep` float32 (h, w), `colour` (3,), `add` (4, h, w)."""
    for y in range(keep.shape[0]):
        a, w = keep[y], add[3, y]
        for x in range(a.shape[0]):
            w[x] = _ONE - a[x]
        for c in range(3):
            value, b = colour[c], add[c, y]
            for x in range(a.shape[0]):
                b[x] = snap(w[x] * value)


@kernel
def load(keep: np.ndarray, colours: np.ndarray, amplitudes: np.ndarray, add: np.ndarray) -> None:
    """B of textured paint in one pass, as `weigh`, `glaze` and `wash` make it: with M = 1 - A, add[0:3] = snap(M
    colours), add[3] = M, add[4 + i] = snap(M amplitudes[i]).

    `keep` float32 (h, w), `colours` (3, h, w), `amplitudes` (k,), `add` (4 + k, h, w).
    """
    for y in range(keep.shape[0]):
        a, w = keep[y], add[3, y]
        for x in range(a.shape[0]):
            w[x] = _ONE - a[x]
        for c in range(3):
            p, b = colours[c, y], add[c, y]
            for x in range(a.shape[0]):
                b[x] = snap(w[x] * p[x])
        for i in range(amplitudes.shape[0]):
            value, b = amplitudes[i], add[4 + i, y]
            for x in range(a.shape[0]):
                b[x] = snap(w[x] * value)


@kernel
def stain(part: np.ndarray, colour: np.ndarray, add: np.ndarray) -> None:
    """Turns some of the paint to another colour: B of `load`, `lay` or `wash`, float32 (4 + 3n, h, w), in place.

    `part`: how much of it, 0..1, float32 (h, w); `colour` float32 (3,).  Ink of what turns is gone.
    """
    for y in range(part.shape[0]):
        t, w = part[y], add[3, y]
        for c in range(3):
            value, b = colour[c], add[c, y]
            for x in range(t.shape[0]):
                b[x] = snap(b[x] + t[x] * (w[x] * value - b[x]))
        for c in range(4, add.shape[0]):
            b = add[c, y]
            for x in range(t.shape[0]):
                b[x] = snap(b[x] - t[x] * b[x])


def local_mean(planes: np.ndarray, reach: int) -> np.ndarray:
    """Returns the mean of each pixel's surroundings: two passes of a box of 2 reach + 1 px along each axis.

    `planes`: float32 (n, 128 + 4 reach, 128 + 4 reach) on the grid; returns float32 (n, 128, 128).  The sums are
    exact in float64, so the result does not depend on their order.
    """
    width = 2 * reach + 1
    out = np.empty((len(planes), TILE, TILE), np.float32)
    for plane, mean in zip(planes, out, strict=True):
        down = _box(_box(plane.astype(np.float64), width), width)
        across = _box(_box(np.ascontiguousarray(down.T), width), width)
        np.divide(across.T, float(width**4), out=mean, casting="same_kind")
    return out


@kernel
def _box(values: np.ndarray, width: int) -> np.ndarray:
    """Sums of `width` successive rows: float64 (h, w) to (h - width + 1, w)."""
    out = np.empty((values.shape[0] - width + 1, values.shape[1]))
    total = np.zeros(values.shape[1])
    for y in range(values.shape[0]):
        come, gone, o = values[y], values[max(y - width, 0)], out[max(y - width + 1, 0)]
        full = 1.0 if y >= width else 0.0  # whether there is a row to take away
        for x in range(total.shape[0]):
            total[x] += come[x] - full * gone[x]
            o[x] = total[x]
    return out
