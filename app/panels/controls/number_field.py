"""Numbers to be read and typed: fields in a row, of which one may be in hand."""

from __future__ import annotations

import re
from fractions import Fraction

from imgui_bundle import imgui

from app.language import said
from app.panels.controls import widgets as w
from engine.canvas.placing.pose import FARTHEST

_FLAGS = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
_NUMBER = re.compile(r"[+-]?[0-9]{1,2500}([.][0-9]{0,30})?")


class NumberFields:
    """Remembers which number is being typed."""

    def __init__(self) -> None:
        self._typing, self._text = "", ""

    def draw(self, name: str, sign: str, value: str, width: float, hint: str) -> str | None:
        """Draws a field, `width` ems wide, behind its sign if that is told; returns what was typed when that is ended
        by Return."""
        if sign:
            imgui.align_text_to_frame_padding()
            said.text_disabled(sign)
            imgui.same_line(0, 0.3 * imgui.get_font_size())
        imgui.set_next_item_width(width * imgui.get_font_size())
        entered, text = imgui.input_text(f"##{name}", self._text if self._typing == name else value, _FLAGS)
        if imgui.is_item_active():
            self._typing, self._text = name, text
        elif self._typing == name:
            self._typing = ""
        w.named(f"##{name} field")
        w.tooltip(hint)
        return text if entered else None


def typed_number(text: str) -> Fraction | None:
    """Returns the number that was typed, to its last digit; None if it is none, or too large."""
    plain = text.strip().rstrip("%° ").replace("−", "-").replace(",", ".")
    value = Fraction(plain) if _NUMBER.fullmatch(plain) else None
    return value if value is not None and abs(value) < FARTHEST else None
