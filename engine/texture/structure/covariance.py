"""The linear map by which rows of numbers come to have a covariance among one another, and another with others, while
they change as little as they can."""

from __future__ import annotations

import numpy as np

from engine.numeric.matrices import combinations, products
from engine.numeric.solving import nearest_rotation, solved
from engine.numeric.symmetric import eigenvectors, product

_FAINT = 1e-7  # of the mean variance: directions with less are not made louder
_FIRM = 1e-4  # of the parents' mean variance, so that some that are like others do not tear the map apart


def coerced(
    rows: np.ndarray, together: np.ndarray, parents: np.ndarray | None = None, under: np.ndarray | None = None
) -> np.ndarray:
    """Returns rows (b, n) with the covariance `together` (b, b), and with `parents` (p, n) the one `under` (b, p)."""
    count = max(rows.shape[1], 1)
    now = products(rows, rows) / count
    if parents is None or under is None or not under.size:
        return combinations(_map(now, together, together), rows)
    theirs = products(parents, parents) / count
    theirs += np.eye(len(theirs)) * (_FIRM * _mean_variance(theirs) + 1e-20)
    both = products(rows, parents) / count
    share, wanted = (_times(solved(theirs, part.T).T, part.T) for part in (both, under))
    own = _map(now - share, together - wanted, together)
    rest = solved(theirs, (under - _times(own, both)).T).T
    return combinations(rest, parents, combinations(own, rows))


def _map(now: np.ndarray, wanted: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Returns the matrix that takes a covariance to another, and is nearest to none."""
    least = _FAINT * max(_mean_variance(whole), 1e-20)
    (size, axes), (target, goals) = eigenvectors(now), eigenvectors(wanted)
    roots, wanted_roots = (np.sqrt(np.maximum(values, least)) for values in (size, target))
    ours, theirs = axes * roots, goals * wanted_roots
    turn = nearest_rotation(_times(np.ascontiguousarray(theirs.T), ours))
    return _times(_times(theirs, turn), np.ascontiguousarray((axes / roots).T))


def _times(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    found: np.ndarray = product(np.ascontiguousarray(one), np.ascontiguousarray(other))
    return found


def _mean_variance(covariance: np.ndarray) -> float:
    return float(sum(np.diag(covariance))) / max(len(covariance), 1)
