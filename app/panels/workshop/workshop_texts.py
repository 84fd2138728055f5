"""Which text is in the workshop: examples that teach, files, what the brush paints with; and undo."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from imgui_bundle import imgui

from app import icons
from app.desk import palette
from app.desk.desk import Desk
from app.desk.hand import mixed_now
from app.desk.workshop.explained import explained
from app.desk.workshop.workshop_work import ListTexts, ReadText
from app.language import said
from app.panels.controls import widgets as w
from app.panels.workshop.keeping_texts import KeepText
from app.panels.workshop.text_field import TextField
from engine.texture.expression.library.bundled_texts import LibraryText

_LETTERS = 18  # of a text's name: the button is as wide whatever it is called


def draw_texts(desk: Desk, field: TextField, keep: KeepText) -> None:
    """Draws it into the title line."""
    state, gap = desk.workshop, 2 * desk.scale
    if state.files is None:
        state.files = ()
        desk.work(ListTexts())
    label = f"{icons.EXAMPLES} {state.name[:_LETTERS] or 'Examples'}###texts"
    hint = "Examples that teach, in order; and yours"
    if w.text_button(label, hint, width=0.62 * _LETTERS * imgui.get_font_size()):
        imgui.open_popup("texts")
    w.named("Examples")
    _menu(desk)
    imgui.same_line(0, gap)
    if w.icon_button("new text", icons.ADD, "Another text, from the beginning"):
        state.take(state.lessons[0].text if state.lessons else "")
    imgui.same_line(0, gap)
    if w.icon_button("open text", icons.FOLDER, "Open a texture that was written: its file may be dropped here, too"):
        desk.asked.show("texture text")
    imgui.same_line(0, gap)
    keep.draw(desk)
    imgui.same_line(0, gap)
    hint = "Explain: what the brush paints with, as a text"
    if w.icon_button("explain brush", icons.BRUSH, hint, enabled=bool(mixed_now(desk.hand).ink)):
        _explain(desk)
    imgui.same_line(0, gap)
    back, again = field.travels
    if w.icon_button("text back", icons.UNDO, "Take back what was written  (Ctrl+Z in the text)", enabled=back):
        field.travel(-1)
    imgui.same_line(0, gap)
    if w.icon_button("text again", icons.REDO, "Write it again  (Ctrl+Y in the text)", enabled=again):
        field.travel(1)
    imgui.same_line(0, gap)
    hint = "The text as nodes: a line each, and links for names; what is changed in one is changed in the other"
    if w.icon_button("as nodes", icons.NODES, hint, on=state.nodes):
        state.nodes = not state.nodes


def _explain(desk: Desk) -> None:
    """Opens what the brush paints with as a text."""
    palette.provide(desk)  # the text names them
    found = explained(mixed_now(desk.hand), palette.belonging(desk)[0])
    if found is None:
        desk.say("The language has no words for what this brush paints with", bad=True)
        return
    desk.workshop.take(found.text, desk.hand.preset, found.told)


def _menu(desk: Desk) -> None:
    if not imgui.begin_popup("texts"):
        return
    state = desk.workshop
    library = sorted(state.library, key=lambda one: one.title)
    half = -(-len(library) // 2)
    lists: tuple[tuple[str, Sequence[LibraryText]], ...] = (
        *(("Lessons", state.lessons), ("Textures", library[:half]), ("", library[half:])),
        ("Along a stroke", state.generators),
    )
    imgui.begin_table("texts", len(lists), imgui.TableFlags_.sizing_fixed_fit)
    for title, texts in lists:
        imgui.table_next_column()
        said.text_disabled(title)
        for number, one in enumerate(texts):
            told = f"{number}  {one.title}" if texts is state.lessons else one.title
            if said.menu_item(f"{told}##{title}", "", False)[0]:
                state.take(one.text, one.title)
            w.named(one.title)
            w.tooltip(one.about)
    if state.files:
        said.text_disabled("Yours")
    for path in state.files or ():
        if said.menu_item(f"{PurePath(path).stem}##{path}", "", False)[0]:
            desk.work(ReadText(PurePath(path)))
        w.named(PurePath(path).stem)
    imgui.end_table()
    imgui.end_popup()
