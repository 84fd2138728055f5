"""The canvas on the graphics card: tiles come in as bytes, one pass shows them.

The card holds the least recently seen tiles of any level in one texture array.  A place whose tile has not come yet
shows its nearest ancestor magnified; the tile then fades in over it.  Nothing here computes paint.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import moderngl

from app.canvas.cell_pass import CellPass, Row
from app.canvas.lamp import Lamp
from app.canvas.shader_files import shader_source
from app.canvas.tile_heights import TileHeights
from app.canvas.view import View
from engine.light.light import BRIGHTNESS, BY_ALPHA, BY_IMPASTO, BY_PICTURE, RIM, Light
from engine.numeric.address import Rect
from engine.studio.requests import SCREEN_TILE
from engine.studio.results import Patch

FADE = 0.13  # seconds
ANCESTORS = 12  # levels up that are searched for something to show
LIGHT, DARK = 0.955, 0.225  # greys of the squares where there is no paper, and of the desk around them
_FLAT = 32768 / 65535  # of heights of impasto: where there is none
CONTRAST = 0.045  # of the squares
SQUARE = 16  # side of the paper's squares, pixels of the view's level
Insets = tuple[float, float, float, float]


class ScreenTile(NamedTuple):
    """Screen tile (x, y) covers pixels [256 x, 256 x + 256) x [256 y, 256 y + 256) of its level."""

    level: int
    x: int
    y: int

    def ancestor(self, levels: int) -> ScreenTile:
        """Gives the tile that holds this one, so many levels coarser."""
        return ScreenTile(self.level - levels, self.x >> levels, self.y >> levels)


@dataclass(slots=True)
class _Held:
    layer: int
    revision: int
    born: float
    opaque: bool = False  # covers the paper everywhere, as far as is known
    empty: bool = True  # shows nothing, for certain


@dataclass(slots=True)
class ScreenPlan:
    """What the canvas is to show.  Cells of each pass: nine floats each, as canvas.vert reads them; the paper needs
    only where they lie.  Plans that are equal look alike."""

    view: View
    frame: Rect | None
    insets: Insets
    uploads: int  # of tiles, so far
    colour: str | None = None  # of the paper, "#rrggbb"; None: squares
    light: Light | None = None  # that the picture is seen in
    paper: list[Row] = field(default_factory=list)
    whole: list[Row] = field(default_factory=list)
    fading: list[Row] = field(default_factory=list)
    moving: bool = False  # something still fades
    lacks: int = 0  # tiles that are not there


def cells(view: View, level: int, rim: int = 0) -> list[ScreenTile]:
    """Returns the tiles of `level` that the screen meets, or a rim around it, pixels of the level, row by row."""
    r = view.visible(level).grown(rim)
    return [
        ScreenTile(level, x, y)
        for y in range(r.y0 // SCREEN_TILE, (r.y1 - 1) // SCREEN_TILE + 1)
        for x in range(r.x0 // SCREEN_TILE, (r.x1 - 1) // SCREEN_TILE + 1)
    ]


def near_first(view: View, tiles: list[ScreenTile], x: float, y: float) -> list[ScreenTile]:
    """Ordered by the distance of their middles to a screen point."""

    def far(tile: ScreenTile) -> float:
        cx, cy = view.pixel_to_screen(
            tile.level, tile.x * SCREEN_TILE + SCREEN_TILE // 2, tile.y * SCREEN_TILE + SCREEN_TILE // 2
        )
        return math.hypot(cx - x, cy - y)

    return sorted(tiles, key=far)


class Screen:
    """Tiles held on the card, and the passes that draw them.  All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._paper = CellPass(ctx, shader_source("paper.vert"), shader_source("paper.frag"))
        cell = shader_source("canvas.vert")
        self._whole = CellPass(ctx, cell, shader_source("tile.frag"))
        self._fading = CellPass(ctx, cell, shader_source("fade.frag"))
        self._lamp, self._heights = Lamp(ctx), TileHeights(ctx)
        self._array: Any = None
        self._held: OrderedDict[ScreenTile, _Held] = OrderedDict()
        self._free: list[int] = []
        self._uploads = 0

    def _allocate(self, view: View) -> None:
        """Room for the visible tiles at the smallest scale, their ancestors and some places visited before."""
        across = [math.ceil(n / (SCREEN_TILE * 0.7)) + 2 for n in (view.width, view.height)]
        most = self.ctx.info["GL_MAX_ARRAY_TEXTURE_LAYERS"]
        layers = min(most, max(192, 3 * across[0] * across[1]))
        self._array = self.ctx.texture_array((SCREEN_TILE, SCREEN_TILE, layers), 4)
        self._array.repeat_x = self._array.repeat_y = False
        self._free = list(range(layers))[::-1]

    def revision(self, tile: ScreenTile) -> int:
        """Returns the revision of the painting that a tile shows; -1 where it is not held."""
        held = self._held.get(tile)
        return held.revision if held else -1

    def upload(self, patch: Patch, view: View, now: float) -> None:
        """Takes in a part of a tile, or a whole one.

        A part of a tile that is not held is dropped: the whole tile will be asked for.
        """
        if self._array is None:
            self._allocate(view)
        tile, area = ScreenTile(*patch.tile), patch.area
        held = self._held.get(tile)
        whole = area.width == SCREEN_TILE and area.height == SCREEN_TILE
        if held is None:
            if not whole:
                return
            held = self._held[tile] = _Held(self._room(), patch.revision, now)
        self._array.write(patch.pixels, viewport=(area.x0, area.y0, held.layer, area.width, area.height, 1))
        self._heights.take(held.layer, area, patch.heights, self._array.size)
        self._uploads += 1
        alpha = patch.pixels[..., 3]
        held.opaque = bool(alpha.min() == 255) and (whole or held.opaque)
        bare = not alpha.any() and (patch.heights is None or not patch.heights.any())
        held.empty = bare and (whole or held.empty)
        held.revision = max(held.revision, patch.revision)
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

    def draw(self, plan: ScreenPlan) -> None:
        """Draws the canvas."""
        view, light = plan.view, plan.light
        self._set_uniforms(view, plan.frame, plan.colour)
        size, free = (view.width, view.height), free_part(view, plan.insets)
        self.ctx.viewport, self.ctx.scissor = (0, 0, *size), free
        self.ctx.disable(moderngl.BLEND)
        self._paper.draw(plan.paper)
        if light is None:
            self._draw_tiles(plan)
        elif self._array is not None:
            target = self._lamp.begin(size)
            self._set_rim(RIM)
            if plan.colour is not None:
                self._paper.draw(plan.paper)
            self._draw_tiles(plan)
            self._set_rim(0)
            self._lamp.raise_from(_ground(light.height, plan.colour))
            self._heights.draw(plan.whole + plan.fading, self._array, light.height, view)
            if light.height == BY_IMPASTO:  # thickness is in pixels of the level, which is magnified
                light = replace(light, depth=light.depth * 2.0**view.fraction)
            self._lamp.show(light, target, free)
        self.ctx.scissor = None

    def _set_rim(self, pixels: int) -> None:
        for one in (self._paper, self._whole, self._fading):
            one.program["rim"] = pixels

    def _draw_tiles(self, plan: ScreenPlan) -> None:
        view = plan.view
        if self._array is not None:
            exact = not view.fraction and not view.angle
            self._array.filter = (moderngl.NEAREST, moderngl.NEAREST) if exact else (moderngl.LINEAR, moderngl.LINEAR)
            self._array.use(0)
            self.ctx.enable(moderngl.BLEND)
            self.ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
            self._whole.draw(plan.whole)
            self._fading.draw(plan.fading)

    def _set_uniforms(self, view: View, frame: Rect | None, colour: str | None) -> None:
        a, b, c, d = view.matrix()
        for one in (self._paper, self._whole, self._fading):
            one.program["size"], one.program["turn"] = (view.width, view.height), (a, b, c, d)
        p = self._paper.program
        levels = (view.level, view.level + 1)
        phase: list[float] = []
        for level in levels:
            x, y = view.centre.pixel(level)
            fx, fy = view.centre.offset(level, x, y)
            phase += [(x % (2 * SQUARE) + fx) / SQUARE, (y % (2 * SQUARE) + fy) / SQUARE]
        p["inverse"], p["frame"] = (a, c, b, d), frame_on_screen(view, frame)
        p["pitch"] = tuple(1 / (SQUARE * view.scale(level)) for level in levels)
        p["phase"], p["blend"] = tuple(phase), view.fraction
        light: tuple[float, ...] = (LIGHT,) * 3
        dark: tuple[float, ...] = (DARK,) * 3
        if colour is not None:
            light = dark = _rgb(colour)
        p["light"], p["dark"], p["contrast"] = light, dark, CONTRAST if colour is None else 0.0

    def plan(
        self,
        view: View,
        frame: Rect | None,
        now: float,
        insets: Insets = (0.0, 0.0, 0.0, 0.0),
        paper: str | None = None,
        light: Light | None = None,
    ) -> ScreenPlan:
        """Returns what to draw, decided before anything is drawn.

        `insets`: how far panels that hide what is under them reach in from the left, top, right and bottom; `paper`:
        its colour, None where there is none; `light`: that the picture is seen in.
        """
        plan = ScreenPlan(view, frame, insets, self._uploads, paper, light)
        exact = not view.fraction and not view.angle
        for tile in cells(view, view.shown_level, 0 if light is None else 2 * RIM):
            held = self._touch(tile)
            up = next((n for n in range(1, ANCESTORS) if tile.ancestor(n) in self._held), 0)
            plan.lacks += held is None
            weight = 0.0 if held is None else min(1.0, (now - held.born) / FADE) if up else 1.0
            corner = _corner(view, tile, exact)
            if held is None or not held.opaque or weight < 1.0:
                plan.paper.append((*corner, 1.0, -1, -1, 0.0, 0.0, 1.0))
            if held is not None and held.empty and weight == 1.0:
                continue
            if held is not None and weight == 1.0:
                plan.whole.append((*corner, 1.0, held.layer, -1, 0.0, 0.0, 1.0))
            elif up:
                above = self._touch(tile.ancestor(up))
                assert above is not None
                layer = held.layer if held else -1
                plan.fading.append((*corner, weight, layer, above.layer, *_ancestor_part(tile, up)))
                plan.moving |= held is not None
            else:
                self._descendants(plan, view, tile, 2)
        return plan

    def bare(
        self, view: View, frame: Rect | None, insets: Insets, paper: str | None, hidden: bool = False
    ) -> ScreenPlan:
        """Returns a plan of the paper alone; of nothing where that is `hidden`."""
        if hidden:
            return ScreenPlan(view, frame, insets, 0, paper)
        exact = not view.fraction and not view.angle
        corners = [_corner(view, tile, exact) for tile in cells(view, view.shown_level)]
        rows: list[Row] = [(*at, 1.0, -1, -1, 0.0, 0.0, 1.0) for at in corners]
        return ScreenPlan(view, frame, insets, 0, paper, paper=rows)

    def _touch(self, tile: ScreenTile) -> _Held | None:
        held = self._held.get(tile)
        if held is not None:
            self._held.move_to_end(tile)
        return held

    def _descendants(self, plan: ScreenPlan, view: View, tile: ScreenTile, depth: int) -> None:
        """Finer tiles, shrunk, for a place left by zooming out."""
        for n in (0, 1, 2, 3):
            child = ScreenTile(tile.level + 1, tile.x * 2 + (n & 1), tile.y * 2 + (n >> 1))
            held = self._held.get(child)
            if held is not None:
                plan.whole.append((*_corner(view, child, False), 1.0, held.layer, -1, 0.0, 0.0, 1.0))
            elif depth > 1:
                self._descendants(plan, view, child, depth - 1)


