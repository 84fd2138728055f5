"""Written textures as instances: what they look like at a level, and what each finer level adds.

What they show is worked out for the width of a pixel at each level, so that the bandpass is what is left of a level
when the coarser one is taken from it.  A number is grey, -1..1 for 0..1; a colour is premultiplied, as of a gradient.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache, partial

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.texture.expression.kept_squares import from_squares
from engine.texture.expression.language import read, weave
from engine.texture.expression.naming.elsewhere import Elsewhere, unit_of
from engine.texture.expression.placing.placed_scene import drawn_plainly
from engine.texture.expression.programs import Program, draw_pixels, program
from engine.texture.expression.sampling.errors import JUMP_SIDE, POINT_SIDE
from engine.texture.expression.sampling.far_fit import (
    CROWDED_BELOW,
    FAR_SIDES,
    FITTED_BELOW,
    PAIRED_FROM,
    UNSURE_BELOW,
    far_cost,
    fit_to_near,
    near_level,
    shown_at_places,
    shown_within,
)
from engine.texture.expression.sampling.sample_trial import is_unsure, measured_side, samples_of
from engine.texture.expression.weaving import Setting, Woven
from engine.texture.expression.written import FELT, OWN_RIM, OWN_WAY, PRESSURE, STROKE_WAYS, USUAL_STAGES
from engine.texture.record import Instance

FINEST_PIXEL = 34  # a pixel of 2^-34 periods is the last that differs from its neighbours
_COARSEST = -40  # levels above where the period is told
_MEMO = 256
_WOVEN = 4  # of up to three megabytes: of one line, for the samples that are tried

Values = tuple[tuple[str, float | str], ...]
Named = tuple[tuple[str, Instance], ...]
About = tuple[str, Values, Named, int, int, float, int]


@dataclass(frozen=True, slots=True)
class Expression:
    """`period`: pixels of `level` that the text calls 1; `values`: of all its sliders, by name; `covers`: not the
    colours, but what they hide; `named`: textures that the text names and that do not come along, by name;
    `tabulated`: for how many pressures a stroke has it, which changes nothing of any one."""

    base: int
    text: str
    period: float
    level: int
    seed: int
    values: Values = ()
    covers: bool = False
    named: Named = ()
    tabulated: int = field(default=USUAL_STAGES, compare=False)

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        kind = "expression-cover" if self.covers else "expression"
        pairs: list[object] = [part for pair in self.values for part in pair]
        pairs += [part for name, made in self.named for part in (f'"{name}"', made.key)]
        return (kind, self.base, self.text, self.period, self.level, self.seed, *pairs)

    @property
    def by_name(self) -> Mapping[str, Elsewhere | Expression]:
        """Gives the textures that it names, by name."""
        return textures_by_name(self.named)

    @property
    def deep(self) -> int:
        """Tells how many texts name one another within it."""
        return 1 + max((made.deep for _, made in self.named if isinstance(made, Expression)), default=0)

    @property
    def stages(self) -> int:
        """Gives how many textures of as many pressures are mixed where the pen's pressure counts, else 1."""
        return self._stages_of(PRESSURE)

    @property
    def rims(self) -> int:
        """Gives how many textures of as many distances from the rim are mixed where that counts, else 1."""
        return self._stages_of(OWN_RIM)

    @property
    def ways(self) -> int:
        """Gives how many textures of as many directions of the stroke there are where that counts, else 1."""
        return STROKE_WAYS if any(name == FELT[OWN_WAY] for name, _ in self.values) else 1

    def _stages_of(self, felt: str) -> int:
        return self.tabulated if any(name == FELT[felt] for name, _ in self.values) else 1

    def under(self, pressure: float, rim: float) -> tuple[tuple[float, Expression], ...]:
        """Returns what a stroke mixes at a pressure and so far from its rim, each 0 to 1: parts, which together are 1,
        and the textures."""
        found: tuple[tuple[float, Expression], ...] = ((1.0, self),)
        for name, value in ((PRESSURE, pressure), (OWN_RIM, rim)):
            last = self._stages_of(name) - 1
            if last > 0:
                before = min(int(value * last), last - 1)
                part = value * last - before
                parts = [(1.0 - part, before / last), (part, (before + 1) / last)]
                found = tuple((a * b, one._at(name, at)) for a, one in found for b, at in parts if b > 0.0)
        return found

    def _at(self, felt: str, at: float) -> Expression:
        values = tuple((name, at if name == FELT[felt] else value) for name, value in self.values)
        return replace(self, values=values)

    @property
    def shows_colours(self) -> bool:
        """Tells whether it has colours, and not only brightness."""
        return self.at(self.base).channels == 4

    @property
    def cover(self) -> Expression | None:
        """Returns what the texture hides, for an ink that lies over another colour; None if it hides all."""
        about = self.text, one_way(self.values), self.named, self.seed, self.base - self.level, self.period
        made = _program(*about)
        clear = made.channels == 4 and not _always(made, 3, 1.0)
        return replace(self, covers=True) if clear and not self.covers else None

    def at(self, level: int) -> Program:
        """Returns the program that draws a level."""
        return _program(self.text, self.values, self.named, self.seed, level - self.level, self.period)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`: (1, h, w); of colours premultiplied (4, h,
        w), of a cover (1, h, w)."""
        if level < self.base:
            raise ValueError(f"expression: level {level} is coarser than the base level {self.base}")
        return self.means(level, rect)[slice(3, 4) if self.covers else slice(0, 4)]

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if level <= self.base or rect.empty or pixels(self.period, level - 1 - self.level) >= 1 << FINEST_PIXEL:
            return None
        even, planes = rect.evened(), slice(3, 4) if self.covers else slice(0, 3)
        out = np.ascontiguousarray(self.means(level, even)[planes])
        if not subtract_expanded(out, np.ascontiguousarray(self.means(level - 1, parents(even))[planes])):
            return None
        inner = cut(out, rect, even)
        return inner if rect == even or inner.any() else None

    def means(self, level: int, rect: Rect) -> np.ndarray:
        """Returns what the pixels of a rectangle show: float32, (1, h, w) of -1..1 or (4, h, w) of 0..1."""
        about = self.text, self.values, self.named, self.seed, level - self.level, self.period
        return from_squares(_shown_on, about, self.at(level).channels, rect)


def one_way(values: Values) -> Values:
    """Returns values with the first of a stroke's directions, which tells of all sixteen what the text is like: each
    that is woven takes tens of milliseconds."""
    return tuple((name, 0.0 if name == FELT[OWN_WAY] else value) for name, value in values)


@lru_cache(_MEMO)
def textures_by_name(named: Named) -> Mapping[str, Elsewhere | Expression]:
    """Returns textures by name, as a text asks for them."""
    return {name: made if isinstance(made, Expression) else Elsewhere(made, unit_of(made)) for name, made in named}


def _shown_on(text: str, values: Values, named: Named, seed: int, finer: int, period: float, rect: Rect) -> np.ndarray:
    made = _program(text, values, named, seed, finer, period)
    out = drawn_plainly(made, rect, pixels(period, finer))
    if made.channels == 1:
        out *= np.float32(2.0)
        out -= np.float32(1.0)
    return out


def pixels(period: float, finer: int) -> Fraction:
    """Returns how many pixels a period has, so many levels finer than where it is told."""
    bounded = max(-2000, min(2000, finer))
    return Fraction(period) * Fraction(2) ** bounded


def _always(made: Program, channel: int, value: float) -> bool:
    row = int(made.shown[channel])
    return row < made.constants.size and float(made.constants[row]) == value


@lru_cache(_MEMO)
def _program(text: str, values: Values, named: Named, seed: int, finer: int, period: float) -> Program:
    return woven_program(text, values, named, seed, finer, period)


def woven_line(
    text: str, values: Values, named: Named, seed: int, finer: int, period: float, line: int = -1,
    side: int = 1,
) -> Woven:  # fmt: skip
    """Returns what a line of a text is, so many levels finer than where its period is told, for one of so many samples
    along a pixel."""
    last = line == len(read(text).lines) - 1
    return _woven(text, values, named, seed, finer, period, -1 if last else line, side)


@lru_cache(_WOVEN)
def _woven(
    text: str, values: Values, named: Named, seed: int, finer: int, period: float, line: int, side: int
) -> Woven:
    width = float(1 / pixels(period, max(finer, _COARSEST))) / side
    return weave(read(text), Setting(dict(values), finer, seed, width, textures_by_name(named), side), line)


def woven_program(
    text: str, values: Values, named: Named, seed: int, finer: int, period: float, line: int = -1
) -> Program:
    """Returns the program of a line of a text: what it is for the samples that it asks for."""
    about = (text, values, named, seed, finer, period, line)
    woven, many = woven_line(*about), pixels(period, max(finer, _COARSEST))
    found = _from_afar(_enough(woven, about, many), about, many)
    if woven.whole is not None or named or many >= FITTED_BELOW or not (woven.rough or woven.jumps):
        return found
    paired = many >= PAIRED_FROM
    far = shown_at_places(partial(_at_pixels, found, many), many, paired)
    near = (
        _from_nearer(text, values, seed, finer, period, line) if paired
        else _from_near(text, values, seed, period, line)
    )  # fmt: skip
    return replace(found, fit=fit_to_near(far, near))


def one_sample(about: About) -> Program:
    """Returns the program of a line with one sample of each pixel, which is woven at once."""
    return _sampled(*about, 1)


def _at_pixels(made: Program, many: Fraction, columns: np.ndarray, rows: np.ndarray) -> np.ndarray:
    return draw_pixels(made, columns, rows, many)


def _from_afar(found: Program, about: About, many: Fraction) -> Program:
    """Returns the program with more samples where each pixel holds so much that some of its own have sixteen, if that
    is not too dear; where it does not hold much, if sixteen are not sure."""
    most = found.side if found.finer is None else found.most
    if many >= UNSURE_BELOW or most < JUMP_SIDE or found.takes:
        return found
    dear, side = _sampled(*about, JUMP_SIDE).cost, JUMP_SIDE
    for more in FAR_SIDES:
        sure = many >= CROWDED_BELOW if side == JUMP_SIDE else True
        if dear * (more / JUMP_SIDE) ** 2 > far_cost(many) or (sure and not _unsure(about, many, (side, more))):
            break
        side = more
    return found if side == JUMP_SIDE else _sampled(*about, side)


def _unsure(about: About, many: Fraction, sides: tuple[int, int]) -> bool:
    return _told_unsure((about[0], one_way(about[1]), *about[2:]), many, sides)


@lru_cache(_MEMO)
def _told_unsure(about: About, many: Fraction, sides: tuple[int, int]) -> bool:
    some, more = (_sampled(*about, side) for side in sides)
    return is_unsure(some, more, many)


def _enough(woven: Woven, about: About, many: Fraction) -> Program:
    """Returns the program with as many samples as are enough."""
    made = partial(_sampled, *about)
    if woven.whole is not None:
        return made(POINT_SIDE if woven.rough or woven.jumps else 1)
    side = _measured((about[0], one_way(about[1]), *about[2:]), many) if woven.rough else 1
    if not woven.jumps and side < JUMP_SIDE:
        return made(side)
    compares = side == JUMP_SIDE
    if side == POINT_SIDE:
        found = program(woven_line(*about, POINT_SIDE), side, made)
    else:
        found = _comparing(about) if compares else program(woven, side, made)
    samples, often = samples_of(found, many)
    if often and side == POINT_SIDE:
        return made(side)
    return replace(found, cost=woven.cost * samples, most=POINT_SIDE if often and not compares else JUMP_SIDE)


@lru_cache(_WOVEN)
def _comparing(about: About) -> Program:
    """Returns the program for one sample of each pixel, with its error, and more where four are far from that."""
    return program(woven_line(*about), 1, partial(_sampled, *about), True)


@lru_cache(_MEMO)
def _measured(about: About, many: Fraction) -> int:
    made = partial(_sampled, *about)
    return measured_side(_comparing(about) if woven_line(*about).jumps else made(1), made, many)


@lru_cache(16)
def _from_near(text: str, values: Values, seed: int, period: float, line: int) -> np.ndarray:
    """Returns what a line shows from near, at some places."""
    finer = near_level(period)
    made, many = woven_program(text, values, (), seed, finer, period, line), pixels(period, finer)
    return shown_at_places(partial(_at_pixels, made, many), many)


def _from_nearer(text: str, values: Values, seed: int, finer: int, period: float, line: int) -> np.ndarray:
    """Returns what the pixels of a line hold by the next finer level, at some places."""
    about, many = (text, values, (), seed, finer + 1, period), pixels(period, finer)
    made = _program(*about) if line == -1 else woven_program(*about, line)
    return shown_within(partial(_at_pixels, made, 2 * many), many)


@lru_cache(_MEMO)
def _sampled(
    text: str, values: Values, named: Named, seed: int, finer: int, period: float, line: int, side: int
) -> Program:
    """Returns the program of a line for so many samples along each pixel."""
    return program(woven_line(text, values, named, seed, finer, period, line, side), side)
