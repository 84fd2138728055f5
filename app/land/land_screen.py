"""Land as the card draws it: tiles that morph from level to level, in the light that the engine has laid on them."""

from __future__ import annotations

import math
import time
from collections import OrderedDict
from collections.abc import Callable

import moderngl
import numpy as np

from app.canvas.renderers import fills_pixels
from app.canvas.shader_files import shader_source
from app.desk.desk import Desk
from app.desk.land.land_state import QUICK, LandState
from app.land.still_fade import StillFade
from engine.terrain.seen.choosing import Anchor, LandSight, anchor
from engine.terrain.seen.land_tiles import (
    BRIGHTEST,
    FINER,
    QUADS,
    TEXEL_RIM,
    TEXELS,
    LandTile,
    TileKey,
    corner_heights,
    grid,
    triangles,
)
from engine.terrain.seen.tile_light import towards_sun

_HAZE = 13.0  # frames' widths at which it hides all but a third
_NEAR = 0.2  # of how high the eye is above the ground: nothing nearer is drawn
_BORN = 0.35  # seconds in which a tile that has come parts from its parent's mesh
_WHOLE = TEXELS + 2 * TEXEL_RIM
_COARSE = 0.75  # of width and height, that are drawn while the eye moves where the processor fills the pixels
_STOPS = 0.12  # seconds without a move after which all pixels are
_WAITED = 0.0005  # seconds: pixels that were waited for no longer may have been filled long before
_TILES_A_FLUSH = 16  # tiles that a software renderer is told of before it fills their pixels, beside what comes next
_SETTLES = 1.0  # seconds after the last tile that has come, in which neighbours may still show another painting
SPARE_CARDS = 48  # tiles not drawn that are on the card, where each takes 0.1 MB
_SKY = 24, 16  # columns and rows of the sky's corners
_BARE = 6 * QUADS * QUADS  # corners of a tile's triangles but for its skirts'


class _OnCard:
    """A tile on the card."""

    def __init__(self, ctx: moderngl.Context, program: moderngl.Program, tile: LandTile, shared: _Shared) -> None:
        self.tile = tile
        self._heights = ctx.buffer(corner_heights(tile).tobytes())
        layout = [(shared.at, "3f", "at"), (self._heights, "2f", "heights")]
        self.mesh = ctx.vertex_array(program, layout, shared.faces)
        self.picture = ctx.texture((_WHOLE, _WHOLE), 3, tile.colours.tobytes(), alignment=1)
        self.picture.repeat_x = self.picture.repeat_y = False
        self.picture.build_mipmaps()
        self.picture.filter = shared.filter

    def release(self) -> None:
        self.mesh.release()
        self._heights.release()
        self.picture.release()


class _Shared:
    """What all tiles have in common."""

    def __init__(self, ctx: moderngl.Context, slow: bool) -> None:
        self.at = ctx.buffer(grid().tobytes())
        self.faces = ctx.buffer(triangles().tobytes())
        self.filter = moderngl.LINEAR_MIPMAP_NEAREST if slow else moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR


