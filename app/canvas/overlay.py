"""The panels over the canvas: a picture of them is kept on the card, in which only what changed is drawn anew.

imgui tells all that it shows in lists of triangles, one a window, anew for each frame.  Lists that overlap are drawn
together; those whose bytes are the ones of the frame before are in the picture already.  A software renderer pays
more for the rectangles and letters of the panels than for the canvas, and most frames change none of them.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Sequence, Set
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from imgui_bundle import imgui
from imgui_bundle.imgui import backends

from app.canvas.shader_files import shader_source

Box = tuple[int, int, int, int]  # left, top, right, bottom, screen pixels
Command = tuple[tuple[float, float, float, float], tuple[int, int, int], int]  # clip, triangles, texture
Told = tuple[tuple[Command, ...], bytes, bytes, tuple[int, int]]  # commands, vertices, indices, the screen's size
NOTHING = 0, 0, 0, 0
_UNDER = "##Background"  # imgui's name of the list below all windows, which goes with the canvas


@dataclass(slots=True, eq=False)
class Sheet:
    """What imgui shows of one window.  `told`: its commands and triangles; `box`: the pixels that they touch."""

    told: Told
    box: Box


@dataclass(frozen=True, slots=True)
class Group:
    """Sheets that overlap, from the lowest to the topmost; no other group reaches into its box."""

    box: Box
    sheets: tuple[Sheet, ...]
    lists: tuple[int, ...]  # their places among all lists


class Overlay:
    """All calls from the thread that owns the context.  `screen`: what is drawn to, the window if that is None."""

    def __init__(self, ctx: moderngl.Context, screen: moderngl.Framebuffer | None = None) -> None:
        self._ctx, self._screen = ctx, ctx.screen if screen is None else screen
        self._program: Any = ctx.program(shader_source("overlay.vert"), shader_source("overlay.frag"))
        self._room_for(32)
        self._picture: Any = None
        self._frame: Any = None
        self._lists: list[imgui.ImDrawList] = []
        self._sheets: dict[str, Sheet] = {}  # by the window's name
        self._drawn: set[tuple[Box, tuple[Sheet, ...]]] = set()
        self._laid: list[Box] = []

    def _room_for(self, boxes: int) -> None:
        self._most = boxes
        self._boxes = self._ctx.buffer(reserve=16 * boxes)
        self._quads = self._ctx.vertex_array(self._program, [(self._boxes, "4f/i", "box")])

    def look(self, data: imgui.ImDrawData, size: tuple[int, int], fresh: Set[int] = frozenset()) -> bool:
        """Takes in what imgui shows on a screen of `size` (width, height); True if that is something else than before.

        `fresh`: the textures that show something else now.
        """
        self._lists = list(data.cmd_lists)
        _render(data, [])  # brings imgui's own textures up to date, which the lists name
        known, self._sheets = self._sheets, {}
        for one in self._lists:
            self._sheets[one._owner_name] = _sheet(data, one, size, known.get(one._owner_name), fresh)
        if self._picture is None or self._picture.size != size:
            self._begin(size)
            return True
        return list(self._sheets.items()) != list(known.items())

    def redraw(self, data: imgui.ImDrawData) -> None:
        """Draws into the picture what changed in it; before anything is drawn to the screen, for a software renderer
        waits for all that was begun when it turns from one picture to the other.
        """
        lists = [one for one in self._lists if one._owner_name != _UNDER]
        groups = grouped_sheets([self._sheets[one._owner_name] for one in lists])
        for group in groups:
            if (group.box, group.sheets) not in self._drawn:
                self._render_box(data, group.box, [lists[n] for n in group.lists])
        self._drawn = {(group.box, group.sheets) for group in groups}
        self._laid = [group.box for group in groups]

    def draw(self, data: imgui.ImDrawData) -> None:
        """Lays over the screen what `look` took in and `redraw` drew."""
        _render(data, [one for one in self._lists if one._owner_name == _UNDER])
        self._lay(self._laid, self._picture.size)

    def _begin(self, size: tuple[int, int]) -> None:
        """Nothing is drawn yet, in a picture of that size."""
        self._drawn = set()
        for old in (self._frame, self._picture):
            if old is not None:
                old.release()
        self._picture = self._ctx.texture(size, 4)
        self._picture.filter = moderngl.NEAREST, moderngl.NEAREST
        self._frame = self._ctx.framebuffer([self._picture])

    def _render_box(self, data: imgui.ImDrawData, box: Box, lists: list[imgui.ImDrawList]) -> None:
        left, top, right, bottom = box
        self._frame.use()
        self._frame.clear(viewport=(left, self._frame.height - bottom, right - left, bottom - top))
        _render(data, lists)
        self._screen.use()

    def _lay(self, boxes: list[Box], size: tuple[int, int]) -> None:
        if not boxes:
            return
        if len(boxes) > self._most:
            self._room_for(2 * len(boxes))
        self._boxes.orphan()
        self._boxes.write(np.array(boxes, np.float32))
        self._program["size"] = size
        self._ctx.enable(moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._picture.use(0)
        self._quads.render(moderngl.TRIANGLE_STRIP, vertices=4, instances=len(boxes))


def _render(data: imgui.ImDrawData, lists: list[imgui.ImDrawList]) -> None:
    """Draws some of the lists, and no others, where drawing goes now."""
    held = data.cmd_lists
    held.clear()
    for one in lists:
        held.push_back(one)
    backends.opengl3_render_draw_data(data)


def _sheet(
    data: imgui.ImDrawData, one: imgui.ImDrawList, size: tuple[int, int], known: Sheet | None, fresh: Set[int]
) -> Sheet:
    """Returns what a list tells; `known` itself if that looks the same."""
    vertices, indices = one.vtx_buffer, one.idx_buffer
    told = (
        tuple(_command(command) for command in one.cmd_buffer if command.elem_count),
        _bytes(vertices.data_address(), vertices.size() * imgui.VERTEX_SIZE),
        _bytes(indices.data_address(), indices.size() * imgui.INDEX_SIZE),
        size,
    )
    same = known is not None and known.told == told and fresh.isdisjoint(texture for _, _, texture in told[0])
    return known if known is not None and same else Sheet(told, _touched(data, told))


def _command(command: imgui.ImDrawCmd) -> Command:
    clip = command.clip_rect
    triangles = command.idx_offset, command.elem_count, command.vtx_offset
    return (clip.x, clip.y, clip.z, clip.w), triangles, command.get_tex_id()


def _bytes(address: int, count: int) -> bytes:
    return ctypes.string_at(address, count) if count else b""


def _touched(data: imgui.ImDrawData, told: Told) -> Box:
    """Returns the smallest box around the pixels of the screen that a list may touch: 0, 0, 0, 0 if it touches none."""
    commands, vertices, indices, size = told
    at = np.frombuffer(vertices, np.float32).reshape(-1, imgui.VERTEX_SIZE // 4)[:, :2]
    corner = np.frombuffer(indices, np.uint32 if imgui.INDEX_SIZE == 4 else np.uint16)
    scale, origin = data.framebuffer_scale, data.display_pos
    ends = []
    for clip, (first, count, offset), _ in commands:
        points = at[corner[first : first + count] + offset]
        low, high = np.maximum(points.min(axis=0), clip[:2]), np.minimum(points.max(axis=0), clip[2:])
        if (low < high).all():
            ends.append((*low, *high))
    if not ends:
        return NOTHING
    low, high = np.array(ends)[:, :2].min(axis=0), np.array(ends)[:, 2:].max(axis=0)
    place, by = (origin.x, origin.y), (scale.x, scale.y)
    left, top = (max(0, math.floor((v - o) * s + 0.5)) for v, o, s in zip(low, place, by, strict=True))
    right, bottom = (min(n, math.ceil((v - o) * s - 0.5)) for v, o, s, n in zip(high, place, by, size, strict=True))
    return (left, top, right, bottom) if left < right and top < bottom else NOTHING


def grouped_sheets(sheets: Sequence[Sheet]) -> list[Group]:
    """Returns all sheets that touch anything, from the lowest to the topmost, in groups whose boxes do not overlap."""
    groups: list[Group] = []
    for n, sheet in enumerate(sheets):
        if sheet.box == NOTHING:
            continue
        box, members = sheet.box, [n]
        while hit := [group for group in groups if _overlap(group.box, box)]:
            groups = [group for group in groups if group not in hit]
            for group in hit:
                box, members = _hull(box, group.box), members + list(group.lists)
        places = tuple(sorted(members))
        groups.append(Group(box, tuple(sheets[k] for k in places), places))
    return groups


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _hull(a: Box, b: Box) -> Box:
    return min(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3])
