"""The dialog of earlier versions: cards with their pictures and dates, one of which is opened."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import previews
from app.desk.desk import Desk
from app.desk.earlier import ReadVersions, Versions
from app.desk.folders import size_text
from app.desk.previews import FileRow
from app.language import said
from app.panels.controls import widgets as w

_SIDE = 192.0  # of a picture, points
_CARDS = 3  # that are in sight; more are scrolled to
_FLAGS = imgui.SelectableFlags_.allow_double_click | imgui.SelectableFlags_.no_auto_close_popups


class EarlierVersions:
    """Shows what is kept of the painting's file; opens one as an untitled painting."""

    title = "Earlier versions"

    def __init__(self, path: Path) -> None:
        self._path = path
        self._found: Versions | None = None
        self._wanted, self._chosen = True, 0

    def _listed(self, found: Versions) -> None:
        self._found = found

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        if self._wanted:
            desk.work(ReadVersions(self._path, self._listed))
            self._wanted = False
        em, side = imgui.get_font_size(), _SIDE * desk.scale
        pad = imgui.get_style().item_spacing.x
        card = ImVec2(side + 2 * pad, side + 3 * pad + 2 * imgui.get_text_line_height_with_spacing())
        bar = imgui.get_style().scrollbar_size
        imgui.push_style_color(imgui.Col_.child_bg, theme.vec(theme.look.field))
        room = ImVec2(_CARDS * card.x + (_CARDS + 1) * pad, card.y + 2 * pad + bar)
        imgui.begin_child("versions", room, 0, imgui.WindowFlags_.horizontal_scrollbar)
        opened = self._cards(desk, card, side)
        imgui.end_child()
        imgui.pop_style_color()
        said.text_disabled(f"Opens as an untitled painting; {self._path.name} stays as it is.")
        imgui.spacing()
        rows = self._rows
        hint = "Open the chosen version as an untitled painting"
        if w.default_button("Open", hint, enabled=bool(rows), width=em * 7) or opened:
            assert self._found is not None
            path = self._found[0] / rows[self._chosen].name
            desk.guard(lambda: desk.open(path, untitled=True))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Go back to the painting", width=em * 7)

    @property
    def _rows(self) -> tuple[FileRow, ...]:
        return () if self._found is None else self._found[1]

    def _cards(self, desk: Desk, card: ImVec2, side: float) -> bool:
        """Draws a card for each version, and has their pictures made; True when one was clicked on twice."""
        pad, opened = imgui.get_style().item_spacing.x, False
        if self._found is None or not self._rows:
            told = "" if self._found is None else "None yet: what a save replaces is kept from now on."
            room = imgui.get_window_size()
            size = said.calc_text_size(told)
            imgui.set_cursor_pos(ImVec2((room.x - size.x) / 2, (room.y - size.y) / 2))
            said.text_disabled(told)
            w.named(told)
            return False
        for number, row in enumerate(self._rows):
            imgui.set_cursor_pos(ImVec2(pad + number * (card.x + pad), pad))
            imgui.push_style_color(imgui.Col_.header_hovered, theme.vec(theme.look.raised, 0.45))
            if said.selectable(f"##{row.name}", False, _FLAGS, card)[0]:
                self._chosen = number
                opened = imgui.is_mouse_double_clicked(0)
            imgui.pop_style_color()
            w.named(f"version {number + 1}")
            w.tooltip("Choose this version; a double click opens it")
            _contents(desk, self._found[0], row, (number, side))
            if number == self._chosen:
                low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
                accent, rounding = theme.packed(theme.look.accent), imgui.get_style().frame_rounding
                imgui.get_window_draw_list().add_rect(low, high, accent, rounding, thickness=2 * desk.scale)
        desk.previews(self._found[0], self._rows, round(side))
        return opened


def _contents(desk: Desk, folder: Path, row: FileRow, place: tuple[int, float]) -> None:
    """What the card just drawn shows: the picture, when it was saved, which one it is, its size."""
    number, side = place
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    pad, painter = imgui.get_style().item_spacing.x, imgui.get_window_draw_list()
    line = imgui.get_text_line_height_with_spacing()
    corner = ImVec2((low.x + high.x - side) / 2, low.y + pad)
    shown = desk.pictures.get(previews.ident(folder, row))
    if shown is None:
        wide = said.calc_text_size(icons.IMAGE)
        at = ImVec2(corner.x + (side - wide.x) / 2, corner.y + (side - wide.y) / 2)
        said.add_text(painter, at, theme.packed(theme.look.quiet), icons.IMAGE)
    else:
        painter.add_image(shown, corner, ImVec2(corner.x + side, corner.y + side))
    top = corner.y + side + pad
    said.add_text(painter, ImVec2(corner.x, top), theme.packed(theme.look.text), row.date)
    ago = "before that" if number else "before the last save"
    said.add_text(painter, ImVec2(corner.x, top + line), theme.packed(theme.look.quiet), ago)
    size = size_text(row.size)
    right = corner.x + side - said.calc_text_size(size).x
    said.add_text(painter, ImVec2(right, top + line), theme.packed(theme.look.quiet), size)
