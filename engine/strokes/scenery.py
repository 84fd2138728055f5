"""What a stroke looks at besides the pixels under it: another layer, the pen's pressure, the way it runs, itself as a
whole."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from immutables import Map

from engine.brush.checks import BrushError
from engine.brush.copies import NO_COPIES, Copies, Torus, copied, copied_places
from engine.brush.covered import Looks, Read, Scene
from engine.brush.dabs import Stroker
from engine.brush.dynamics import knots_of
from engine.brush.felt import PLACE_COLUMNS, radii_around, tints_of
from engine.brush.foretell import AREA_CAP
from engine.brush.mask import StrokeMask
from engine.brush.settings import FIXED_TO, SETTINGS, Brush
from engine.brush.tinting import Tinted
from engine.brush.tip_shape import ROUND
from engine.canvas import layers
from engine.canvas.growth import is_settled, settled
from engine.canvas.layers import Group, Layer
from engine.canvas.painted import tile_bounds
from engine.canvas.reading import layer_ink
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.numeric.prediction import Predictor
from engine.texture.planes import Planes

_WIDER, _SPARE = 1.5, 2.0  # of the stroke's radius, px
_SPACING, _FLOW = 0.15, 0.4  # so that a pixel sees about as far back as ahead, and little of what was there before
_PLAIN = 6  # columns of a dab that is round


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
        self._headings = Headings(brush, place, copies, chance) if looks.ways else None
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
        return rect if self._headings is None else rect.union(self._headings.lay(points))

    @property
    def predictor(self) -> Predictor | None:
        """Returns the filter that an op fitted to what was painted, once it has."""
        return self._memo.get("predictor")

    @property
    def scene(self) -> Scene:
        """Gives what a raster-op looks at, as the stroke is now."""
        pressure = self._mask.coverage() if self._looks.pressure else None
        ways = None if self._headings is None else self._headings.ways
        return Scene(self._source, self._origin, pressure, self._start, self._seed, self._memo, ways=ways)


class Headings:
    """The ways that one stroke runs, growing with it.  Along it lie dabs a little larger than its own, soft up to their
    middle, of which each tells its way; a pixel has the mean of those over it, as of colours (`tinting`).

    `place`: the stroke's level and origin; `chance`: of what is random in it."""

    def __init__(self, brush: Brush, place: tuple[int, tuple[int, int]], copies: Copies | Torus, chance: int) -> None:
        radius = min(brush.radius * radii_around(brush) * _WIDER + _SPARE, SETTINGS["radius"].hi)
        kept = {name: knots_of(curve) for name, curve in brush.dynamics.items() if name == "radius"}
        steady = replace(brush, radius=radius, opacity=1.0, flow=_FLOW, hardness=0.0, spacing=_SPACING, tip=None)
        self._brush = replace(steady, shape=ROUND, dynamics=Map(kept), wet=None, fixed=FIXED_TO[1])
        self._stroker, self._place, self._copies = Stroker(self._brush, chance), place, copies
        self._mask = self._blank()

    def _blank(self) -> StrokeMask:
        return StrokeMask(*self._place, tip=Tinted(None, 2))

    def lay(self, points: np.ndarray) -> Rect:
        """More points, as `Scenery.lay`; returns the pixels whose ways may be others now."""
        waited, dabs = self._stroker.waits, self._stroker.walk(points)
        stood = Rect(0, 0, 0, 0)
        if waited:
            stood, self._mask = self._mask.rect, self._blank()
        dabs = self._stroker.rest() if self._stroker.waits else dabs
        first = dabs.shape[1] - tints_of(self._brush) - PLACE_COLUMNS
        ways = _turned(dabs[:, first : first + 2], self._copies)
        touched: set[TileKey] = set()
        done = 0
        for part in copied(dabs, self._copies):
            told = ways[done : done + len(part)]
            touched |= self._mask.paint(np.concatenate([part[:, :_PLAIN], told], axis=1))
            done += len(part)
        return tile_bounds(touched).union(stood)

    @property
    def ways(self) -> dict[TileKey, np.ndarray]:
        """Gives what tiles know so far: float32 (2, 128, 128) each, which later dabs do not change."""
        return dict(self._mask.coverage().tints or {})


def _turned(ways: np.ndarray, copies: Copies | Torus) -> np.ndarray:
    """Returns the ways of dabs, float64 (n, 2), each followed by those of its copies."""
    told, each = (copies.copies, copies.each) if isinstance(copies, Torus) else (copies, 1 + len(copies))
    turned = copied_places(ways, tuple(one._replace(x=0.0, y=0.0) for one in told)).reshape(-1, 2)
    return np.repeat(turned, each // (1 + len(told)), axis=0)


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
