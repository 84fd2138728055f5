"""Meshes: triangles whose corners have normals, of a size that fits the unit ball's cube."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CREASE = 40.0  # degrees between triangles from which on an edge stays sharp
_MOST_CORNERS = 48  # of one point are compared with one another; beyond, a point is smooth


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """`points` and `normals`: float64 (V, 3), z upwards; `faces`: int32 (F, 3), seen from outside against the clock;
    `places`: (V, 2), where a picture wrapped around it has each point, 0..1, or None."""

    points: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    places: np.ndarray | None = None


def welded(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points that are one within a millionth of the size become one; triangles without area go."""
    first, names = one_places(points)
    together = names[faces]
    a, b, c = together.T
    return points[first], together[(a != b) & (b != c) & (c != a)].astype(np.int32)


def one_places(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns of points, of which those within a millionth of the size are at one place, the first at each place, and
    for each point the number of its place."""
    size = max(float(np.ptp(points, axis=0).max(initial=0.0)), 1e-30)
    keys = np.rint((points - points.min(axis=0, initial=np.inf)) * (1e6 / size)).astype(np.int64)
    _, first, names = np.unique(_packed(keys, 21), return_index=True, return_inverse=True)
    return first, names.reshape(-1)


def unit_sized(points: np.ndarray) -> np.ndarray:
    """Points moved and scaled, alike in all directions, so that their box is around 0 and 2 long."""
    low, high = points.min(axis=0), points.max(axis=0)
    out: np.ndarray = (points - (low + high) / 2.0) * (2.0 / max(float((high - low).max()), 1e-30))
    return out


def face_normals(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Returns the normals of triangles, of length 1, or 0 where one has no area: float64 (F, 3)."""
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    out = np.cross(b - a, c - a)
    return unit(out)


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors along the last axis at length 1, those of no length as they are."""
    length = np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True))
    out: np.ndarray = vectors / np.where(length > 1e-300, length, 1.0)
    return out


def meshed(points: np.ndarray, faces: np.ndarray, crease: float = CREASE) -> Mesh:
    """Returns the mesh of points (V, 3) and triangles (F, 3), welded: normals are the mean of those of the triangles
    around, by their angles there; across edges sharper than `crease` degrees a point has several."""
    points, faces = welded(points, faces)
    flat = face_normals(points, faces)
    corners = faces.reshape(-1)
    weighted = (flat[:, None] * _angles(points, faces)[..., None]).reshape(-1, 3)
    order = np.argsort(corners, kind="stable")
    starts = np.searchsorted(corners[order], np.arange(len(points) + 1))
    counts = np.diff(starts)
    total = np.zeros((len(points), 3))
    np.add.at(total, corners, weighted)
    normals = total[corners]
    own = np.repeat(flat, 3, axis=0)
    near = np.zeros_like(weighted)
    least = np.cos(np.radians(crease))
    for turn in range(min(int(counts.max(initial=0)), _MOST_CORNERS)):
        has = turn < counts[corners]
        other = order[np.where(has, starts[corners] + turn, 0)]
        joins = has & ((own * own[other]).sum(axis=1) >= least)
        near[joins] += weighted[other[joins]]
    split = counts[corners] <= _MOST_CORNERS
    normals[split] = near[split]
    return _distinct(points, corners, unit(normals))


def _distinct(points: np.ndarray, corners: np.ndarray, normals: np.ndarray) -> Mesh:
    """The mesh in which corners of one point and one normal are one."""
    directions = _packed(np.rint((normals + 1.0) * 2048.0).astype(np.int64), 13)
    _, first, names = np.unique((corners.astype(np.int64) << 39) | directions, return_index=True, return_inverse=True)
    return Mesh(points[corners[first]], normals[first], names.reshape(-1, 3).astype(np.int32))


def _packed(keys: np.ndarray, bits: int) -> np.ndarray:
    """Rows of three whole numbers as one each."""
    out: np.ndarray = (keys[:, 0] << (2 * bits)) | (keys[:, 1] << bits) | keys[:, 2]
    return out


def _angles(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The angles of triangles at their corners, radians (F, 3)."""
    out = np.empty(faces.shape)
    for corner in range(3):
        here, then, last = (points[faces[:, (corner + turn) % 3]] for turn in range(3))
        cosine = (unit(then - here) * unit(last - here)).sum(axis=1)
        out[:, corner] = np.arccos(np.clip(cosine, -1.0, 1.0))
    return out


def together(parts: list[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
    """Several lists of points and triangles as one."""
    before = np.cumsum([0, *(len(points) for points, _ in parts)])
    faces = [faces + start for (_, faces), start in zip(parts, before, strict=False)]
    return np.concatenate([points for points, _ in parts]), np.concatenate(faces)


def grid_mesh(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A grid of points (rows, columns, 3) as points and triangles, outside where columns x rows points to."""
    height, width = points.shape[:2]
    i, j = (axis.reshape(-1) for axis in np.meshgrid(np.arange(width - 1), np.arange(height - 1)))
    a = j * width + i
    b, c, d = a + 1, a + width, a + width + 1
    triangles = np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])
    return points.reshape(-1, 3), triangles


def open_edges(mesh: Mesh) -> int:
    """Returns how many edges, of points that are one, have not as many triangles on one side as on the other."""
    points, faces = welded(mesh.points, mesh.faces)
    edges = np.concatenate([faces[:, (0, 1)], faces[:, (1, 2)], faces[:, (2, 0)]]).astype(np.int64)
    low, high = edges.min(axis=1), edges.max(axis=1)
    _, names = np.unique(low * len(points) + high, return_inverse=True)
    sides = np.bincount(names, np.where(edges[:, 0] == low, 1.0, -1.0))
    return int((sides != 0.0).sum())


def volume(mesh: Mesh) -> float:
    """Returns the volume inside; negative if triangles are seen from inside."""
    a, b, c = (mesh.points[mesh.faces[:, corner]] for corner in range(3))
    return float((a * np.cross(b, c)).sum() / 6.0)
