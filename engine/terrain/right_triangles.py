"""Meshes of heights: right-angled triangles, halved where the land asks for it (Evans, Kirkpatrick, Townsend 2001).

A triangle's hypotenuse is bisected until what that leaves out is within the tolerance.  The usual measure, the worst
single step of a triangle and its descendants, bounds nothing: steps add up down the chain, to four times the tolerance.
Here a middle's error is its own step **plus** the worst of its children's, which is a true bound of how far the mesh is
from any sample; and as both triangles at a hypotenuse ask the same middle, there are no gaps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

MOST_CELLS = 8192  # of a side


@dataclass(frozen=True)
class Mesh:
    """`places` (n, 2): column and row of each vertex, `faces` (m, 3), counterclockwise seen from above where rows go
    down."""

    places: np.ndarray
    faces: np.ndarray


@dataclass(frozen=True)
class Bounds:
    """What may be left out of heights: `errors` (side + 1, side + 1) float32, of the triangles whose hypotenuse's
    middle lies there; `columns`, `rows`: cells of the heights."""

    errors: np.ndarray
    columns: int
    rows: int

    @property
    def side(self) -> int:
        """Gives the cells of a side, a power of two, of the square that is halved."""
        return len(self.errors) - 1

    def worst(self) -> float:
        """Returns the tolerance from which on a mesh has as few triangles as it can have."""
        return float(np.max(self.errors, where=np.isfinite(self.errors), initial=0.0))


def errors_of(heights: np.ndarray) -> Bounds:
    """Returns the bounds of heights (h, w), both at least 2.  Where they do not fill the square, triangles across
    their rim have no bound: they are always halved."""
    rows, columns = heights.shape[0] - 1, heights.shape[1] - 1
    side = 1 << max(rows - 1, columns - 1, 0).bit_length()
    h = np.pad(heights.astype(np.float32), ((0, side - rows), (0, side - columns)), mode="edge")
    errors = np.zeros_like(h)
    step = 2
    while step <= side:
        _straight(h, errors, step, (rows, columns))
        _straight(h.T, errors.T, step, (columns, rows))
        _diagonal(h, errors, step, (rows, columns))
        step *= 2
    return Bounds(errors, columns, rows)


def _straight(h: np.ndarray, errors: np.ndarray, step: int, size: tuple[int, int]) -> None:
    """Of triangles whose hypotenuse lies along a row, `step` long."""
    half = step // 2
    worst = np.zeros_like(h[::step, half::step])
    if half > 1:
        below = errors[half // 2 :: half, half // 2 :: half]
        below = np.maximum(below[:, ::2], below[:, 1::2])
        worst[1:] = below[1::2]
        worst[:-1] = np.maximum(worst[:-1], below[::2])
    own = np.abs(0.5 * (h[::step, :-1:step] + h[::step, step::step]) - h[::step, half::step])
    y, x = np.arange(0, len(h), step)[:, None], np.arange(half, len(h), step)[None]
    torn = np.zeros(own.shape, bool)
    for top in (y, y - half):
        past = (x - half >= size[1]) | (top >= size[0]) | (top < 0)
        torn |= ((x + half > size[1]) | (top + half > size[0])) & ~past
    errors[::step, half::step] = np.where(torn, np.inf, own + worst)


def _diagonal(h: np.ndarray, errors: np.ndarray, step: int, size: tuple[int, int]) -> None:
    """Of triangles whose hypotenuse is a square's diagonal, which turns from each square to the next."""
    half = step // 2
    falling = 0.5 * (h[:-1:step, :-1:step] + h[step::step, step::step])
    rising = 0.5 * (h[:-1:step, step::step] + h[step::step, :-1:step])
    count = np.arange(len(falling))
    odd = (count[:, None] + count[None]) % 2 == 1
    own = np.abs(np.where(odd, rising, falling) - h[half::step, half::step])
    rows, columns = errors[half::step, ::step], errors[::step, half::step]
    worst = np.maximum(np.maximum(rows[:, :-1], rows[:, 1:]), np.maximum(columns[:-1], columns[1:]))
    y, x = count[:, None] * step, count[None] * step
    torn = ((x + step > size[1]) | (y + step > size[0])) & (x < size[1]) & (y < size[0])
    errors[half::step, half::step] = np.where(torn, np.inf, own + worst)


