"""Pictures that were asked for and have not come: those shown meanwhile are of something else."""

from __future__ import annotations

import time

LATE = 0.7  # seconds: what takes no longer is not spoken of


class Awaited:
    """Since when each is awaited, by its name."""

    def __init__(self) -> None:
        self._since: dict[str, float] = {}

    def ask(self, ident: str) -> None:
        """Notes that a picture is asked for, perhaps once more."""
        self._since.setdefault(ident, time.monotonic())

    def come(self, ident: str) -> None:
        """Notes that a picture is there."""
        self._since.pop(ident, None)

    def late(self, ident: str) -> bool:
        """Tells whether a picture is awaited so long that one should say so."""
        return time.monotonic() - self._since.get(ident, float("inf")) > LATE
