"""Where a bookmark stands in the land, and which way it looks: members `eye`, `turn`, `tilt`, `fov`."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from engine.checks.values import is_number
from engine.files.strict_json import Fields

_DEEPEST = 1000  # level beyond which heights have no numbers
_PLACES = 1 << 8192
_LOWEST, _HIGHEST = 2.0**-40, 2.0**40  # pixels above the ground
_TILT, _FOV = -20.0, 55.0


@dataclass(frozen=True, slots=True)
class Outlook:
    """An eye `height` pixels of `level` above the ground, or the water, at (x, y) of it; it looks `turn` degrees
    clockwise from the top of the canvas, `tilt` degrees up; `fov`: degrees from left to right."""

    level: int
    x: float | Fraction
    y: float | Fraction
    height: float
    turn: float = 0.0
    tilt: float = _TILT
    fov: float = _FOV

    def place(self) -> tuple[Fraction, Fraction]:
        """Returns the place in pixels of level 0."""
        by = Fraction(2) ** -self.level
        return Fraction(self.x) * by, Fraction(self.y) * by


def read_outlook(members: Fields) -> Outlook | None:
    """Reads the members of a bookmark that tell it; None where there is no `eye`."""
    if "eye" not in members:
        return None
    eye = members.take("eye", None)
    if not (isinstance(eye, list) and len(eye) == 4 and all(map(is_number, eye)) and isinstance(eye[0], int)):
        raise members.fault("eye", "[level, x, y, height]")
    if not (abs(eye[0]) <= _DEEPEST and all(abs(v) <= _PLACES for v in eye[1:3]) and _LOWEST <= eye[3] <= _HIGHEST):
        raise members.fault("eye", f"a level within {_DEEPEST} and a height above 0")
    turn, tilt = members.number("turn", 0.0, lo=-360.0, hi=360.0), members.number("tilt", _TILT, lo=-90.0, hi=90.0)
    level, x, y, height = eye
    return Outlook(level, x, y, height, turn, tilt, members.number("fov", _FOV, lo=1.0, hi=150.0))


def write_outlook(told: Outlook) -> dict[str, object]:
    """Tells its members; `read_outlook` is the inverse."""
    return {
        "eye": [told.level, told.x, told.y, told.height],
        "turn": told.turn,
        "tilt": told.tilt,
        "fov": told.fov,
    }
