"""The panel of solids as the window knows it: which material on which object, how it is turned, what is carved."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from pathlib import PurePath
from typing import TYPE_CHECKING

import numpy as np

from app.desk.solids.shown_solid import Aspect, AtRest, Carved, Made, turned_by

if TYPE_CHECKING:
    from app.desk.solids.touching_up import TouchUp
    from engine.painting.layering.touch_command import Touch

OBJECTS = ("sphere", "cube", "torus", "vase", "teapot", "knot", "bust")
USUAL_OBJECT, USUAL_MATERIAL = "teapot", "agate"
SOLID_SCALES, USUAL_SCALE = (0.1, 2.0), 0.42
DEEPEST_SLICE, USUAL_DEPTH = 1.0, 0.5  # of a slice
FIRST_SIDE, LAST_SIDE = 48, 96  # voxels of the cube that is shown at once, and of the one that follows
SMALLEST_ROOM = 8  # pixels of a picture that is worth drawing
_STEEP = 2  # of a slice's normal, in whole numbers
_MOST_TILT = 100.0


@dataclass(slots=True)
class Growth:
    """How far a cube is, 0..1: written on the files' thread, looked at by the window."""

    done: float = 0.0


@dataclass(slots=True)
class SolidState:
    """`material`: its name, or the path of a cube; `name`: of an object, or the path of a mesh; `turn`: degrees about
    the upright axis, and forwards; `scale`: of the solid; `depth`: of the slice that becomes ink; `room`: pixels of the
    picture; `turning`: by hand, right now; `busy`: something is being carved; `awaited`: the texture that is to be ink;
    `rest`: what is seen at rest; `resting`: of what that is being made; `cubes`: paths of those that are kept, None
    while nobody has looked; `maps`: pictures that go around the object; `growing`: the cube that grows; `corner`:
    of the picture, on the screen; `touches`: what is painted on the solid; `painting`: the pen paints on it;
    `stroke`: the one that is being painted."""

    material: str = USUAL_MATERIAL
    name: str = USUAL_OBJECT
    seed: int = 1
    values: dict[str, dict[str, float]] = field(default_factory=dict)
    turn: tuple[float, float] = (-30.0, 22.0)
    scale: float = USUAL_SCALE
    depth: float = USUAL_DEPTH
    room: tuple[int, int] = (0, 0)
    turning: bool = False
    carved: Carved | None = None
    busy: bool = False
    awaited: str = ""
    rest: AtRest | None = None
    resting: Aspect | None = None
    cubes: tuple[str, ...] | None = None
    maps: tuple[str, ...] = ()
    growing: Growth | None = None
    corner: tuple[float, float] = (0.0, 0.0)
    touches: tuple[Touch, ...] = ()
    painting: bool = False
    stroke: TouchUp | None = None

    @property
    def wrapped(self) -> bool:
        """Tells whether a picture goes around the object, in place of a solid through it."""
        return self.material in self.maps

    def wrap(self, path: str) -> None:
        """Has a picture that tiles go around the object."""
        self.material, self.painting = path, False
        self.maps = (*(known for known in self.maps if known != path), path)

    @property
    def made(self) -> Made:
        """Returns the material as it is set."""
        if self.wrapped:
            return self.material, 0, ((self.name, round(self.scale, 3)),)
        return self.material, self.seed, tuple(sorted(self.values.get(self.material, {}).items()))

    @property
    def solid_name(self) -> str:
        """Gives the name under which a painting keeps what is painted on the solid: whatever its sliders say."""
        return PurePath(self.material).stem

    def set(self, slider: str, value: float) -> None:
        """Sets a slider of the material."""
        self.values.setdefault(self.material, {})[slider] = value

    def drag(self, across: float, down: float) -> None:
        """Turns by so many degrees."""
        about, tilt = self.turn
        self.turn = (about + across) % 360.0, max(-_MOST_TILT, min(_MOST_TILT, tilt + down))

    @property
    def lacks(self) -> int:
        """Returns the side of the cube that is to be carved next; 0 if what is shown is what is set."""
        held = self.carved
        if held is None or (held.made, held.name, held.touches) != (self.made, self.name, self.touches):
            return FIRST_SIDE if held is None or held.made != self.made else len(held.cube)
        return 0 if held.whole else LAST_SIDE

    @property
    def aspect(self) -> Aspect | None:
        """Returns what is seen of the object, finished or not."""
        if self.carved is None or min(self.room) < SMALLEST_ROOM:
            return None
        return Aspect(self.carved, self.room, self.turn, self.carved.scale(self.scale))

    @property
    def seen(self) -> Aspect | None:
        """Returns what is seen while it rests; None while it is turned, or something finer is carved."""
        return None if self.turning or self.stroke is not None or self.lacks else self.aspect

    def normal(self) -> tuple[int, int, int]:
        """Returns the direction of small whole numbers, within the object, that looks most towards the eye."""
        towards = turned_by(*self.turn)[2]
        steps = range(-_STEEP, _STEEP + 1)
        a, b, c = max((n for n in product(steps, repeat=3) if any(n)), key=lambda n: _along(n, towards))
        return a, b, c


def _along(normal: tuple[int, ...], towards: np.ndarray) -> float:
    """How much a direction goes another's way; of two that are alike, the shorter."""
    given = np.array(normal, float)
    length = float(np.sqrt((given * given).sum()))
    return round(float((given * towards).sum()) / length, 6) - 1e-9 * length
