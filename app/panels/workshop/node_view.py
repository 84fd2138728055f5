"""The text of a texture as nodes: each line is one, links are names; what is set here is written there."""

from __future__ import annotations

from collections.abc import Hashable

from imgui_bundle import ImVec2, imgui
from imgui_bundle import imgui_node_editor as ed

from app import theme
from app.desk.colours import from_hex, to_hex
from app.desk.desk import Desk
from app.desk.workshop.text_nodes import LineNode, NodeRow, Slot, TextNodes, text_nodes
from app.language import said
from app.panels.controls.colour_popup import colour_popup
from app.panels.workshop import text_colours
from app.panels.workshop.line_marks import line_picture
from app.panels.workshop.node_canvas import OUT, NodeCanvas
from app.panels.workshop.node_layout import NUMBER_WIDE, broken_rows, first_places, legible, node_width, slots_of
from app.panels.workshop.node_menus import TIDY, NodeMenus

_WHOLE = frozenset(("octaves", "seed", "corners", "n"))  # values that are whole numbers
_PICTURE = ImVec2(2.4, 1.5)  # letters' sizes
_LEAST = 0.62  # of a node's size: below that letters are hard to read
_FRAMES = 4  # until the sizes of nodes are known, and all are in sight
_SOLO = "Click to look at this line alone"
_NUMBER = "Drag to change it, or Ctrl+click to type"
_COLOUR = "Click to choose another colour"
_TAKES = "The right end of another line dropped here takes this place"
_GIVES = "Drag from here into another line, to use this one there; a right click cuts a link"
_REFUSED = "No line is made of itself, and sliders have numbers of their own"


