"""The texture lab: a spectrum to paint in, the texture it makes, and a stroke of it, all at once."""

from __future__ import annotations

import math
from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.action import Action
from app.actions.actions import ACTIONS
from app.desk.desk import Desk
from app.desk.lab_state import only_with, with_texture
from app.desk.outside import pictured
from app.language import said
from app.panels.controls import widgets as w
from app.panels.lab.lab_settings import LabSettings
from app.panels.panel import Painting, Panel
from app.tools.painting_gestures import paint_lab
from engine.studio.textures.texture_requests import LabStep
from engine.studio.textures.texture_results import LabScene

FIELD = 360  # pixels of an endless field that the preview shows along a side
HALF = 0.564  # of the radial window's width: within it, it is more than half as strong as in the middle
REPEATS = 1.4  # tiles of 256 pixels that the preview shows along a side
_PERIODS = (32, 16, 8, 4)  # pixels: rings drawn over the spectrum
_USES = (
    ("ink", icons.BRUSH, "Use as ink", "Makes the texture the brush's ink: paint with it at once"),
    ("density", "", "Dry brush", "The texture thins the stroke like bristles or dry paint"),
    ("grain", "", "Paper", "The texture becomes the surface that the brush feels"),
)


class LabPanel(Panel):
    """Draws the strip; strokes in the spectrum come from `tools.paint_lab`."""

    def __init__(self) -> None:
        self._settings = LabSettings()
        self.hears = {LabScene: _heard}

    def wants(self, desk: Desk, now: float) -> None:
        """Posts what was set, and when it rests a stroke with the texture."""
        known = {row.name for row in desk.known.tables.kinds if not row.pictured}
        known |= set(desk.known.scene.textures if desk.known.scene else ())
        brush = only_with(replace(desk.hand.dipped(), ink=()), frozenset(known))
        desk.lab.ask(desk.post, now, replace(brush, radius=16.0, opacity=1.0, flow=1.0, mode="paint"))

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """Returns a stroke in the spectrum."""
        return paint_lab if desk.lab.over(x, y) else None

    def takes(self, desk: Desk, action: Action) -> bool:
        """Undo and redo over the spectrum are the lab's."""
        steps = {ACTIONS["undo"]: -1, ACTIONS["redo"]: 1}
        if action not in steps or not desk.lab.over(desk.pointer.x, desk.pointer.y):
            return False
        desk.post(LabStep(steps[action]))
        return True

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        line, gap = imgui.get_frame_height_with_spacing(), imgui.get_style().item_spacing.x
        room = imgui.get_content_region_avail()
        side = min(room.y - line - 2, (room.x - 2 * gap) * 0.37)
        imgui.begin_child("spectrum", ImVec2(side, 0))
        self._spectrum(desk, side)
        self._brush(desk)
        imgui.end_child()
        imgui.same_line()
        settings = min((room.x - side - 2 * gap) * 0.51, 300 * desk.scale)
        imgui.begin_child("texture", ImVec2(room.x - side - settings - 2 * gap, 0))
        self._texture(desk, side)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("settings", ImVec2(0, 0))
        imgui.begin_child("sliders", ImVec2(0, -line))
        self._settings.draw(desk)
        imgui.end_child()
        self._uses(desk)
        imgui.end_child()

    # --- the spectrum ------------------------------------------------------------------------------------------------

    def _spectrum(self, desk: Desk, side: float) -> None:
        lab = desk.lab
        corner = w.picture(desk.pictures.get("lab spectrum"), (side, side), "", name="spectrum")
        free = not imgui.is_popup_open("", imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level)
        lab.spot = (corner.x, corner.y, side) if free else None
        painter = imgui.get_window_draw_list()
        painter.push_clip_rect(corner, ImVec2(corner.x + side, corner.y + side), True)
        over = lab.over(desk.pointer.x, desk.pointer.y)
        _axes(desk, corner, side, over)
        if over:
            self._outline(desk, corner, side)
        if lab.scene is not None and lab.scene.silent and lab.made.sheet == "amplitude":
            made = lab.made
            flat = made.part == "imaginary" and made.phase != "random" and not made.forward
            text = "Only random phases have\nan imaginary part" if flat else "Silent: paint here"
            _invite(corner, side, text)
        painter.pop_clip_rect()

    def _outline(self, desk: Desk, corner: ImVec2, side: float) -> None:
        """Draws the brush at the pointer, and where symmetry paints too."""
        lab, painter = desk.lab, imgui.get_window_draw_list()
        radius = max(1.5, lab.radius * side / 256)
        x, y = desk.pointer.x, desk.pointer.y
        other = ImVec2(2 * corner.x + side - x, 2 * corner.y + side - y)
        for at, alpha in ((ImVec2(x, y), 0.9), (other, 0.0 if lab.made.forward else 0.4)):
            painter.add_circle(at, radius + 1, theme.packed((0.0, 0.0, 0.0), 0.6 * alpha), 40)
            painter.add_circle(at, radius, theme.packed((1.0, 1.0, 1.0), alpha), 40)
        if lab.made.forward or lab.painting:
            return
        across, down = (x - corner.x) / side - 0.5, (y - corner.y) / side - 0.5
        far = math.hypot(across, down)
        if far > 0.004:
            text = f"{1 / far:.1f} px  {math.degrees(math.atan2(down, across)) % 180:.0f}°"
            _label(ImVec2(corner.x + 6, corner.y + side - imgui.get_font_size() - 4), text)

    def _brush(self, desk: Desk) -> None:
        """Draws the brush that paints in the spectrum, and its undo."""
        lab, height = desk.lab, imgui.get_frame_height()
        room = imgui.get_content_region_avail().x - 2 * height - 4 * 2 * desk.scale
        imgui.begin_child("size", ImVec2(room / 2, height))
        changed, value = w.slider(
            "Size", lab.radius, (0.7, 60.0), "Radius of the brush in the spectrum", form="%.1f", curved=True
        )
        lab.radius = round(value, 2) if changed else lab.radius
        imgui.end_child()
        imgui.same_line(0, 2 * desk.scale)
        imgui.begin_child("strength", ImVec2(room / 2, height))
        hint = "How strong its paint is; the spectrum shows strength on a logarithmic scale"
        changed, value = w.slider("Strength", lab.strength * 100, (1.0, 100.0), hint, form="%.0f%%")
        lab.strength = round(value / 100, 3) if changed else lab.strength
        imgui.end_child()
        imgui.same_line(0, 2 * desk.scale)
        if w.icon_button("erase", icons.ERASER, "Erase: paints silence", on=lab.erasing):
            lab.erasing = not lab.erasing
        imgui.same_line(0, 2 * desk.scale)
        hint = "Paint in the brush's colour: red, green and blue each have a spectrum of their own"
        if w.icon_button("colour", icons.PALETTE, hint, on=lab.coloured):
            lab.coloured = not lab.coloured

    def hint(self, desk: Desk) -> str:
        """Returns what the brush does in the spectrum now."""
        made = desk.lab.made
        if made.sheet == "phase":
            return "Paint its phases: warm one way, cold the other"
        return "Paint a pattern: the texture is its transform" if made.forward else ""

    def bar(self, desk: Desk) -> None:
        """Draws the texture in use, and the lab's undo, in the strip's title line."""
        lab, scene = desk.lab, desk.lab.scene
        using = self._using(desk)
        side, gap = imgui.get_frame_height(), 2 * desk.scale
        right = imgui.get_window_width() - imgui.get_style().window_padding.x - 4 * (side + gap) - 8 * desk.scale
        if using:
            text = f"“{using}” follows"
            wide = said.calc_text_size("Keep").x + 2 * imgui.get_style().frame_padding.x
            imgui.same_line(right - wide - said.calc_text_size(text).x - imgui.get_style().item_spacing.x)
            imgui.align_text_to_frame_padding()
            said.text_disabled(text)
            imgui.same_line(right - wide)
            if w.text_button("Keep", "Lets it stay as it is; the next use makes another texture"):
                lab.use(desk.post, "")
        else:
            imgui.same_line(right - said.calc_text_size("Live").x - side - gap)
            _, lab.follow = w.tick("Live", lab.follow, _LIVE)
        imgui.same_line(right + 8 * desk.scale)
        signs = (
            (-1, icons.UNDO, "Take back a stroke  (Ctrl+Z over the spectrum)", bool(scene and scene.can_undo)),
            (1, icons.REDO, "Do it again  (Ctrl+Shift+Z over the spectrum)", bool(scene and scene.can_redo)),
            (0, icons.DELETE, "Take all strokes away; the shapes stay", bool(scene and scene.strokes)),
        )
        for count, icon, hint, enabled in signs:
            if w.icon_button(f"step {count}", icon, hint, enabled=enabled):
                desk.post(LabStep(count))
            imgui.same_line(0, 2 * desk.scale)

    # --- the texture -------------------------------------------------------------------------------------------------

    def _texture(self, desk: Desk, side: float) -> None:
        """Draws the texture as it tiles, a stroke of it, and the same much nearer."""
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing
        endless = desk.lab.endless
        tile = min(room.x / REPEATS, 256 * desk.scale) * desk.lab.made.size[0] / 256
        below = min(64 * desk.scale, 0.24 * room.y)
        tall = room.y - below - gap.y
        hint = "The endless field; ringed: one copy" if endless else "The texture, tiled; it follows every touch"
        tile = max(room.x, tall) if endless else tile
        corner = w.picture(desk.pictures.get("lab texture"), (room.x, tall), hint, tile, "texture")
        if endless and (imgui.is_item_hovered() or self._settings.on_window):
            _window(corner, (room.x, tall), desk.lab.window, tile / FIELD)
        wide = (room.x - gap.x) / 2
        desk.lab.shown = max(1, round(wide)), max(1, round(below))
        w.picture(desk.pictures.get("lab stroke"), (wide, below), "A stroke of the brush with this ink")
        imgui.same_line()
        w.picture(desk.pictures.get("lab near"), (wide, below), "The same ink, 16 times nearer")

    def _using(self, desk: Desk) -> str:
        """Returns the texture of this painting that follows the lab."""
        name = desk.lab.scene.using if desk.lab.scene is not None else ""
        return name if desk.known.scene is not None and name in desk.known.scene.textures else ""

    # --- its use -----------------------------------------------------------------------------------------------------

    def _uses(self, desk: Desk) -> None:
        scene = desk.lab.scene
        using = self._using(desk)
        silent = scene is None or scene.silent
        gap, room = 2 * desk.scale, imgui.get_content_region_avail().x
        for i, (how, icon, text, hint) in enumerate(_USES):
            if i:
                imgui.same_line(0, gap)
            wide = (room - 2 * gap) * (0.46, 0.31, 0.23)[i]
            imgui.push_style_color(imgui.Col_.button, theme.vec(theme.look.raised if i else theme.look.accent_soft))
            if w.text_button(f"{icon} {text}".strip(), hint, enabled=not silent, width=wide):
                self._use(desk, how, using)
            imgui.pop_style_color()

    def _use(self, desk: Desk, how: str, using: str) -> None:
        name = using or pictured.free_texture_name(desk, "Texture")
        if not using:
            desk.lab.use(desk.post, name)
        desk.hand.take(with_texture(desk.hand.brush, how, name, desk.pointer.pen))
        desk.hand.use("brush")


