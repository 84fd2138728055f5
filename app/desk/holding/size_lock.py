"""The size of the brush: so many pixels of the screen, or, locked, as large on the canvas as it is, however near."""

from __future__ import annotations

from dataclasses import replace

from app.desk.desk import Desk
from app.desk.hand import LARGEST, SMALLEST
from app.desk.holding.sizes import Lock

_FARTHEST = 64.0  # levels by which a size is scaled at once


def set_lock(desk: Desk, on: bool) -> None:
    """Locks the size to the canvas, or keeps it as it is on the screen."""
    view, radius = desk.view, desk.hand.brush.radius
    desk.hand.sizes.lock = Lock(radius, radius, view.level, view.fraction) if on else None


def follow_view(desk: Desk) -> None:
    """Gives a brush that is locked to the canvas the radius that it has on the screen now.  Where that is too small or
    too large to paint with it is the nearest that can, and it comes back."""
    hand, view = desk.hand, desk.view
    lock = hand.sizes.lock
    if lock is None:
        return
    levels = max(-_FARTHEST, min(_FARTHEST, view.level - lock.level + view.fraction - lock.fraction))
    if hand.brush.radius != lock.shown:  # it was set meanwhile, in the view of then
        lock = replace(lock, radius=hand.brush.radius, shown=hand.brush.radius)
    if levels:
        radius = lock.radius * 2.0**levels
        lock = Lock(radius, round(max(SMALLEST, min(LARGEST, radius)), 4), view.level, view.fraction)
        if hand.sizes.resting is not None:
            hand.sizes.resting = max(SMALLEST, min(LARGEST, hand.sizes.resting * 2.0**levels))
    hand.sizes.lock = lock
    if hand.brush.radius != lock.shown:
        hand.change(radius=lock.shown)
