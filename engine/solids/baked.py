"""Meshes that carry the colours of a solid at their corners, for programs that know nothing of solids.

Edges are halved where the colour between their ends is not what lies half-way between theirs, the worst first, until
all are or there are as many triangles as there may be.  Whether an edge is halved depends on its ends' places alone,
so triangles beside each other, also across a sharp edge, stay closed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.solids.mesh import one_places, unit
from engine.solids.solid_rendering import Body

FEWEST, MOST = 1_000, 4_000_000  # triangles that may be asked for
ENOUGH = 400_000
_LIKE = 0.03  # of white: so far a colour may be from what corners tell
_FIRST = 0.12  # of half the object: no edge is longer
_SHARE = 0.6  # of the room that is left, which one round may take
_CORNERS = (0, 1), (1, 2), (2, 0)


@dataclass(frozen=True, slots=True, eq=False)
class Baked:
    """`points` and `normals`: float64 (V, 3), of length 1, z upwards; `faces`: int32 (F, 3); `colours`: (V, 3), 0..1 as
    a screen shows them; `error`: how far those of edges' middles are from what they are, at most."""

    points: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    colours: np.ndarray
    error: float


class _Growing:
    """A mesh that is divided: corners have `names`, which those at one place share."""

    def __init__(self, body: Body, most: int) -> None:
        mesh = body.mesh
        self.points, self.normals, self.faces = mesh.points, mesh.normals, mesh.faces.astype(np.int64)
        self.names = one_places(mesh.points)[1]
        a, b, c = (mesh.points[mesh.faces[:, corner]] for corner in range(3))
        area = 0.5 * float(np.sqrt((np.cross(b - a, c - a) ** 2).sum(axis=1)).sum())
        self.finest = 0.7 * float(np.sqrt(area / most))  # about half an edge, were all of one size
        self._body = body
        self._told = np.empty(0, np.int64), np.empty(0)  # edges by the names of their ends, in order; their errors
        self.colours = self._seen(self.points)

    def _seen(self, points: np.ndarray) -> np.ndarray:
        scale = self._body.scale
        return self._body.solid.colours(points * scale + 0.5, self.finest * scale)

    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns the edges as pairs of corners, one of each pair of places, (E, 2); and those of triangles, (F, 3)."""
        pairs = np.concatenate([self.faces[:, pair] for pair in _CORNERS])
        named = np.sort(self.names[pairs], axis=1)
        _, first, back = np.unique(named[:, 0] * len(self.points) + named[:, 1], return_index=True, return_inverse=True)
        return pairs[first], back.reshape(3, -1).T

    def lengths(self, edges: np.ndarray) -> np.ndarray:
        """Returns how long edges are."""
        gone = self.points[edges[:, 0]] - self.points[edges[:, 1]]
        out: np.ndarray = np.sqrt((gone * gone).sum(axis=1))
        return out

    def errors(self, edges: np.ndarray) -> np.ndarray:
        """Returns how far colours within edges are from those between their ends, at most."""
        ends = np.sort(self.names[edges], axis=1)
        keys = (ends[:, 0] << 32) | ends[:, 1]
        known, told = self._told
        at = np.searchsorted(known, keys)
        held = np.append(known, -1)[at] == keys
        out: np.ndarray = np.append(told, 0.0)[at]
        out[~held] = self._errors(edges[~held])
        order = np.argsort(keys)
        self._told = keys[order], out[order]
        return out

    def _errors(self, edges: np.ndarray) -> np.ndarray:
        a, b = edges.T
        out = np.zeros(len(edges))
        for share in (0.25, 0.5, 0.75):
            there = self._seen(self.points[a] * (1.0 - share) + self.points[b] * share)
            told = self.colours[a] * (1.0 - share) + self.colours[b] * share
            out = np.maximum(out, np.abs(there - told).max(axis=1))
        return out

    def halve(self, chosen: np.ndarray, of_faces: np.ndarray) -> None:
        """Halves the chosen of the edges, and the triangles at them."""
        halved = chosen[of_faces]
        pairs = np.concatenate([np.sort(self.faces[:, pair], axis=1)[halved[:, k]] for k, pair in enumerate(_CORNERS)])
        count = len(self.points)
        keys, back = np.unique(pairs[:, 0] * count + pairs[:, 1], return_inverse=True)
        a, b = keys // count, keys % count
        between = np.full(halved.shape, -1, np.int64)
        where = 0
        for k in range(3):
            here = int(halved[:, k].sum())
            between[halved[:, k], k] = count + back.reshape(-1)[where : where + here]
            where += here
        middles = 0.5 * (self.points[a] + self.points[b])
        self.names = np.concatenate([self.names, self._named(a, b)])
        self.points = np.concatenate([self.points, middles])
        self.normals = np.concatenate([self.normals, unit(self.normals[a] + self.normals[b])])
        self.colours = np.concatenate([self.colours, self._seen(middles)])
        self.faces = _split_triangles(self.faces, between)

    def _named(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """New names for the middles of edges, one for each pair of places."""
        ends = np.sort(np.stack([self.names[a], self.names[b]], axis=1), axis=1)
        _, names = np.unique(ends[:, 0] * len(self.points) + ends[:, 1], return_inverse=True)
        out: np.ndarray = names.reshape(-1) + int(self.names.max()) + 1
        return out


def _split_triangles(faces: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Triangles with the corners `between` theirs, (F, 3), -1 for none: each becomes one to four."""
    count = (between >= 0).sum(axis=1)
    out = [faces[count == 0]]
    for k in range(3):
        one = (count == 1) & (between[:, k] >= 0)
        a, b, c = (faces[one, (k + turn) % 3] for turn in range(3))
        m = between[one, k]
        out += [np.stack([a, m, c], axis=1), np.stack([m, b, c], axis=1)]
        two = (count == 2) & (between[:, k] < 0)  # the edge from a to b stays whole
        a, b, c = (faces[two, (k + turn) % 3] for turn in range(3))
        m, n = between[two, (k + 1) % 3], between[two, (k + 2) % 3]
        out += [np.stack([m, c, n], axis=1), np.stack([a, b, m], axis=1), np.stack([a, m, n], axis=1)]
    (a, b, c), (m, n, o) = faces[count == 3].T, between[count == 3].T
    out += [np.stack(corners, axis=1) for corners in ((a, m, o), (m, b, n), (o, n, c), (m, n, o))]
    return np.concatenate(out)


