"""The panel of solids as the window knows it: which material on which object, how it is turned, what is carved."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from engine.solids.solid_lookup import Lookup

OBJECTS = ("sphere", "cube", "torus", "vase", "teapot", "knot", "bust")
USUAL_OBJECT, USUAL_MATERIAL = "teapot", "agate"
FIRST_SIDE, LAST_SIDE = 48, 96  # voxels of the cube that is shown at once, and of the one that follows
SMALLEST_ROOM = 8  # pixels of a picture that is worth drawing
_STEEP = 2  # of a slice's normal, in whole numbers
_MOST_TILT = 100.0

Made = tuple[str, int, tuple[tuple[str, float], ...]]  # a material, or a cube's path; its seed; values of sliders


@dataclass(frozen=True, slots=True, eq=False)
class Carved:
    """What there is to show: `solid`: what was `made`; `cube`: uint8 (z, y, x, 3) of it, the `whole` of it if there are
    no finer ones; `corners`: float32 (V, 6), places and normals of the object `name`; `faces`: int32 (F, 3); `fewer`:
    of those that are drawn while it turns."""

    made: Made
    solid: Lookup
    cube: np.ndarray
    whole: bool
    name: str
    corners: np.ndarray
    faces: np.ndarray
    fewer: np.ndarray


class Aspect(NamedTuple):
    """Which object is seen, in how many pixels, how it is turned, and the scale of the solid."""

    carved: Carved
    room: tuple[int, int]
    turn: tuple[float, float]
    scale: float


@dataclass(frozen=True, slots=True, eq=False)
class AtRest:
    """An object as it was seen while it rested, with all that the solid has of detail: uint8 (h, w, 3)."""

    of: Aspect
    pixels: np.ndarray


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
    while nobody has looked; `growing`: the cube that grows."""

    material: str = USUAL_MATERIAL
    name: str = USUAL_OBJECT
    seed: int = 1
    values: dict[str, dict[str, float]] = field(default_factory=dict)
    turn: tuple[float, float] = (-30.0, 22.0)
    scale: float = 0.42
    depth: float = 0.5
    room: tuple[int, int] = (0, 0)
    turning: bool = False
    carved: Carved | None = None
    busy: bool = False
    awaited: str = ""
    rest: AtRest | None = None
    resting: Aspect | None = None
    cubes: tuple[str, ...] | None = None
    growing: Growth | None = None

    @property
    def made(self) -> Made:
        """Returns the material as it is set."""
        return self.material, self.seed, tuple(sorted(self.values.get(self.material, {}).items()))

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
        if held is None or (held.made, held.name) != (self.made, self.name):
            return FIRST_SIDE if held is None or held.made != self.made else len(held.cube)
        return 0 if held.whole else LAST_SIDE

    @property
    def seen(self) -> Aspect | None:
        """Returns what is seen while it rests; None while it is turned, or something finer is carved."""
        if self.carved is None or self.turning or self.lacks or min(self.room) < SMALLEST_ROOM:
            return None
        return Aspect(self.carved, self.room, self.turn, self.scale)

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


def turned_by(about: float, tilt: float) -> np.ndarray:
    """Returns what turns an object, z upwards, for an eye that looks along -z and has y above: (3, 3)."""
    a, b = np.radians((about, tilt))
    first = np.array(((np.cos(a), -np.sin(a), 0.0), (np.sin(a), np.cos(a), 0.0), (0.0, 0.0, 1.0)))
    upright = np.array(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)))
    forwards = np.array(((1.0, 0.0, 0.0), (0.0, np.cos(b), -np.sin(b)), (0.0, np.sin(b), np.cos(b))))
    out: np.ndarray = forwards @ upright @ first
    return out
