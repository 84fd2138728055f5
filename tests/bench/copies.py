"""A stroke drawn sixteen times in one step, against the same sixteen strokes: laid in portions, and committed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from bench import Figure
from bench.clock import processor
from engine.brush.copies import NO_COPIES, Copies, Copy, symmetric
from engine.brush.settings import Brush, from_json
from engine.session.session import Session

SIDE, COUNT, REPEATS, PORTION = 1024, 16, 5, 4
LIMIT = 1 / 3
BRUSHES: dict[str, dict[str, Any]] = {
    "soft": {"radius": 24, "hardness": 0.3, "opacity": 0.7},
    "ink": {"radius": 24, "hardness": 0.6, "ink": [{"texture": "rock", "amount": 0.7}]},
}


def measure(small: bool = False) -> Iterator[Figure]:
    copies, points = symmetric((SIDE / 2, SIDE / 2), COUNT), _points(PORTION if small else 60)
    alone = [(_placed(points, copy), NO_COPIES) for copy in [Copy(1.0, 0.0, 0.0, 0.0), *copies]]
    for name, told in BRUSHES.items():
        brush = from_json({"colour": "#335577", **told})
        _paint(brush, [(points, copies)])  # compiles
        times = [
            (processor(lambda: _paint(brush, [(points, copies)])), processor(lambda: _paint(brush, alone)))  # noqa: B023
            for _ in range(1 if small else REPEATS)
        ]
        one, many = (min(column) for column in zip(*times, strict=True))
        yield Figure(f"{COUNT} copies, {name}", one * 1e3, "ms", f"{COUNT} strokes", one / many, LIMIT)


def _paint(brush: Brush, strokes: Sequence[tuple[np.ndarray, Copies]]) -> None:
    session = Session()
    for points, copies in strokes:
        live = session.begin(0, (0, 0), brush, copies=copies)
        for part in np.array_split(points, max(1, len(points) // PORTION)):
            live.add(part)
        session.finish(live)


def _points(count: int) -> np.ndarray:
    """An arc from near the middle to the rim."""
    part = np.linspace(0.0, 1.0, count)
    x, y = SIDE / 2 + 60 + 380 * part, SIDE / 2 + 90 * np.sin(3 * part)
    return np.column_stack([x, y, 0.4 + 0.6 * part])


def _placed(points: np.ndarray, copy: Copy) -> np.ndarray:
    """Where a copy shows points."""
    return np.array([[*copy.moved(x, y), pressure] for x, y, pressure in points])
