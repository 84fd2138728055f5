"""The brush panel: tools, presets painted by the brushes themselves, and the settings of the one chosen."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import actions
from app.desk import palette
from app.desk.desk import Desk
from app.desk.examples import example_use, thumbnails
from app.desk.examples.following import Following
from app.desk.hand import go_on_with_brush
from app.language import said
from app.panels.brush import example_section, move_choice, shape_choice, tip_section
from app.panels.brush.brush_list import BrushList
from app.panels.brush.dynamics_section import DynamicsSection
from app.panels.brush.operations import Operations
from app.panels.brush.save_brush import SaveBrush, draw_changed
from app.panels.brush.size_row import draw_radius, draw_steadying
from app.panels.brush.symmetry_section import SymmetrySection
from app.panels.brush.texturing import Texturing
from app.panels.brush.thickness_section import draw_thickness
from app.panels.brush.wet_section import WetSection
from app.panels.controls import widgets as w
from app.panels.controls.grips import note_grip
from app.panels.controls.late_picture import draw_late
from app.panels.options.fill_options import FILL_TOOLS
from app.tools.tools import TOOLS
from engine.brush.modes import MODES
from engine.brush.settings import SETTINGS
from engine.studio.requests import Swatch

_ON_WHITE = 0.36, 0.36, 0.36  # of the brush's name, on the white of its picture, whatever the look
PREVIEW = (228, 44)  # of the stroke of the brush as it is, points
_FIXED = (
    ("canvas", "On canvas", "Textures lie still on the canvas: strokes merge"),
    ("stroke", "On stroke", "Textures turn and run with each stroke, as brush marks do"),
    ("dab", "On dab", "Every dab has the same piece of the texture"),
)  # what the ink's and the dry brush's textures lie on
_ACROSS = 7  # buttons of tools in a row


def _tool_row(desk: Desk, names: list[tuple[str, str, bool]], side: float, gap: float) -> None:
    """Draws buttons of tools, with a gap between them."""
    for i, (name, icon, on) in enumerate(names):
        if i:
            imgui.same_line(0, gap)
        if w.icon_button(name, icon, actions.tip(name), on=on, size=side):
            actions.perform(desk, actions.ACTIONS[name])


class BrushPanel:
    """Draws the tools, the presets, and the settings."""

    def __init__(self) -> None:
        self._texturing, self._dynamics = Texturing(), DynamicsSection()
        self._operations, self._saving, self._list = Operations(), SaveBrush(), BrushList()
        self._symmetry, self._wet = SymmetrySection(), WetSection()
        self._sections: dict[str, Callable[[Desk], None]] = {
            "eraser": example_section.draw_eraser,
            "operations": self._operations.draw,
            "example": example_section.draw,
        }  # of a mode alone
        self._following = Following()

    def wants(self, desk: Desk, now: float) -> None:
        """Asks for the stroke of the brush as it is set, pictures of the presets, and those of examples where one is
        shown."""
        self._list.wants(desk)
        brush, lab = desk.examples.at_home(desk.hand.dipped()), desk.lab.scene
        grows = brush.row.grows
        if grows:
            example_use.prepare(desk, now)
            desk.thumbnails(desk.examples.entries, thumbnails.side(desk.scale))
        free = not grows or desk.known.preparing is None  # or the engine would wait for it, and strokes for the engine
        if self._following.due((brush, 0 if lab is None else lab.version), now, free):
            size = (int(PREVIEW[0] * desk.scale), int(PREVIEW[1] * desk.scale))
            desk.awaited.ask("brush")
            desk.post(Swatch("brush", brush, size, textures=palette.lacking(desk), soon=True))

    def draw_tools(self, desk: Desk) -> None:
        """Draws the tools into the present window, below a line by which they are taken."""
        corner, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
        imgui.invisible_button("tools grip", ImVec2(wide, 8 * desk.scale))
        note_grip()
        w.named("tools grip")
        w.tooltip("Drag the tools elsewhere; right click: more")
        painter, y = imgui.get_window_draw_list(), corner.y + 4 * desk.scale
        colour = theme.packed(theme.look.quiet if imgui.is_item_hovered() else theme.look.raised)
        left, right = corner.x + 0.42 * wide, corner.x + 0.58 * wide
        painter.add_line(ImVec2(left, y), ImVec2(right, y), colour, 2 * desk.scale)
        self._tools(desk)

    def draw_list(self, desk: Desk) -> None:
        """Draws the presets."""
        shown = w.section("Brushes", "Presets: click to paint with one", shared=True)
        self._saving.draw(desk)
        if shown:
            self._list.draw(desk)

    def draw_settings(self, desk: Desk) -> None:
        """Draws what the brush in hand is set to: what its mode alone has comes last, so that nothing gives way."""
        shown = w.section("Brush settings", shared=True)
        draw_changed(desk)
        if shown:
            self._preview(desk)
            self._modes(desk)
            self._settings(desk)
            section = desk.hand.stroke_mode().section
            if section:
                self._sections[section](desk)
        self._wet.draw(desk)
        self._texturing.draw(desk)
        if w.section("Symmetry", "Strokes painted several times in one step", opened=False):
            self._symmetry.draw(desk)
        if w.section("Tip shape", "Slender, turned with the stroke or the pen, strewn", opened=False):
            tip_section.draw(desk)
        if w.section("Pen and motion", "What pressure, tilt, speed, chance change", opened=False):
            self._dynamics.draw(desk)

    def _preview(self, desk: Desk) -> None:
        """Draws a stroke of the brush as it is set now."""
        width, height = imgui.get_content_region_avail().x, PREVIEW[1] * desk.scale
        corner = imgui.get_cursor_screen_pos()
        imgui.dummy(ImVec2(width, height))
        w.tooltip("A stroke of this brush")
        end, painter = ImVec2(corner.x + width, corner.y + height), imgui.get_window_draw_list()
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), 4 * desk.scale)
        picture = desk.pictures.get("brush")
        if picture is not None:
            white = theme.packed((1.0, 1.0, 1.0))
            painter.add_image_rounded(picture, corner, end, ImVec2(0, 0), ImVec2(1, 1), white, 4 * desk.scale)
            size = 0.8 * imgui.get_font_size()
            at = ImVec2(corner.x + 0.4 * size, end.y - 1.2 * size)
            said.add_text(painter, at, theme.packed(_ON_WHITE), desk.hand.preset, size)
        draw_late(desk, "brush", corner, end)

    def _tools(self, desk: Desk) -> None:
        side = imgui.get_font_size() * 2.1
        names: list[tuple[str, str, bool]] = [
            ("brush", icons.BRUSH, desk.hand.tool == "brush" and not desk.hand.erasing),
            ("eraser", icons.ERASER, desk.hand.tool == "brush" and desk.hand.erasing),
        ]
        names.append(("pick", TOOLS["pick"].icon, desk.hand.tool == "pick"))
        gap = (imgui.get_content_region_avail().x - side * _ACROSS) / (_ACROSS - 1)
        _tool_row(desk, names, side, gap)
        imgui.same_line(0, gap)
        move_choice.draw(desk, side)
        imgui.same_line(0, gap)
        views = [(name, TOOLS[name].icon, desk.hand.tool == name) for name in ("pan", "zoom", "turn")]
        _tool_row(desk, views, side, gap)
        fills = desk.hand.tool if desk.hand.tool in FILL_TOOLS else "fill"
        regions = ("rectangle", "ellipse", "lasso", "polygon", "wand", fills)
        _tool_row(desk, [(name, TOOLS[name].icon, desk.hand.tool == name) for name in regions], side, gap)
        imgui.same_line(0, gap)
        shape_choice.draw(desk, side)

    def _modes(self, desk: Desk) -> None:
        """Buttons side by side, each as wide as its word asks for, in two rows where a language asks for more room."""
        gap, room, rows = 3 * desk.scale, imgui.get_content_region_avail().x, list(MODES.values())
        words = [said.calc_text_size(row.label).x + 2 * desk.scale for row in rows]
        across = len(rows) if sum(words) + gap * (len(rows) - 1) <= room else (len(rows) + 1) // 2
        imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(1, 4) * desk.scale)
        for i, row in enumerate(rows):
            if i % across:
                imgui.same_line(0, gap)
            else:
                beside = words[i : i + across]
                spare = (room - sum(beside) - gap * (len(beside) - 1)) / len(beside)
            on = desk.hand.brush.row is row
            imgui.push_style_color(imgui.Col_.button, theme.vec(theme.look.accent_soft if on else theme.look.raised))
            if w.text_button(row.label, row.tooltip, width=words[i] + spare):
                go_on_with_brush(desk.hand)
                if row.grows and desk.hand.brush.example is None:
                    example_use.take_example(desk)
                else:
                    desk.hand.change(mode=row.name)
            imgui.pop_style_color()
        imgui.pop_style_var()

    def _settings(self, desk: Desk) -> None:
        for name, row in SETTINGS.items():
            if name == "radius":
                draw_radius(desk)
                continue
            shown, form, lo, hi = _percent(getattr(desk.hand.brush, name), "%.2f", *row.slider, row.unit)
            imgui.begin_disabled(name in desk.hand.stroke_mode().unfelt)
            changed, value = w.slider(row.label, shown, (lo, hi), row.tooltip, form=form, curved=row.logarithmic)
            imgui.end_disabled()
            if changed:
                value = value / 100 if form.endswith("%%") else value
                setting: dict[str, Any] = {name: row.clamped(round(value, 4))}
                desk.hand.change(**setting)

        draw_steadying(desk)
        _draw_fixed(desk)
        draw_thickness(desk)


def _draw_fixed(desk: Desk) -> None:
    """Draws what the brush's textures lie still on; it does nothing where none is there that may move."""
    brush = desk.hand.brush
    imgui.begin_disabled(brush.density is None and not (brush.ink and brush.row.lays_ink))
    fixed = w.segments("fixed", brush.fixed, _FIXED)
    imgui.end_disabled()
    if fixed is not None:
        desk.hand.change(fixed=fixed)


def _percent(value: float, form: str, lo: float, hi: float, unit: str) -> tuple[float, str, float, float]:
    """Parts of one as per cent, which people read more easily."""
    if unit == "" and (lo, hi) == (0.0, 1.0):
        return value * 100, "%.0f%%", 0.0, 100.0
    return value, form, lo, hi
