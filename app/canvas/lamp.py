"""The light on the canvas: what was drawn is seen once more, lit by its own relief.

A whole screen is drawn aside first, so that a pixel finds its neighbours whichever tiles they come from.
"""

from __future__ import annotations

import moderngl

from app.canvas.shader_files import shader_source
from engine.light.light import BY_ALPHA, DIFFUSE, Light

_LUMINANCE, _ALPHA = (0.2126, 0.7152, 0.0722, 0.0), (0.0, 0.0, 0.0, 1.0)


class Lamp:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        # The files are read at the start, before the window waits for none; the rest is made when it is asked for.
        self._vertex = shader_source("light.vert")
        self._fragment = shader_source("light.frag").replace("DIFFUSE", repr(DIFFUSE))
        self._program: moderngl.Program | None = None
        self._aside: moderngl.Framebuffer | None = None
        self._picture: moderngl.Texture

    def begin(self, size: tuple[int, int]) -> moderngl.Framebuffer:
        """From now on drawing goes aside, to a clear screen of a size; returns where it went until now."""
        target = self._ctx.fbo
        if self._program is None:
            self._program = self._ctx.program(self._vertex, self._fragment)
            self._triangle = self._ctx.vertex_array(self._program, [])
        aside = self._aside
        if aside is None or aside.size != size:
            if aside is not None:
                aside.release()
                self._picture.release()
            self._picture = self._ctx.texture(size, 4)
            self._picture.filter = moderngl.NEAREST, moderngl.NEAREST
            aside = self._aside = self._ctx.framebuffer([self._picture])
        aside.use()
        aside.clear()
        return target

    def show(self, light: Light, target: moderngl.Framebuffer, part: tuple[int, int, int, int]) -> None:
        """Lays what was drawn aside over a part of the target, lit."""
        target.use()
        program = self._program
        assert program is not None
        program["weights"] = _ALPHA if light.height == BY_ALPHA else _LUMINANCE
        program["slope"], program["sun"], program["gloss"] = light.slope, light.sun, light.gloss
        self._ctx.scissor = part
        self._ctx.enable(moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._picture.use(0)
        self._triangle.render(moderngl.TRIANGLES, vertices=3)
