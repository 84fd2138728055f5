"""Pictures of objects made of solids: on a ground, in the light of a studio, without a graphics card."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from engine.solids.depth import draw_triangles
from engine.solids.mesh import Mesh, unit
from engine.solids.solid_lookup import Lookup
from engine.solids.studio_light import FILL, KEY, Lights, lights_on

_BAND = 32  # rows of the picture at a time
_EYE = np.array((0.0, -6.2, 2.1))
AWAY = 6.4  # from the middle of a body that is afloat
_FAR = 40.0  # half the ground's width
_GROUND = np.array((0.50, 0.475, 0.45)) ** 2.2
_BACK = np.array((0.36, 0.35, 0.345)) ** 2.2
_EXPOSURE = 0.62


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """An object in a scene: its mesh, its solid, how it is turned (3 x 3), its size and where its middle is; a unit of
    the solid is 1 / `scale` of half the object's length."""

    mesh: Mesh
    solid: Lookup
    turned: np.ndarray = field(default_factory=lambda: np.eye(3))
    size: float = 1.0
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    scale: float = 0.42

    def points(self) -> np.ndarray:
        """Returns where its points are in the scene."""
        out: np.ndarray = self.mesh.points @ (self.size * self.turned).T + np.array(self.at)
        return out

    def standing(self) -> Body:
        """Returns the same, resting on the ground, z = 0."""
        low = float(self.points()[:, 2].min())
        return Body(self.mesh, self.solid, self.turned, self.size, (*self.at[:2], self.at[2] - low), self.scale)


def turning(about: float, tilt: float) -> np.ndarray:
    """Returns what turns by degrees about the upright axis, and then tilts towards the eye: (3, 3)."""
    a, b = np.radians((about, tilt))
    first = np.array(((np.cos(a), -np.sin(a), 0.0), (np.sin(a), np.cos(a), 0.0), (0.0, 0.0, 1.0)))
    second = np.array(((1.0, 0.0, 0.0), (0.0, np.cos(b), -np.sin(b)), (0.0, np.sin(b), np.cos(b))))
    out: np.ndarray = second @ first
    return out


