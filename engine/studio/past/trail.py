"""What all that deals with the past shares: the steps of the painting on the easel, as they are now."""

from __future__ import annotations

from engine.checks.owned import Owned
from engine.painting.value import Painting
from engine.session.session import Session
from engine.session.steps import LoggedStep
from engine.studio.easel import Easel
from engine.studio.past.past_records import PastStep
from engine.studio.past.rebuilding import STEPS_APART, KeptStates, Rebuilding
from engine.studio.past.step_words import told


class Trail(Owned):
    """The steps of the easel's session.  It belongs to the engine's thread.

    `session`: the one that was followed last; `states`: those of its paintings that are kept.
    """

    def __init__(self, easel: Easel) -> None:
        self.easel = easel
        self._begin(easel.session)
        easel.aside.append(lambda: self.states.roots())

    def _begin(self, session: Session) -> None:
        self.session, self.states = session, KeptStates(session.base)
        self._logged, self._steps = 0, tuple[LoggedStep, ...]()
        self._rows: dict[int, tuple[LoggedStep, PastStep]] = {}

    def follow(self) -> None:
        """Takes in what was done since."""
        if self.session is not self.easel.session:
            self._begin(self.easel.session)
        session = self.session
        if len(session.log) == self._logged:
            return
        steps = session.steps
        self._logged, self._steps = len(session.log), (*steps.done, *steps.undone)
        if steps.count % STEPS_APART == 0:
            self.states.keep(len(session.log), session.painting)

    def since(self, index: int) -> tuple[LoggedStep, ...]:
        """Returns the steps that are done, of commands from that place of the log on."""
        count = self.count
        first = next((n for n in range(count, 0, -1) if self._steps[n - 1].index < index), 0)
        return self._steps[first:count]

    @property
    def steps(self) -> tuple[LoggedStep, ...]:
        """Gives all steps, those done and then those undone, by their numbers from 1."""
        return self._steps

    @property
    def count(self) -> int:
        """Counts the steps that are done."""
        return self.session.steps.count

    def row(self, step: LoggedStep) -> PastStep:
        """Returns what the window is told of a step."""
        known = self._rows.get(step.index)
        if known is None or known[0] is not step:
            known = self._rows[step.index] = step, told(step, self.easel.serial)
        return known[1]

    def held(self, number: int) -> Painting | None:
        """Returns the painting after the step of a number, if it is at hand."""
        by = number - self.count
        return self.session.painting if by == 0 else self.session.history.at(by)

    def rebuilding(self, number: int) -> Rebuilding:
        """Returns what plays the painting anew up to the step of a number."""
        return Rebuilding(self.session, self.states, self._steps[number - 1].index + 1 if number else 0)

    def tour(self, first: LoggedStep, last: LoggedStep) -> Rebuilding:
        """Returns what plays some steps anew, to be looked at one after the other."""
        return Rebuilding(self.session, self.states, last.index + 1, first.index, held=0)
