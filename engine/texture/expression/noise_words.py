"""Functions that are random by place: noise and sums of it, white noise, cells, a number for each part of a repeat."""

from __future__ import annotations

import math
from functools import lru_cache

from engine.numeric import elementary
from engine.numeric.hashing import MASK32, fold_key
from engine.texture.expression import cell_rows
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import NO_ERROR
from engine.texture.expression.noise_rows import CELLS_SEEN
from engine.texture.expression.sampling.errors import FEW_FROM
from engine.texture.expression.spreads import Spread, spread_within, summed_up
from engine.texture.expression.weaving import Env, Rule, Value, Weaver
from engine.texture.expression.written import Term

_DOMAIN = 0x78707273  # tells these hashes from those of other textures
_EVEN = 1.0 / math.sqrt(12.0)  # the standard deviation of what is evenly within 0..1
_CELLS = 2.0  # of noise, in a unit
_SPREAD = 0.463  # its standard deviation at a gain of 1
_FAINT = 0.35 / 255.0  # of what is left of an octave
LOUD = 0.36  # of noise about 1/2: its standard deviation is 0.17
OCTAVES_MOST = 32
_OCTAVES_KEPT = 1 << 14
_OCTAVES, _GAIN, _FINER = 8, 0.5, 2.0
_STEEP = 0.8  # of ridges
_TURBULENCE = 0.372  # the mean of |n|, n being noise of standard deviation 0.463
_RIDGE = 1.0 - 2.0 * _STEEP * _TURBULENCE + _STEEP * _STEEP * 0.2144  # of (1 - _STEEP |n|)^2
_NOISE_FADES = (1.45, 2.6, (0.25, 1.5))  # cells, of `spreads.spread_within`
_CELLS_FADE: tuple[
    tuple[float, float, float, tuple[float, float]], ...
] = (  # deviation, and of `spreads.spread_within`, of distances, edges, random numbers
    (0.19, 0.65, 2.2, (0.1, 1.0)),
    (0.118, 0.4, 2.2, (0.1, 0.7)),
    (0.283, 0.85, 1.8, (0.0, 0.01)),
)
_CELLS_ERRORS = (0.28, 0.8, 2.5)  # of what they vary within a sample
_SEES = 0.75  # of its width: how far an edge may be that a sample sees
_SEEN, _UNSEEN = 2.0, 8.0  # cells across a sample, between which a fold fades to its mean


def _place(weaver: Weaver, term: Term, env: Env, count: int = 2) -> tuple[list[int], int]:
    """Returns the nodes of the first values of a function, and their error."""
    values = [weaver.number(part, env.point) for part in term.parts[:count]]
    return [value.nodes[0] for value in values], weaver.errors.worst(*(value.error for value in values))


def _optional(weaver: Weaver, term: Term, env: Env, at: int, usual: float, bounds: tuple[float, float]) -> float:
    """Returns a value that may be left out, the same everywhere."""
    return weaver.fixed(term.parts[at], env, *bounds) if len(term.parts) > at else usual


def _seed(weaver: Weaver, term: Term, env: Env, at: int) -> int:
    return int(weaver.fixed(term.parts[at], env, -1e9, 1e9, True)) if len(term.parts) > at else 0


def _key(weaver: Weaver, *about: int) -> int:
    return _folded_key(weaver.setting.seed, *about)


@lru_cache(_OCTAVES_KEPT)
def _folded_key(*about: int) -> int:
    return fold_key(_DOMAIN, *about)


_Lattice = tuple[float, float, float, float, float]


@lru_cache(_OCTAVES_KEPT)
def _octave(seeds: tuple[int, int], number: int, finer: float, gain: float) -> tuple[_Lattice, int]:
    """Returns the lattice of an octave, and its key: octaves are shifted, that no two have their cells in line.
    `seeds`: the texture's, and of the noise.

    What is left of noise of standard deviation s over w cells is s w^-3/2: beyond where that is _FAINT, none is seen.
    """
    key = fold_key(_DOMAIN, seeds[0], Code.NOISE, seeds[1], number)
    across, down = ((key >> bits & 0xFFFF) / 1024.0 for bits in (32, 48))
    widest = elementary.power(abs(gain) * _SPREAD / _FAINT, 2.0 / 3.0)
    return (_CELLS * finer, across, down, gain, min(max(widest, 2.0), CELLS_SEEN)), key & MASK32


def _widths(weaver: Weaver, place: list[int]) -> tuple[int, int]:
    return weaver.width(place[0]), weaver.width(place[1])


def _unseen(weaver: Weaver, widths: tuple[int, int]) -> bool:
    """Tells whether units are too fine for every sample."""
    told = [weaver.graph.value(width) for width in widths]
    return any(one is not None and one >= CELLS_SEEN for one in told)


