"""The letters of a text that is written, in the language's colours, with selections, carets and notes."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_color_text_edit as edit

from app import theme
from app.language import said
from app.panels.workshop import text_colours
from app.panels.workshop.text_colours import Names

GUTTER = 5  # letters: what stands beside the lines
Note = Callable[[int], str]  # tells what is said at the end of a row, by its number


class _Piece(NamedTuple):
    """Letters of a line, from, to, that stand side by side on the screen at a place."""

    at: ImVec2
    start: int
    end: int


def draw_letters(editor: edit.TextEditor, box: tuple[ImVec2, ImVec2], names: Names, note: Note) -> None:
    """Draws selections and letters of the lines in sight, below an editor that was drawn in a box."""
    painter, (corner, end) = imgui.get_window_draw_list(), box
    wide, high = editor.get_glyph_width(), editor.get_line_height()
    painter.push_clip_rect(ImVec2(corner.x + (GUTTER + 0.5) * wide, corner.y), end, True)
    lines = lines_in_sight(editor, corner.y, end.y)
    for number in range(editor.get_number_of_cursors()):
        _selection(editor, painter, number, lines)
    down = (high - imgui.get_font_size()) / 2
    for line in lines:
        for part in text_colours.text_parts(editor.get_line_text(line), names):
            for piece in _pieces(editor, line, part.at, part.at + len(part.text)):
                x, y, told = piece.at.x, piece.at.y, part.text[piece.start - part.at : piece.end - part.at]
                if part.kind == text_colours.COLOUR_PART:
                    _underlined(painter, ImVec2(x, y), ImVec2(len(told) * wide, high), part.text)
                said.add_text(painter, ImVec2(x, y + down), theme.packed(text_colours.tone(part)), told)
        _note(painter, note(line), ImVec2(end.x, editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(line, 0)).y), high)
    painter.pop_clip_rect()


def lines_in_sight(editor: edit.TextEditor, top: float, bottom: float) -> range:
    """Returns the lines between two heights of the screen; one line may take several rows."""
    tops = [editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(n, 0)).y for n in range(editor.get_line_count())]
    first = max(0, bisect_right(tops, top) - 1)  # its last row may be in sight
    return range(first, bisect_left(tops, bottom))


def _pieces(editor: edit.TextEditor, line: int, start: int, end: int) -> Iterator[_Piece]:
    """Yields where letters of a line stand: those of each row apart, where they go over an edge of it."""
    at = editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(line, start))
    last = editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(line, max(start, end - 1)))
    for index in range(start + 1, end) if last.y != at.y else ():
        there = editor.doc_pos2_screen_pos(edit.TextEditor.DocPos(line, index))
        if there.y != at.y:
            yield _Piece(at, start, index)
            at, start = there, index
    yield _Piece(at, start, end)


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
    left, down = end.x - size.x - 2 * pad - imgui.get_style().scrollbar_size, (high - size.y) / 2
    painter.add_rect_filled(
        ImVec2(left - pad, end.y), ImVec2(left + size.x + pad, end.y + high), theme.packed(theme.look.field)
    )
    said.add_text(painter, ImVec2(left, end.y + down), theme.packed(theme.look.accent), text)


def _selection(editor: edit.TextEditor, painter: imgui.ImDrawList, number: int, lines: range) -> None:
    found = editor.get_cursor_selection(number)
    start, end = found.start, found.end
    wide, high = editor.get_glyph_width(), editor.get_line_height()
    for line in lines:
        if not start.line <= line <= end.line or (start.line, start.index) == (end.line, end.index):
            continue
        first = start.index if line == start.line else 0
        last, more = (end.index, 0) if line == end.line else (len(editor.get_line_text(line)), 1)  # its end is seen
        for piece in _pieces(editor, line, first, last):
            to = ImVec2(piece.at.x + (piece.end - piece.start + more * (piece.end == last)) * wide, piece.at.y + high)
            painter.add_rect_filled(piece.at, to, theme.packed(theme.look.accent_soft))


def _underlined(painter: imgui.ImDrawList, at: ImVec2, size: ImVec2, text: str) -> None:
    """Draws a stroke of a colour below the letters that tell it."""
    rgb = tuple(int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    thick = max(2.0, 0.16 * size.y)
    corner, end = ImVec2(at.x, at.y + size.y - thick), ImVec2(at.x + size.x, at.y + size.y)
    painter.add_rect_filled(corner, end, theme.packed(rgb), thick / 3)