class Camera:
    """Looks from `eye` at `target`; `half` the width that is seen there, at most, as is its height times the sides."""

    def __init__(self, size: tuple[int, int], target: np.ndarray, reach: float, eye: np.ndarray = _EYE) -> None:
        self.width, self.height = size
        self.eye = target + eye
        self.ahead = unit(target - self.eye)
        self.right = unit(np.cross(self.ahead, (0.0, 0.0, 1.0)))
        self.up = np.cross(self.right, self.ahead)
        self.lens = min(size) / (2.0 * reach) * float(np.sqrt(eye @ eye))  # pixels at distance 1

    def corners(self, points: np.ndarray) -> np.ndarray:
        """Returns pixels x and y, and 1 / distance, of points before the camera."""
        gone = points - self.eye
        near = 1.0 / np.maximum(gone @ self.ahead, 1e-3)
        x = self.width / 2.0 + self.lens * (gone @ self.right) * near
        y = self.height / 2.0 - self.lens * (gone @ self.up) * near
        return np.stack([x, y, near], axis=1)

    def rays(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Returns directions through pixels, 1 long along `ahead`."""
        across, up = (x - self.width / 2.0) / self.lens, (self.height / 2.0 - y) / self.lens
        out: np.ndarray = self.ahead + across[:, None] * self.right + up[:, None] * self.up
        return out


class Arrangement:
    """Bodies on a ground as a camera sees them; or afloat, before the `behind`, a colour as a screen shows it."""

    def __init__(
        self,
        bodies: list[Body],
        target: np.ndarray,
        reach: float,
        eye: np.ndarray = _EYE,
        behind: tuple[float, float, float] | None = None,
    ) -> None:
        self.bodies, self.target, self.reach, self.eye = bodies, target, reach, eye
        self._behind = None if behind is None else _light_of(np.array(behind))
        self._points = [body.points() for body in bodies]
        self._starts = np.cumsum([0, *(len(body.mesh.faces) for body in bodies)])
        before = np.cumsum([0, *(len(points) for points in self._points)])
        faces = [body.mesh.faces + start for body, start in zip(bodies, before, strict=False)]
        self.lights: Lights = lights_on(np.concatenate(self._points), np.concatenate(faces).astype(np.int32))

    def picture(
        self, size: tuple[int, int], samples: int = 3, tell: Callable[[int], None] = lambda done: None
    ) -> np.ndarray:
        """Returns uint8 (h, w, 3), of `samples` squared samples a pixel; `tell` hears how many rows are done."""
        out = np.empty((size[1], size[0], 3), np.uint8)
        for top, rows in self.bands(size, samples):
            out[top : top + len(rows)] = rows
            tell(top + len(rows))
        return out

    def bands(self, size: tuple[int, int], samples: int) -> Iterator[tuple[int, np.ndarray]]:
        """Yields some rows of the picture after others: which is the first of them, and uint8 (rows, w, 3)."""
        width, height = size
        camera = Camera((width * samples, height * samples), self.target, self.reach, self.eye)
        corners = [camera.corners(points) for points in self._points]
        for top in range(0, height, _BAND):
            rows = min(_BAND, height - top)
            light = self._band(camera, corners, top * samples, rows * samples)
            light = _shown(light).reshape(rows, samples, width, samples, 3).mean(axis=(1, 3))
            yield top, np.rint(255.0 * light).astype(np.uint8)

    def _band(self, camera: Camera, corners: list[np.ndarray], top: int, rows: int) -> np.ndarray:
        """Light (rows * width, 3) of some rows of samples."""
        nearest = np.zeros((rows, camera.width), np.float32)
        names = np.full((rows, camera.width), -1, np.int32)
        for body, places, first in zip(self.bodies, corners, self._starts, strict=False):
            draw_triangles(places, body.mesh.faces, first, nearest, names, top)
        y, x = np.mgrid[top : top + rows, 0 : camera.width] + 0.5
        rays = camera.rays(x.reshape(-1), y.reshape(-1))
        flat = names.reshape(-1)
        out = self._ground(camera, rays, flat < 0) if self._behind is None else np.tile(self._behind, (len(rays), 1))
        for n, (body, places) in enumerate(zip(self.bodies, corners, strict=True)):
            here = np.nonzero((flat >= self._starts[n]) & (flat < self._starts[n + 1]))[0]
            if len(here):
                faces = body.mesh.faces[flat[here] - self._starts[n]]
                shares = _shares(places, faces, x.reshape(-1)[here], y.reshape(-1)[here])
                out[here] = self._surface(camera, n, faces, shares, rays[here])
        return out

    def _surface(
        self, camera: Camera, which: int, faces: np.ndarray, shares: np.ndarray, rays: np.ndarray
    ) -> np.ndarray:
        body = self.bodies[which]
        inside = (body.mesh.points[faces] * shares[..., None]).sum(axis=1)
        normals = unit((body.mesh.normals[faces] * shares[..., None]).sum(axis=1)) @ body.turned.T
        points = inside @ (body.size * body.turned).T + np.array(body.at)
        view = -unit(rays)
        behind = (normals * view).sum(axis=1) < 0.0
        normals[behind] = -normals[behind]
        pixel = float(np.median((points - camera.eye) @ camera.ahead)) / camera.lens
        colours = body.solid.colours(inside * body.scale + 0.5, pixel / body.size * body.scale) ** 2.2
        light = self.lights.at(points, normals)
        mirrored = unit(2.0 * (normals * view).sum(axis=1, keepdims=True) * normals - view)
        facing = np.clip((normals * view).sum(axis=1, keepdims=True), 0.0, 1.0)
        share = body.solid.gloss * (0.045 + 0.75 * (1.0 - facing) ** 5)
        free = np.clip(light.mean(axis=1, keepdims=True) / 1.2, 0.25, 1.0)
        out: np.ndarray = colours * light * (1.0 - 0.5 * share) + share * free * _room(mirrored, body.solid.gloss)
        return out

    def _ground(self, camera: Camera, rays: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        """The ground and what is behind it, into which it fades."""
        out = np.zeros((len(rays), 3))
        fall = np.where(rays[:, 2] < -1e-6, -camera.eye[2] / np.minimum(rays[:, 2], -1e-6), np.inf)
        points = camera.eye + np.minimum(fall, 1e4)[:, None] * rays
        gone = np.sqrt(((points - self.target)[:, :2] ** 2).sum(axis=1)) / self.reach
        faded = np.clip((gone - 1.3) / 4.5, 0.0, 1.0)
        faded = np.where(np.isfinite(fall), faded * faded * (3.0 - 2.0 * faded), 1.0)[:, None]
        out[:] = _BACK * (1.0 + 0.35 * np.clip(1.0 - np.abs(rays[:, 2:] + 0.30) * 2.2, -0.6, 1.0))
        here = np.nonzero(wanted & (faded[:, 0] < 1.0))[0]
        if len(here):
            upward = np.zeros((len(here), 3))
            upward[:, 2] = 1.0
            ground = _GROUND * self.lights.at(points[here], upward)
            out[here] = ground + (out[here] - ground) * faded[here]
        return out


def afloat(body: Body, reach: float, behind: tuple[float, float, float]) -> Arrangement:
    """Returns the scene of one body that the eye looks straight at, from AWAY; `reach`: of the picture's half height
    for a unit, at distance 1; `behind`: the colour behind it."""
    return Arrangement([body], np.zeros(3), reach * AWAY, np.array((0.0, -AWAY, 0.0)), behind)


def framed(bodies: list[Body]) -> Arrangement:
    """Returns the scene of bodies, seen so that all of them are in the picture."""
    points = np.concatenate([body.points() for body in bodies])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    camera = Camera((2, 2), middle, 1.0)
    gone = points - camera.eye
    ahead = gone @ camera.ahead
    across = np.maximum(np.abs(gone @ camera.right), np.abs(gone @ camera.up)) / ahead
    return Arrangement(bodies, middle, 1.14 * float(across.max()) * float(np.sqrt(_EYE @ _EYE)))


def _shares(corners: np.ndarray, faces: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """How much of each corner of its triangle a place has in space: (N, 3)."""
    a, b, c = (corners[faces[:, corner]] for corner in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    u = ((x - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (y - a[:, 1])) / area
    v = ((b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])) / area
    # On the picture 1 / distance is linear, in space distance is.
    out = np.stack([(1.0 - u - v) * a[:, 2], u * b[:, 2], v * c[:, 2]], axis=1)
    total: np.ndarray = out / out.sum(axis=1, keepdims=True)
    return total


def _room(towards: np.ndarray, gloss: float) -> np.ndarray:
    """What a smooth surface mirrors: two windows of light, a bright ceiling, the ground."""
    soft = 0.02 + 0.10 * (1.0 - gloss)
    up = towards[:, 2:]
    out: np.ndarray = np.where(up > 0.0, 0.30 + 0.55 * up, 0.12) * np.array((0.95, 1.0, 1.05))
    for lamp, wide, strength in ((KEY, 0.17, 11.0), (FILL, 0.26, 2.2)):
        across = unit(np.cross((0.0, 0.0, 1.0), lamp))
        over = np.cross(lamp, across)
        ahead = np.maximum(towards @ lamp, 1e-3)
        u, v = np.abs(towards @ across) / ahead, np.abs(towards @ over) / ahead
        edge = np.clip((wide - np.maximum(u, 1.0 * v)) / soft + 0.5, 0.0, 1.0) * (towards @ lamp > 0.0)
        bright = strength * (1.0 - 0.75 * gloss * (1.0 - gloss)) * edge
        out = out + bright[:, None] * np.array((1.0, 0.96, 0.9))
    return out


def _light_of(shown: np.ndarray) -> np.ndarray:
    """Light of which a screen shows this: the other way of `_shown`."""
    y = shown**2.2
    a, b = 2.51 - 2.43 * y, 0.03 - 0.59 * y
    out: np.ndarray = (np.sqrt(b * b + 0.56 * a * y) - b) / (2.0 * a) / _EXPOSURE
    return out


def _shown(light: np.ndarray) -> np.ndarray:
    """Light as a screen shows it: bright places are compressed as a film does it."""
    x = np.maximum(light, 0.0) * _EXPOSURE
    film = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
    out: np.ndarray = np.clip(film, 0.0, 1.0) ** (1.0 / 2.2)
    return out
