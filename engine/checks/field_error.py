"""What is wrong with a value that somebody gave: the place, what was found there, what was expected."""

from __future__ import annotations

_LONGEST_PLACE = 80  # characters of a place that are told: of a longer one the middle is left out


class FieldError(ValueError):
    """A value that its field does not allow.  `str()` is one line; `place` is "" where there is only one."""

    def __init__(self, place: str, found: str, expected: str) -> None:
        self.place, self.found, self.expected = place, found, expected
        lead = f"{_shortened(place)}: " if place else ""
        super().__init__(f"{lead}found {found}, expected {expected}")

    def __reduce__(self) -> tuple[type[FieldError], tuple[str, str, str]]:
        return type(self), (self.place, self.found, self.expected)


def _shortened(place: str) -> str:
    half = (_LONGEST_PLACE - 3) // 2
    return place if len(place) <= _LONGEST_PLACE else f"{place[:half]}...{place[-half:]}"
