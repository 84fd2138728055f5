"""The matching panel: an example, the texture that is made like it, what may be changed on the way, and its use.

Heeger & Bergen 1995; section 6 asks for a slider for each parameter of the representation, and for the artist to see
what it does.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.desk.hand import go_on_with_brush
from app.desk.lab_state import with_texture
from app.desk.match_state import SIZES, SMALLEST, title
from app.desk.outside import pictured
from app.desk.outside.doctoring import ask_doctor
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col
from app.panels.match.match_settings import MatchSettings
from app.panels.panel import Panel
from engine.studio.textures.texture_results import DoctorScene, MatchScene

REPEATS = 1.35  # tiles of 256 pixels that the preview shows along a side
_USES = (
    ("ink", icons.BRUSH, "Use as ink", "Makes the texture the brush's ink: paint with it"),
    ("density", "", "Dry brush", "The texture thins the stroke like bristles or dry paint"),
    ("grain", "", "Paper", "The texture becomes the surface that the brush feels"),
)
_STILL = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse
_NAMES = ("match example", "match second")
_HINTS = (
    "The example: the texture is made like it.  Drop an image here",
    "A second example, to be mixed with the first.  Drop an image here",
)


class MatchingPanel(Panel):
    """Draws the strip."""

    def __init__(self) -> None:
        self._settings = MatchSettings()
        self.hears = {MatchScene: _heard, DoctorScene: _doctored}

    def wants(self, desk: Desk, now: float) -> None:
        """Asks for the texture as it is set."""
        desk.match.ask(desk.post)

    def dropped(self, desk: Desk, path: Path, x: float, y: float) -> bool:
        """A picture is an example."""
        return desk.match.dropped(path, x, y)

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        left = min(0.21 * room.x, 0.62 * room.y)
        middle = min(0.36 * room.x, room.y)
        desk.match.spots = {}
        imgui.begin_child("examples", ImVec2(left, 0), 0, _STILL)
        for index in (0, 1):
            self._example(desk, index, room.y / 2 - gap)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("texture", ImVec2(middle, 0), 0, _STILL)
        self._texture(desk)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("settings", ImVec2(0, 0))
        imgui.begin_child("sliders", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        self._settings.draw(desk)
        imgui.end_child()
        self._uses(desk)
        imgui.end_child()
        at, size = imgui.get_window_pos(), imgui.get_window_size()
        desk.match.spots[2] = (at.x, at.y, at.x + size.x, at.y + size.y)
        self._welcome(desk)

    def bar(self, desk: Desk) -> None:
        """Draws what is wrong, in the strip's title line."""
        fault = desk.match.scene.fault if desk.match.scene is not None else ""
        if fault:
            imgui.same_line(0, 14 * desk.scale)
            said.text_colored(theme.vec(theme.look.warn), fault if len(fault) < 70 else fault[:68] + "…")
            w.tooltip(fault)

    # --- examples ----------------------------------------------------------------------------------------------------

    def _example(self, desk: Desk, index: int, tall: float) -> None:
        match = desk.match
        line, gap = imgui.get_frame_height(), imgui.get_style().item_spacing.y
        wide, tall = imgui.get_content_region_avail().x, tall - line - gap
        held = match.examples[index]
        corner = imgui.get_cursor_screen_pos()
        match.spots[index] = (corner.x, corner.y, corner.x + wide, corner.y + tall)
        sizes = match.scene.sizes if match.scene is not None else ()
        shown = desk.pictures.get(_NAMES[index]) if held is not None and index < len(sizes) else None
        hint = _HINTS[index] if held is None else f"{title(held)}\n{_HINTS[index]}"
        w.picture(None, (wide, tall), hint, name="example")
        painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + tall)
        if shown is not None:
            at, to = _within(corner, (wide, tall), sizes[index])
            painter.add_image_rounded(shown, at, to, ImVec2(0, 0), ImVec2(1, 1), -1 & 0xFFFFFFFF, 4 * desk.scale)
        else:
            _dashed(corner, end, match.marking == index)
            text = ("Drop an image" if index == 0 else "and another, to mix") if held is None else "…"
            size = said.calc_text_size(text)
            at = ImVec2((corner.x + end.x - size.x) / 2, (corner.y + end.y - size.y) / 2)
            said.add_text(painter, at, theme.packed(theme.look.quiet), text)
        self._sources(desk, index, wide, line)

    def _sources(self, desk: Desk, index: int, wide: float, side: float) -> None:
        """Draws where an example comes from."""
        match, gap = desk.match, 2 * desk.scale
        imgui.push_id(index)
        free = index == 0 or match.examples[0] is not None
        buttons = (
            ("file", icons.FOLDER, "A picture file…", False),
            ("view", icons.EYE, "What the canvas shows now", False),
            ("area", icons.AREA, "Draw a rectangle on the canvas", match.marking == index),
        )
        for i, (name, icon, hint, on) in enumerate(buttons):
            if i:
                imgui.same_line(0, gap)
            if w.icon_button(name, icon, hint, on=on, enabled=free, size=side):
                self._pick(desk, index, name)
        held = match.examples[index]
        if held is not None and "path" in held and not match.mixing:
            imgui.same_line(0, gap)
            if w.icon_button("doctor", icons.DOCTOR, "Which maker suits this example? All are tried", size=side):
                ask_doctor(desk, Path(held["path"]))
        if match.examples[index] is not None:
            imgui.same_line(wide - side)
            if w.icon_button("away", icons.CLOSE, "Take it away", size=side):
                match.show(index, None)
        imgui.pop_id()

    def _pick(self, desk: Desk, index: int, name: str) -> None:
        match = desk.match
        if name == "file":
            desk.asked.show(f"match picture {index}")
        elif name == "area":
            match.marking = None if match.marking == index else index
        else:
            rect = pictured.seen(desk)
            if min(rect.width, rect.height) >= SMALLEST:
                match.show_area(index, desk.view.shown_level, rect)

    # --- the texture -------------------------------------------------------------------------------------------------

    def _texture(self, desk: Desk) -> None:
        match, scene = desk.match, desk.match.scene
        room, gap, line = imgui.get_content_region_avail(), imgui.get_style().item_spacing, imgui.get_frame_height()
        ready = match.examples[0] is not None and scene is not None and scene.done > 0.0
        tall = room.y - line - gap.y - 2
        tile = room.x / REPEATS * match.size / 256 if match.size <= 256 else room.x
        shown = desk.pictures.get("match texture") if ready else None
        corner = w.picture(shown, (room.x, tall), "The texture, tiled; it has no seams", tile, "texture")
        painter = imgui.get_window_draw_list()
        if not ready:
            text = "Texture like the example"
            size = said.calc_text_size(text)
            at = ImVec2(corner.x + (room.x - size.x) / 2, corner.y + (tall - size.y) / 2)
            said.add_text(painter, at, theme.packed(theme.look.quiet), text)
        elif scene is not None and scene.done < 1.0:
            end = ImVec2(corner.x + room.x * scene.done, corner.y + tall)
            painter.add_rect_filled(ImVec2(corner.x, end.y - 3), end, theme.packed(theme.look.accent))
        side = imgui.get_frame_height()
        options = [(str(n), str(n), f"A texture of {n} × {n} pixels") for n in SIZES]
        picked = w.segments("size", str(match.size), options, room.x - side - 2 * desk.scale)
        if picked:
            match.size = int(picked)
        imgui.same_line(0, 2 * desk.scale)
        if w.icon_button("throw", icons.DICE, "The same from other noise", size=side):
            match.seed = (match.seed * 31 + 17) % 99991

    # --- its use -----------------------------------------------------------------------------------------------------

    def _uses(self, desk: Desk) -> None:
        match, gap = desk.match, 2 * desk.scale
        room = imgui.get_content_region_avail().x
        good = match.examples[0] is not None and not (match.scene is not None and match.scene.fault)
        busy = match.awaited is not None
        for i, (how, icon, text, hint) in enumerate(_USES):
            if i:
                imgui.same_line(0, gap)
            wide = (room - 2 * gap) * (0.46, 0.31, 0.23)[i]
            imgui.push_style_color(Col.button, theme.vec(theme.look.raised if i else theme.look.accent_soft))
            label = f"{icons.WAIT} making…" if busy and i == 0 else f"{icon} {text}".strip()
            if w.text_button(f"{label}##{how}", hint, enabled=good and not busy, width=wide):
                match.use(desk.post, how, pictured.free_texture_name(desk, _stem(desk)))
            imgui.pop_style_color()

    def _welcome(self, desk: Desk) -> None:
        """A texture that was asked for is one of the painting now: the brush gets it."""
        match = desk.match
        if match.awaited is None:
            return
        how, name = match.awaited
        if match.scene is not None and match.scene.fault:
            match.awaited = None
        elif desk.known.scene is not None and name in desk.known.scene.textures:
            match.awaited = None
            brush = with_texture(desk.hand.brush, how, name)
            if how == "ink" and match.by_pressure:
                part = replace(brush.ink[0], parameters=brush.ink[0].parameters.set("weight", "pressure"))
                dynamics = brush.dynamics.delete("opacity") if "opacity" in brush.dynamics else brush.dynamics
                brush = replace(brush, ink=(part,), dynamics=dynamics)
            desk.hand.take(brush)
            go_on_with_brush(desk.hand)


