"""The canvas on the graphics card: tiles come in as bytes, one pass shows them.

The card holds the least recently seen tiles of any level in one texture array.  A place whose tile has not come yet
shows its nearest ancestor magnified; the tile then fades in over it.  Nothing here computes paint.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import moderngl
import numpy as np

from app.view import View
from engine.numeric.address import Rect
from engine.painting.requests import SIDE

FADE = 0.13  # seconds
ANCESTORS = 12  # levels up that are searched for something to show
LIGHT, DARK = (0.955, 0.955, 0.955), (0.225, 0.225, 0.225)
MINIFY_LINEAR = (moderngl.LINEAR, moderngl.LINEAR)
Insets = tuple[float, float, float, float]


class ScreenTile(NamedTuple):
    """Screen tile (x, y) covers pixels [256 x, 256 x + 256) x [256 y, 256 y + 256) of its level."""

    level: int
    x: int
    y: int

    def ancestor(self, levels: int) -> ScreenTile:
        return ScreenTile(self.level - levels, self.x >> levels, self.y >> levels)


@dataclass(slots=True)
class _Held:
    layer: int
    revision: int
    born: float


def cells(view: View, level: int) -> list[ScreenTile]:
    """The tiles of `level` that the screen meets, row by row."""
    r = view.visible(level)
    return [
        ScreenTile(level, x, y)
        for y in range(r.y0 // SIDE, (r.y1 - 1) // SIDE + 1)
        for x in range(r.x0 // SIDE, (r.x1 - 1) // SIDE + 1)
    ]


def near_first(view: View, tiles: list[ScreenTile], x: float, y: float) -> list[ScreenTile]:
    """Ordered by the distance of their middles to a screen point."""

    def far(tile: ScreenTile) -> float:
        cx, cy = view.pixel_to_screen(tile.level, tile.x * SIDE + SIDE // 2, tile.y * SIDE + SIDE // 2)
        return math.hypot(cx - x, cy - y)

    return sorted(tiles, key=far)


def shader_source(name: str) -> str:
    """A file of the `shaders` folder, which lies beside the packages, in a checkout as in an installation."""
    return (Path(__file__).resolve().parent.parent / "shaders" / name).read_text("utf-8")


def _program(ctx: moderngl.Context, vertex: str, fragment: str) -> Any:
    return ctx.program(vertex_shader=shader_source(vertex), fragment_shader=shader_source(fragment))


class Screen:
    """Tiles held on the card, and the pass that draws them.  All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._paper = _program(ctx, "paper.vert", "paper.frag")
        self._paper_quad = ctx.vertex_array(self._paper, [])
        self._tiles: Any = None
        self._array: Any = None
        self._held: OrderedDict[ScreenTile, _Held] = OrderedDict()
        self._free: list[int] = []

    def _allocate(self, view: View) -> None:
        """Room for the visible tiles at the smallest scale, their ancestors and some places visited before."""
        across = [math.ceil(n / (SIDE * 0.7)) + 2 for n in (view.width, view.height)]
        most = self.ctx.info["GL_MAX_ARRAY_TEXTURE_LAYERS"]
        layers = min(most, max(192, 3 * across[0] * across[1]))
        self._tiles = _program(self.ctx, "tiles.vert", "tiles.frag")
        self._array = self.ctx.texture_array((SIDE, SIDE, layers), 4)
        self._array.filter = MINIFY_LINEAR
        self._array.repeat_x = self._array.repeat_y = False
        self._free = list(range(layers))[::-1]
        self._buffer = self.ctx.buffer(reserve=36 * layers * 4)
        self._quads = self.ctx.vertex_array(self._tiles, [(self._buffer, "4f 4f 1f/i", "cell", "source", "span")])

    def revision(self, tile: ScreenTile) -> int:
        """The revision of the painting that a tile shows; -1 where it is not held."""
        held = self._held.get(tile)
        return held.revision if held else -1

    def upload(self, tile: ScreenTile, area: Rect, pixels: np.ndarray, revision: int, view: View, now: float) -> None:
        """Pixels uint8 (h, w, 4), premultiplied, of the rectangle `area` inside a tile (0..256).

        A part of a tile that is not held is dropped: the whole tile will be asked for.
        """
        if self._array is None:
            self._allocate(view)
        held = self._held.get(tile)
        whole = area.width == SIDE and area.height == SIDE
        if held is None:
            if not whole:
                return
            held = self._held[tile] = _Held(self._room(), revision, now)
        self._array.write(pixels, viewport=(area.x0, area.y0, held.layer, area.width, area.height, 1))
        held.revision = max(held.revision, revision)
        self._held.move_to_end(tile)

    def confirm(self, tile: ScreenTile, revision: int) -> None:
        """The tile is still what revision `revision` shows."""
        held = self._held.get(tile)
        if held is not None:
            held.revision = max(held.revision, revision)

    def forget(self) -> None:
        """Drops every tile: another painting is shown."""
        self._free.extend(h.layer for h in self._held.values())
        self._held.clear()

    def _room(self) -> int:
        if not self._free:
            _, oldest = self._held.popitem(last=False)
            return oldest.layer
        return self._free.pop()

    def draw(self, view: View, frame: Rect | None, now: float, insets: Insets = (0.0, 0.0, 0.0, 0.0)) -> bool:
        """Draws the canvas; True while something still fades.

        `insets`: how far panels that hide what is under them reach in from the left, top, right and bottom.
        """
        self.ctx.viewport = (0, 0, view.width, view.height)
        self.ctx.scissor = _free(view, insets)
        try:
            self.ctx.disable(moderngl.BLEND)
            self._draw_paper(view, frame)
            return self._array is not None and self._draw_tiles(view, now)
        finally:
            self.ctx.scissor = None

    def _draw_tiles(self, view: View, now: float) -> bool:
        rows, fading = self._rows(view, now)
        if not rows:
            return fading
        data = np.array(rows, np.float32)
        self._buffer.orphan()
        self._buffer.write(data)
        self._tiles["size"] = (view.width, view.height)
        self._tiles["turn"] = view.matrix()
        self._array.filter = MINIFY_LINEAR if view.fraction or view.angle else (moderngl.NEAREST, moderngl.NEAREST)
        self._array.use(0)
        self.ctx.enable(moderngl.BLEND)
        self.ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._quads.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(rows))
        return fading

    def _draw_paper(self, view: View, frame: Rect | None) -> None:
        p = self._paper
        fine = [view.level + 1, view.level]
        sides = [16 * view.scale(n) for n in (view.level, view.level + 1)]
        phase: list[float] = []
        for level in reversed(fine):
            x, y = view.centre.pixel(level)
            fx, fy = view.centre.offset(level, x, y)
            phase += [(x % 32 + fx) / 16, (y % 32 + fy) / 16]
        a, b, c, d = view.matrix()
        p["size"], p["middle"] = (view.width, view.height), (view.width / 2, view.height / 2)
        p["inverse"], p["cell"], p["phase"], p["blend"] = (a, c, b, d), tuple(sides), tuple(phase), view.fraction
        p["frame"] = frame_on_screen(view, frame)
        p["light"], p["dark"] = LIGHT, DARK
        self._paper_quad.render(moderngl.TRIANGLES, vertices=3)

    def _rows(self, view: View, now: float) -> tuple[list[tuple[float, ...]], bool]:
        """What to draw, decided before anything is drawn: one row of nine floats a quad."""
        level, rows, fading = view.shown_level, [], False
        snap = not view.fraction and not view.angle
        for tile in cells(view, level):
            held = self._touch(tile)
            up = next((n for n in range(1, ANCESTORS) if tile.ancestor(n) in self._held), 0)
            if held is None and not up:
                rows += self._descendants(view, tile, 2)
                continue
            weight = 0.0 if held is None else min(1.0, (now - held.born) / FADE) if up else 1.0
            fading |= held is not None and weight < 1.0
            place = _ancestor_part(tile, up) if weight < 1.0 else (0.0, 0.0, 1.0)
            above = self._touch(tile.ancestor(up)) if up and weight < 1.0 else None
            layers = (held.layer if held else -1, above.layer if above else -1)
            rows.append((*_corner(view, tile, snap), weight, *layers, *place))
        return rows, fading

    def _touch(self, tile: ScreenTile) -> _Held | None:
        held = self._held.get(tile)
        if held is not None:
            self._held.move_to_end(tile)
        return held

    def _descendants(self, view: View, tile: ScreenTile, depth: int) -> list[tuple[float, ...]]:
        """Finer tiles, shrunk, for a place left by zooming out."""
        rows: list[tuple[float, ...]] = []
        for n in (0, 1, 2, 3):
            child = ScreenTile(tile.level + 1, tile.x * 2 + (n & 1), tile.y * 2 + (n >> 1))
            held = self._held.get(child)
            if held is not None:
                rows.append((*_corner(view, child, False), 1.0, held.layer, -1, 0.0, 0.0, 1.0))
            elif depth > 1:
                rows += self._descendants(view, child, depth - 1)
        return rows


