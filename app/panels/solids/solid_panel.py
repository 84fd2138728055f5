"""The panel of solids: a material on an object that is turned by hand, and a slice through it as ink."""

from __future__ import annotations

from pathlib import PurePath

from imgui_bundle import ImVec2, imgui
from immutables import Map

from app import icons, theme
from app.desk.desk import Desk
from app.desk.hand import go_on_with_brush, radius_of
from app.desk.lab_state import with_texture
from app.desk.outside import pictured
from app.desk.solids.cube_work import ListCubes
from app.desk.solids.solid_state import DEEPEST_SLICE, OBJECTS, SOLID_SCALES
from app.desk.solids.solid_work import Carve, Rest, pictures_at_rest
from app.desk.solids.touching_up import ObjectSeen
from app.language import said
from app.panels.controls import widgets as w
from app.panels.panel import Painting, Panel
from app.tools.solid_gestures import touch_up
from engine.painting.commands import DefineTexture
from engine.painting.layering.touch_command import CleanSolid
from engine.solids.material_sliders import MATERIALS
from engine.studio.requests import Do

_DEGREES = 0.45  # for each pixel of a drag
_UNIT = 256  # pixels of the slice that is ink
_OWN, _LONGEST = "", 24  # what asks for a mesh; letters of its name
_DRAWN, _WRAPPED = "drawn", "wrapped"
_ASKED = {_OWN: "solid cube", _DRAWN: "drawn cube", _WRAPPED: "wrapped picture"}  # dialogs, by what asks for them


