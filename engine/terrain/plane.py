"""Heights of a painting that never end: terraces at no level, and the same bits whatever window asks for them.

A `Land` is a painting seen as land: which brightness is its height, and how high that is.  `Land.height(level, rect)`
gives float64 (h, w) in pixels of level 0, of the centres of the level's pixels: pixel i lies at (i + 1/2) / 2^level.
With luma = .2126 R + .7152 G + .0722 B of the values as they are stored, not clamped,

    height = scale (luma + (1 - alpha) ground - sea).

`scale`: pixels of level 0 from black to white; by default the layer's own, else a sixth of the frame's width.  `sea`:
the brightness that lies at height 0; by default the layer's own, else 0.  `ground`: the brightness of what is not
painted on; by default the median of the frame's rim, chosen when the land is made.  `source`: a layer's or group's
name, "composite" (all that is in the picture), "alpha" (how opaque that is) or "impasto" (how thick paint lies, alone,
whatever the scale); by default the layer of the role
"height" if there is one, else "composite".

What brushes heaped on the source, in pixels, comes on top (`engine.canvas.heaps`).

**Deep down** float64 ends, too.  Down to level 32 heights are told from the sea.  Beyond, they are told relative to one
pixel, `about`: by default the one 32 levels up that the first tile of the window lies in, so that a tile's heights are
a function of the tile alone.  Windows that are seen together ask with the same `about`, which may be any pixel of a
level from 1 to theirs (`Land.about` gives the usual one); then they fit bit for bit, as windows above level 32 do.

A layer's brightness follows the recurrence of `engine.terrain.layer_heights`; so does that of layers and groups that
lie over one another plainly.  Where blending is more than that (other modes, masks, clipping, placements, layers that
wrap around) there is only the picture that the canvas shows, on its grid of 2^-16.
"""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.merging.paper import Paper
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import AS_HEIGHT
from engine.numeric.address import TILE, Rect
from engine.painting.value import Painting
from engine.terrain.heaped_land import heaped_bound, heaped_heights
from engine.terrain.land_bound import Remainder, layer_bound, nothing_lies
from engine.terrain.layer_heights import Brightness, Pixel, Zero, layer_brightness, luma, zeros_of

COMPOSITE, ALPHA, IMPASTO = "composite", "alpha", "impasto"
DEEP = 32  # levels below level 0, and below a pixel that heights are relative to, that float64 has room for
_RIM = 256  # pixels of the longer side of the frame whose rim is looked at
_THERE = 0.5  # alpha from which a pixel of it counts
_PART = 6  # of the frame's width: how high white is


