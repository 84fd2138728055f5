"""Paintings of earlier steps that are asked for to tell what was painted somewhere, and are not at hand: the log played
anew.

What a region of like colour covered, and what a selection was that followed from paint, cannot be told otherwise.
"""

from __future__ import annotations

from typing import NamedTuple

from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.here.chosen import Held
from engine.session.session import Session
from engine.session.steps import LoggedStep
from engine.studio.past.rebuilding import KeptStates, Rebuilding

_MOST = 64  # paintings that are held for it


class _Wanted(NamedTuple):
    """A painting by the number of the step that led there, and that step."""

    number: int
    step: LoggedStep | None

    @property
    def commands(self) -> int:
        """Counts the commands that lead there."""
        return 0 if self.step is None else self.step.index + 1


class FoundAgain:
    """The paintings of a session's steps, `held` those at hand.  It belongs to the thread of the session.

    `wanted`: whether one was asked for in vain since it was looked at last.
    """

    def __init__(self, session: Session, held: Held, states: KeptStates | None = None) -> None:
        self._session, self._at_hand = session, held
        self._states = KeptStates(session.base) if states is None else states
        self._kept: dict[int, tuple[LoggedStep | None, Painting]] = {}  # by number; and the step that led there
        self._asked: set[int] = set()
        self._tried: set[int] = set()  # those that were asked for before
        self._open: list[_Wanted] = []  # the last first
        self._way: Rebuilding | None = None

    @property
    def wanted(self) -> bool:
        """Tells whether a painting was asked for that was not at hand."""
        return bool(self._asked)

    def held(self, number: int) -> Painting | None:
        """Returns the painting after the step of a number, if it is at hand by now."""
        found = self._at_hand(number)
        if found is not None:
            return found
        done = self._session.steps.done
        if not 0 <= number <= len(done):
            return None
        kept = self._kept.get(number)
        if kept is not None and kept[0] is (done[number - 1] if number else None):
            return kept[1]
        self._asked.add(number)
        return None

    def begin(self) -> bool:
        """Sets out to find what was asked for, and others that may be asked for then.  Returns whether there is any."""
        new, self._tried, self._asked = self._asked - self._tried, self._tried | self._asked, set()
        last, done = max(new, default=-1), self._session.steps.done
        numbers = {last, *(_needed(step) for step in done[: last + 1])} - {-1}
        some = sorted(number for number in numbers if number <= last)[-_MOST:]
        self._open = [_Wanted(number, done[number - 1] if number else None) for number in reversed(some)]
        if self._open:
            self._kept = {}
            first, count = self._open[-1].commands, self._open[0].commands
            self._way = Rebuilding(self._session, self._states, count, first, held=0)
        return bool(self._open)

    def play(self) -> bool:
        """Plays the next command.  Returns whether there is more to play; Refusal or FileError: the log cannot be."""
        way = self._way
        assert way is not None
        while self._open and self._open[-1].commands == way.at:
            number, step = self._open.pop()
            self._kept[number] = step, way.session.painting
        if self._open and not way.done:
            way.play()
            return True
        self._open, self._way = [], None
        return False


def _needed(step: LoggedStep) -> int:
    """Returns the number of the painting that tells what a step covered or selected; -1 where none is needed."""
    command = step.command
    if isinstance(command, c.Fill):
        return -1 if command.like is None else step.number - 1
    by_paint = isinstance(command, c.Select) and isinstance(command.source, c.Like)
    on_mask = isinstance(command, c.Stroke) and bool(command.onto)
    return step.number if by_paint or on_mask else -1
