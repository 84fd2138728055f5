"""Draws painted-solids.webp: a still life of solids with paint on them, by rays and without a graphics card.

python palettes/pictures/make_painted_solids.py

Each is painted as the panel of solids does it: strokes along its surface, `touch` in a recording, over a material.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from immutables import Map
from PIL import Image

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1]))

from engine.brush.settings import Brush  # noqa: E402
from engine.painting.layering.touch_command import VOXELS, Touch  # noqa: E402
from engine.solids.objects import object_named  # noqa: E402
from engine.solids.painted.touching import Touched  # noqa: E402
from engine.solids.solid_lookup import Procedural  # noqa: E402
from engine.solids.solid_rendering import Arrangement, Body, framed, turning  # noqa: E402

SIZE, SAMPLES, QUALITY = (1200, 640), 3, 88
COBALT, SKY, CREAM, RED, LEAF, GOLD = "#1d3f94", "#7f9fd6", "#f4ead2", "#9c2a20", "#3d6b35", "#c9973a"
Line = list[tuple[float, float, float]]  # across, up, pressure; of a pattern, in half lengths of the object
TURN = 2.0 * np.pi


class Spot(NamedTuple):
    """Where a pattern lies on an object: the direction that it faces, degrees, and how high its middle is."""

    facing: float
    height: float


class Painter:
    """Lays strokes on the side of an object, as rays towards its upright axis meet it."""

    def __init__(self, name: str, scale: float) -> None:
        self.mesh, self.scale = object_named(name), scale
        self.touches: list[Touch] = []
        self._corners = self.mesh.points[self.mesh.faces]

    def line(self, spot: Spot, points: Line, colour: str, width: float) -> None:
        """Paints a line of a pattern, so wide where the pressure is 1."""
        radius = max(float(np.hypot(*self._met(np.radians(spot.facing), spot.height)[:2])), 0.05)
        told = []
        for across, up, pressure in points:
            place = self._met(np.radians(spot.facing) + across / radius, spot.height + up)
            told.append((*((place * self.scale + 0.5) * VOXELS).tolist(), pressure))
        brush = Brush(radius=0.5 * width * self.scale * VOXELS, colour=colour, hardness=0.85, dynamics=FELT)
        self.touches.append(Touch("painted", tuple(told), brush))

    def around(self, height: float, colour: str, width: float) -> None:
        """Paints a band all around."""
        told = [(*((self._met(a, height) * self.scale + 0.5) * VOXELS).tolist(), 1.0) for a in np.linspace(0, TURN, 97)]
        brush = Brush(radius=0.5 * width * self.scale * VOXELS, colour=colour, hardness=0.9, dynamics=FELT)
        self.touches.append(Touch("painted", tuple(told), brush))

    def flat(self, facing: float, points: Line, colour: str, width: float) -> None:
        """Paints a line on the flat side of a cube."""
        a = np.radians(facing)
        out, side = np.array((np.cos(a), np.sin(a), 0.0)), np.array((-np.sin(a), np.cos(a), 0.0))
        told = []
        for across, up, pressure in points:
            place = out + across * side + np.array((0.0, 0.0, up))
            told.append((*((place * self.scale + 0.5) * VOXELS).tolist(), pressure))
        brush = Brush(radius=0.5 * width * self.scale * VOXELS, colour=colour, hardness=0.9, dynamics=FELT)
        self.touches.append(Touch("painted", tuple(told), brush))

    def _met(self, angle: float, height: float) -> np.ndarray:
        """Where a level ray from outside first meets the object."""
        out = np.array((np.cos(angle), np.sin(angle), 0.0))
        side = np.array((-out[1], out[0], 0.0))
        a, b, c = (self._corners[:, k] for k in range(3))
        ends = [np.stack([p @ side, p[:, 2] - height], axis=1) for p in (a, b, c)]
        (ax, ay), (bx, by), (cx, cy) = (end.T for end in ends)
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        with np.errstate(divide="ignore", invalid="ignore"):
            u, v = (bx * cy - by * cx) / area, (cx * ay - cy * ax) / area
            w = 1.0 - u - v
            inside = (u >= -1e-9) & (v >= -1e-9) & (w >= -1e-9)
            far = np.where(inside, u * (a @ out) + v * (b @ out) + w * (c @ out), -np.inf)
        found: np.ndarray = float(far.max()) * out + np.array((0.0, 0.0, height))
        return found

    def body(self, solid: Procedural, turn: tuple[float, float], size: float, at: tuple[float, float]) -> Body:
        """Returns the object, painted."""
        painted = Touched(solid, tuple(self.touches), VOXELS)
        return Body(self.mesh, painted, turning(*turn), size, (*at, 0.0), self.scale).standing()


FELT: Map[str, object] = Map({"radius": "pressure"})


def petals(count: int, long: float, begin: float = 0.0, inner: float = 0.18) -> Iterator[Line]:
    """Yields petals around a middle, each pressed most beyond its own."""
    for k in range(count):
        turn = TURN * (k + begin) / count
        steps = np.linspace(inner, 1.0, 15)
        press = np.clip(np.sin(np.pi * steps), 0.0, 1.0) ** 0.7
        yield [(long * t * np.cos(turn), long * t * np.sin(turn), float(p)) for t, p in zip(steps, press, strict=True)]


def sprig(across: float, up: float, bend: float) -> Line:
    """A stem that bends."""
    steps = np.linspace(0.0, 1.0, 9)
    return [(across * t, up * t + bend * np.sin(np.pi * t), float(1.0 - 0.55 * t)) for t in steps]


def leaf(root: tuple[float, float], across: float, up: float) -> Line:
    """A leaf that grows from a place."""
    steps = np.linspace(0.0, 1.0, 7)
    return [(root[0] + across * t, root[1] + up * t, float(np.sin(np.pi * t) ** 0.8 + 0.04)) for t in steps]


def dot(across: float, up: float) -> Line:
    """A dab."""
    return [(across, up, 1.0)]


def flower(painter: Painter, spot: Spot, size: float, colours: tuple[str, str, str]) -> None:
    """Paints two rings of petals and what is in the middle."""
    outer, inner, middle = colours
    for line in petals(8, size):
        painter.line(spot, line, outer, 0.46 * size)
    for line in petals(8, 0.62 * size, 0.5):
        painter.line(spot, line, inner, 0.26 * size)
    painter.line(spot, dot(0.0, 0.0), middle, 0.34 * size)


def leaves(painter: Painter, spot: Spot, stem: Line, colour: str, size: float) -> None:
    """Paints a stem with leaves on both of its sides."""
    painter.line(spot, stem, colour, 0.12 * size)
    for k, (across, up, _) in enumerate(stem[2::2]):
        ahead = 1.0 if stem[-1][0] > 0 else -1.0
        for side in (1.0, -1.0):
            grown = leaf((across, up), ahead * 0.55 * size, side * (0.75 - 0.08 * k) * size)
            painter.line(spot, grown, colour, 0.34 * size)


def ring_of_dots(painter: Painter, height: float, count: int, colour: str, width: float) -> None:
    """Paints dots all around."""
    for k in range(count):
        painter.line(Spot(360.0 * k / count, height), dot(0.0, 0.0), colour, width)


def teapot() -> Body:
    """White marble in blue."""
    made = Painter("teapot", 0.42)
    for height, width in ((0.215, 0.03), (-0.40, 0.035)):
        made.around(height, COBALT, width)
    made.around(0.165, SKY, 0.014)
    ring_of_dots(made, -0.345, 40, SKY, 0.03)
    for facing in (-90.0, 90.0):
        spot = Spot(facing, -0.08)
        for across in (-0.42, 0.42):
            leaves(made, spot, sprig(across, 0.02, 0.09), COBALT, 0.15)
        flower(made, spot, 0.2, (COBALT, SKY, CREAM))
    return made.body(PORCELAIN, (-20.0, 0.0), 1.22, (0.36, 0.1))


PORCELAIN = Procedural("marble", 4, {"veins": 1.0, "turbulence": 0.5})


def vase() -> Body:
    """Wood with flowers of red and cream, as on a peasant's chest."""
    made = Painter("vase", 0.40)
    for height, colour, width in ((-0.92, GOLD, 0.05), (-0.74, RED, 0.025), (0.22, RED, 0.025), (0.5, GOLD, 0.045)):
        made.around(height, colour, width)
    ring_of_dots(made, 0.31, 28, CREAM, 0.05)
    ring_of_dots(made, -0.83, 22, CREAM, 0.045)
    for k in range(5):
        spot = Spot(72.0 * k - 90.0 + 20.0, -0.27)
        for across in (-0.3, 0.3):
            leaves(made, spot, sprig(across, -0.2, -0.1), LEAF, 0.13)
        flower(made, spot, 0.27, (RED, CREAM, GOLD) if k % 2 == 0 else (CREAM, RED, GOLD))
    return made.body(Procedural("wood", 3), (-20.0, 0.0), 1.12, (-1.42, 0.45))


