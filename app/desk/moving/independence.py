"""What is shown becomes paint of its own; where that loses detail, the artist is asked before."""

from __future__ import annotations

from app.desk.desk import Desk
from engine.studio.moving.move_requests import BakeTold
from engine.studio.requests import Do


def ask(desk: Desk, told: BakeTold, _now: float) -> None:
    """Makes paint of a placement, or asks whether it may lose detail."""
    if told.loses or told.flat:
        desk.asked.bake, desk.asked.bake_loses = told.command, (told.loses, told.flat)
        desk.asked.show("bake")
    else:
        desk.post(Do(told.command))