class _Target:
    """A picture that is drawn to."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int]) -> None:
        self.picture = ctx.texture(size, 3, alignment=1)
        self.picture.repeat_x = self.picture.repeat_y = False
        self._depths = ctx.depth_renderbuffer(size)
        self.frame = ctx.framebuffer([self.picture], self._depths)

    def release(self) -> None:
        for one in (self.frame, self.picture, self._depths):
            one.release()


class LandScreen:
    """All calls from the thread that owns the context.  `flush`: has the card begin with what it was told."""

    def __init__(self, ctx: moderngl.Context, flush: Callable[[], None] = lambda: None) -> None:
        self._ctx, self._flush = ctx, flush
        self._sources = shader_source("terrain.vert"), shader_source("terrain.frag")
        self._sky_sources = shader_source("sky.vert"), shader_source("sky.frag")
        self._slow = fills_pixels(ctx.info["GL_RENDERER"])
        self._program: moderngl.Program | None = None
        self._shown: _Target | None = None
        self._tiles: OrderedDict[TileKey, _OnCard] = OrderedDict()  # the longest not drawn first
        self._fade = StillFade(ctx)
        self._targets: dict[float, _Target] = {}  # by the part of width and height that they have
        self._part = 1.0  # of the last picture
        self._moves = False
        self._began: float | None = None  # when the picture that is on its way was

    def begin(self, desk: Desk, now: float) -> None:
        """Has the land drawn anew if it has changed: its pixels are filled beside what is done before `draw`."""
        state = desk.land
        if state.eye is None or min(state.size) < 8:
            return
        part = _COARSE if self._slow and now - state.moved < _STOPS else 1.0
        if state.changed or (self._began is None and (self._moves or part > self._part)):
            self._began = time.perf_counter()
            self._picture(state, now, part)
            self._flush()
            state.changed = False

    def draw(self, desk: Desk, now: float) -> bool:
        """Sees to it that the land is drawn as it is now; True if the window is to be drawn again."""
        state = desk.land
        if state.eye is None or min(state.size) < 8:
            return False
        fresh = self._fade.follow(state, now)
        self.begin(desk, now)
        if self._began is None:
            return fresh
        before = time.perf_counter()
        self._ctx.finish()
        after = time.perf_counter()
        took = after - self._began
        state.adapt(took if after - before > _WAITED else min(took, QUICK))
        self._began = None
        return True

    @property
    def moving(self) -> bool:
        """Tells whether something still morphs, fades or is coarse."""
        return self._moves or self._fade.moving or self._part < 1.0

    def picture(self) -> bytes:
        """Returns what was drawn last, the lowest row first, three bytes a pixel."""
        return self._shown.picture.read() if self._shown is not None else b""

    def show(self, desk: Desk) -> None:
        """Lays the picture on the window."""
        state = desk.land
        left, top, width, height = state.room
        self._ctx.screen.use()
        self._ctx.clear(0.115, 0.12, 0.125)
        if self._shown is None or state.eye is None:
            return
        self._ctx.viewport = (left, desk.view.height - top - height, width, height)
        self._fade.draw(self._shown.picture)
        self._ctx.viewport = (0, 0, desk.view.width, desk.view.height)

    def forget(self) -> None:
        """Lets go of all tiles."""
        for tile in self._tiles.values():
            tile.release()
        self._tiles.clear()

    def _begin(self) -> moderngl.Program:
        ctx = self._ctx
        if self._program is None:
            self._program = ctx.program(*self._sources)
            self._sky = ctx.program(*self._sky_sources)
            self._shared = _Shared(ctx, self._slow)
            corners, faces = (ctx.buffer(part.tobytes()) for part in _sky_mesh())
            self._whole = ctx.vertex_array(self._sky, [(corners, "2f", "at")], faces)
        return self._program

    def _target(self, size: tuple[int, int], part: float) -> _Target:
        """Returns what is drawn to, a part of a picture of that size."""
        held = self._targets.get(part)
        size = round(size[0] * part), round(size[1] * part)
        if held is None or held.picture.size != size:
            if held is not None:
                held.release()
            held = self._targets[part] = _Target(self._ctx, size)
        return held

    def _picture(self, state: LandState, now: float, part: float) -> None:
        program, sight = self._begin(), state.sight()
        self._shown, self._part = self._target(state.size, part), part
        frame = self._shown.frame
        frame.use()
        self._ctx.enable_only(moderngl.DEPTH_TEST)
        frame.clear(depth=1.0)
        right, up, forward = (tuple(axis.tolist()) for axis in sight.eye.axes())
        wide = math.tan(math.radians(sight.eye.fov) / 2)
        lens = 1.0 / wide, state.size[0] / state.size[1] / wide
        for shown in (program, self._sky):
            shown["right"], shown["up"], shown["forward"] = right, up, forward
            shown["sun"] = towards_sun()
        held = [(key, state.kept[key]) for key in state.drawn if key in state.kept]
        at = anchor(sight, max((key.level for key, _ in held), default=0))
        self._common(program, sight, at, lens)
        self._moves = any(now - kept.came < _BORN for _, kept in held)
        hangs = state.lacking > 0 or self._moves or now - state.taken < _SETTLES
        corners = 3 * len(triangles()) if hangs else _BARE
        state.triangles = corners // 3 * len(held)
        for n, (key, kept) in enumerate(held):
            if n % _TILES_A_FLUSH == _TILES_A_FLUSH - 1:
                self._flush()
            placed, card = at.place(key, kept.tile.base, sight), self._on_card(program, kept.tile)
            program["corner"], program["sides"] = placed.corner, (placed.step, placed.unit)
            program["morphs"] = placed.begins, placed.ends, max(0.0, 1.0 - (now - kept.came) / _BORN)
            card.picture.use(0)
            card.mesh.render(moderngl.TRIANGLES, corners)
        self._sky["lens"] = lens
        self._ctx.depth_func = "<="
        self._whole.render(moderngl.TRIANGLES)
        self._ctx.depth_func = "<"
        self._ctx.enable_only(moderngl.NOTHING)
        self._let_go(state)

    def _common(self, program: moderngl.Program, sight: LandSight, at: Anchor, lens: tuple[float, float]) -> None:
        program["eye"], program["clear"] = at.eye, at.clear
        program["lens"] = *lens, _NEAR * at.clear
        program["texels"] = (1 << FINER) / _WHOLE, TEXEL_RIM / _WHOLE
        program["haze"] = math.ldexp(_HAZE * sight.frame.width, at.level)
        program["horizon"] = math.ldexp(sight.horizon, at.level)
        program["brightest"] = BRIGHTEST

    def _on_card(self, program: moderngl.Program, tile: LandTile) -> _OnCard:
        held = self._tiles.get(tile.key)
        if held is None or held.tile is not tile:
            if held is not None:
                held.release()
            held = self._tiles[tile.key] = _OnCard(self._ctx, program, tile, self._shared)
        self._tiles.move_to_end(tile.key)
        return held

    def _let_go(self, state: LandState) -> None:
        """Gives back what of the card tiles have that are kept no more, or were not drawn for long."""
        if len(self._tiles) > len(state.kept):
            for key in [key for key in self._tiles if key not in state.kept]:
                self._tiles.pop(key).release()
        while len(self._tiles) > len(state.drawn) + SPARE_CARDS:
            self._tiles.popitem(last=False)[1].release()


def _sky_mesh() -> tuple[np.ndarray, np.ndarray]:
    """Returns corners float32 (n, 2) and triangles int32 (m, 3) of the whole picture: the sky changes little from one
    corner to the next, and a software renderer pays for what each pixel works out."""
    columns, rows = (np.linspace(-1.0, 1.0, n + 1, dtype=np.float32) for n in _SKY)
    across, up = np.meshgrid(columns, rows)
    first = (np.arange(_SKY[1])[:, None] * (_SKY[0] + 1) + np.arange(_SKY[0])).ravel()
    above = first + _SKY[0] + 1
    faces = [np.stack([first, first + 1, above + 1], axis=1), np.stack([first, above + 1, above], axis=1)]
    return np.stack([across.ravel(), up.ravel()], axis=1), np.concatenate(faces).astype(np.int32)
