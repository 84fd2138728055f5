"""The light, over a corner of the canvas: a dome to drag the sun on, depth, gloss, and what stands high."""

from __future__ import annotations

import math
from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.lit.light_state import NO_LAYERS, height_layers, sun_at
from app.language import said
from app.panels.controls import widgets as w
from engine.light.light import BY_ALPHA, BY_IMPASTO, BY_PICTURE

_WIDE, _DOME = 16.0, 6.4  # ems
_SHADES, _DARK, _BRIGHT = 20, 0.16, 0.62  # of the dome: how many, and greys
_SUN = (1.0, 0.86, 0.5)
_DEEPEST = 60.0
_SOURCES = (
    (BY_PICTURE, "Lightness", "Light paint stands higher than dark paint"),
    (BY_IMPASTO, "Impasto", "Thick paint stands out, and what is heaped on the layer of heights"),
    (BY_ALPHA, "Paint", "Places stand higher the more paint lies there; for paintings without paper"),
)


def light_box(desk: Desk) -> tuple[float, float, float, float] | None:
    """Returns where it lies, left, top, width and height, framebuffer pixels; None while it is not to be seen."""
    if not desk.panels or not desk.light.on:
        return None
    em, frame, gap = imgui.get_font_size(), imgui.get_frame_height(), imgui.get_style().item_spacing.y
    rows = 4 if desk.light.light.height in NO_LAYERS else 5
    wide, high = _WIDE * em, _DOME * em + rows * (frame + gap) + 3 * gap
    _, _, right, bottom = desk.free_area()
    margin = 4 * desk.scale
    return right - wide - margin, bottom - high - margin, wide, high


def draw_light(desk: Desk) -> None:
    """Fills the present window."""
    state = desk.light
    imgui.align_text_to_frame_padding()
    said.text_unformatted("Light")
    imgui.same_line(imgui.get_window_width() - imgui.get_frame_height() - imgui.get_style().window_padding.x)
    if w.icon_button("close light", icons.CLOSE, actions.keyed("Back to the plain painting", "light")):
        state.on = False
    _dome(desk)
    changed, depth = w.slider(
        "Depth", state.light.depth, (-_DEEPEST, _DEEPEST), "How high it stands, in pixels of the screen", form="%.0f"
    )
    if changed:
        state.light = replace(state.light, depth=float(round(depth)))
    changed, gloss = w.slider("Gloss", state.light.gloss, (0.0, 1.0), "How wet the paint looks")
    if changed:
        state.light = replace(state.light, gloss=round(gloss, 2))
    _what_stands_high(desk)


def _what_stands_high(desk: Desk) -> None:
    """What stands high: of all that is seen, or of a layer that is chosen above, where it pushes no button away."""
    state, layers = desk.light, height_layers(desk.known.scene)
    now = state.light.height
    by_layer = now not in NO_LAYERS
    first = now if by_layer or not layers else layers[0]
    of_layer = (first, "Layer", "Light paint of one layer stands higher; it may be hidden, or the land's height")
    picked = None
    if by_layer:
        wide, options = imgui.get_content_region_avail().x, [(name, name) for name in layers]
        picked = w.choice("layer of light", now, options, "Whose light paint stands higher", wide)
    picked = w.segments("height of light", now, (*_SOURCES, of_layer) if layers else _SOURCES) or picked
    if picked is not None:
        state.light = replace(state.light, height=picked)


def _dome(desk: Desk) -> None:
    """The sky seen from above: the sun over its middle stands highest, at its rim lowest."""
    state, side = desk.light, _DOME * imgui.get_font_size()
    imgui.set_cursor_pos_x((imgui.get_window_width() - side) / 2)
    corner = imgui.get_cursor_screen_pos()
    imgui.invisible_button("sun", ImVec2(side, side))
    w.named("sun")
    held, radius = imgui.is_item_active(), 0.46 * side
    middle = ImVec2(corner.x + side / 2, corner.y + side / 2)
    if held:
        mouse = imgui.get_io().mouse_pos
        azimuth, altitude = sun_at((mouse.x - middle.x) / radius, (mouse.y - middle.y) / radius)
        state.light = replace(state.light, azimuth=azimuth, altitude=altitude)
    x, y, _ = state.light.sun
    painter = imgui.get_window_draw_list()
    for n in range(_SHADES):
        part = n / _SHADES
        grey = _DARK + (_BRIGHT - _DARK) * part**1.5
        at = ImVec2(middle.x + x * radius * part, middle.y + y * radius * part)
        painter.add_circle_filled(at, radius * (1 - part), theme.packed((grey,) * 3), 48)
    painter.add_circle(middle, radius, theme.packed(theme.look.edge), 48)
    _sun(painter, ImVec2(middle.x + x * radius, middle.y + y * radius), 0.05 * side * (1.2 if held else 1.0))
    if not held:
        w.tooltip(f"Drag the sun: {state.light.azimuth:.0f}° from the top, {state.light.altitude:.0f}° high")


def _sun(painter: imgui.ImDrawList, at: ImVec2, radius: float) -> None:
    painter.add_circle_filled(at, 1.25 * radius, theme.packed((0.1, 0.08, 0.04), 0.6), 24)
    painter.add_circle_filled(at, radius, theme.packed(_SUN), 24)
    for n in range(8):
        c, s = math.cos(n * math.pi / 4), math.sin(n * math.pi / 4)
        near, far = 1.5 * radius, 2.1 * radius
        ends = ImVec2(at.x + near * c, at.y + near * s), ImVec2(at.x + far * c, at.y + far * s)
        painter.add_line(*ends, theme.packed(_SUN), 1.5)
