"""Where things lie: a small picture put together from an example's patches on a torus, made finer as far as is asked.

At an eighth of the size all patches are compared, from large ones to small (Kwatra et al. 2005, Granot et al. 2022);
finer, those that go on from the neighbours' (Ashikhmin 2001, Lefebvre & Hoppe 2005).  After each size, joint
statistics are given once.  A start may fail, so several are made, and the one that is most like the example stays.
"""

from __future__ import annotations

import os
from collections.abc import Generator, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from threading import Event

import numpy as np

from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.real_fourier import irfft2, rfft2
from engine.numeric.sums import total
from engine.texture.structure.half_spectra import Size, halved_size, low_mask, masked, regridded, resized
from engine.texture.structure.nearest import Patches
from engine.texture.structure.patches import coherent, laid_down, quilted, weights_of
from engine.texture.structure.statistics import Joint, bands_measured, unlike
from engine.texture.structure.sweep import swept
from engine.texture.structure.synthesis import Progressed, from_noise

_TOP = 3  # scale at which all patches are compared, if there is room
_SIDES = (13, 13, 11, 11, 9, 9, 7, 7, 7, 7)  # of patches, one after the other
_SIDE = 7  # of those at finer scales
_ROUNDS = (1, 2, 3)  # at scales 0, 1, 2
_STARTS = ((16, 6, 1.1), (12, 5, 1.02), None)  # blocks of quilts: side, overlap, tolerance; None: joint statistics
_NARROWEST = 2 * _SIDE  # an example's grid
_SWEEPS = 6  # of a start by statistics
_LOOK = 0.02  # seconds between two looks at starts that threads make
_DOMAIN = 0x6C61796F  # "layo"

Laid = tuple[np.ndarray, np.ndarray]  # planes, and where their patches come from


@dataclass(frozen=True, slots=True, eq=False)
class Ground:
    """An example at a scale: `planes` (R, h, w), and its `colours` (h, w, R), planes times `spreads`."""

    planes: np.ndarray
    spreads: np.ndarray
    colours: np.ndarray

    @property
    def size(self) -> Size:
        """Returns height and width."""
        return self.planes.shape[1], self.planes.shape[2]

    def seen(self, planes: np.ndarray) -> np.ndarray:
        """Returns planes (R, h, w) as colours (h, w, R)."""
        return np.ascontiguousarray((planes * self.spreads[:, None, None]).transpose(1, 2, 0))

    def unseen(self, colours: np.ndarray) -> np.ndarray:
        """Undoes `seen`."""
        out: np.ndarray = np.ascontiguousarray(colours.transpose(2, 0, 1)) / self.spreads[:, None, None]
        return out


def top_of(example: Size, size: Size, scales: int = _TOP) -> int:
    """Tells at which scale a layout begins; -1 if the example is too small for any.  `scales`: those of the statistics
    that are given after each size, fewer where they are mixed with those of a small picture."""
    top = min(_TOP, scales)
    while top >= 0 and (min(halved_size(example, top)) < _NARROWEST or min(halved_size(size, top)) < _SIDE):
        top -= 1
    return top


def laid_out(picture: np.ndarray, wanted: Joint, size: Size, seed: int, finest: int) -> Iterator[Progressed]:
    """Yields the steps to planes (R, h, w) of the grid of scale `finest`, or of the coarsest that there is room for, of
    a texture of a size, laid out as an example (C, h, w); `wanted`: its statistics, or others of the same axes."""
    top = top_of((picture.shape[1], picture.shape[2]), size, len(wanted.scales))
    grounds = yield from _grounds(picture, wanted, max(top, 0))
    planes, source = yield from _begun(grounds[top], wanted, halved_size(size, top), seed, top)
    yield Progressed(0.5, planes)
    for scale in range(top - 1, finest - 1, -1):
        planes, source = yield from _refined(grounds[scale], wanted, halved_size(size, scale), (planes, source), scale)
        yield Progressed(0.5 + 0.5 * (top - scale) / (top - finest), planes)


