"""What the window is told when the engine is loaded: the rows of the tables that its panels are made from."""

from __future__ import annotations

from collections.abc import Iterable

from engine.brush.ops import OPS
from engine.numeric.blend import BLENDS
from engine.numeric.curves import CURVES, EDGES, Curve
from engine.numeric.shaping import table
from engine.studio.results import CurveRow, Ready
from engine.texture.table import KINDS

_EVERY = 8  # of a curve's 1025 table entries the window gets one in so many


def ready() -> Ready:
    """Returns the tables' rows, as the window is told them."""
    return Ready(
        tuple((row.name, row.label, row.tooltip) for row in BLENDS.values()),
        tuple(KINDS.values()),
        ops=tuple(OPS.values()),
        curves=_rows(CURVES.values(), "shaping"),
        edges=_rows(EDGES.values(), "edge"),
    )


def _rows(curves: Iterable[Curve], rows: str) -> tuple[CurveRow, ...]:
    return tuple(CurveRow(c.name, c.label, c.tooltip, tuple(map(float, table(c.name, rows)[::_EVERY]))) for c in curves)
