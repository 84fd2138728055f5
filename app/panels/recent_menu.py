"""The menu of the paintings that were opened or saved last."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import theme
from app.actions.action import ready
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.fitting import home_text, shortened
from app.panels.starting.recent_pictures import PICTURE_EMS, ask_pictures, draw_file_picture

_WIDE = 22.0  # ems of a row


def draw(desk: Desk) -> None:
    """Draws it into the present menu."""
    paths = desk.opened.paths
    opened = said.begin_menu("Open recent", bool(paths) and ready(desk))
    w.named("Open recent")
    w.tooltip("Paintings that you opened or saved last")
    if not opened:
        return
    ask_pictures(desk, paths)
    for i, path in enumerate(paths):
        if draw_recent(desk, path, f"recent {i}", imgui.get_font_size() * _WIDE):
            desk.guard(partial(desk.open, path))
    imgui.end_menu()


def draw_recent(desk: Desk, path: Path, ident: str, wide: float) -> bool:
    """Draws a painting's picture, name and folder; tells whether it was pressed."""
    em = imgui.get_font_size()
    corner, tall = imgui.get_cursor_screen_pos(), PICTURE_EMS * em
    pressed = said.selectable(f"##{ident}", path == desk.known.path, 0, ImVec2(wide, tall))[0]
    w.named(path.name)
    w.tooltip(str(path))
    draw_file_picture(desk, path, corner, ImVec2(1.3 * tall, tall))
    painter, left = imgui.get_window_draw_list(), corner.x + 1.3 * tall + 0.8 * em
    room = corner.x + wide - left - 0.3 * em
    painter.add_text(ImVec2(left, corner.y + 0.35 * em), theme.packed(theme.look.text), shortened(path.name, room))
    where = shortened(home_text(path.parent), room)
    said.add_text(painter, ImVec2(left, corner.y + 1.75 * em), theme.packed(theme.look.quiet), where)
    return pressed
