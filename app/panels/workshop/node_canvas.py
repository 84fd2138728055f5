"""What nodes lie on: imgui-bundle's editor, whose ids stand for names, and where all lies for tests."""

from __future__ import annotations

from collections.abc import Hashable

from imgui_bundle import ImVec2, ImVec4, imgui
from imgui_bundle import imgui_node_editor as ed

from app import theme
from app.panels.controls import widgets as w

_RADIUS, _PIN = 0.24, 0.55  # of the letters' size
OUT = "out"  # of a pin's key: the end that gives


class NodeCanvas:
    """One for each window in which nodes are."""

    def __init__(self) -> None:
        self._context: ed.EditorContext | None = None
        self._ids: dict[Hashable, int] = {}
        self._keys: dict[int, tuple[Hashable, ...]] = {}
        self._boxes: list[tuple[str, ImVec2, ImVec2]] = []
        self.hint = ""

    def begin(self, size: ImVec2) -> None:
        """Begins a frame."""
        if self._context is None:
            config = ed.Config()
            config.settings_file = None
            self._context = ed.create_editor(config)
        ed.set_current_editor(self._context)
        ed.enable_shortcuts(False)  # keys are the program's
        self._look()
        self._boxes, self.hint = [], ""
        ed.begin("nodes", size)

    def id(self, *key: Hashable) -> int:
        """Returns the number by which the editor knows something, the same one each frame."""
        number = self._ids.setdefault(key, len(self._ids) + 1)
        self._keys[number] = key
        return number

    def key(self, number: int) -> tuple[Hashable, ...]:
        """Returns what a number stands for; () if nothing."""
        return self._keys.get(number, ())

    def note(self, name: str, hint: str) -> None:
        """Remembers where the item just drawn lies, and what is told of it."""
        if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
            self.hint = hint
        self._boxes.append((name, imgui.get_item_rect_min(), imgui.get_item_rect_max()))

    def pin(self, key: tuple[Hashable, ...], kind: ed.PinKind, name: str, hint: str) -> None:
        """Draws an end of links."""
        size, high = imgui.get_font_size(), imgui.get_frame_height()
        ed.begin_pin(ed.PinId(self.id("pin", *key)), kind)
        ed.pin_pivot_alignment(ImVec2(0.5, 0.5))
        ed.pin_pivot_size(ImVec2(0, 0))
        at = imgui.get_cursor_screen_pos()
        imgui.dummy(ImVec2(_PIN * size, high))
        middle = at + ImVec2(_PIN * size / 2, high / 2)
        imgui.get_window_draw_list().add_circle_filled(middle, _RADIUS * size, theme.packed(theme.look.soft))
        self.note(name, hint)
        ed.end_pin()

    def tell(self) -> None:
        """Draws the hint of what the pointer is over, and tells tests where all lies; while the editor is suspended."""
        for name, corner, end in self._boxes:
            w.placed(name, ed.canvas_to_screen(corner), ed.canvas_to_screen(end))
        if self.hint:
            w.show_tooltip(self.hint)

    def _look(self) -> None:
        style, size, look = ed.get_style(), imgui.get_font_size(), theme.look
        style.node_padding = ImVec4(0.5 * size, 0.4 * size, 0.5 * size, 0.4 * size)
        style.node_rounding, style.link_strength = imgui.get_style().frame_rounding, 3.0 * size
        names = ed.StyleColor
        for name, colour, alpha in (
            *((names.bg, look.field, 1.0), (names.grid, look.line, 0.35), (names.node_bg, look.panel, 1.0)),
            *((names.node_border, look.border, 1.0), (names.hov_node_border, look.soft, 1.0)),
            *((names.sel_node_border, look.accent, 1.0), (names.node_sel_rect, look.accent, 0.15)),
            *((names.hov_link_border, look.text, 1.0), (names.sel_link_border, look.accent, 1.0)),
        ):
            style.set_color_(name, theme.vec(colour, alpha))
