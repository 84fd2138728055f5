"""Where the panels lie: menu above, brush on the left, colour, ink and layers on the right, status line below."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from app import theme, trace
from app.desk.desk import Desk, Hear
from app.desk.outside import pictured
from app.faults.fault_guard import FaultGuard
from app.panels import menu_bar, status
from app.panels.arranging.dock_edge import DockEdge, Edge
from app.panels.arranging.docks import FLOATS, Docks, dock_unit
from app.panels.brush.brush_panel import BrushPanel
from app.panels.brush.pop_up import PopUp
from app.panels.colour.colour_panel import ColourPanel
from app.panels.colour.ink_mixer import InkPanel
from app.panels.dialogs.dialogs import Dialogs
from app.panels.guides.guide_bar import GuideBar
from app.panels.layers import mask_bar
from app.panels.layers.layers_panel import LayersPanel
from app.panels.light import light_panel
from app.panels.moving.move_bar import MoveBar
from app.panels.options import options_bar
from app.panels.panel import Painting
from app.panels.places.place_field import PlaceField
from app.panels.starting import start_page
from app.panels.strip import StripPanel

NARROW = 640.0  # points: a strip needs more
HIGH = 0.62  # of the window's height: a strip takes no more
_FIXED = (
    imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.no_title_bar
    | imgui.WindowFlags_.no_resize
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_bring_to_front_on_focus
)
_FLOATING = _FIXED & ~(imgui.WindowFlags_.no_resize | imgui.WindowFlags_.no_bring_to_front_on_focus)
_SCROLLS_NOT = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse


class Layout:
    """Draws all panels and tells which points of the screen they cover; one that fails keeps none from the others."""

    def __init__(self, guard: FaultGuard) -> None:
        self._guard = guard
        self.brush, self.colour, self.ink, self.layers = BrushPanel(), ColourPanel(), InkPanel(), LayersPanel()
        self.dialogs, self.strip, self.place_field = Dialogs(), StripPanel(), PlaceField()
        self.move_bar, self.guide_bar, self.pop_up = MoveBar(), GuideBar(), PopUp()
        self.start_page = start_page.StartPage()
        panels = {
            "tools": self.brush.draw_tools,
            "brushes": self.brush.draw_list,
            "settings": self.brush.draw_settings,
            "colour": self.colour.draw,
            "ink": self.ink.draw,
            "layers": self.layers.draw,
        }
        self._docks, self._edge = Docks(panels, self._begin, guard), DockEdge(self._begin)
        self._covered: list[tuple[float, float, float, float]] = []
        self._popup, self._strip = False, ""

    def covers(self, x: float, y: float) -> bool:
        """Tells whether a press at (x, y) belongs to the panels: those of the last frame, or any menu or dialog."""
        below = self._popup and not self.dialogs.leaves(x, y)
        return below or any(x0 <= x < x1 and y0 <= y < y1 for x0, y0, x1, y1 in self._covered)

    @property
    def popup(self) -> bool:
        """Tells whether a menu, a list or a small window is open above the panels."""
        return self._popup

    def dismiss(self) -> None:
        """Closes the topmost of them."""
        imgui.internal.close_popup_to_level(max(0, len(imgui.get_current_context().open_popup_stack) - 1), True)

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """Returns the stroke that a press there begins in a panel; None if it begins none."""
        return None if self._popup else self.strip.stroke(desk, x, y)

    def hearers(self, kind: type) -> list[Hear]:
        """Returns who of the panels hears results of a type."""
        return self.strip.hearers(kind)

    def wants(self, desk: Desk, now: float) -> None:
        """Posts what the panels lack that are to be seen; called once the engine is there."""
        if not desk.painting and not desk.glide.moving:
            desk.places.seek(desk.post, desk.view.shown_level, pictured.seen(desk), desk.known.scene)
        if desk.panels:
            self.brush.wants(desk, now)
            self.ink.wants(desk, now)
            self.strip.wants(desk, now)

    def draw(self, desk: Desk, pointer_name: str) -> None:
        """Draws it into the present window."""
        self._covered = []
        _take_keys(desk)
        top = self._menu(desk)
        bottom = self._status(desk, pointer_name) if desk.panels or desk.notices.rows else 0.0
        left, right, opened = 0.0, 0.0, desk.strip
        if desk.panels:
            height = desk.view.height - top - bottom
            left, right = self._docks.widths(desk)
            tall = min(self.strip.height(desk), HIGH * height) if desk.strip else 0.0
            under = desk.view.width - left - right < NARROW * desk.scale  # then the strip goes below the right panel
            self._docks.draw(desk, top, (height, height - tall if under else height), (left, right))
            if desk.strip:
                bottom += tall
                wide = desk.view.width - left - (0.0 if under else right)
                self._open_strip(desk, (left, desk.view.height - bottom, wide, tall))
        self._make_room(desk, (left, top, right, bottom), opened)
        self._bar(desk, (left, top))
        box = self.start_page.box(desk)
        if box is not None:
            with start_page.card_style(desk):
                if self._begin("start", box):
                    with self._guard.spare_drawing("drawing the start page"):
                        self.start_page.draw(desk)
                imgui.end()
        with self._guard.spare_drawing("drawing a dialog"):
            self.dialogs.draw(desk)
        with self._guard.spare_drawing("drawing the pop-up palette"):
            self.pop_up.draw(desk)
        with self._guard.spare_drawing("drawing the field for a place"):
            self.place_field.draw(desk)
        any_popup = imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level
        self._popup = imgui.is_popup_open("", any_popup)
        trace.tell_places()

    def _open_strip(self, desk: Desk, box: tuple[float, float, float, float]) -> None:
        imgui.push_style_color(imgui.Col_.window_bg, theme.vec(theme.look.popup))
        if self._begin("strip", box):
            with self._guard.spare_drawing("drawing the strip"):
                self.strip.draw(desk)
        imgui.end()
        imgui.pop_style_color()
        x, y, wide, tall = box
        out = 4 * desk.scale
        wanted = self._edge.draw(desk, Edge("strip edge", (x, y - out, wide, out), True, -1.0), tall)
        if wanted is not None:
            desk.arranged.now = replace(desk.arranged.now, strip=max(1.0, wanted / dock_unit(desk)))

    def _bar(self, desk: Desk, corner: tuple[float, float]) -> None:
        """Draws bars over the canvas, so that nothing gives way to them: the numbers of what is moved or of a guide, or
        what the tool in hand can be set to, and below which mask is painted on; and the light, if it is on."""
        options = (options_bar.options_of(desk), self.move_bar.options(desk), self.guide_bar.options(desk))
        bars = [("options bar", bar) for bar in options if bar is not None][:1]
        if mask_bar.wanted(desk):
            bars.append(("mask bar", options_bar.Options(mask_bar.MASK_BAR_WIDTH, mask_bar.draw)))
        margin, gap = 4 * desk.scale, imgui.get_style().item_spacing.y
        free, top = desk.view.width - corner[0] - desk.insets[2] - 2 * margin, corner[1] + margin
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(8, 4) * desk.scale)
        for name, bar in bars:
            high = bar.lines * (imgui.get_frame_height() + gap) - gap + (6 + 2 * bar.lines) * desk.scale
            wide = min(bar.width * imgui.get_font_size(), free)
            if self._begin(name, (corner[0] + margin, top, wide, high), _SCROLLS_NOT):
                with self._guard.spare_drawing(f"drawing the {name}"):
                    bar.draw(desk)
            imgui.end()
            top += high + margin
        box = light_panel.light_box(desk)
        if box is not None:
            if self._begin("light", box, _SCROLLS_NOT):
                with self._guard.spare_drawing("drawing the light"):
                    light_panel.draw_light(desk)
            imgui.end()
        imgui.pop_style_var()

    def _make_room(self, desk: Desk, insets: tuple[float, float, float, float], opened: str) -> None:
        """What was in the middle stays there when the strip opens or closes.  `opened`: the one that was drawn: its own
        sign closes it from the next frame on."""
        x, y = desk.middle()
        strip, self._strip = self._strip, opened
        desk.insets = insets
        left, top, right, bottom = (round(inset) for inset in insets)
        trace.note_place("canvas", "canvas", (left, top, desk.view.width - right, desk.view.height - bottom))
        if strip != self._strip and not desk.painting:
            desk.view = desk.view.held(desk.view.to_canvas(x, y), *desk.middle())

    def _begin(self, name: str, box: tuple[float, float, float, float], flags: int = 0) -> bool:
        x0, y0, x1, y1 = (round(edge) for edge in (box[0], box[1], box[0] + box[2], box[1] + box[3]))
        self._covered.append((x0, y0, x1, y1))  # whole pixels, as imgui draws it: a press on any of them is the panel's
        imgui.set_next_window_pos(ImVec2(x0, y0))
        imgui.set_next_window_size(ImVec2(x1 - x0, y1 - y0))
        return imgui.begin(name, None, _FLOATING if flags == FLOATS else _FIXED | flags)[0]

    def _menu(self, desk: Desk) -> float:
        height = 0.0
        if desk.panels:
            with self._guard.spare_drawing("drawing the menu bar"):
                height = menu_bar.draw(desk)
                self._covered.append((0, 0, desk.view.width, height))
        return height

    def _status(self, desk: Desk, pointer_name: str) -> float:
        height = imgui.get_font_size() + 11 * desk.scale
        imgui.push_style_color(imgui.Col_.window_bg, theme.vec(theme.look.shade))
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(10 * desk.scale, 5 * desk.scale))
        imgui.push_style_var(imgui.StyleVar_.window_min_size, ImVec2(1, 1))
        if self._begin(
            "status", (0, desk.view.height - height, desk.view.width, height), imgui.WindowFlags_.no_scrollbar
        ):
            with self._guard.spare_drawing("drawing the status line"):
                status.draw(desk, pointer_name)
        imgui.end()
        imgui.pop_style_var(2)
        imgui.pop_style_color()
        return height


def _take_keys(desk: Desk) -> None:
    """Has keys go through the panels while one is chosen by them, and chooses the next one."""
    io, nav = imgui.get_io(), int(imgui.ConfigFlags_.nav_enable_keyboard)
    on = desk.keys.panel is not None
    io.config_nav_cursor_visible_always = on
    io.config_flags = io.config_flags | nav if on else io.config_flags & ~nav
    if desk.keys.turning and desk.keys.panel is not None:
        told = desk.arranged.now
        floating = [f"{name}##floating" for name in sorted(told.floating) if name not in told.hidden]
        names = [*told.column("left"), *told.column("right"), *floating, *(["strip"] if desk.strip else [])]
        if names:
            imgui.set_window_focus(names[desk.keys.panel % len(names)])
    desk.keys.turning = False
