"""What kernels are told of a level of the example, and of how neighbourhoods are compared there (Ritter et al. 2006,
section 5).
"""

from __future__ import annotations

from engine.numeric.neighbourhood import SIDE, WEIGHT, square_bits, weights
from engine.texture.example.control import NO_PLANES, NO_WEIGHTS
from engine.texture.example.exemplar import COUNTS, Exemplar
from engine.texture.example.region_window import Example, Rules

_CANDIDATES = 1024  # of a search at the coarsest level, at most: an example may be large and have but one
# Pixels of another shape that are free, from the coarsest level on: where pixels are large the example has few shapes
# like the stroke's, and the same ones again and again would show as a comb.
_LEEWAY = 6, 2
# At a rim, at most: else where a stroke is narrow what continues one side of it goes on to its other side.
_RIM_KAPPA = 1.5
_SHAPES, _FEW = 64, 11  # of a rim, of which the nearest are searched; and without seams
_RARER = 125  # times as few candidates are searched at the coarsest level without seams
_MOST = 16.0  # of the energy of a shape: so it stays within 32 bits


def example_of(exemplar: Exemplar, n: int) -> Example:
    """Gives level `n` of an example as kernels take it, 0 the finest."""
    level = exemplar.levels[n]
    own, held = exemplar.control, (level.compared.reshape(-1), level.region, level.bits, level.order)
    told = (NO_PLANES, NO_WEIGHTS) if own is None else (own.levels[n], own.turns[n])
    return Example(*held, exemplar.shapes[n], level.starts, *told)


def rules_of(exemplar: Exemplar, n: int) -> Rules:
    """Gives how neighbourhoods are compared at level `n`, as kernels take it."""
    given = exemplar.parameters
    above = len(exemplar.levels) - 1 - n
    size = SIDE * SIDE / given.neighbourhood**2
    lists = exemplar.levels[n].starts.size // (COUNTS + 1)
    penalty = int(min(given.e_max * size, _MOST) * 65025 * WEIGHT)
    leeway = _LEEWAY[above] if n >= 2 and above < len(_LEEWAY) and exemplar.boundary else 0
    rules = Rules(
        weights(given.neighbourhood),
        square_bits(given.neighbourhood),
        penalty,
        leeway,
        int(256 * (1.0 + given.kappa)),
        int(256 * (1.0 + min(given.kappa, _RIM_KAPPA))),
        max(given.every, exemplar.levels[n].order.size // lists // _CANDIDATES) if above == 0 else 0,
        exemplar.boundary,
        NO_WEIGHTS if exemplar.control is None else exemplar.control.weights,
        0,
        _SHAPES,
        False,
    )
    return _seamless(rules, exemplar.ragged) if exemplar.seamless else rules


def _seamless(rules: Rules, ragged: int) -> Rules:
    """Without seams: neither the coarsest level's pieces are searched for what is better, nor all of a rim's shapes.

    What is the best anywhere would be it again and again, and it would be plain and faint: what has little of its own
    is not far from anything.  The more ragged a rim, the less its shapes tell, and the fewer are looked at.
    """
    return rules._replace(
        leeway=max(0, ragged - 1),
        stride=rules.stride * _RARER,
        depth=rules.penalty // 2,
        shapes=max(1, _FEW - 5 * ragged // 2),
        pieces=True,
    )
