"""The region of an example: the picture, large, with what is not grown dimmed; strokes paint it in and out.

Strokes come from `tools.paint_region`.
"""

from __future__ import annotations

from typing import Any

from imgui_bundle import ImVec2, imgui
from immutables import Map

from app import icons, theme
from app.actions.action import Action
from app.actions.actions import ACTIONS
from app.desk.desk import Desk
from app.desk.examples import cutting_work, example_work
from app.desk.examples.region_state import BY_ALPHA, EVERYTHING, INVERTED, RADII, SMOOTHED, RegionState
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col
from app.panels.examples.region_picture import draw_picture

GROW = 1.15  # of the brush, by a key
_SIDE = 232.0  # width of the tools, points
_WAYS = (
    ("in", "Paint in", "A stroke adds to the region"),
    ("out", "Paint out", "A stroke takes away from the region"),
    ("colour", "Colour", "A click takes everything of that colour out of the region: the background"),
)
_WHOLE: tuple[tuple[str, str, Map[str, Any]], ...] = (
    ("By transparency", "The region is where the picture is not transparent", BY_ALPHA),
    ("Everything", "The whole picture is the region: it has no rim", EVERYTHING),
    ("Invert", "Inside becomes outside", INVERTED),
    ("Smooth", "Rounds the edge, and takes specks and pinholes away", SMOOTHED),
)


class RegionPanel:
    """Draws the strip's inside."""

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        state, region = desk.examples, desk.examples.region
        if region is None:
            return
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        imgui.begin_child("region picture", ImVec2(room.x - _SIDE * desk.scale - gap, 0))
        radius = None if region.way == "colour" else region.radius
        draw_picture(desk, (f"region {state.chosen}",), region.scene.size, radius)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("region tools", ImVec2(0, 0))
        imgui.begin_child("ways", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        entry = state.entry
        said.text_disabled(f"What is grown of “{entry.title}”" if entry is not None else "")
        self._tools(desk, region)
        imgui.end_child()
        own = entry is not None and entry.own
        lit = region.scene.modified or not own
        imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft if lit else theme.look.raised))
        text, hint = ("Save", "Keep this region") if own else ("Save as my own", "It goes to a copy of your own")
        if w.text_button(f"{icons.DISK} {text}###save", hint, enabled=region.scene.modified, width=-1):
            example_work.save_region(desk)
        imgui.pop_style_color()
        imgui.end_child()

    def takes(self, desk: Desk, action: Action) -> bool:
        """Steps through what was painted, or makes the brush larger or smaller; False for other actions."""
        steps = {ACTIONS["undo"]: -1, ACTIONS["redo"]: 1}
        sizes = {ACTIONS["smaller"]: 1 / GROW, ACTIONS["larger"]: GROW}
        region = desk.examples.region
        if region is None or action not in {**steps, **sizes}:
            return False
        if action in steps:
            region.travel(desk.post, steps[action])
        else:
            region.resize(sizes[action])
        return True

    def _tools(self, desk: Desk, region: RegionState) -> None:
        gap = 2 * desk.scale
        region.way = w.segments("way", region.way, _WAYS) or region.way
        if region.way == "colour":
            hint = "How far from the clicked colour still counts as that colour"
            _, tolerance = w.slider("Tolerance", region.tolerance * 100, (0.0, 60.0), hint, form="%.0f%%")
            hint = "Only what hangs together with the place that is clicked"
            _, joined = w.tick("Connected only", region.joined, hint)
            region.tolerate(desk.post, round(tolerance / 100, 3), joined)
        else:
            hint = "Radius of the brush, in pixels of the picture  ([ and ])"
            changed, radius = w.slider("Size", region.radius, (1.0, 128.0), hint, form="%.1f px", curved=True)
            if changed:
                region.radius = round(max(RADII[0], min(RADII[1], radius)), 1)
        if region.way == "colour":
            said.text_disabled("Click on the background")
        imgui.spacing()
        room = (imgui.get_content_region_avail().x - gap) / 2
        for i, (label, hint, step) in enumerate(_WHOLE):
            if i % 2:
                imgui.same_line(0, gap)
            if w.text_button(label, hint, enabled=i > 0 or not region.scene.opaque, width=room):
                region.do(desk.post, step)
        hint = "Finds what lies on the picture's ground, to be cut out"
        if w.text_button(f"{icons.WAND} Find it###find", hint, width=-1):
            cutting_work.find(desk)
        self._steps(desk, region)

    def _steps(self, desk: Desk, region: RegionState) -> None:
        """Undo and redo of the region's own, and how much of the picture it is."""
        gap, past = 2 * imgui.get_style().font_scale_dpi, region.scene
        side = imgui.get_frame_height()
        if w.icon_button("undo", icons.UNDO, "Take back  (Ctrl+Z over the picture)", enabled=past.can_undo, size=side):
            region.travel(desk.post, -1)
        imgui.same_line(0, gap)
        hint = "Do again  (Ctrl+Shift+Z over the picture)"
        if w.icon_button("redo", icons.REDO, hint, enabled=past.can_redo, size=side):
            region.travel(desk.post, 1)
        imgui.same_line(0, 3 * gap)
        imgui.align_text_to_frame_padding()
        said.text_disabled(f"{region.scene.share * 100:.0f}% is grown")
