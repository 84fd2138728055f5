"""What stands beside the lines of a text: each one's picture, which a click brings alone into sight, and its values."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from app.panels.workshop import text_colours
from engine.studio.workshop.workshop_records import LINES_ACROSS, WorkshopLine
from engine.texture.expression.written import samples_told

_LARGE = 128  # points of a line's picture under the pointer


class LineMarks:
    """Draws them row by row, as the field goes along."""

    def __init__(self) -> None:
        self._desk: Desk | None = None
        self._rows: dict[int, tuple[int, WorkshopLine]] = {}

    def begin(self, desk: Desk) -> None:
        """Takes what is known now, of the lines that stand where they stood."""
        self._desk, rows = desk, desk.workshop.text.split("\n")
        lines = enumerate(desk.workshop.scene.lines)
        self._rows = {line.row - 1: (n, line) for n, line in lines if _stands(line, rows)}

    def draw(self, row: int, corner: ImVec2, size: ImVec2) -> None:
        """Draws what stands beside a row, counted from 0."""
        if self._desk is None or row not in self._rows:
            return
        desk, (number, line) = self._desk, self._rows[row]
        state, side = desk.workshop, size.y - 2
        x = corner.x + (size.x - 1.6 * side) / 2
        last = len(state.scene.lines) - 1
        alone = number == (state.line if 0 <= state.line <= last else last)
        imgui.set_cursor_screen_pos(ImVec2(x, corner.y + 1))
        if imgui.invisible_button(f"##line {row}", ImVec2(1.6 * side, side)):
            state.line = -1 if number == last or state.line == number else number
        w.named(f"line {number + 1}")
        painter, at, end = imgui.get_window_draw_list(), imgui.get_item_rect_min(), imgui.get_item_rect_max()
        shown = line_picture(desk, line.name)
        if shown is not None:
            picture, u, v = shown
            middle, half = (u.y + v.y) / 2, (v.y - u.y) / 3.2
            u, v = ImVec2(u.x, middle - half), ImVec2(v.x, middle + half)
            painter.add_image_rounded(picture, at, end, u, v, -1 & 0xFFFFFFFF, 3)
        if alone or imgui.is_item_hovered():
            colour = theme.packed(theme.look.accent if alone else theme.look.text)
            painter.add_rect(at - ImVec2(1, 1), end + ImVec2(1, 1), colour, 3, thickness=1.5)
        if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
            _tell(desk, line)

    def note(self, row: int) -> str:
        """Returns what a row's line is at the pixel under the pointer; "" while that is over nothing."""
        desk = self._desk
        if desk is None or row not in self._rows or desk.workshop.over is None or desk.workshop.seen is None:
            return ""
        number, values = self._rows[row][0], desk.workshop.seen.values
        return _told(values[number]) if number < len(values) else ""


def _stands(line: WorkshopLine, rows: list[str]) -> bool:
    """Tells whether a line is in its row still, now that the text is written on."""
    row = rows[line.row - 1] if line.row <= len(rows) else ""
    named = text_colours.own_names(row)
    return line.name in named if line.name else bool(row.strip()) and not named


def line_corners(number: int, count: int) -> tuple[ImVec2, ImVec2]:
    """Returns where a line's picture lies among all."""
    rows = -(-count // LINES_ACROSS)
    left, top = number % LINES_ACROSS / LINES_ACROSS, number // LINES_ACROSS / rows
    return ImVec2(left, top), ImVec2(left + 1 / LINES_ACROSS, top + 1 / rows)


def _told(values: tuple[float, ...]) -> str:
    if len(values) == 1:
        return f"{values[0]:.3f}"
    red, green, blue, alpha = values
    shown = (round(max(0.0, min(1.0, value)) * 255) for value in (red, green, blue))
    return "#" + "".join(f"{value:02x}" for value in shown) + (f" {alpha:.0%}" if alpha < 0.999 else "")


def line_picture(desk: Desk, name: str) -> tuple[imgui.ImTextureRef, ImVec2, ImVec2] | None:
    """Returns the picture in which a line's lies, and where; None as long as there is none of it."""
    shown, pictured = desk.pictures.get("workshop lines"), desk.workshop.scene.pictured
    if shown is None or name not in pictured:
        return None
    return (shown, *line_corners(pictured.index(name), len(pictured)))


def _tell(desk: Desk, line: WorkshopLine) -> None:
    """Draws a line's picture larger, and what is known of it."""
    side, padding = _LARGE * desk.scale, imgui.get_style().window_padding
    shown = line_picture(desk, line.name)
    samples = samples_told(line.samples)
    text = f"{line.cost:,.0f} ns a pixel, {samples}"
    about = f"{line.least:.2f} … {line.most:.2f}"
    beyond = () if line.coloured else ("Blue is below 0",) * (line.least < 0) + ("Orange is above 1",) * (line.most > 1)
    high = side + (3 + len(beyond)) * imgui.get_text_line_height_with_spacing()
    wide = max(side, said.calc_text_size(text).x, said.calc_text_size(line.name).x)
    imgui.set_next_window_size(ImVec2(wide, high) + padding * 2)
    if imgui.begin_tooltip():
        if shown is not None:
            picture, u, v = shown
            imgui.image(picture, ImVec2(side, side), u, v)
        said.text_unformatted(line.name or "the texture")
        said.text_disabled(about)
        said.text_disabled(text)
        for told in beyond:
            said.text_disabled(told)
        imgui.end_tooltip()
