"""What a raster-op looks at besides the pixels under the stroke: another layer, the pen's pressure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.brush import ops
from engine.brush.checks import BrushError
from engine.brush.dabs import Stroker
from engine.brush.mask import StrokeMask
from engine.brush.raster import Read, Scene
from engine.brush.record import Brush
from engine.canvas import evaluate, layers
from engine.canvas.evaluate import TileCache
from engine.canvas.layers import Group, Layer
from engine.numeric.address import Rect
from engine.numeric.formula import variables
from engine.texture.planes import Planes


class Scenery:
    """Grows with the stroke.  BrushError if the op names a layer that is none of `root`'s."""

    def __init__(self, brush: Brush, root: Group, level: int, origin: tuple[int, int], cache: TileCache | None) -> None:
        op = ops.chosen(brush.op)
        self._level, self._origin = level, origin
        self._source = _reader(root, op.parameters["layer"], level, cache) if "layer" in op.parameters else None
        self._pressed = op.tree is not None and "pressure" in variables(op.tree)
        steady = brush.dynamics.delete("flow") if "flow" in brush.dynamics else brush.dynamics
        self._brush = replace(brush, opacity=1.0, flow=1.0, hardness=1.0, dynamics=steady.set("opacity", "pressure"))
        self.again()

    def again(self) -> None:
        """Begins anew, without a point."""
        self._stroker = Stroker(self._brush)
        self._mask = StrokeMask(self._level, self._origin)

    def lay(self, points: np.ndarray) -> None:
        """More points, float64 (n, 6), that are known to be good."""
        if self._pressed:
            self._mask.paint(self._stroker.walk(points))

    @property
    def scene(self) -> Scene:
        return Scene(self._source, self._origin, self._mask.coverage() if self._pressed else None)


def _reader(root: Group, name: str, level: int, cache: TileCache | None) -> Read:
    known = [node.name for node in layers.layers(root)]
    if name not in known:
        found = "a group" if layers.has(root, name) else "none of that name"
        listed = ", ".join(map(ascii, known[:12])) + (", ..." if len(known) > 12 else "")
        raise BrushError("brush.op.layer", f"{name!a}, {found}", f"a layer: {listed}")
    layer = layers.find(root, name)
    assert isinstance(layer, Layer)

    def read(rect: Rect) -> Planes:
        return evaluate.evaluate(layer.pyramid, level, rect, cache)

    return read
