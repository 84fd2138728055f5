"""The field in which a texture is written: imgui-bundle's editor, whose letters are drawn here in colours.

Its own colours cannot be set from Python, so that it draws nothing but squiggles: letters, selections and carets lie
below it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_color_text_edit as edit

from app import theme
from app.panels.controls import widgets as w
from app.panels.workshop import text_colours, text_letters
from app.panels.workshop.completing import function_around, word_at
from app.panels.workshop.completion_list import CompletionList
from app.panels.workshop.text_colours import Names
from app.panels.workshop.text_steps import TextSteps, Typed
from engine.studio.workshop.workshop_records import WorkshopMistake, WorkshopWord, WorkshopWords

At = edit.TextEditor.DocPos
_BESIDE = (
    imgui.WindowFlags_.no_background
    | imgui.WindowFlags_.no_scrollbar
    | imgui.WindowFlags_.no_scroll_with_mouse
    | imgui.WindowFlags_.no_nav
)
_SPACING = 1.32  # of a line's height
Beside = Callable[[int, ImVec2, ImVec2], None]  # draws what stands beside a row: its number, from 0, corner and size


class FieldShown(NamedTuple):
    """What the field is to show: where the text is wrong, the words of the language, what stands beside a row, and the
    names of the painting's textures."""

    mistake: WorkshopMistake | None
    words: WorkshopWords
    beside: Beside
    note: text_letters.Note
    textures: tuple[str, ...] = ()


