"""How many inks may meet in one place: each that is there makes a stroke dearer, at every coarser level that has it."""

from __future__ import annotations

from engine.brush.ink import Ink
from engine.canvas.store import Pyramid
from engine.numeric.address import TILE
from engine.painting.value import Refusal

MOST_MEETING = 4096  # from there on a stroke takes a third of a second, and the next one longer
_LEVELS = 17  # coarser ones that are looked at: beyond, an ink of one stroke lies below the grid


def refuse_crowd(pyramid: Pyramid, level: int, origin: tuple[int, int], ink: Ink | None) -> None:
    """Refuses a stroke whose ink would be one too many where it begins, or around: one that is there is none more."""
    wanted = frozenset(() if ink is None else ink.inks)
    for up in range(_LEVELS if wanted else 0):
        stored = pyramid.levels.get(level - up)
        record = None if stored is None else stored.get(((origin[0] >> up) // TILE, (origin[1] >> up) // TILE))
        if record is not None and len(record.inks) >= MOST_MEETING and not wanted.issubset(record.inks):
            raise Refusal(
                f"stroke: found {len(record.inks)} inks here that differ, expected fewer than {MOST_MEETING}: paint"
                " with one of them, or on another layer"
            )
