"""Where the artist has been, to go back and forward through: places where one stayed, or jumped from or to."""

from __future__ import annotations

from dataclasses import dataclass, field

from app.canvas.standpoint import Standpoint

STAYED = 1.2  # seconds after which one has been at a place
_LONGEST = 100  # places


@dataclass(slots=True)
class Trail:
    """`places`: oldest first; `at`: the one where one is, or was last.  `side`: pixels of the screen, by which places
    that are nearly the same count as one."""

    places: list[Standpoint] = field(default_factory=list)
    at: int = -1
    _seen: Standpoint | None = None
    _since: float = 0.0

    @property
    def can_go_back(self) -> bool:
        """Tells whether there is a place before."""
        return self.at > 0 or (self.at == 0 and self._seen is not None and self._seen != self.places[0])

    @property
    def can_go_forward(self) -> bool:
        """Tells whether one came back from a place."""
        return self.at + 1 < len(self.places)

    def forget(self) -> None:
        """Begins anew: another painting."""
        self.places, self.at, self._seen = [], -1, None

    def watch(self, here: Standpoint, now: float, side: float) -> None:
        """Takes in where one is at a time, seconds; called in every frame in which nothing moves by itself."""
        if here == self._seen:
            return
        if self._seen is not None and now - self._since >= STAYED:
            self.keep(self._seen, side)
        self._seen, self._since = here, now

    def keep(self, here: Standpoint, side: float) -> None:
        """Counts a place, now the last one, unless it is where one was anyway."""
        if self.places and here.near(self.places[self.at], side):
            self.places[self.at] = here
            return
        self.places = [*self.places[: self.at + 1], here][-_LONGEST:]
        self.at = len(self.places) - 1

    def leap(self, here: Standpoint, there: Standpoint, side: float) -> None:
        """Counts both ends of a jump."""
        self.keep(here, side)
        self.keep(there, side)
        self._seen = None

    def step(self, here: Standpoint, by: int, side: float) -> Standpoint | None:
        """Goes back (`by` -1) or forward (1): the place there; None if there is none."""
        if not (self.places and here.near(self.places[self.at], side)):
            if by > 0:
                return self._stepped(by)
            self.keep(here, side)
        return self._stepped(by)

    def _stepped(self, by: int) -> Standpoint | None:
        if not 0 <= self.at + by < len(self.places):
            return None
        self.at += by
        self._seen = None  # it is counted: after this jump it must not be once more
        return self.places[self.at]
