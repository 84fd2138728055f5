"""Small pictures of the paintings that were opened or saved last, for the File menu and the start page."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import previews
from app.desk.desk import Desk
from app.desk.previews import FileRow
from app.language import said

PICTURE_EMS = 3.2  # ems: width and height of a picture


def ask_pictures(desk: Desk, paths: Iterable[Path]) -> None:
    """Has the pictures of files made that are not there yet; in place of others that are asked for."""
    desk.previews(Path(), [_row(desk, path) for path in paths], round(2 * PICTURE_EMS * imgui.get_font_size()))


def draw_file_picture(desk: Desk, path: Path, corner: ImVec2, size: ImVec2) -> None:
    """Draws the picture of a file, as much of its middle as fills a rectangle, or a sign while there is none."""
    shown = desk.pictures.get(previews.ident(Path(), _row(desk, path)))
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + size.x, corner.y + size.y)
    rounding = imgui.get_style().frame_rounding
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
    if shown is not None:
        wide, high = (min(1.0, a / b) / 2 for a, b in ((size.x, size.y), (size.y, size.x)))
        low, most = ImVec2(0.5 - wide, 0.5 - high), ImVec2(0.5 + wide, 0.5 + high)
        painter.add_image_rounded(shown, corner, end, low, most, theme.packed((1.0, 1.0, 1.0)), rounding)
        return
    sign = said.calc_text_size(icons.IMAGE)
    at = ImVec2((corner.x + end.x - sign.x) / 2, (corner.y + end.y - sign.y) / 2)
    said.add_text(painter, at, theme.packed(theme.look.quiet), icons.IMAGE)


def _row(desk: Desk, path: Path) -> FileRow:
    """Returns a file as the list of pictures asks for it; another one once it was saved."""
    return FileRow(str(path.absolute()), False, changed=desk.opened.saves.get(path, 0))
