"""The list of keys: what each action, tool and brush is bound to, and otherwise."""

from __future__ import annotations

from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import ACTIONS, MENUS
from app.actions.binding import bound_with, change_keys, keys_with, owner_of, row_action, usual_keys
from app.actions.chosen_map import OWN_KEYS, take_map
from app.actions.key_maps import KEY_MAPS
from app.desk.desk import Desk
from app.desk.keys.key_state import Bound, brush_of, brush_row
from app.language import said
from app.panels.controls import widgets as w

_WIDE, _TALL, _KEYS = 46.0, 26.0, 17.0  # ems: of the list, and where keys begin from its right end
_BRUSHES = "Brushes"
_WITH_POINTER = (
    ("Wheel", "Zoom about the pointer"),
    ("Space + drag, middle button", "Pan"),
    ("Shift + Space + drag", "Turn the view"),
    ("Ctrl + Space + drag", "Zoom"),
    ("Ctrl + click, right button dragged", "Pick a colour"),
    ("Right click, a pen's button", "Pop-up palette: favourites, colours, zoom"),
    ("Alt + drag, with the brush", "Its radius sideways, its hardness up and down"),
    ("Shift + drag or click", "A straight line"),
)


class _Slot(NamedTuple):
    """Where a key is to stand: a row, and the `place` among its keys; -1: it is one more."""

    row: str
    place: int


