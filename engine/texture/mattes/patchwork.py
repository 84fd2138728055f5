"""A picture as some thousands of superpixels, and what is known of each: colours, neighbours, how much of it lies at
the picture's border.

Made once for a picture, so that corrections only solve for the superpixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import ndimage, sparse

SUPERPIXELS = 4000  # superpixels
SEEN = 80_000  # pixels of the small picture that is cut into superpixels
_KINDS = 48  # kinds of colour and grain
_THIN = 12  # pixels along a picture too thin for superpixels
_RING = 0.02  # of the shorter side: the border
_SAMPLED, _ROUNDS = 6000, 8  # pixels that the codes are found by, and how often they move
_GRAIN = 1.5  # pixels: the reach of grain; and how much it counts beside lightness
_TOGETHER = 4096  # pixels looked at together
_NEARLY = 0.06  # colours so near in Lab, of 100, count for one another


class Kinds(NamedTuple):
    """Of the pixels of a picture, which of K kinds each is, `codes` uint8 (h, w); how these count for one another,
    `alike` float32 (K, K); of each superpixel, how much of it is of each kind, `shares` float32 (n, K)."""

    codes: np.ndarray
    alike: np.ndarray
    shares: np.ndarray


@dataclass(frozen=True, eq=False, slots=True)
class Patchwork:
    """`size`: height and width of the picture; `labels`: int32 (h, w) of the small one, whose colours are `lab`,
    float32 (h, w, 3), lightness 0..1; `grained`: kinds of colour and grain; `coloured`: of colour alone.

    Of each of n superpixels: `areas`, `ring` (pixels of it at the border), `holes` (whether it is transparent).
    `graph`: how strongly neighbours hang together, sparse (n, n); `steps`: how far their colours are apart, sparse
    (n, n)."""

    size: tuple[int, int]
    labels: np.ndarray
    lab: np.ndarray
    grained: Kinds
    coloured: Kinds
    areas: np.ndarray
    ring: np.ndarray
    holes: np.ndarray
    graph: sparse.csr_matrix
    steps: sparse.csr_matrix

    @property
    def count(self) -> int:
        """Gives how many superpixels there are."""
        return len(self.areas)


def patchwork(pixels: np.ndarray) -> Patchwork:
    """Cuts a picture, uint8 or uint16 RGBA (h, w, 4), alpha not premultiplied, into superpixels."""
    small = smaller(pixels, SEEN)
    lab = _lab(small[..., :3])
    labels = _superpixels(lab)
    count = int(labels.max()) + 1
    flat = labels.ravel()
    areas = np.bincount(flat, minlength=count)
    means = np.stack([np.bincount(flat, plane.ravel(), count) for plane in lab.transpose(2, 0, 1)], 1) / areas[:, None]
    graph, steps = _graph(labels, means, count)
    return Patchwork(
        pixels.shape[:2],
        labels,
        lab,
        _kinds(np.concatenate([lab, _grain(lab[..., 0])], axis=-1), labels),
        _kinds(lab, labels),
        areas.astype(np.float64),
        np.bincount(flat, _ringed(labels.shape).ravel(), count),
        np.bincount(flat, small[..., 3].ravel(), count) / areas < 0.5,
        graph,
        steps,
    )


def smaller(pixels: np.ndarray, most: int) -> np.ndarray:
    """Returns a picture, uint8 or uint16 (h, w, 4), with at most so many pixels: area means, float32 (h, w, 4) in
    0..1."""
    height, width = pixels.shape[:2]
    full = np.float32(np.iinfo(pixels.dtype).max)
    scale = max(1.0, (height * width / most) ** 0.5)
    rows, columns = (max(1, round(n / scale)) for n in (height, width))
    while rows * columns > most:  # of a picture one pixel high
        rows, columns = (max(1, int(n * most / (rows * columns))) if n > 1 else 1 for n in (rows, columns))
    return reduced(pixels, rows, columns) / full


def reduced(pixels: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """Returns the means of a picture (h, w, c) over `rows` x `columns` rectangles of whole pixels: float32."""
    found = pixels
    for axis, count in ((0, rows), (1, columns)):
        size = found.shape[axis]
        if count == size:
            continue
        starts = np.arange(count) * size // count
        lengths = np.diff([*starts, size]).astype(np.float32)
        summed = np.add.reduceat(found, starts, axis=axis, dtype=np.float32)
        found = summed / lengths.reshape((-1, 1, 1) if axis == 0 else (1, -1, 1))
    return np.asarray(found, np.float32)


def _lab(rgb: np.ndarray) -> np.ndarray:
    from skimage.color import rgb2lab

    return np.asarray(rgb2lab(rgb), np.float32) / np.float32(100)


def _superpixels(lab: np.ndarray) -> np.ndarray:
    """Returns labels from 0 on, none missing: int32 (h, w)."""
    height, width = lab.shape[:2]
    if height * width <= SUPERPIXELS:
        return np.arange(height * width, dtype=np.int32).reshape(height, width)
    if min(height, width) < _THIN:
        return _pieces(height, width)
    from skimage.segmentation import slic

    found = slic(
        lab * 100, n_segments=int(0.8 * SUPERPIXELS), compactness=8, convert2lab=False, start_label=0, max_num_iter=6
    )
    _, found = np.unique(found, return_inverse=True)
    return np.asarray(found.reshape(height, width), np.int32)


def _pieces(height: int, width: int) -> np.ndarray:
    """Returns the labels of a picture too thin for superpixels: pieces of rows, or of columns, of one length."""
    if height > width:
        return np.ascontiguousarray(_pieces(width, height).T)
    long = -(-width // (SUPERPIXELS // height))
    rows, columns = np.mgrid[:height, :width]
    return np.asarray(rows * -(-width // long) + columns // long, np.int32)


def _grain(light: np.ndarray) -> np.ndarray:
    """Returns how much lightness varies about each pixel, (h, w, 1)."""
    mean = ndimage.gaussian_filter(light, _GRAIN)
    varied = ndimage.gaussian_filter(light * light, _GRAIN) - mean * mean
    found: np.ndarray = _GRAIN * np.sqrt(np.maximum(varied, 0.0))[..., None]
    return found


def _kinds(features: np.ndarray, labels: np.ndarray) -> Kinds:
    """Finds kinds of pixels, by features (h, w, c)."""
    rows = features.reshape(-1, features.shape[-1])
    rng = np.random.default_rng(0)
    sample = rows[rng.permutation(len(rows))[:_SAMPLED]]
    centres = _spread(sample, min(_KINDS, len(sample)))
    for _ in range(_ROUNDS):
        near = _nearest(sample, centres)
        held = np.bincount(near, minlength=len(centres))
        sums = np.stack([np.bincount(near, plane, len(centres)) for plane in sample.T], 1)
        centres = np.where(held[:, None] > 0, sums / np.maximum(held, 1)[:, None], centres).astype(np.float32)
    codes = _nearest(rows, centres)
    apart = np.linalg.norm(centres[:, None] - centres[None], axis=-1)
    alike = np.exp(-0.5 * (apart / _NEARLY) ** 2)
    count, kinds = int(labels.max()) + 1, len(centres)
    shares = np.bincount(labels.ravel() * kinds + codes, minlength=count * kinds).reshape(count, kinds)
    return Kinds(
        codes.astype(np.uint8).reshape(labels.shape),
        (alike / alike.sum(axis=1, keepdims=True)).astype(np.float32),
        (shares / shares.sum(axis=1, keepdims=True)).astype(np.float32),
    )


def _spread(sample: np.ndarray, count: int) -> np.ndarray:
    """Returns some of a sample, each as far from those before it as any is."""
    found = [sample[0]]
    apart = ((sample - found[0]) ** 2).sum(axis=1)
    for _ in range(count - 1):
        found.append(sample[int(apart.argmax())])
        apart = np.minimum(apart, ((sample - found[-1]) ** 2).sum(axis=1))
    return np.array(found, np.float32)


def _nearest(features: np.ndarray, centres: np.ndarray) -> np.ndarray:
    found, own = np.empty(len(features), np.int64), (centres**2).sum(axis=1)
    for at in range(0, len(features), _TOGETHER):
        # Not by the library of linear algebra, whose threads wait for one another.
        products = np.einsum("nc,kc->nk", features[at : at + _TOGETHER], 2.0 * centres)
        found[at : at + _TOGETHER] = (own - products).argmin(axis=1)
    return found


def _ringed(shape: tuple[int, ...]) -> np.ndarray:
    """Tells which pixels lie at the border: bool (h, w)."""
    height, width = shape
    deep = max(1, round(_RING * min(height, width)))
    found = np.ones((height, width), np.bool_)
    found[deep : height - deep, deep : width - deep] = False
    return found


def _graph(labels: np.ndarray, means: np.ndarray, count: int) -> tuple[sparse.csr_matrix, sparse.csr_matrix]:
    """Returns how strongly neighbours hang together: the border between them, less where colours differ; and how far
    they differ."""
    pairs = [
        np.stack([labels[:, :-1].ravel(), labels[:, 1:].ravel()]),
        np.stack([labels[:-1].ravel(), labels[1:].ravel()]),
    ]
    first, second = np.concatenate(pairs, axis=1)
    first, second = first[first != second], second[first != second]
    shared = sparse.coo_matrix((np.ones(len(first)), (first, second)), (count, count)).tocsr()
    shared = sparse.triu(shared + shared.T, 1).tocoo()
    apart = np.linalg.norm(means[shared.row] - means[shared.col], axis=1)
    usual = float((apart**2).mean()) + 1e-6 if len(apart) else 1.0
    weights = shared.data * (np.exp(-(apart**2) / usual) + 1e-3)
    both = [sparse.coo_matrix((data, (shared.row, shared.col)), (count, count)) for data in (weights, apart + 1e-5)]
    graph, steps = ((one + one.T).tocsr() for one in both)
    return graph, steps
