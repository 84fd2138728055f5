"""The table of actions: name, menu, keys, when allowed, what it does; those of no menu are offers of notices.

Menus, keys, tooltips and the list of keys are made from it.
"""

from __future__ import annotations

from collections.abc import Mapping

from app.actions.action import Action, asks
from app.actions.edit_actions import EDIT_ACTIONS
from app.actions.endless_actions import ENDLESS_ACTIONS
from app.actions.file_actions import FILE_ACTIONS
from app.actions.guide_actions import GUIDE_ACTIONS
from app.actions.layer_actions import LAYER_ACTIONS
from app.actions.mask_actions import MASK_ACTIONS
from app.actions.merging_actions import MERGING_ACTIONS
from app.actions.panel_actions import PANEL_ACTIONS
from app.actions.placement_actions import PLACEMENT_ACTIONS
from app.actions.select_actions import SELECT_ACTIONS
from app.actions.tool_actions import TOOL_ACTIONS
from app.actions.view_actions import VIEW_ACTIONS
from app.actions.wrapping_actions import WRAPPING_ACTIONS
from app.desk import offers
from app.desk.desk import Desk

ACTIONS: dict[str, Action] = {
    **FILE_ACTIONS,
    **EDIT_ACTIONS,
    **TOOL_ACTIONS,
    **GUIDE_ACTIONS,
    **LAYER_ACTIONS,
    **SELECT_ACTIONS,
    **MASK_ACTIONS,
    **MERGING_ACTIONS,
    **PLACEMENT_ACTIONS,
    **ENDLESS_ACTIONS,
    **VIEW_ACTIONS,
    **PANEL_ACTIONS,
    **WRAPPING_ACTIONS,
    "keys": Action("Keys…", "Help", ("F1",), "All keys in one list", asks("keys")),
    "start_page": Action("Start page", "Help", (), "Things to try, and what was open", lambda desk: desk.start.show()),
    "copy_details": Action("Copy details", "Help", (), "Copy versions and the last faults", offers.copy_details),
    "about": Action("About Inkfall…", "Help", (), "What this program is", asks("about")),
}  # fmt: skip
MENUS = ("File", "Edit", "Tools", "Layer", "Select", "Guides", "View", "Go", "Help")


def by_key(keys: str) -> Action | None:
    """Returns the action that a key press such as `Ctrl+S` means."""
    return _BY_KEY.get(keys)


def keys_mean(actions: Mapping[str, Action]) -> None:
    """From now on each key press means the action that it has here."""
    _BY_KEY.clear()
    _BY_KEY.update(actions)


_BY_KEY = {key: action for action in ACTIONS.values() for key in action.keys}


def perform(desk: Desk, action: Action) -> bool:
    """Does it if it is allowed now."""
    if not action.when(desk):
        return False
    action.do(desk)
    return True


def tip(name: str) -> str:
    """Returns an action's hint with its keys, for tooltips."""
    return keyed(ACTIONS[name].hint, name)


def keyed(text: str, name: str) -> str:
    """Returns a text with the keys of an action behind it."""
    keys = ACTIONS[name].keys
    return f"{text}  ({keys[0]})" if keys else text
