"""The panel of solids as the window knows it: which material on which object, how it is turned, what is carved."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np

from engine.solids.material_sliders import MATERIALS

OBJECTS = ("sphere", "cube", "torus", "vase", "teapot", "knot", "bust")
USUAL_OBJECT = "teapot"
FIRST_SIDE, LAST_SIDE = 48, 96  # voxels of the cube that is shown at once, and of the one that follows
_STEEP = 2  # of a slice's normal, in whole numbers
_MOST_TILT = 100.0

Made = tuple[str, int, tuple[tuple[str, float], ...]]  # a material, its seed and values


@dataclass(frozen=True, slots=True, eq=False)
class Carved:
    """What there is to show: `cube`: uint8 (z, y, x, 3) of what was `made`; `corners`: float32 (V, 6), places and
    normals of the object `name`; `faces`: int32 (F, 3); `fewer`: of those that are drawn while it turns."""

    made: Made
    cube: np.ndarray
    name: str
    corners: np.ndarray
    faces: np.ndarray
    fewer: np.ndarray

    @property
    def gloss(self) -> float:
        """Returns how much the material mirrors."""
        return MATERIALS[self.made[0]].gloss


@dataclass(slots=True)
class SolidState:
    """`name`: of an object, or the path of a mesh; `turn`: degrees about the upright axis, and forwards; `scale`: of
    the solid; `depth`: of the slice that becomes ink; `room`: pixels of the picture; `turning`: by hand, right now;
    `busy`: something is being carved; `awaited`: the texture that is to be ink."""

    material: str = "agate"
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
        return 0 if len(held.cube) >= LAST_SIDE else LAST_SIDE

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
