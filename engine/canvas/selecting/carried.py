"""What is selected as a layer meets it that is seen elsewhere: the selection, carried to where its paint lies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.placing.pose import Pose
from engine.canvas.placing.through import Seen, looked_through
from engine.canvas.selecting.selection import Selection
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect


@dataclass(frozen=True, eq=False, slots=True)
class Carried:
    """A selection on a layer; `canvas`: how the canvas, on which it lies, is seen from the layer."""

    selection: Selection
    canvas: Seen

    @classmethod
    def of(cls, selection: Selection, pose: Pose) -> Carried:
        """Makes it for a layer that is seen through quarter turns and powers of two."""
        return cls(selection, Seen(pose.similarity.inverse()))

    def part(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | float:
        """As `Selection.part`: where the move is by whole pixels, the very values of those that they are seen as."""

        def planes(at: int, part: Rect) -> np.ndarray | None:
            value = evaluate_sparse(self.selection.pyramid, at, part, cache)
            return None if value is None else value.rgba

        return self.selection.share(looked_through(planes, level, rect, self.canvas))

    def chosen(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray:
        """As `Selection.chosen`."""
        return np.broadcast_to(np.greater_equal(self.part(level, rect, cache), 0.5), (rect.height, rect.width)).copy()
