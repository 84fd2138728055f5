"""A stroke of 1,000 points, 10,000 px long over 2000 x 2000, from pen to committed pixels at all levels.

Against libmypaint's stroke through the same points: its plain one, for textures too, as it has none; its smudging one
for what moves or evens paint.  CPU time, as one thread takes it; the pyramid and the step of the history included.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from bench import Figure, libmypaint
from bench.clock import processor, slowness
from engine.brush.settings import Brush, Component, from_json
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect
from engine.session.session import Session

POINTS, SIDE = 1000, 2000
REPEATS = 5
HARDNESS, SPACING = 0.5, 0.25
SMUDGE = 0.6  # what libmypaint takes along
AT_ONCE = 4  # points, as a frame brings them
_PUBLISHED = {(4.0, False): 82e3, (32.0, False): 31e3, (128.0, False): 9.5e3, (4.0, True): 38e3, (32.0, True): 17e3}
_INKS = {
    "rock": (Component("rock", 0.8, "#d0c0a0"),),
    "three inks": (
        Component("rock", 0.5, "#d0c0a0"),
        Component("stripes", 0.3, "#806020"),
        Component("squares", 0.2, "#a0c0e0"),
    ),
}
_EMPTY, _OVER, _OVER_INKS = "empty layer", "over paint", "over three inks"  # what strokes go onto
_MOVES: dict[str, dict[str, object]] = {
    "smooth": {"mode": "smooth"},
    "smear": {"mode": "raster", "op": {"name": "displace", "distance": 8.0}},
    "raster smooth": {"mode": "raster", "op": "smooth"},
    "erase": {"mode": "erase"},
    "wet, light": {"wet": {"length": SMUDGE, "amount": SMUDGE}},
    "wet, pigment": {"wet": {"length": SMUDGE, "amount": SMUDGE, "mixing": "pigment"}},
}


class Case(NamedTuple):
    """A row: its name, radius and brush, what it goes onto, how many times libmypaint's speed it ought to have, and how
    much of the paint libmypaint takes along."""

    name: str
    radius: float
    brush: Brush
    ground: str
    goal: float
    smudge: float = 0.0


def _cases() -> Iterator[Case]:
    for radius, goals in ((4.0, (1.3, 1.0, 1.0, 0.7)), (32.0, (3.0, 2.0, 1.5, 1.0)), (128.0, (4.0, 3.0, 2.0, 1.5))):
        brush = Brush(radius=radius, hardness=HARDNESS, spacing=SPACING, colour="#204060")
        yield Case("one colour", radius, brush, _EMPTY, goals[0])
        yield Case("one colour", radius, brush, _OVER, goals[1])
        yield Case("one colour", radius, brush, _OVER_INKS, goals[3])
        for (name, ink), goal in zip(_INKS.items(), goals[2:], strict=True):
            inked = Brush(radius=radius, hardness=HARDNESS, spacing=SPACING, colour="#204060", ink=ink)
            yield Case(name, radius, inked, _EMPTY, goal)
    for radius, goal in ((4.0, 1.0), (32.0, 1.5)):
        for name, members in _MOVES.items():
            moving = from_json({"radius": radius, "hardness": HARDNESS, "spacing": SPACING, **members})
            yield Case(name, radius, moving, _OVER, goal, 0.0 if name == "erase" else SMUDGE)


def _felt() -> Iterator[tuple[Case, Case]]:
    """Tips, what follows chance, and textures along the stroke, over paint, each with the row of its kind: the same
    texture fixed to the canvas, or one colour.  Radius, spacing, points and dabs, 1,100, are the same."""
    rock = {"texture": "rock", "amount": 0.8}
    plain: dict[str, object] = {}
    rows: dict[str, tuple[dict[str, object], dict[str, object]]] = {
        "slender": ({"shape": {"ratio": 0.3, "angle": 30}}, plain),
        "hue by dab": ({"dynamics": {"hue": {"random_dab": [[0, 0.9], [1, 1.1]]}, "opacity": "pressure"}}, plain),
        "rock along the stroke": ({"ink": [rock], "fixed": "stroke"}, {"ink": [rock]}),
        "dry along the stroke": ({"density": rock, "fixed": "stroke"}, {"density": rock}),
    }
    for name, told in rows.items():
        made, kind = (from_json({"hardness": HARDNESS, "spacing": SPACING, "radius": 32, **one}) for one in told)
        yield Case(name, 32.0, made, _OVER, 1.0), Case("its kind", 32.0, kind, _OVER, 1.0)


def measure(small: bool = False) -> Iterator[Figure]:
    repeats, points = (1, curve(20)) if small else (REPEATS, curve(POINTS))
    slow = 1.0 if libmypaint.library() else slowness()
    for case in _cases():
        yield _figure(case, points, repeats, slow)
    for case, kind in _felt():
        yield _by_kind(case, kind, points, repeats)


def _figure(case: Case, points: np.ndarray, repeats: int, slow: float) -> Figure:
    session, told = _ground(case.ground, points), [(float(x), float(y), float(p)) for x, y, p in points]
    there = libmypaint.library() is not None
    times = []
    for i in range(repeats + 1):  # the first compiles, and touches the memory
        session = Session() if case.ground == _EMPTY else session
        own = processor(lambda: stroke(session, case.brush, points + np.array([1.25 * i, 0.75 * i, 0.0])))  # noqa: B023
        theirs = libmypaint.stroke(told, case.radius, HARDNESS, SPACING, case.smudge) if there else 0.0
        times.append((own, theirs))
    taken, theirs = (min(column) for column in zip(*times[1:], strict=True))
    note = "same points and dabs, without a pyramid, measured in the same run"
    if not there:
        theirs = len(points) / _PUBLISHED[case.radius, case.smudge > 0.0] * slow
        note = f"its figure of another run, as copying takes {slow:.2f} x as long"
    name = f"{case.name}, radius {case.radius:.0f}, {case.ground}"
    bound = f"libmypaint's {len(points) / theirs:,.0f}"
    return Figure(name, len(points) / taken, "points/s", bound, theirs / taken, case.goal, True, note)


def _by_kind(case: Case, kind: Case, points: np.ndarray, repeats: int) -> Figure:
    """How fast a stroke is, and how fast the row of its kind, in turns."""
    grounds = _ground(case.ground, points), _ground(kind.ground, points)
    times = []
    for i in range(repeats + 1):  # the first compiles, and touches the memory
        moved, brushes = points + np.array([1.25 * i, 0.75 * i, 0.0]), (case.brush, kind.brush)
        times.append([processor(partial(stroke, *one, moved)) for one in zip(grounds, brushes, strict=True)])
    own, its = (min(column) for column in zip(*times[1:], strict=True))
    name, bound = f"{case.name}, radius {case.radius:.0f}, {case.ground}", f"its kind's {len(points) / its:,.0f}"
    note = "the same texture on the canvas, or one colour; same points and dabs, in the same run"
    return Figure(name, len(points) / own, "points/s", bound, its / own, case.goal, True, note)


def curve(count: int) -> np.ndarray:
    """The first points of a curve of some 10,000 px over 2000 x 2000 for 1,000 points: x, y, pressure."""
    t = np.linspace(0.0, count / POINTS, count)
    x, y = 1000 + 830 * np.sin(2 * math.tau * t + 0.4), 1000 + 830 * np.cos(1.5 * math.tau * t)
    return np.column_stack([x, y, 0.3 + 0.7 * t])


def _ground(name: str, points: np.ndarray) -> Session:
    if name == _EMPTY:
        return Session()
    return painted(points, _INKS["three inks"] if name == _OVER_INKS else ())


def painted(points: np.ndarray, ink: tuple[Component, ...] = ()) -> Session:
    """A session with paint of several colours, with some inks, wherever the points lead, and seen."""
    session = Session()
    top, bottom = (int(y) for y in (points[:, 1].min() - 160, points[:, 1].max() + 160))
    left, right = points[:, 0].min() - 160, points[:, 0].max() + 160
    for i, y in enumerate(range(top, bottom, 100)):
        colour = f"#{(40 + 53 * i) % 256:02x}{(90 + 31 * i) % 256:02x}70"
        brush = Brush(radius=90.0, hardness=0.3, colour=colour, ink=ink)
        stroke(session, brush, np.array([[left, y, 1.0], [(left + right) / 2, y + 60.0, 0.8], [right, y, 1.0]]))
    layer = next(iter(layers(session.painting.root)))
    evaluate(layer.pyramid, 0, Rect(int(left), top, int(right), bottom), session.cache)
    return session


def stroke(session: Session, brush: Brush, points: np.ndarray) -> None:
    """Paints a stroke as the window has it painted."""
    live = session.begin(0, (0, 0), brush)
    for part in np.array_split(points, max(1, len(points) // AT_ONCE)):
        live.add(part)
    session.finish(live)