def _free(view: View, insets: Insets) -> tuple[int, int, int, int]:
    """The part of the screen that panels leave free, as GL has it: x, y of the lower left corner, width, height."""
    left, top, right, bottom = (max(0, math.floor(inset)) for inset in insets)
    return left, bottom, max(0, view.width - left - right), max(0, view.height - top - bottom)


def _corner(view: View, tile: ScreenTile, snap: bool) -> tuple[float, float, float]:
    x, y = view.pixel_to_screen(tile.level, tile.x * SIDE, tile.y * SIDE)
    if snap:  # at a whole zoom, tile pixels fall on screen pixels
        x, y = round(x), round(y)
    return x, y, SIDE * view.scale(tile.level)


def _ancestor_part(tile: ScreenTile, up: int) -> tuple[float, float, float]:
    """Corner and side of a tile within its ancestor `up` levels above, as parts of the ancestor's side."""
    mask, n = (1 << up) - 1, 1 << up
    return (tile.x & mask) / n, (tile.y & mask) / n, 1 / n


def frame_on_screen(view: View, frame: Rect | None) -> tuple[float, float, float, float]:
    """The level-0 frame seen from the view's centre: screen pixels before turning; everything when there is none."""
    if frame is None:
        return -1e9, -1e9, 1e9, 1e9
    s, out = view.scale(0), []
    level = view.shown_level
    n = max(level, 0)
    s = view.scale(n)
    for x, y in ((frame.x0, frame.y0), (frame.x1, frame.y1)):
        fx, fy = view.centre.offset(n, x << n, y << n)
        out += [max(-1e9, min(1e9, -fx * s)), max(-1e9, min(1e9, -fy * s))]
    return out[0], out[1], out[2], out[3]