def _heard(desk: Desk, scene: LabScene, _now: float) -> None:
    desk.lab.scene = scene


def _axes(desk: Desk, corner: ImVec2, side: float, over: bool) -> None:
    """Marks the zero frequency in the middle, and rings at periods that say how large the features are."""
    painter = imgui.get_window_draw_list()
    middle = ImVec2(corner.x + side / 2, corner.y + side / 2)
    faint = theme.packed((1.0, 1.0, 1.0), 0.10)
    painter.add_line(ImVec2(corner.x, middle.y), ImVec2(corner.x + side, middle.y), faint)
    painter.add_line(ImVec2(middle.x, corner.y), ImVec2(middle.x, corner.y + side), faint)
    if desk.lab.made.forward:
        return
    for period in _PERIODS:
        radius = side / period
        painter.add_circle(middle, radius + 1, theme.packed((0.0, 0.0, 0.0), 0.22), 64)
        painter.add_circle(middle, radius, theme.packed((1.0, 1.0, 1.0), 0.2), 64)
        if period <= 8:
            at = ImVec2(middle.x + 0.71 * radius + 2, middle.y + 0.71 * radius - 2)
            _label(at, f"{period} px", 0.9 if over else 0.6)


def _invite(corner: ImVec2, side: float, text: str) -> None:
    size = said.calc_text_size(text)
    at = ImVec2(corner.x + (side - size.x) / 2, corner.y + side * 0.62)
    said.add_text(imgui.get_window_draw_list(), at, theme.packed(theme.look.text, 0.8), text)


