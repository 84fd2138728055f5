"""The record of a placement: which node it shows, and where.

It has no paint of its own: what it shows follows from its source at every level, so nothing is stored and none is lost.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from engine.canvas.node_checks import check_common, check_flags, insist
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic, Similarity

MOST_LEVELS = 8192  # most powers of two by which a source is magnified or made smaller
FARTHEST = 1 << 8192  # pixels: as far as places are told
FINEST = 4096  # levels at which places and rectangles are told, and their negatives
_QUARTERS = ((1, 0), (0, 1), (-1, 0), (0, -1))


@dataclass(frozen=True)
class Pose:
    """Where a source is shown: its place p, x + iy with y downwards, at 2^levels c m(p) + at.

    c is `turn` quarters clockwise, or `turned`: its real and imaginary part, 1/2 <= |c| < 2, exactly what the doubles
    say.  m(x + iy) is -x + iy where `mirror` is set, else p.  `at`: in pixels of `level`.
    """

    at: tuple[int, int] = (0, 0)
    level: int = 0
    levels: int = 0
    turn: int = 0
    turned: tuple[float, float] | None = None
    mirror: bool = False

    @cached_property
    def similarity(self) -> Similarity:
        """Gives it as a similarity."""
        c = Dyadic.of(*_QUARTERS[self.turn]) if self.turned is None else Dyadic.exactly(*self.turned)
        c = Dyadic.of(c.x, c.y, c.e - self.levels)
        return Similarity(-c if self.mirror else c, Dyadic.of(*self.at, self.level), self.mirror)

    def wrong(self) -> tuple[str, object, str] | None:
        """Returns what is wrong with it: the member, what was found there, what was expected; None if nothing is."""
        if max(map(abs, self.at)) > FARTHEST:
            return "at", "a place too far", "integers up to 2^8192"
        for name, most in (("level", FINEST), ("levels", MOST_LEVELS)):
            if abs(getattr(self, name)) > most:
                return name, getattr(self, name), f"an integer from -{most} to {most}"
        if self.turn not in range(4):
            return "turn", self.turn, "0, 1, 2 or 3 quarters"
        if self.turned is None:
            return None
        if self.turn:
            return "c", "a turn of quarters, too", "one of both"
        if not all(map(math.isfinite, self.turned)) or not 0.5 <= math.hypot(*self.turned) < 2:
            return "c", list(self.turned), "[re, im] with 1/2 <= |c| < 2"
        return None


@dataclass(frozen=True, slots=True)
class SourcePart:
    """A rectangle of a source, of which only what lies within is shown: pixels of `level`."""

    level: int
    rect: Rect


@dataclass(frozen=True, slots=True)
class Placement:
    """A node of the tree shown elsewhere.

    `of`: the id of the layer, group or placement that is shown, as if it were visible, opaque and normal; None: the
    whole painting.  `pose`: where.  `part`: what of it, in its own places (None: all).  `repeat`: the part is a cell,
    repeated without end.  The rest as of a `Layer`.
    """

    id: int
    name: str
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    locked: bool = False
    of: int | None = None
    pose: Pose = Pose()
    part: SourcePart | None = None
    repeat: bool = False

    def __post_init__(self) -> None:
        check_common(self)
        check_flags(self, ("visible", "locked", "repeat"))
        wrong = self.pose.wrong()
        if wrong is not None:
            insist(self.name, wrong[0], wrong[1], False, wrong[2])
        if self.part is not None:
            level, rect = self.part.level, self.part.rect
            insist(self.name, "rect", "no pixel", not rect.empty, "a width and height of at least 1")
            near = max(map(abs, rect)) <= FARTHEST
            insist(self.name, "rect", "a place too far", near, "integers up to 2^8192")
            insist(self.name, "rect", f"level {level}", abs(level) <= FINEST, f"a level from -{FINEST} to {FINEST}")
        insist(self.name, "repeat", "no rect", not self.repeat or self.part is not None, "one, which is repeated")