class Keys:
    """Lists the keys; a click on one, and the next press takes its place."""

    title = "Keys"

    def __init__(self, desk: Desk) -> None:
        self._before = desk.keys.bound
        self._words, self._slot, self._pressed = "", _Slot("", -1), ""
        self._told, desk.keys.told, desk.keys.listening = desk.keys.told, "", False

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em = imgui.get_font_size()
        self._hear(desk)
        self._head(desk, em)
        imgui.push_style_color(imgui.Col_.child_bg, theme.vec(theme.look.field))
        room = imgui.get_main_viewport().work_size.y - 13 * em
        imgui.begin_child("list", ImVec2(_WIDE * em, min(_TALL * em, room)))
        imgui.pop_style_color()
        keys = keys_with(desk.keys.bound)
        for title, rows in self._groups(desk):
            self._group(desk, title, rows, keys)
        if not self._words:
            _pointer_rows(em)
        imgui.end_child()
        self._line(desk, em)
        stays = self._foot(desk, em)
        if not stays:
            desk.keys.listening = False
        return stays

    def _groups(self, desk: Desk) -> list[tuple[str, list[str]]]:
        """Returns the rows by their headings: those that all words are found in, or all."""
        listed = {menu: [n for n, a in ACTIONS.items() if a.menu.partition("/")[0] == menu] for menu in MENUS}
        listed[_BRUSHES] = [brush_row(preset.name) for preset in desk.known.presets]
        keys, words = keys_with(desk.keys.bound), self._words.casefold().split()

        def wanted(row: str) -> bool:
            told = f"{row_action(row).title} {' '.join(keys.get(row, ()))}".casefold()
            return all(word in told for word in words)

        return [(title, [row for row in rows if wanted(row)]) for title, rows in listed.items()]

    def _group(self, desk: Desk, title: str, rows: list[str], keys: dict[str, tuple[str, ...]]) -> None:
        if not rows:
            return
        if title == _BRUSHES and not self._words:
            opened = said.tree_node(f"{title}##brush keys", imgui.TreeNodeFlags_.no_tree_push_on_open)
            w.named("brush keys")
            w.tooltip("Each brush may have keys; a star gives a favourite its digit")
            if not opened:
                return
        else:
            said.text_disabled(title)
        for row in rows:
            self._row(desk, row, keys.get(row, ()))

    def _row(self, desk: Desk, row: str, keys: tuple[str, ...]) -> None:
        em, action = imgui.get_font_size(), row_action(row)
        imgui.push_id(row)
        imgui.set_cursor_pos_x(1.2 * em)
        imgui.align_text_to_frame_padding()
        said.text_unformatted(action.title)
        w.named(f"row {row}")
        w.tooltip(action.hint)
        imgui.same_line((_WIDE - _KEYS) * em)
        for index, key in enumerate(keys):
            self._chip(desk, _Slot(row, index), key)
            imgui.same_line(0, 0.3 * em)
        self._chip(desk, _Slot(row, -1), "")
        if keys != usual_keys(row):
            imgui.same_line(_WIDE * em - 2.6 * em)
            shown = ", ".join(usual_keys(row)) or "none"
            side = (
                imgui.get_frame_height() - imgui.get_style().frame_padding.y
            )  # or its row would be higher than others
            if w.icon_button("reset", icons.UNDO, f"As it comes: {shown}", size=side):
                change_keys(desk, bound_with(desk.keys.bound, row, usual_keys(row)))
        imgui.pop_id()

    def _chip(self, desk: Desk, slot: _Slot, key: str) -> None:
        """Draws a key of a row, or what adds one; a click waits for the next press, a right click takes it away."""
        waits = desk.keys.listening and self._slot == slot
        label = "Press a key…" if waits else key or icons.ADD
        hint = "Click, then press another key, button or wheel; right click: none" if key else "Click, then press a key"
        if w.lit_button(f"{label}###{slot.place}", hint, waits):
            self._slot, self._pressed, self._told = slot, "", ""
            desk.keys.listening, desk.keys.pressed = not waits, ""
        w.named(f"key {slot.row} {slot.place}")
        if key and imgui.is_item_clicked(imgui.MouseButton_.right):
            held = keys_with(desk.keys.bound)[slot.row]
            change_keys(desk, bound_with(desk.keys.bound, slot.row, tuple(one for one in held if one != key)))

    def _hear(self, desk: Desk) -> None:
        """Takes the key that was pressed: binds it, unless another has it."""
        state = desk.keys
        if not state.listening or not state.pressed:
            return
        self._pressed, state.pressed, state.listening = state.pressed, "", False
        if owner_of(state.bound, self._pressed) in ("", self._slot.row):
            self._bind(desk)

    def _bind(self, desk: Desk) -> None:
        row, index = self._slot.row, self._slot.place
        held = list(keys_with(desk.keys.bound).get(row, ()))
        if index >= 0:
            held[index] = self._pressed
        else:
            held.append(self._pressed)
        change_keys(desk, bound_with(desk.keys.bound, row, tuple(held)))
        self._told, self._pressed = f"{self._pressed}: {row_action(row).title}", ""

    def _head(self, desk: Desk, em: float) -> None:
        imgui.set_next_item_width(16 * em)
        self._words = said.input_text_with_hint("##find", "Find an action, brush or key", self._words)[1]
        w.named("find keys")
        w.tooltip("Words of what it does, or a key")
        imgui.same_line()
        current = next((name for name, row in KEY_MAPS.items() if _alike(row.bound, desk.keys.bound)), OWN_KEYS)
        own = [(OWN_KEYS, "Your own")] if current == OWN_KEYS or desk.keys.own else []
        titles = [(name, row.title) for name, row in KEY_MAPS.items()] + own
        chosen = w.choice("key map", current, titles, "Ready-made maps; keys of brushes stay", 9 * em)
        if chosen and chosen != current:
            self._told, self._pressed = take_map(desk, chosen, current), ""
        imgui.same_line()
        if w.text_button("Bring in…##keys", "Keys from a file"):
            desk.asked.show("keys from")
        imgui.same_line()
        if w.text_button("Give away…##keys", "Write your keys as a file"):
            desk.asked.show("keys to")

    def _line(self, desk: Desk, em: float) -> None:
        """Draws a line below the list: what was bound, or which row has the key that was pressed."""
        owner = owner_of(desk.keys.bound, self._pressed) if self._pressed else ""
        imgui.align_text_to_frame_padding()
        if not owner:
            said.text_disabled(self._told or "Click a key, then press another; Escape leaves it as it is")
            w.named("told of keys")
            return
        said.text_colored(theme.vec(theme.look.warn), f"{self._pressed} is “{row_action(owner).title}” already")
        w.named("conflict")
        imgui.same_line()
        if w.text_button("Take it##key", f"Give it to “{row_action(self._slot.row).title}”"):
            self._bind(desk)
        imgui.same_line()
        if w.text_button("Leave it##key", "Both stay as they are"):
            self._pressed = ""

    def _foot(self, desk: Desk, em: float) -> bool:
        """Draws the buttons; False when the dialog is done, or another takes its place."""
        closes = w.text_button("Close", "Close the list", width=em * 7)
        imgui.same_line()
        changed = desk.keys.bound != self._before
        if w.text_button("Take back##keys", "As they were when the list was opened", enabled=changed):
            change_keys(desk, self._before)
            self._pressed = ""
        return not (closes or desk.asked.dialog)


def _alike(one: Bound, other: Bound) -> bool:
    """Tells whether two maps bind the same but for brushes."""
    kept = {row: keys for row, keys in other.items() if not brush_of(row)}
    return dict(one) == kept


def _pointer_rows(em: float) -> None:
    """Draws what drags do, which no list changes."""
    said.text_disabled("With the pointer")
    for keys, title in _WITH_POINTER:
        imgui.set_cursor_pos_x(1.2 * em)
        said.text_unformatted(title)
        imgui.same_line((_WIDE - _KEYS) * em)
        said.text_colored(theme.vec(theme.look.accent), keys)
