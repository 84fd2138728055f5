"""The controls that all panels share: filled sliders, icon buttons, section headers.  Every one takes its tooltip."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from imgui_bundle import ImVec2, imgui

from app import icons, theme, trace
from app.language import said
from app.language.words import meant, say
from app.panels.controls.fields_in_sight import note_slider
from app.panels.controls.fitting import ended, fitting_button, shares
from app.panels.controls.folds import folding_header

Col = imgui.Col_
_RETURN = imgui.Key.enter, imgui.Key.keypad_enter
_LISTED = 1  # in a window's storage: in which frame a list that drops down was open last


def tooltip(text: str, *, beside: bool = False) -> None:
    """Draws the hint of the item just drawn, after a short rest of the pointer.  `beside`: to the left of its window,
    so that it covers none of what is in it.  Its size is that of this text: by itself it takes one a frame later."""
    if text and imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip | imgui.HoveredFlags_.allow_when_disabled):
        if beside:
            edge = imgui.internal.get_current_window_read().root_window.pos.x - 4 * imgui.get_style().font_scale_dpi
            imgui.set_next_window_pos(ImVec2(edge, imgui.get_item_rect_min().y), imgui.Cond_.always, ImVec2(1, 0))
        show_tooltip(text)


def show_tooltip(text: str) -> None:
    """Draws a hint at the pointer."""
    text = say(text)
    padding, wide = ImVec2(8, 5) * imgui.get_style().font_scale_dpi, imgui.get_font_size() * 22
    imgui.set_next_window_size(imgui.calc_text_size(text, False, wide) + padding * 2 + ImVec2(1, 1))
    imgui.push_style_var(imgui.StyleVar_.window_padding, padding)
    if imgui.begin_tooltip():
        imgui.text_wrapped(text)
        named("tooltip")
        imgui.end_tooltip()
    imgui.pop_style_var()


def named(label: str) -> None:
    """Tells tests where the item just drawn lies."""
    if trace.TRACED and imgui.is_item_visible():
        placed(label, imgui.get_item_rect_min(), imgui.get_item_rect_max())


def placed(label: str, corner: ImVec2, end: ImVec2) -> None:
    """Tells tests what of the present window lies there, as far as it is in sight: by the text that it shows, without
    signs, or by what stands after ## where it shows none."""
    if not trace.TRACED or not label:
        return
    text, _, hidden = label.partition("##")
    text = "".join(letter for letter in text if not "\ue000" <= letter <= "\uf8ff").strip(" +")
    window = meant(imgui.internal.get_current_window_read().root_window.name.partition("##")[0])
    least, most = imgui.get_window_draw_list().get_clip_rect_min(), imgui.get_window_draw_list().get_clip_rect_max()
    left, top = round(max(corner.x, least.x)), round(max(corner.y, least.y))
    right, bottom = round(min(end.x, most.x)), round(min(end.y, most.y))
    trace.note_place(window, text or hidden.lstrip("#"), (left, top, right, bottom))


def icon_button(
    name: str, icon: str, hint: str, *, on: bool = False, enabled: bool = True, size: float | None = None
) -> bool:
    """Returns a square button with a sign; lit while `on`."""
    side = size or imgui.get_frame_height()
    imgui.begin_disabled(not enabled)
    imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(0, 0))
    imgui.push_style_color(
        Col.button, theme.vec(theme.look.accent_soft if on else theme.look.raised, 1.0 if on else 0.0)
    )
    imgui.push_style_color(Col.text, theme.vec(theme.look.text if on or enabled else theme.look.quiet))
    pressed = imgui.button(f"{icon}##{name}", ImVec2(side, side))
    named(name)
    imgui.pop_style_color(2)
    imgui.pop_style_var()
    imgui.end_disabled()
    tooltip(hint)
    return pressed


def text_button(label: str, hint: str, *, enabled: bool = True, width: float = 0.0) -> bool:
    """Draws a button with a text and a tooltip; tells whether it was pressed."""
    imgui.begin_disabled(not enabled)
    pressed = fitting_button(label, width)
    imgui.end_disabled()
    named(label)
    tooltip(hint)
    return pressed


def lines_button(lines: Sequence[str], hint: str, width: float) -> bool:
    """Draws a button with lines of text, each in its middle; tells whether it was pressed.  The first is its name."""
    line, padding = imgui.get_text_line_height(), imgui.get_style().frame_padding.y
    pressed = said.button(f"##{lines[0]}", ImVec2(width, len(lines) * line + 2 * padding))
    named(lines[0])
    tooltip(hint)
    corner, painter = imgui.get_item_rect_min(), imgui.get_window_draw_list()
    for i, text in enumerate(lines):
        left = corner.x + (width - said.calc_text_size(text).x) / 2
        said.add_text(painter, ImVec2(round(left), corner.y + padding + i * line), theme.packed(theme.look.text), text)
    return pressed


