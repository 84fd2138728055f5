"""What a raster-op is given: the edit that it is part of, and what lies under the stroke in one tile."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from engine.brush import ops
from engine.brush.covered import Covered
from engine.brush.foretell import Foretold, foretell, predictor
from engine.brush.mask import Coverage
from engine.brush.mixture import Mixture
from engine.brush.tints import numbers
from engine.numeric.address import TILE, TileKey
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance

ALPHA = 3
_TINY = np.float32(1e-6)


@dataclass(frozen=True, eq=False, slots=True)
class Operand:
    """One tile under a stroke.  Arrays are float32 (128, 128) and not to be written to.

    `old`: what is there; `covered`: the stroke's coverage; `texture`: the brush's textures mixed, not cut off;
    `weight`: w, how far the op goes at each pixel; `free`: how strongly w follows the texture's finer detail.
    """

    key: TileKey
    old: Planes
    covered: np.ndarray
    texture: np.ndarray
    weight: np.ndarray
    free: np.ndarray


class Operating(Covered):
    """An edit that does what its brush's op says; `ink` is the brush's `mixture`."""

    @cached_property
    def op(self) -> ops.Chosen:
        """Gives what the brush's `op` says."""
        return ops.chosen(self.brush.op)

    @cached_property
    def colour(self) -> np.ndarray:
        """Returns the brush's colour, float32 (3,)."""
        return np.array(self.brush.rgb, np.float32)

    @cached_property
    def numbers(self) -> np.ndarray:
        """Returns the op's numeric parameters in turn, float32 (9,)."""
        return numbers(self.op)

    @cached_property
    def mixture(self) -> Mixture:
        """Gives the textures of the brush, mixed."""
        return Mixture(self.ink if self.brush.ink else None, self.level)

    @cached_property
    def foretold(self) -> Foretold | None:
        """Returns what the op "predict" fills the stroke with; None where nothing is painted that could be
        continued."""
        assert self.read is not None
        memo = self.scene.memo
        if "predictor" not in memo:
            window, reach = (round(self.op.parameters[name]) for name in ("window", "reach"))
            about = self.scene.start, window, reach, self.scene.arithmetic
            memo["predictor"] = predictor(self.read, *about)
        found = memo["predictor"]
        return None if found is None else foretell(self.coverage, self.read, found, self.scene.seed)


def plane(coverage: Coverage, key: TileKey) -> np.ndarray | None:
    """M of a tile as float32 (128, 128), None where it is nothing."""
    covered = coverage.tiles.get(key)
    if covered is None or isinstance(covered, np.ndarray):
        return covered
    return np.full((TILE, TILE), covered, np.float32) if covered > 0.0 else None


def straight(planes: np.ndarray, old: Planes) -> np.ndarray:
    """Straight colours (3, h, w) of premultiplied `planes`; those of `old` where there are none."""
    alpha = planes[ALPHA]
    below = np.clip(old.data[:ALPHA] / np.maximum(old.data[ALPHA], _TINY), 0.0, 1.0)
    straight: np.ndarray = np.where(alpha > 0.0, np.clip(planes[:ALPHA] / np.maximum(alpha, _TINY), 0.0, 1.0), below)
    return straight


def planes_of(inks: tuple[Instance, ...], into: tuple[Instance, ...]) -> np.ndarray:
    """For each of the 3n planes of the inks `into`, its place among the planes of a stack with `inks`, -1 for none."""
    places = {made: COLOURS + 3 * i for i, made in enumerate(inks)}
    return np.array([places[m] + c if m in places else -1 for m in into for c in range(3)], np.int64)
