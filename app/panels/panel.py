"""What opens below the canvas: what each such panel may do.  Most need little of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from app.actions.action import Action
from app.desk.desk import Desk, Hear
from app.input.events import PenEvent
from app.tools.gesture import Gesture

Painting = Callable[[Desk, PenEvent], Gesture]


class Panel:
    """Draws itself, asks the engine for what it shows, and hears the answers."""

    hears: Mapping[type, Hear] = {}  # by the type of the results, whether it is open or not

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        raise NotImplementedError

    def bar(self, desk: Desk) -> None:
        """Draws what it has in the strip's title line."""

    def hint(self, desk: Desk) -> str:
        """Says what can be done in it now; empty if that is always the same."""
        return ""

    def wants(self, desk: Desk, now: float) -> None:
        """Posts what it lacks; called after it was drawn, once the engine is there."""

    def closed(self, desk: Desk) -> None:
        """Posts what follows from its being closed, or another being opened in its place."""

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """Returns the stroke that a press at a point of the screen begins; None if it begins none."""
        return None

    def takes(self, desk: Desk, action: Action) -> bool:
        """Does an action in its own way, while the pointer is over what is painted in it; False if it does not."""
        return False

    def dropped(self, desk: Desk, path: Path, x: float, y: float) -> bool:
        """Takes a file that was dropped at a point of the screen; False if it is not for this panel."""
        return False