class NodeView:
    """It keeps where the nodes lie, by the lines' names."""

    def __init__(self) -> None:
        self._canvas = NodeCanvas()
        self._menus = NodeMenus(self._canvas)
        self._lying: set[str] = set()
        self._found: TextNodes | None = None
        self._told = ""
        self._fit = 0

    def draw(self, desk: Desk, size: ImVec2) -> str | None:
        """Draws them; returns the text, where it was changed.  While it cannot be read, the last ones stay, in vain."""
        state = desk.workshop
        found = text_nodes(state.text, state.words)
        right, found = found is not None, found or self._found
        if found is None:
            return None
        self._found, self._told = found, state.text
        self._canvas.begin(size)
        self._lie(found)
        imgui.begin_disabled(not right)
        for number, node in enumerate(found.nodes):
            self._node(desk, found, number, node)
        imgui.end_disabled()
        self._links(found)
        if right:
            self._connect(found)
        ed.suspend()
        chosen = self._menus.draw(desk, found if right else None)
        if not self._fit:
            self._canvas.tell()
        ed.resume()
        self._fit = max(0, self._fit - 1)
        if self._fit == 2:
            self._into_sight(found, size)
        ed.end()
        if chosen == TIDY:
            self._lying.clear()
        elif chosen is not None:
            self._told = chosen
        return self._told if right and self._told != state.text else None

    def _lie(self, found: TextNodes) -> None:
        """Puts those that came to their places: no other moves."""
        names = {node.name for node in found.nodes}
        first = 2 * len(self._lying & names) <= len(names)  # another text
        new, size = names if first else names - self._lying, imgui.get_font_size()
        for name, at in first_places(found).items() if new else ():
            if name in new:
                ed.set_node_position(ed.NodeId(self._canvas.id("node", name)), ImVec2(at.x, at.y) * size)
        self._lying, self._fit = names, _FRAMES if first else self._fit

    def _into_sight(self, found: TextNodes, size: ImVec2) -> None:
        """Shows all nodes; where these are too small to be read, the texture's and as many before it as can be."""
        ids = [ed.NodeId(self._canvas.id("node", node.name)) for node in found.nodes]
        corners = [ed.get_node_position(one) for one in ids]
        boxes = [(at, at + ed.get_node_size(one)) for one, at in zip(ids, corners, strict=True)]
        shown = legible(boxes, size * (1 / _LEAST))
        if len(shown) == len(ids):
            ed.navigate_to_content(0.0)
            return
        for number in shown:
            ed.select_node(ids[number], append=True)
        ed.navigate_to_selection(True, 0.0)
        ed.clear_selection()

    def _node(self, desk: Desk, found: TextNodes, number: int, node: LineNode) -> None:
        size = imgui.get_font_size()
        ed.begin_node(ed.NodeId(self._canvas.id("node", node.name)))
        imgui.push_id(node.name or "##last")
        left = imgui.get_cursor_pos_x()
        imgui.begin_group()
        self._picture(desk, found, number)
        imgui.same_line(0, 0.4 * size)
        imgui.begin_group()
        if node.name:
            said.own_text(node.name)
        else:
            said.text_unformatted("the texture")
        _coloured(node.head or " ", text_colours.FUNCTION)
        imgui.end_group()
        imgui.end_group()
        if node.name:
            imgui.same_line()
            imgui.set_cursor_pos_x(left + (node_width(node) - 1.5) * size)  # of the canvas, not of the group
            self._canvas.pin((node.name, OUT), ed.PinKind.output, f"{node.name} {OUT}", _GIVES)
        for n, row in enumerate(node.rows):
            self._row(node, n, row)
        imgui.pop_id()
        ed.end_node()

    def _picture(self, desk: Desk, found: TextNodes, number: int) -> None:
        """Draws how a line looks; a click looks at it alone."""
        state = desk.workshop
        size, last = _PICTURE * imgui.get_font_size(), len(found.nodes) - 1
        alone = number == (state.line if 0 <= state.line <= last else last)
        if imgui.invisible_button("##picture", size):
            state.line = -1 if number == last or state.line == number else number
        self._canvas.note(f"node {number + 1}", _SOLO)
        painter, at, end = imgui.get_window_draw_list(), imgui.get_item_rect_min(), imgui.get_item_rect_max()
        shown = line_picture(desk, found.nodes[number].name)
        if shown is not None:
            picture, u, v = shown
            middle, half = (u.y + v.y) / 2, (v.y - u.y) * size.y / size.x / 2
            u, v = ImVec2(u.x, middle - half), ImVec2(v.x, middle + half)
            painter.add_image_rounded(picture, at, end, u, v, -1 & 0xFFFFFFFF, 3)
        if alone:
            painter.add_rect(at - ImVec2(1, 1), end + ImVec2(1, 1), theme.packed(theme.look.accent), 3, thickness=1.5)

    def _row(self, node: LineNode, number: int, row: NodeRow) -> None:
        size, at = imgui.get_font_size(), 0
        if row.label:
            imgui.align_text_to_frame_padding()
            _toned(row.label, theme.look.quiet)
            imgui.same_line(0, 0.4 * size)
        for part in broken_rows(row):
            for m, piece in enumerate(part):
                if m:
                    imgui.same_line(0, 0.3 * size if isinstance(piece, Slot) or piece not in "(),)" else 0.0)
                if isinstance(piece, Slot):
                    self._slot(piece, (node.name, number, at), row.label)
                else:
                    imgui.align_text_to_frame_padding()
                    said.own_text(piece)
                at += 1

    def _slot(self, slot: Slot, key: tuple[str, int, int], label: str) -> None:
        """Draws what can be set; `key`: its line, row and place there."""
        size, name = imgui.get_font_size(), " ".join((key[0] or "texture", label, f"{key[2] + 1}")).replace("  ", " ")
        imgui.push_id(f"{key[1]} {key[2]}")
        if not slot.set_:
            imgui.align_text_to_frame_padding()
            self._canvas.pin(key, ed.PinKind.input, f"into {name}", _TAKES)
            imgui.same_line(0, 0.15 * size)
        if slot.kind == "number":
            imgui.set_next_item_width(NUMBER_WIDE * size)
            whole, value = label in _WHOLE, slot.number
            speed = 0.05 if whole else max(abs(value), 0.2) * 0.01
            changed, value = imgui.drag_float("##number", value, speed, 0.0, 0.0, "%.4g")
            self._canvas.note(name, _NUMBER)
            if changed:
                self._replace(slot, f"{round(value) if whole else value:.4g}")
        elif slot.kind == "colour":
            self._colour(slot, name)
        else:
            imgui.align_text_to_frame_padding()
            _coloured(slot.text, text_colours.OWN_NAME if slot.source else text_colours.PLACE)
        imgui.pop_id()

    def _colour(self, slot: Slot, name: str) -> None:
        side, rgb = imgui.get_frame_height(), from_hex(slot.text[:7])
        if imgui.color_button("##colour", theme.vec(rgb), imgui.ColorEditFlags_.no_tooltip, ImVec2(1.4 * side, side)):
            imgui.open_popup("pick")
        self._canvas.note(name, _COLOUR)
        picked = colour_popup("pick", rgb)
        if picked is not None:
            self._replace(slot, to_hex(picked) + slot.text[7:])

    def _replace(self, slot: Slot, told: str) -> None:
        if self._found is not None and self._told == self._found.text:
            self._told = self._found.replaced(slot, told)

    def _links(self, found: TextNodes) -> None:
        colour, canvas = theme.vec(theme.look.soft), self._canvas
        for _, slot, key in slots_of(found):
            if slot.source:
                start, end = canvas.id("pin", slot.source, OUT), canvas.id("pin", *key)
                ed.link(ed.LinkId(canvas.id("link", *key)), ed.PinId(start), ed.PinId(end), colour, 1.6)

    def _connect(self, found: TextNodes) -> None:
        """Does what a link that is drawn asks for."""
        start, end = ed.PinId(), ed.PinId()
        if ed.begin_create(theme.vec(theme.look.accent), 2.0):
            if ed.query_new_link(start, end):
                text = self._linked(found, [self._canvas.key(pin.id())[1:] for pin in (start, end)])
                if text is None:
                    ed.reject_new_item(theme.vec(theme.look.warn), 2.0)
                    self._canvas.hint = _REFUSED
                elif ed.accept_new_item(theme.vec(theme.look.accent), 3.0):
                    self._told = text
            ed.end_create()

    def _linked(self, found: TextNodes, keys: list[tuple[Hashable, ...]]) -> str | None:
        out = next((key for key in keys if key[1:] == (OUT,)), None)
        slot = next((slot for _, slot, key in slots_of(found) if key in keys), None)
        return None if slot is None or out is None else found.linked(slot, str(out[0]))


def _coloured(text: str, kind: str) -> None:
    """Draws a text of the language in the colour of what it is."""
    _toned(text, text_colours.tone(text_colours.TextPart(0, "", kind)))


def _toned(text: str, colour: tuple[float, float, float]) -> None:
    imgui.push_style_color(imgui.Col_.text, theme.vec(colour))
    said.own_text(text)
    imgui.pop_style_color()
