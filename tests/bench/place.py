"""Placements seen at 1920 x 1080, tile of the screen by tile, by one thread's processor time.

A placement is compared with its source seen the same way in the same run; many of them, and pictures that contain
themselves, with what a view may take.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from bench import Figure
from bench.clock import processor
from engine.canvas.attenuate import RENEWED
from engine.canvas.composite import composite
from engine.canvas.layers import EMPTY, Group, Layer, layers
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.reading import kept_planes, layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic, Similarity
from engine.painting.commands import parse
from engine.painting.rendering import piece_reader
from engine.session.session import Session
from engine.studio.requests import SCREEN_TILE

WIDTH, HEIGHT, REPEATS, CACHE = 1920, 1080, 3, 256 << 20
FRAME = SourcePart(0, Rect(0, 0, 1024, 1024))
HALF = Pose(at=(256, 300), levels=-1)
SPIRAL = Pose(at=(300, 90), turned=(0.499 * 2 * math.cos(0.4363), 0.499 * 2 * math.sin(0.4363)), levels=-1)
Work = Callable[[], object]
Cases = dict[str, tuple[Group, float]]  # by what is seen, the tree and how many times its source's time it may take
TURN = (0.8660254037844387, 0.5)


def measure(small: bool = False) -> Iterator[Figure]:
    size, repeats = ((256, 256), 1) if small else ((WIDTH, HEIGHT), REPEATS)
    source = _painted()
    yield from _beside(source, size, repeats)
    many = Rect.at(0, 0, *size)
    yield _within("100 exact placements", _look(_hundred(source, size), 0, many), 0.120, repeats)
    below, above = _filled(), _sparse()
    for name, pose, over, most in (
        ("itself at 1/2", HALF, False, 0.060),
        ("itself at 1/2, a layer above", HALF, True, 0.100),
        ("itself in a spiral", SPIRAL, False, 0.600),
    ):
        nodes = (below, Placement(9, "itself", pose=pose, part=FRAME), *((above,) if over else ()))
        for level in (3, 30, 1000):
            look = _look(replace(EMPTY, children=nodes), level, _around_fixed(pose.similarity, level, size))
            yield _within(f"{name}, level {level}", look, most, repeats)


def _beside(source: Layer, size: tuple[int, int], repeats: int) -> Iterator[Figure]:
    """Placements against their source, from nothing and with its tiles kept."""
    view, hidden = Rect.at(200, 100, *size), replace(source, visible=False)

    def placed(**pose: Any) -> Group:
        return replace(EMPTY, children=(hidden, Placement(9, "placed", of=source.id, pose=Pose(**pose))))

    plain = replace(EMPTY, children=(source,))
    cases: Cases = {
        "exact": (placed(at=(-37, 75)), 1.2),
        "mirrored, a quarter": (placed(at=(100, 200), turn=1, mirror=True), 1.2),
        "half a pixel": (placed(at=(75, 33), level=1), 4.0),
        "turned": (placed(at=(300, -400), turned=TURN), 4.0),
        "scaled by 1.3": (placed(turned=(1.3, 0.0)), 8.0),
    }
    for kept in (False, True):
        looks = [_look(root, 0, view, kept) for root in (plain, *(root for root, _ in cases.values()))]
        own, *times = _best(repeats, *looks)
        for (name, (_, limit)), seconds in zip(cases.items(), times, strict=True):
            how = "tiles kept" if kept else "cold"
            yield Figure(f"{name}, {how}", seconds * 1e3, "ms", f"its source, {own * 1e3:.1f} ms", seconds / own, limit)


def _within(name: str, look: Work, most: float, repeats: int) -> Figure:
    (seconds,) = _best(repeats, look)
    return Figure(name, seconds * 1e3, "ms", f"{most * 1e3:.0f} ms", seconds / most, 1.0)


def _look(root: Group, level: int, view: Rect, kept: bool = False) -> Work:
    """All tiles of the screen, as the window's are made; `kept`: those of the layers are there from the last time."""
    held, planned = TileCache(CACHE), Planned.of(root)

    def look() -> None:
        cache = held if kept else TileCache(CACHE)
        if not kept:
            RENEWED.clear()

        def read(layer: Layer, level: int, rect: Rect) -> Any:
            return layer_planes(layer, level, rect, cache)

        def placed(layer: Layer, level: int, rect: Rect) -> Any:
            return kept_planes(layer, level, rect, cache)

        for y in range(view.y0 - view.y0 % SCREEN_TILE, view.y1, SCREEN_TILE):
            for x in range(view.x0 - view.x0 % SCREEN_TILE, view.x1, SCREEN_TILE):
                tile = Rect.at(x, y, SCREEN_TILE, SCREEN_TILE)
                composite(planned, level, tile, piece_reader(level, tile, read, placed))

    return look


def _best(repeats: int, *works: Work) -> list[float]:
    """The shortest time of each work in seconds of the processor; they take turns."""
    for work in works:
        work()
    times = [[processor(work) for work in works] for _ in range(repeats)]
    return [min(column) for column in zip(*times, strict=True)]


def _painted() -> Layer:
    """A layer with strokes of several levels all over 4000 x 3000 pixels."""
    return _strokes(
        (level, radius, [[x * scale, y * scale], [(x + 900) * scale, (y + 500) * scale]])
        for level, radius, scale in ((0, 150, 1), (-1, 200, 0.5), (0, 12, 1))
        for x in range(-500, 3600, 700)
        for y in range(-500, 2600, 400)
    )


def _filled() -> Layer:
    """A layer that is opaque all over the frame, with paint on it."""
    rows = [(0, 420, [[-200, y], [1200, y]]) for y in (0, 500, 1000)]
    return _strokes([*rows, (0, 30, [[100, 900], [900, 100]]), (1, 20, [[300, 300], [1500, 1700]])], 1)


def _sparse() -> Layer:
    """A layer with a few strokes."""
    return _strokes([(0, 20, [[60, 60], [300, 90]]), (0, 14, [[700, 900], [980, 640]])], 2)


def _strokes(strokes: Any, number: int = 1) -> Layer:
    session = Session()
    for n, (level, radius, points) in enumerate(strokes):
        brush = {"radius": radius, "hardness": 0.95, "colour": f"#{(n * 0x35791B + 0x203040) & 0xFFFFFF:06x}"}
        session.do(parse({"do": "stroke", "level": level, "points": points, "brush": brush}))
    return replace(next(layers(session.painting.root)), id=number, name=f"paint {number}")


def _hundred(source: Layer, size: tuple[int, int]) -> Group:
    part, (width, height) = SourcePart(0, Rect(300, 200, 556, 456)), size
    copies = (
        Placement(
            100 + n,
            f"copy {n}",
            of=source.id,
            part=part,
            pose=Pose(at=(n % 10 * width // 10 - 300, n // 10 * height // 10 - 200), turn=0, mirror=False),
        )
        for n in range(100)
    )
    return replace(EMPTY, children=(replace(source, visible=False), *copies))


def _around_fixed(f: Similarity, level: int, size: tuple[int, int]) -> Rect:
    """A view of a level around the place that a similarity leaves where it is."""
    place = Dyadic(0, 0)
    for _ in range(level + 40):
        place = f(place)
        drop = max(0, place.e - level - 8)
        place = Dyadic.of(place.x >> drop, place.y >> drop, place.e - drop)
    shift = level - place.e
    x, y = ((v << shift if shift >= 0 else v >> -shift) for v in (place.x, place.y))
    return Rect.at(x - size[0] // 2, y - size[1] // 2, *size)
