"""Places: bookmarks with their pictures, the map of the paint, and back and forward."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import ACTIONS, perform, tip
from app.desk.desk import Desk
from app.desk.examples.following import Following
from app.desk.places import going
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.fitting import ended
from app.panels.panel import Panel
from app.panels.places.paint_map import PaintMapView
from engine.painting.commands import RemoveBookmark, RenameBookmark
from engine.painting.places import Bookmark
from engine.studio.requests import AskMap, AskMiniatures, Do
from engine.studio.results import PaintMap, Sought

_CARD, _SHAPE = 138.0, 0.68  # points: the least width of a card; its picture's height by its width
_SETTLE = 0.5  # seconds from one map to the next
_PIXELS = 256  # along the longer side of a bookmark's picture
_WAYS = (("back", icons.BACK), ("forward", icons.FORWARD), ("nearest", icons.NEAREST), ("bookmark", icons.BOOKMARK))
_FLAGS = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all


class PlacesPanel(Panel):
    """Draws the strip; remembers which name is being edited."""

    def __init__(self) -> None:
        self._map = PaintMapView()
        self._maps, self._miniatures = Following(_SETTLE), Following(_SETTLE)
        self._editing: str | None = None
        self._text, self._focus = "", False
        self._size = (1, 1)
        self.hears = {PaintMap: _mapped, Sought: _sought}

    def wants(self, desk: Desk, now: float) -> None:
        """Asks for the map and the bookmarks' pictures when the painting has changed."""
        scene, free = desk.known.scene, not desk.painting
        if scene is not None and self._maps.due((id(scene), self._size), now, free):
            desk.post(AskMap(self._size))
        if scene is not None and self._miniatures.due((id(scene),), now, free):
            desk.post(AskMiniatures(scene.bookmarks, (_PIXELS, round(_PIXELS * _SHAPE))))

    def bar(self, desk: Desk) -> None:
        """Draws the ways in the strip's title line."""
        for i, (name, icon) in enumerate(_WAYS):
            imgui.same_line(0, 18 * desk.scale if not i else 3 * desk.scale)
            if w.icon_button(name, icon, tip(name), enabled=ACTIONS[name].when(desk)):
                perform(desk, ACTIONS[name])

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        room = imgui.get_content_region_avail()
        imgui.begin_child("bookmarks", ImVec2(0.46 * room.x, 0))
        self._bookmarks(desk)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("map of paint", ImVec2(0, 0), 0, imgui.WindowFlags_.no_scrollbar)
        room = imgui.get_content_region_avail()
        self._size = max(64, round(room.x / 64) * 64), max(64, round(room.y / 64) * 64)
        self._map.draw(desk)
        imgui.end_child()

    # --- bookmarks ---------------------------------------------------------------------------------------------------

    def _bookmarks(self, desk: Desk) -> None:
        marks = desk.known.scene.bookmarks if desk.known.scene else ()
        room, gap = imgui.get_content_region_avail().x, imgui.get_style().item_spacing.x
        count = max(1, int((room + gap) // (_CARD * desk.scale + gap)))
        wide = (room - imgui.get_style().scrollbar_size - gap * (count - 1)) / count
        for i, mark in enumerate((*marks, None)):
            if i % count:
                imgui.same_line()
            imgui.begin_group()
            imgui.push_id(i)
            if mark is None:
                _add_card(desk, (wide, wide * _SHAPE), not marks)
            else:
                self._card(desk, mark, (wide, wide * _SHAPE))
            imgui.pop_id()
            imgui.end_group()

    def _card(self, desk: Desk, mark: Bookmark, size: tuple[float, float]) -> None:
        corner = imgui.get_cursor_screen_pos()
        imgui.set_next_item_allow_overlap()
        pressed = imgui.invisible_button("go", ImVec2(*size), imgui.ButtonFlags_.enable_nav)
        w.named(f"bookmark {mark.name}")
        hovered, end = imgui.is_item_hovered(), ImVec2(corner.x + size[0], corner.y + size[1])
        w.tooltip(f"Go to “{mark.name}”")
        painter, rounding = imgui.get_window_draw_list(), imgui.get_style().frame_rounding
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
        shown = desk.pictures.get(f"place {mark.name}")
        if shown is not None:
            scale = min(size[0] / mark.size[0], size[1] / mark.size[1])
            half = ImVec2(mark.size[0] * scale / 2, mark.size[1] * scale / 2)
            middle = ImVec2((corner.x + end.x) / 2, (corner.y + end.y) / 2)
            at, to = ImVec2(middle.x - half.x, middle.y - half.y), ImVec2(middle.x + half.x, middle.y + half.y)
            painter.add_image_rounded(shown, at, to, ImVec2(0, 0), ImVec2(1, 1), theme.packed((1.0,) * 3), rounding)
        if hovered:
            painter.add_rect(corner, end, theme.packed(theme.look.accent), rounding, thickness=1.5 * desk.scale)
        editing = self._editing == mark.name
        if self._tools(desk, mark, corner, end):
            pressed = False
        if pressed:
            going.go_to_bookmark(desk, mark)
        if editing:
            self._name_field(desk, mark, size[0])
        else:
            self._name(desk, mark, size[0])

    def _tools(self, desk: Desk, mark: Bookmark, corner: ImVec2, end: ImVec2) -> bool:
        """Draws what can be done with a bookmark over its picture, while the pointer is there; tells whether it is
        done now."""
        mouse, below = imgui.get_io().mouse_pos, imgui.get_cursor_screen_pos()
        here = imgui.is_window_hovered(imgui.HoveredFlags_.allow_when_blocked_by_active_item)
        if not (here and corner.x <= mouse.x < end.x and corner.y <= mouse.y < end.y):
            return False
        side, edge = imgui.get_frame_height(), 3 * desk.scale
        at = ImVec2(end.x - 2 * side - edge, corner.y + edge)
        ground, rounding = theme.packed(theme.look.panel, 0.85), imgui.get_style().frame_rounding
        imgui.get_window_draw_list().add_rect_filled(at, ImVec2(end.x - edge, at.y + side), ground, rounding)
        imgui.set_cursor_screen_pos(at)
        rename = w.icon_button("rename", icons.PENCIL, f"Rename “{mark.name}”", size=side)
        if rename:
            self._edit(mark)
        imgui.set_cursor_screen_pos(ImVec2(at.x + side, at.y))
        remove = w.icon_button("remove bookmark", icons.DELETE, f"Remove “{mark.name}”", size=side)
        if remove:
            desk.post(Do(RemoveBookmark(mark.name)))
        imgui.set_cursor_screen_pos(below)
        return rename or remove

    def _edit(self, mark: Bookmark) -> None:
        self._editing, self._text, self._focus = mark.name, mark.name, True

    def _name(self, desk: Desk, mark: Bookmark, wide: float) -> None:
        flags = imgui.SelectableFlags_.allow_double_click
        chosen = imgui.selectable(f"{ended(mark.name, wide)}###name", False, flags, ImVec2(wide, 0))[0]
        if chosen and imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            self._edit(mark)
        w.named(mark.name)
        w.tooltip(f"“{mark.name}”: double-click to rename")

    def _name_field(self, desk: Desk, mark: Bookmark, wide: float) -> None:
        imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(2, 0))
        imgui.set_next_item_width(wide)
        if self._focus:
            imgui.set_keyboard_focus_here()
            self._focus = False
        done, self._text = imgui.input_text("##rename", self._text, _FLAGS)
        if imgui.is_item_active():  # what is typed goes there
            w.named("rename bookmark")
        imgui.pop_style_var()
        if imgui.is_item_deactivated():
            name = self._text.strip()
            if (done or imgui.is_item_deactivated_after_edit()) and name and name != mark.name:
                desk.post(Do(RenameBookmark(mark.name, name)))
            self._editing = None


def _add_card(desk: Desk, size: tuple[float, float], first: bool) -> None:
    """Draws a place for the next one."""
    action = ACTIONS["bookmark"]
    imgui.push_style_color(imgui.Col_.button, theme.vec(theme.look.raised, 0.45))
    imgui.begin_disabled(not action.when(desk))
    pressed = said.button(f"{icons.ADD}  {'Bookmark this view' if first else 'This view'}", ImVec2(*size))
    imgui.end_disabled()
    imgui.pop_style_color()
    w.named("add bookmark")
    w.tooltip(tip("bookmark"))
    if pressed:
        perform(desk, action)


def _mapped(desk: Desk, found: PaintMap, _now: float) -> None:
    desk.places.map = found


def _sought(desk: Desk, found: Sought, _now: float) -> None:
    desk.places.sought = found
