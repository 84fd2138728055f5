"""What all edits of strokes share: where the stroke covers, with what, and what it may look at."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from engine.brush import coat
from engine.brush.ink import Ink, Texture
from engine.brush.mask import Coverage
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.prediction import Predictor
from engine.texture.image import ImageSource
from engine.texture.planes import Planes

Read = Callable[[Rect], Planes]  # the old values of a rectangle of the stroke's level


@dataclass(frozen=True, slots=True)
class Looks:
    """What a stroke looks at besides the pixels under it: the pen's `pressure` at each; another `layer`, by name;
    `rim`: so many pixels within its own rim, 0 for nothing of that; `ways`: which way it runs.
    `whole` names what has to see the whole stroke before it knows any pixel, "" for nothing of the kind."""

    pressure: bool = False
    layer: str | None = None
    whole: str = ""
    rim: float = 0.0
    ways: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """What `Looks` asked for.

    `source`: reads the layer that the op names, at the stroke's level; `origin`: the stroke's, in pixels of its level;
    `pressure`: the stroke's coverage laid with the pen's pressure as opacity: the strongest that went over a pixel.
    `start`: the pixel where the stroke begins; `seed`: of what is random; `memo`: what was learnt there, kept for the
    whole stroke; `arithmetic`: the painting's; `covered`: the stroke's coverage before anything thins it; `ways`:
    what its tiles know of the way that it runs (`strokes.scenery.Headings`).
    """

    source: Read | None = None
    origin: tuple[int, int] = (0, 0)
    pressure: Coverage | None = None
    start: tuple[int, int] = (0, 0)
    seed: int = 0
    memo: dict[str, Predictor | None] = field(default_factory=dict)
    arithmetic: int = LIBRARY
    covered: Coverage | None = None
    ways: Mapping[TileKey, np.ndarray] | None = None


@dataclass(frozen=True, eq=False)
class Covered:
    """An edit of the tiles that a stroke covers; one class a mode.  `locked`: under alpha lock."""

    coverage: Coverage
    brush: Brush
    ink: Ink | None
    locked: bool
    read: Read | None
    scene: Scene = field(default_factory=Scene)

    @staticmethod
    def ink_of(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> Ink | None:
        """Returns the ink that strokes of the mode are made with, as `ink.resolve`; None for those that need none."""
        return None

    @staticmethod
    def looks(brush: Brush, ink: Ink | None) -> Looks:
        """Returns what strokes of the mode look at."""
        return Looks()

    @property
    def level(self) -> int:
        """Gives the level of the stroke."""
        return self.coverage.level

    @property
    def tiles(self) -> tuple[TileKey, ...]:
        """Gives the tiles that the stroke covers a part of."""
        return self.coverage.keys

    @property
    def rect(self) -> Rect:
        """Gives a rectangle outside which nothing is covered."""
        return self.coverage.rect

    @property
    def spares_alpha(self) -> bool:
        """Tells whether alpha stays as it is, at every level."""
        return self.locked

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns the change of one tile, as `stamp.Edit.stamp`."""
        raise NotImplementedError

    def keep(self, key: TileKey) -> np.ndarray | None:
        """1 - M over a tile, M being the stroke's coverage on the grid: float32 (128, 128), or None where nothing is
        covered."""
        covered = self.coverage.tiles.get(key)
        if covered is None:
            return None
        keep = np.empty((TILE, TILE), np.float32)
        if not isinstance(covered, np.ndarray):
            keep[...] = 1.0 - np.rint(covered * 65536.0) / 65536.0
            return keep if keep[0, 0] < 1.0 else None
        return keep if coat.keep_of(covered, keep) else None
