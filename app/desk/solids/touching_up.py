"""Painting on an object: where the pen's ray meets it, and the voxels that change while the pen moves."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from immutables import Map

from app.desk.solids.painted_cube import as_bytes
from app.desk.solids.shown_solid import EYE_AWAY, Carved, turned_by
from engine.brush.settings import Brush
from engine.painting.layering.touch_command import TOUCH_POINTS_CAP, VOXELS, WIDEST_TOUCH, Touch
from engine.painting.points import plain

if TYPE_CHECKING:
    from app.desk.solids.shown_solid import Aspect

_LEAST = 0.4  # of a pixel: a shorter way is none
_JUMP = 6.0  # times the way on the picture: from one part of the object to another
_FELT = ("radius", "opacity", "hardness")
_FINEST = 1.0 / 96.0  # units: strokes thinner than a voxel are shown, as the engine shows them
_THINNEST = 0.75


class Met(NamedTuple):
    """Where a ray meets an object: `place`, in voxels of the solid; how many of these a pixel is there."""

    place: tuple[float, float, float]
    voxels: float


class ObjectSeen:
    """An object as the picture shows it, for rays through its pixels."""

    def __init__(self, seen: Aspect) -> None:
        self.of = seen
        width, height = seen.room
        points = seen.carved.corners[:, :3].astype(np.float64)
        turned = points @ turned_by(*seen.turn).T
        self._away = EYE_AWAY - turned[:, 2]
        self._lens = 0.5 * height / seen.carved.nearness * min(1.0, width / height)
        across, down = turned[:, 0] / self._away * self._lens, turned[:, 1] / self._away * self._lens
        self._corners = np.stack([0.5 * width + across, 0.5 * height - down], axis=1)
        self._points, self._faces = points, seen.carved.faces
        boxes = self._corners[self._faces]
        self._low, self._high = boxes.min(axis=1), boxes.max(axis=1)

    def hit(self, x: float, y: float) -> Met | None:
        """Returns where the ray through a place of the picture meets the object first."""
        at = np.array((x, y))
        near = np.nonzero(((self._low <= at) & (self._high >= at)).all(axis=1))[0]
        faces = self._faces[near]
        a, b, c = (self._corners[faces[:, corner]] for corner in range(3))
        area = _cross(b - a, c - a)
        with np.errstate(divide="ignore", invalid="ignore"):
            u, v = _cross(at - a, c - a) / area, _cross(b - a, at - a) / area
        inside = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0)
        if not inside.any():
            return None
        # On the picture 1 / distance is linear, in space distance is.
        shares = np.stack([1.0 - u - v, u, v], axis=1)[inside] / self._away[faces[inside]]
        away = 1.0 / shares.sum(axis=1)
        nearest = int(np.argmin(away))
        weights = shares[nearest] * away[nearest]
        place = (weights[:, None] * self._points[faces[inside][nearest]]).sum(axis=0)
        scale = self.of.scale
        px, py, pz = (VOXELS * (place * scale + 0.5)).tolist()
        return Met((px, py, pz), VOXELS * scale * float(away[nearest]) / self._lens)


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    out: np.ndarray = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return out


def brush_on_solid(brush: Brush, radius: float) -> Brush:
    """Returns what of a brush counts on a solid; `radius`: in voxels."""
    from engine.brush.dynamics import DYNAMIC, knots_of  # these have kernels: the window is there before
    from engine.brush.felt import steadied

    felt, mode = steadied(brush).dynamics, "erase" if brush.row.takes_away else "paint"
    curves = Map({name: knots_of(felt[name]) for name in DYNAMIC if name in felt and name in _FELT})
    return Brush(
        min(max(round(radius, 3), 0.5), WIDEST_TOUCH),
        brush.hardness,
        brush.opacity,
        mode=mode,
        colour=brush.colour,
        dynamics=curves,
    )


@dataclass(eq=False)
class TouchUp:
    """A stroke that is being painted on an object; `before`: what was carved when it began."""

    solid: str
    brush: Brush
    before: Carved
    points: list[tuple[float, float, float, float]] = field(default_factory=list)
    breaks: list[int] = field(default_factory=list)
    _covered: np.ndarray | None = None
    _now: np.ndarray | None = None
    _last: tuple[float, float] | None = None
    _per_pixel: float = 1.0

    def go(self, met: Met | None, x: float, y: float, pressure: float) -> Carved | None:
        """Goes on to where the ray through a place of the picture meets the object, or leaves it; returns what is
        carved then, None if nothing changes."""
        if met is None or len(self.points) >= TOUCH_POINTS_CAP:
            self._last = None
            return None
        row = (*(round(value, 3) for value in met.place), round(min(max(pressure, 0.0), 1.0), 4))
        point = row[0], row[1], row[2], row[3]
        joined = self._last is not None
        if self._last is not None:
            gone = float(np.hypot(x - self._last[0], y - self._last[1]))
            if gone < _LEAST:
                return None
            way = np.array(point[:3]) - np.array(self.points[-1][:3])
            joined = float(np.sqrt(way @ way)) <= _JUMP * gone * max(met.voxels, self._per_pixel)
        if self.points and not joined:
            self.breaks.append(len(self.points))
        self.points.append(point)
        self._last, self._per_pixel = (x, y), met.voxels
        return self._shown(self.points[-2] if joined else point, point)

    def told(self) -> Touch:
        """Returns the command that paints it."""
        points = tuple((plain(x), plain(y), plain(z), p) for x, y, z, p in self.points)
        return Touch(self.solid, points, self.brush, tuple(self.breaks))

    def _shown(self, a: tuple[float, ...], b: tuple[float, ...]) -> Carved:
        """What is carved, with a line more."""
        from engine.brush.dynamics import evaluate

        bare, cube, shown = self.before.plain, self.before.cube, self._cube()
        sides = bare.shape[:3]
        covered = np.zeros(sides, np.float32) if self._covered is None else self._covered
        self._covered = covered
        ends = np.array((a, b))
        radius, opacity, hardness = (
            getattr(self.brush, name) * evaluate(self.brush.dynamics.get(name), ends[:, 3]) for name in _FELT
        )
        voxel = min(1.0 / max(sides), _FINEST)
        outer = max(float(radius.max()) / VOXELS, _THINNEST * voxel)
        ends = ends[:, :3] / VOXELS
        places, middles = _around(ends, outer, sides)
        z, y, x = np.meshgrid(*middles, indexing="ij", sparse=True)
        gone, way = (x - ends[0, 0], y - ends[0, 1], z - ends[0, 2]), ends[1] - ends[0]
        along = (gone[0] * way[0] + gone[1] * way[1] + gone[2] * way[2]) / max(float(way @ way), 1e-12)
        t = np.clip(along, 0.0, 1.0)
        far = sum((g - t * w) ** 2 for g, w in zip(gone, way, strict=True))
        inner = max(min(float(hardness.max()) * outer, outer - voxel), 0.0)
        u = np.clip((far - inner * inner) / (outer * outer - inner * inner), 0.0, 1.0)
        cover = float(opacity.max()) * (1.0 - u) ** 2 * (1.0 + 2.0 * u)
        covered[places] = np.maximum(covered[places], cover)
        colour = [int(self.brush.colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
        to = bare[places] / 255.0 if self.brush.row.takes_away else np.array(colour)
        old = cube[places] / 255.0
        shown[places] = as_bytes(old + (to - old) * covered[places][..., None])
        return replace(self.before, cube=shown)

    def _cube(self) -> np.ndarray:
        """The voxels as they are by now, to be written to."""
        self._now = (self.before.cube if self._now is None else self._now).copy()
        return self._now


def _around(ends: np.ndarray, reach: float, sides: tuple[int, ...]) -> tuple[tuple[np.ndarray, ...], list[np.ndarray]]:
    """Which voxels lie around a line, in the order z, y, x, and where their middles are, beyond the unit, too."""
    numbers = []
    for axis, side in zip((2, 1, 0), sides, strict=True):
        low, high = float(ends[:, axis].min()) - reach, float(ends[:, axis].max()) + reach
        first = int(np.floor(low * side - 0.5))
        last = min(int(np.ceil(high * side - 0.5)), first + side - 1)
        numbers.append(np.arange(first, last + 1))
    middles = [(number + 0.5) / side for number, side in zip(numbers, sides, strict=True)]
    return np.ix_(*(number % side for number, side in zip(numbers, sides, strict=True))), middles
