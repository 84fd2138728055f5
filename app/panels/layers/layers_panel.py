"""The layer panel: a list like a stack of sheets, the top-most first."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.stack.chosen_layer import choose_layer
from app.desk.stack.many_rows import chosen_rows, dropped_rows, post_together, reach_row, toggle_row
from app.desk.stack.row_colours import colour_rows
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.fitting import ended
from app.panels.layers import layer_row, mask_picture
from app.panels.layers.layer_sliders import LayerSliders
from engine.painting import commands as c
from engine.studio.requests import Do
from engine.studio.results import LayerRow, Ready

_PAYLOAD = "layer"
_MOUSE = "Drag to reorder, double-click to rename, right-click for more\nCtrl or Shift: choose several"
_FIELD = 6.0  # of a letter: the width of the search field
_ALSO = 0.6  # how strongly a row is lit that is chosen along with the active one
_USUAL = "src-over", "Normal"  # the blend mode of a new layer, and its title


class LayersPanel:
    """Remembers which name is being edited and which groups are folded."""

    def __init__(self) -> None:
        self._editing: str | None = None
        self._text = ""
        self._focus = False
        self._find = ""
        self._folded: set[str] = set()
        self._sliders = LayerSliders()
        self._active: str | None = None
        self._reveal: str | None = None  # a row that is to be brought into sight

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        corner, room = imgui.get_cursor_pos(), imgui.get_content_region_avail().x
        if not w.section("Layers", shared=True):
            return
        self._header(desk, corner.x + room)
        rows = desk.known.scene.layers if desk.known.scene else ()
        imgui.begin_disabled(not desk.known.ready)
        self._settings(desk, desk.known.active)
        self._list(desk, rows)
        self._buttons(desk)
        imgui.end_disabled()

    def _header(self, desk: Desk, right: float) -> None:
        """Draws the field and the locks at the right end of the header just drawn."""
        scale, below = imgui.get_style().font_scale_dpi, imgui.get_cursor_pos()
        side, gap = imgui.get_text_line_height() * 1.25, 4 * scale
        wide = imgui.get_font_size() * _FIELD
        imgui.same_line(right - wide - 2 * (side + gap))
        imgui.set_cursor_pos_y(imgui.get_cursor_pos_y() - 2)
        imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(6, 1) * scale)
        imgui.set_next_item_width(wide)
        flags = imgui.InputTextFlags_.escape_clears_all
        _, self._find = said.input_text_with_hint("##find layer", "Find", self._find, flags)
        imgui.pop_style_var()
        w.named("find layer")
        w.tooltip("Only layers with this in their names; Escape shows all again", beside=True)
        self._locks(desk, desk.known.active, side, gap)
        imgui.set_cursor_pos(below)

    def _locks(self, desk: Desk, row: LayerRow | None, side: float, gap: float) -> None:
        """Draws what of the active layer can be locked."""
        top = imgui.get_item_rect_min().y - imgui.get_style().font_scale_dpi
        imgui.begin_disabled(row is None or not desk.known.ready)
        locked, alpha = bool(row and row.locked), bool(row and row.alpha_locked)
        imgui.same_line(0, gap)
        imgui.set_cursor_screen_pos(ImVec2(imgui.get_cursor_screen_pos().x, top))
        hint = "Keep transparency: paint only where there is paint"
        if w.icon_button("alpha", icons.ALPHA_LOCK, hint, on=alpha, size=side) and row:
            desk.post(Do(c.SetLayer(row.name, alpha_locked=not alpha)))
        imgui.same_line(0, gap)
        imgui.set_cursor_screen_pos(ImVec2(imgui.get_cursor_screen_pos().x, top))
        sign, hint = icons.LOCK if locked else icons.UNLOCK, "Lock the layer against painting"
        if w.icon_button("lock", sign, hint, on=locked, size=side) and row:
            desk.post(Do(c.SetLayer(row.name, locked=not locked)))
        imgui.end_disabled()

    def _settings(self, desk: Desk, row: LayerRow | None) -> None:
        """Draws how it mixes and how opaque it is, on one line: the rows have what is left of the panel."""
        imgui.begin_disabled(row is None)
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        options = blend_titles(desk.known.tables)
        blend = w.choice(
            "blend", row.blend if row else _USUAL[0], options, "How the layer mixes with those below", half
        )
        if row and blend:
            desk.post(Do(c.SetLayer(row.name, blend=blend)))
        imgui.same_line()
        self._sliders.draw_opacity(desk, row)
        self._sliders.draw_land(desk, row)
        imgui.end_disabled()

    def _list(self, desk: Desk, rows: tuple[LayerRow, ...]) -> None:
        line = imgui.get_frame_height() + 3 * desk.scale
        room = imgui.get_content_region_avail().y - imgui.get_frame_height_with_spacing() - 2 * desk.scale
        height = max(room, 3.3 * line)
        imgui.push_style_color(imgui.Col_.child_bg, theme.vec(theme.look.field))
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(4 * desk.scale, 3 * desk.scale))
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(3 * desk.scale, 3 * desk.scale))
        imgui.begin_child("list", ImVec2(0, height), imgui.ChildFlags_.always_use_window_padding)
        self._follow(desk, rows)
        unfolded = self._unfolded(rows)
        clipper = imgui.ListClipper()
        clipper.begin(len(unfolded), imgui.get_frame_height_with_spacing())
        for n, row in enumerate(unfolded):
            if row.name in (self._editing, self._reveal):
                clipper.include_item_by_index(n)
        while clipper.step():
            for row in unfolded[clipper.display_start : clipper.display_end]:
                imgui.push_id(row.name)
                self._row(desk, row)
                if row.name == self._reveal:
                    imgui.internal.scroll_to_item()
                    self._reveal = None
                imgui.pop_id()
        if not rows:
            imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.quiet))
            imgui.indent(3 * desk.scale)
            said.text_wrapped("No layer yet: the first stroke makes one.")
            imgui.unindent(3 * desk.scale)
            imgui.pop_style_color()
        imgui.end_child()
        imgui.pop_style_var(2)
        imgui.pop_style_color()

    def _follow(self, desk: Desk, rows: tuple[LayerRow, ...]) -> None:
        """Brings another active layer into sight, and unfolds the groups around it."""
        active = desk.known.scene.active if desk.known.scene else None
        if active == self._active:
            return
        self._active = self._reveal = active
        parents = {row.name: row.parent for row in rows}
        inside = None if active is None else parents.get(active)
        while inside is not None:
            self._folded.discard(inside)
            inside = parents.get(inside)

    def _unfolded(self, rows: tuple[LayerRow, ...]) -> list[LayerRow]:
        """Returns the rows that no folded group holds, or those with the names that are searched."""
        if self._find.strip():
            return [row for row in rows if self._find.strip().lower() in row.name.lower()]
        if not self._folded:
            return list(rows)
        found: list[LayerRow] = []
        hidden_below: int | None = None
        for row in rows:
            if hidden_below is None or row.depth <= hidden_below:
                hidden_below = row.depth if row.group and row.name in self._folded else None
                found.append(row)
        return found

    def _row(self, desk: Desk, row: LayerRow) -> None:
        side = imgui.get_frame_height()
        layer_row.row_colour(desk, row)
        layer_row.eye(desk, row)
        imgui.same_line()
        imgui.dummy(ImVec2(row.depth * side * 0.55, 0))
        imgui.same_line(0, 0)
        if row.group:
            folded = row.name in self._folded
            if w.icon_button("fold", icons.GROUP if folded else icons.GROUP_OPEN, ""):
                self._folded ^= {row.name}
            w.tooltip("Fold or unfold the group", beside=True)
            imgui.same_line(0, 2 * desk.scale)
        if row.shows is not None:
            source = row.shows.name
            if w.icon_button("source", icons.LINK, "", enabled=source is not None) and source is not None:
                choose_layer(desk, source)
            w.tooltip(f"Shows {source}: click to go there" if source else "Shows the whole painting", beside=True)
            imgui.same_line(0, 2 * desk.scale)
        layer_row.small_picture(desk, row)
        if row.masked:
            mask_picture.draw(desk, row)
            imgui.same_line(0, 4 * desk.scale)
        if self._editing == row.name:
            self._name_field(desk, row)
        else:
            self._name(desk, row)

    def _name(self, desk: Desk, row: LayerRow) -> None:
        active = desk.known.scene is not None and desk.known.scene.active == row.name
        told = (
            (row.clip, icons.CLIP),
            (row.wrap is not None, icons.WRAP),
            (row.reference, icons.REFERENCE),
            (row.height, icons.MOUNTAIN),
            (row.locked, icons.LOCK),
            (row.alpha_locked, icons.ALPHA_LOCK),
        )
        signs = "".join(f" {sign}" for shown, sign in told if shown)
        quiet = theme.look.text if row.visible else theme.look.quiet
        imgui.push_style_color(imgui.Col_.text, theme.vec(quiet))
        imgui.push_style_var(imgui.StyleVar_.selectable_text_align, ImVec2(0.0, 0.5))
        flags = imgui.SelectableFlags_.allow_double_click
        shown = ended(row.name, imgui.get_content_region_avail().x - said.calc_text_size(signs).x)
        imgui.push_style_color(imgui.Col_.header, theme.vec(theme.look.accent_soft, 1.0 if active else _ALSO))
        if imgui.selectable(
            f"{shown}{signs}###name", active or row.name in desk.stack.many, flags, ImVec2(0, imgui.get_frame_height())
        )[0]:
            self._clicked(desk, row, active)
        imgui.pop_style_var()
        imgui.pop_style_color(2)
        w.named(row.name)
        if layer_row.menu(desk, row):
            self._editing, self._text, self._focus = row.name, row.name, True
        self._drag(desk, row)
        about = "" if row.opacity >= 1 else f"{row.opacity * 100:.0f} %  "
        blend = dict(blend_titles(desk.known.tables)).get(row.blend, row.blend)
        whole = f"{row.name}\n" if shown != row.name else ""
        about += "Masked  " if row.masked else ""
        about += "Reference: not exported  " if row.reference else ""
        about += "Height of the land: not exported  " if row.height else ""
        w.tooltip(f"{whole}{about}{blend}\n{_MOUSE}", beside=True)

    def _clicked(self, desk: Desk, row: LayerRow, active: bool) -> None:
        if imgui.is_mouse_double_clicked(0):
            self._editing, self._text, self._focus = row.name, row.name, True
        elif imgui.get_io().key_ctrl:
            toggle_row(desk, row)
        elif imgui.get_io().key_shift:
            reach_row(desk, self._unfolded(desk.known.scene.layers if desk.known.scene else ()), row)
        elif not active or desk.stack.many:
            desk.stack.many = set()
            choose_layer(desk, row.name)
        elif desk.masks.on(row):
            desk.masks.end(desk.post)

    def _name_field(self, desk: Desk, row: LayerRow) -> None:
        imgui.set_next_item_width(-1)
        if self._focus:
            imgui.set_keyboard_focus_here()
            self._focus = False
        done, self._text = imgui.input_text(
            "##rename", self._text, imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
        )
        if imgui.is_item_deactivated():
            name = self._text.strip()
            if (done or imgui.is_item_deactivated_after_edit()) and name and name != row.name:
                desk.post(Do(c.RenameLayer(row.name, name)))
                if row.name in desk.stack.colours:
                    colour_rows(desk, [name], desk.stack.colours[row.name])
            self._editing = None

    def _drag(self, desk: Desk, row: LayerRow) -> None:
        if imgui.begin_drag_drop_source():
            names = [r.name for r in desk.known.scene.layers] if desk.known.scene else []
            imgui.set_drag_drop_payload_py_id(_PAYLOAD, names.index(row.name))
            others = len(chosen_rows(desk)) - 1 if row.name in desk.stack.many else 0
            said.text_unformatted(f"{row.name} and {others} more" if others else row.name)
            imgui.end_drag_drop_source()
        if imgui.begin_drag_drop_target():
            top, bottom = imgui.get_item_rect_min().y, imgui.get_item_rect_max().y
            where = (imgui.get_io().mouse_pos.y - top) / max(1.0, bottom - top)
            payload = imgui.accept_drag_drop_payload_py_id(_PAYLOAD)
            if payload is not None and desk.known.scene:
                rows = desk.known.scene.layers
                moved = rows[int(payload.data_id)]
                together = chosen_rows(desk) if moved.name in desk.stack.many else [moved]
                post_together(desk, dropped_rows(rows, together, row, where))
            imgui.end_drag_drop_target()

    def _buttons(self, desk: Desk) -> None:
        names = (
            ("add_layer", icons.ADD),
            ("add_group", icons.GROUP),
            ("duplicate", icons.COPY),
            ("show_again", icons.LINK),
            ("independent", icons.UNLINK),
            ("mask_full", icons.MASK),
            ("raise", icons.UP),
            ("lower", icons.DOWN),
            ("merge_down", icons.MERGE),
            ("remove", icons.DELETE),
        )
        left, side = imgui.get_cursor_pos_x(), imgui.get_frame_height()
        step = (imgui.get_content_region_avail().x - side) / (len(names) - 1)  # all in sight, however narrow it is
        for i, (name, icon) in enumerate(names):
            if i:
                imgui.same_line(left + i * min(step, side + imgui.get_style().item_spacing.x))
            action = actions.ACTIONS[name]
            if w.icon_button(name, icon, actions.tip(name), enabled=action.when(desk)):
                actions.perform(desk, action)


def blend_titles(tables: Ready) -> list[tuple[str, str]]:
    """Returns the name and the title of each blend mode; before the engine is there, of the usual one alone."""
    return [(name, title) for name, title, _ in tables.blends] or [_USUAL]
