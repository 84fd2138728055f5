"""What a right click on nodes offers: a line goes or comes, a link is cut."""

from __future__ import annotations

from collections.abc import Hashable

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_node_editor as ed

from app import icons
from app.desk.desk import Desk
from app.desk.workshop.text_nodes import TextNodes, unlinked
from app.language import said
from app.panels.controls import widgets as w
from app.panels.workshop.node_canvas import NodeCanvas
from app.panels.workshop.node_layout import slots_of

TIDY = "tidy"  # is asked for in place of another text
_LISTED = (10.0, 16.0)  # letters' sizes
_PLACERS = ("scatter", "row", "outer", "slider", "pick")  # that mean nothing as they stand


class NodeMenus:
    """One is open at a time."""

    def __init__(self, canvas: NodeCanvas) -> None:
        self._canvas = canvas
        self._of: tuple[Hashable, ...] = ()  # what the menu is of

    def draw(self, desk: Desk, found: TextNodes | None) -> str | None:
        """Draws what is open, while the editor is suspended; returns a changed text, or TIDY.  `found`: None while the
        text cannot be read."""
        node, link = ed.NodeId(), ed.LinkId()
        if ed.show_node_context_menu(node):
            self._of = self._canvas.key(node.id())
            imgui.open_popup("of a node")
        elif ed.show_link_context_menu(link):
            self._of = self._canvas.key(link.id())
            imgui.open_popup("of a link")
        elif ed.show_background_context_menu():
            imgui.open_popup("of the ground")
        if found is None:
            return None
        return self._of_node(found) or self._of_link(desk, found) or self._of_ground(desk, found)

    def _of_node(self, found: TextNodes) -> str | None:
        if not imgui.begin_popup("of a node"):
            return None
        node = next((one for one in found.nodes if ("node", one.name) == self._of), None)
        text = None if node is None else found.removed(node)
        chosen = said.menu_item(f"{icons.DELETE} Remove the line", "", False, text is not None)[0]
        w.named("Remove the line")
        w.tooltip("A line that no other one uses can go")
        imgui.end_popup()
        return text if chosen else None

    def _of_link(self, desk: Desk, found: TextNodes) -> str | None:
        if not imgui.begin_popup("of a link"):
            return None
        slot = next((one for _, one, key in slots_of(found) if ("link", *key) == self._of), None)
        chosen = said.menu_item(f"{icons.UNLINK} Cut the link", "", False, slot is not None)[0]
        w.named("Cut the link")
        w.tooltip("A plain number or colour takes its place")
        imgui.end_popup()
        if not chosen or slot is None:
            return None
        coloured = {line.name: line.coloured for line in desk.workshop.scene.lines}
        return found.replaced(slot, unlinked(coloured.get(slot.source, False)))

    def _of_ground(self, desk: Desk, found: TextNodes) -> str | None:
        if not imgui.begin_popup("of the ground"):
            return None
        told = None
        if said.menu_item(f"{icons.GRID} Tidy up", "", False)[0]:
            told = TIDY
        w.named("Tidy up")
        w.tooltip("Lays all nodes out anew")
        imgui.separator()
        said.text_disabled("Another line")
        imgui.begin_child("functions", ImVec2(*_LISTED) * imgui.get_font_size())
        for word in desk.workshop.words.functions:
            if word.name not in _PLACERS and imgui.menu_item(word.name, "", False)[0]:
                told = found.added(word)
            w.named(f"add {word.name}")
            w.tooltip(f"{word.form}\n{word.about}")
        imgui.end_child()
        if told is not None:
            imgui.close_current_popup()
        imgui.end_popup()
        return told
