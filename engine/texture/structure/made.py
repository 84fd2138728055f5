"""Textures with a structure: joint statistics alone, or beginning with a layout that is taken as far as is asked."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.texture.structure.half_spectra import Size
from engine.texture.structure.laying_out import laid_out, top_of
from engine.texture.structure.pieced import has_pieces, pieced
from engine.texture.structure.statistics import Joint
from engine.texture.structure.synthesis import SWEEPS, Progressed, synthesised

PIECES = "pieces"  # the layout of which is of large pieces; else as in "full"
# Of each, from how little to how much of the example's layout is kept: the finest scale that is laid out, None for
# none, and the sweeps of scales 0, 1, ... that follow.
STRUCTURES: dict[str, tuple[int | None, tuple[int, ...]]] = {
    "statistics": (None, SWEEPS),
    "coarse": (2, (5, 5, 1)),
    "objects": (1, (5, 1)),
    "full": (0, (3,)),
    PIECES: (0, (3,)),
}
_LAID_OUT = 0.6  # of the work


def structured(picture: np.ndarray, wanted: Joint, structure: str, size: Size, seed: int) -> Iterator[Progressed]:
    """Yields the steps to planes (R, *size) with a structure; the last has them.

    `picture` (C, h, w): the example whose layout is kept, one too small for any being taken by its statistics alone;
    `wanted`: its statistics, or others along the same axes.
    """
    if wanted.axes.count == 0:
        yield Progressed(1.0, np.zeros((0, *size), np.float32))
        return
    finest, sweeps = STRUCTURES[structure]
    top = top_of((picture.shape[1], picture.shape[2]), size, len(wanted.scales))
    if finest is None or top < 0:
        yield from synthesised(wanted, size, seed)
        return
    finest = min(finest, top)
    laying, planes = laid_out(picture, wanted, size, seed, finest), None
    if structure == PIECES and has_pieces((picture.shape[1], picture.shape[2]), size):
        laying = _of_pieces(picture, wanted, size, seed)
    for stage in laying:
        planes = stage.planes
        yield Progressed(_LAID_OUT * stage.done, planes if finest == 0 else None)
    assert planes is not None
    for stage in synthesised(wanted, size, seed, sweeps[: finest + 1], (planes, finest)):
        yield Progressed(_LAID_OUT + (1.0 - _LAID_OUT) * stage.done, stage.planes)


def _of_pieces(picture: np.ndarray, wanted: Joint, size: Size, seed: int) -> Iterator[Progressed]:
    for done, texture in pieced(picture, size, seed):
        yield Progressed(done, None if texture is None else wanted.axes.planes(texture))
