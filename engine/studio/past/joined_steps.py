"""Steps that the hand made as one: all of them are taken back, and done again, at once."""

from __future__ import annotations

from engine.session.session import Session


class JoinedSteps:
    """Remembers which steps were posted as one, for as long as their painting is open."""

    def __init__(self) -> None:
        self._session: Session | None = None
        self._of: dict[int, int] = {}  # by the place of a step's command in the log: the number of what it is part of

    def note(self, session: Session, logged: int, together: int) -> None:
        """Notes that what was logged since there were so many commands is part of one thing."""
        if self._session is not session:
            self._session, self._of = session, {}
        self._of |= dict.fromkeys(range(logged, len(session.log)), together)

    def reach(self, session: Session, back: bool, count: int) -> int:
        """Returns how many steps to go, back or forth, so that what so many steps lead into is not left half done."""
        if self._session is not session or not self._of:
            return count
        steps = session.steps
        row = steps.done[::-1] if back else steps.undone
        while 0 < count < len(row) and self._one(row[count - 1].index, row[count].index):
            count += 1
        return count

    def _one(self, one: int, other: int) -> bool:
        return one in self._of and self._of.get(other) == self._of[one]
