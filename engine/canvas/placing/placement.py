"""The record of a placement: which node it shows, and where.

It has no paint of its own: what it shows follows from its source at every level, so nothing is stored and none is lost.
"""

from __future__ import annotations

from dataclasses import dataclass

from engine.canvas.node_checks import check_common, check_flags, check_role, insist
from engine.canvas.placing.pose import FARTHEST, FINEST, UNMOVED, Pose, SourcePart
from engine.canvas.selecting.selection import Selection


@dataclass(frozen=True, slots=True)
class Placement:
    """A node of the tree shown elsewhere.

    `of`: the id of the layer, group or placement that is shown, as if it were visible, opaque and normal; None: the
    whole painting.  `pose`: where.  `part`: what of it, in its own places (None: all).  `repeat`: the part is a cell,
    repeated without end.  `mask`: of what is seen, in the places where it is seen.  The rest as of a `Layer`.
    """

    id: int
    name: str
    opacity: float = 1.0
    visible: bool = True
    blend: str = "src-over"
    locked: bool = False
    of: int | None = None
    pose: Pose = UNMOVED
    part: SourcePart | None = None
    repeat: bool = False
    role: str = ""
    clip: bool = False
    mask: Selection | None = None

    def __post_init__(self) -> None:
        check_common(self)
        check_flags(self, ("visible", "locked", "repeat", "clip"))
        check_role(self, self.role)
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
