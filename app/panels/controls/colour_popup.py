"""A picker of colours that pops up."""

from __future__ import annotations

from typing import Any

from imgui_bundle import imgui

from app.panels.controls import widgets as w


def colour_popup(name: str, rgb: tuple[float, float, float]) -> tuple[float, float, float] | None:
    """Returns a picker in a pop-up `name`; the colour while it changes, else None."""
    if not imgui.begin_popup(name):
        return None
    imgui.set_next_item_width(imgui.get_font_size() * 13)
    changed, value = imgui.color_picker3(f"##{name}", list(rgb), PICKER_FLAGS)
    w.named(name)
    imgui.end_popup()
    return (value[0], value[1], value[2]) if changed else None


PICKER_FLAGS: Any = (
    imgui.ColorEditFlags_.picker_hue_wheel
    | imgui.ColorEditFlags_.no_inputs
    | imgui.ColorEditFlags_.no_side_preview
    | imgui.ColorEditFlags_.no_small_preview
    | imgui.ColorEditFlags_.no_label
    | imgui.ColorEditFlags_.no_alpha
    | imgui.ColorEditFlags_.no_tooltip
)