def accent_button(label: str, hint: str, *, enabled: bool = True, width: float = 0.0) -> bool:
    """Draws a button that stands out among others; tells whether it was pressed."""
    for name, alpha in ((Col.button, 1.0), (Col.button_hovered, 0.75), (Col.button_active, 0.5)):
        imgui.push_style_color(name, theme.vec(theme.look.accent_soft, alpha))
    pressed = text_button(label, hint, enabled=enabled, width=width)
    imgui.pop_style_color(3)
    return pressed


def default_button(label: str, hint: str, *, enabled: bool = True, width: float = 0.0) -> bool:
    """Returns the button of a dialog that the Return key presses, too; not one that was held down as the dialog came
    up, nor while a list is open, which it closes."""
    pressed = accent_button(label, hint, enabled=enabled, width=width)
    listed = imgui.get_state_storage().get_int(_LISTED, -1) == imgui.get_frame_count()
    return pressed or (enabled and not listed and any(imgui.is_key_pressed(key, repeat=False) for key in _RETURN))


def return_down() -> bool:
    """Tells whether a Return key is held down."""
    return any(imgui.is_key_down(key) for key in _RETURN)


def section(title: str, hint: str = "", *, opened: bool = True, shared: bool = False) -> bool:
    """Returns a panel's header; a click folds it.  `shared`: a button may lie on its right end."""
    imgui.dummy(ImVec2(0, 1))
    if shared:
        imgui.set_next_item_allow_overlap()
    flags = imgui.TreeNodeFlags_.span_avail_width | (imgui.TreeNodeFlags_.default_open if opened else 0)
    imgui.push_style_color(Col.header, theme.vec(theme.look.panel, 0.0))
    imgui.push_style_color(Col.header_hovered, theme.vec(theme.look.raised, 0.5))
    imgui.push_style_color(Col.header_active, theme.vec(theme.look.raised))
    imgui.push_style_color(Col.text, theme.vec(theme.look.soft))
    shown = folding_header(title, flags)
    imgui.pop_style_color(4)
    named(title)
    tooltip(hint)
    return shown


def switched_section(title: str, hint: str, on: bool, *, enabled: bool = True) -> tuple[bool, bool]:
    """Returns a header with a switch at its right end; turning it on unfolds it.  (whether it is unfolded, whether
    on)"""
    imgui.dummy(ImVec2(0, 1))
    height, right = imgui.get_frame_height(), imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
    wide, tall = height * 1.15, height * 0.56
    line = imgui.get_text_line_height()
    at = ImVec2(right - wide, imgui.get_cursor_screen_pos().y + (line - tall) / 2)
    mouse = imgui.get_io().mouse_pos
    over = at.x - 4 <= mouse.x < right and abs(mouse.y - at.y - tall / 2) <= line / 2 and imgui.is_window_hovered()
    pressed = over and enabled and imgui.is_mouse_clicked(imgui.MouseButton_.left)
    on = on != pressed
    imgui.push_style_color(Col.header_hovered, theme.vec(theme.look.raised, 0.5))
    imgui.push_style_color(Col.header_active, theme.vec(theme.look.raised))
    imgui.push_style_color(Col.text, theme.vec(theme.look.text if on else theme.look.soft))
    shown = folding_header(title, turned=on if pressed else None)
    imgui.pop_style_color(3)
    named(title)
    tooltip(hint)
    _switch(at, wide, tall, on, over)
    return shown, on


def _switch(at: ImVec2, wide: float, tall: float, on: bool, over: bool) -> None:
    """Draws a pill whose knob lies left (off) or right (on)."""
    painter, radius = imgui.get_window_draw_list(), tall / 2
    grey = theme.look.accent_soft if on else theme.look.hover if over else theme.look.raised
    painter.add_rect_filled(at, ImVec2(at.x + wide, at.y + tall), theme.packed(grey), radius)
    x = at.x + wide - radius if on else at.x + radius
    knob = theme.look.accent if on else theme.look.knob
    painter.add_circle_filled(ImVec2(x, at.y + radius), radius * 0.66, theme.packed(knob), 24)


