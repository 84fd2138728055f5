"""Editing curves given by knots: pairs (in, out) of 0..1, inputs rising strictly, straight lines between them.

Pure: every function takes knots and gives new ones, rounded to four digits as brushes keep them.
"""

from __future__ import annotations

from bisect import bisect_right

Knots = tuple[tuple[float, float], ...]

CAP = 64  # knots of a curve
_GAP = 1 / 512  # between the inputs of neighbours
STRAIGHT: Knots = ((0.0, 0.0), (1.0, 1.0))


def at(knots: Knots, x: float) -> float:
    """Returns the curve's output; level before the first knot and after the last."""
    i = bisect_right(knots, (x, float("inf")))
    if i == 0:
        return knots[0][1]
    if i == len(knots):
        return knots[-1][1]
    (x0, y0), (x1, y1) = knots[i - 1], knots[i]
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0)


def nearest(knots: Knots, x: float, y: float, reach: float) -> int | None:
    """Returns the knot nearest to a point, if it is within `reach`."""
    distance, i = min(((kx - x) ** 2 + (ky - y) ** 2, i) for i, (kx, ky) in enumerate(knots))
    return i if distance <= reach * reach else None


def added(knots: Knots, x: float, y: float) -> tuple[Knots, int | None]:
    """With one more knot, and its number; None where there is no room for it."""
    i = bisect_right(knots, (x, float("inf")))
    lo = knots[i - 1][0] + _GAP if i else 0.0
    hi = knots[i][0] - _GAP if i < len(knots) else 1.0
    if len(knots) >= CAP or lo > hi:
        return knots, None
    return (*knots[:i], _knot(min(max(x, lo), hi), y), *knots[i:]), i


def moved_knot(knots: Knots, i: int, x: float, y: float) -> Knots:
    """Knot `i` brought to (x, y), or as near as its neighbours let it."""
    lo = knots[i - 1][0] + _GAP if i else 0.0
    hi = knots[i + 1][0] - _GAP if i + 1 < len(knots) else 1.0
    if lo > hi:
        x = knots[i][0]
    return (*knots[:i], _knot(min(max(x, lo), hi), y), *knots[i + 1 :])


def removed(knots: Knots, i: int) -> Knots:
    """Without knot `i`; the last two stay."""
    return knots if len(knots) <= 2 else (*knots[:i], *knots[i + 1 :])


def drawn_curve(knots: Knots, start: tuple[float, float], end: tuple[float, float]) -> Knots:
    """Returns the curve by hand: 64 knots side by side, those between two points of the pen on the line between
    them."""
    (x0, y0), (x1, y1) = sorted((start, end))
    first, last = round(x0 * (CAP - 1)), round(x1 * (CAP - 1))
    out = []
    for i in range(CAP):
        x = i / (CAP - 1)
        if first <= i <= last:
            part = 1.0 if x1 == x0 else min(max((x - x0) / (x1 - x0), 0.0), 1.0)
            out.append(_knot(x, y0 + (y1 - y0) * part))
        else:
            out.append(_knot(x, at(knots, x)))
    return tuple(out)


def at_edge(point: tuple[float, float], reach: float) -> tuple[float, float]:
    """Returns a point of the pen, moved to an edge if it is that near: no piece of the old curve is left there."""
    x, y = point
    return 0.0 if x < reach else 1.0 if x > 1.0 - reach else x, y


def thinned(knots: Knots, tolerance: float) -> Knots:
    """As few of the knots as keep the curve within `tolerance` of what it was (Ramer 1972, Douglas & Peucker 1973,
    with the distance taken along the output)."""
    keep = {0, len(knots) - 1}
    spans = [(0, len(knots) - 1)]
    while spans:
        a, b = spans.pop()
        chord = (knots[a], knots[b])
        off, i = max(((abs(knots[i][1] - at(chord, knots[i][0])), i) for i in range(a + 1, b)), default=(0.0, a))
        if off > tolerance:
            keep.add(i)
            spans += [(a, i), (i, b)]
    return tuple(knots[i] for i in sorted(keep))


def _knot(x: float, y: float) -> tuple[float, float]:
    return round(min(max(x, 0.0), 1.0), 4), round(min(max(y, 0.0), 1.0), 4)
