"""What was brought in, from when it was asked for until it lies there: told meanwhile, and then handed to be moved."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.outside.arrival_state import Arriving


def expect(desk: Desk, name: str, hint: str) -> None:
    """Tells that something is on its way."""
    desk.arriving = Arriving(name, hint, desk.hand.tool)
    desk.say(f"Bringing in “{name}”…")


def welcome_arrived(desk: Desk) -> None:
    """Has what arrived be moved next, but not where the hand does something else meanwhile; called with each scene."""
    arriving, scene = desk.arriving, desk.known.scene
    if not arriving.name or scene is None or all(row.name != arriving.name for row in scene.layers):
        return
    desk.arriving = Arriving()
    desk.say(arriving.hint)
    if desk.hand.tool == arriving.tool and not desk.painting:
        desk.hand.use("move")
