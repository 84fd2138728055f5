"""The texture that is being written as it is seen: at one level, at five, and as a stroke."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.studio.workshop.workshop_records import LEVEL_STEP, LEVELS_SHOWN

_LEAST, _MOST = 64, 640  # pixels of the picture's sides
_BELOW = 52.0  # points of what stands below it
_STROKE = 0.30  # of the width


class TextureView:
    """A drag looks elsewhere, the wheel nearer."""

    def __init__(self) -> None:
        self._dragged = (0.0, 0.0)

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.y
        below = min(_BELOW * desk.scale, 0.25 * room.y)
        self._texture(desk, (room.x, room.y - below - gap))
        wide = _STROKE * room.x
        w.picture(desk.pictures.get("workshop stroke"), (wide, below), "A stroke with this texture as its ink")
        imgui.same_line(0, gap)
        _levels(desk, (room.x - wide - gap, below))

    def _texture(self, desk: Desk, size: tuple[float, float]) -> None:
        state = desk.workshop
        state.size = (_side(size[0]), _side(size[1]))
        corner = imgui.get_cursor_screen_pos()
        imgui.set_next_item_allow_overlap()
        imgui.invisible_button("##looked at", ImVec2(*size))
        w.named("looked at")
        hovered, active = imgui.is_item_hovered(), imgui.is_item_active()
        w.tooltip("Drag to look elsewhere; the wheel looks nearer, without end.  The lines tell their values here")
        painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + size[0], corner.y + size[1])
        shown, rounding = desk.pictures.get("workshop texture"), imgui.get_style().frame_rounding
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
        if shown is not None:
            painter.add_image_rounded(shown, corner, end, ImVec2(0, 0), ImVec2(1, 1), -1 & 0xFFFFFFFF, rounding)
        self._moves(desk, corner, hovered, active)
        line = state.scene.lines[state.line] if 0 <= state.line < len(state.scene.lines) - 1 else None
        if state.scene.busy:
            _label(ImVec2(corner.x + 8, corner.y + 6), f"{icons.WAIT} getting ready…")
        elif line is not None:
            _label(ImVec2(corner.x + 8, corner.y + 6), f"{line.name}, alone")
        across = size[0] / state.period / 2.0**state.level
        text = f"level {state.level}, {across:.3g} across".replace("-", "−")
        _label(ImVec2(corner.x + 8, end.y - imgui.get_text_line_height() - 6), text)
        side = imgui.get_frame_height()
        _ground(ImVec2(end.x - side - 4, corner.y + 4), side)
        if w.icon_button("as relief", icons.MOUNTAIN, "As heights in the light: bright is high", on=state.lit):
            state.lit = not state.lit
        if state.level or state.origin != (0, 0) or line is not None:
            _ground(ImVec2(end.x - side - 4, corner.y + 8 + side), side)
            if w.icon_button("back to 1:1", icons.HOME, "Back to the whole texture at level 0, where it begins"):
                state.look(0, (0, 0))
                state.line = -1
        imgui.set_cursor_screen_pos(ImVec2(corner.x, end.y + imgui.get_style().item_spacing.y))

    def _moves(self, desk: Desk, corner: ImVec2, hovered: bool, active: bool) -> None:
        state, mouse, io = desk.workshop, imgui.get_mouse_pos(), imgui.get_io()
        at = mouse.x - corner.x, mouse.y - corner.y
        state.over = (state.origin[0] + int(at[0]), state.origin[1] + int(at[1])) if hovered else None
        if not active:
            self._dragged = (0.0, 0.0)
        else:
            x, y = self._dragged[0] - io.mouse_delta.x, self._dragged[1] - io.mouse_delta.y
            before = state.origin
            state.look(state.level, (before[0] + int(x), before[1] + int(y)))
            self._dragged = x - (state.origin[0] - before[0]), y - (state.origin[1] - before[1])
        if hovered and io.mouse_wheel:
            state.zoom(round(io.mouse_wheel) or (1 if io.mouse_wheel > 0 else -1), at)


def _levels(desk: Desk, size: tuple[float, float]) -> None:
    """Draws five levels side by side; a click looks at one."""
    state, gap = desk.workshop, 2 * desk.scale
    wide = (size[0] - (LEVELS_SHOWN - 1) * gap) / LEVELS_SHOWN
    shown, painter = desk.pictures.get("workshop levels"), imgui.get_window_draw_list()
    part = 0.5 * min(1.0, size[1] / wide)
    for n in range(LEVELS_SHOWN):
        if n:
            imgui.same_line(0, gap)
        finer = (n - LEVELS_SHOWN // 2) * LEVEL_STEP
        corner = imgui.get_cursor_screen_pos()
        if imgui.invisible_button(f"##level {n}", ImVec2(wide, size[1])):
            state.zoom(finer, (state.size[0] / 2, state.size[1] / 2))
        w.named(f"level {n + 1}")
        nearer = f"{2**finer} times nearer" if finer > 0 else f"{2**-finer} times farther"
        w.tooltip(f"The texture {nearer if finer else 'as it is looked at'}; click to look at it so")
        end = ImVec2(corner.x + wide, corner.y + size[1])
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), 4)
        if shown is not None:
            across = min(1.0, wide / size[1]) / 2
            u, v = (
                ImVec2((n + 0.5 - across) / LEVELS_SHOWN, 0.5 - part),
                ImVec2((n + 0.5 + across) / LEVELS_SHOWN, 0.5 + part),
            )
            painter.add_image_rounded(shown, corner, end, u, v, -1 & 0xFFFFFFFF, 4)
        if not finer or imgui.is_item_hovered():
            colour = theme.look.text if finer else theme.look.accent
            painter.add_rect(corner, end, theme.packed(colour, 0.9), 4, thickness=1.5)


def _side(length: float) -> int:
    return max(_LEAST, min(_MOST, int(length)))


def _ground(at: ImVec2, side: float) -> None:
    """Draws a dark ground for a button over the picture, which comes next."""
    end = ImVec2(at.x + side, at.y + side)
    imgui.get_window_draw_list().add_rect_filled(at, end, theme.packed(theme.look.field, 0.8), 4)
    imgui.set_cursor_screen_pos(at)


def _label(at: ImVec2, text: str) -> None:
    """Draws a text on a dark ground, which is read over anything."""
    painter, size = imgui.get_window_draw_list(), said.calc_text_size(text)
    painter.add_rect_filled(at - ImVec2(4, 2), at + size + ImVec2(4, 2), theme.packed((0.0, 0.0, 0.0), 0.6), 3)
    said.add_text(painter, at, theme.packed((0.92, 0.92, 0.92)), text)
