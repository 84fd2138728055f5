"""How a stroke begins under a pen: what only taps the canvas is as heavy as it was pressed.

A pen tells that it touches when it is hardly pressed, and while it stays in its place no more dabs are laid: a dot had
the pressure of its first moment, which is next to none.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import replace

from app.input.events import ENDS, PenEvent

STILL = 1.5  # pixels of the screen within which a pen stays where it came down


def come_down(first: PenEvent) -> Generator[None, PenEvent, list[PenEvent]]:
    """Waits while a pen stays where it came down; returns what it told since, the first and the last included.  Where
    it was lifted there, all of that is as heavy as it was pressed at most.  Anything else than a pen is not waited
    for."""
    told = [first]
    while first.pen and told[-1].kind in ("down", "move"):
        if math.hypot(told[-1].x - first.x, told[-1].y - first.y) > STILL:
            return told
        told.append((yield))
    if told[-1].kind in ENDS:
        most = max(event.pressure for event in told[:-1])
        return [*(replace(event, pressure=most) for event in told[:-1]), told[-1]]
    return told
