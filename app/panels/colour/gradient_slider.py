"""A slider whose bar shows what it leads to."""

from __future__ import annotations

from collections.abc import Sequence

from imgui_bundle import ImVec2, imgui

from app import theme
from app.panels.controls import widgets as w

_STEP = 0.01  # that a key moves it by


def gradient_slider(
    label: str, value: float, stops: Sequence[tuple[float, float, float]], hint: str
) -> tuple[bool, float]:
    """Returns a bar of colours with a marker; value 0..1.  (changed, value)"""
    width, height = imgui.get_content_region_avail().x, imgui.get_frame_height() * 0.66
    corner = imgui.get_cursor_screen_pos()
    imgui.invisible_button(label, ImVec2(width, height), imgui.ButtonFlags_.enable_nav)
    changed = imgui.is_item_active()
    if changed:
        value = max(0.0, min(1.0, (imgui.get_io().mouse_pos.x - corner.x) / width))
    for key, by in ((imgui.Key.left_arrow, -_STEP), (imgui.Key.right_arrow, _STEP)):
        if imgui.is_item_focused() and imgui.is_key_pressed(key):
            changed, value = True, max(0.0, min(1.0, value + by))
    w.named(label)
    w.tooltip(hint)
    painter, n = imgui.get_window_draw_list(), len(stops) - 1
    for i in range(n):
        a, b = theme.packed(stops[i]), theme.packed(stops[i + 1])
        left, right = corner.x + width * i / n, corner.x + width * (i + 1) / n
        painter.add_rect_filled_multi_color(ImVec2(left, corner.y), ImVec2(right, corner.y + height), a, b, b, a)
    x = corner.x + 3 + (width - 6) * value
    for grow, grey in ((3.0, 0.0), (1.5, 1.0)):
        painter.add_rect(
            ImVec2(x - grow - 1, corner.y - grow + 1),
            ImVec2(x + grow + 1, corner.y + height + grow - 1),
            theme.packed((grey,) * 3, 0.9),
            2.0,
            thickness=1.5,
        )
    return changed, value