def slider(
    label: str,
    value: float,
    bounds: tuple[float, float],
    hint: str,
    *,
    form: str = "%.2f",
    curved: bool = False,
    own: bool = False,
) -> tuple[bool, float]:
    """Returns a bar filled up to its value, name on the left, number on the right; Ctrl+click to type.  `own`: the name
    is the artist's, in no language of the window's.  (changed, value)"""
    width, height = imgui.get_content_region_avail().x, imgui.get_frame_height()
    corner, lo, hi = imgui.get_cursor_screen_pos(), *bounds
    end, painter = ImVec2(corner.x + width, corner.y + height), imgui.get_window_draw_list()
    _filled_part(corner, end, _part(value, lo, hi, curved))
    typing = imgui.internal.temp_input_is_active(imgui.get_id(f"##{label}"))
    _hidden_frame(True, typing)
    imgui.set_next_item_width(width)
    flags = imgui.SliderFlags_.logarithmic if curved and lo > 0 else 0
    changed, value = imgui.slider_float(
        f"##{label}", value, lo, hi, form if typing or imgui.get_io().key_ctrl else "", flags
    )
    _hidden_frame(False, typing)
    note_slider()
    named(label)
    if not typing:
        pad = imgui.get_style().frame_padding
        text = told_number(form, value)
        at = ImVec2(end.x - pad.x - said.calc_text_size(text).x, corner.y + pad.y)
        name = ended(label if own else say(label.split("##")[0]), at.x - corner.x - 1.5 * pad.x)
        painter.add_text(ImVec2(corner.x + pad.x, corner.y + pad.y), theme.packed(theme.look.soft), name)
        said.add_text(painter, at, theme.packed(theme.look.text), text)
    tooltip(hint)
    return changed, max(lo, min(hi, value)) if changed else value


def _filled_part(corner: ImVec2, end: ImVec2, part: float) -> None:
    """Draws a slider's bar, filled up to a part of it."""
    painter, rounding = imgui.get_window_draw_list(), imgui.get_style().frame_rounding
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
    if part > 0.004:
        fill = ImVec2(corner.x + max(rounding, (end.x - corner.x) * part), end.y)
        hovered = imgui.is_mouse_hovering_rect(corner, end) and imgui.is_window_hovered()
        shade = theme.look.filled_lit if hovered else theme.look.filled
        painter.add_rect_filled(corner, fill, theme.packed(shade), rounding)
        wide = 2.0 * imgui.get_style().font_scale_dpi
        painter.add_rect_filled(ImVec2(fill.x - wide, corner.y), fill, theme.packed(theme.look.grab), wide / 2)


def told_number(form: str, value: float) -> str:
    """Returns a value as it is shown; a form may be a word in its place, as "auto"."""
    told = say(form)
    return told % value if "%" in told else told


def _hidden_frame(on: bool, typing: bool) -> None:
    """Makes the slider's own looks made invisible, but for the text while it is a field to type in."""
    names = (Col.frame_bg, Col.frame_bg_hovered, Col.frame_bg_active, Col.slider_grab, Col.slider_grab_active)
    if not on:
        imgui.pop_style_color(len(names) + 1)
        return
    for name in names:
        imgui.push_style_color(name, theme.vec(theme.look.field, 0.0))
    imgui.push_style_color(Col.text, theme.vec(theme.look.text, 1.0 if typing else 0.0))


def _part(value: float, lo: float, hi: float, curved: bool) -> float:
    value = max(lo, min(hi, value))
    if hi <= lo:
        return 0.0
    if curved and lo > 0:
        return math.log(value / lo) / math.log(hi / lo)
    return (value - lo) / (hi - lo)


def stepper(label: str, value: int, bounds: tuple[int, int], hint: str) -> tuple[bool, int]:
    """Returns a whole number between two buttons that make it smaller or larger by one.  (changed, value)"""
    side, gap = imgui.get_frame_height(), 2 * imgui.get_style().font_scale_dpi
    wide = imgui.get_content_region_avail().x - 2 * (side + gap)
    before = value
    if icon_button(f"{label} less", icons.MINUS, hint, enabled=value > bounds[0], size=side):
        value -= 1
    imgui.same_line(0, gap)
    corner = imgui.get_cursor_screen_pos()
    imgui.dummy(ImVec2(wide, side))
    tooltip(hint)
    painter, pad = imgui.get_window_draw_list(), imgui.get_style().frame_padding
    end, text = ImVec2(corner.x + wide, corner.y + side), str(value).replace("-", "−")
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), imgui.get_style().frame_rounding)
    said.add_text(painter, ImVec2(corner.x + pad.x, corner.y + pad.y), theme.packed(theme.look.soft), label)
    at = ImVec2(end.x - pad.x - said.calc_text_size(text).x, corner.y + pad.y)
    said.add_text(painter, at, theme.packed(theme.look.text), text)
    imgui.same_line(0, gap)
    if icon_button(f"{label} more", icons.ADD, hint, enabled=value < bounds[1], size=side):
        value += 1
    return value != before, value


