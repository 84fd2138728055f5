"""The picture at rest comes over the one that moves, each sharper one over the one before."""

from __future__ import annotations

import moderngl
import numpy as np

from app.canvas.shader_files import shader_source
from app.desk.land.land_state import LandState
from engine.studio.land.land_records import StillCome

SECONDS = 0.35
_AS_IT_IS = 1.0, 1.0, 0.0, 0.0  # how the picture while the eye moves is looked up


class StillFade:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._sources = tuple(shader_source(name) for name in ("still.vert", "still.frag", "moving.frag"))
        self._program: moderngl.Program | None = None
        self._still: moderngl.Texture | None = None
        self._before: moderngl.Texture | None = None  # over which the last one comes
        self._lower = _AS_IT_IS
        self._shown: StillCome | None = None
        self._since = 0.0
        self._part = 0.0
        self._reach = (1.0, 1.0)

    @property
    def moving(self) -> bool:
        """Tells whether it still comes."""
        return self._shown is not None and self._part < 1.0

    def follow(self, state: LandState, now: float) -> bool:
        """Takes over which picture is there; True if it is another one, or more of it is seen."""
        still, before = state.still, self._part
        if still is not self._shown:
            over = still is not None and still.last and self._part == 1.0 and self._still is not None
            if still is None or self._shown is None or over:
                self._since = now
            self._keep() if over else self._let_go()
            self._shown = still
            if still is not None:
                self._hang(still, state.size)
            before = -1.0
        self._part = 0.0 if self._shown is None else min(1.0, (now - self._since) / SECONDS)
        if self._part == 1.0:
            self._let_go()
        return self._part != before

    def _keep(self) -> None:
        """Has the next picture come over the one that is seen."""
        self._let_go()
        self._before, self._still = self._still, None
        self._lower = self._reach[0], -self._reach[1], 0.0, self._reach[1]

    def _let_go(self) -> None:
        if self._before is not None:
            self._before.release()
        self._before, self._lower = None, _AS_IT_IS

    def _hang(self, still: StillCome, size: tuple[int, int]) -> None:
        high, wide = still.pixels.shape[:2]
        if self._still is not None and self._still.size != (wide, high):
            self._still.release()
            self._still = None
        if self._still is None:
            self._still = self._ctx.texture((wide, high), 3, alignment=1)
            self._still.repeat_x = self._still.repeat_y = False
        self._still.write(np.ascontiguousarray(still.pixels), alignment=1)
        self._reach = size[0] / (still.by * wide), size[1] / (still.by * high)

    def draw(self, moving: moderngl.Texture) -> None:
        """Draws what is seen of both into the present viewport."""
        if self._program is None:
            self._begin()
        assert self._program is not None
        (self._before or moving).use(0)
        if self._still is None or self._shown is None or (self._part == 0.0 and self._before is None):
            self._alone.render(moderngl.TRIANGLE_STRIP)
            return
        self._still.use(1)
        self._program["part"], self._program["reach"] = self._part, self._reach
        self._program["lower"] = self._lower
        self._both.render(moderngl.TRIANGLE_STRIP)

    def _begin(self) -> None:
        corners = self._ctx.buffer(np.array([-1, -1, 1, -1, -1, 1, 1, 1], np.float32).tobytes())
        whole, both, alone = self._sources
        self._program, one = self._ctx.program(whole, both), self._ctx.program(whole, alone)
        self._both, self._alone = (
            self._ctx.vertex_array(program, [(corners, "2f", "at")]) for program in (self._program, one)
        )
        self._program["under"], self._program["still"], one["moving"] = 0, 1, 0
