"""Pictures that follow what they show: asked for at once, but no faster than they can be seen."""

from __future__ import annotations

from typing import Any

SETTLE = 0.12  # seconds from one swatch to the next


class Following:
    """`settle`: seconds from one asking to the next."""

    def __init__(self, settle: float = SETTLE) -> None:
        self._settle = settle
        self._wanted: Any = None
        self._since = self._sent = 0.0

    def due(self, wanted: Any, now: float, free: bool = True) -> bool:
        """Tells whether a picture of `wanted` is to be asked for now: it is not of the one before, and enough time
        went by.  While not `free`, it waits."""
        if wanted != self._wanted:
            self._wanted, self._since = wanted, self._since or max(now, self._sent + self._settle)
        if not free or not self._since or now < self._since:
            return False
        self._since, self._sent = 0.0, now
        return True