def choice(
    label: str,
    current: str,
    options: Sequence[tuple[str, str]],
    hint: str,
    width: float = 0.0,
    hints: Sequence[str] = (),
) -> str | None:
    """Returns a drop-down of (value, shown text), each perhaps with a hint of its own; the value chosen now, or
    None."""
    shown, picked = dict(options).get(current, current), None
    if width:
        imgui.set_next_item_width(width)
    opened = said.begin_combo(f"##{label}", shown, imgui.ComboFlags_.height_large)
    if not opened:
        named(label)
        tooltip(hint)
        return None
    for i, (value, text) in enumerate(options):
        if said.selectable(text, value == current)[0]:
            picked = value
        named(text)
        tooltip(hints[i] if i < len(hints) else "")
    if any(imgui.is_key_pressed(key, repeat=False) for key in _RETURN):
        imgui.close_current_popup()
    imgui.end_combo()
    imgui.get_state_storage().set_int(_LISTED, imgui.get_frame_count())
    return picked


def swatch(name: str, rgb: tuple[float, float, float], hint: str, size: tuple[float, float]) -> bool:
    """Returns a patch of colour that can be pressed."""
    flags = imgui.ColorEditFlags_.no_tooltip | imgui.ColorEditFlags_.no_drag_drop | imgui.ColorEditFlags_.no_alpha
    pressed = imgui.color_button(f"##{name}", theme.vec(rgb), flags, ImVec2(*size))
    named(name)
    tooltip(hint)
    return pressed


def dot(label: str, on: bool) -> bool:
    """Draws one of several of which one is on; tells whether it was pressed."""
    imgui.push_style_var(imgui.StyleVar_.frame_border_size, imgui.get_style().font_scale_dpi)
    imgui.push_style_color(Col.border, theme.vec(theme.look.edge))
    pressed = said.radio_button(label, on)
    imgui.pop_style_color()
    imgui.pop_style_var()
    return pressed


def tick(label: str, on: bool, hint: str) -> tuple[bool, bool]:
    """Returns a box to tick.  (changed, on)"""
    imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(3, 3))
    imgui.push_style_var(imgui.StyleVar_.frame_border_size, imgui.get_style().font_scale_dpi)
    imgui.push_style_color(Col.border, theme.vec(theme.look.edge))
    changed, on = said.checkbox(label, on)
    imgui.pop_style_color()
    imgui.pop_style_var(2)
    named(label)
    tooltip(hint)
    return changed, on


def picture(shown: Any, size: tuple[float, float], hint: str, tile: float = 0.0, name: str = "") -> ImVec2:
    """Returns a picture in a frame of its own, or a dark field while there is none; its corner on the screen.
    `tile`: the width and height of each of its repeats; 0: it fills the frame.  `name`: what tests call it."""
    corner = imgui.get_cursor_screen_pos()
    imgui.dummy(ImVec2(*size))
    named(name)
    tooltip(hint)
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + size[0], corner.y + size[1])
    rounding = imgui.get_style().frame_rounding
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
    if shown is None:
        return corner
    white, zero, one = theme.packed((1.0, 1.0, 1.0)), ImVec2(0, 0), ImVec2(1, 1)
    if not tile:
        painter.add_image_rounded(shown, corner, end, zero, one, white, rounding)
        return corner
    painter.push_clip_rect(corner, end, True)
    for j in range(math.ceil(size[1] / tile)):
        for i in range(math.ceil(size[0] / tile)):
            at = ImVec2(corner.x + i * tile, corner.y + j * tile)
            painter.add_image(shown, at, ImVec2(at.x + tile, at.y + tile), zero, one, white)
    painter.pop_clip_rect()
    return corner


def lit_button(label: str, hint: str, on: bool, width: float = 0.0) -> bool:
    """Returns a button with a text, lit while `on`."""
    imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft if on else theme.look.raised))
    if on:
        imgui.push_style_color(Col.button_hovered, theme.vec(theme.look.accent_soft))
    pressed = text_button(label, hint, width=width)
    imgui.pop_style_color(1 + on)
    return pressed


def segments(name: str, current: str, options: Sequence[tuple[str, str, str]], width: float = 0.0) -> str | None:
    """Buttons side by side of which one is lit: (value, text, hint); the value chosen now, or None."""
    gap = 2 * imgui.get_style().font_scale_dpi
    width = (width or imgui.get_content_region_avail().x) - gap * (len(options) - 1)
    picked = None
    imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(1, imgui.get_style().frame_padding.y))
    widths = shares([text for _, text, _ in options], width)
    for i, (value, text, hint) in enumerate(options):
        if i:
            imgui.same_line(0, gap)
        if lit_button(f"{text}##{name} {value}", hint, value == current, widths[i]):
            picked = value
    imgui.pop_style_var()
    return picked