class TextField:
    """One for each text; undo and redo are its own."""

    def __init__(self) -> None:
        self._editor = editor = edit.TextEditor()
        editor.set_palette(edit.TextEditor.Palette())  # all clear
        editor.set_line_spacing(_SPACING)
        editor.set_show_line_numbers_enabled(False)
        editor.set_show_whitespaces_enabled(False)
        editor.set_show_matching_brackets(False)
        editor.set_show_scrollbar_mini_map_enabled(False)
        editor.set_show_current_line_highlight_enabled(False)
        editor.set_complete_paired_glyphs(False)
        editor.set_word_wrap_enabled(True)
        breaks = edit.TextEditor.LineBreakConfig()
        breaks.break_after, breaks.break_before = "", " ,("  # it goes on one letter behind that
        editor.set_line_break_config(breaks)
        editor.set_tab_size(4)
        editor.set_insert_spaces_on_tabs(True)
        editor.set_line_decorator(text_letters.GUTTER, _no_mark)
        editor.set_custom_caret_renderer(text_letters.draw_caret)
        self._completion = CompletionList(editor)
        self._steps, self._count = TextSteps(), 0  # of undo, and how many the editor had
        self._words = WorkshopWords()
        self._marked: WorkshopMistake | None = None
        self._names, self._rows = (WorkshopWords(), ""), Names()
        self._text = ""
        self.focused = False

    @property
    def text(self) -> str:
        """Gives what is written."""
        return self._text

    def put(self, text: str, whole: bool = False) -> None:
        """Takes another text, which can be undone; `whole`: which cannot, as it is the first."""
        if whole:
            self._editor.set_text(text)
        else:
            self._editor.select_all()
            self._editor.replace_text_in_current_cursor(text)
        self._steps.end()
        self._note()
        self._steps.end()
        self._editor.set_cursor(At(0, 0))
        self._text = self._editor.get_text()
        self._completion.close()

    def go_to(self, line: int, column: int) -> None:
        """Puts the caret at a place, counted from 1."""
        self._editor.set_cursor(At(line - 1, column - 1))
        self._editor.set_focus()

    def travel(self, steps: int) -> None:
        """Takes back what was written, a word or what was typed until a pause, or writes it again."""
        editor = self._editor
        if steps < 0:
            back = self._steps.back(editor.get_undo_index())
            while editor.can_undo() and editor.get_undo_index() > back:
                editor.undo()
        else:
            again = self._steps.again(editor.get_undo_index())
            while editor.can_redo() and (again is None or editor.get_undo_index() < again):
                editor.redo()
        self._text, self._count = editor.get_text(), editor.get_undo_index()

    @property
    def travels(self) -> tuple[bool, bool]:
        """Tells whether something can be taken back, and written again."""
        return self._editor.can_undo(), self._editor.can_redo()

    def function(self, words: WorkshopWords) -> WorkshopWord | None:
        """Returns the function that is being written."""
        at = self._editor.get_main_cursor_position()
        return function_around(self._editor.get_line_text(at.line), at.index, words)

    def draw(self, size: ImVec2, shown: FieldShown) -> None:
        """Draws it into the present window."""
        self._words = shown.words
        self._mark(shown.mistake)
        corner, painter = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
        painter.add_rect_filled(corner, corner + size, theme.packed(theme.look.field), imgui.get_style().frame_rounding)
        imgui.push_font(theme.letters, theme.FONT_SIZE - 1.0)
        self._completion.take_keys(self.focused)
        self._take_keys()
        self._editor.render("##text", size)
        w.placed("text of the texture", corner, corner + size)
        hovered = imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip)
        self.focused = imgui.is_item_focused() or self._editor_focused()
        text = self._editor.get_text()
        self._note()
        typed, self._text = text != self._text, text
        text_letters.draw_letters(self._editor, (corner, corner + size), self._known(), shown.note)
        self._beside((corner, corner + size), shown.beside)
        imgui.pop_font()
        self._completion.draw(typed and self.focused, self._known(), shown.words, shown.textures)
        if hovered:
            self._hint(corner, size, shown.words)

    def _take_keys(self) -> None:
        """Takes the keys of undo from the editor, whose steps are a letter each."""
        io, owner = imgui.get_io(), imgui.get_id("undo")
        if not self.focused or not io.key_ctrl or io.key_alt:
            return
        for key, steps in ((imgui.Key.z, 1 if io.key_shift else -1), (imgui.Key.y, 1)):
            if imgui.is_key_pressed(key):
                imgui.internal.set_key_owner(key, owner, imgui.internal.InputFlagsPrivate_.lock_this_frame)
                self.travel(steps)

    def _note(self) -> None:
        """Takes what was written since it was looked at last into the steps of undo."""
        count, self._count = self._count, self._editor.get_undo_index()
        if self._count <= count:
            return
        at = self._editor.get_main_cursor_position()
        before = self._editor.get_line_text(at.line)[: at.index]
        grown = len(self._editor.get_text()) - len(self._text)
        typed = Typed(grown, (at.line, at.index), before, imgui.get_time())
        self._steps.note(count, self._count - count, typed)

    def _editor_focused(self) -> bool:
        window = imgui.get_current_context().nav_window
        return window is not None and "##text" in window.name

    def _known(self) -> Names:
        """Returns what names mean now."""
        key = self._words, self._text
        if key != self._names:
            functions = frozenset(row.name for row in key[0].functions)
            places = frozenset(row.name for row in key[0].names) | {"pi", "tau", "e", "if", "else"}
            self._names, self._rows = key, Names(functions, places, text_colours.own_names(self._text))
        return self._rows

    def _mark(self, mistake: WorkshopMistake | None) -> None:
        """Underlines where the text is wrong."""
        if mistake == self._marked:
            return
        self._marked = mistake
        self._editor.clear_squiggles()
        if mistake is None or mistake.line > self._editor.get_line_count():
            return
        line = self._editor.get_line_text(mistake.line - 1)
        start = min(mistake.column - 1, max(len(line) - 1, 0))
        found = next((p for p in text_colours.text_parts(line, self._rows) if p.at <= start < p.at + len(p.text)), None)
        end = start + 1 if found is None else found.at + len(found.text)
        colour = theme.packed(theme.look.warn)
        self._editor.add_squiggle(At(mistake.line - 1, start), At(mistake.line - 1, end), 0, colour)

    def _beside(self, box: tuple[ImVec2, ImVec2], beside: Beside) -> None:
        """Draws what stands beside the lines: over the editor, which knows rows alone, and a line may take several."""
        (corner, end), high = box, self._editor.get_line_height()
        wide = text_letters.GUTTER * self._editor.get_glyph_width()
        imgui.set_cursor_screen_pos(corner)
        imgui.begin_child("beside the text", ImVec2(wide, end.y - corner.y), 0, _BESIDE)
        for line in text_letters.lines_in_sight(self._editor, corner.y, end.y):
            at = self._editor.doc_pos2_screen_pos(At(line, 0))
            beside(line, ImVec2(corner.x, at.y), ImVec2(wide, high))
        imgui.end_child()

    def _hint(self, corner: ImVec2, size: ImVec2, words: WorkshopWords) -> None:
        """Tells what the word under the pointer does."""
        mouse = imgui.get_mouse_pos()
        inside = corner.x <= mouse.x < corner.x + size.x and corner.y <= mouse.y < corner.y + size.y
        if not inside or self._completion.opened or not self._editor.is_mouse_pos_over_glyph(mouse):
            return
        at = self._editor.get_doc_pos_at_mouse_pos(mouse)
        found = word_at(self._editor.get_line_text(at.line), at.index, words)
        if found is not None:
            w.show_tooltip(f"{found.form}\n{found.about}")


def _no_mark(row: edit.TextEditor.Decorator) -> None:
    """Draws nothing: room is kept, see `_beside`."""
