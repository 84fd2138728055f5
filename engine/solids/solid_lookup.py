"""What is looked up for each place of an object's surface: a solid, by its place within the object."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from engine.numeric.kernel import kernel
from engine.solids.material_sliders import MATERIALS
from engine.solids.materials import COLOURS, Seen
from engine.solids.solid_noise import Octaves, noise_at

_PIECE = 1 << 16  # places at once


class Lookup(Protocol):
    """A solid, wherever its colours come from."""

    @property
    def gloss(self) -> float:
        """Returns how much it mirrors, 0..1."""
        ...

    def colours(self, points: np.ndarray, finest: float) -> np.ndarray:
        """Returns colours (N, 3), 0..1 as a screen shows them, at points (N, 3) in units, of which lengths from
        `finest` on are seen."""
        ...


@dataclass(frozen=True, slots=True)
class Procedural:
    """A material with a seed and values of its sliders."""

    material: str
    seed: int = 0
    values: dict[str, float] = field(default_factory=dict)

    @property
    def gloss(self) -> float:
        """As the material."""
        return MATERIALS[self.material].gloss

    def colours(self, points: np.ndarray, finest: float) -> np.ndarray:
        """Returns the material's colours, of all octaves that are seen."""
        values = MATERIALS[self.material].values(self.values)
        out = np.empty((len(points), 3))
        for start in range(0, len(points), _PIECE):
            piece = slice(start, start + _PIECE)
            out[piece] = COLOURS[self.material](Seen(points[piece], self.seed, finest), values)
        return out


@dataclass(frozen=True, eq=False)
class Cubed:
    """A cube of voxels, float32 (z, y, x, 3) in 0..1, that repeats; below a voxel's size noise goes on as strong as its
    own finest detail is, in the same mixture of colours, each octave at half the strength."""

    voxels: np.ndarray
    gloss: float = 0.35
    seed: int = 0

    @cached_property
    def mixture(self) -> np.ndarray:
        """Returns what mixes three noises to the finest detail's colours: (3, 3)."""
        around = [np.roll(self.voxels, step, axis) for axis in range(3) for step in (1, -1)]
        detail = (self.voxels - sum(around) / 6.0).reshape(-1, 3).astype(np.float64)
        values, vectors = np.linalg.eigh(detail.T @ detail / len(detail))
        out: np.ndarray = vectors * np.sqrt(np.maximum(values, 0.0))
        return out

    def colours(self, points: np.ndarray, finest: float) -> np.ndarray:
        """Returns the cube's colours between voxels, and noise beyond them."""
        side = len(self.voxels)
        out = np.empty((len(points), 3))
        _between_voxels(self.voxels, np.ascontiguousarray(points, np.float64), out)
        if finest * side >= 1.0:
            return out
        for channel in range(3):
            mixed = self.mixture[:, channel]
            if np.abs(mixed).max() > 1e-4:
                octaves = Octaves((side, side, side), 0.55, 8)
                out += noise_at(points, octaves, 3 * self.seed + channel, finest)[:, None] * mixed
        np.clip(out, 0.0, 1.0, out=out)
        return out


@kernel
def _between_voxels(voxels: np.ndarray, points: np.ndarray, out: np.ndarray) -> None:
    """Quadratic B-splines between voxels, whose middles lie at (n + 1/2) / side."""
    depth, height, width = voxels.shape[0], voxels.shape[1], voxels.shape[2]
    weights = np.empty((3, 3))
    sizes = (width, height, depth)
    at = np.empty(3, np.int64)
    for n in range(points.shape[0]):
        for axis in range(3):
            place = points[n, axis] * sizes[axis] - 0.5
            middle = np.floor(place + 0.5)
            t = place - middle
            at[axis] = int(middle)
            weights[axis, 0] = 0.5 * (0.5 - t) ** 2
            weights[axis, 1] = 0.75 - t * t
            weights[axis, 2] = 0.5 * (0.5 + t) ** 2
        out[n, 0] = out[n, 1] = out[n, 2] = 0.0
        for k in range(3):
            for j in range(3):
                for i in range(3):
                    share = weights[2, k] * weights[1, j] * weights[0, i]
                    voxel = voxels[(at[2] + k - 1) % depth, (at[1] + j - 1) % height, (at[0] + i - 1) % width]
                    for channel in range(3):
                        out[n, channel] += share * voxel[channel]
