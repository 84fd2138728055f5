"""What one stroke of a generator laid: its things as a texture, whose alpha is their own coverage.

Of its three parts the colours are premultiplied; `cover` is what they hide, for what lies below, and `alpha` the same
where nothing lay, for the alpha that then is there.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from weakref import WeakValueDictionary

import numpy as np

from engine.checks.field_error import FieldError
from engine.checks.values import described, is_integer, is_within
from engine.numeric.address import Rect
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.numeric.pyramid import reduce
from engine.texture.expression.defined import PERIOD_LEAST, PERIOD_MOST, expression
from engine.texture.expression.kept_squares import from_squares
from engine.texture.expression.placing.centre_line import POINTS_MOST, CentreLine
from engine.texture.expression.placing.placed_scene import LineSight, bounds_of_line, changed_box, drawn_whole
from engine.texture.expression.programs import Program
from engine.texture.expression.written_ink import FINEST_PIXEL, Expression, pixels

COLOURS_OF, COVER_OF, ALPHA_OF = "generated", "generated-cover", "generated-alpha"
_SMALL = 192  # pixels of a unit


@dataclass(frozen=True, slots=True)
class LaidStroke:
    """A generator's stroke: `unit`: pixels of the level of the size 1; `start`: the pixel from which `line` goes."""

    base: int
    text: str
    unit: float
    seed: int
    start: tuple[int, int]
    line: CentreLine
    values: tuple[tuple[str, float | str], ...] = ()

    def at(self, level: int) -> Program:
        """Returns the program that draws a level."""
        return Expression(self.base, self.text, self.unit, self.base, self.seed, self.values).at(level)

    def sight(self, level: int) -> LineSight:
        """Returns from where a level is seen."""
        finer = level - self.base
        origin = self.start[0] << finer, self.start[1] << finer
        return LineSight(float(1 / pixels(self.unit, finer)), origin, self.line)

    def rect(self, level: int) -> Rect:
        """Returns the pixels of a level in which anything may show."""
        return _bounds(self, level)

    def changed(self, before: LaidStroke | None, level: int) -> Rect:
        """Returns the pixels of a level in which it may show otherwise than before."""
        if before is None or (before.start, before.text, before.values) != (self.start, self.text, self.values):
            return self.rect(level)
        return changed_box(self.at(level), self.sight(level), before.sight(level))

    def means(self, level: int, rect: Rect) -> np.ndarray:
        """Returns what the pixels of a rectangle show, premultiplied: float32 (4, h, w)."""
        return from_squares(_drawn, (self, level), 4, rect)


@lru_cache(256)
def _bounds(laid: LaidStroke, level: int) -> Rect:
    return bounds_of_line(laid.at(level), laid.sight(level))


def _drawn(laid: LaidStroke, level: int, rect: Rect) -> np.ndarray:
    """Where things are small, and many lie in a pixel, the mean of finer pixels, each as it is drawn."""
    if pixels(laid.unit, level - laid.base) < _SMALL:
        return reduce(_drawn_once(laid, level + 1, rect.zoomed(1)))
    return _drawn_once(laid, level, rect)


def _drawn_once(laid: LaidStroke, level: int, rect: Rect) -> np.ndarray:
    out = np.zeros((4, rect.height, rect.width), np.float32)
    inner = rect.intersect(laid.rect(level))
    if not inner.empty:
        made = drawn_whole(laid.at(level), inner, laid.sight(level))
        rows, columns = inner.slices(rect)
        out[:, rows, columns] = made if len(made) == 4 else np.concatenate([made] * 3 + [np.ones_like(made)])
        np.clip(out[3], 0.0, 1.0, out=out[3])
        np.clip(out[:3], 0.0, out[3], out=out[:3])
    return out


@dataclass(frozen=True, eq=False)
class Generated:
    """A part of what a stroke laid, as an instance.  Equal ones are the same object: where thousands meet, each stroke
    looks for each of them many times."""

    laid: LaidStroke
    kind: str = COLOURS_OF

    def __new__(cls, laid: LaidStroke, kind: str = COLOURS_OF) -> Generated:
        """Returns the one that is there, if one is."""
        with _LOCK:
            found = _THERE.get((laid, kind))
            if found is None:
                found = _THERE[laid, kind] = super().__new__(cls)
            return found

    def __reduce__(self) -> tuple[type[Generated], tuple[LaidStroke, str]]:
        return Generated, (self.laid, self.kind)

    @cached_property
    def base(self) -> int:
        """Gives the level of the stroke."""
        return self.laid.base

    @property
    def on_alpha(self) -> bool:
        """Tells whether its planes are, red for all, how much of it adds to alpha."""
        return self.kind == ALPHA_OF

    @cached_property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        laid = self.laid
        pairs = (part for pair in laid.values for part in pair)
        return (self.kind, laid.base, laid.text, laid.unit, laid.seed, laid.start, laid.line.told, *pairs)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`: (4, h, w), or of a cover (1, h, w)."""
        if level < self.base:
            raise ValueError(f"generated: level {level} is coarser than the base level {self.base}")
        found = self.laid.means(level, rect)
        return found if self.kind == COLOURS_OF else found[3:]

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if level <= self.base or rect.empty or pixels(self.laid.unit, level - 1 - self.base) >= 1 << FINEST_PIXEL:
            return None
        if not rect.meets(self.laid.rect(level).grown(4)):
            return None
        even, planes = rect.evened(), slice(0, 3) if self.kind == COLOURS_OF else slice(3, 4)
        out = self.laid.means(level, even)[planes].copy()
        if not subtract_expanded(out, np.ascontiguousarray(self.laid.means(level - 1, parents(even))[planes])):
            return None
        inner = cut(out, rect, even)
        return inner if rect == even or inner.any() else None

    def part(self, kind: str) -> Generated:
        """Returns another part of the same."""
        return replace(self, kind=kind)


_LOCK = threading.Lock()
_THERE: WeakValueDictionary[tuple[LaidStroke, str], Generated] = WeakValueDictionary()


def generated_of_key(key: Sequence[object]) -> Generated:
    """Returns the texture whose key this is; FieldError names what is wrong."""
    if len(key) < 7 or len(key) % 2 == 0 or not isinstance(key[1], int):
        raise FieldError("key", described(list(key)), "[kind, level, text, unit, seed, [x, y], line, name, value, ...]")
    kind, base, text, unit, seed, start, line = key[:7]
    values = {str(name): value for name, value in zip(key[7::2], key[8::2], strict=True)}
    if not is_within(unit, PERIOD_LEAST, PERIOD_MOST):
        raise FieldError("unit", described(unit), f"a number from {PERIOD_LEAST:g} to {PERIOD_MOST:g}")
    if not (isinstance(start, list | tuple) and len(start) == 2 and all(is_integer(v) for v in start)):
        raise FieldError("start", described(start), "[x, y], integers")
    points = line if isinstance(line, list | tuple) else ()
    if not (0 < len(points) <= 3 * POINTS_MOST and len(points) % 3 == 0) or not all(_is_step(v) for v in points):
        raise FieldError("line", described(line), f"x, y and size of 1 to {POINTS_MOST} points, integers")
    assert isinstance(base, int)
    made = expression({"text": text, "period": unit, "seed": seed, "level": base, "values": values}, base)
    told = CentreLine(tuple(int(v) for v in points))
    laid = LaidStroke(base, made.text, made.period, made.seed, (int(start[0]), int(start[1])), told, made.values)
    return Generated(laid, str(kind))


def _is_step(value: object) -> bool:
    return is_integer(value) and is_within(value, -(1 << 40), 1 << 40)
