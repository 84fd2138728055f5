"""The dialog of a picture that is brought in: what is to become of it."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import previews
from app.desk.desk import Desk
from app.desk.examples import example_work
from app.desk.outside import bringing, bringing_layers, doctoring, ground_maps, pictured
from app.desk.previews import PAINTING, FileRow
from app.language import said
from app.panels.controls import widgets as w
from app.tools.filling_gestures import drop_texture
from engine.brush.parts import Component

_SIDE = 150.0  # of the small picture, points


class BringIn:
    """Asks whether a picture is to be a layer, a texture, an example, or opened by itself."""

    title = "Bring in a picture"

    def __init__(self, desk: Desk) -> None:
        assert desk.asked.bringing is not None
        self._path, self._place = desk.asked.bringing
        self._refined, self._strength = False, 1.0

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is answered."""
        self._picture(desk)
        imgui.same_line()
        imgui.begin_group()
        said.text_unformatted(self._path.name if len(self._path.name) < 40 else f"{self._path.name[:38]}…")
        imgui.spacing()
        done = self._of_layers(desk) if bringing.is_layered(self._path) else self._ways(desk)
        imgui.end_group()
        return not done

    def _ways(self, desk: Desk) -> bool:
        wide = imgui.get_font_size() * 15
        if bringing.is_map(self._path):
            return self._as_ground(desk, wide) or w.text_button("Cancel", "Leave the painting as it is", width=wide)
        if w.default_button("Layer", "Lay it on a layer of its own, where it was dropped; then move it", width=wide):
            bringing.as_layer(desk, self._path, self._place, self._strength if self._refined else None)
            return True
        self._extrapolation(wide)
        if w.text_button("Reference", "To look at and pick from while you paint; never exported", width=wide):
            bringing.as_reference(desk, self._path, self._place)
            return True
        if self._as_ground(desk, wide):
            return True
        if w.text_button("Texture", "Paint with it: it joins the ink", width=wide):
            pictured.from_file(desk, self._path)
            return True
        if w.text_button("Fill", "Fill the region where it was dropped with it", width=wide):
            texture = pictured.texture_of(desk, self._path)
            at = desk.view.to_screen(self._place)
            drop_texture(desk, (texture,), Component(texture.name, 1.0, "#ffffff"), *at)
            return True
        if w.text_button("Example", "Paint with more of the same, with its own rim", width=wide):
            desk.strip, desk.panels = "examples", True
            example_work.add(desk, self._path)
            return True
        if w.text_button(
            "What suits it?", "Tries all makers of textures on it, and tells which one suits it", width=wide
        ):
            doctoring.ask_doctor(desk, self._path)
            return True
        if w.text_button("Open", "Leave this painting, and open the picture by itself", width=wide):
            path = self._path
            desk.guard(lambda: desk.open(path))
            return True
        return w.text_button("Cancel", "Leave the painting as it is", width=wide)

    def _extrapolation(self, wide: float) -> None:
        """Shows whether the layer goes on below the picture's pixels, and how much."""
        hint = "Its layer goes on below its own pixels, as they let expect: sharp edges, and grain where it has some"
        _, self._refined = w.tick("Extrapolate", self._refined, hint)
        imgui.begin_disabled(not self._refined)
        imgui.begin_child("strength", ImVec2(wide, imgui.get_frame_height()))
        hint = "How much of the detail is added"
        changed, value = w.slider("Detail", self._strength * 100, (0.0, 100.0), hint, form="%.0f%%")
        self._strength = value / 100 if changed else self._strength
        imgui.end_child()
        imgui.end_disabled()

    def _as_ground(self, desk: Desk, wide: float) -> bool:
        chosen = w.text_button("Ground", "A height map: it becomes ground of the land", width=wide)
        if chosen:
            ground_maps.read_map(desk, self._path, self._place)
        return chosen

    def _of_layers(self, desk: Desk) -> bool:
        wide, ours = imgui.get_font_size() * 15, self._path.suffix.lower() == PAINTING
        said.text_disabled(
            "What Inkfall painted comes in exactly, other files as pictures"
            if ours
            else "Text and shapes come in as pictures"
        )
        imgui.spacing()
        if w.default_button("Group", "Bring its layers in as a group, where it was dropped; then move it", width=wide):
            bringing_layers.as_group(desk, self._path, self._place)
            return True
        if ours and w.text_button("Group in its place", "Its layers lie where they do in their own file", width=wide):
            bringing_layers.as_group(desk, self._path, None)
            return True
        if ours and w.text_button("Open", "Leave this painting, and open the other one", width=wide):
            path = self._path
            desk.guard(lambda: desk.open(path))
            return True
        return w.text_button("Cancel", "Leave the painting as it is", width=wide)

    def _picture(self, desk: Desk) -> None:
        side = _SIDE * desk.scale
        row = FileRow(self._path.name, False)
        desk.previews(self._path.parent, [row], round(side))
        corner = imgui.get_cursor_screen_pos()
        imgui.dummy(ImVec2(side, side))
        shown = desk.pictures.get(previews.ident(self._path.parent, row))
        painter = imgui.get_window_draw_list()
        if shown is not None:
            painter.add_image(shown, corner, ImVec2(corner.x + side, corner.y + side))
            return
        sign = said.calc_text_size(icons.IMAGE)
        middle = ImVec2(corner.x + (side - sign.x) / 2, corner.y + (side - sign.y) / 2)
        said.add_text(painter, middle, theme.packed(theme.look.quiet), icons.IMAGE)
