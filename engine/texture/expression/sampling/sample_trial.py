"""How many samples a pixel of a written texture takes, where that cannot be told beforehand: it is measured at some
pixels, which are the same ones for every text."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from typing import Protocol

import numpy as np

from engine.texture.expression.machine import SHOWN_LEAST, SHOWN_MOST
from engine.texture.expression.sampling.errors import JUMP_SIDE, MANY_FROM, POINT_SIDE

_PIXELS, _TRIALS = 96, 4
_ACROSS = ((41.0, 256.0), (3.0, 12.0))  # periods, but no fewer pixels, within which every other one lies
_UNIT = 1 << 16
_OFTEN = 1.0 / 12.0  # of the pixels
# How far one sample may be off, and four: rms over these pixels but so many that are farthest off, and at one, of the
# channel that is farthest off.
_BY_ONE, _BY_FOUR = (0.5 / 255.0, 2.4 / 255.0, 0), (2.05 / 255.0, 24.0 / 255.0, 1)
_ASIDE = 1.0 / 255.0  # all these pixels together: else each level is darker, or lighter, than the next one
_FAR = 2.0 / 255.0  # one sample and four from one another, where more are taken
_SHOWS = 2.0 / 255.0  # four from sixteen, rms over the pixels in which something jumps: less is not worth sixteen
_UNSURE = 3.0 / 255.0  # sixteen from four times as many, where more are taken from afar
_TURNS = (0.7548776662466927, 0.5698402909980532)  # no two pixels are near one another (Roberts 2018)


class Drawn(Protocol):
    """A program, as `programs.Program`: two are the same where they are one."""

    def __hash__(self) -> int: ...

    @property
    def side(self) -> int:
        """Gives samples along a pixel."""

    @property
    def channels(self) -> int:
        """Gives planes, but for that of the error."""

    @property
    def compares(self) -> bool:
        """Tells whether pixels take more in which four are far from one."""

    @property
    def finer(self) -> Callable[[int], Drawn] | None:
        """Gives the program for so many along a pixel; None where all take as many."""

    def over(self, xs: np.ndarray, ys: np.ndarray, row: int) -> np.ndarray:
        """Returns the means over pixels."""


def far_apart(plain: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Tells in which pixels one sample and some are so far from one another that more must be taken: bool (pixels,)."""
    found: np.ndarray = np.abs(plain - some).max(axis=0) > np.float32(_FAR)
    return found


def measured_side(one: Drawn, made: Callable[[int], Drawn], period: Fraction) -> int:
    """Returns how many samples along a pixel are enough; `one`, `made`: a text for one, and for so many; `period`:
    pixels."""
    plain, some = (_whole(_tried(drawn, period)[: drawn.channels]) for drawn in (one, made(POINT_SIDE)))
    if _alike(plain, some, _BY_ONE) and not _bounded(plain):
        return 1
    many = _whole(_tried(made(JUMP_SIDE), period))
    return POINT_SIDE if _alike(some, many, _BY_FOUR) and not _bounded(some) else JUMP_SIDE


def is_unsure(many: Drawn, most: Drawn, period: Fraction) -> bool:
    """Tells whether many samples and most show so different pixels that most must be taken."""
    a, b = (_whole(_tried(made, period)) for made in (many, most))
    squares = np.square(a - b).max(axis=0)
    return math.sqrt(int(squares.sum()) / _PIXELS) / _UNIT > _UNSURE


def samples_of(made: Drawn, period: Fraction) -> tuple[float, bool]:
    """Returns how many samples a pixel takes, about, of a program by which some take more than others, and whether what
    was measured tells of these, too: they are many, or sixteen show no more of them than four."""
    assert made.finer is not None
    found = _tried(made, period)
    more, samples = found[-1] >= MANY_FROM, float(made.side**2)
    if made.compares:
        some = _tried(made.finer(POINT_SIDE), period)
        more, samples = more | far_apart(found[:-1], some), samples + POINT_SIDE**2
    part = float(np.count_nonzero(more)) / _PIXELS
    often = part > _OFTEN or (made.side == POINT_SIDE and part > 0.0 and not _shows_jumps(made, found, period))
    return samples + (POINT_SIDE if often and not made.compares else JUMP_SIDE) ** 2 * part, often


def _shows_jumps(made: Drawn, some: np.ndarray, period: Fraction) -> bool:
    """Tells whether sixteen samples show more than four of the pixels in which something jumps."""
    assert made.finer is not None
    many = _whole(_tried(made.finer(JUMP_SIDE), period))
    squares = np.square(_whole(some[:-1]) - many).max(axis=0)[some[-1] >= MANY_FROM]
    return math.sqrt(int(squares.sum()) / squares.size) / _UNIT > _SHOWS


@lru_cache(_TRIALS)
def _tried(made: Drawn, period: Fraction) -> np.ndarray:
    """Returns what these pixels show, with as many samples as a program takes of each: float32 (planes, pixels)."""
    shown = made.over(*_places(made.side, float(period)), _PIXELS)
    shown.flags.writeable = False
    return shown


def _whole(shown: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.rint(shown.astype(np.float64) * _UNIT).astype(np.int64)
    return found


def _alike(a: np.ndarray, b: np.ndarray, allowed: tuple[float, float, int]) -> bool:
    apart, (rms, most, spared) = a - b, allowed
    squares = np.sort(np.square(apart).max(axis=0))
    found = math.sqrt(int(squares[: _PIXELS - spared].sum()) / _PIXELS) / _UNIT
    aside = int(np.abs(apart.sum(axis=1)).max()) / (_PIXELS * _UNIT)
    return found <= rms and aside <= _ASIDE and math.sqrt(int(squares[-1])) / _UNIT <= most


def _bounded(shown: np.ndarray) -> bool:
    """Tells whether many pixels are as dark or as bright as can be shown: how far they are from others is not seen."""
    ends = (shown <= SHOWN_LEAST * _UNIT) | (shown >= SHOWN_MOST * _UNIT)
    return float(ends.mean(axis=1).max()) > _OFTEN


@lru_cache(64)
def _places(side: int, period: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns where the samples of these pixels lie, in periods: float64 (side side, pixels), twice."""
    wide = np.array([max(periods * period, least) for periods, least in _ACROSS] * (_PIXELS // 2))
    found = []
    within = np.arange(side)
    for turn, along in zip(_TURNS, (np.tile(within, side), np.repeat(within, side)), strict=True):
        pixel = np.floor(np.arange(1, _PIXELS + 1) * turn % 1.0 * wide)
        found.append(np.ascontiguousarray((pixel * side + along[:, None] + 0.5) / (side * period)))
    return found[0], found[1]