def _window(corner: ImVec2, size: tuple[float, float], width: int, scale: float) -> None:
    """Draws the radial window of a copy over the field: where it ends, and where it is half as strong as in the
    middle."""
    middle, painter = ImVec2(corner.x + size[0] / 2, corner.y + size[1] / 2), imgui.get_window_draw_list()
    painter.push_clip_rect(corner, ImVec2(corner.x + size[0], corner.y + size[1]), True)
    for part, alpha in ((1.0, 0.9), (HALF, 0.5)):
        radius = part * width * scale / 2
        painter.add_circle(middle, radius + 1, theme.packed((0.0, 0.0, 0.0), 0.6 * alpha), 64)
        painter.add_circle(middle, radius, theme.packed((1.0, 1.0, 1.0), alpha), 64)
    _label(ImVec2(corner.x + 6, corner.y + size[1] - imgui.get_font_size() - 4), f"window {width} px")
    painter.pop_clip_rect()


def _label(at: ImVec2, text: str, alpha: float = 1.0) -> None:
    """Draws a light text that is read over anything."""
    painter = imgui.get_window_draw_list()
    for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        said.add_text(painter, ImVec2(at.x + dx, at.y + dy), theme.packed((0.0, 0.0, 0.0), 0.6 * alpha), text)
    said.add_text(painter, at, theme.packed(theme.look.text, alpha), text)


_LIVE = "A texture in use changes with the lab, and the next stroke paints with it"
