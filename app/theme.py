"""The look of the window: neutral greys, so that colours are judged well, one font, one accent."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import imgui_bundle
from imgui_bundle import ImVec2, ImVec4, imgui

FONT_SIZE = 15.0
FONTS = Path(imgui_bundle.__file__).parent / "assets" / "fonts"

# sRGB greys, light to dark, and the one accent.
TEXT, QUIET = (0.86, 0.86, 0.86), (0.56, 0.56, 0.56)
PANEL, FIELD, RAISED, HOVER, PRESSED = (0.165,) * 3, (0.115,) * 3, (0.235,) * 3, (0.30,) * 3, (0.37,) * 3
LINE, SHADE = (0.10,) * 3, (0.13,) * 3
ACCENT, ACCENT_SOFT = (0.45, 0.60, 0.78), (0.27, 0.34, 0.42)
WARN = (0.93, 0.62, 0.36)

_COLOURS: dict[str, tuple[tuple[float, ...], float]] = {
    "text": (TEXT, 1),
    "text_disabled": (QUIET, 1),
    "window_bg": (PANEL, 1),
    "child_bg": (PANEL, 0),
    "popup_bg": ((0.145,) * 3, 1),
    "border": ((0.27,) * 3, 1),
    "frame_bg": (FIELD, 1),
    "frame_bg_hovered": ((0.145,) * 3, 1),
    "frame_bg_active": ((0.145,) * 3, 1),
    "title_bg": (SHADE, 1),
    "title_bg_active": (SHADE, 1),
    "menu_bar_bg": (SHADE, 1),
    "scrollbar_bg": (PANEL, 0),
    "scrollbar_grab": (RAISED, 1),
    "scrollbar_grab_hovered": (HOVER, 1),
    "scrollbar_grab_active": (PRESSED, 1),
    "check_mark": (TEXT, 1),
    "checkbox_selected_bg": (FIELD, 1),
    "slider_grab": ((0.52,) * 3, 1),
    "slider_grab_active": (TEXT, 1),
    "button": (RAISED, 1),
    "button_hovered": (HOVER, 1),
    "button_active": (PRESSED, 1),
    "header": (ACCENT_SOFT, 1),
    "header_hovered": (HOVER, 1),
    "header_active": (PRESSED, 1),
    "separator": (LINE, 1),
    "drag_drop_target": (ACCENT, 1),
    "text_selected_bg": (ACCENT_SOFT, 1),
    "nav_cursor": (ACCENT, 1),
    "modal_window_dim_bg": ((0.0, 0.0, 0.0), 0.35),
}


def vec(colour: tuple[float, ...], alpha: float = 1.0) -> ImVec4:
    """Gives a colour as imgui takes it."""
    r, g, b = colour
    return ImVec4(r, g, b, alpha)


def packed(colour: tuple[float, ...], alpha: float = 1.0) -> int:
    """Returns the 32-bit colour that draw lists take."""
    return imgui.color_convert_float4_to_u32(vec(colour, alpha))


def load_fonts(io: Any) -> None:
    """Loads text and icons as one font; glyphs are rasterised when first shown, at any size."""
    io.fonts.add_font_from_file_ttf(str(FONTS / "Roboto" / "Roboto-Regular.ttf"), FONT_SIZE)
    icons = imgui.ImFontConfig()
    icons.merge_mode = True
    icons.glyph_min_advance_x = FONT_SIZE
    icons.pixel_snap_h = True
    io.fonts.add_font_from_file_ttf(str(FONTS / "Font_Awesome_6_Free-Solid-900.otf"), FONT_SIZE * 0.87, icons)


def apply(scale: float, font_size: float = FONT_SIZE) -> None:
    """Colours and metrics for a screen of `scale` pixels per point; may be called again."""
    style, usual = imgui.get_style(), imgui.Style()
    for name in dir(usual):  # what is not said below would be scaled once more
        if not name.startswith(("_", "font")) and isinstance(getattr(usual, name), int | float | ImVec2):
            setattr(style, name, getattr(usual, name))
    for name, (colour, alpha) in _COLOURS.items():
        style.set_color_(getattr(imgui.Col_, name), vec(colour, alpha))
    style.window_padding = ImVec2(10, 8)
    style.frame_padding = ImVec2(8, 4)
    style.item_spacing = ImVec2(7, 6)
    style.item_inner_spacing = ImVec2(6, 4)
    style.indent_spacing = 14
    style.scrollbar_size = 10
    style.grab_min_size = 8
    style.window_rounding = 0
    style.child_rounding = 4
    style.frame_rounding = 4
    style.popup_rounding = 5
    style.grab_rounding = 3
    style.scrollbar_rounding = 5
    style.window_border_size = 0
    style.popup_border_size = 1
    style.hover_stationary_delay = 0.25
    style.scale_all_sizes(scale)
    style.font_scale_dpi, style.font_scale_main = scale, font_size / FONT_SIZE
