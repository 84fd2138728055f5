"""The heights that go to the window along with the pixels of tiles, while it shows the painting in the light."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.heaps.seen_heaps import HeapsOf, thickness
from engine.canvas.layers import Group, alone, find, has
from engine.canvas.reading import Read
from engine.checks.owned import Owned
from engine.light.light import BY_ALPHA, BY_IMPASTO, BY_PICTURE, height_of_thickness
from engine.light.lit_relief import luminance
from engine.numeric.address import Rect
from engine.painting.difference import Areas
from engine.studio.results import WHITE_HEIGHT, frozen


class SeenHeights(Owned):
    """It belongs to the engine's thread.  `changed` is told that all of the picture is another one."""

    def __init__(self, changed: Callable[[Areas], None]) -> None:
        self._source: str | None = None  # of the heights, as in `Light.height`; None: the window wants none
        self._changed = changed

    def want(self, source: str | None) -> None:
        """From now on the window wants heights of a source, or none: those it has been sent are old."""
        if source != self._source:
            self._source = source
            if source is not None:
                self._changed(lambda level: None)

    def of(
        self, root: Group, level: int, part: Rect, picture: np.ndarray, read: Read, heaps_of: HeapsOf
    ) -> np.ndarray | None:
        """Returns the heights of a rectangle: uint16 (h, w), up to WHITE_HEIGHT; None if none are wanted.
        `picture`: what is seen there, float32 (4, h, w); `read` gives layers, `heaps_of` what is heaped on them."""
        source = self._source
        if source is None:
            return None
        if source == BY_ALPHA:
            heights = picture[3]
        elif source == BY_IMPASTO:
            heights = height_of_thickness(thickness(root, level, part, heaps_of, read))
        elif source == BY_PICTURE or not has(root, source):
            heights = luminance(picture)
        else:
            heights = luminance(composite(alone(find(root, source), root), level, part, read))
        return frozen(np.rint(np.clip(heights, 0.0, 1.0) * np.float32(WHITE_HEIGHT)).astype(np.uint16))