class SolidPanel(Panel):
    """Draws the strip."""

    def wants(self, desk: Desk, now: float) -> None:
        """Has carved what is set and not yet shown, and drawn what rests."""
        state, scene = desk.solid, desk.known.scene
        if state.stroke is not None:
            return
        state.touches = scene.touches.get(state.solid_name, ()) if scene is not None and not state.wrapped else ()
        side, seen = state.lacks, state.seen
        if state.cubes is None:
            state.cubes = ()
            desk.work(ListCubes())
        if side and not state.busy:
            state.busy = True
            desk.work(Carve(state.made, state.name, side, state.carved, state.touches))
        elif seen is not None and state.resting is None and (state.rest is None or state.rest.of != seen):
            state.resting = seen
            desk.work(Rest(seen, pictures_at_rest(seen)))

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """Returns a stroke on the object; beside it, a drag turns it."""
        state = desk.solid
        left, top = state.corner
        aspect = state.aspect if state.painting else None
        if aspect is None or not (0.0 <= x - left < state.room[0] and 0.0 <= y - top < state.room[1]):
            return None
        return None if ObjectSeen(aspect).hit(x - left, y - top) is None else touch_up

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        room = imgui.get_content_region_avail()
        self._object(desk, (0.62 * room.x, room.y))
        imgui.same_line()
        imgui.begin_child("settings", ImVec2(0, 0))
        imgui.begin_child("sliders", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        self._settings(desk)
        imgui.end_child()
        self._use(desk)
        imgui.end_child()
        self._welcome(desk)

    def _object(self, desk: Desk, size: tuple[float, float]) -> None:
        """Draws the object; a drag turns it, the wheel changes the solid's scale."""
        state = desk.solid
        state.room = max(1, int(size[0])), max(1, int(size[1]))
        corner = imgui.get_cursor_screen_pos()
        state.corner = corner.x, corner.y
        buttons = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
        imgui.invisible_button("object", ImVec2(*size), buttons)
        w.named("object")
        if not state.painting:
            w.tooltip("Drag to turn it; the wheel scales the solid")
        state.turning = imgui.is_item_active()
        if state.turning:
            moved = imgui.get_io().mouse_delta
            state.drag(_DEGREES * moved.x / desk.scale, _DEGREES * moved.y / desk.scale)
        wheel = imgui.get_io().mouse_wheel if imgui.is_item_hovered() else 0.0
        if wheel:
            state.scale = min(max(state.scale * 1.12**wheel, SOLID_SCALES[0]), SOLID_SCALES[1])
        painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + size[0], corner.y + size[1])
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), imgui.get_style().frame_rounding)
        shown = desk.pictures.get("solid")
        if shown is not None and state.carved is not None:
            painter.add_image(shown, corner, ImVec2(corner.x + state.room[0], corner.y + state.room[1]))
        if state.painting and (imgui.is_item_hovered() or state.stroke is not None):
            at, radius = imgui.get_io().mouse_pos, max(radius_of(desk.hand, desk.pointer.eraser), 1.5)
            painter.add_circle(at, radius + 1.0, theme.packed((0.0, 0.0, 0.0)), 0, 1.0)
            painter.add_circle(at, radius, theme.packed((1.0, 1.0, 1.0)), 0, 1.0)
        if state.lacks or state.growing is not None:
            grown = f"{icons.WAIT} growing… {state.growing.done:.0%}" if state.growing is not None else ""
            text = grown or f"{icons.WAIT} carving…"
            at = ImVec2(corner.x + 10 * desk.scale, end.y - 26 * desk.scale)
            said.add_text(painter, at, theme.packed(theme.look.quiet), text)

    def _touches(self, desk: Desk) -> None:
        """Chooses between turning the object and painting on it; takes the paint off."""
        state, wide = desk.solid, imgui.get_content_region_avail().x
        side = imgui.get_frame_height()
        hint = "The brush paints on the object, into the solid; the right button, or a drag beside it, turns it"
        imgui.begin_disabled(state.wrapped)
        if w.lit_button(f"{icons.BRUSH} Paint on it", hint, state.painting, wide - side - 2 * desk.scale):
            state.painting = not state.painting
        imgui.end_disabled()
        imgui.same_line(0, 2 * desk.scale)
        hint = f"Take all paint off the {state.solid_name}; Undo brings it back"
        if w.icon_button("clean", icons.DELETE, hint, enabled=bool(state.touches), size=side):
            desk.post(Do(CleanSolid(state.solid_name)))

    def _settings(self, desk: Desk) -> None:
        state = desk.solid
        hints = {name: row.about for name, row in MATERIALS.items()}
        options = [(name, name.capitalize(), hints[name].capitalize()) for name in MATERIALS]
        state.material = w.segments("material", state.material, options) or state.material
        self._cubes(desk)
        side = imgui.get_frame_height()
        wide = imgui.get_content_region_avail().x - side - 2 * desk.scale
        objects = [(name, name.capitalize()) for name in OBJECTS]
        if state.name not in OBJECTS:
            objects.append((state.name, PurePath(state.name).stem[:_LONGEST]))
        objects.append((_OWN, "A mesh of your own…"))
        chosen = w.choice("object shown", state.name, objects, "The object that is made of it", wide)
        if chosen == _OWN:
            desk.asked.show("solid mesh")
        elif chosen:
            state.name = chosen
        imgui.same_line(0, 2 * desk.scale)
        carved = state.material in MATERIALS
        if w.icon_button("throw", icons.DICE, "The same from another block", enabled=carved, size=side):
            state.seed = (state.seed * 31 + 17) % 99991
        self._touches(desk)
        for name, slider in MATERIALS[state.material].sliders.items() if carved else ():
            value = state.values.get(state.material, {}).get(name, slider.usual)
            form = "%.0f" if slider.whole or slider.high >= 20.0 else "%.2f"
            label, hint = name.capitalize(), slider.about[0].upper() + slider.about[1:]
            changed, value = w.slider(label, value, (slider.low, slider.high), hint, form=form)
            if changed:
                state.set(name, float(round(value)) if slider.whole else round(value, 3))
        hint = "How much of the block the object takes: smaller shows it larger"
        _, state.scale = w.slider("Scale", state.scale, SOLID_SCALES, hint, curved=True)
        if not state.wrapped:
            _, state.depth = w.slider("Slice", state.depth, (0.0, DEEPEST_SLICE), "How deep the block is cut for ink")

    def _cubes(self, desk: Desk) -> None:
        """Chooses among cubes that are kept, or asks for another."""
        state, wide = desk.solid, imgui.get_content_region_avail().x
        if state.growing is not None:
            if w.text_button("Stop growing", "Goes on with the solid that is shown", width=wide):
                state.growing = None
            return
        kept = [(path, PurePath(path).stem[:_LONGEST]) for path in (*(state.cubes or ()), *state.maps)]
        if state.material not in MATERIALS and state.material not in dict(kept):
            kept.append((state.material, PurePath(state.material).stem[:_LONGEST]))
        shown = "Like a picture…" if state.material in MATERIALS else state.material
        hint = "Grown from a picture, drawn out of one in layers, wrapped around the object, or a cube from a file"
        asked = [(_OWN, "From a picture or a cube…"), (_DRAWN, "Drawn out of a picture…")]
        asked.append((_WRAPPED, "Wrapped around it…"))
        chosen = w.choice("cube", shown, [*kept, *asked], hint, wide)
        if chosen in _ASKED:
            desk.asked.show(_ASKED[chosen])
        elif chosen:
            state.material = chosen

    def _use(self, desk: Desk) -> None:
        state = desk.solid
        text = f"{icons.WAIT} cutting…" if state.awaited else f"{icons.BRUSH} Use as ink"
        hint = "Cuts the block across the way you look at it: the slice becomes the brush's ink, and tiles"
        ready = not state.awaited and not state.wrapped
        if w.accent_button(text, hint, enabled=ready, width=imgui.get_content_region_avail().x):
            material, seed, values = state.made
            state.awaited = pictured.free_texture_name(desk, PurePath(material).stem)
            named = "material" if material in MATERIALS else "cube"
            given = {named: material, "seed": seed, "normal": state.normal(), "unit": _UNIT}
            given |= {"depth": round(state.depth, 3)} | ({"values": Map(values)} if values else {})
            given |= {"touches": state.solid_name} if state.touches else {}
            desk.post(Do(DefineTexture(state.awaited, "solid", Map(given))))

    def _welcome(self, desk: Desk) -> None:
        """A slice that was asked for is a texture of the painting now: the brush gets it."""
        name = desk.solid.awaited
        if name and desk.known.scene is not None and name in desk.known.scene.textures:
            desk.solid.awaited = ""
            desk.hand.take(with_texture(desk.hand.brush, "ink", name))
            go_on_with_brush(desk.hand)
