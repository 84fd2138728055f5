"""An endless zoom into a picture that contains itself: two places that look the same, one a turn deeper."""

from __future__ import annotations

import math

from engine.canvas.placing.pose import Pose, SourcePart
from engine.numeric.scaling import scaled
from engine.numeric.similarity import Dyadic, Similarity
from engine.painting.places import Bookmark

_FINER = 4  # levels beyond the one at which all lies on whole pixels
_ROUNDS = 64  # turns after which one is at the place that all of them share
_LEAST = 16  # parts of the frame's side that have to lie around that place, at least
_UNITS = 32  # bits of parts of pixels


def endless(name: str, pose: Pose, part: SourcePart) -> tuple[Bookmark, Bookmark]:
    """Returns two places within what a placement shows of a picture in which it lies, the outer one first: from one to
    the other it is a turn.  Screens up to twice as wide as high, or as high as wide, show nothing else."""
    f = pose.similarity
    level = max(part.level, f.t.e) + _FINER
    x, y, side = _middle(f, level, part)
    outer = Bookmark(f"{name} out", level, (x - side // 2, y - side // 2), (side, side))
    there, deeper = f(Dyadic.of(x, y, level)), level - f.log_scale
    fraction, whole = math.modf(deeper)
    left, top = (
        scaled(_shifted(at, int(whole) + _UNITS - there.e), fraction) - (side << _UNITS - 1)
        for at in (there.x, there.y)
    )
    angle = _angle(pose)
    inner = Bookmark(
        f"{name} in",
        _plainly(deeper),
        (_pixels(left), _pixels(top)),
        (side, side),
        angle if pose.mirror else -angle,
        pose.mirror,
    )
    return outer, inner


def _middle(f: Similarity, level: int, part: SourcePart) -> tuple[int, int, int]:
    """Returns the place that all turns share, or the frame's middle if that is at its rim, in pixels of a level, and
    an even side of a square around it."""
    frame = part.rect.zoomed(level - part.level)
    place = Dyadic.of(frame.x0 + frame.x1, frame.y0 + frame.y1, level + 1)
    shared = place
    for _ in range(_ROUNDS):
        shared = f(shared)
        drop = max(0, shared.e - level - _UNITS)
        shared = Dyadic.of(shared.x >> drop, shared.y >> drop, shared.e - drop)
    for middle in (shared, place):
        x, y = (_shifted(at, level - middle.e) for at in (middle.x, middle.y))
        room = min(x - frame.x0, frame.x1 - x, y - frame.y0, frame.y1 - y)
        if room * _LEAST >= min(frame.width, frame.height):
            break
    return x, y, max(2, room // 2 * 2)


def _angle(pose: Pose) -> float:
    """Returns the degrees by which a placement turns what it shows clockwise."""
    if pose.turned is None:
        return 90.0 * (pose.turn if pose.turn < 3 else -1)
    return math.degrees(math.atan2(pose.turned[1], pose.turned[0]))


def _shifted(value: int, bits: int) -> int:
    return value << bits if bits >= 0 else value >> -bits


def _plainly(level: float) -> float:
    return int(level) if level == int(level) else level


def _pixels(units: int) -> float:
    """Returns 2^-32 pixels as pixels: an int where they are whole."""
    return units >> _UNITS if not units & ((1 << _UNITS) - 1) else units / (1 << _UNITS)
