"""A stroke where something is selected, against the same where nothing is: laid in portions, and committed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from bench import Figure
from bench.clock import processor
from engine.brush.settings import Brush, from_json
from engine.painting import commands as c
from engine.session.session import Session

REPEATS, PORTION = 7, 4
LIMIT = 1.5
SELECTED: Mapping[str, dict[str, Any]] = {
    "within": {"rect": [0, 0, 0, 1400, 1000]},
    "along the rim": {"ellipse": [0, 150, 350, 1000, 300]},
    "feathered": {"rect": [0, 300, 300, 700, 400], "feather": 200},
}
BRUSHES: dict[str, dict[str, Any]] = {
    "soft": {"radius": 24, "hardness": 0.3, "opacity": 0.7},
    "ink": {"radius": 24, "hardness": 0.6, "ink": [{"texture": "rock", "amount": 0.7}]},
}


def measure(small: bool = False) -> Iterator[Figure]:
    points = _points(PORTION if small else 60)
    for name, told in BRUSHES.items():
        brush = from_json({"colour": "#335577", **told})
        for where, shape in SELECTED.items():
            free, chosen = Session(), Session()
            for session in (free, chosen):
                session.do(c.parse({"do": "layer", "add": "Paint"}))
            chosen.do(c.parse({"do": "select", **shape}))
            for one in (chosen, free):
                _paint(one, brush, points)  # compiles; the selection's tiles are kept, as after the first stroke
            times = [
                tuple(processor(lambda: _paint(one, brush, points)) for one in (chosen, free))  # noqa: B023
                for _ in range(1 if small else REPEATS)
            ]
            limited, plain = (min(column) for column in zip(*times, strict=True))
            yield Figure(f"{name}, {where}", limited * 1e3, "ms", "nothing selected", limited / plain, LIMIT)


def _paint(begun: Session, brush: Brush, points: np.ndarray) -> None:
    session = Session(begun.painting, begun.cache)
    live = session.begin(0, (0, 0), brush)
    for part in np.array_split(points, max(1, len(points) // PORTION)):
        live.add(part)
    session.finish(live)


def _points(count: int) -> np.ndarray:
    """A wave from left to right."""
    part = np.linspace(0.0, 1.0, count)
    return np.column_stack([200 + 900 * part, 500 + 120 * np.sin(9 * part), 0.4 + 0.6 * part])