def mesh_within(bounds: Bounds, tolerance: float) -> Mesh:
    """Returns the mesh that is nowhere farther than `tolerance` from a sample."""
    columns, rows, side = bounds.columns, bounds.rows, bounds.side
    todo = np.array([[0, 0, side, side, side, 0], [side, side, 0, 0, 0, side]], np.int32)
    done: list[np.ndarray] = []
    while len(todo):
        x, y = todo[:, ::2], todo[:, 1::2]
        todo = todo[(x.min(axis=1) < columns) & (y.min(axis=1) < rows)]
        ax, ay, bx, by, cx, cy = todo.T
        mx, my = (ax + bx) >> 1, (ay + by) >> 1
        split = (np.abs(ax - cx) + np.abs(ay - cy) > 1) & (bounds.errors[my, mx] > tolerance)
        done.append(todo[~split])
        ax, ay, bx, by, cx, cy, mx, my = (v[split] for v in (ax, ay, bx, by, cx, cy, mx, my))
        todo = np.concatenate([np.stack([cx, cy, ax, ay, mx, my], 1), np.stack([bx, by, cx, cy, mx, my], 1)])
    found = np.concatenate(done).astype(np.int64)
    corners = found[:, 1::2] * (columns + 1) + found[:, ::2]
    used, faces = np.unique(corners, return_inverse=True)
    places = np.stack([used % (columns + 1), used // (columns + 1)], 1)
    return Mesh(places, faces.reshape(-1, 3).astype(np.int64))


def mesh_of_at_most(bounds: Bounds, most: int, closed: bool) -> tuple[Mesh, float]:
    """Returns the finest mesh of at most `most` triangles, those of its base included if it is `closed`, and the
    tolerance that it keeps; ValueError if there is none so coarse."""
    coarse = bounds.worst()
    mesh = mesh_within(bounds, coarse)
    if count_of(mesh, bounds, closed) > most:
        found = count_of(mesh, bounds, closed)
        raise ValueError(f"found {most} triangles, expected at least {found} for {bounds.columns} x {bounds.rows}")
    whole = mesh_within(bounds, 0.0)
    if count_of(whole, bounds, closed) <= most:
        return whole, 0.0
    fine = 0.0
    for _ in range(24):
        middle = 0.5 * (fine + coarse)
        tried = mesh_within(bounds, middle)
        if count_of(tried, bounds, closed) <= most:
            mesh, coarse = tried, middle
        else:
            fine = middle
        if coarse - fine < 1e-3 * coarse:
            break
    return mesh, coarse


def count_of(mesh: Mesh, bounds: Bounds, closed: bool) -> int:
    """Returns how many triangles a mesh has, with a base or without."""
    return len(mesh.faces) + (3 * len(rim_of(mesh, bounds.columns, bounds.rows)) if closed else 0)


def rim_of(mesh: Mesh, columns: int, rows: int) -> np.ndarray:
    """Returns the vertices along the rim, in the order in which they lie there: clockwise where rows go down."""
    x, y = mesh.places.T
    sides = ((y == 0, x), (x == columns, y), (y == rows, -x), (x == 0, -y))
    found = []
    for on, along in sides:
        these = np.nonzero(on)[0]
        found.append(these[np.argsort(along[these])][:-1])
    return np.concatenate(found)


def closed_block(mesh: Mesh, positions: np.ndarray, size: tuple[int, int], floor: float) -> tuple[np.ndarray, ...]:
    """Returns (positions, faces) of a closed body: `positions` (n, 3) of a mesh's vertices, z up, rows going towards
    -y; walls from its rim, of the same vertices; a flat base at `floor`.  `size`: its columns and rows of cells."""
    rim = rim_of(mesh, *size)
    count, around = len(positions), len(rim)
    below = positions[rim].copy()
    below[:, 2] = floor
    middle = 0.5 * (below.min(axis=0) + below.max(axis=0))
    here = np.arange(around)
    following = (here + 1) % around
    a, b = rim[here], rim[following]
    fa, fb = count + here, count + following
    walls = np.concatenate([np.stack([a, b, fa], 1), np.stack([b, fb, fa], 1)])
    base = np.stack([fa, fb, np.full(around, count + around)], 1)
    return np.concatenate([positions, below, middle[None]]), np.concatenate([mesh.faces, walls, base])
