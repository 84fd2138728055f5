"""The light on the canvas: what was drawn is seen once more, lit by its own relief.

A whole screen, and the heights under it, are drawn aside first, so that a pixel finds its neighbours whichever tiles
they come from; with a rim, so that it has them at the screen's border, too.
"""

from __future__ import annotations

import moderngl

from app.canvas.shader_files import shader_source
from engine.light.light import DIFFUSE, RIM, Light


class Lamp:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        # The files are read at the start, before the window waits for none; the rest is made when it is asked for.
        self._vertex = shader_source("light.vert")
        self._fragment = shader_source("light.frag").replace("DIFFUSE", repr(DIFFUSE)).replace("RIM", str(RIM))
        self._program: moderngl.Program | None = None
        self._aside: list[moderngl.Framebuffer] = []  # the picture and its heights
        self._drawn: list[moderngl.Texture] = []  # what is in these

    def begin(self, size: tuple[int, int]) -> moderngl.Framebuffer:
        """From now on drawing goes aside, to a clear screen of a size and a rim around it; returns where it went until
        now."""
        target = self._ctx.fbo
        if self._program is None:
            self._program = self._ctx.program(self._vertex, self._fragment)
            self._program["picture"], self._program["relief"] = 0, 1
            self._triangle = self._ctx.vertex_array(self._program, [])
        around = size[0] + 2 * RIM, size[1] + 2 * RIM
        if not self._aside or self._aside[0].size != around:
            for framebuffer, texture in zip(self._aside, self._drawn, strict=True):
                framebuffer.release()
                texture.release()
            self._drawn = [self._ctx.texture(around, 4), self._ctx.texture(around, 1, dtype="nu2")]
            for texture in self._drawn:
                texture.filter = moderngl.NEAREST, moderngl.NEAREST
            self._aside = [self._ctx.framebuffer([texture]) for texture in self._drawn]
        self._aside[0].use()
        self._aside[0].clear()
        return target

    def raise_from(self, ground: float) -> None:
        """From now on drawing goes to the heights, which are those of the ground, 0 to 1, where nothing is drawn."""
        self._aside[1].use()
        self._aside[1].clear(ground)

    def show(self, light: Light, target: moderngl.Framebuffer, part: tuple[int, int, int, int]) -> None:
        """Lays what was drawn aside over a part of the target, lit."""
        target.use()
        program = self._program
        assert program is not None
        program["slope"], program["sun"], program["gloss"] = light.slope, light.sun, light.gloss
        self._ctx.scissor = part
        self._ctx.enable(moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        for unit, texture in enumerate(self._drawn):
            texture.use(unit)
        self._triangle.render(moderngl.TRIANGLES, vertices=3)
