"""The region of an example: the picture, large, with what is not grown dimmed; strokes paint it in and out.

Strokes come from `tools.paint_region`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import ACTIONS, Action
from app.desk import example_work
from app.desk.desk import Desk
from app.desk.region_mask import RADII, Mask, shown, smoothed
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col

GROW = 1.15  # of the brush, by a key
SIDE = 232.0  # width of the tools, points
_WAYS = (
    ("in", "Paint in", "A stroke adds to the region"),
    ("out", "Paint out", "A stroke takes away from the region"),
    ("colour", "Colour", "A click takes everything of that colour out of the region: the background"),
)
_WHOLE: tuple[tuple[str, str, Callable[[Mask], np.ndarray]], ...] = (
    (
        "By transparency",
        "The region is where the picture is not transparent",
        lambda mask: mask.pixels[..., 3] > 0,
    ),
    ("Everything", "The whole picture is the region: it has no rim", lambda mask: np.ones_like(mask.inside)),
    ("Invert", "Inside becomes outside", lambda mask: ~mask.inside),
    ("Smooth", "Rounds the edge, and takes specks and pinholes away", lambda mask: smoothed(mask.inside)),
)


class RegionPanel:
    """Draws the strip's inside."""

    def draw(self, desk: Desk) -> None:
        state, mask = desk.examples, desk.examples.mask
        if mask is None:
            return
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        imgui.begin_child("region picture", ImVec2(room.x - SIDE * desk.scale - gap, 0))
        self._picture(desk, mask)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("region tools", ImVec2(0, 0))
        imgui.begin_child("ways", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        entry = state.entry
        imgui.text_disabled(f"What is grown of “{entry.title}”" if entry is not None else "")
        self._tools(desk, mask)
        imgui.end_child()
        own = entry is not None and entry.own
        imgui.push_style_color(Col.button, theme.vec(theme.ACCENT_SOFT if mask.modified or not own else theme.RAISED))
        text, hint = ("Save", "Keep this region") if own else ("Save as my own", "It goes to a copy of your own")
        if w.text_button(f"{icons.DISK} {text}###save", hint, enabled=mask.modified, width=-1):
            example_work.save_region(desk)
        imgui.pop_style_color()
        imgui.end_child()

    def show(self, desk: Desk) -> None:
        """Draws into the picture what has changed."""
        mask = desk.examples.mask
        if mask is not None and mask.dirty is not None:
            height, width = mask.inside.shape
            desk.touch(f"region {desk.examples.chosen}", (width, height), mask.dirty, shown(mask, mask.dirty))
            mask.dirty = None

    def takes(self, desk: Desk, action: Action) -> bool:
        """Steps through what was painted, or makes the brush larger or smaller; False for other actions."""
        steps = {ACTIONS["undo"]: -1, ACTIONS["redo"]: 1}
        sizes = {ACTIONS["smaller"]: 1 / GROW, ACTIONS["larger"]: GROW}
        mask = desk.examples.mask
        if mask is None or action not in {**steps, **sizes}:
            return False
        if action in steps:
            mask.step(steps[action])
        else:
            mask.resize(sizes[action])
        return True

    def _picture(self, desk: Desk, mask: Mask) -> None:
        """As large as there is room for; its place is remembered for the strokes."""
        state, room = desk.examples, imgui.get_content_region_avail()
        height, width = mask.inside.shape
        scale = min(room.x / width, room.y / height)
        corner = imgui.get_cursor_screen_pos()
        at = ImVec2(round(corner.x + (room.x - width * scale) / 2), round(corner.y + (room.y - height * scale) / 2))
        end = ImVec2(at.x + width * scale, at.y + height * scale)
        painter = imgui.get_window_draw_list()
        painter.add_rect_filled(corner, ImVec2(corner.x + room.x, corner.y + room.y), theme.packed(theme.FIELD), 4)
        w.placed("region", at, end)
        picture = desk.pictures.get(f"region {state.chosen}")
        if picture is not None:
            painter.add_image(picture, at, end)
        free = not imgui.is_popup_open("", imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level)
        state.spot = (at.x, at.y, scale) if free else None
        if state.over(desk.pointer.x, desk.pointer.y) and mask.way != "colour":
            painter.push_clip_rect(at, end, True)
            middle, radius = ImVec2(desk.pointer.x, desk.pointer.y), max(1.5, mask.radius * scale)
            painter.add_circle(middle, radius + 0.5, theme.packed((0.0, 0.0, 0.0), 0.6), 0, 1.6 * desk.scale)
            painter.add_circle(middle, radius - 0.5, theme.packed((1.0, 1.0, 1.0), 0.9), 0, desk.scale)
            painter.pop_clip_rect()

    def _tools(self, desk: Desk, mask: Mask) -> None:
        gap = 2 * desk.scale
        mask.way = w.segments("way", mask.way, _WAYS) or mask.way
        if mask.way == "colour":
            hint = "How far from the clicked colour still counts as that colour"
            _, tolerance = w.slider("Tolerance", mask.tolerance * 100, (0.0, 60.0), hint, form="%.0f%%")
            hint = "Only what hangs together with the place that is clicked"
            _, joined = w.tick("Connected only", mask.joined, hint)
            mask.tolerate(round(tolerance / 100, 3), joined)
        else:
            hint = "Radius of the brush, in pixels of the picture  ([ and ])"
            changed, radius = w.slider("Size", mask.radius, (1.0, 128.0), hint, form="%.1f px", curved=True)
            if changed:
                mask.radius = round(max(RADII[0], min(RADII[1], radius)), 1)
        if mask.way == "colour":
            imgui.text_disabled("Click on the background")
        imgui.spacing()
        room = (imgui.get_content_region_avail().x - gap) / 2
        for i, (label, hint, make) in enumerate(_WHOLE):
            if i % 2:
                imgui.same_line(0, gap)
            if w.text_button(label, hint, enabled=i > 0 or not mask.opaque, width=room):
                mask.put(make(mask))
        self._steps(mask)

    def _steps(self, mask: Mask) -> None:
        """Undo and redo of the region's own, and how much of the picture it is."""
        gap, past = 2 * imgui.get_style().font_scale_dpi, mask.history
        side = imgui.get_frame_height()
        if w.icon_button("undo", icons.UNDO, "Take back  (Ctrl+Z over the picture)", enabled=past.can_undo, size=side):
            mask.step(-1)
        imgui.same_line(0, gap)
        hint = "Do again  (Ctrl+Shift+Z over the picture)"
        if w.icon_button("redo", icons.REDO, hint, enabled=past.can_redo, size=side):
            mask.step(1)
        imgui.same_line(0, 3 * gap)
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(f"{mask.inside.mean() * 100:.0f}% is grown")
