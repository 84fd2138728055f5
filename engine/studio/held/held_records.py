"""What the window is told of memory: a frozen record, light on purpose, as `results`."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Held:
    """The memory that is taken, in bytes: `rows` tell what for, `resident` in all, with the program itself; `budget` is
    what paintings may take; `disk`: what was put away there."""

    rows: tuple[tuple[str, int], ...] = ()
    resident: int = 0
    budget: int = 0
    disk: int = 0
