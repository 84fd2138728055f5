"""The list of a folder in a dialog: small pictures, names, sizes, dates."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import previews
from app.desk.desk import Desk
from app.desk.folders import size_text
from app.desk.previews import FileRow
from app.language import said
from app.panels.controls import widgets as w

_PICTURE = 34.0  # the side of a small picture, points
_SIZE, _DATE = 6.0, 8.8  # widths of the columns, ems
_FLAGS = imgui.SelectableFlags_.allow_double_click | imgui.SelectableFlags_.no_auto_close_popups


def draw(desk: Desk, folder: Path, rows: Sequence[FileRow], chosen: str) -> FileRow | None:
    """Draws those that are in sight into the present window, and has their pictures made; gives the one clicked on."""
    clicked, seen = None, []
    side = _PICTURE * desk.scale
    height = side + 4 * desk.scale
    clipper = imgui.ListClipper()
    clipper.begin(len(rows), height + imgui.get_style().item_spacing.y)
    while clipper.step():
        for row in rows[clipper.display_start : clipper.display_end]:
            seen.append(row)
            if said.selectable(f"##{row.name}", row.name == chosen, _FLAGS, ImVec2(0, height))[0]:
                clicked = row
            w.named(row.name)
            w.tooltip("Open this folder" if row.folder else row.name, beside=True)
            _contents(desk, folder, row, side)
    desk.previews(folder, seen, round(side))
    return clicked


def _contents(desk: Desk, folder: Path, row: FileRow, side: float) -> None:
    """What the item just drawn shows."""
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    em, gap, painter = imgui.get_font_size(), imgui.get_style().item_spacing.x, imgui.get_window_draw_list()
    top, quiet = (low.y + high.y - em) / 2, theme.packed(theme.look.quiet)
    _picture(desk, folder, row, ImVec2(low.x + gap, (low.y + high.y - side) / 2))
    date, size = high.x - _DATE * em, high.x - _DATE * em - gap
    painter.push_clip_rect(low, ImVec2(size - _SIZE * em if not row.folder else high.x, high.y), True)
    painter.add_text(ImVec2(low.x + side + 3 * gap, top), theme.packed(theme.look.text), row.name)
    painter.pop_clip_rect()
    if not row.folder:
        told = size_text(row.size)
        said.add_text(painter, ImVec2(size - gap - said.calc_text_size(told).x, top), quiet, told)
        said.add_text(painter, ImVec2(date, top), quiet, row.date)


def _picture(desk: Desk, folder: Path, row: FileRow, corner: ImVec2) -> None:
    """A file's picture in the middle of its place; a sign while there is none."""
    painter, side = imgui.get_window_draw_list(), _PICTURE * desk.scale
    shown = None if row.folder else desk.pictures.get(previews.ident(folder, row))
    if shown is None:
        sign = icons.FOLDER if row.folder else icons.IMAGE
        wide = said.calc_text_size(sign)
        at = ImVec2(corner.x + (side - wide.x) / 2, corner.y + (side - wide.y) / 2)
        said.add_text(painter, at, theme.packed(theme.look.text if row.folder else theme.look.quiet), sign)
    else:
        painter.add_image(shown, corner, ImVec2(corner.x + side, corner.y + side))