def _noises(weaver: Weaver, place: list[int], seed: int, octaves: list[tuple[float, float]]) -> int:
    """Returns a sum of octaves of noise about 0, each (times finer, gain)."""
    numbers: list[float] = []
    keys: list[int] = []
    widths, spreads = _widths(weaver, place), []
    usual, told = _told_width(weaver, place, widths), [weaver.graph.value(width) for width in widths]
    widest = max((one for one in told if one is not None), default=0.0)
    for n, (finer, gain) in enumerate(octaves):
        lattice, key = _octave((weaver.setting.seed, seed), n, finer, gain)
        spreads.append(spread_within(abs(gain) * _SPREAD, usual * lattice[0], *_NOISE_FADES))
        if widest * lattice[0] < lattice[4]:
            numbers += lattice
            keys.append(key)
    if not keys:
        return _level(weaver, summed_up(spreads))
    made = weaver.graph.node(Code.NOISE, *place, *widths, numbers=tuple(numbers), key=tuple(keys))
    weaver.spreads.told[made] = summed_up(spreads)
    return made


def _told_width(weaver: Weaver, place: list[int], widths: tuple[int, int]) -> float:
    """Returns the width of a sample, as far as it is the same everywhere; where it is not, about."""
    told = [weaver.graph.value(width) for width in widths]
    if None in told:
        return max(weaver.spreads.of(one).within for one in place) / _EVEN
    wide: float = max(one for one in told if one is not None)
    return wide


def _level(weaver: Weaver, spread: Spread) -> int:
    """Returns 0 that is what is left of something: a node of its own, which has a spread."""
    told = int(spread.lost * 1e6)
    made = weaver.graph.node(Code.TIMES, weaver.graph.x, numbers=(0.0,), key=(told,))
    weaver.spreads.told[made] = spread
    return made


def _noise(weaver: Weaver, term: Term, env: Env) -> Value:
    place, error = _place(weaver, term, env)
    return Value(
        (weaver.graph.plus(_noises(weaver, place, _seed(weaver, term, env, 2), [(1.0, LOUD)]), 0.5),),
        weaver.errors.bounded(error),
    )


def _octaves(weaver: Weaver, term: Term, env: Env) -> tuple[list[tuple[float, float]], int]:
    """Returns octaves as (times finer, gain), and the seed, of octaves, gain, finer, seed, all of which may be left
    out."""
    count = _OCTAVES
    if len(term.parts) > 2:
        count = int(weaver.fixed(term.parts[2], env, 1, OCTAVES_MOST, True))
    gain = _optional(weaver, term, env, 3, _GAIN, (0.0, 1.0))
    finer = _optional(weaver, term, env, 4, _FINER, (1.0, 8.0))
    out, scale, loud = [], 1.0, 1.0
    for _ in range(count):
        out.append((scale, loud))
        scale, loud = min(scale * finer, 1e12), loud * gain
    return out, _seed(weaver, term, env, 5)


def _fbm(weaver: Weaver, term: Term, env: Env) -> Value:
    place, error = _place(weaver, term, env)
    octaves, seed = _octaves(weaver, term, env)
    power = math.sqrt(sum(gain * gain for _, gain in octaves))
    node = _noises(weaver, place, seed, [(finer, LOUD * gain / power) for finer, gain in octaves])
    return Value((weaver.graph.plus(node, 0.5),), weaver.errors.bounded(error))


def _folded(ridged: bool) -> Rule:
    """Octaves of noise folded where they pass through 0; each fades to its mean where it is too fine."""

    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        place, error = _place(weaver, term, env)
        octaves, seed = _octaves(weaver, term, env)
        graph, wide = weaver.graph, _told_width(weaver, place, _widths(weaver, place))
        total, errors, all_ = graph.constant(0.0), [weaver.errors.bounded(error)], sum(gain for _, gain in octaves)
        for n, (finer, gain) in enumerate(octaves):
            mean = graph.constant(_RIDGE if ridged else _TURBULENCE)
            seen = min(max((_UNSEEN - wide * finer * _CELLS) / (_UNSEEN - _SEEN), 0.0), 1.0)
            if seen > 0.0:
                own = _noises(weaver, place, seed + 7 * n, [(finer, 1.0)])
                fold = graph.sub(graph.times(weaver.ramped(own), 2.0), own)
                spread = weaver.spreads.of(own)
                if ridged:
                    square = graph.plus(graph.mul(own, own), spread.lost_squared)
                    fold = graph.plus(
                        graph.add(graph.times(fold, -2.0 * _STEEP), graph.times(square, _STEEP * _STEEP)), 1.0
                    )
                mean = graph.blend(mean, fold, graph.constant(seen))
                errors.append(weaver.errors.at_edge(own, 0.8 * spread.within * seen * gain / all_, NO_ERROR))
            total = graph.add(total, graph.times(mean, gain / all_))
        return Value((total,), weaver.errors.worst(*errors))

    return rule


