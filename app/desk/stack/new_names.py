"""Names of layers that are asked for: none twice, also where the engine has not yet made those asked for before."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.naming import free_name


def new_layer_name(desk: Desk, stem: str) -> str:
    """`stem` with the first number that no layer has, nor one that is still to come."""
    if not desk.behind():
        desk.stack.given.clear()
    known = {row.name for row in desk.known.scene.layers} if desk.known.scene else set()
    name = free_name(stem, known | desk.stack.given)
    desk.stack.given.add(name)
    return name
