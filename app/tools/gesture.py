"""What a gesture and a tool are.

Each gesture is a generator that gets pen events from touch-down to lift-off.
A gesture may be closed early (Esc): it then leaves nothing half done.  Where the pen is lost (`events.ENDS`), strokes
end and stay; all other gestures are closed.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import NamedTuple

from app.desk.desk import Desk
from app.input.events import PenEvent

Gesture = Generator[None, PenEvent, None]


class Tool(NamedTuple):
    """A row of the table of tools."""

    title: str
    icon: str
    gesture: Callable[[Desk, PenEvent], Gesture]
    hint: str
    outline: bool = False  # shows the brush's circle
    told: Callable[[Desk], str] | None = None  # what it does now, in place of the hint
