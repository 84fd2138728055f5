"""Commits that no step leads to any more: each painting holds all that led to it, many in a long session."""

from __future__ import annotations

from engine.canvas.layers import Group
from engine.canvas.store import Change
from engine.session.held_pyramids import pyramids

EACH = 4096  # steps from which on those before the oldest that was there then are forgotten


class OldCommits:
    """Forgets the commits before the oldest step that there was some thousands of steps ago: what was worked out since
    is still known to be good."""

    def __init__(self) -> None:
        self._steps = 0
        self._oldest: list[Change] = []

    def step(self, oldest: Group) -> None:
        """A step was done; the oldest that is there began with these layers."""
        self._steps += 1
        if self._steps < EACH:
            return
        self._steps = 0
        for change in self._oldest:
            change.forget_before()
        states = (pyramid.last for pyramid in pyramids(oldest).values())
        self._oldest = [change for change in states if change is not None]
