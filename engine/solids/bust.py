"""A bust, carved by signed distances: head, neck and shoulders of balls and rods that flow into one another.

Distances are those to ellipsoids, near enough at their surface; `k` says over what length two bodies blend (Quilez'
polynomial minimum).  The head is 1 high and looks along -y.
"""

from __future__ import annotations

import numpy as np

from engine.solids.isosurface import zero_surface
from engine.solids.mesh import Mesh, meshed, unit_sized

_CELL = 0.0195
_LOW, _HIGH = np.array((-1.0, -0.68, -1.12)), np.array((1.0, 0.70, 1.18))  # the box of x, y, z

_Place = tuple[float, float, float]


def carved() -> Mesh:
    """Returns the bust as a mesh, 2 high."""
    axes = [np.arange(low, high, _CELL) for low, high in zip(_LOW, _HIGH, strict=True)]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij", sparse=True)
    values = _Body(x, y, z).bust()
    points, faces = zero_surface(values)
    return meshed(unit_sized(points * _CELL), faces, 70.0)


def _union(a: np.ndarray, b: np.ndarray, k: float) -> np.ndarray:
    h = np.maximum(k - np.abs(a - b), 0.0) / k
    out: np.ndarray = np.minimum(a, b) - h * h * k * 0.25
    return out


def _less(a: np.ndarray, b: np.ndarray, k: float) -> np.ndarray:
    """The first without the second."""
    return -_union(-a, b, k)