def _heard(desk: Desk, scene: MatchScene, _now: float) -> None:
    desk.match.scene = scene


def _doctored(desk: Desk, scene: DoctorScene, _now: float) -> None:
    desk.match.doctored = scene


def _stem(desk: Desk) -> str:
    """Returns a name that says what the texture is made of."""
    stems = [title(example).rpartition(".")[0] or "View" for example in desk.match.examples if example is not None]
    return " and ".join(dict.fromkeys(stems))


def _within(corner: ImVec2, room: tuple[float, float], size: tuple[int, int]) -> tuple[ImVec2, ImVec2]:
    """Corners of a picture of `size` as large as a box has room for, in its middle."""
    scale = min(room[0] / size[0], room[1] / size[1])
    wide, tall = size[0] * scale, size[1] * scale
    x, y = corner.x + (room[0] - wide) / 2, corner.y + (room[1] - tall) / 2
    return ImVec2(x, y), ImVec2(x + wide, y + tall)


def _dashed(corner: ImVec2, end: ImVec2, lit: bool) -> None:
    """Draws the edge of a place where something may be dropped."""
    painter, colour = imgui.get_window_draw_list(), theme.packed(theme.look.accent if lit else theme.look.filled_lit)
    inset, dash = 5.0, 6.0
    x0, y0, x1, y1 = corner.x + inset, corner.y + inset, end.x - inset, end.y - inset
    x = x0
    while x < x1:
        for y in (y0, y1):
            painter.add_line(ImVec2(x, y), ImVec2(min(x + dash, x1), y), colour, 1.2)
        x += 2 * dash
    y = y0
    while y < y1:
        for x in (x0, x1):
            painter.add_line(ImVec2(x, y), ImVec2(x, min(y + dash, y1)), colour, 1.2)
        y += 2 * dash
