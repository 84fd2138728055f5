"""The look of the window in force: its colours, one font, and the measures of everything."""

from __future__ import annotations

from pathlib import Path

import imgui_bundle
from imgui_bundle import ImVec2, ImVec4, imgui

from app.theme.looks import LOOKS, USUAL_LOOK, WindowLook

FONT_SIZE = 15.0
FONTS = Path(imgui_bundle.__file__).parent / "assets" / "fonts"

look: WindowLook = LOOKS[USUAL_LOOK]  # the one in force
letters: imgui.ImFont | None = None  # the font whose letters are all as wide

GROUNDS = {
    "text": "text",
    "text_disabled": "quiet",
    "window_bg": "panel",
    "popup_bg": "popup",
    "border": "border",
    "frame_bg": "field",
    "frame_bg_hovered": "card",
    "frame_bg_active": "card",
    "title_bg": "shade",
    "title_bg_active": "shade",
    "menu_bar_bg": "shade",
    "scrollbar_grab": "pressed",
    "scrollbar_grab_hovered": "knob",
    "scrollbar_grab_active": "knob",
    "check_mark": "text",
    "plot_histogram": "accent_soft",
    "checkbox_selected_bg": "field",
    "slider_grab": "grab",
    "slider_grab_active": "text",
    "button": "raised",
    "button_hovered": "hover",
    "button_active": "pressed",
    "header": "accent_soft",
    "header_hovered": "hover",
    "header_active": "pressed",
    "separator": "line",
    "drag_drop_target": "accent",
    "text_selected_bg": "accent_soft",
    "input_text_cursor": "text",
    "tree_lines": "line",
    "nav_cursor": "accent",
    "resize_grip": "border",
    "resize_grip_hovered": "accent",
    "resize_grip_active": "accent",
}  # what each of imgui's colours is of a look


def vec(colour: tuple[float, ...], alpha: float = 1.0) -> ImVec4:
    """Gives a colour as imgui takes it."""
    r, g, b = colour
    return ImVec4(r, g, b, alpha)


def packed(colour: tuple[float, ...], alpha: float = 1.0) -> int:
    """Returns the 32-bit colour that draw lists take."""
    return imgui.color_convert_float4_to_u32(vec(colour, alpha))


def load_fonts(io: imgui.IO) -> None:
    """Loads text and icons as one font, and one for what is written line by line, whose letters are all as wide; glyphs
    are rasterised when first shown, at any size."""
    global letters
    letters = io.fonts.add_font_from_file_ttf(str(FONTS / "Inconsolata-Medium.ttf"), FONT_SIZE)
    io.font_default = io.fonts.add_font_from_file_ttf(str(FONTS / "Roboto" / "Roboto-Regular.ttf"), FONT_SIZE)
    icons = imgui.ImFontConfig()
    icons.merge_mode = True
    icons.glyph_min_advance_x = FONT_SIZE
    icons.pixel_snap_h = True
    io.fonts.add_font_from_file_ttf(str(FONTS / "Font_Awesome_6_Free-Solid-900.otf"), FONT_SIZE * 0.87, icons)


def apply(scale: float, font_size: float = FONT_SIZE, name: str = USUAL_LOOK) -> None:
    """Colours and metrics for a screen of `scale` pixels per point; `name`: of the look; may be called again."""
    global look
    look = LOOKS[name]
    style, usual = imgui.get_style(), imgui.Style()
    for name in dir(usual):  # what is not said below would be scaled once more
        if not name.startswith(("_", "font")) and isinstance(getattr(usual, name), int | float | ImVec2):
            setattr(style, name, getattr(usual, name))
    for theirs, ours in GROUNDS.items():
        style.set_color_(getattr(imgui.Col_, theirs), vec(getattr(look, ours)))
    style.set_color_(imgui.Col_.child_bg, vec(look.panel, 0.0))
    style.set_color_(imgui.Col_.scrollbar_bg, vec(look.panel, 0.0))
    style.set_color_(imgui.Col_.modal_window_dim_bg, vec((0.0, 0.0, 0.0), 0.35))
    style.disabled_alpha = look.dimmed
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
    style.window_border_size, style.frame_border_size = 0, look.frames
    style.popup_border_size = 1
    style.hover_stationary_delay = 0.25
    style.scale_all_sizes(scale)
    style.font_scale_dpi, style.font_scale_main = scale, font_size / FONT_SIZE
