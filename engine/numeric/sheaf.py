"""All parallel planes across any direction of a cube that goes on without end, as far as they are smooth.

The smooth part of such planes is a rod in the spectrum of the cube, along their normal.  Its frequencies lie anywhere
among those of the planes, so they are spread to a grid twice as fine (Dutt & Rokhlin 1993, "Fast Fourier transforms for
nonequispaced data"), by the kernel of Barnett, Magland & af Klinteberg 2019, "A parallel non-uniform fast Fourier
transform library based on an 'exponential of semicircle' kernel".
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from engine.numeric.kernel import Array, inlined, kernel

_WIDTH = 4  # points of the grid that a frequency is spread to, along each axis
_STEEP = 2.3 * _WIDTH


@dataclass(frozen=True, slots=True, eq=False)
class Rod:
    """The frequencies of a cube within `reach` of a line: their `places` in half of its spectrum (n, n, n//2 + 1),
    int64 (m,); where they lie `along` the grid's three axes, float64 (m, 3); what samples have of each, complex64."""

    places: np.ndarray
    along: np.ndarray
    weights: np.ndarray


class Sheaves:
    """For cubes of `side`: n planes a voxel apart, of `small` x `small` samples each over `side` voxels, which have the
    frequencies within `reach` periods a cube of their normal."""

    def __init__(self, side: int, small: int, reach: float) -> None:
        self.side, self.small, self.reach = side, small, reach
        self._shape = side, small, small
        self._grid = tuple(2 * count for count in self._shape)
        self._samples = np.ix_(*((np.arange(n) - n // 2) % (2 * n) for n in self._shape))
        far, near = (1.0 / _transform(n) for n in (side, small))
        self._mend = (far[:, None, None] * near[None, :, None] * near).astype(np.float32)

    def rod(self, frame: np.ndarray, centre: np.ndarray, response: np.ndarray) -> Rod:
        """For planes across frame[0] with rows along frame[1] and columns along frame[2], float64 (3, 3) orthonormal,
        around the voxel `centre`, of a cube whose waves count as `response` says along each axis (side // 2 + 1,)."""
        room = int(16.0 * (self.reach + 1.0) ** 2 * self.side)
        places, along, weights = np.empty(room, np.int64), np.empty((room, 3)), np.empty(room, np.complex64)
        count = _gather_rod(frame, centre, self.side, self.reach, response, places, along, weights)
        return Rod(places[:count], along[:count], weights[:count])

    def planes(self, spectrum: np.ndarray, rod: Rod) -> np.ndarray:
        """Returns the samples (n, small, small), float32, of a cube whose spectrum is given: complex64 (n, n, n//2 +
        1)."""
        from scipy.fft import ifftn

        grid = np.zeros(self._grid, np.complex64)
        _spread(spectrum.reshape(-1)[rod.places] * rod.weights, rod.along, grid)
        samples = ifftn(grid, norm="forward", overwrite_x=True)[self._samples].real
        out: np.ndarray = samples * (self._mend * np.float32(1.0 / self.side**3))
        return out

    def given(self, rod: Rod, planes: np.ndarray) -> np.ndarray:
        """Returns what each voxel has to do with the samples of `planes`, the transpose of that: half of a spectrum
        at the rod's places, which has nothing elsewhere; complex64 (m,)."""
        from scipy.fft import fftn

        grid = np.zeros(self._grid, np.complex64)
        grid[self._samples] = planes * self._mend
        found = np.empty(rod.places.size, np.complex64)
        _collect(fftn(grid, overwrite_x=True), rod.along, found)
        found *= rod.weights.conj()
        # In half of a spectrum most frequencies stand for two.
        return np.where(rod.places % (self.side // 2 + 1) > 0, np.float32(0.5), np.float32(1.0)) * found


def _transform(count: int) -> np.ndarray:
    """Returns the kernel's own transform at `count` samples around 0, on a grid of twice as many."""
    places = np.linspace(-_WIDTH / 2.0, _WIDTH / 2.0, 2001)
    values = np.array([_kernel(x) for x in places])
    waves = np.cos(np.pi / count * places * (np.arange(count) - count // 2)[:, None])
    out: np.ndarray = np.trapezoid(values * waves, places, axis=1)
    return out


@kernel
def _kernel(x: float) -> float:
    inside = 1.0 - (2.0 * x / _WIDTH) ** 2
    return math.exp(_STEEP * (math.sqrt(inside) - 1.0)) if inside > 0.0 else 0.0


@kernel
def _gather_rod(
    frame: Array, centre: Array, side: int, reach: float, response: Array, places: Array, along: Array, weights: Array
) -> int:
    """Fills in what a Rod has; returns how many frequencies there are."""
    count, highest = 0, (side - 1) // 2
    first = np.argmax(np.abs(frame[0]))
    second, third = (first + 1) % 3, (first + 2) % 3
    away = reach / abs(frame[0, first])
    at = np.empty(3, np.int64)
    for i in range(-highest, highest + 1):
        part = i / frame[0, first]
        j0, k0 = part * frame[0, second], part * frame[0, third]
        for j in range(max(-highest, math.ceil(j0 - away)), min(highest, math.floor(j0 + away)) + 1):
            for k in range(max(-highest, math.ceil(k0 - away)), min(highest, math.floor(k0 + away)) + 1):
                at[first], at[second], at[third] = i, j, k
                z, y, x = at
                rows = z * frame[1, 0] + y * frame[1, 1] + x * frame[1, 2]
                columns = z * frame[2, 0] + y * frame[2, 1] + x * frame[2, 2]
                if x < 0 or rows * rows + columns * columns >= reach * reach:
                    continue
                along[count, 0] = z * frame[0, 0] + y * frame[0, 1] + x * frame[0, 2]
                along[count, 1], along[count, 2] = rows, columns
                turn = 2.0 * math.pi / side * (z * centre[0] + y * centre[1] + x * centre[2])
                size = response[abs(z)] * response[abs(y)] * response[x] * (2.0 if x > 0 else 1.0)
                weights[count] = size * complex(math.cos(turn), math.sin(turn))
                places[count] = ((z % side) * side + y % side) * (side // 2 + 1) + x
                count += 1
    return count


@inlined
def _around(place: float, count: int, places: np.ndarray, weights: np.ndarray) -> None:
    """Finds the points of a grid of `count`, with spacing 1/2, that a frequency is spread to, and their weights."""
    first = math.ceil(2.0 * place - _WIDTH / 2.0)
    for k in range(_WIDTH):
        places[k] = (np.int64(first) + k) % count
        weights[k] = _kernel(first + k - 2.0 * place)


@kernel
def _spread(values: np.ndarray, along: np.ndarray, grid: np.ndarray) -> None:
    places, weights = np.empty((3, _WIDTH), np.int64), np.empty((3, _WIDTH), np.float32)
    for n in range(values.size):
        for axis in range(3):
            _around(along[n, axis], grid.shape[axis], places[axis], weights[axis])
        for a in range(_WIDTH):
            for b in range(_WIDTH):
                row = grid[places[0, a], places[1, b]]
                value = values[n] * (weights[0, a] * weights[1, b])
                for c in range(_WIDTH):
                    row[places[2, c]] += value * weights[2, c]


@kernel
def _collect(grid: np.ndarray, along: np.ndarray, found: np.ndarray) -> None:
    places, weights = np.empty((3, _WIDTH), np.int64), np.empty((3, _WIDTH), np.float32)
    for n in range(found.size):
        for axis in range(3):
            _around(along[n, axis], grid.shape[axis], places[axis], weights[axis])
        total = np.complex64(0.0)
        for a in range(_WIDTH):
            for b in range(_WIDTH):
                row = grid[places[0, a], places[1, b]]
                part = np.complex64(0.0)
                for c in range(_WIDTH):
                    part += row[places[2, c]] * weights[2, c]
                total += part * (weights[0, a] * weights[1, b])
        found[n] = total
