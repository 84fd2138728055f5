"""Whether a field looks as if it took what is typed: digits are not for the picture then."""

from __future__ import annotations

from imgui_bundle import imgui

_LONG_AGO = -9
_seen = _LONG_AGO  # the frame in which a slider was lit last


def note_slider() -> None:
    """Notes the slider just drawn: while the pointer is over it, it is lit."""
    global _seen
    if imgui.is_item_hovered() or imgui.is_item_active():
        _seen = imgui.get_frame_count()


def field_in_sight() -> bool:
    """Tells whether one does in this frame, or did in the last one: over a field for text the pointer is a bar."""
    bar = imgui.get_mouse_cursor() == imgui.MouseCursor_.text_input
    return bar or 0 <= imgui.get_frame_count() - _seen <= 1
