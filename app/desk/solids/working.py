"""Long work on the files' thread, a while at a time, so that files come between."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TypeVar

_T = TypeVar("_T")
_WHILE = 0.25  # seconds


def for_a_while(steps: Iterator[_T | None]) -> tuple[_T | None, bool]:
    """Takes steps for a while, or until one gives something; returns that, and whether there may be more."""
    end = time.monotonic() + _WHILE
    for found in steps:
        if found is not None or time.monotonic() >= end:
            return found, True
    return None, False
