"""A bar for long work: on a terminal only, on standard error, at most ten times a second."""

from __future__ import annotations

import sys
import time
from types import TracebackType

WIDTH = 40


class Progress:
    """Use as `with Progress("playing", total) as tell: tell(done)`."""

    def __init__(self, label: str, total: int) -> None:
        self.label, self.total = label, max(total, 1)
        self._shown = sys.stderr is not None and sys.stderr.isatty()
        self._next = 0.0

    def __enter__(self) -> Progress:
        return self

    def __call__(self, done: int, total: int | None = None) -> None:
        if not self._shown:
            return
        self.total = max(total or self.total, 1)
        now = time.monotonic()
        if now >= self._next:
            self._next = now + 0.1
            filled = min(WIDTH * done // self.total, WIDTH)
            sys.stderr.write(f"\r{self.label} [{'#' * filled}{'.' * (WIDTH - filled)}] {done}/{self.total}")
            sys.stderr.flush()

    def part(self, done: float) -> None:
        """As a call, for work that tells the part done, 0..1."""
        self(int(100 * done), 100)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._shown and self._next:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
