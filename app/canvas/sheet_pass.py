"""What is dragged, drawn on the card between what lies below it and above it."""

from __future__ import annotations

import math
from typing import NamedTuple

import moderngl

from app.canvas.screen import Insets, free_part
from app.canvas.shader_files import shader_source
from app.canvas.view import View
from engine.studio.moving.sheet_records import CarriedSheets

BELOW, MOVED, ABOVE = range(3)  # sheets
_FAR = 0.75  # screen pixels a pixel, below which a sheet is seen through coarser copies of it


class Quad(NamedTuple):
    """Where a sheet lies on the screen: its corner, its upper side and its left one."""

    sheet: int
    corner: tuple[float, float]
    across: tuple[float, float]
    down: tuple[float, float]


class SheetPlan(NamedTuple):
    """CarriedSheets, and where they are to be seen."""

    sheets: CarriedSheets
    quads: tuple[Quad, ...]


class SheetPass:
    """All calls from the thread that owns the context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._program = ctx.program(shader_source("sheet.vert"), shader_source("sheet.frag"))
        self._corners = ctx.vertex_array(self._program, [])
        self._held: CarriedSheets | None = None
        self._textures: list[moderngl.Texture | None] = []
        self._opaque: list[bool] = []

    def keep(self, sheets: CarriedSheets | None) -> None:
        """Lets go of all sheets but these."""
        if self._held is not None and self._held is not sheets:
            self._let_go()

    def draw(self, plan: SheetPlan, view: View, insets: Insets) -> None:
        """Draws them where panels leave room."""
        if self._held is not plan.sheets:
            self._take(plan.sheets)
        self._ctx.scissor = free_part(view, insets)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._program["size"] = view.width, view.height
        for quad in plan.quads:
            texture = self._textures[quad.sheet]
            if texture is None:
                continue
            texture.filter = _filter(quad, texture.width)
            mixes = not self._opaque[quad.sheet] or texture.filter[0] != moderngl.NEAREST  # rims of others are soft
            (self._ctx.enable if mixes else self._ctx.disable)(moderngl.BLEND)
            texture.use(0)
            self._program["corner"], self._program["sides"] = quad.corner, (*quad.across, *quad.down)
            self._corners.render(moderngl.TRIANGLE_STRIP, vertices=4)
        self._ctx.enable(moderngl.BLEND)
        self._ctx.scissor = None

    def hides(self, plan: SheetPlan, view: View) -> bool:
        """Tells whether what lies below covers the whole screen, pixel on pixel: no paper is to be seen."""
        quad, sheet = plan.quads[0], (plan.sheets.sheets or ())[BELOW]
        (x, y), (width, height) = quad.corner, (quad.across[0], quad.down[1])
        if quad.across != (sheet.rect.width, 0.0) or quad.down != (0.0, sheet.rect.height):
            return False
        if self._held is not plan.sheets:
            self._take(plan.sheets)
        return self._opaque[BELOW] and x <= 0 and y <= 0 and x + width >= view.width and y + height >= view.height

    def _take(self, sheets: CarriedSheets) -> None:
        self._let_go()
        self._held = sheets
        for number, sheet in enumerate(sheets.sheets or ()):
            texture = None
            if sheet.pixels is not None:
                texture = self._ctx.texture((sheet.rect.width, sheet.rect.height), 4, sheet.pixels)
                texture.repeat_x = texture.repeat_y = False
                if number == MOVED:
                    texture.build_mipmaps()
            self._opaque.append(sheet.pixels is not None and int(sheet.pixels[..., 3].min()) == 255)
            self._textures.append(texture)

    def _let_go(self) -> None:
        for texture in self._textures:
            if texture is not None:
                texture.release()
        self._held, self._textures, self._opaque = None, [], []


def _filter(quad: Quad, width: int) -> tuple[int, int]:
    """Returns how a sheet is looked up, where it is made smaller and larger."""
    long = math.hypot(*quad.across)
    if quad.across == (width, 0.0):  # pixel on pixel
        return moderngl.NEAREST, moderngl.NEAREST
    small = quad.sheet == MOVED and long < _FAR * width
    return (moderngl.LINEAR_MIPMAP_NEAREST if small else moderngl.LINEAR), moderngl.LINEAR