def _white(weaver: Weaver, term: Term, env: Env) -> Value:
    place, error = _place(weaver, term, env)
    made = white(weaver, place, _seed(weaver, term, env, 2), env)
    own = NO_ERROR if env.mean else weaver.errors.worst(*(weaver.errors.jump(one) for one in place))
    return Value((made,), weaver.errors.worst(weaver.errors.bounded(error), own))


def white(weaver: Weaver, place: list[int], seed: int, env: Env) -> int:
    """Returns a random number for each unit square."""
    return half_white(weaver, place, (seed, 0), 0.5, env)


def half_white(weaver: Weaver, place: list[int], which: tuple[int, int], about: float, env: Env) -> int:
    """Returns `white` about another number; `which`: its seed, and 1 where it is only in the upper half of each square,
    elsewhere there is that number.

    At a point it has no values between those of two cells, but where a sample spans as much as a cell.
    """
    widths = _widths(weaver, place)
    wide = _told_width(weaver, place, widths)
    spread = spread_within(_EVEN, wide, 0.6, 2.0, (0.0, 0.01))
    if _unseen(weaver, widths):
        return weaver.graph.plus(_level(weaver, spread), about)
    if not env.mean:
        blurred = min(max(wide - 0.5, 0.0), 1.0)
        widths = weaver.graph.times(widths[0], blurred), weaver.graph.times(widths[1], blurred)
        spread = Spread(spread.within, spread.lost * blurred)
    key = _key(weaver, Code.WHITE, which[0]) & MASK32
    made = weaver.graph.node(Code.WHITE, *place, *widths, key=(key,), kind=which[1])
    weaver.spreads.told[made] = Spread(spread.within, spread.lost * (1.0 if which[1] == 0 else 0.7))
    return weaver.graph.plus(made, about)


def _cells(kind: int) -> Rule:
    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        place, error = _place(weaver, term, env)
        jitter = _optional(weaver, term, env, 2, 1.0, (0.0, 1.0))
        key, widths = _key(weaver, Code.CELLS, _seed(weaver, term, env, 3)) & MASK32, _widths(weaver, place)
        node = weaver.graph.node(Code.CELLS, *place, *widths, numbers=(jitter,), key=(key,), kind=kind)
        deviation, half, falls, seen = _CELLS_FADE[kind]
        spread = spread_within(deviation, _told_width(weaver, place, widths), half, falls, seen)
        weaver.spreads.told[node] = spread
        own = NO_ERROR
        weaver.errors.flat(spread.within * _CELLS_ERRORS[kind])
        if kind == cell_rows.RANDOM and spread.within > FEW_FROM:
            edge = weaver.graph.node(Code.CELLS, *place, *widths, numbers=(jitter,), key=(key,), kind=cell_rows.EDGE)
            near = weaver.graph.node(Code.LESS, edge, weaver.graph.times(weaver.graph.most(*widths), _SEES))
            own = weaver.graph.pick(near, weaver.graph.constant(1.0), NO_ERROR)
        return Value((node,), weaver.errors.worst(weaver.errors.bounded(error), own))

    return rule


def _random(weaver: Weaver, term: Term, env: Env) -> Value:
    number = int(weaver.fixed(term.parts[0], env, 0, 1e9, True))
    key = _key(weaver, Code.RANDOM, number) & MASK32
    return Value((weaver.graph.node(Code.RANDOM, *env.cell, key=(key,)),))


_SUM = "octaves, gain, finer, seed)"
NOISE_WORDS: dict[str, tuple[int, int, Rule, str]] = {
    "noise": (2, 3, _noise, "noise(x, y, seed): smooth noise about 0.5, a hill or a hollow in each unit"),
    "white": (2, 3, _white, "white(x, y, seed): a random number from 0 to 1 for each unit square"),
    "fbm": (2, 6, _fbm, f"fbm(x, y, {_SUM}: noise of many sizes, each octave finer and weaker"),
    "ridged": (2, 6, _folded(True), f"ridged(x, y, {_SUM}: noise with bright ridges, as of mountains"),
    "turbulence": (2, 6, _folded(False), f"turbulence(x, y, {_SUM}: noise with dark creases, as of smoke"),
    "cells": (2, 4, _cells(cell_rows.DISTANCE), "cells(x, y, jitter, seed): how far the nearest of many points is"),
    "cells_edge": (2, 4, _cells(cell_rows.EDGE), "cells_edge(x, y, jitter, seed): how far the edge of the cell is"),
    "cells_random": (2, 4, _cells(cell_rows.RANDOM), "cells_random(x, y, jitter, seed): a random number for each cell"),
    "random": (1, 1, _random, "random(n): the nth random number, 0 to 1, of each part of a repeat"),
}  # fmt: skip
