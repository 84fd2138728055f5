"""The surface where a function of space is zero, as a mesh.

Surface nets (Gibson 1998), the dual of marching cubes: one point for each cell that the surface passes, in the middle
of where it cuts the cell's edges, and a square for each edge that it cuts.  Closed wherever the surface keeps away from
the box's walls, with triangles of like size.
"""

from __future__ import annotations

import numpy as np


def zero_surface(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (V, 3) of x, y, z in cells and triangles of the surface around what is below 0 in (nz, ny, nx)."""
    inside = values < 0.0
    cells = np.zeros(tuple(side - 1 for side in values.shape), bool)
    sums = np.zeros((*cells.shape, 3))
    counts = np.zeros(cells.shape)
    for axis in range(3):
        cut, part = _crossed(values, inside, axis)
        for shifts in ((0, 0), (0, 1), (1, 0), (1, 1)):
            where = _around(axis, shifts, cells.shape)
            found = cut[where]
            counts += found
            for other in range(3):
                side = part[where] if other == axis else np.full(found.shape, shifts[_others(axis).index(other)])
                sums[..., other] += np.where(found, side, 0.0)
    cells = counts > 0
    names = np.full(cells.shape, -1)
    names[cells] = np.arange(int(cells.sum()))
    points = np.argwhere(cells) + sums[cells] / counts[cells][:, None]
    return points[:, ::-1].copy(), _squares(inside, names)


def _others(axis: int) -> list[int]:
    return [other for other in range(3) if other != axis]


def _crossed(values: np.ndarray, inside: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """Which edges along an axis are cut, and at what part of them."""
    near = [slice(None)] * 3
    far = [slice(None)] * 3
    near[axis], far[axis] = slice(None, -1), slice(1, None)
    a, b = values[tuple(near)], values[tuple(far)]
    cut = inside[tuple(near)] != inside[tuple(far)]
    return cut, np.where(cut, a / np.where(cut, a - b, 1.0), 0.0)


def _around(axis: int, shifts: tuple[int, int], cells: tuple[int, ...]) -> tuple[slice, ...]:
    """Those edges along an axis that lie at a corner, by `shifts` along the other axes, of every cell."""
    out = [slice(None)] * 3
    for other, shift in zip(_others(axis), shifts, strict=True):
        out[other] = slice(shift, shift + cells[other])
    return tuple(out)


def _squares(inside: np.ndarray, names: np.ndarray) -> np.ndarray:
    """Two triangles between the points of the four cells around each edge that is cut, seen from outside."""
    out = []
    for axis in range(3):
        near = [slice(None)] * 3
        far = [slice(None)] * 3
        near[axis], far[axis] = slice(None, -1), slice(1, None)
        begins, ends = inside[tuple(near)], inside[tuple(far)]
        for cut, turned in ((begins & ~ends, False), (ends & ~begins, True)):
            at = np.argwhere(cut)
            u, v = _others(axis)
            within = [(at[:, other] > 0) & (at[:, other] < inside.shape[other] - 1) for other in (u, v)]
            at = at[within[0] & within[1]]
            corners = []
            for back in ((1, 1), (1, 0), (0, 0), (0, 1)):
                cell = at.copy()
                cell[:, u] -= back[0]
                cell[:, v] -= back[1]
                corners.append(names[tuple(cell.T)])
            a, b, c, d = corners
            # Axes are stored as z, y, x, which turns what is right-handed round; the axis between the others once more.
            if turned != (axis == 1):
                b, d = d, b
            out += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    return np.concatenate(out)