def _with_longest(chosen: np.ndarray, of_faces: np.ndarray, lengths: np.ndarray) -> np.ndarray:
    """Chosen edges, and the longest ones of all triangles at them: so these keep good forms."""
    # Of two that are alike the same one for all: the later.
    order = np.empty(len(lengths), np.int64)
    order[np.argsort(lengths, kind="stable")] = np.arange(len(lengths))
    longest = np.take_along_axis(of_faces, order[of_faces].argmax(axis=1)[:, None], axis=1)[:, 0]
    while True:
        more = longest[chosen[of_faces].any(axis=1)]
        if chosen[more].all():
            return chosen
        chosen = chosen.copy()
        chosen[more] = True


def colours_baked(body: Body, most: int = ENOUGH, tell: Callable[[int], None] = lambda done: None) -> Baked:
    """Returns an object's mesh in the colours of its solid, of at most `most` triangles, or as many as it has; turned,
    sized and put as the body is.  `tell` hears how many triangles there are."""
    made = _Growing(body, most)
    while True:
        edges, of_faces = made.edges()
        lengths, errors = made.lengths(edges), made.errors(edges)
        bad = (errors > _LIKE) & (lengths > made.finest)
        weights = np.where(lengths > _FIRST, 2.0 + lengths, np.where(bad, errors, 0.0))
        room = most - len(made.faces)
        chosen = np.zeros(len(edges), bool)
        worst = np.argsort(-weights, kind="stable")[: max(0, int(_SHARE * room / 2))]
        chosen[worst[weights[worst] > 0.0]] = True
        chosen = _with_longest(chosen, of_faces, lengths)
        if not chosen.any() or int(chosen[of_faces].sum()) > room:
            break
        made.halve(chosen, of_faces)
        tell(len(made.faces))
    points = made.points @ (body.size * body.turned).T + np.array(body.at)
    return Baked(
        points, made.normals @ body.turned.T, made.faces.astype(np.int32), made.colours, float(errors.max(initial=0.0))
    )


def turned_upright(vectors: np.ndarray) -> np.ndarray:
    """Places or directions (N, 3), z upwards, as glTF has them, y upwards."""
    x, y, z = vectors.T
    return np.stack([x, z, -y], axis=1)
