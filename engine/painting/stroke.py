"""The stroke in progress: pen points in, the edit of the layer out.  Its preview is what its commit will be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from immutables import Map

from engine.brush import kinds, raster, relief, tip
from engine.brush.checks import BrushError
from engine.brush.dabs import Stroker
from engine.brush.ink import resolve
from engine.brush.mask import StrokeMask
from engine.brush.record import Brush
from engine.brush.stamp import Edit
from engine.canvas import commit, evaluate, layers
from engine.canvas.evaluate import TileCache
from engine.canvas.painted import tile_bounds
from engine.numeric.address import Rect
from engine.painting.commands import Stroke
from engine.painting.points import POINT_COLUMNS, REACH
from engine.painting.scenery import Scenery
from engine.painting.value import Painting, Refusal, layer_for
from engine.texture.planes import Planes

POINTS_CAP = 60_000  # a stroke's line must stay below the 8 MiB that a recording's line may have
_DEFAULTS, _LOWEST, _HIGHEST = (np.array(column) for column in list(zip(*POINT_COLUMNS, strict=True))[1:])


class LiveStroke:
    """A stroke that still grows, on the painting as it was when the pen touched down.

    `base`: that painting, with the layer painted on made if there was none; `layer`: that layer; `dropped`: how many
    points were no points (not finite, or too far away); `extra`: what else its command said, kept for the recording.
    Refusal if the layer is locked or the brush cannot be used.
    """

    def __init__(
        self,
        painting: Painting,
        level: int,
        origin: tuple[int, int],
        brush: Brush,
        cache: TileCache | None = None,
        layer: str | None = None,
        seed: int | None = None,
    ) -> None:
        kinds.check(brush)
        self.base, self.layer = layer_for(painting, layer)
        self.before = painting
        self.level, self.origin, self.brush, self.seed = level, origin, brush, seed
        self.cache = cache
        self.dropped = 0
        self.extra: Map = Map()
        self._named = layer
        self._points: list[np.ndarray] = []
        self._count = 0
        self._stroker = Stroker(brush)
        own = painting.seed if seed is None else seed
        self._tip = tip.resolve(brush, painting.textures, level, own)
        self._mask = StrokeMask(level, origin, tip=self._tip)
        inks = {"paint": resolve, "raster": raster.mixture}
        self._ink = inks[brush.mode](brush, painting.textures, level, own) if brush.mode in inks else None
        looking = brush.mode == "raster" or (self._ink is not None and bool(self._ink.swayed))
        self._scenery = Scenery(brush, self.base.root, level, origin, own, cache) if looking else None
        self._relief = relief.resolve(brush, painting.textures, level, (own, painting.seed))
        self._edit: Edit | None = None

    @property
    def full(self) -> bool:
        """Whether the stroke has as many points as one command can hold: end it and begin another."""
        return self._count >= POINTS_CAP

    @property
    def empty(self) -> bool:
        return self._count == 0

    def add(self, points: np.ndarray) -> Rect:
        """More of what the pen told: float64 (n, 2..6) as POINT_COLUMNS, in pixels of the level from the origin.

        Points that are no points are dropped and counted, the others brought within their bounds; those of a recording
        are taken as they are.
        Returns the pixels of the level whose preview may have changed.
        """
        return self.lay(self._fit(np.atleast_2d(np.asarray(points, np.float64))))

    def lay(self, points: np.ndarray) -> Rect:
        """As `add`, for points float64 (n, 6) that are known to be good.

        BrushError if they make the stroke too large: it is as it was before.
        """
        if not len(points):
            return Rect(0, 0, 0, 0)
        try:
            dirty = tile_bounds(self._mask.paint(self._stroker.walk(points)))
            dirty = dirty if dirty.empty else dirty.grown(self._relief.reach)
            if self._scenery is not None:
                dirty = dirty.union(self._scenery.lay(points, self._mask.rect))
        except BrushError:
            self._again()
            raise
        self._points.append(points)
        self._count += len(points)
        self._edit = None
        return dirty

    def _again(self) -> None:
        """Lays the points that were kept, and nothing else."""
        self._stroker = Stroker(self.brush)
        self._mask = StrokeMask(self.level, self.origin, tip=self._tip)
        self._edit = None
        for points in self._points:
            self._mask.paint(self._stroker.walk(points))

    def _fit(self, given: np.ndarray) -> np.ndarray:
        table = np.empty((len(given), len(POINT_COLUMNS)))
        table[:, : given.shape[1]] = given
        table[:, given.shape[1] :] = _DEFAULTS[given.shape[1] :]
        table += 0.0  # no negative zeros
        if ((table >= _LOWEST) & (table <= _HIGHEST)).all():
            return table
        table[:, 3:] = np.nan_to_num(table[:, 3:], nan=0.0, posinf=0.0, neginf=0.0)
        good = np.isfinite(table[:, :3]).all(axis=1) & (np.abs(table[:, :2]) <= REACH).all(axis=1)
        self.dropped += int((~good).sum())
        return np.clip(table[good], _LOWEST, _HIGHEST)

    @property
    def rect(self) -> Rect:
        """A rectangle of pixels of the level outside which nothing changes."""
        rect = self._mask.rect
        return rect if rect.empty else rect.grown(self._relief.spread)

    @property
    def edit(self) -> Edit:
        """The edit of the layer that the points so far make."""
        if self._edit is None:
            scene = None if self._scenery is None else self._scenery.scene
            self._edit = kinds.edit(
                self.brush, self._mask, self._ink, self.layer.alpha_locked, self._read, self._relief, scene
            )
        return self._edit

    def _read(self, rect: Rect) -> Planes:
        return evaluate.evaluate(self.layer.pyramid, self.level, rect, self.cache)

    def preview(self, rect: Rect) -> Planes:
        """The layer's pixels of `rect` at the stroke's level, as they will be."""
        return commit.preview(self.layer.pyramid, self.edit, rect, self.cache)

    def commit(self) -> Painting:
        """The painting with the stroke on its layer."""
        if self.empty:
            return self.before
        pyramid = commit.commit(self.layer.pyramid, self.edit, self.cache)
        if pyramid is self.layer.pyramid:
            return self.base
        return replace(self.base, root=layers.with_pyramid(self.base.root, self.layer.name, pyramid))

    def to_command(self) -> Stroke:
        """The command that does the same; Refusal if there is no point."""
        if self.empty:
            raise Refusal("stroke: found no point, expected one at least")
        points = np.concatenate(self._points)
        points.flags.writeable = False
        return Stroke(self.level, self.origin, points, self.brush, self._named, self.seed, self.extra)
