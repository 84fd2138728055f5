"""Planes through a cube that goes on without end, in any direction, between its voxels by cubic B-splines.

Unser 1999, "Splines: a perfect fit for signal and image processing".  A spline's coefficients have the spectrum of the
cube times `prefilter` along each axis; a plane is cut out by 64 weights a sample, and laid back by the same ones.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.numeric.kernel import inlined, kernel

_SIXTH = np.float32(1.0 / 6.0)


class Plane(NamedTuple):
    """Where a plane's samples lie, in voxels (z, y, x): its first one at `corner`, the next ones further by `down` and
    `across`; float64 (3,) each."""

    corner: np.ndarray
    down: np.ndarray
    across: np.ndarray


def prefilter(side: int) -> np.ndarray:
    """Returns what the coefficients have, along one axis, of each frequency of the voxels: float32 (side,)."""
    return (3.0 / (2.0 + np.cos(2.0 * np.pi * np.arange(side) / side))).astype(np.float32)


def response(frequency: np.ndarray) -> np.ndarray:
    """Returns what the spline has, along one axis, of a wave of so many periods a voxel: float64."""
    out: np.ndarray = np.sinc(frequency) ** 4 * 3.0 / (2.0 + np.cos(2.0 * np.pi * frequency))
    return out


def blur(pictures: np.ndarray) -> np.ndarray:
    """Returns pictures (..., h, w), mirrored at their edges, with as much less of what is fine as they have where
    they are cut out at a slant in this way, on average over slants: float32."""
    from scipy.fft import dctn, idctn

    h, w = pictures.shape[-2:]
    length = np.hypot(np.arange(h)[:, None] / (2.0 * h), np.arange(w) / (2.0 * w))
    lengths, slants = np.linspace(0.0, 0.75, 200)[:, None], np.pi / 32.0 * (np.arange(16) + 0.5)
    left = (response(lengths * np.cos(slants)) * response(lengths * np.sin(slants))).mean(axis=1)
    waves = dctn(np.asarray(pictures, np.float32), axes=(-2, -1))
    waves *= np.interp(length, lengths[:, 0], left).astype(np.float32)
    out: np.ndarray = idctn(waves, axes=(-2, -1))
    return out


def cut(coefficients: np.ndarray, plane: Plane, size: int) -> np.ndarray:
    """Returns the samples of a plane of the spline with `coefficients`, float32 (n, n, n): float32 (size, size)."""
    out = np.empty((size, size), np.float32)
    _cut(coefficients, *plane, out)
    return out


def lay(total: np.ndarray, plane: Plane, values: np.ndarray) -> None:
    """Adds to coefficients, in place, what each has to do with the samples of a plane: the transpose of `cut`."""
    _lay(total, *plane, values)


@inlined
def _weigh(place: float, side: int, places: np.ndarray, weights: np.ndarray) -> None:
    """Finds the four coefficients that a place along an axis lies among, and their weights."""
    low = math.floor(place)
    t = np.float32(place - low)
    u = np.float32(1.0) - t
    weights[0] = u * u * u * _SIXTH
    weights[1] = (np.float32(4.0) - np.float32(3.0) * t * t * (u + np.float32(1.0))) * _SIXTH
    weights[3] = t * t * t * _SIXTH
    weights[2] = np.float32(1.0) - weights[0] - weights[1] - weights[3]
    first = (np.int64(low) - 1) % side
    for k in range(4):
        places[k] = first + k if first + k < side else first + k - side


@kernel
def _cut(coefficients: np.ndarray, corner: np.ndarray, down: np.ndarray, across: np.ndarray, out: np.ndarray) -> None:
    side = coefficients.shape[0]
    flat = coefficients.reshape(-1)
    places, weights = np.empty((3, 4), np.int64), np.empty((3, 4), np.float32)
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            for axis in range(3):
                _weigh(corner[axis] + i * down[axis] + j * across[axis], side, places[axis], weights[axis])
            x0, x1, x2, x3 = places[2]
            w0, w1, w2, w3 = weights[2]
            total = np.float32(0.0)
            for a in range(4):
                for b in range(4):
                    row = (places[0, a] * side + places[1, b]) * side
                    along = w0 * flat[row + x0] + w1 * flat[row + x1] + w2 * flat[row + x2] + w3 * flat[row + x3]
                    total += weights[0, a] * weights[1, b] * along
            out[i, j] = total


@kernel
def _lay(total: np.ndarray, corner: np.ndarray, down: np.ndarray, across: np.ndarray, values: np.ndarray) -> None:
    side = total.shape[0]
    flat = total.reshape(-1)
    places, weights = np.empty((3, 4), np.int64), np.empty((3, 4), np.float32)
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            for axis in range(3):
                _weigh(corner[axis] + i * down[axis] + j * across[axis], side, places[axis], weights[axis])
            x0, x1, x2, x3 = places[2]
            w0, w1, w2, w3 = weights[2]
            for a in range(4):
                for b in range(4):
                    row = (places[0, a] * side + places[1, b]) * side
                    part = values[i, j] * weights[0, a] * weights[1, b]
                    flat[row + x0] += part * w0
                    flat[row + x1] += part * w1
                    flat[row + x2] += part * w2
                    flat[row + x3] += part * w3
