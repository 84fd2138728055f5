"""The numbers of the frame, and what else crops, in the bar above the canvas while its tool is in hand."""

from __future__ import annotations

from imgui_bundle import imgui

from app.actions import actions
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.layering.frame_command import LONGEST_SIDE
from engine.studio.requests import Do

FRAME_OPTIONS_WIDTH = 56.0  # of the bar, ems
_FARTHEST = 1 << 30  # that a field of imgui holds
_FIELDS = (
    ("x", "Where the frame begins, pixels of level 0"),
    ("y", "Where the frame begins, pixels of level 0"),
    ("w", "How wide the frame is"),
    ("h", "How tall the frame is"),
)
_BUTTONS = (("crop", "To selection"), ("crop_to_paint", "To paint"), ("clear_outside", "Delete outside"))


def draw_frame_options(desk: Desk) -> None:
    """Fills the present window, one line high."""
    frame, em = desk.framing.shown(desk.known), imgui.get_font_size()
    values = [frame.x0, frame.y0, frame.width, frame.height]
    for i, (name, hint) in enumerate(_FIELDS):
        imgui.align_text_to_frame_padding()
        said.text_disabled(name.upper() if i > 1 else name)
        imgui.same_line(0, 0.3 * em)
        imgui.set_next_item_width(5.2 * em)
        shown = max(-_FARTHEST, min(_FARTHEST, values[i]))
        entered, value = imgui.input_int(f"##frame {name}", shown, 0, flags=imgui.InputTextFlags_.enter_returns_true)
        w.named(f"frame {name}")
        w.tooltip(f"{hint}.  Return sets it; no paint changes")
        if entered and value != shown:
            values[i] = value
            _set(desk, values)
        imgui.same_line(0, 0.6 * em)
    for action, label in _BUTTONS:
        row = actions.ACTIONS[action]
        if w.text_button(label, row.hint, enabled=row.when(desk)):
            actions.perform(desk, row)
        imgui.same_line()


def _set(desk: Desk, values: list[int]) -> None:
    x, y, width, height = values
    if 1 <= width <= LONGEST_SIDE and 1 <= height <= LONGEST_SIDE:
        desk.post(Do(c.SetFrame(Rect.at(x, y, width, height))))
    else:
        desk.say("A frame is at least one pixel wide and tall", bad=True)