def _ground(height: str, colour: str | None) -> float:
    """Returns how high paper of a colour lies where there is nothing but it, 0 to 1."""
    if height == BY_IMPASTO:
        return _FLAT
    if colour is None or height not in (BY_ALPHA, BY_PICTURE):
        return 0.0
    return 1.0 if height == BY_ALPHA else sum(part * of for part, of in zip(_rgb(colour), BRIGHTNESS, strict=True))


def _rgb(colour: str) -> tuple[float, ...]:
    return tuple(int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))


def free_part(view: View, insets: Insets) -> tuple[int, int, int, int]:
    """Returns the part of the screen that panels leave free, as GL has it: x, y of the lower left corner, width,
    height."""
    left, top, right, bottom = (max(0, math.floor(inset)) for inset in insets)
    return left, bottom, max(0, view.width - left - right), max(0, view.height - top - bottom)


def _corner(view: View, tile: ScreenTile, snap: bool) -> tuple[float, float, float]:
    x, y = view.pixel_to_screen(tile.level, tile.x * SCREEN_TILE, tile.y * SCREEN_TILE)
    if snap:  # at a whole zoom, tile pixels fall on screen pixels
        x, y = round(x), round(y)
    return x, y, SCREEN_TILE * view.scale(tile.level)


def _ancestor_part(tile: ScreenTile, up: int) -> tuple[float, float, float]:
    """Corner and side of a tile within its ancestor `up` levels above, as parts of the ancestor's side."""
    mask, n = (1 << up) - 1, 1 << up
    return (tile.x & mask) / n, (tile.y & mask) / n, 1 / n


def frame_on_screen(view: View, frame: Rect | None) -> tuple[float, float, float, float]:
    """Returns the level-0 frame seen from the view's centre: screen pixels before turning; everything when there is
    none."""
    if frame is None:
        return -1e9, -1e9, 1e9, 1e9
    n = max(view.shown_level, 0)
    s, out = view.scale(n), []
    for x, y in ((frame.x0, frame.y0), (frame.x1, frame.y1)):
        fx, fy = view.centre.offset(n, x << n, y << n)
        out += [max(-1e9, min(1e9, -fx * s)), max(-1e9, min(1e9, -fy * s))]
    return out[0], out[1], out[2], out[3]
