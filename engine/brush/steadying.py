"""How a shaky hand is steadied: ways to follow the pen, as one table.

Weighted: a first-order filter in time, which trails the more the faster the pen is.  Rope: the brush is drawn along at
the end of a slack rope, and rests while that is.  Quick: the lag falls as the pen gets faster (the 1 EUR filter:
Casiez, Roussel and Vogel 2012), so that the brush never trails by more than a few pixels.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

_NOMINAL = 0.008  # s between samples whose times do not rise
_SLOWEST = 0.15  # s, the lag of the strongest stabiliser
_ROPE = 120.0  # px of the screen, the longest rope
_TRAIL = 4.0  # px of the screen by which a quick brush trails at most
_SPEED_LAG = 0.05  # s, by which the pen's speed is known late


class Follow(Protocol):
    """Where the brush goes: from `at`, with the pen at `to`, so many seconds after the sample before."""

    def __call__(self, at: tuple[float, float], to: tuple[float, float], passed: float) -> tuple[float, float]:
        """Returns the brush's next place."""
        ...


class Steadied(NamedTuple):
    """A row: what makes a `Follow` of the strength, 0..1 but not 0, and of how many of the samples' pixels one of the
    screen is.  `to_the_pen`: the stroke ends where the pen is lifted, else where the brush is."""

    label: str
    tooltip: str
    make: Callable[[float, float], Follow]
    to_the_pen: bool = True


def _lag(strength: float) -> float:
    return _SLOWEST * strength**2


def _part(passed: float, lag: float) -> float:
    return -math.expm1(-(passed if 0.0 < passed < 1.0 else _NOMINAL) / lag)


def _moved(at: tuple[float, float], to: tuple[float, float], part: float) -> tuple[float, float]:
    return at[0] + (to[0] - at[0]) * part, at[1] + (to[1] - at[1]) * part


def _weighted(strength: float, _unit: float) -> Follow:
    lag = _lag(strength)
    return lambda at, to, passed: _moved(at, to, _part(passed, lag))


def _rope(strength: float, unit: float) -> Follow:
    length = _ROPE * strength * unit

    def follow(at: tuple[float, float], to: tuple[float, float], passed: float) -> tuple[float, float]:
        far = math.dist(at, to)
        return at if far <= length else _moved(at, to, 1.0 - length / far)

    return follow


class _Quick:
    """Knows where the pen was, and its velocity without its tremor, in pixels of the screen a second."""

    def __init__(self, strength: float, unit: float) -> None:
        self._lag, self._unit = _lag(strength), unit
        self._velocity = 0.0, 0.0
        self._pen: tuple[float, float] | None = None

    def __call__(self, at: tuple[float, float], to: tuple[float, float], passed: float) -> tuple[float, float]:
        time = passed if 0.0 < passed < 1.0 else _NOMINAL
        x, y = to if self._pen is None else self._pen
        now = (to[0] - x) / self._unit / time, (to[1] - y) / self._unit / time
        self._velocity, self._pen = _moved(self._velocity, now, _part(time, _SPEED_LAG)), to
        return _moved(at, to, _part(time, 1.0 / (1.0 / self._lag + math.hypot(*self._velocity) / _TRAIL)))


ON_ROPE, QUICK = "rope", "quick"
STEADIED = {
    "weighted": Steadied("Weighted", "The brush follows the pen with a lag: the faster, the farther behind", _weighted),
    ON_ROPE: Steadied("Rope", "You draw the brush along on a slack rope; it stays while that is slack", _rope, False),
    QUICK: Steadied("Quick", "Slow lines are steadied; with fast ones the brush stays at the pen", _Quick),
}