def ball() -> Body:
    """Green marble with stars of gold."""
    made = Painter("sphere", 0.36)
    for height, width in ((0.42, 0.05), (-0.42, 0.05), (0.52, 0.02), (-0.52, 0.02)):
        made.around(height, GOLD, width)
    for k in range(8):
        spot = Spot(45.0 * k, 0.0)
        for line in petals(8, 0.3, inner=0.0):
            made.line(spot, [(x, y, 1.0 - 0.9 * n / 14) for n, (x, y, _) in enumerate(line)], GOLD, 0.09)
        made.line(Spot(45.0 * k + 22.5, 0.0), dot(0.0, 0.0), CREAM, 0.09)
    green = Procedural("marble", 5, {"green": 1.0, "veins": 3.0, "turbulence": 1.1})
    return made.body(green, (12.0, 14.0), 0.40, (-0.66, -0.95))


def block() -> Body:
    """A toy of wood with a letter on two sides and a flower on two."""
    made = Painter("cube", 0.30)
    for facing in (0.0, 90.0, 180.0, 270.0):
        frame = [(-0.78, -0.78), (0.78, -0.78), (0.78, 0.78), (-0.78, 0.78), (-0.78, -0.78)]
        made.flat(facing, [(x, y, 1.0) for x, y in frame], RED, 0.10)
        if facing in (90.0, 270.0):
            made.flat(facing, [(-0.40, -0.5, 1.0), (0.0, 0.5, 1.0), (0.40, -0.5, 1.0)], COBALT, 0.17)
            made.flat(facing, [(-0.25, -0.14, 1.0), (0.25, -0.14, 1.0)], COBALT, 0.15)
            continue
        for line in petals(6, 0.56):
            made.flat(facing, line, CREAM, 0.32)
        made.flat(facing, dot(0.0, 0.0), GOLD, 0.30)
    return made.body(Procedural("wood", 11, {"rings": 40.0}), (28.0, 0.0), 0.34, (1.5, -0.75))


def scene() -> Arrangement:
    """The vase, the teapot, and what lies before them."""
    bodies = [vase(), teapot(), ball(), block()]
    whole = framed(bodies)
    return Arrangement(bodies, whole.target + np.array((0.0, 0.0, -0.1)), whole.reach * 0.66)


def main() -> None:
    Image.fromarray(scene().picture(SIZE, SAMPLES)).save(FOLDER / "painted-solids.webp", quality=QUALITY, method=6)


if __name__ == "__main__":
    main()
