"""Steps of undo as one thinks of them: a word, what is typed until a pause; the editor has one each key."""

from __future__ import annotations

from typing import NamedTuple

_PAUSE = 1.5  # seconds: what is typed after that is a step of its own


class Typed(NamedTuple):
    """A change of the text: how many letters it has more, where the caret is now, row and letter, the letters before
    that there, and when."""

    grown: int
    at: tuple[int, int]
    before: str
    now: float


class TextSteps:
    """Where they begin, told in the editor's own; in order."""

    def __init__(self) -> None:
        self._starts: list[int] = []
        self._last: Typed | None = None

    def note(self, count: int, more: int, typed: Typed) -> None:
        """Takes a change: the editor had `count` steps of its own, and has `more` of them more."""
        del self._starts[self._kept(count) :]  # what was taken back is gone
        goes_on = more == abs(typed.grown) > 0 and self._goes_on(typed)
        if not goes_on or not self._starts:
            self._starts.append(count)
        self._last = typed if more == abs(typed.grown) else None

    def end(self) -> None:
        """Has the next change be a step of its own, whatever it is like."""
        self._last = None

    def back(self, count: int) -> int:
        """Returns how many of the editor's own steps there are when one is taken back."""
        self._last = None
        kept = self._kept(count)
        return self._starts[kept - 1] if kept else 0

    def again(self, count: int) -> int | None:
        """Returns how many there are when one is done again; None for all."""
        self._last = None
        kept = self._kept(count + 1)
        return self._starts[kept] if kept < len(self._starts) else None

    def _kept(self, count: int) -> int:
        """Returns how many begin before one of the editor's own."""
        return sum(start < count for start in self._starts)

    def _goes_on(self, typed: Typed) -> bool:
        """Tells whether a change belongs to the one before: typed on in the same row, within a word or behind one; or
        letters that are taken away one after the other."""
        last = self._last
        if last is None or typed.now - last.now > _PAUSE or (typed.grown > 0) != (last.grown > 0):
            return False
        if typed.grown < 0:
            return typed.at[0] == last.at[0] and 0 <= last.at[1] - typed.at[1] <= -typed.grown
        follows = typed.at == (last.at[0], last.at[1] + typed.grown)
        return follows and not _begins_word(typed.before, typed.grown)


def _begins_word(before: str, grown: int) -> bool:
    """Tells whether the first of the last letters is one of a word, and that before it is none."""
    first = len(before) - grown
    return first > 0 and _in_word(before[first]) and not _in_word(before[first - 1])


def _in_word(letter: str) -> bool:
    return letter.isalnum() or letter in "_#."
