"""What a stroke looks at besides the pixels under it: another layer, the pen's pressure, itself as a whole."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.copies import NO_COPIES, Copies, Torus, copied
from engine.brush.covered import Looks, Read, Scene
from engine.brush.dabs import Stroker
from engine.brush.foretell import AREA_CAP
from engine.brush.mask import StrokeMask
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.growth import is_settled, settled
from engine.canvas.layers import Group, Layer
from engine.canvas.reading import layer_ink
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.prediction import Predictor
from engine.texture.planes import Planes


class Scenery:
    """What its mode's class asked to see (`looks`) of a stroke, growing with it.

    `place`: the stroke's level and origin; `seed`: of what is random; `source` reads the layer that is looked at.
    """

    def __init__(
        self,
        looks: Looks,
        brush: Brush,
        place: tuple[int, tuple[int, int]],
        seed: int,
        source: Read | None,
        copies: Copies | Torus = NO_COPIES,
        chance: int = 0,
    ) -> None:
        level, self._origin = place
        self._looks, self._source = looks, source
        steady = brush.dynamics.delete("flow") if "flow" in brush.dynamics else brush.dynamics
        self._brush = replace(brush, opacity=1.0, flow=1.0, hardness=1.0, dynamics=steady.set("opacity", "pressure"))
        self._stroker = Stroker(self._brush, chance)
        self._level, self._mask = level, StrokeMask(level, self._origin)
        self._copies = copies
        self._seed, self._start = seed, (0, 0)
        self._memo: dict[str, Predictor | None] = {}
        self._begun = False

    def lay(self, points: np.ndarray, covered: StrokeMask) -> Rect:
        """More points, float64 (n, 6), that are known to be good, of a stroke that has `covered` so much now.

        Returns the pixels that may look different although they were covered before.  BrushError if what is
        done cannot be done on so large a stroke; the points are not laid then.
        """
        rect = covered.rect if self._looks.whole else Rect(0, 0, 0, 0)
        if rect.area > AREA_CAP:
            raise BrushError("stroke", f"one of {rect.area} pixels", f"at most {AREA_CAP} of {self._looks.whole}")
        if not self._begun:
            left, top = (math.floor(value) for value in points[0, :2])
            self._start, self._begun = (self._origin[0] + left, self._origin[1] + top), True
        if self._looks.pressure:
            waited, dabs = self._stroker.waits, self._stroker.walk(points)
            if waited:
                self._mask = StrokeMask(self._level, self._origin)
            for part in copied(self._stroker.rest() if self._stroker.waits else dabs, self._copies):
                self._mask.paint(part)
        return rect

    @property
    def predictor(self) -> Predictor | None:
        """Returns the filter that an op fitted to what was painted, once it has."""
        return self._memo.get("predictor")

    @property
    def scene(self) -> Scene:
        """Gives what a raster-op looks at, as the stroke is now."""
        pressure = self._mask.coverage() if self._looks.pressure else None
        return Scene(self._source, self._origin, pressure, self._start, self._seed, self._memo)


def reader(root: Group, name: str, level: int, cache: TileCache | None) -> Read:
    """Reads the ink of a layer at a level.  BrushError if there is no layer of that name."""
    known = [node.name for node in layers.layers(root)]
    if name not in known:
        found = "a group" if layers.has(root, name) else "none of that name"
        listed = ", ".join(map(ascii, known[:12])) + (", ..." if len(known) > 12 else "")
        raise BrushError("brush.op.layer", f"{name!a}, {found}", f"a layer: {listed}")
    layer = layers.find(root, name)
    assert isinstance(layer, Layer)
    layer = layer if is_settled(layer.growth) else replace(layer, growth=settled(layer.growth))

    def read(rect: Rect) -> Planes:
        return layer_ink(layer, level, rect, cache)

    return read
