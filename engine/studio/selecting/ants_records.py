"""What the window asks of the selection, and what it hears."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from engine.numeric.address import Rect

if TYPE_CHECKING:
    from engine.painting.select_commands import Select


@dataclass(frozen=True, slots=True)
class AskAnts:
    """Asks for the rim of what is selected in a rectangle of a level, now and whenever that changes.  The newest
    counts."""

    level: int
    area: Rect


@dataclass(frozen=True, slots=True)
class PreviewSelection:
    """Asks for the rim of what a command would select, in place of what is selected; None: no more.  The newest
    counts."""

    command: Select | None


class Measure(NamedTuple):
    """`bounds`: of what is selected at least half, in pixels of `level`; `feather`: how soft its rim is, 0 for sharp.
    Where the selection is inverse, of what is not selected."""

    level: int
    bounds: Rect
    feather: int


@dataclass(frozen=True, slots=True, eq=False)
class Ants:
    """`selected`: whether anything in particular is; `saved`: the names of kept selections; `lines`: the rim of what is
    selected at least half, float32 (n, 4): x0, y0, x1, y1 in pixels of `level` from the corner of `area`, along pixels'
    edges; `bounded`: what is selected has an end; `bounds`: of what is selected at least half, in pixels of level
    0, None where it has none, or is very large; `measure`: how large it is, None where that cannot be told."""

    selected: bool
    saved: tuple[str, ...]
    level: int
    area: Rect
    lines: np.ndarray
    bounded: bool
    bounds: Rect | None = None
    measure: Measure | None = None
