"""An eager dense reference of the pyramid: every level a whole array, every rule written out plainly in float64.

It shares no code with the canvas but the rectangles that textures are asked for, and the keys of hashes.
"""

import numpy as np

from engine.numeric.address import TILE, Rect
from engine.numeric.hashing import fold_key

COUNT = 65536.0


def snap(values, count=COUNT):
    out = values * count
    np.rint(out, out)
    out /= count
    return out


def product(a, b, count=COUNT, noise=None):
    """snap(a * b + noise) with product and sum rounded to float32 first."""
    out = np.asarray(a, np.float32) * np.asarray(b, np.float32)
    return snap((out if noise is None else out + noise).astype(np.float64), count)


def expand(p, count=COUNT):
    """(C, h + 2, w + 2) to (C, 2h, 2w)."""
    mid = p[:, 1:-1, 1:-1]
    out = np.empty((p.shape[0], 2 * mid.shape[1], 2 * mid.shape[2]))
    nine = 9 * mid  # all that follows is exact in float64, in whatever order
    for dy in (0, 1):
        for dx in (0, 1):
            rows = slice(0, -2) if dy == 0 else slice(2, None)
            columns = slice(0, -2) if dx == 0 else slice(2, None)
            mixed = p[:, rows, 1:-1] + p[:, 1:-1, columns]
            mixed *= 3
            mixed += nine
            mixed += p[:, rows, columns]
            mixed /= 16
            out[:, dy::2, dx::2] = snap(mixed, count)
    return out


def reduce(f, count=COUNT):
    return snap((f[:, 0::2, 0::2] + f[:, 0::2, 1::2] + f[:, 1::2, 0::2] + f[:, 1::2, 1::2]) / 4, count)


def cell(mask):
    """(2h, 2w) of bool to (h, w): any of the four."""
    return mask[0::2, 0::2] | mask[0::2, 1::2] | mask[1::2, 0::2] | mask[1::2, 1::2]


def children_of(marks):
    """The pixels any of whose four expand parents is marked: (h + 2, w + 2) to (2h, 2w)."""
    out = np.zeros((2 * marks.shape[0] - 4, 2 * marks.shape[1] - 4), bool)
    mid = marks[1:-1, 1:-1]
    for dy in (0, 1):
        for dx in (0, 1):
            rows = slice(0, -2) if dy == 0 else slice(2, None)
            columns = slice(0, -2) if dx == 0 else slice(2, None)
            out[dy::2, dx::2] = mid | marks[rows, 1:-1] | marks[1:-1, columns] | marks[rows, columns]
    return out


