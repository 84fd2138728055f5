"""How like its example a texture is.  Pictures are float (h, w, 3 or 4) in 0..1, alpha not premultiplied; masks bool.

Each figure finds what the others miss: `sliced` structure and tone at each scale, `nearest` seams, blur and garbage
(`nn`, `nn95`) and how much of the example is in use (`cov`), `repeats` copies beside one another, `rim` what lies along
the outline.  `score` is one number of them: about 0 for the example itself, 1000 for its pixels shuffled.  A comb of
repeated rows can better the score: look at `repeats`, at `nn95` and at the picture too.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import ndimage

BANDS, PROJECTIONS = 3, 128
CELL = 20  # pixels along the squares by which the use of the example is counted
RIMS = 16  # pixels from the outline
WIDE_COVERAGE = 0.95


class Likeness(NamedTuple):
    swd: float
    nn: float
    nn95: float
    cov: float
    rim: float  # 0 where the example has no outline
    rep: float

    def score(self, shuffled: Likeness) -> float:
        """Q: relative to the example's own pixels shuffled."""
        parts = self.swd / shuffled.swd + self.nn / shuffled.nn + 0.5 * max(0.0, 1.0 - self.cov / WIDE_COVERAGE)
        inside = 1000.0 * parts / 2.0
        return inside if not self.rim else (2.0 * inside + 1000.0 * self.rim / shuffled.rim) / 3.0


def likeness(example: np.ndarray, made: np.ndarray, mask=None, region=None) -> Likeness:
    """All figures; `mask` and `region`: where the example and the texture are, else everywhere."""
    bounded = mask is not None
    mask = np.ones(example.shape[:2], bool) if mask is None else mask
    region = np.ones(made.shape[:2], bool) if region is None else region
    one, other = premultiplied(example), premultiplied(made)
    outline = rim(one, mask, other, region) if bounded else 0.0
    return Likeness(
        sliced(one, mask, other, region), *nearest(one, mask, other, region), outline, repeats(one, mask, other, region)
    )


def shuffled(example: np.ndarray, region: np.ndarray, mask=None) -> np.ndarray:
    """The example's pixels in any order, over the region."""
    pixels = example.reshape(-1, example.shape[-1]) if mask is None else example[mask]
    out = np.zeros((*region.shape, example.shape[-1]))
    out[region] = pixels[np.random.default_rng(0).integers(len(pixels), size=int(region.sum()))]
    return out


def premultiplied(picture: np.ndarray) -> np.ndarray:
    out = np.array(picture, np.float32)
    if out.shape[-1] == 4:
        out[..., :3] *= out[..., 3:]
    return out


def sliced(example, mask, made, region) -> float:
    """1-Wasserstein distance of 7 x 7 patches of Laplacian bands and of the rest, along fixed directions, times 1000,
    in units of the example's deviation."""
    found = []
    pairs = zip(_bands(example, mask), _bands(made, region), strict=True)
    for level, ((one, inside), (other, within)) in enumerate(pairs):
        random = np.random.default_rng(100 + level)
        mean, spread = one[inside].mean(0), one[inside].std(0) + 1e-4
        a = _patches((one - mean) / spread, inside, 7, 20000, random)[0]
        b = _patches((other - mean) / spread, within, 7, 20000, random)[0]
        if min(len(a), len(b)) < 50:
            continue
        directions = random.standard_normal((a.shape[1], PROJECTIONS)).astype(np.float32)
        a, b = (patches @ (directions / np.linalg.norm(directions, axis=0)) for patches in (a, b))
        found.append((_wasserstein(a, b, 512) / a.std(0)).mean())
    return 1000.0 * float(np.mean(found))


