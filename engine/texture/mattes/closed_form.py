"""Alpha in a band of pixels, by the closed form of Levin, Lischinski & Weiss 2008: within each 3 x 3 window alpha is a
linear function of the colours; solved by conjugate gradients."""

from __future__ import annotations

import numpy as np
from scipy import ndimage, sparse

from engine.texture.mattes.conjugate import Until, descended

_SMOOTH = 1e-4  # added to a window's covariances of colour, times 9
_UNTIL = Until(80, 5e-3)
_PLACES = [(dy, dx) for dy in (-1, 0, 1) for dx in (-1, 0, 1)]


def solved(rgb: np.ndarray, band: np.ndarray, first: np.ndarray, weights: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Returns alpha, float64 (n,), of the n pixels of a band, bool (h, w).  `rgb`: (h, w, 3) in 0..1; `first`: alpha
    (h, w), as it is outside the band and as the solution begins within; `weights` (h, w): how much `wanted` (h, w)
    counts, beside what the windows say."""
    planes = _weights(rgb, ndimage.binary_dilation(band, np.ones((3, 3), bool)))
    number = np.full(band.shape, -1, np.int64)
    number[band] = np.arange(int(band.sum()))
    at = np.flatnonzero(band)
    columns_wide = band.shape[1] + 4
    padded_number = np.pad(number, 2, constant_values=-1).ravel()
    padded_first = np.pad(first.astype(np.float64), 2).ravel()
    place = (at // band.shape[1] + 2) * columns_wide + at % band.shape[1] + 2
    target = (weights * wanted)[band].astype(np.float64)
    diagonal = weights[band].astype(np.float64) + 1e-9
    rows, columns, values = [], [], []
    for (dy, dx), plane in planes.items():
        value = plane[band]
        other = padded_number[place + dy * columns_wide + dx]
        if (dy, dx) == (0, 0):
            diagonal += value
            continue
        known = other < 0
        target[known] -= value[known] * padded_first[place[known] + dy * columns_wide + dx]
        rows.append(np.flatnonzero(~known))
        columns.append(other[~known])
        values.append(value[~known])
    size = len(at)
    linked = sparse.coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (size, size))
    return descended(linked.tocsr(), diagonal, target, first[band].astype(np.float64), _UNTIL)


def _weights(rgb: np.ndarray, windows: np.ndarray) -> dict[tuple[int, int], np.ndarray]:
    """Returns what each pixel of the matting Laplacian has with its neighbours, float32 (h, w), by how far these are
    down and right.  `windows`: bool (h, w), the middles of the windows that count."""
    counted = windows.copy()
    counted[[0, -1]] = counted[:, [0, -1]] = False
    middles, wide = np.flatnonzero(counted), windows.shape[1]
    offsets = [dy * wide + dx for dy, dx in _PLACES]
    colours = rgb.reshape(-1, 3)
    stacked = np.stack([colours[middles + offset] for offset in offsets], 1)  # windows, 9, 3
    centred = stacked - stacked.mean(axis=1, keepdims=True)
    turned = centred.transpose(0, 2, 1)
    covariance = turned @ centred / 9 + _SMOOTH / 9 * np.eye(3, dtype=np.float32)
    linked = (centred @ np.linalg.inv(covariance)) @ turned
    values = np.eye(9, dtype=np.float32) - (1.0 + linked) / 9
    found: dict[tuple[int, int], np.ndarray] = {}
    for i, (y, x) in enumerate(_PLACES):
        for j, (v, u) in enumerate(_PLACES):
            plane = found.setdefault((v - y, u - x), np.zeros(windows.size, np.float32))
            plane[middles + offsets[i]] += values[:, i, j]  # no window's twice
    return {place: plane.reshape(windows.shape) for place, plane in found.items()}
