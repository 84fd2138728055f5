"""Land as the card draws it: tiles that morph from level to level, in the light that the engine has laid on them."""

from __future__ import annotations

import math
import time

import moderngl
import numpy as np

from app.canvas.shader_files import shader_source
from app.desk.desk import Desk
from app.desk.land.land_state import LandState
from app.land.still_fade import StillFade
from engine.terrain.seen.choosing import Anchor, LandSight, anchor
from engine.terrain.seen.land_tiles import (
    BRIGHTEST,
    FINER,
    TEXEL_RIM,
    TEXELS,
    LandTile,
    Placed,
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
        self.picture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR

    def release(self) -> None:
        self.mesh.release()
        self._heights.release()
        self.picture.release()


class _Shared:
    """What all tiles have in common."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.at = ctx.buffer(grid().tobytes())
        self.faces = ctx.buffer(triangles().tobytes())


class LandScreen:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._sources = shader_source("terrain.vert"), shader_source("terrain.frag")
        self._sky_sources = shader_source("sky.vert"), shader_source("sky.frag")
        self._program: moderngl.Program | None = None
        self._shown: moderngl.Texture | None = None
        self._tiles: dict[TileKey, _OnCard] = {}
        self._fade = StillFade(ctx)
        self._frame: moderngl.Framebuffer | None = None
        self._moves = False

    def draw(self, desk: Desk, now: float) -> bool:
        """Draws the land anew if it has changed; True if the window is to be drawn again."""
        state = desk.land
        if state.eye is None or min(state.size) < 8:
            return False
        fresh = self._fade.follow(state, now)
        if state.changed or self._moves:
            began = time.perf_counter()
            self._picture(state, now)
            self._ctx.finish()
            state.adapt(time.perf_counter() - began)
            state.changed, fresh = False, True
        return fresh

    @property
    def moving(self) -> bool:
        """Tells whether something still morphs or fades."""
        return self._moves or self._fade.moving

    def show(self, desk: Desk) -> None:
        """Lays the picture on the window."""
        state = desk.land
        left, top, width, height = state.room
        self._ctx.screen.use()
        self._ctx.clear(0.115, 0.12, 0.125)
        if self._shown is None or state.eye is None:
            return
        self._ctx.viewport = (left, desk.view.height - top - height, width, height)
        self._fade.draw(self._shown)
        self._ctx.viewport = (0, 0, desk.view.width, desk.view.height)

    def forget(self) -> None:
        """Lets go of all tiles."""
        for tile in self._tiles.values():
            tile.release()
        self._tiles.clear()

    def _begin(self, size: tuple[int, int]) -> moderngl.Program:
        ctx = self._ctx
        if self._program is None:
            self._program = ctx.program(*self._sources)
            self._sky = ctx.program(*self._sky_sources)
            self._shared = _Shared(ctx)
            corners = ctx.buffer(np.array([-1, -1, 1, -1, -1, 1, 1, 1], np.float32).tobytes())
            self._whole = ctx.vertex_array(self._sky, [(corners, "2f", "at")])
        if self._frame is None or self._frame.size != size:
            if self._frame is not None and self._shown is not None:
                self._shown.release()
                self._frame.release()
            self._shown = ctx.texture(size, 3, alignment=1)
            self._frame = ctx.framebuffer([self._shown], ctx.depth_renderbuffer(size))
        return self._program

    def _picture(self, state: LandState, now: float) -> None:
        program, sight = self._begin(state.size), state.sight()
        assert self._frame is not None
        self._frame.use()
        self._ctx.enable_only(moderngl.DEPTH_TEST)
        self._frame.clear(depth=1.0)
        right, up, forward = (tuple(axis.tolist()) for axis in sight.eye.axes())
        wide = math.tan(math.radians(sight.eye.fov) / 2)
        lens = 1.0 / wide, state.size[0] / state.size[1] / wide
        for shown in (program, self._sky):
            shown["right"], shown["up"], shown["forward"] = right, up, forward
            shown["sun"] = towards_sun()
        held = [(key, state.kept[key]) for key in state.drawn if key in state.kept]
        at = anchor(sight, max((key.level for key, _ in held), default=0))
        self._common(program, sight, at, lens)
        self._moves, state.triangles = False, len(triangles()) * len(held)
        for key, kept in held:
            born = max(0.0, 1.0 - (now - kept.came) / _BORN)
            self._moves = self._moves or born > 0.0
            self._tile(program, self._on_card(program, kept.tile), at.place(key, kept.tile.base, sight), born)
        self._sky["lens"] = lens
        self._ctx.depth_func = "<="
        self._whole.render(moderngl.TRIANGLE_STRIP)
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

    @staticmethod
    def _tile(program: moderngl.Program, tile: _OnCard, placed: Placed, born: float) -> None:
        program["corner"], program["sides"] = placed.corner, (placed.step, placed.unit)
        program["morphs"] = placed.begins, placed.ends, born
        tile.picture.use(0)
        tile.mesh.render(moderngl.TRIANGLES)

    def _on_card(self, program: moderngl.Program, tile: LandTile) -> _OnCard:
        held = self._tiles.get(tile.key)
        if held is None or held.tile is not tile:
            if held is not None:
                held.release()
            held = self._tiles[tile.key] = _OnCard(self._ctx, program, tile, self._shared)
        return held

    def _let_go(self, state: LandState) -> None:
        """Gives back what of the card tiles have that are kept no more."""
        if len(self._tiles) > len(state.kept):
            for key in [key for key in self._tiles if key not in state.kept]:
                self._tiles.pop(key).release()
