"""The menu of the paintings that were opened or saved last."""

from __future__ import annotations

from functools import partial

from imgui_bundle import imgui

from app.actions.action import ready
from app.desk.desk import Desk
from app.panels.controls import widgets as w

_LONGEST = 48  # letters of a name that are shown


def draw(desk: Desk) -> None:
    """Draws it into the present menu."""
    paths = desk.opened.paths
    opened = imgui.begin_menu("Open recent", bool(paths) and ready(desk))
    w.named("Open recent")
    w.tooltip("Paintings that you opened or saved last")
    if not opened:
        return
    for i, path in enumerate(paths):
        name = path.name if len(path.name) <= _LONGEST else f"{path.name[: _LONGEST - 1]}…"
        if imgui.menu_item(f"{name}##{i}", "", path == desk.known.path)[0]:
            desk.guard(partial(desk.open, path))
        w.named(name)
        w.tooltip(str(path))
    imgui.end_menu()
