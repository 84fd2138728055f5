"""Which sections of panels are folded, by their titles: as they were in the last session, where the artist chose."""

from __future__ import annotations

from imgui_bundle import imgui

from app.language import said
from app.panels.controls.grips import note_grip

_chosen: dict[str, bool] = {}


def keep_folds_in(chosen: dict[str, bool]) -> None:
    """From now on reads and notes in a table, by titles, which sections are open."""
    global _chosen
    _chosen = chosen


def folding_header(title: str, flags: int = 0, turned: bool | None = None) -> bool:
    """Draws a section's header as it was left; tells whether it is open.  `turned`: it is opened or folded now."""
    if turned is not None:
        imgui.set_next_item_open(turned)
        _chosen[title] = turned
    elif title in _chosen:
        imgui.set_next_item_open(_chosen[title], imgui.Cond_.once)
    opened = said.tree_node(f"{title}##section", flags | imgui.TreeNodeFlags_.no_tree_push_on_open)
    note_grip()
    if imgui.is_item_toggled_open():
        _chosen[title] = opened
    return opened
