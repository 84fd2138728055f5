"""The radius of the brush with its lock, and how the hand is steadied."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.desk.hand import LARGEST, SMALLEST
from app.desk.holding.size_lock import set_lock
from app.panels.controls import widgets as w
from engine.brush.settings import SETTINGS
from engine.brush.smoothing import Smoother
from engine.brush.steadying import ON_ROPE, QUICK, STEADIED

_LOCKED = "As large on the canvas, however near you look; click to keep its size on the screen"
_FREE = "As large on the screen, however near you look; click to lock its size to the canvas"
_SHOWN = {"weighted": 0.8, ON_ROPE: 0.3, QUICK: 1.0}  # how strongly the pictures of the ways steady


def draw_radius(desk: Desk) -> None:
    """Draws the slider, in pixels of the screen, or of the level while it is locked, and the lock beside it."""
    row, locked = SETTINGS["radius"], desk.hand.sizes.lock is not None
    level, side, gap = desk.view.shown_level, imgui.get_frame_height(), 3 * desk.scale
    scale = desk.view.scale(level) if locked else 1.0
    form = f"%.1f px of level {level}".replace("-", "−") if locked else "%.1f px"
    imgui.begin_child("radius", ImVec2(imgui.get_content_region_avail().x - side - gap, side))
    hint = f"{row.tooltip}  ([ and ], or Alt+drag on the canvas)"
    ends = SMALLEST / scale, LARGEST / scale
    changed, value = w.slider(row.label, desk.hand.brush.radius / scale, ends, hint, form=form, curved=True)
    imgui.end_child()
    if changed:
        desk.hand.change(radius=round(max(SMALLEST, min(LARGEST, value * scale)), 4))
    imgui.same_line(0, gap)
    icon, hint = (icons.LOCK, _LOCKED) if locked else (icons.UNLOCK, _FREE)
    if w.icon_button("size lock", icon, hint, on=locked, size=side):
        set_lock(desk, not locked)


def draw_steadying(desk: Desk) -> None:
    """Draws how much the hand is steadied, and how, each way with a picture of what it makes of a shaky line."""
    hint = "How much the stroke is steadied"
    changed, value = w.slider("Stabiliser", desk.hand.stabiliser * 100, (0.0, 100.0), hint, form="%.0f%%")
    if changed:
        desk.hand.stabiliser = round(value / 100, 3)
    gap = 3 * desk.scale
    wide = (imgui.get_content_region_avail().x - gap * (len(STEADIED) - 1)) / len(STEADIED)
    for i, (name, way) in enumerate(STEADIED.items()):
        if i:
            imgui.same_line(0, gap)
        if _way(desk, name, wide):
            desk.hand.steadying = name
        w.tooltip(f"{way.label}: {way.tooltip}")


def _way(desk: Desk, name: str, wide: float) -> bool:
    """Draws a way as a button; tells whether it was pressed."""
    corner, tall, chosen = imgui.get_cursor_screen_pos(), 2.0 * imgui.get_font_size(), desk.hand.steadying == name
    pressed = imgui.invisible_button(f"steady {name}", ImVec2(wide, tall), imgui.ButtonFlags_.enable_nav)
    w.named(STEADIED[name].label)
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + tall)
    ground = theme.look.accent_soft if chosen else theme.look.hover if imgui.is_item_hovered() else theme.look.raised
    painter.add_rect_filled(corner, end, theme.packed(ground), imgui.get_style().frame_rounding)
    shaky, steadied = _drawn(name)
    inset, ends = 5 * desk.scale, list[ImVec2]()
    for line, tone, alpha, width in ((shaky, theme.look.soft, 0.5, 1.0), (steadied, theme.look.text, 0.95, 1.8)):
        points = [
            ImVec2(corner.x + inset + x * (wide - 2 * inset), corner.y + inset + y * (tall - 2 * inset))
            for x, y in line
        ]
        painter.add_polyline([*points], theme.packed(tone, alpha), width * desk.scale, 0)
        ends.append(points[-1])
    if name == ON_ROPE:
        painter.add_line(ends[1], ends[0], theme.packed(theme.look.accent), 1.5 * desk.scale)
        painter.add_circle_filled(ends[0], 2.5 * desk.scale, theme.packed(theme.look.accent), 16)
    return pressed


@lru_cache(maxsize=8)
def _drawn(name: str) -> tuple[tuple[tuple[float, float], ...], ...]:
    """Returns a shaky line, and what a way makes of it, both in a square of 1."""
    n = 90
    t = np.arange(n) / (n - 1)
    rows = np.zeros((n, 6))
    rows[:, 0] = 190 * t
    rows[:, 1] = 24 - 22 * np.sin(math.pi * t * 1.5) + 4.0 * np.sin(t * 83) + 2.0 * np.sin(t * 47)
    rows[:, 5] = 1.6 * t
    smoother = Smoother(_SHOWN[name], way=name, unit=4.0 if name == QUICK else 1.0)  # a slow line is seen from near
    made = np.concatenate([smoother.add(rows), smoother.finish()])
    return tuple(tuple((x / 190, y / 54) for x, y in line[:, :2].tolist()) for line in (rows, made))
