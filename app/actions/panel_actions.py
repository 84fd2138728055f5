"""The actions of the menu View > Each panel: which panels are to be seen, and how they are arranged."""

from __future__ import annotations

from collections.abc import Callable

from app.actions.action import Action, Check, always, asks
from app.desk.arranging.arrangement import DOCKS, Arrangement, shown_or_hidden, sides_swapped
from app.desk.desk import Desk

_MENU = "View/Each panel"


def _toggles(name: str) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        if not desk.panels:  # all are hidden: this one is wanted
            desk.panels = True
            if name not in desk.arranged.now.hidden:
                return
        desk.arranged.now = shown_or_hidden(desk.arranged.now, name)

    return do


def _seen(name: str) -> Check:
    return lambda desk: desk.panels and name not in desk.arranged.now.hidden


def _swap_sides(desk: Desk) -> None:
    desk.arranged.now = sides_swapped(desk.arranged.now)


def _next_panel(desk: Desk) -> None:
    desk.panels = True
    desk.keys.panel, desk.keys.turning = 0 if desk.keys.panel is None else desk.keys.panel + 1, True


def _as_at_first(desk: Desk) -> None:
    desk.arranged.now = Arrangement()


PANEL_ACTIONS: dict[str, Action] = {
    **{
        f"panel {name}": Action(f"Panel: {dock.title}", _MENU, (), dock.hint, _toggles(name), always, _seen(name))
        for name, dock in DOCKS.items()
    },
    "panel_keys": Action(
        "Panels by keyboard",
        "View",
        ("F6",),
        "Arrows and Tab go through a panel, Space presses; F6 to the next one, Escape back to the canvas",
        _next_panel,
        always,
        lambda desk: desk.keys.panel is not None,
    ),
    "swap_sides": Action("Swap the sides", _MENU, (), "The left column to the right, for left-handers", _swap_sides),
    "panels_reset": Action("As at first", _MENU, (), "All panels where they come, as wide and high", _as_at_first),
    "workspaces": Action(
        "Panels and workspaces…", "View", (), "Where panels lie; arrangements under names", asks("workspaces")
    ),
}