def hash_plane_of_tile(number, level, x, y):
    """What `place64` makes of all places of a tile, from its corner, under the key of the tile and the commit."""
    ys, xs = np.indices((TILE, TILE), np.uint64)
    h = (ys << np.uint64(32) | xs) ^ np.uint64(fold_key(number, level, x, y))
    h = (h ^ (h >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    h = (h ^ (h >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return h ^ (h >> np.uint64(31))


class Dense:
    """All levels of a square canvas centred on the origin; arrays cover [-H, H) with H = half(level).

    An array of a level is never written to once it stands in `v` or `d`: another takes its place.
    `grid`: of the values, by its bits; `commits`: how many there were, where it is the coarse one.
    """

    def __init__(self, coarsest, finest, half0, inks, grid=16):
        self.count, self.commits = 2.0**grid, 0
        self.coarsest, self.finest, self.inks = coarsest, finest, list(inks)
        self.planes = 4 + 3 * len(self.inks)
        self.half = {
            k: half0 << k if k >= 0 else max(4, 2 * -(-half0 // (2 << -k))) for k in range(coarsest, finest + 1)
        }
        self.v = {k: np.zeros((self.planes, 2 * h, 2 * h)) for k, h in self.half.items()}
        self.d = dict(self.v)

    def snapshot(self):
        return dict(self.v), dict(self.d), self.commits

    def restore(self, state):
        self.v, self.d, self.commits = dict(state[0]), dict(state[1]), state[2]

    def noise(self, k, keep):
        """What the commit that is under way adds at level k before it rounds: float32, None on the fine grid."""
        if self.count == COUNT:
            return None
        out, h = np.zeros(keep.shape, np.float32), self.half[k]
        for y in range(-(-h // TILE) * -TILE, h, TILE):
            for x in range(-(-h // TILE) * -TILE, h, TILE):
                hashed = hash_plane_of_tile(self.commits + 1, k, x // TILE, y // TILE)
                rows, columns = slice(max(y, -h), min(y + TILE, h)), slice(max(x, -h), min(x + TILE, h))
                part = hashed[rows.start - y : rows.stop - y, columns.start - x : columns.stop - x]
                parts = (part >> np.uint64(54)).astype(np.float64)
                out[rows.start + h : rows.stop + h, columns.start + h : columns.stop + h] = (parts + 0.5) / 1024 - 0.5
        return np.where((keep > 15 / 16) & (keep < 17 / 16), out / np.float32(self.count), np.float32(0))

    def up(self, a, k, fill=0.0, count=None):
        """expand from level k - 1 to level k, `fill` outside."""
        e = expand(np.pad(a, [(0, 0), (1, 1), (1, 1)], constant_values=fill), count or self.count)
        spare = e.shape[1] // 2 - self.half[k]
        assert spare >= 0
        return e[:, spare : e.shape[1] - spare, spare : e.shape[2] - spare] if spare else e

    def down(self, a, j, fill=0.0):
        """Pad a level j + 1 array so that it covers the children of level j."""
        spare = 2 * self.half[j] - a.shape[-1] // 2
        pad = [(0, 0)] * (a.ndim - 2) + [(spare, spare)] * 2
        return np.pad(a, pad, constant_values=fill)

    def texture(self, k, ink_planes):
        h = self.half[k]
        total = np.zeros((3, 2 * h, 2 * h))
        for i, ink in enumerate(self.inks):
            if k > ink.base:
                detail = ink.bandpass(k, Rect(-h, -h, h, h))
                if detail is not None:
                    own = ink_planes[3 * i : 3 * i + 3]
                    total += product(own, np.broadcast_to(detail, (3, 2 * h, 2 * h)), self.count)
        return total

    def settle(self, k):
        """v of a level from its parents, its ink and its residual."""
        v = self.up(self.v[k - 1], k) + self.d[k]
        v[:3] += self.texture(k, v[4:])
        v[3] = np.clip(v[3], 0, 1)
        self.v[k] = v

    def paint(self, m, x0, y0, keep, add, spares_alpha=False):
        """v' = snap(A v) + B at level m, on the coarse grid snap(A v + B + noise), but not of alpha if that is spared;
        keep (h, w), add (planes, h, w) on the fine grid."""
        residuals = {k: d[3] for k, d in self.d.items()}
        h, (rows, columns) = self.half[m], keep.shape
        a = np.ones((2 * h, 2 * h))
        b = np.zeros((self.planes, 2 * h, 2 * h))
        a[y0 + h : y0 + h + rows, x0 + h : x0 + h + columns] = keep
        b[:, y0 + h : y0 + h + rows, x0 + h : x0 + h + columns] = add
        old = dict(self.v)
        noise, whole = self.noise(m, a), np.broadcast_to(a, self.v[m].shape)
        if noise is None:
            new = product(whole, self.v[m]) + b
        else:
            total = whole.astype(np.float32) * self.v[m].astype(np.float32) + b.astype(np.float32)
            new = snap((total + noise).astype(np.float64), self.count)
        new[3] = old[m][3] if spares_alpha else np.clip(new[3], 0, 1)
        self.v[m] = new
        marks = {m: (a != 1) | (new != old[m]).any(0)}
        aj = a
        for j in range(m - 1, self.coarsest - 1, -1):
            if not marks[j + 1].any():
                break
            aj = self.climb(j, old, aj, marks, spares_alpha)
        else:
            assert not marks[self.coarsest].any(), "the reference needs more coarse levels"
        for k in range(self.coarsest, m + 1):
            self.new_residual(k, old, marks)
        ak = a[None]
        for k in range(m + 1, self.finest + 1):
            ak = self.up(ak, k, 1.0, COUNT)
            weaker = product(np.broadcast_to(ak, self.d[k].shape), self.d[k], self.count, self.noise(k, ak[0]))
            self.d[k] = np.clip(weaker, -8, 8)
            if spares_alpha:
                self.d[k][3] = residuals[k]
            self.settle(k)

    def climb(self, j, old, keep, marks, spares_alpha):
        above = reduce(self.down(keep[None], j, 1.0))[0]
        parents = cell(self.down(marks[j + 1], j, False))
        above = np.where(parents, above, 1.0)
        r = old[j] - reduce(self.down(old[j + 1], j), self.count)
        r = np.where(np.abs(r) <= 2 / self.count, 0, r)
        kept = product(np.broadcast_to(above, r.shape), r, self.count, self.noise(j, above))
        new = reduce(self.down(self.v[j + 1], j), self.count) + kept
        new[3] = old[j][3] if spares_alpha else np.clip(new[3], 0, 1)
        self.v[j] = np.where(parents, new, old[j])
        marks[j] = (above != 1) | (self.v[j] != old[j]).any(0)
        return above

    def new_residual(self, k, old, marks):
        touched = marks.get(k, np.zeros(self.v[k].shape[1:], bool)).copy()
        predicted = np.zeros_like(self.v[k])
        if k > self.coarsest:
            predicted = self.up(self.v[k - 1], k)
            changed = np.pad((self.v[k - 1] != old[k - 1]).any(0), 1)
            spread = children_of(changed)
            spare = spread.shape[0] // 2 - self.half[k]
            touched |= spread[spare : spread.shape[0] - spare, spare : spread.shape[1] - spare]
        residual = self.v[k] - predicted
        residual[:3] -= self.texture(k, self.v[k][4:])
        self.d[k] = np.where(touched, residual, self.d[k])
