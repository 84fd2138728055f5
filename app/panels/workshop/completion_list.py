"""The list of what the word that is being typed may become, at the caret."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_color_text_edit as edit

from app import theme
from app.language import said
from app.panels.controls import widgets as w
from app.panels.workshop.completing import Offer, offers, word_before
from app.panels.workshop.text_colours import Names
from engine.studio.workshop.workshop_records import WorkshopWords

_KEYS = {
    imgui.Key.down_arrow: 1,
    imgui.Key.up_arrow: -1,
    imgui.Key.tab: 0,
    imgui.Key.enter: 0,
    imgui.Key.keypad_enter: 0,
    imgui.Key.escape: None,
}
_WIDE = 26.0  # of the letters' size
_FLAGS = (
    imgui.WindowFlags_.no_title_bar
    | imgui.WindowFlags_.no_resize
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.no_nav
    | imgui.WindowFlags_.no_scrollbar
)


class CompletionList:
    """It belongs to an editor, whose keys it takes while it is open."""

    def __init__(self, editor: edit.TextEditor) -> None:
        self._editor = editor
        self._offers: tuple[Offer, ...] = ()
        self._chosen = 0
        self._at = (0, 0)  # where the caret was

    @property
    def opened(self) -> bool:
        """Tells whether it is to be seen."""
        return bool(self._offers)

    def close(self) -> None:
        """Offers nothing any more."""
        self._offers = ()

    def take_keys(self, focused: bool) -> None:
        """Does what a key asks for, and keeps it from the editor; before that is drawn."""
        if not self._offers or not focused:
            self._offers = ()
            return
        owner = imgui.get_id("completion")
        for key, way in _KEYS.items():
            if not imgui.is_key_pressed(key):
                continue
            imgui.internal.set_key_owner(key, owner, imgui.internal.InputFlagsPrivate_.lock_this_frame)
            if way is None:
                self._offers = ()
            elif way:
                self._chosen = (self._chosen + way) % len(self._offers)
            else:
                self._accept(self._chosen)
            return

    def draw(self, typed: bool, names: Names, words: WorkshopWords) -> None:
        """Draws what is offered; `typed`: the text is another one than before."""
        at = self._editor.get_main_cursor_position()
        if typed:
            line = self._editor.get_line_text(at.line)
            word = word_before(line, at.index)
            others = names.own - {line.partition("=")[0].strip()}
            self._offers, self._chosen = offers(word, words, others), 0
        elif (at.line, at.index) != self._at:
            self._offers = ()
        self._at = at.line, at.index
        if self._offers:
            self._list(at)

    def _list(self, at: edit.TextEditor.DocPos) -> None:
        size, padding = imgui.get_font_size(), imgui.get_style().frame_padding
        line = imgui.get_text_line_height() + 2 * padding.y
        caret = self._editor.doc_pos2_screen_pos(at)
        window = imgui.internal.get_current_window_read().root_window
        wide, tall = _WIDE * size, len(self._offers) * line + 2 * padding.y
        x = max(window.pos.x, min(caret.x, window.pos.x + window.size.x - wide))
        below = caret.y + self._editor.get_line_height() + padding.y
        above = caret.y - tall - padding.y
        fits = below + tall <= window.pos.y + window.size.y or above < window.pos.y
        imgui.set_next_window_pos(ImVec2(round(x), round(below if fits else above)))
        imgui.set_next_window_size(ImVec2(wide, tall))
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(padding.y, padding.y))
        imgui.push_style_color(imgui.Col_.window_bg, theme.vec(theme.look.popup))
        imgui.begin("##completion", None, _FLAGS)
        imgui.internal.bring_window_to_display_front(imgui.internal.get_current_window())
        for i, offer in enumerate(self._offers):
            self._row(i, offer, line)
        imgui.end()
        imgui.pop_style_color()
        imgui.pop_style_var()

    def _row(self, number: int, offer: Offer, high: float) -> None:
        corner, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
        if imgui.invisible_button(f"##offer {number}", ImVec2(wide, high)):
            self._accept(number)
            self._editor.set_focus()
        w.named(f"offer {offer.text}")
        painter, padding = imgui.get_window_draw_list(), imgui.get_style().frame_padding
        if imgui.is_item_hovered() or number == self._chosen:
            grey = theme.look.accent_soft if number == self._chosen else theme.look.hover
            painter.add_rect_filled(corner, ImVec2(corner.x + wide, corner.y + high), theme.packed(grey), 3)
        imgui.set_cursor_screen_pos(ImVec2(corner.x, corner.y + high))
        x, y = corner.x + padding.x, corner.y + padding.y
        imgui.push_font(theme.letters, 0.0)
        said.add_text(painter, ImVec2(x, y), theme.packed(theme.look.text), offer.form)
        x += imgui.calc_text_size(offer.form).x + padding.x
        imgui.pop_font()
        painter.push_clip_rect(corner, ImVec2(corner.x + wide, corner.y + high), True)
        said.add_text(painter, ImVec2(x, y), theme.packed(theme.look.quiet), offer.about)
        painter.pop_clip_rect()

    def _accept(self, number: int) -> None:
        at, offer = self._editor.get_main_cursor_position(), self._offers[number]
        line = self._editor.get_line_text(at.line)
        word = word_before(line, at.index)
        text = offer.text[:-1] if offer.text.endswith("(") and line[at.index :].startswith("(") else offer.text
        start = edit.TextEditor.DocPos(at.line, at.index - len(word))
        self._editor.replace_section_text(start, at, text)
        self._editor.set_cursor(edit.TextEditor.DocPos(at.line, start.index + len(text)))
        self._offers = ()
