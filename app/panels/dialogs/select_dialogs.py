"""The windows about what is selected: its rim, the name to keep it under, those that are kept."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.painting.commands import Select
from engine.painting.select_commands import JOIN_OPS, WIDEST_RIM, Named
from engine.studio.requests import Do
from engine.studio.selecting.ants_records import PreviewSelection

_WIDE = 16  # ems of a field
_JOINS = {"replace": "Select", "add": "Add", "subtract": "Subtract", "intersect": "Intersect"}
_HINTS = {
    "replace": "Select this in place of what is selected",
    "add": "Select this as well",
    "subtract": "Take this from what is selected",
    "intersect": "Leave what both have",
}
_CHANGES = (
    ("grow", "Grow", "Move the rim out"),
    ("shrink", "Shrink", "Move the rim in"),
    ("feather", "Feather", "Soften the rim"),
)


class ChangeSelection:
    """Grows, shrinks or feathers it, by pixels of what is seen; the rim shows what it would be."""

    title = "Change the selection"

    def __init__(self) -> None:
        self._tried: Select | None = None

    def draw(self, desk: Desk) -> bool:
        """Draws the contents; False when it is done."""
        state, wide = desk.selecting, _WIDE * imgui.get_font_size()
        state.change = w.segments("change", state.change, _CHANGES, wide) or state.change
        imgui.set_next_item_width(wide)
        _, state.amount = imgui.slider_int("Pixels", state.amount, 1, 64)
        state.amount = max(1, min(int(WIDEST_RIM), state.amount))
        w.named("select amount")
        w.tooltip("By so many pixels of what you see; Ctrl-click to type")
        command = _changing(state.change, float(state.amount), desk.view.shown_level)
        if command != self._tried:
            self._tried = command
            desk.post(PreviewSelection(command))
        imgui.spacing()
        chosen = w.default_button("Apply", "Change the selection so", width=wide / 2)
        imgui.same_line()
        done = w.text_button("Cancel", "Leave it as it is", width=wide / 2) or chosen
        if chosen:
            desk.post(Do(command))
        if done or imgui.is_key_pressed(imgui.Key.escape):
            desk.post(PreviewSelection(None))
        return not done


def _changing(way: str, amount: float, level: int) -> Select:
    """Returns the command that grows, shrinks or feathers by an amount."""
    if way == "feather":
        return Select(level=level, feather=amount)
    return Select(level=level, grow=amount if way == "grow" else -amount)


class KeepSelection:
    """Asks for a name."""

    title = "Keep the selection"

    def __init__(self) -> None:
        self._name = ""

    def draw(self, desk: Desk) -> bool:
        """Draws the contents; False when it is done."""
        if imgui.is_window_appearing():
            imgui.set_keyboard_focus_here()
        imgui.set_next_item_width(_WIDE * imgui.get_font_size())
        entered, self._name = imgui.input_text("Name", self._name, imgui.InputTextFlags_.enter_returns_true)
        w.named("selection name")
        w.tooltip("One of that name that is kept is replaced")
        name = self._name.strip()[:120]
        imgui.begin_disabled(not name)
        kept = w.text_button("Keep", "Keep it with the painting")
        imgui.end_disabled()
        if (kept or entered) and name:
            desk.post(Do(Select(keep=name)))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Keep nothing")


class KeptSelections:
    """Lists those that are kept."""

    title = "Kept selections"

    def draw(self, desk: Desk) -> bool:
        """Draws the contents; False when it is done."""
        for name in desk.selecting.saved:
            imgui.push_id(name)
            for op in JOIN_OPS:
                if w.text_button(_JOINS[op], _HINTS[op]):
                    desk.post(Do(Select(Named(name, saved=True), op, desk.view.shown_level)))
                    imgui.pop_id()
                    return False
                imgui.same_line()
            said.text_unformatted(name)
            imgui.pop_id()
        return not w.text_button("Close", "Leave what is selected as it is")
