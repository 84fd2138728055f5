"""The workshop: a text, its pictures, its sliders, and what is known of it, all at once (Perlin & Velho 1995, 8.2)."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.desk.examples.following import Following
from app.desk.hand import go_on_with_brush
from app.desk.lab_state import with_texture
from app.desk.outside import pictured
from app.desk.workshop.workshop_state import WRITTEN
from app.desk.workshop.workshop_work import TEXTS, ReadText
from app.language import said
from app.panels.controls import widgets as w
from app.panels.panel import Panel
from app.panels.workshop.keeping_texts import KeepText
from app.panels.workshop.line_marks import LineMarks
from app.panels.workshop.node_view import NodeView
from app.panels.workshop.text_field import FieldShown, TextField
from app.panels.workshop.texture_view import TextureView
from app.panels.workshop.workshop_settings import draw_settings
from app.panels.workshop.workshop_texts import draw_texts
from engine.brush.settings import Brush
from engine.studio.requests import Do, Swatch
from engine.studio.workshop.workshop_records import (
    WorkshopMistake,
    WorkshopScene,
    WorkshopValues,
    WorkshopWords,
)

_STROKE = (112, 48)  # points of the picture of a stroke
_TOLD = 3  # rows of what is told below the text
_OF_TEXT = "Click a picture to look at a line alone; Ctrl+Space tells what may be written"
_OF_NODES = (
    "Drag from a right end into another line; a right click adds a line, removes one or cuts a link; the wheel zooms"
)
_SETTLE = 0.4  # seconds from one picture of a stroke to the next
_USES = (
    ("ink", icons.BRUSH, "Use as ink", "The brush paints with this texture"),
    ("density", "", "Dry brush", "The texture thins the stroke like bristles or dry paint"),
    ("grain", "", "Paper", "The texture becomes the surface that the brush feels"),
)


class WorkshopPanel(Panel):
    """Draws the strip."""

    def __init__(self) -> None:
        self._field, self._marks, self._view = TextField(), LineMarks(), TextureView()
        self._keep = KeepText()
        self._nodes, self._written_as = NodeView(), ""  # what the field had when nodes were drawn last
        self._following, self._first = Following(_SETTLE), True
        self.hears = {WorkshopScene: _heard, WorkshopWords: _words, WorkshopValues: _values}

    def wants(self, desk: Desk, now: float) -> None:
        """Asks for what is looked at, and when it rests for a stroke with the texture."""
        state = desk.workshop
        state.ask(desk.post)
        wanted = state.definition(WRITTEN) if state.right else None
        if wanted is not None and self._following.due((wanted, desk.scale), now):
            brush = with_texture(Brush(18.0 * desk.scale, hardness=0.8), "ink", WRITTEN)
            size = int(_STROKE[0] * desk.scale), int(_STROKE[1] * desk.scale)
            desk.post(Swatch("workshop stroke", brush, size, textures=(wanted,), soon=True))

    def bar(self, desk: Desk) -> None:
        """Draws which texts there are, and undo, in the strip's title line."""
        imgui.same_line(0, 14 * desk.scale)
        draw_texts(desk, self._field, self._keep)

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        state, room, gap = desk.workshop, imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        if state.put:
            self._field.put(state.text, self._first)
            state.put = self._first = False
        settings = min(0.22 * room.x, 260 * desk.scale)
        view = min(0.31 * room.x, 1.2 * room.y)
        imgui.begin_child("written", ImVec2(room.x - settings - view - 2 * gap, 0))
        self._written(desk)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("texture", ImVec2(view, 0))
        self._view.draw(desk)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("settings", ImVec2(0, 0))
        imgui.begin_child("sliders", ImVec2(0, -2 * imgui.get_frame_height_with_spacing()))
        draw_settings(desk)
        imgui.end_child()
        self._uses(desk)
        imgui.end_child()
        self._welcome(desk)

    def dropped(self, desk: Desk, path: Path, x: float, y: float) -> bool:
        """A text is opened."""
        if path.suffix.lower() not in TEXTS:
            return False
        desk.work(ReadText(path))
        return True

    def _written(self, desk: Desk) -> None:
        """Draws the text, and below it what is wrong, or what the function at the caret does."""
        state, room = desk.workshop, imgui.get_content_region_avail()
        line, gap = imgui.get_text_line_height(), imgui.get_style().item_spacing.y
        mistake = state.scene.mistake if state.scene.text == state.text else None
        self._marks.begin(desk)
        size = ImVec2(room.x, room.y - _TOLD * line - 2 * gap)
        if state.nodes:
            self._as_nodes(desk, size)
        else:
            textures = desk.known.scene.textures if desk.known.scene is not None else ()
            shown = FieldShown(mistake, state.words, self._marks.draw, self._marks.note, textures)
            self._field.draw(size, shown)
            if self._field.text != state.text:
                state.edit(self._field.text)
        self._told(desk, mistake)

    def _told(self, desk: Desk, mistake: WorkshopMistake | None) -> None:
        """Draws what the function at the caret does, and what is wrong: as many rows whatever there is to tell."""
        function = self._field.function(desk.workshop.words)
        imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.quiet))
        if function is None and mistake is None:
            said.text_wrapped(_OF_NODES if desk.workshop.nodes else _OF_TEXT)
        elif function is not None and mistake is None:
            said.text_wrapped(f"{function.form}: {function.about}")
        elif function is not None:
            said.text_unformatted(function.form)
            w.tooltip(f"{function.form}\n{function.about}")
        imgui.pop_style_color()
        if mistake is None:
            return
        text = f"{icons.WARNING} {mistake.line}:{mistake.column}  found {mistake.found}, expected {mistake.expected}"
        imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.warn))
        said.text_wrapped(text)
        imgui.pop_style_color()
        w.named("mistake")
        w.tooltip(f"{text}\nClick to go there; the last texture that was right stays in sight")
        if imgui.is_item_clicked():
            self._field.go_to(mistake.line, mistake.column)

    def _as_nodes(self, desk: Desk, size: ImVec2) -> None:
        """Draws the text as nodes.  What is dragged there is one step of the text's undo when it is let go."""
        state = desk.workshop
        if self._field.text != self._written_as:  # something was taken back
            self._written_as = self._field.text
            state.edit(self._written_as)
        changed = self._nodes.draw(desk, size)
        if changed is not None:
            state.edit(changed)
        if state.text != self._written_as and not imgui.is_any_item_active():
            self._field.put(state.text)
            self._written_as = state.text

    def _uses(self, desk: Desk) -> None:
        """Draws what the texture can become: ink, in the first row, is what most want."""
        gap, room, state = 2 * desk.scale, imgui.get_content_region_avail().x, desk.workshop
        for i, (how, icon, text, hint) in enumerate(_USES):
            if i > 1:
                imgui.same_line(0, gap)
            wide = (room - gap) / 2 if i else room
            imgui.push_style_color(imgui.Col_.button, theme.vec(theme.look.raised if i else theme.look.accent_soft))
            if w.text_button(f"{icon} {text}".strip(), hint, enabled=state.right and state.use is None, width=wide):
                name = pictured.free_texture_name(desk, state.name or WRITTEN)
                state.use = how, name
                desk.post(Do(state.definition(name, desk.view.shown_level)))
            imgui.pop_style_color()

    def _welcome(self, desk: Desk) -> None:
        """A texture that was asked for is one of the painting now: the brush gets it."""
        state, scene = desk.workshop, desk.known.scene
        if state.use is not None and scene is not None and state.use[1] in scene.textures:
            (how, name), state.use = state.use, None
            desk.hand.take(with_texture(desk.hand.brush, how, name, desk.pointer.pen))
            go_on_with_brush(desk.hand)


def _heard(desk: Desk, scene: WorkshopScene, _now: float) -> None:
    desk.workshop.scene = scene


def _words(desk: Desk, words: WorkshopWords, _now: float) -> None:
    desk.workshop.words = words


def _values(desk: Desk, seen: WorkshopValues, _now: float) -> None:
    desk.workshop.seen = seen