def _grounds(picture: np.ndarray, wanted: Joint, top: int) -> Generator[Progressed, None, list[Ground]]:
    """Returns the example at the scales up to one: mirrored at its edges, so that none meets the other."""
    planes = wanted.axes.planes(picture)
    around = np.pad(planes, ((0, 0), (0, planes.shape[1]), (0, planes.shape[2])), mode="symmetric")
    spreads = np.sqrt(total(np.square(wanted.axes.axes), axis=0))
    spreads = (spreads / spreads.max()).astype(np.float32)
    whole, half, out = (around.shape[1], around.shape[2]), rfft2(around), []
    for scale in range(top + 1):
        grid, (height, width) = halved_size(whole, scale), halved_size((planes.shape[1], planes.shape[2]), scale)
        yield Progressed(0.0)
        seen = planes if scale == 0 else irfft2(masked(resized(half, whole[1], grid), low_mask(grid)), grid, True)
        seen = np.ascontiguousarray(seen[:, :height, :width])
        out.append(Ground(seen, spreads, np.ascontiguousarray((seen * spreads[:, None, None]).transpose(1, 2, 0))))
    return out


def _begun(ground: Ground, wanted: Joint, size: Size, seed: int, top: int) -> Generator[Progressed, None, Laid]:
    """Yields until the best of several starts is found; returns it."""
    goal = bands_measured(ground.planes, 2)
    sides = [side for side in _SIDES if side <= max(_SIDE, min(ground.size) // 2)]
    known: dict[int, Patches] = {}
    for side in sides:
        if side not in known:
            known[side] = Patches(ground.colours, side, size[0] * size[1])
            yield Progressed(0.0)

    given_up = Event()

    def begin(number: int) -> tuple[float, Laid]:
        planes = _started(ground, wanted, size, (seed, number), _STARTS[number], top)
        for side in sides:
            if given_up.is_set():
                break
            source = known[side].nearest(ground.seen(planes), ground.size)
            planes = ground.unseen(laid_down(ground.colours, source, weights_of(side)))
        planes = _once(planes, wanted, top)
        return unlike(bands_measured(planes, 2), goal), (planes, source)

    found: list[tuple[float, Laid]] = []
    pool = ThreadPoolExecutor(min(os.cpu_count() or 1, len(_STARTS)), "inkfall layout")
    try:
        for number, begun in enumerate([pool.submit(begin, number) for number in range(len(_STARTS))]):
            while not wait([begun], _LOOK).done:
                yield Progressed(0.5 * number / len(_STARTS))
            found.append(begun.result())
    finally:  # nobody waits for what is not wanted any more
        given_up.set()
        pool.shutdown(wait=False, cancel_futures=True)
    return min(found, key=lambda one: one[0])[1]


def _started(
    ground: Ground, wanted: Joint, size: Size, key: tuple[int, int], block: tuple[int, int, float] | None, top: int
) -> np.ndarray:
    if block is None:
        return from_noise(wanted, size, key[0], top, _SWEEPS)
    side = min(block[0], min(ground.size) // 2, *size)
    step = max(side - side * block[1] // block[0], 1)
    rows, columns = (-(-n // step) for n in size)
    hashed = hash_plane(fold_key(_DOMAIN, *key), 0, 0, columns, rows) >> np.uint64(40)
    chances = hashed.astype(np.float64) * 2.0**-24
    return ground.unseen(quilted(ground.colours, size, (side, *block[1:]), chances))


def _refined(ground: Ground, wanted: Joint, size: Size, coarse: Laid, scale: int) -> Generator[Progressed, None, Laid]:
    planes, source = regridded(coarse[0], size), _doubled(coarse[1], size)
    weights = weights_of(_SIDE)
    for turn in range(_ROUNDS[scale]):
        seen = ground.seen(planes)
        for _ in range(2 if turn == 0 else 1):
            source = coherent(seen, ground.colours, source, weights)
        planes = ground.unseen(laid_down(ground.colours, source, weights))
        yield Progressed(0.5)
    return _once(planes, wanted, scale), source


def _doubled(source: np.ndarray, size: Size) -> np.ndarray:
    """Returns sources on the grid of twice the size: four places of the example for each."""
    rows, columns = (np.arange(n) for n in size)
    out = 2 * source[rows // 2][:, columns // 2]
    out[..., 0] += (rows % 2)[:, None]
    out[..., 1] += columns % 2
    return np.ascontiguousarray(out, np.int32)


def _once(planes: np.ndarray, wanted: Joint, scale: int) -> np.ndarray:
    *_, found = swept(planes, wanted, scale)
    assert found is not None
    return found
