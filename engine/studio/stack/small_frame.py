"""The frame as small pictures of layers and masks show it."""

from __future__ import annotations

from engine.numeric.address import Rect

SIDE = 64  # pixels at most


def small_frame(frame: Rect) -> tuple[int, Rect]:
    """Returns the finest level at which a frame is small enough, and its pixels there."""
    level = 0
    while max(frame.zoomed(level).width, frame.zoomed(level).height) > SIDE:
        level -= 1
    return level, frame.zoomed(level)
