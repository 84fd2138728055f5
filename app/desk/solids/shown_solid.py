"""What the panel of solids shows: an object that is carved of a solid, and how it is seen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from engine.solids.material_sliders import MATERIALS

if TYPE_CHECKING:
    from engine.painting.layering.touch_command import Touch
    from engine.solids.solid_lookup import Lookup

MAP_SCALE = 0.49  # of what is wrapped around an object: all of that lies in the cube once, and half a voxel beside it
NEARNESS, EYE_AWAY = 0.17, 6.4  # of the picture's half height for a unit at distance 1; of the eye from the middle
# A material, or the path of a cube or picture; its seed; values of sliders, or around which object it goes how often.
Made = tuple[str, int, tuple[tuple[str, float], ...]]


@dataclass(frozen=True, slots=True, eq=False)
class Carved:
    """What there is to show: `solid`: what was `made`, with the paint of `touches` on it; `cube`: uint8 (z, y, x, 3) of
    it, the `whole` of it if there are no finer ones, and `plain`, the same without paint; `corners`: float32 (V, 6),
    places and normals of the object `name`; `faces`: int32 (F, 3); `fewer`: of those that are drawn while it turns."""

    made: Made
    solid: Lookup
    plain: np.ndarray
    touches: tuple[Touch, ...]
    cube: np.ndarray
    whole: bool
    name: str
    corners: np.ndarray
    faces: np.ndarray
    fewer: np.ndarray

    def scale(self, asked: float) -> float:
        """Returns the scale by which the solid is looked up, where one is asked for."""
        return MAP_SCALE if is_wrapped(self.made) else asked

    @property
    def nearness(self) -> float:
        """Gives the picture's half height for a unit at distance 1, so that all of the object is seen however it is
        turned: corners of a cube reach farther than a unit."""
        places = self.corners[:, :3]
        return NEARNESS * max(1.0, float(np.sqrt(np.einsum("ij,ij->i", places, places).max(initial=0.0))))


def is_wrapped(made: Made) -> bool:
    """Tells whether what is made is a picture that goes around an object."""
    material, _, values = made
    return bool(values) and material not in MATERIALS


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


def turned_by(about: float, tilt: float) -> np.ndarray:
    """Returns what turns an object, z upwards, for an eye that looks along -z and has y above: (3, 3)."""
    a, b = np.radians((about, tilt))
    first = np.array(((np.cos(a), -np.sin(a), 0.0), (np.sin(a), np.cos(a), 0.0), (0.0, 0.0, 1.0)))
    upright = np.array(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)))
    forwards = np.array(((1.0, 0.0, 0.0), (0.0, np.cos(b), -np.sin(b)), (0.0, np.sin(b), np.cos(b))))
    out: np.ndarray = forwards @ upright @ first
    return out
