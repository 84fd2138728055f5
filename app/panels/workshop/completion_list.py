"""The list of what the word that is being typed may become, at the caret."""

from __future__ import annotations

from collections.abc import Iterable

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_color_text_edit as edit

from app import theme
from app.language import said
from app.panels.controls import widgets as w
from app.panels.workshop.completing import Offer, accepted, offers, word_before
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
_WIDE = 28.0  # of the letters' size
_SEEN = 7  # that are seen at a time
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
        self._chosen, self._first = 0, 0  # of all; the first one in sight
        self._asked, self._word = False, ""  # what is being typed
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
        owner = imgui.get_id("completion")
        if focused and imgui.is_key_chord_pressed(imgui.Key.mod_ctrl | imgui.Key.space):
            self._asked = True
            imgui.internal.set_key_owner(imgui.Key.space, owner, imgui.internal.InputFlagsPrivate_.lock_this_frame)
        if not self._offers or not focused:
            self._offers = ()
            return
        for key, way in _KEYS.items():
            if not imgui.is_key_pressed(key):
                continue
            if way == 0 and self._offers[self._chosen].text == self._word:
                self._offers = ()  # it stands there: the key is the editor's
                return
            imgui.internal.set_key_owner(key, owner, imgui.internal.InputFlagsPrivate_.lock_this_frame)
            if way is None:
                self._offers = ()
            elif way:
                self._choose((self._chosen + way) % len(self._offers))
            else:
                self._accept(self._chosen)
            return

    def draw(self, typed: bool, names: Names, words: WorkshopWords, textures: Iterable[str]) -> None:
        """Draws what is offered; `typed`: the text is another one than before; `textures`: the painting's."""
        at = self._editor.get_main_cursor_position()
        if typed or self._asked:
            line = self._editor.get_line_text(at.line)
            word = self._word = word_before(line, at.index)
            others = names.own - {line.partition("=")[0].strip()}
            self._offers = offers(word, words, others, textures) if word or self._asked else ()
            self._chosen = self._first = 0
            self._asked = False
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
        wide, tall = _WIDE * size, min(_SEEN, len(self._offers)) * line + 2 * padding.y
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
        if imgui.is_window_hovered() and imgui.get_io().mouse_wheel:
            self._first -= round(imgui.get_io().mouse_wheel)
        self._first = max(0, min(self._first, len(self._offers) - _SEEN))
        for i, offer in enumerate(self._offers[self._first : self._first + _SEEN], self._first):
            self._row(i, offer, line)
        self._bar(ImVec2(wide, tall))
        imgui.end()
        imgui.pop_style_color()
        imgui.pop_style_var()

    def _choose(self, number: int) -> None:
        self._chosen = number
        self._first = max(number - _SEEN + 1, min(self._first, number))

    def _bar(self, size: ImVec2) -> None:
        """Draws how many there are beside those in sight."""
        count = len(self._offers)
        if count > _SEEN:
            corner, high = imgui.get_window_pos(), size.y / count
            top, wide = corner.y + self._first * high, 0.2 * imgui.get_font_size()
            start, end = ImVec2(corner.x + size.x - wide, top), ImVec2(corner.x + size.x, top + _SEEN * high)
            imgui.get_window_draw_list().add_rect_filled(start, end, theme.packed(theme.look.quiet), wide / 2)

    def _row(self, number: int, offer: Offer, high: float) -> None:
        corner, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
        imgui.invisible_button(f"##offer {number}", ImVec2(wide, high))
        if imgui.is_item_hovered() and imgui.is_mouse_clicked(
            imgui.MouseButton_.left
        ):  # the press takes the focus away
            self._accept(number)
            self._editor.set_focus()
        w.named(f"offer {offer.text}")
        w.tooltip(f"{offer.form}\n{offer.about}")
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
        start, end, text = accepted(self._editor.get_line_text(at.line), at.index, offer)
        first, last = (edit.TextEditor.DocPos(at.line, index) for index in (start, end))
        self._editor.replace_section_text(first, last, text)
        self._editor.set_cursor(edit.TextEditor.DocPos(at.line, start + len(text)))
        self._offers = ()
