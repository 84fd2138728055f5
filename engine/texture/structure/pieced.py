"""Pieces of an example on a torus, each beside such as it agrees with, and cut where it does (Efros & Freeman 2001).

What is compared are whole numbers.  Where pieces come from is looked for in a small picture, several times; the layout
with the cheapest cuts is made again on finer grids, where its pieces move by a pixel.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from engine.numeric.hashing import fold_key, hash_plane
from engine.texture.structure.half_spectra import Size, halved_size

_PART, _OVER = 0.4, 3  # of the example's shorter side: a piece; the part of it, at the least, that lies over others
_NARROWEST = 6  # pixels along a piece where places are looked for
_LOOKED_AT, _OFTEN_LOOKED_AT = 72 * 72, 40 * 40  # pixels of the example there, about; where pieces are many
_MANY = 24
_TRIES, _PIECES = 6, 200  # layouts, and pieces of all of them, at most
_NEARLY = 10  # a piece may disagree by a tenth more than the best
# What was laid already disagrees the more, each time: by a part of what it does, and by one of the example's variance.
_AGAIN, _USED = 4, 64
_DOMAIN = 0x71756C74  # "qult"

Places = dict[tuple[int, int], tuple[int, int]]  # of the example, by row and column of pieces


@dataclass(frozen=True, slots=True, eq=False)
class _Ground:
    """`example`: int32 (h, w, C) in 0..255; `size`: of the torus; `side`: of pieces; `rows`, `columns`: of pieces."""

    example: np.ndarray
    size: Size
    side: int
    rows: int
    columns: int

    @property
    def varied(self) -> int:
        """Gives the variance of the example's colours, summed."""
        flat = self.example.reshape(-1, self.example.shape[2])
        means = flat.sum(axis=0, dtype=np.int64) // len(flat)
        return int(np.square(flat - means).sum(dtype=np.int64)) // len(flat)

    def coarser(self) -> _Ground:
        """Returns the same at half the size."""
        height, width = (n // 2 * 2 for n in self.example.shape[:2])
        parts = self.example[:height, :width].reshape(height // 2, 2, width // 2, 2, -1)
        side = self.side // 2
        size = halved_size(self.size, 1)
        return replace(
            self,
            example=(parts.sum(axis=(1, 3), dtype=np.int32) + 2) >> 2,
            size=(max(size[0], side), max(size[1], side)),
            side=side,
        )


class _Laid:
    """A torus that pieces are laid on; `used`: how often which pixel of the example was, int64 (h, w)."""

    def __init__(self, ground: _Ground) -> None:
        self.ground, self._spent, self._long = ground, 0, 0
        self.used = np.zeros(ground.example.shape[:2], np.int64)
        self._values = np.zeros((*ground.size, ground.example.shape[2]), np.int32)
        self._known = np.zeros(ground.size, np.bool_)
        self.source = np.zeros((*ground.size, 2), np.int32)

    def under(self, row: int, column: int) -> tuple[tuple[np.ndarray, ...], np.ndarray, np.ndarray]:
        """Returns where a piece lies, as indices, what is there, (side, side, C), and where anything is."""
        (height, width), side = self.ground.size, np.arange(self.ground.side)
        ys = (row * height // self.ground.rows + side) % height
        xs = (column * width // self.ground.columns + side) % width
        there = np.ix_(ys, xs)
        return there, self._values[there], self._known[there]

    def put(self, at: tuple[int, int], place: tuple[int, int]) -> None:
        """Lays a piece of the example down, as far as the cuts leave it."""
        there, old, known = self.under(*at)
        side, (n, m) = self.ground.side, place
        new = self.ground.example[n : n + side, m : m + side]
        apart = np.square(new - old).sum(axis=-1, dtype=np.int64)
        taken = np.ones((side, side), np.bool_)
        for turn in range(4):  # what is known at the left, then at the other edges
            apart, known, taken = (np.rot90(one, -1) if turn else one for one in (apart, known, taken))
            wide = _leading(np.asarray(known.all(axis=0)))
            if wide:
                kept, spent = _cut(apart[:, :wide])
                taken = taken.copy()
                taken[:, :wide] &= kept
                self._spent, self._long = self._spent + spent, self._long + side
        apart, known, taken = (np.rot90(one, -1) for one in (apart, known, taken))
        taken = taken | ~known
        down, across = np.nonzero(taken)
        ys, xs = there[0][down, 0], there[1][0, across]
        self._values[ys, xs] = new[down, across]
        self.source[ys, xs] = np.stack([n + down, m + across], axis=-1)
        self._known[there] = True
        self.used[n : n + side, m : m + side] += 1

    def unlike(self) -> float:
        """Tells how far off it is, squared and for a pixel: along its cuts, and in which values there are."""
        shown, own = (np.sort(one.reshape(-1, one.shape[2]), axis=0) for one in (self._values, self.ground.example))
        ranks = np.arange(len(shown)) * len(own) // len(shown)
        values = int(np.square(shown - own[ranks]).sum(dtype=np.int64))
        return self._spent / max(self._long, 1) + values / len(shown)


def has_pieces(example: Size, size: Size) -> bool:
    """Tells whether an example and a texture of a size have room for pieces."""
    return _PART * min(example) >= 2 * _NARROWEST and min(size) >= 2 * _NARROWEST


def pieced(picture: np.ndarray, size: Size, seed: int) -> Iterator[tuple[float, np.ndarray | None]]:
    """Yields how far the work is, 0..1, and last a texture (C, *size), float32, of pieces of a picture (C, h, w)."""
    grounds = _grounds(picture, size)
    count = grounds[0].rows * grounds[0].columns
    tries = max(1, min(_TRIES, _PIECES // count))
    whole, done = float(count * (tries + len(grounds) - 1)), 0
    best: tuple[float, Places] | None = None
    for number in range(tries):
        laid, places = _Laid(grounds[-1]), Places()
        chances = hash_plane(fold_key(_DOMAIN, seed, number), 0, 0, grounds[0].columns, grounds[0].rows)
        for at in np.ndindex(chances.shape):
            places[at] = _anywhere(laid, at, int(chances[at]))
            laid.put(at, places[at])
            done += 1
            yield done / whole, None
        if best is None or laid.unlike() < best[0]:
            best = laid.unlike(), places
    assert best is not None
    places = best[1]
    for ground in reversed(grounds[:-1]):
        laid = _Laid(ground)
        for at, (n, m) in places.items():
            places[at] = _near(laid, at, (2 * n, 2 * m))
            laid.put(at, places[at])
            done += 1
            yield done / whole, None
    rows, columns = laid.source[: size[0], : size[1]].transpose(2, 0, 1)
    yield 1.0, np.ascontiguousarray(picture[:, rows, columns], np.float32)


def _grounds(picture: np.ndarray, size: Size) -> list[_Ground]:
    """Returns the example and the torus at full size and at halves of it, as far as places are looked for."""
    example = np.rint(np.float32(255.0) * picture).astype(np.int32).transpose(1, 2, 0)
    side = min(max(int(_PART * min(example.shape[:2])), 1), *size)
    halved, pixels = 0, example.shape[0] * example.shape[1]
    most = _OFTEN_LOOKED_AT if size[0] * size[1] > _MANY * side * side // 2 else _LOOKED_AT
    while pixels >> 2 * halved > most and side >> halved + 1 >= _NARROWEST:
        halved += 1
    side = side >> halved << halved
    step = side - side // _OVER
    rows, columns = (-(-n // step) for n in size)
    found = [_Ground(np.ascontiguousarray(example), size, side, rows, columns)]
    for _ in range(halved):
        found.append(found[-1].coarser())
    return found


def _anywhere(laid: _Laid, at: tuple[int, int], chance: int) -> tuple[int, int]:
    """Returns one of the example's places that agree with what is there as well as any, or nearly."""
    example, side = laid.ground.example, laid.ground.side
    _, old, known = laid.under(*at)
    high, wide = (n - side + 1 for n in example.shape[:2])
    every, apart = np.zeros((2, high, wide, old.shape[2]), np.int32)  # of at most some thousand squares of 255
    looked_at = np.argwhere(known)
    looked_at = looked_at[looked_at.sum(axis=1) & 1 == 0]  # as on a chequerboard: half of them are enough
    for y, x in looked_at:
        np.subtract(example[y : y + high, x : x + wide], old[y, x], out=apart)
        np.multiply(apart, apart, out=apart)
        every += apart
    costs = every.sum(axis=-1, dtype=np.int64)
    used = _sums(laid.used, side)
    costs += (used * (costs // _AGAIN + laid.ground.varied * len(looked_at) // _USED)) // (side * side)
    least = int(costs.min())
    near = np.flatnonzero(costs <= least + least // _NEARLY + len(looked_at) * old.shape[2])
    n, m = divmod(int(near[chance % near.size]), wide)
    return n, m


def _sums(values: np.ndarray, side: int) -> np.ndarray:
    """Returns the sums of all squares of a plane, by their first row and column: int64."""
    whole = np.pad(np.cumsum(np.cumsum(values, axis=0), axis=1), ((1, 0), (1, 0)))
    out: np.ndarray = whole[side:, side:] - whole[:-side, side:] - whole[side:, :-side] + whole[:-side, :-side]
    return out


def _near(laid: _Laid, at: tuple[int, int], place: tuple[int, int]) -> tuple[int, int]:
    """Returns the place of the example's that agrees best, at most a pixel from one."""
    example, side = laid.ground.example, laid.ground.side
    _, old, known = laid.under(*at)
    best, found = -1, place
    for n in _around(place[0], example.shape[0] - side):
        for m in _around(place[1], example.shape[1] - side):
            apart = np.square(example[n : n + side, m : m + side] - old).sum(axis=-1, dtype=np.int64)
            far = int(apart[known].sum())
            if best < 0 or far < best:
                best, found = far, (n, m)
    return found


def _around(place: int, last: int) -> Sequence[int]:
    place = min(place, last)
    return [place, *(n for n in (place - 1, place + 1) if 0 <= n <= last)]


def _leading(told: np.ndarray) -> int:
    """Counts the trues that a row begins with; half of all if there is nothing else."""
    return len(told) // 2 if told.all() else int(np.argmin(told))


def _cut(costs: np.ndarray) -> tuple[np.ndarray, int]:
    """Returns what lies on and right of the cheapest path from top to bottom of costs, (h, w), and what it costs."""
    height, width = costs.shape
    sums = costs.copy()
    for y in range(1, height):
        above = sums[y - 1]
        least = above.copy()
        np.minimum(least[1:], above[:-1], out=least[1:])
        np.minimum(least[:-1], above[1:], out=least[:-1])
        sums[y] += least
    x, out = int(np.argmin(sums[-1])), np.zeros((height, width), np.bool_)
    spent = int(sums[-1, x])
    for y in range(height - 1, -1, -1):
        out[y, x:] = True
        if y:
            first = max(0, x - 1)
            x = first + int(np.argmin(sums[y - 1, first : x + 2]))
    return out, spent
