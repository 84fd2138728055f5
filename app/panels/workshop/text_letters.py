"""The letters of a text that is written, in the language's colours, with selections, carets and notes."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_color_text_edit as edit

from app import theme
from app.language import said
from app.panels.workshop import text_colours
from app.panels.workshop.text_colours import Names

GUTTER = 5  # letters: what stands beside the lines
Note = Callable[[int], str]  # tells what is said at the end of a row, by its number


def draw_letters(editor: edit.TextEditor, box: tuple[ImVec2, ImVec2], names: Names, note: Note) -> None:
    """Draws selections and letters of the rows in sight, below an editor that was drawn in a box."""
    painter, (corner, end) = imgui.get_window_draw_list(), box
    wide, high = editor.get_glyph_width(), editor.get_line_height()
    painter.push_clip_rect(ImVec2(corner.x + (GUTTER + 0.5) * wide, corner.y), end, True)
    rows = range(
        max(0, editor.get_first_visible_row()), min(editor.get_last_visible_row() + 1, editor.get_line_count())
    )
    for number in range(editor.get_number_of_cursors()):
        _selection(editor, painter, number, rows)
    down = (high - imgui.get_font_size()) / 2
    for row in rows:
        at = editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(row, 0))
        for part in text_colours.text_parts(editor.get_line_text(row), names):
            x = at.x + part.at * wide
            if part.kind == text_colours.COLOUR_PART:
                _underlined(painter, ImVec2(x, at.y), ImVec2(len(part.text) * wide, high), part.text)
            said.add_text(painter, ImVec2(x, at.y + down), theme.packed(text_colours.tone(part)), part.text)
        _note(painter, note(row), ImVec2(end.x, at.y), high)
    painter.pop_clip_rect()


def draw_caret(caret: edit.TextEditor.CustomCaret) -> None:
    """Draws a caret, while it is to be seen."""
    if caret.caret_visible:
        at, thick = caret.glyph_pos, 1.5 * imgui.get_style().font_scale_dpi
        end = ImVec2(at.x + thick, at.y + caret.glyph_size.y)
        caret.draw_list.add_rect_filled(at, end, theme.packed(theme.look.text))


def _note(painter: imgui.ImDrawList, text: str, end: ImVec2, high: float) -> None:
    """Draws what is said at the end of a row, over its letters."""
    if not text:
        return
    size, pad = imgui.calc_text_size(text), imgui.get_style().frame_padding.x
    left, down = end.x - size.x - 2 * pad, (high - size.y) / 2
    painter.add_rect_filled(ImVec2(left - pad, end.y), ImVec2(end.x, end.y + high), theme.packed(theme.look.field))
    said.add_text(painter, ImVec2(left, end.y + down), theme.packed(theme.look.accent), text)


def _selection(editor: edit.TextEditor, painter: imgui.ImDrawList, number: int, rows: range) -> None:
    found = editor.get_cursor_selection(number)
    start, end = found.start, found.end
    wide, high = editor.get_glyph_width(), editor.get_line_height()
    for row in rows:
        if not start.line <= row <= end.line or (start.line, start.index) == (end.line, end.index):
            continue
        first = start.index if row == start.line else 0
        last = end.index if row == end.line else len(editor.get_line_text(row)) + 1
        at = editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(row, 0))
        corner, to = ImVec2(at.x + first * wide, at.y), ImVec2(at.x + last * wide, at.y + high)
        painter.add_rect_filled(corner, to, theme.packed(theme.look.accent_soft))


def _underlined(painter: imgui.ImDrawList, at: ImVec2, size: ImVec2, text: str) -> None:
    """Draws a stroke of a colour below the letters that tell it."""
    rgb = tuple(int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    thick = max(2.0, 0.16 * size.y)
    corner, end = ImVec2(at.x, at.y + size.y - thick), ImVec2(at.x + size.x, at.y + size.y)
    painter.add_rect_filled(corner, end, theme.packed(rgb), thick / 3)
