"""The member `seen` of strokes: where the layer painted on is seen, by whose places they are limited by what is
selected."""

from __future__ import annotations

from engine.canvas.placing.pose import UNMOVED, Pose
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.painting.layering.placing_members import PLACED, Members, Placing, read_placing, write_placing

_NO_POSE = ("of", "rect", "repeat", "c")


def read_seen(members: Fields) -> Pose | None:
    """Returns where the layer is seen; None: where it lies.  FieldError if that is not by quarter turns and powers of
    two."""
    if members.take("seen", None) is None:
        return None
    inner = Fields(members.take("seen"), members.at("seen"))
    for name in inner.all():
        if name not in PLACED or name in _NO_POSE:
            raise FieldError(inner.at(name), "a member of no pose", '"at", "level", "levels", "turn", "mirror"')
    return read_placing(inner).posed(UNMOVED)


def write_seen(pose: Pose) -> Members:
    """Tells where a layer is seen; `read_seen` is the inverse."""
    return write_placing(Placing.at_pose(pose))
