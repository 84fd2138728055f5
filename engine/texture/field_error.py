"""What is wrong with a value that somebody gave: the place, what was found there, what was expected."""


class FieldError(ValueError):
    """`str()` is one line."""

    def __init__(self, place: str, found: str, expected: str) -> None:
        self.place, self.found, self.expected = place, found, expected
        super().__init__(f"{place}: found {found}, expected {expected}")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.place, self.found, self.expected)
