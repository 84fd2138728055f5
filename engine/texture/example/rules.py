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
    return Rules(
        weights(given.neighbourhood),
        square_bits(given.neighbourhood),
        penalty,
        _LEEWAY[above] if n >= 2 and above < len(_LEEWAY) and exemplar.boundary else 0,
        int(256 * (1.0 + given.kappa)),
        int(256 * (1.0 + min(given.kappa, _RIM_KAPPA))),
        max(given.every, exemplar.levels[n].order.size // lists // _CANDIDATES) if above == 0 else 0,
        exemplar.boundary,
        NO_WEIGHTS if exemplar.control is None else exemplar.control.weights,
    )
