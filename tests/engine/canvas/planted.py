"""Examples, dabs and plain forms of what is painted with them, for the tests of the canvas."""

from __future__ import annotations

from functools import cache

import numpy as np

from engine.canvas import growth as growths
from engine.numeric.address import Rect
from engine.numeric.grid import snapped
from engine.texture.example import show, tiles
from engine.texture.example.exemplar import PAD, analysed, shrunk
from engine.texture.example.parameters import Parameters


def blob(hue: int, side: int = 64) -> np.ndarray:
    """Stripes with a pale, half transparent rim: uint8 RGBA (side, side, 4)."""
    random = np.random.default_rng(hue)
    y, x = np.mgrid[:side, :side] - (side - 1) / 2.0
    depth = side * 0.46 - np.hypot(x, y) + 0.6 * random.standard_normal((side, side))
    stripes = (x + 0.5 * y) % 9 < 4
    colours = np.where(stripes[..., None], (40 + 60 * hue, 200, 90), (20, 30 * hue, 160)).astype(float)
    colours += random.integers(-15, 16, (side, side, 1))
    colours = np.where((depth < 4)[..., None], 240, colours)
    pixels = np.dstack([colours, np.clip(90 + 60 * depth, 0, 255)]) * (depth > 0)[..., None]
    return np.clip(pixels, 0, 255).astype(np.uint8)


@cache
def example(key: str):
    """Of the examples "a", "b", ...; "a+1" has one octave of finer detail."""
    name, _, detail = key.partition("+")
    found = analysed(blob("abcdef".index(name)), None, Parameters())
    return shrunk(found, int(detail)) if detail else found


def disc(radius: int) -> np.ndarray:
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    return x * x + y * y <= radius * radius


def around(x: int, y: int, radius: int) -> Rect:
    return Rect.at(x - radius, y - radius, 2 * radius + 1, 2 * radius + 1)


def planted(growth, x, y, radius, key="a", depth=0.0, level=0, seed=1):
    """With a disc of an example laid."""
    about = depth, level, key, key, example(key), seed
    return growths.laid(growth, *about, around(x, y, radius), disc(radius))


def bitten(growth, x, y, radius, depth=None, level=0):
    """With a disc cut out."""
    return growths.cut(growth, level, around(x, y, radius), disc(radius), depth)


def masked(plot, rect: Rect) -> np.ndarray:
    """A plot's own pixels: bool (h, w)."""
    return tiles.gathered(plot.region.masks[0], rect, np.zeros((1, rect.height, rect.width), np.uint8))[0] > 0


def same(one, other) -> bool:
    """Whether two growths have the same plots, and these the same pixels shown, tile by tile."""
    if [plot.order for plot in one] != [plot.order for plot in other]:
        return False
    for left, right in zip(one, other, strict=True):
        for a, b in zip(left.shown, right.shown, strict=True):
            if set(a) != set(b) or not all(np.array_equal(tile.data, b[key].data) for key, tile in a.items()):
                return False
    return True


# --- plain forms ------------------------------------------------------------------------------------------------------


