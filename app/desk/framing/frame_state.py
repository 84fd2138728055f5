"""The frame while its handles are dragged."""

from __future__ import annotations

from dataclasses import dataclass

from app.desk.known import Known
from app.desk.moving.box import INSIDE, SCALES
from engine.numeric.address import Rect
from engine.painting.layering.frame_command import LONGEST_SIDE
from engine.studio.results import Scene

FRAME_TOOL = "frame_tool"


@dataclass(slots=True)
class FrameState:
    """`trial`: another frame, and the scene in which it was tried: the painting's next one tells its own.  `grip`: what
    of the box is held; `dragging`: now."""

    trial: tuple[Scene | None, Rect] | None = None
    grip: str = ""
    dragging: bool = False

    def shown(self, known: Known) -> Rect:
        """Returns the frame as it is to be seen."""
        return self.trial[1] if self.trial is not None and self.trial[0] is known.scene else known.frame


def dragged(frame: Rect, grip: str, x: int, y: int, keep: bool = False) -> Rect:
    """Returns a frame whose handle, or all of it, was dragged by whole pixels; `keep`: its sides keep their ratio, and
    what lies opposite stays."""
    if grip == INSIDE:
        return Rect(frame.x0 + x, frame.y0 + y, frame.x1 + x, frame.y1 + y)
    across, down = SCALES[grip]
    width, height = (
        min(max(side + sign * by, 1), LONGEST_SIDE)
        for side, sign, by in ((frame.width, across, x), (frame.height, down, y))
    )
    if keep and (down == 0 or (across and width * frame.height >= height * frame.width)):
        height = max(1, round(width * frame.height / frame.width))
    elif keep:
        width = max(1, round(height * frame.width / frame.height))
    left = _kept((frame.x0, frame.x1), across, width)
    top = _kept((frame.y0, frame.y1), down, height)
    return Rect.at(left, top, width, height)


def _kept(ends: tuple[int, int], sign: int, side: int) -> int:
    """Returns where a side of another length begins: its end stays that is not dragged, or its middle."""
    if sign > 0:
        return ends[0]
    return ends[1] - side if sign < 0 else (ends[0] + ends[1] - side) // 2