class _Body:
    """The places, x >= 0 standing for both sides."""

    def __init__(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> None:
        self.x, self.y, self.z = np.abs(x), y, z

    def ball(self, at: _Place, radii: _Place) -> np.ndarray:
        """Distance to an ellipsoid."""
        p = [(axis - c) / r for axis, c, r in zip((self.x, self.y, self.z), at, radii, strict=True)]
        near = np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2)
        slope = np.sqrt(sum((axis / r) ** 2 for axis, r in zip(p, radii, strict=True)))
        out: np.ndarray = near * (near - 1.0) / np.maximum(slope, 1e-9)
        return out

    def rod(self, a: _Place, b: _Place, ra: float, rb: float) -> np.ndarray:
        """Distance to a rod with round ends, from radius ra at `a` to rb at `b`."""
        along = np.subtract(b, a)
        p = [axis - c for axis, c in zip((self.x, self.y, self.z), a, strict=True)]
        t = sum(q * d for q, d in zip(p, along, strict=True)) / float(along @ along)
        t = np.clip(t, 0.0, 1.0)
        gone = sum((q - d * t) ** 2 for q, d in zip(p, along, strict=True))
        out: np.ndarray = np.sqrt(gone) - (ra + (rb - ra) * t)
        return out

    def bust(self) -> np.ndarray:
        """Returns the distance to all of it, on its foot."""
        trunk = self.rod((0.0, 0.10, -0.22), (0.0, 0.03, 0.22), 0.185, 0.165)  # the neck
        cords = self.rod((0.05, -0.12, -0.30), (0.20, 0.10, 0.25), 0.035, 0.03)
        trunk = _union(trunk, cords, 0.07)
        slope = self.rod((0.08, 0.14, -0.16), (0.58, 0.10, -0.42), 0.12, 0.13)
        trunk = _union(trunk, slope, 0.16)
        chest = self.ball((0.0, 0.06, -0.62), (0.62, 0.30, 0.42))
        trunk = _union(trunk, chest, 0.18)
        trunk = _union(trunk, self.ball((0.62, 0.08, -0.52), (0.20, 0.19, 0.22)), 0.14)
        bones = self.rod((0.05, -0.17, -0.335), (0.50, -0.03, -0.325), 0.032, 0.03)
        trunk = _union(trunk, bones, 0.06)
        trunk = np.maximum(trunk, self.ball((0.0, 0.02, -0.15), (0.92, 0.60, 0.60)))  # cut round below
        foot = self.rod((0.0, 0.06, -0.84), (0.0, 0.06, -0.62), 0.14, 0.12)
        base = np.maximum(np.sqrt(self.x**2 + (self.y - 0.06) ** 2) - 0.30, np.abs(self.z + 0.93) - 0.055) - 0.012
        out = _union(_union(trunk, foot, 0.10), base, 0.06)
        return _union(out, self.head(), 0.06)

    def head(self) -> np.ndarray:
        """Returns the distance to the head, with its hair."""
        skull = self.ball((0.0, 0.10, 0.70), (0.335, 0.41, 0.36))
        face = self.ball((0.0, -0.10, 0.50), (0.255, 0.25, 0.40))
        jaw = self.rod((0.0, -0.20, 0.19), (0.17, 0.04, 0.36), 0.085, 0.08)
        head = _union(_union(skull, face, 0.12), jaw, 0.12)
        head = _union(head, self.ball((0.0, -0.285, 0.165), (0.075, 0.065, 0.065)), 0.07)  # the chin
        head = _union(head, self.ball((0.165, -0.235, 0.47), (0.085, 0.07, 0.07)), 0.09)  # cheekbones
        head = _union(head, self.rod((0.02, -0.345, 0.655), (0.175, -0.275, 0.665), 0.030, 0.022), 0.05)  # brows
        head = _less(head, self.ball((0.115, -0.365, 0.575), (0.085, 0.075, 0.052)), 0.06)  # sockets
        head = _union(head, self.ball((0.115, -0.265, 0.573), (0.062, 0.060, 0.050)), 0.012)  # eyes
        lid = self.rod((0.06, -0.318, 0.588), (0.115, -0.325, 0.607), 0.013, 0.013)
        lid = _union(lid, self.rod((0.115, -0.325, 0.607), (0.172, -0.290, 0.582), 0.013, 0.011), 0.015)
        lid = _union(lid, self.rod((0.065, -0.312, 0.548), (0.165, -0.288, 0.546), 0.010, 0.009), 0.01)
        head = _union(head, lid, 0.018)
        return self._features(head)

    def _features(self, head: np.ndarray) -> np.ndarray:
        """Nose, mouth, ears and hair."""
        nose = self.rod((0.0, -0.335, 0.63), (0.0, -0.430, 0.425), 0.034, 0.046)
        nose = _union(nose, self.ball((0.052, -0.375, 0.405), (0.032, 0.042, 0.030)), 0.03)
        nose = _less(nose, self.ball((0.026, -0.415, 0.372), (0.016, 0.026, 0.018)), 0.012)
        head = _union(head, nose, 0.045)
        head = _union(head, self.ball((0.0, -0.315, 0.285), (0.10, 0.045, 0.055)), 0.05)
        upper = self.rod((0.018, -0.368, 0.304), (0.088, -0.325, 0.283), 0.020, 0.009)
        lower = self.rod((0.0, -0.360, 0.262), (0.070, -0.330, 0.272), 0.024, 0.011)
        head = _union(_union(head, upper, 0.012), lower, 0.014)
        head = _less(head, self.rod((0.0, -0.385, 0.284), (0.085, -0.345, 0.280), 0.005, 0.004), 0.012)
        ear = self.ball((0.325, 0.06, 0.52), (0.035, 0.075, 0.115))
        ear = _less(ear, self.ball((0.365, 0.045, 0.53), (0.035, 0.042, 0.072)), 0.025)
        head = _union(head, ear, 0.03)
        return _union(head, self._hair(), 0.02)

    def _hair(self) -> np.ndarray:
        """A cap of waves that run back from the brow, and a knot behind."""
        cap = self.ball((0.0, 0.125, 0.725), (0.372, 0.425, 0.385))
        turn = np.arctan2(self.x, self.z - 0.60)
        waves = np.sin(16.0 * turn + 4.0 * np.sin(5.0 * self.y + 2.0 * turn)) * 0.016
        open_face = self.ball((0.0, -0.42, 0.52), (0.262, 0.40, 0.335))
        cap = _less(cap - waves, open_face, 0.04)
        cap = np.maximum(cap, 0.36 - self.z + 0.20 * np.minimum(-self.y, 0.4))
        knot = self.ball((0.0, 0.53, 0.66), (0.15, 0.13, 0.15))
        return _union(cap, knot - 0.6 * waves, 0.05)
