"""An object made of a solid, as the card draws it: one texture of three dimensions, one light, one picture.

While it turns it has one sample a pixel and few triangles, at rest all of them and more samples, until the engine's
picture of it is there, which has all the detail of its solid and softer light.
"""

from __future__ import annotations

import moderngl

from app.canvas.gallery import Gallery
from app.canvas.shader_files import shader_source
from app.desk.solids.shown_solid import AtRest, Carved, turned_by
from app.desk.solids.solid_state import SMALLEST_ROOM, SolidState
from app.desk.solids.solid_work import BEHIND
from engine.numeric.address import Rect

_SAMPLES = 4


class SolidView:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context, gallery: Gallery) -> None:
        self._ctx, self._gallery = ctx, gallery
        self._sources = shader_source("solid.vert"), shader_source("solid.frag")
        self._program: moderngl.Program | None = None
        self._solid: moderngl.Texture3D | None = None
        self._objects: list[moderngl.VertexArray] = []  # all triangles, and those drawn while it turns
        self._held: list[moderngl.Buffer] = []
        self._frames: list[moderngl.Framebuffer] = []
        self._carved: Carved | None = None
        self._drawn: tuple[object, ...] = ()

    def show(self, state: SolidState) -> None:
        """Draws the object again, if it is seen and has changed."""
        width, height = state.room
        if state.carved is None or min(width, height) < SMALLEST_ROOM:
            return
        rest = state.rest if state.rest is not None and state.rest.of == state.seen else None
        told = (state.carved, state.room, state.turn, state.carved.scale(state.scale), state.turning, rest)
        if told == self._drawn:
            return
        self._drawn = told
        if rest is not None:
            self._hang(rest)
            return
        if state.carved is not self._carved:
            self._take(state.carved)
        self._draw(state)

    def _hang(self, rest: AtRest) -> None:
        """Shows what the engine has drawn, where the card's picture is."""
        self._frames_of(*rest.of.room)
        self._gallery.touch("solid", rest.of.room, Rect.at(0, 0, *rest.of.room), rest.pixels)

    def _take(self, carved: Carved) -> None:
        """Loads the solid and the object."""
        before, self._carved = self._carved, carved
        if self._program is None:
            self._program = self._ctx.program(*self._sources)
        if before is None or before.cube is not carved.cube:
            if self._solid is not None:
                self._solid.release()
            sides = carved.cube.shape[2], carved.cube.shape[1], carved.cube.shape[0]
            self._solid = self._ctx.texture3d(sides, 3, carved.cube.tobytes(), alignment=1)
            self._solid.repeat_x = self._solid.repeat_y = self._solid.repeat_z = True
            self._solid.filter = moderngl.LINEAR, moderngl.LINEAR
        if before is None or before.corners is not carved.corners:
            for drawn in self._objects:
                drawn.release()
            for old in self._held:
                old.release()
            self._held = [self._ctx.buffer(part.tobytes()) for part in (carved.corners, carved.faces, carved.fewer)]
            layout = [(self._held[0], "3f 3f", "point", "normal")]
            self._objects = [self._ctx.vertex_array(self._program, layout, faces) for faces in self._held[1:]]

    def _draw(self, state: SolidState) -> None:
        assert state.carved is not None
        assert self._program is not None
        assert self._solid is not None
        width, height = state.room
        picture, plain, smooth = self._frames_of(width, height)
        target = plain if state.turning else smooth
        target.use()
        self._ctx.enable_only(moderngl.DEPTH_TEST)
        target.clear(*BEHIND, 1.0)
        self._solid.use(0)
        program = self._program
        program["scale"], program["gloss"] = state.carved.scale(state.scale), state.carved.solid.gloss
        lens = 1.0 / state.carved.nearness * min(1.0, width / height)
        program["lens"] = lens * height / width, -lens  # the picture's first row is the uppermost
        program["turned"] = tuple(turned_by(*state.turn).T.reshape(-1).tolist())
        self._objects[state.turning].render(moderngl.TRIANGLES)
        self._ctx.copy_framebuffer(picture, target)
        self._ctx.enable_only(moderngl.NOTHING)
        self._ctx.screen.use()

    def _frames_of(self, width: int, height: int) -> list[moderngl.Framebuffer]:
        """The picture that imgui shows, and what is drawn to: of one sample a pixel, and of several."""
        size = width, height
        shown = self._gallery.drawn("solid", size)
        if not self._frames or self._frames[0].size != size:
            for old in self._frames:
                old.release()
            self._frames = [self._ctx.framebuffer([shown])]
            for samples in (0, min(_SAMPLES, self._ctx.max_samples)):
                colours = self._ctx.renderbuffer(size, 3, samples=samples)
                depths = self._ctx.depth_renderbuffer(size, samples=samples)
                self._frames.append(self._ctx.framebuffer([colours], depths))
        return self._frames