@dataclass(frozen=True)
class Land:
    """A painting seen as land; see above.  `land` makes one.  Safe for several threads."""

    painting: Painting
    source: str
    scale: float
    sea: float
    ground: float
    cache: TileCache | None = None
    _known: dict[tuple[int, Pixel], tuple[Zero, ...]] = field(default_factory=dict, repr=False, compare=False)

    def height(self, level: int, rect: Rect, about: Pixel | None = None) -> np.ndarray:
        """Returns heights of a rectangle of a level, relative to the pixel `about` if there is one: float64 (h, w), in
        pixels of level 0."""
        if about is None and level > DEEP:
            about = self.about(level, rect)
        return self._bare(level, rect, about) + self._heaped(level, rect, about)

    def _bare(self, level: int, rect: Rect, about: Pixel | None) -> np.ndarray:
        """Returns the heights without what is heaped on them."""
        if about is None:
            return self._told(self._brightness(level, rect, None), self.sea)
        if not 0 < about.level <= level:
            raise ValueError(f"heights: found a pixel of level {about.level}, expected one of level 1 to {level}")
        one = self._brightness(about.level, about.rect, about)
        taken = float((one.fine + (one.still + (1.0 - one.alpha) * self.ground))[0, 0])
        return self._told(self._brightness(level, rect, about), taken)

    def _heaped(self, level: int, rect: Rect, about: Pixel | None) -> np.ndarray | float:
        """Returns what brushes heaped on the source, or of "impasto" on all layers that show."""
        steps = () if about is None else range(about.level, 0, -DEEP)
        out: np.ndarray | float = 0.0
        for layer, opacity in _heaping(self.painting.root, self.source):
            out = out + heaped_heights(layer, level, rect, about, steps, self.cache) * opacity
        return out

    def about(self, level: int, rect: Rect) -> Pixel:
        """Returns the pixel that the heights of a window of a level beyond 32 are relative to, if nothing is said."""
        return Pixel(level, rect.x0 // TILE * TILE, rect.y0 // TILE * TILE).above(level - DEEP)

    def _told(self, seen: Brightness, taken: float) -> np.ndarray:
        """Returns the heights that brightness tells, relative to a brightness."""
        out: np.ndarray = (seen.fine + (seen.still + (1.0 - seen.alpha) * self.ground - taken)) * self.scale
        return out

    def _brightness(self, level: int, rect: Rect, about: Pixel | None) -> Brightness:
        if self.source == IMPASTO:
            return Brightness(np.zeros((rect.height, rect.width)), 0.0, 1.0)
        if self.source in (COMPOSITE, ALPHA):
            root = layers.pictured(self.painting.root)
            seen = self._whole(root, level, rect, about)
            if self.source == COMPOSITE:
                return seen
            return Brightness(np.zeros((rect.height, rect.width)), np.asarray(seen.alpha, np.float64), 1.0)
        node = layers.find(self.painting.root, self.source)
        if isinstance(node, Layer) and node.wrap is None and node.mask is None:
            return self._layer(node, level, rect, about)
        if isinstance(node, Group) and node.mask is None and _plain(node.children):
            return self._group(node.children, level, rect, about)
        return self._canvas(layers.alone(node, self.painting.root), level, rect, about)

    def _whole(self, root: Group, level: int, rect: Rect, about: Pixel | None) -> Brightness:
        if not _plain(root.children):
            return self._canvas(root, level, rect, about)
        seen = self._group(root.children, level, rect, about)
        if root.paper is None:
            return seen
        paper = float(luma(Paper(root.paper).planes(Rect(0, 0, 1, 1)))[0, 0])
        return Brightness(seen.fine, seen.still + (1.0 - seen.alpha) * paper, 1.0)

    def _group(self, nodes: Iterable[Node], level: int, rect: Rect, about: Pixel | None) -> Brightness:
        """Returns what plain nodes come to, lying over one another."""
        under = Brightness(np.zeros((rect.height, rect.width)), 0.0, 0.0)
        for node in nodes:
            if not node.visible or not node.opacity:
                continue
            if isinstance(node, Group):
                over = self._group(node.children, level, rect, about)
            else:
                assert isinstance(node, Layer)
                over = self._layer(node, level, rect, about)
            under = _over(under, over, node.opacity)
        return under

    def _layer(self, layer: Layer, level: int, rect: Rect, about: Pixel | None) -> Brightness:
        return layer_brightness(layer, level, rect, () if about is None else self._zeros(layer, about), self.cache)

    def _zeros(self, layer: Layer, about: Pixel) -> tuple[Zero, ...]:
        key = layer.id, about
        found = self._known.get(key)
        if found is None:
            found = zeros_of(layer, about, range(about.level, 0, -DEEP), self.cache)
            self._known[key] = found
        return found

    def bound(self, level: int, rect: Rect) -> Remainder | None:
        """Returns how far the land in a rectangle may be from its heights at a level, in pixels of level 0: no finer
        level, expanded from there, differs by more.  None where nothing is known: where several layers lie over one
        another, where they are more than laid over one another, and where ink is renewed."""
        heaped = Remainder(0.0, 0.0)
        for layer, opacity in _heaping(self.painting.root, self.source):
            more = heaped_bound(layer, level, rect, self.cache)
            if more is None:
                return None
            heaped = Remainder(heaped.hard + opacity * more.hard, heaped.rms + opacity * more.rms)
        return heaped if self.source == IMPASTO else self._bare_bound(level, rect, heaped)

    def _bare_bound(self, level: int, rect: Rect, heaped: Remainder) -> Remainder | None:
        """Returns the bound of what is not heaped, with that of what is."""
        told = self._only_layer(level, rect)
        if told is None:
            return None
        layer, opacity, ground = told
        found = Remainder(0.0, 0.0)
        if layer is not None:
            seen = layer_bound(layer, ground, level, rect, self.cache)
            if seen is None:
                return None
            found = seen
        by = abs(self.scale) * opacity
        return Remainder(found.hard * by + heaped.hard, found.rms * by + heaped.rms)

    def _only_layer(self, level: int, rect: Rect) -> tuple[Layer | None, float, float] | None:
        """Returns the one layer that lies in a rectangle, its opacity, and the brightness of what it does not cover;
        None if there are more."""
        if self.source == ALPHA:
            return None
        if self.source == COMPOSITE:
            root = layers.pictured(self.painting.root)
            ground = (
                self.ground if root.paper is None else float(luma(Paper(root.paper).planes(Rect(0, 0, 1, 1)))[0, 0])
            )
            node: Node = root
        else:
            node, ground = layers.find(self.painting.root, self.source), self.ground
        if isinstance(node, Layer):
            return None if node.wrap is not None or node.mask is not None else (node, 1.0, ground)
        if not isinstance(node, Group) or node.mask is not None or not _plain(node.children):
            return None
        there = [one for one in _shown(node.children) if not nothing_lies(one[0], level, rect, self.cache)]
        return None if len(there) > 1 else (*there[0], ground) if there else (None, 1.0, ground)

    def rim(self) -> float:
        """Returns the median brightness of what is painted along the frame's rim; 0 where nothing is."""
        frame, level = self.painting.frame, 0
        while max(frame.width, frame.height) > _RIM:
            frame, level = frame.zoomed(-1), level - 1
        x0, y0, x1, y1 = frame
        rows = Rect(x0, y0, x1, y0 + 1), Rect(x0, y1 - 1, x1, y1)
        found: list[float] = []
        for side in (*rows, Rect(x0, y0, x0 + 1, y1), Rect(x1 - 1, y0, x1, y1)):
            seen = self._brightness(level, side, None)
            alpha = np.broadcast_to(seen.alpha, seen.fine.shape)
            there = alpha >= _THERE
            found += ((seen.fine + seen.still)[there] / alpha[there]).tolist()
        return statistics.median(found) if found else 0.0

    def _canvas(self, root: Group, level: int, rect: Rect, about: Pixel | None) -> Brightness:
        """Returns the picture as the canvas has it."""
        planes = composite(root, level, rect, partial(layer_planes, cache=self.cache))
        alpha = planes[3].astype(np.float64)
        return Brightness(luma(planes), 0.0, alpha)


def land(
    painting: Painting,
    source: str | None = None,
    scale: float | None = None,
    sea: float | None = None,
    ground: float | None = None,
    cache: TileCache | None = None,
) -> Land:
    """Returns a painting seen as land; what is not given is as described above.  LayerError if there is no such layer.

    `cache`: tiles of the canvas that are kept, which is faster where more than one window is looked at.
    """
    node = heights_of(painting) if source is None else None
    if source not in (None, COMPOSITE, ALPHA, IMPASTO):
        node = layers.find(painting.root, source)
    told = node if isinstance(node, Layer) else None
    source = source or (COMPOSITE if node is None else node.name)
    scale = _first(scale, None if told is None else told.scale, painting.frame.width / _PART)
    sea = _first(sea, None if told is None else told.sea, 0.0)
    made = Land(painting, source, scale, sea, 0.0 if ground is None else ground, cache)
    return made if source in (ALPHA, IMPASTO) or ground is not None else replace(made, ground=made.rim())


def heights_of(painting: Painting) -> Node | None:
    """Returns the layer or placement of the role "height", if there is one."""
    found = (node for node in layers.walk(painting.root) if not isinstance(node, Group) and node.role == AS_HEIGHT)
    return next(found, None)


def _first(*given: float | None) -> float:
    return next(number for number in given if number is not None)


def height(painting: Painting, source: str | None, level: int, rect: Rect, about: Pixel | None = None) -> np.ndarray:
    """Returns `Land.height` of the land that a source of a painting makes."""
    return land(painting, source).height(level, rect, about)


def _plain(nodes: Iterable[Node]) -> bool:
    """Tells whether nodes, those that show, lie over one another without more ado."""
    for node in nodes:
        if not node.visible:
            continue
        if node.blend != "src-over" or node.clip:
            return False
        if isinstance(node, Group):
            if node.mask is not None or not _plain(node.children):
                return False
        elif not isinstance(node, Layer) or node.wrap is not None or node.mask is not None:
            return False
    return True


def _heaping(root: Group, source: str) -> Iterable[tuple[Layer, float]]:
    """Returns the layers on which the heights of a source are heaped, each with its opacity."""
    if source == IMPASTO:
        return _shown(layers.pictured(root).children)
    if source in (COMPOSITE, ALPHA):
        return ()
    node = layers.find(root, source)
    return ((node, 1.0),) if isinstance(node, Layer) else ()


def _shown(nodes: Iterable[Node]) -> Iterator[tuple[Layer, float]]:
    """Yields the layers that show, each with its opacity."""
    for node in nodes:
        if not node.visible or not node.opacity:
            continue
        if isinstance(node, Group):
            yield from _shown(node.children)
        elif isinstance(node, Layer):
            yield node, node.opacity


def _over(under: Brightness, over: Brightness, opacity: float) -> Brightness:
    seen = 1.0 - over.alpha * opacity
    if isinstance(seen, float) and seen == 0.0:
        return over
    alpha = over.alpha * opacity + seen * under.alpha
    fine = over.fine * opacity + seen * under.fine
    return Brightness(fine, over.still * opacity + seen * under.still, alpha)
