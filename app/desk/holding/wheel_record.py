"""How the wheel is set: its form, the harmony marked on it, and its gamut mask."""

from __future__ import annotations

import math
from dataclasses import dataclass

from app.desk.holding.gamut_mask import MOST_CORNERS, Corners, hull
from app.desk.holding.harmonies import HARMONIES
from engine.checks.field_error import FieldError
from engine.checks.values import described


@dataclass(frozen=True, slots=True)
class WheelSet:
    """`disc`: hue and chroma on a disc in place of ring and triangle; `harmony`: a row of HARMONIES; `corners`: of the
    gamut mask, where one was chosen; `masked`: it is on, which needs the disc."""

    disc: bool = False
    harmony: str = ""
    corners: Corners = ()
    masked: bool = False

    @property
    def limits(self) -> Corners:
        """Returns the corners within which is picked, none where all can be."""
        return self.corners if self.masked else ()


def wheel_told(wheel: WheelSet) -> dict[str, object]:
    """Returns it as `read_wheel` takes it."""
    corners = [[round(at.real, 4), round(at.imag, 4)] for at in wheel.corners]
    return {"disc": wheel.disc, "harmony": wheel.harmony, "corners": corners, "masked": wheel.masked}


def read_wheel(value: object) -> WheelSet:
    """Returns what a file tells of it; FieldError."""
    if not isinstance(value, dict):
        raise FieldError("wheel", described(value), "an object")
    name = value.get("harmony", "")
    corners = _corners(value.get("corners", []))
    masked = value.get("masked") is True and bool(corners)
    known = name if isinstance(name, str) and name in HARMONIES else ""
    return WheelSet(value.get("disc") is True or masked, known, corners, masked)


def _corners(value: object) -> Corners:
    expected = f"no corners, or 3 to {MOST_CORNERS} of two numbers -1..1"
    if not isinstance(value, list) or len(value) > MOST_CORNERS:
        raise FieldError("wheel.corners", described(value), expected)
    found = []
    for one in value:
        if not isinstance(one, list) or len(one) != 2 or not all(_is_part(part) for part in one):
            raise FieldError("wheel.corners", described(one), expected)
        found.append(complex(*one))
    corners = hull(found)
    if value and len(corners) < 3:
        raise FieldError("wheel.corners", described(value), expected)
    return corners


def _is_part(part: object) -> bool:
    return isinstance(part, int | float) and not isinstance(part, bool) and math.isfinite(part) and abs(part) <= 1.0001
