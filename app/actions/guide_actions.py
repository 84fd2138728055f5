"""The actions of the Guides menu, and whether guides are seen."""

from __future__ import annotations

from dataclasses import replace

from app.actions.action import Action as A
from app.actions.action import always, ready
from app.desk.desk import Desk
from app.desk.guides import assistants, symmetry
from app.desk.guides.present import present_guides


def _move(desk: Desk) -> None:
    desk.hand.use("guides")


def _moving(desk: Desk) -> bool:
    return desk.hand.tool == "guides"


def _symmetric(desk: Desk) -> bool:
    guide = symmetry.guide_of(desk)
    return guide is not None and not guide.off


def _drawn(desk: Desk) -> bool:
    return ready(desk) and _symmetric(desk)


def _chosen(desk: Desk) -> bool:
    guide = assistants.chosen_guide(desk)
    return ready(desk) and guide is not None and guide.kind != "symmetry"


def _hidden(desk: Desk) -> bool:
    return ready(desk) and any(guide.off and guide.kind != "symmetry" for guide in present_guides(desk))


def _hide(desk: Desk) -> None:
    guide = assistants.chosen_guide(desk)
    if guide is not None:
        assistants.set_guide(desk, replace(guide, off=True))
    desk.guides.chosen = ""


GUIDE_ACTIONS: dict[str, A] = {
    "guides": A(
        "Move guides", "Guides", ("Shift+Y",), "Add guides, drag their points, type their numbers", _move, always,
        _moving,
    ),
    "snap_guides": A(
        "Snap to guides", "Guides", ("Ctrl+Shift+Y",), "Strokes along a guide are drawn onto it",
        assistants.toggle_snaps, always, lambda desk: desk.guides.snaps,
    ),
    "show_guides": A(
        "Guides", "View", ("Ctrl+;",), "Show guides; hidden ones work all the same", assistants.toggle_shown, always,
        lambda desk: desk.guides.shown,
    ),
    **{
        f"add_{kind}": A(f"Add: {row.title.lower()}", "Guides", (), row.hint, assistants.adds(kind), ready)
        for kind, row in assistants.ASSISTANTS.items()
    },
    "hide_guide": A("Hide the guide", "Guides", (), "Turn off the guide that is chosen", _hide, _chosen),
    "hidden_guides": A("Bring hidden guides back", "Guides", (), "Turn all guides on", assistants.show_all, _hidden),
    "delete_guide": A("Delete the guide", "Guides", (), "Take the chosen guide away", assistants.remove_it, _chosen),
    "symmetry": A(
        "Symmetry", "Guides", ("Y",), "Paint with symmetry, or without; its kind is in the brush settings",
        symmetry.toggle, ready, _symmetric,
    ),
    "symmetry_here": A(
        "Bring the symmetry here", "Guides", (), "Its centre comes into the middle of what you see",
        symmetry.bring_here, _drawn,
    ),
}  # fmt: skip
