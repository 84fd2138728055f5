"""The cards of paintings that were not closed, and of those in the bin: picture, name, when, and what may be done."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import previews
from app.desk.desk import Desk
from app.desk.previews import FileRow
from app.desk.recovery.recovery_state import made_text, when_text
from app.desk.recovery.recovery_work import Discard, ListBin, recover
from app.faults.log import log_file
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w
from app.panels.controls.fitting import home_text, shortened

if TYPE_CHECKING:
    from engine.journal.entries import Entry

_WIDTH, _PICTURE, _PAD = 43.0, 8.2, 0.8  # of a card, of its picture, around both; ems
_GAP = 0.55  # ems from a card to the next
_IN_SIGHT = 3.45  # cards: part of the next one shows that there are more
_AROUND = 12.0  # ems of a window that the dialog takes above and below the cards
_NAME = 1.25  # a name's size, in that of all other text
_DAMAGED = "Part of what was done last is missing"
_BUTTONS = {"Open": 5.6, "Keep for later": 8.6, "Discard": 6.0}  # widths, ems


class Cards:
    """Lists the paintings; a card that is dealt with stays where it is until all are, or the dialog is left."""

    title, title_of_one = "Paintings that were not closed", "A painting that was not closed"
    lead = "What you open has no name yet: the file that it came from stays as it is."
    keeps = True

    def __init__(self, desk: Desk) -> None:
        self._entries, self._crashed = desk.recovery.cards, desk.recovery.crashed
        if len(self._entries) == 1:
            self.title = self.title_of_one
        self._spent: dict[str, str] = {}  # by the idents of what is dealt with, what became of it

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em = imgui.get_font_size()
        said.text_disabled(self.lead)
        imgui.spacing()
        opened = self._list(desk, em)
        imgui.spacing()
        left = len(self._entries) - len(self._spent)
        many = self.keeps and left > 1
        label, hint = ("Keep all for later", "They are listed again at the next start") if many else ("Close", "Go on")
        leaves = w.text_button(f"{label}###leave", hint, width=em * 10)
        return not (opened or leaves or (self._entries and not left))

    def _list(self, desk: Desk, em: float) -> bool:
        """Draws the cards; tells whether one of them is opened."""
        tall, gap = em * (_PICTURE + 2 * _PAD), em * _GAP
        around = em * (_AROUND if self._entries else 0.0)
        fitting = max((imgui.get_main_viewport().work_size.y - around + gap) / (tall + gap), 1.0)
        shown = min(float(len(self._entries)), _IN_SIGHT, fitting)
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(imgui.get_style().item_spacing.x, gap))
        imgui.begin_child("cards", ImVec2(em * _WIDTH, shown * (tall + gap) - gap))
        opened = None
        for entry in self._entries:
            if self._card(desk, entry, (em, tall)):
                opened = entry
        imgui.end_child()
        imgui.pop_style_var()
        if self._entries:
            rows = [_picture_row(entry) for entry in self._entries if entry.picture is not None]
            desk.previews(self._entries[0].folder.parent, rows, round(em * _PICTURE))
        if opened is not None:
            recover(desk, opened)
        return opened is not None

    def _card(self, desk: Desk, entry: Entry, size: tuple[float, float]) -> bool:
        """Draws a card; tells whether its painting is to be opened."""
        em, tall = size
        spent = entry.ident in self._spent
        imgui.push_style_color(imgui.Col_.child_bg, theme.vec(theme.look.shade if spent else theme.look.card))
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(em * _PAD, em * _PAD))
        flags = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse
        imgui.begin_child(f"card {entry.ident}", ImVec2(0, tall), imgui.ChildFlags_.always_use_window_padding, flags)
        imgui.pop_style_var()
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(em * 0.45, em * 0.3))
        imgui.push_style_var(imgui.StyleVar_.alpha, 0.45 if spent else 1.0)
        shown = desk.pictures.get(previews.ident(entry.folder.parent, _picture_row(entry)))
        corner = w.picture(shown, (em * _PICTURE, em * _PICTURE), "", name=f"picture of {entry.name}")
        if shown is None:
            _sign(corner, em)
        imgui.same_line(0, em * 1.1)
        imgui.begin_group()
        self._words(entry, em)
        imgui.end_group()
        imgui.pop_style_var()
        pressed = self._buttons(desk, entry, em, tall)
        imgui.pop_style_var()
        imgui.end_child()
        imgui.pop_style_color()
        return pressed

    def _words(self, entry: Entry, em: float) -> None:
        imgui.push_font(None, imgui.get_style().font_size_base * _NAME)
        imgui.text_unformatted(shortened(entry.name or say("Untitled"), em * (_WIDTH - _PICTURE - 4.5)))
        imgui.pop_font()
        said.text_unformatted(f"{when_text(entry.when, time.time())}")
        said.text_disabled(made_text(entry.strokes, entry.seconds))
        wrong = [f"Missing: {fault}" for fault in entry.faults]
        told = [*(["Inkfall crashed"] if entry.ident in self._crashed else []), *([_DAMAGED] if wrong else [])]
        if told:
            said.text_colored(theme.vec(theme.look.warn), f"{icons.WARNING}  {'; '.join(told)}")
            w.named(f"fault of {entry.name}")
            crash = [f"{log_file()} tells more of the crash"] if entry.ident in self._crashed else []
            w.tooltip("\n".join([*wrong, *crash]))
        if entry.path is not None:
            said.text_disabled(shortened(f"of {home_text(entry.path)}", em * (_WIDTH - _PICTURE - 4.5)))
            w.tooltip(f"{entry.path} stays as it is")

    def _buttons(self, desk: Desk, entry: Entry, em: float, tall: float) -> bool:
        """Draws a card's buttons in its lower right corner; tells whether it is to be opened."""
        right, down = imgui.get_window_width() - em * _PAD, tall - em * _PAD - imgui.get_frame_height()
        if entry.ident in self._spent:
            told = self._spent[entry.ident]
            imgui.set_cursor_pos(ImVec2(right - said.calc_text_size(told).x, down))
            said.text_unformatted(told)
            return False
        names = ["Open", *(["Keep for later"] if self.keeps else []), "Discard"]
        gap = em * 0.45
        imgui.set_cursor_pos(ImVec2(right - sum(_BUTTONS[name] * em + gap for name in names) + gap, down))
        hint = "Open it as a painting without a name; its file stays as it is"
        opened = w.accent_button(f"Open##{entry.ident}", hint, width=_BUTTONS["Open"] * em)
        imgui.same_line(0, gap)
        if self.keeps:
            hint = "It is listed again at the next start"
            if w.text_button(f"Keep for later##{entry.ident}", hint, width=_BUTTONS["Keep for later"] * em):
                self._spent[entry.ident] = "Kept for later"
            imgui.same_line(0, gap)
        self._discard(desk, entry, _BUTTONS["Discard"] * em)
        return opened

    def _discard(self, desk: Desk, entry: Entry, width: float) -> None:
        if w.text_button(f"Discard##{entry.ident}", "Put it into the bin (File > Bin)", width=width):
            self._spent[entry.ident] = "In the bin"
            desk.work(Discard(entry))


