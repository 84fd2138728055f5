"""What all strokes in progress share: what they began on, and their points."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from immutables import Map

from engine.brush import edits
from engine.brush.copies import NO_COPIES, Copies
from engine.brush.dabs import stroke_key
from engine.brush.settings import Brush
from engine.canvas.layers import Group
from engine.canvas.placing.pose import Pose
from engine.canvas.selecting.limit import Limit
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.prediction import Predictor
from engine.painting.commands import Stroke
from engine.painting.layering.onto_member import ONTO_PAINT
from engine.painting.pen_points import fitted
from engine.painting.points import like_first
from engine.painting.value import Painting, Refusal
from engine.strokes.mask_painting import sheet_for
from engine.strokes.wrapping import wrapped

POINTS_CAP = 60_000  # a stroke's line must stay below the 8 MiB that a recording's line may have
_NO_MEMBERS = Map[str, object]()  # one for all strokes: a long session has a million


class Drawn:
    """A stroke that still grows, on the painting as it was when the pen touched down.

    `base`: that painting, with the layer painted on made if there was none; `layer`: that layer, or the sheet of its
    mask that is painted on; `dropped`: how many
    points were no points (not finite, or too far away); `extra`: what else its command said, kept for the recording.
    `asked`: the number under which the journal knows its points.
    `own`: the seed of its random numbers, the painting's where its command (`seed`) has none; `chance`: what its
    dabs' random numbers hang on; `limit`: what the painting's selection leaves of it, None where that is all.
    `copies`: where it is drawn again, `origin`: from where, on the cell of a layer that is repeated; `areas`: what the
    last points laid may have changed, for it and each copy; `seen`: where the layer is, by which it is limited.
    BrushError if the brush lacks something or cannot be used, Refusal if the layer is locked.
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
        copies: Copies = NO_COPIES,
        onto: str = ONTO_PAINT,
        seen: Pose | None = None,
    ) -> None:
        edits.check(brush)
        self.base, self.layer = sheet_for(painting, layer, onto)
        self.before, self.cache = painting, cache
        self.level, self.brush, self.seed = level, brush, seed
        self._told, self._copies = origin, copies
        self.copies, self.origin = wrapped(self.layer, level, origin, copies)
        self.own = painting.seed if seed is None else seed
        self.chance = stroke_key(self.own, level, origin)
        self.limit = Limit.of(painting.selection, level, cache, self.layer.wrap, seen)
        self.dropped = 0
        self.areas: list[Rect] = []
        self.extra: Map[str, Any] = _NO_MEMBERS
        self.asked: int | None = None
        self._named, self.onto, self._seen = layer, onto, seen
        self._points: list[np.ndarray] = []
        self._count = 0
        self._begin()

    def _begin(self) -> None:
        """Prepares what a kind of stroke needs besides."""
        raise NotImplementedError

    @property
    def predictor(self) -> Predictor | None:
        """Returns the filter by which it continues what is painted, once that is fitted."""
        return None

    @property
    def full(self) -> bool:
        """Tells whether the stroke has as many points as one command can hold: end it and begin another."""
        return self._count >= POINTS_CAP

    @property
    def count(self) -> int:
        """Tells how many points the pen has told."""
        return self._count

    @property
    def empty(self) -> bool:
        """Tells whether the pen has told no point yet."""
        return self._count == 0

    def add(self, points: np.ndarray) -> Rect:
        """More of what the pen told: float64 (n, 2..7) as POINT_COLUMNS, in pixels of the level from the origin.

        Points that are no points are dropped and counted, the others brought within their bounds; those of a recording
        are taken as they are.
        Returns the pixels of the level whose preview may have changed.
        """
        table, dropped = fitted(np.atleast_2d(np.asarray(points, np.float64)))
        if self._points and self._points[0].shape[1] != table.shape[1]:
            table = like_first([self._points[0][:0], table])
        self.dropped += dropped
        return self.lay(table)

    def lay(self, points: np.ndarray) -> Rect:
        """As `add`, for points float64 (n, 6) that are known to be good.

        BrushError if they make the stroke too large: it is as it was before.
        """
        raise NotImplementedError

    def _keep(self, points: np.ndarray) -> None:
        self._points.append(points)
        self._count += len(points)

    def rebase(self, painting: Painting, base: Group) -> None:
        """Takes the painting below, further refined: with and without the layer that the stroke made."""
        self.before, self.base = painting, replace(self.base, root=base)

    def to_command(self) -> Stroke:
        """Returns the command that does the same; Refusal if there is no point."""
        if self.empty:
            raise Refusal("stroke: found no point, expected one at least")
        points = like_first(self._points)
        points.flags.writeable = False
        about = self._named, self.seed, self.extra, self._copies, self.onto, self._seen
        return Stroke(self.level, self._told, points, self.brush, *about)
