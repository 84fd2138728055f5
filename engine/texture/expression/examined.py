"""A written texture looked into: each of its lines as a picture, what it takes, its values at a place, whether it
shimmers.  What the workshop, the command line and the tests show.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from engine.numeric.address import Rect
from engine.texture.expression.language import read
from engine.texture.expression.placing.placed_scene import drawn_plainly
from engine.texture.expression.programs import Program
from engine.texture.expression.sampling.errors import JUMP_SIDE, POINT_SIDE
from engine.texture.expression.written import samples_told
from engine.texture.expression.written_ink import About, Expression, one_sample, pixels, woven_line, woven_program


@dataclass(frozen=True, slots=True)
class LineLook:
    """A line: its `name`, "" if it has none, the row of the text it begins in, from 1; whether it is `coloured`; the
    `samples` a pixel that its mean takes, 0 where each pixel takes as many as it needs, from 1 to 16; `cost`:
    nanoseconds a pixel, about, with all that it refers to."""

    name: str
    row: int
    coloured: bool
    samples: int
    cost: float

    @property
    def told(self) -> str:
        """Tells the samples in words."""
        return samples_told(self.samples)


@dataclass(frozen=True, eq=False, slots=True)
class Shimmer:
    """How far a level is from the next finer one, reduced: `rms` of 0..1 over all channels, and at each pixel,
    `difference`, float32 (h, w), the largest of any channel."""

    rms: float
    difference: np.ndarray


def line_looks(made: Expression, level: int) -> tuple[LineLook, ...]:
    """Returns what each line is at a level."""
    return tuple(line_look(made, number, level) for number in range(len(read(made.text).lines)))


def line_look(made: Expression, number: int, level: int) -> LineLook:
    """Returns what a line, counted from 0, is at a level."""
    written, found = read(made.text), _line(made, number, level)
    line = written.lines[number]
    samples = found.side**2 if found.finer is None else 0
    return LineLook(line.name, written.place(line.at)[0], found.channels == 4, samples, found.cost)


def line_planes(made: Expression, number: int, level: int, rect: Rect, few: bool = False) -> np.ndarray:
    """Returns what a line, counted from 0, is over a rectangle of a level: its numbers as they are within -1..2,
    float32 (1, h, w), or premultiplied colours (4, h, w); `few`: as one sample of each pixel tells."""
    shown = one_sample(_about(made, number, level)) if few else _line(made, number, level)
    return drawn_plainly(shown, rect, pixels(made.period, level - made.level))


def costs_about(made: Expression, number: int, level: int) -> tuple[float, float]:
    """Returns nanoseconds that a pixel of a line takes, before any is drawn: by one sample, and at most, about."""
    woven = woven_line(*_about(made, number, level))
    samples = 1 + POINT_SIDE**2 + JUMP_SIDE**2 if woven.rough or woven.jumps else 1
    return woven.cost, woven.cost * samples


def _about(made: Expression, number: int, level: int) -> About:
    return made.text, made.values, made.named, made.seed, level - made.level, made.period, number


def values_at(made: Expression, level: int, place: tuple[int, int]) -> tuple[tuple[float, ...], ...]:
    """Returns what each line is at a pixel of a level: one number, or four of a colour."""
    rect = Rect.at(*place, 1, 1)
    found = (line_planes(made, n, level, rect) for n in range(len(read(made.text).lines)))
    return tuple(tuple(float(value) for value in planes[:, 0, 0]) for planes in found)


def shimmer(made: Expression, level: int, rect: Rect, number: int = -1) -> Shimmer:
    """Compares a level over a rectangle with the mean of 2 x 2 pixels of the next finer one; of the texture, or of a
    line."""
    number %= len(read(made.text).lines)
    coarse = line_planes(made, number, level, rect)
    fine = line_planes(made, number, level + 1, rect.zoomed(1)).astype(np.float64)
    reduced = (fine[:, ::2, ::2] + fine[:, ::2, 1::2] + (fine[:, 1::2, ::2] + fine[:, 1::2, 1::2])) * 0.25
    apart = coarse - reduced
    return Shimmer(float(np.square(apart).mean()) ** 0.5, np.abs(apart).max(axis=0).astype(np.float32))


@lru_cache(256)
def _line_program(made: Expression, number: int, finer: int) -> Program:
    return woven_program(made.text, made.values, made.named, made.seed, finer, made.period, number)


def _line(made: Expression, number: int, level: int) -> Program:
    return _line_program(made, number, level - made.level)