class Bin(Cards):
    """Lists what is in the bin."""

    title = title_of_one = "Bin"
    lead = "Paintings that were closed without saving, or discarded, stay here for 30 days of use."
    keeps = False

    def __init__(self, desk: Desk) -> None:
        super().__init__(desk)
        self._sure = ""  # the ident of what is deleted when that is pressed again
        self._entries = ()
        desk.recovery.bin = None
        desk.work(ListBin())

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        self._entries = self._entries or desk.recovery.bin or ()
        if not self._entries:
            imgui.dummy(ImVec2(imgui.get_font_size() * _WIDTH, imgui.get_font_size()))
            said.text_unformatted("Looking…" if desk.recovery.bin is None else "Nothing is in the bin.")
        return super().draw(desk)

    def _discard(self, desk: Desk, entry: Entry, width: float) -> None:
        sure = self._sure == entry.ident
        label = f"{'Sure?' if sure else 'Delete'}###delete {entry.ident}"
        if w.text_button(label, "Press again: it cannot be had back" if sure else "Delete it for good", width=width):
            if sure:
                self._spent[entry.ident] = "Deleted"
                desk.work(Discard(entry))
            self._sure = "" if sure else entry.ident


def _picture_row(entry: Entry) -> FileRow:
    """Returns its picture, as a file of the folder that all entries lie in."""
    return FileRow(f"{entry.folder.name}/picture.png", False, changed=round(entry.when * 1e9))


def _sign(corner: ImVec2, em: float) -> None:
    """Draws a sign where no picture is."""
    wide = said.calc_text_size(icons.IMAGE)
    at = ImVec2(corner.x + (_PICTURE * em - wide.x) / 2, corner.y + (_PICTURE * em - wide.y) / 2)
    imgui.get_window_draw_list().add_text(at, theme.packed(theme.look.quiet), icons.IMAGE)