def nearest(example, mask, made, region, side=9) -> tuple[float, float, float]:
    """Distance of patches to the example's nearest one, relative to that of two of its patches: the mean, the 95th
    percentile; and the part of the example from which the nearest ones come."""
    random = np.random.default_rng(5)
    theirs, places = _patches(example, mask, side, None, random)
    ours, _ = _patches(made, region, side, 4000, random)
    mean = theirs.mean(0)
    theirs, ours = theirs - mean, ours - mean
    sample = theirs[:: max(1, len(theirs) // 6000)]
    axes = np.linalg.eigh(sample.T @ sample)[1][:, ::-1][:, :48]
    near, own = theirs @ axes, ours @ axes
    lengths = (near * near).sum(1)
    pairs = random.integers(len(theirs), size=4000), random.integers(len(theirs), size=4000)
    unit = ((theirs[pairs[0]] - theirs[pairs[1]]) ** 2).sum(1).mean()
    distances, sources = [], []
    for first in range(0, len(ours), 200):
        rough = lengths - 2.0 * own[first : first + 200] @ near.T
        best = np.argpartition(rough, min(8, rough.shape[1] - 1), axis=1)[:, :8]
        exact = ((theirs[best] - ours[first : first + 200, None]) ** 2).sum(2)
        distances.append(exact.min(1))
        sources.append(np.take_along_axis(best, exact.argmin(1)[:, None], 1)[:, 0])
    distance, source = np.sqrt(np.concatenate(distances) / unit), np.concatenate(sources)
    return float(distance.mean()), float(np.quantile(distance, 0.95)), _coverage(places // CELL, source)


def _coverage(cells: np.ndarray, source: np.ndarray) -> float:
    _, names, counts = np.unique(cells[:, 0] * 1000 + cells[:, 1], return_inverse=True, return_counts=True)
    used = np.bincount(names.reshape(-1)[source], minlength=len(counts)) / len(source)
    held = used > 0
    return float(np.exp(-(used[held] * np.log(used[held] / (counts[held] / counts.sum()))).sum()))


def rim(example, mask, made, region, part=None) -> float:
    """1-Wasserstein distance of colour and alpha at each distance from the outline, times 1000, in deviations; `part`:
    where the texture is looked at, else all of its region."""
    here, there = (ndimage.distance_transform_edt(np.pad(where, 1))[1:-1, 1:-1] for where in (mask, region))
    spread = example[mask].std(0) + 1e-3
    there = there if part is None else there * part
    found = []
    for d in range(RIMS):
        a, b = example[(here > d) & (here <= d + 1)], made[(there > d) & (there <= d + 1)]
        if min(len(a), len(b)) >= 20:
            found.append((_wasserstein(a, b, 128) / spread).mean())
    return 1000.0 * float(np.mean(found))


def repeats(example, mask, made, region, count=1000, low=5, high=28, side=9) -> float:
    """The part of the patches that come again, almost the same, within 28 pixels, where of the example's one in 200
    comes half as near."""
    random = np.random.default_rng(3)
    a, b = (_nearest_beside(*pair, count, (low, high, side), random) for pair in ((example, mask), (made, region)))
    return float((b <= 0.5 * np.quantile(a, 0.005)).mean()) if len(a) and len(b) else 0.0


def _nearest_beside(picture, mask, count, reach, random) -> np.ndarray:
    """How near the nearest patch is among those from `low` to `high` pixels away."""
    low, high, side = reach
    patches, places = _patches(picture, mask, side, None, random)
    index = np.full(mask.shape, -1)
    index[places[:, 0], places[:, 1]] = np.arange(len(places))
    index = np.pad(index, high, constant_values=-1)
    steps = [(y, x) for y in range(-high, high + 1) for x in range(-high, high + 1) if max(abs(y), abs(x)) >= low]
    steps = np.array(steps) + high
    found = []
    for k in random.integers(len(places), size=count if len(places) else 0):
        near = index[places[k, 0] + steps[:, 0], places[k, 1] + steps[:, 1]]
        near = near[near >= 0]
        if len(near):
            found.append(((patches[near] - patches[k]) ** 2).sum(1).min())
    return np.array(found)


def _bands(picture, mask) -> list[tuple[np.ndarray, np.ndarray]]:
    out = []
    for _ in range(BANDS):
        smooth = _smoothed(picture, mask)
        out.append((picture - smooth, mask))
        picture, mask = smooth[::2, ::2], mask[::2, ::2]
    return [*out, (picture, mask)]


def _smoothed(picture, mask) -> np.ndarray:
    def binomial(plane: np.ndarray) -> np.ndarray:
        for axis in (0, 1):
            plane = ndimage.convolve1d(plane, np.array([1, 4, 6, 4, 1], np.float32) / 16, axis, mode="constant")
        return plane

    inside = mask.astype(np.float32)
    weight = np.maximum(binomial(inside), 1e-6)
    return np.stack([binomial(picture[..., c] * inside) / weight for c in range(picture.shape[-1])], -1)


def _patches(picture, mask, side, most, random) -> tuple[np.ndarray, np.ndarray]:
    """Patches wholly inside the mask, float32 (n, side * side * C), at most `most` of them, and where they begin."""
    half = side // 2
    whole = ndimage.minimum_filter(mask.astype(np.uint8), side, mode="constant")
    places = np.argwhere(whole[half : mask.shape[0] - half, half : mask.shape[1] - half])
    if most is not None and len(places) > most:
        places = places[random.choice(len(places), most, replace=False)]
    if not len(places):
        return np.zeros((0, side * side * picture.shape[-1]), np.float32), places
    windows = np.lib.stride_tricks.sliding_window_view(picture, (side, side), axis=(0, 1))
    return windows[places[:, 0], places[:, 1]].reshape(len(places), -1).astype(np.float32), places


def _wasserstein(a: np.ndarray, b: np.ndarray, count: int) -> np.ndarray:
    """Between the columns of two arrays, by `count` quantiles."""
    at = (np.arange(count) + 0.5) / count
    return np.abs(np.quantile(a, at, axis=0) - np.quantile(b, at, axis=0)).mean(0)
