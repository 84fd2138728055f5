"""What a stroke looks at besides the pixels under it: for a raster-op another layer; the pen's pressure."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from engine.brush import ops
from engine.brush.checks import BrushError
from engine.brush.dabs import Stroker
from engine.brush.foretell import AREA_CAP
from engine.brush.mask import StrokeMask
from engine.brush.raster import Read, Scene
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.evaluate import TileCache
from engine.canvas.growth import is_settled, settled
from engine.canvas.layers import Group, Layer
from engine.canvas.reading import layer_ink
from engine.numeric.address import Rect
from engine.numeric.formula import variables
from engine.numeric.prediction import Predictor
from engine.texture.planes import Planes


class Scenery:
    """Grows with the stroke: one of a raster-op, or one whose ink goes with the pressure.  BrushError if the op names a
    layer that is none of `root`'s."""

    def __init__(
        self, brush: Brush, root: Group, level: int, origin: tuple[int, int], seed: int, cache: TileCache | None
    ) -> None:
        op = ops.chosen(brush.op if brush.mode == "raster" else "toward")
        self._level, self._origin = level, origin
        self._source = _reader(root, op.parameters["layer"], level, cache) if "layer" in op.parameters else None
        self._pressed = brush.mode != "raster" or (op.tree is not None and "pressure" in variables(op.tree))
        steady = brush.dynamics.delete("flow") if "flow" in brush.dynamics else brush.dynamics
        self._brush = replace(brush, opacity=1.0, flow=1.0, hardness=1.0, dynamics=steady.set("opacity", "pressure"))
        self._stroker = Stroker(self._brush)
        self._mask = StrokeMask(level, origin)
        self._seed, self._start = seed, (0, 0)
        self._predicts = op.row is not None and op.row.name == "predict"
        self._memo: dict[str, Predictor | None] = {}
        self._begun = False

    def lay(self, points: np.ndarray, rect: Rect) -> Rect:
        """More points, float64 (n, 6), that are known to be good, of a stroke that now covers `rect`.

        Returns the pixels that may look different although they were covered before.  BrushError if the op cannot be
        done on so large a stroke; the points are not laid then.
        """
        if self._predicts and rect.area > AREA_CAP:
            raise BrushError("stroke", f"one of {rect.area} pixels", f"at most {AREA_CAP} of the operation predict")
        if not self._begun:
            left, top = (math.floor(value) for value in points[0, :2])
            self._start, self._begun = (self._origin[0] + left, self._origin[1] + top), True
        if self._pressed:
            self._mask.paint(self._stroker.walk(points))
        return rect if self._predicts else Rect(0, 0, 0, 0)

    @property
    def predictor(self) -> Predictor | None:
        """The filter that an op fitted to what was painted, once it has."""
        return self._memo.get("predictor")

    @property
    def scene(self) -> Scene:
        pressure = self._mask.coverage() if self._pressed else None
        return Scene(self._source, self._origin, pressure, self._start, self._seed, self._memo)


def _reader(root: Group, name: str, level: int, cache: TileCache | None) -> Read:
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
