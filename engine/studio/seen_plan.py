"""What the window sees, planned once for all its tiles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.canvas.layers import Group
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.placing.portions import Portions
from engine.strokes.example_stroke import Live

TURNS = 24  # of a picture that contains itself, made at a time
_AT_ONCE = 8  # times as many, of a pixel that one waits for


class SeenPlan:
    """The layers that are seen, planned, and the `portions` of pictures of them that are not all made."""

    def __init__(self) -> None:
        self.portions = Portions(TURNS)
        self._planned: Planned | None = None
        self._live: Live | None = None  # the stroke in progress that is seen in it

    def of(self, root: Group, live: Live | None) -> Planned:
        """Returns a root planned, as it is seen with a stroke in progress, if there is one."""
        held = self._planned if self._live is live else None
        if held is None or (live is None and held.root is not root):
            self.portions.forget()
            held = self._planned = Planned.of(root, None, self.portions, None if live is None else live.layer.id)
        self._live = live
        return held

    def by_now(self, made: Callable[[], np.ndarray]) -> np.ndarray:
        """Returns a small picture at once: of one that contains itself, as far as so many turns show."""
        for _ in range(_AT_ONCE):
            picture, whole = self.portions.picture(made)
            if whole:
                break
        return picture

    def changed(self) -> None:
        """The stroke in progress, if there is one, has grown or is gone: of the same layers other pixels are read."""
        if self._live is not None:
            self.forget()

    def forget(self) -> None:
        """Another painting is to be seen."""
        self.portions.forget()
        self._planned = self._live = None