def means(planes: np.ndarray) -> np.ndarray:
    """The next coarser level of (C, 2h, 2w), in whole steps of the grid."""
    steps = np.rint(planes.astype(np.float64) * 65536)
    c, h, w = steps.shape
    return np.rint(steps.reshape(c, h // 2, 2, w // 2, 2).mean(axis=(2, 4))) / 65536


def splines(planes: np.ndarray) -> np.ndarray:
    """The next finer level of (C, h, w), 0 outside: (C, 2h, 2w)."""
    steps = np.pad(np.rint(planes.astype(np.float64) * 65536), ((0, 0), (1, 1), (1, 1)))
    c, h, w = planes.shape
    out = np.empty((c, 2 * h, 2 * w))
    for r in (0, 1):
        for s in (0, 1):
            near, across = steps[:, 1:-1, 1:-1], steps[:, 1:-1, 2 * s : 2 * s + w]
            down, both = steps[:, 2 * r : 2 * r + h, 1:-1], steps[:, 2 * r : 2 * r + h, 2 * s : 2 * s + w]
            out[:, r::2, s::2] = np.rint((9 * near + 3 * across + 3 * down + both) / 16)
    return out / 65536


def dense(plot, whole: Rect, level: int) -> np.ndarray:
    """What a settled plot shows of `whole`, a rectangle of its level that holds it with room, at another level."""
    region = plot.region
    found = show.picture(region, whole).astype(np.float64)
    for _ in range(plot.level - level):
        found = means(found)
    if level <= plot.level:
        return found
    detailed = min(len(region.exemplar.finer), level - plot.level)
    if detailed:
        found = detail(region, show.sources(region, whole), detailed)
    for _ in range(level - plot.level - detailed):
        found = splines(found)
    return found


def continued(names: np.ndarray) -> dict[tuple[int, int], tuple[int, int]]:
    """Places in the example by those of the pixels, of two more beyond the rim: what their nearest neighbours'
    continue with."""
    far = range(-2, 3)
    near = sorted(((dy * dy + dx * dx, dy, dx) for dy in far for dx in far), reverse=True)
    inside = {(int(y), int(x)): divmod(int(names[y, x]), 1 << 16) for y, x in np.argwhere(names >= 0)}
    found = {}
    for _, dy, dx in near:  # the nearest last, and those from above and from the left after others
        found |= {(y - dy, x - dx): (i - PAD - dy, j - PAD - dx) for (y, x), (i, j) in inside.items()}
    return {place: at for place, at in found.items() if min(place) >= 0 and max(place) < len(names)}


def detail(region, names: np.ndarray, k: int) -> np.ndarray:
    """What an example shows `k` levels below the pixels of `names` (h, w): (4, h 2^k, w 2^k)."""
    places, (first, finest) = continued(names), (region.exemplar.colours[0], region.exemplar.finer[k - 1])
    inside = np.zeros((1, *names.shape))
    for place, (i, j) in places.items():
        held = 0 <= i < first.shape[0] and 0 <= j < first.shape[1] and first[i, j, 3] > 0
        inside[(0, *place)] = names[place] >= 0 or not held
    for _ in range(k):
        inside = splines(inside)
    share = np.clip(((inside[0] - 0.5) * (1 << k) + 0.5).astype(np.float32), 0, 1)
    out = np.zeros((4, *inside.shape[1:]), np.float32)
    for y, x in np.argwhere(share > 0):
        out[:, y, x] = snapped(share[y, x] * below(places, finest, k, int(y), int(x)))
    return out.astype(np.float64)


def below(places: dict[tuple[int, int], tuple[int, int]], colours: np.ndarray, k: int, y: int, x: int) -> np.ndarray:
    """What lies `k` levels below the four pixels around a place, those nearer to it weighing more: (4,)."""
    side = 1 << k
    (row, down), (column, across) = (divmod(n - side // 2, side) for n in (y, x))
    found, total = np.zeros(4, np.float32), 0.0
    for r, c in ((row, column), (row, column + 1), (row + 1, column), (row + 1, column + 1)):
        if (r, c) not in places:
            continue
        t, u = (down + 0.5) / side, (across + 0.5) / side
        t, u = t * t * (3 - 2 * t), u * u * (3 - 2 * u)
        weight = (t if r > row else 1 - t) * (u if c > column else 1 - u)
        total += weight
        i, j = (places[r, c][0] - r) * side + y, (places[r, c][1] - c) * side + x
        if 0 <= i < colours.shape[0] and 0 <= j < colours.shape[1]:
            found = (found + weight * colours[i, j].astype(np.float64)).astype(np.float32)
    return (found / total).astype(np.float32) if total else found


def stacked(pictures, below: np.ndarray) -> np.ndarray:
    """Pictures (4, h, w) over one another, the first one lowest, over what is below."""
    out = below.astype(np.float32)
    for picture in pictures:
        above = picture.astype(np.float32)
        out = above + snapped((np.float32(1.0) - above[3]) * out)
    return out
