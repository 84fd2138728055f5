"""Texts that have less room than they take."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app.language import said

_DOTS = "…"
_SMALLEST = 0.85  # of the font, that a text on a button is drawn with


def ended(text: str, width: float) -> str:
    """Returns as much of a text's beginning as fits into a width, pixels; what is left out shows as dots."""
    if imgui.calc_text_size(text).x <= width:
        return text
    low, high = 0, len(text)  # characters that fit, and that do not
    while high - low > 1:
        half = (low + high) // 2
        fits = imgui.calc_text_size(text[:half].rstrip() + _DOTS).x <= width
        low, high = (half, high) if fits else (low, half)
    return text[:low].rstrip() + _DOTS


def shortened(text: str, width: float) -> str:
    """Returns a text with as much left out in its middle as it is too wide."""
    if imgui.calc_text_size(text).x <= width:
        return text
    for kept in range(len(text) - 1, 1, -1):
        shorter = f"{text[: kept // 2]}{_DOTS}{text[-(kept - kept // 2) :]}"
        if imgui.calc_text_size(shorter).x <= width:
            return shorter
    return _DOTS


def fitting_button(label: str, width: float) -> bool:
    """Draws a button that is so wide; tells whether it was pressed.  0: as wide as its text, below: up to the end.  A
    text that is a little too wide, as in some languages, is smaller; for one still wider the button is wider, too."""
    wanted, pad = text_width(label), 2 * imgui.get_style().frame_padding.x
    if width <= 0 or wanted + pad <= width:
        return said.button(label, ImVec2(width, 0))
    part, tall, style = max(_SMALLEST, (width - pad) / wanted), imgui.get_frame_height(), imgui.get_style()
    imgui.push_font(None, part * imgui.get_font_size() / (style.font_scale_main * style.font_scale_dpi))
    pressed = said.button(label, ImVec2(max(width, wanted * part + pad), tall))
    imgui.pop_font()
    return pressed


def shares(labels: Sequence[str], room: float) -> list[float]:
    """Returns how wide buttons side by side are: all alike, but where a text needs more than that."""
    pad = 2 * imgui.get_style().frame_padding.x
    wanted, alike = [text_width(label) + pad for label in labels], room / len(labels)
    if max(wanted) <= alike:
        return [alike] * len(labels)
    return [room * one / sum(wanted) for one in wanted]


def text_width(label: str) -> float:
    """Returns how wide a label is in the language that is spoken, pixels."""
    return said.calc_text_size(label.partition("##")[0]).x


def home_text(path: Path) -> str:
    """Returns a path as people write it."""
    home = Path.home()
    return f"~/{path.relative_to(home)}" if path.is_relative_to(home) else str(path)
