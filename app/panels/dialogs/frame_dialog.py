"""The dialog for another frame: where it lies and how large it is, in pixels of level 0."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio.requests import Do

_LARGEST = 1 << 20  # pixels along a side
_FARTHEST = 1 << 30  # that a field of imgui holds
_FIELDS = (
    ("Left", "Where the frame begins; to the left of 0 is less than 0"),
    ("Top", "Where the frame begins; above 0 is less than 0"),
    ("Width", "How wide the frame is"),
    ("Height", "How tall the frame is"),
)


class FrameDialog:
    """Asks for the frame.  Nothing that was painted changes, in it or outside."""

    title = "Frame"

    def __init__(self, frame: Rect) -> None:
        self._values = [frame.x0, frame.y0, frame.width, frame.height]

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em = imgui.get_font_size()
        for i, (name, hint) in enumerate(_FIELDS):
            if i % 2:
                imgui.same_line(11 * em + imgui.get_cursor_start_pos().x)
            imgui.align_text_to_frame_padding()
            said.text_unformatted(name)
            imgui.same_line((11 * em if i % 2 else 0) + 3.6 * em + imgui.get_cursor_start_pos().x)
            imgui.set_next_item_width(6.4 * em)
            near = max(-_FARTHEST, min(_FARTHEST, self._values[i]))
            changed, value = imgui.input_int(f"##{name}", near, 0)
            self._values[i] = value if changed else self._values[i]
            w.named(name)
            w.tooltip(hint)
        said.text_disabled("Paint outside stays; nothing is lost.")
        imgui.spacing()
        x, y, width, height = self._values
        good = 1 <= width <= _LARGEST and 1 <= height <= _LARGEST
        if w.default_button("Set frame", "Give the painting this frame", enabled=good, width=em * 7):
            if Rect.at(x, y, width, height) != desk.known.frame:
                desk.post(Do(c.SetFrame(Rect.at(x, y, width, height))))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Keep the frame", width=em * 7)
