"""The last pass: what was drawn is sent to the screen in the colours of its profile."""

from __future__ import annotations

import moderngl
import numpy as np

from app.canvas.shader_files import shader_source
from engine.files.profiles.screen_table import NODES, ScreenTable


class ScreenColours:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._sources = shader_source("light.vert"), shader_source("screen.frag")
        self._program: moderngl.Program | None = None
        self._picture: moderngl.Texture | None = None
        self._memory: moderngl.Buffer | None = None  # by which it is copied, where it cannot be copied at once
        self._colours: moderngl.Texture3D | None = None
        self._held: ScreenTable | None = None

    def draw(self, table: ScreenTable, target: moderngl.Framebuffer, size: tuple[int, int]) -> None:
        """Gives all that is drawn there, in so many pixels, the colours of a table."""
        if self._program is None:
            self._begin()
        assert self._program is not None
        if table is not self._held:
            self._take(table)
        assert self._colours is not None
        picture = self._copied(target, size)
        target.use()
        self._ctx.scissor, self._ctx.viewport = None, (0, 0, *size)
        self._ctx.disable(moderngl.BLEND)
        picture.use(0)
        self._places.use(1)
        self._colours.use(2)
        self._triangle.render(moderngl.TRIANGLES, vertices=3)

    def _copied(self, target: moderngl.Framebuffer, size: tuple[int, int]) -> moderngl.Texture:
        """Returns what is drawn there.  That of a window goes on telling the size that the window had at first, and no
        more is copied of it; more is read, into memory of the card."""
        if self._picture is None or self._picture.size != size:
            for held in (self._picture, self._memory):
                if held is not None:
                    held.release()
            self._picture, self._memory = self._ctx.texture(size, 3, alignment=1), None
            self._picture.filter = moderngl.NEAREST, moderngl.NEAREST
        if target.size == size:
            self._ctx.copy_framebuffer(self._picture, target)
            return self._picture
        self._memory = self._memory or self._ctx.buffer(reserve=3 * size[0] * size[1])
        target.read_into(self._memory, (0, 0, *size), 3, alignment=1)
        self._picture.write(self._memory, alignment=1)
        return self._picture

    def _begin(self) -> None:
        self._program = program = self._ctx.program(*self._sources)
        program["picture"], program["places"], program["colours"] = 0, 1, 2
        self._triangle = self._ctx.vertex_array(program, [])
        at = np.interp(np.arange(256), NODES, (np.arange(len(NODES)) + 0.5) / len(NODES))
        self._places = self._ctx.texture((256, 1), 1, at.astype(np.float32).tobytes(), dtype="f4")
        self._places.filter = moderngl.NEAREST, moderngl.NEAREST

    def _take(self, table: ScreenTable) -> None:
        """Loads a table."""
        if self._colours is not None:
            self._colours.release()
        self._held, side = table, len(NODES)
        self._colours = self._ctx.texture3d((side,) * 3, 3, table.colours.tobytes(), alignment=1)
        self._colours.repeat_x = self._colours.repeat_y = self._colours.repeat_z = False
        self._colours.filter = moderngl.LINEAR, moderngl.LINEAR
