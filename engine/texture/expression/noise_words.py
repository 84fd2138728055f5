"""Functions that are random by place: noise and sums of it, white noise, cells, a number for each part of a repeat."""

from __future__ import annotations

from engine.numeric.hashing import MASK32, fold_key
from engine.texture.expression import cell_rows
from engine.texture.expression.codes import Code
from engine.texture.expression.noise_rows import CELLS_SEEN
from engine.texture.expression.weaving import POINT_SIDE, Env, Rule, Value, Weaver
from engine.texture.expression.written import Term

_DOMAIN = 0x78707273  # tells these hashes from those of other textures
_CELLS = 2.0  # of noise, in a unit
_SPREAD = 0.463  # its standard deviation at a gain of 1
_FAINT = 0.35 / 255.0  # of what is left of an octave
LOUD = 0.36  # of noise about 1/2: its standard deviation is 0.17
OCTAVES_MOST = 32
_OCTAVES, _GAIN, _FINER = 8, 0.5, 2.0
_RIDGE, _TURBULENCE = 0.46, 0.372  # means of 1 - |n| squared, and of |n|, n being noise of standard deviation 0.46
_SEEN, _UNSEEN = 1.0, 3.0  # cells across a sample, between which a fold fades to its mean


def _place(weaver: Weaver, term: Term, env: Env, count: int = 2) -> tuple[list[int], int]:
    """Returns the nodes of the first values of a function, and the samples they take."""
    values = [weaver.number(part, env.point) for part in term.parts[:count]]
    return [value.nodes[0] for value in values], max(value.side for value in values)


def _optional(weaver: Weaver, term: Term, env: Env, at: int, usual: float, bounds: tuple[float, float]) -> float:
    """Returns a value that may be left out, the same everywhere."""
    return weaver.fixed(term.parts[at], env, *bounds) if len(term.parts) > at else usual


def _seed(weaver: Weaver, term: Term, env: Env, at: int) -> int:
    return int(weaver.fixed(term.parts[at], env, -1e9, 1e9, True)) if len(term.parts) > at else 0


def _key(weaver: Weaver, *about: int) -> int:
    return fold_key(_DOMAIN, weaver.setting.seed, *about)


_Lattice = tuple[float, float, float, float, float]


def _octave(weaver: Weaver, seed: int, number: int, finer: float, gain: float) -> tuple[_Lattice, int]:
    """Returns the lattice of an octave, and its key: octaves are shifted, that no two have their cells in line.

    What is left of noise of standard deviation s over w cells is s w^-3/2: beyond where that is _FAINT, none is seen.
    """
    key = _key(weaver, Code.NOISE, seed, number)
    across, down = ((key >> bits & 0xFFFF) / 1024.0 for bits in (32, 48))
    widest = (abs(gain) * _SPREAD / _FAINT) ** (2.0 / 3.0)
    return (_CELLS * finer, across, down, gain, min(max(widest, 2.0), CELLS_SEEN)), key & MASK32


def _widths(weaver: Weaver, place: list[int]) -> tuple[int, int]:
    return weaver.width(place[0]), weaver.width(place[1])


def _unseen(weaver: Weaver, widths: tuple[int, int], scale: float, widest: float = CELLS_SEEN) -> bool:
    """Tells whether cells are too fine for every sample."""
    told = [weaver.graph.value(width) for width in widths]
    return any(one is not None and one * scale >= widest for one in told)


def _noises(weaver: Weaver, place: list[int], seed: int, octaves: list[tuple[float, float]]) -> int:
    """Returns a sum of octaves of noise about 0, each (times finer, gain)."""
    numbers: list[float] = []
    keys: list[int] = []
    widths = _widths(weaver, place)
    for n, (finer, gain) in enumerate(octaves):
        lattice, key = _octave(weaver, seed, n, finer, gain)
        if not _unseen(weaver, widths, lattice[0], lattice[4]):
            numbers += lattice
            keys.append(key)
    if not keys:
        return weaver.graph.constant(0.0)
    return weaver.graph.node(Code.NOISE, *place, *widths, numbers=tuple(numbers), key=tuple(keys))


def _noise(weaver: Weaver, term: Term, env: Env) -> Value:
    place, side = _place(weaver, term, env)
    return Value((weaver.graph.plus(_noises(weaver, place, _seed(weaver, term, env, 2), [(1.0, LOUD)]), 0.5),), side)


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
    place, side = _place(weaver, term, env)
    octaves, seed = _octaves(weaver, term, env)
    power = sum(gain * gain for _, gain in octaves) ** 0.5
    node = _noises(weaver, place, seed, [(finer, LOUD * gain / power) for finer, gain in octaves])
    return Value((weaver.graph.plus(node, 0.5),), side)


def _folded(ridged: bool) -> Rule:
    """Octaves of noise folded where they pass through 0; each fades to its mean where it is too fine."""

    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        place, side = _place(weaver, term, env)
        octaves, seed = _octaves(weaver, term, env)
        graph, widths = weaver.graph, _widths(weaver, place)
        wide, total, all_ = graph.most(*widths), graph.constant(0.0), sum(gain for _, gain in octaves)
        mean = graph.constant(_RIDGE if ridged else _TURBULENCE)
        for n, (finer, gain) in enumerate(octaves):
            lattice, key = _octave(weaver, seed, n, finer, 1.0)
            seen = graph.within(graph.plus(graph.times(wide, -lattice[0] / (_UNSEEN - _SEEN)), _UNSEEN / 2.0))
            made = mean
            if graph.value(seen) != 0.0:
                own = graph.node(Code.NOISE, *place, *widths, numbers=lattice, key=(key,))
                fold = graph.node(Code.ABS, own)
                if ridged:
                    fold = graph.most(graph.plus(graph.times(fold, -1.0), 1.0), graph.constant(0.0))
                    fold = graph.mul(fold, fold)
                made = graph.blend(mean, fold, seen)
            total = graph.add(total, graph.times(made, gain / all_))
        return Value((total,), max(side, POINT_SIDE))

    return rule


def _white(weaver: Weaver, term: Term, env: Env) -> Value:
    place, side = _place(weaver, term, env)
    return Value((white(weaver, place, _seed(weaver, term, env, 2)),), side)


def white(weaver: Weaver, place: list[int], seed: int) -> int:
    """Returns a random number for each unit square."""
    widths = _widths(weaver, place)
    if _unseen(weaver, widths, 1.0):
        return weaver.graph.constant(0.5)
    key = _key(weaver, Code.WHITE, seed) & MASK32
    return weaver.graph.node(Code.WHITE, *place, *widths, key=(key,))


def _cells(kind: int) -> Rule:
    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        place, side = _place(weaver, term, env)
        jitter = _optional(weaver, term, env, 2, 1.0, (0.0, 1.0))
        key = _key(weaver, Code.CELLS, _seed(weaver, term, env, 3)) & MASK32
        node = weaver.graph.node(Code.CELLS, *place, *_widths(weaver, place), numbers=(jitter,), key=(key,), kind=kind)
        return Value((node,), max(side, POINT_SIDE))

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
