"""What a region painted with an example shows below the example's own pixels where its detail is learnt: at most two
octaves that follow from what is shown above them, and from noise by its place (Perlin & Velho 1995, section 7.2).

The outline goes on as everywhere on the canvas, by the B-spline of the pixels.  An opaque example is refined as if it
went on beyond its outline, so that this is no edge of it; one with alpha has learnt of its own edges.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.detail import add_expanded, cut, parents, subtract_expanded
from engine.numeric.grid import FINE_STEP, snapped
from engine.numeric.kernel import Array, dividing, forced, inner, kernel
from engine.numeric.pyramid import expand_into
from engine.texture.learnt.kinds import LOOKED_ROUND
from engine.texture.learnt.maps import Maps, maps_of
from engine.texture.learnt.refinement import Learning, channels_of

LOOKED_ABOUT = 8  # of the example's own pixels, around a place: what counts for what is shown below it
_NEAR = 3  # pixels from which colours go on beyond the outline
_ENOUGH, _FAINT = np.float32(0.5), np.float32(1.0 / 64.0)
_LEAST = np.float32(1e-9)
_ONE, _ZERO, _QUARTER = np.float32(1.0), np.float32(0.0), np.float32(0.25)


def has_alpha(learning: Learning) -> bool:
    """Tells whether alpha was learnt, too."""
    maps = maps_of(learning.maps)
    return maps is not None and bool(maps.channels == 4)


def below_own(learning: Learning, octave: int, rect: Rect, own: Callable[[Rect], np.ndarray]) -> np.ndarray:
    """Returns what is shown `octave` (1 or 2) levels below an example's own pixels: premultiplied float32 (4, h, w) of
    an even rectangle there, on the grid.  `own`: gives those pixels, likewise, over any even rectangle."""
    maps = maps_of(learning.maps)
    assert maps is not None
    around = rect.zoomed(-octave).grown(LOOKED_ABOUT).evened()
    there = own(around)
    if not there[3].any():
        return np.zeros((4, rect.height, rect.width), np.float32)
    if maps.channels == 4:
        return snapped(_below(learning, octave, rect, lambda place: cut(there, place, around)))
    out = np.empty((4, rect.height, rect.width), np.float32)
    out[3] = _outline(there[3:], around, octave, rect)
    seen = _below(learning, octave, rect, lambda place: _colours(there, around, place, maps))
    np.multiply(np.clip(seen, _ZERO, _ONE), out[3], out=out[:3])
    return snapped(out)


def _below(learning: Learning, octave: int, rect: Rect, own: Callable[[Rect], np.ndarray]) -> np.ndarray:
    """Returns a picture so many octaves below, four pixels of which are in the mean, at full strength, the one above
    them: so it looks the same from farther away."""
    if not octave:
        return own(rect)
    even = rect.evened()
    wide = even.zoomed(-1).grown(LOOKED_ROUND)
    above = _below(learning, octave - 1, wide, own)
    out = replace(learning, strength=1.0).seen_below(octave, even, lambda place: cut(above, place, wide))
    coarse = cut(above, parents(even), wide)
    _centre(coarse, out)
    if learning.strength < 1.0:
        subtract_expanded(out, coarse)
        out *= np.float32(learning.strength)
        add_expanded(out, coarse)
    return cut(out, rect, even)


def _colours(there: np.ndarray, around: Rect, place: Rect, maps: Maps) -> np.ndarray:
    """Returns the planes that maps are for, over a rectangle within `around`."""
    wide = np.ascontiguousarray(cut(there, place.grown(_NEAR), around))
    colours = np.empty((3, place.height, place.width), np.float32)
    _go_on(wide, colours)
    return channels_of(colours[:1] if maps.channels == 1 else colours, maps)


def _outline(alpha: np.ndarray, at: Rect, octave: int, rect: Rect) -> np.ndarray:
    """Returns alpha (1, h, w), which covers `at`, so many levels below over a rectangle: float32 (h, w)."""
    for k in range(1, octave + 1):
        place = rect.zoomed(k - octave).grown(2).evened() if k < octave else rect
        out = np.empty((1, place.height, place.width), np.float32)
        top, left = (place.y0 >> 1) - 1 - at.y0, (place.x0 >> 1) - 1 - at.x0
        expand_into(np.ascontiguousarray(alpha), top, left, np.arange(1), out, 0, place.height, FINE_STEP)
        alpha, at = out, place
    found: np.ndarray = alpha[0]
    return found


@dividing
def _centre(coarse: Array, out: Array) -> None:
    """Gives each four pixels of `out` (C, 2h, 2w) the mean of the one above them, in `coarse` (C, h + 2, w + 2), and
    makes them as much less different from it as lets them stay within 0..1, colours below alpha, the last of four;
    where alpha changes by that, so do they."""
    channels, height, width = coarse.shape
    whole, most = np.ones((2, 2 * width - 4), np.float32), np.ones((2, 2 * width - 4), np.float32)
    before = whole
    for y in range(height - 2):
        last = coarse[channels - 1, y + 1]
        if channels == 4:
            before = out[3, 2 * y : 2 * y + 2].copy()
            _centre_row(last, last, whole, whole, out[3, 2 * y], out[3, 2 * y + 1])
            most[0], most[1] = out[3, 2 * y], out[3, 2 * y + 1]
        for c in range(min(channels, 3)):
            _centre_row(coarse[c, y + 1], last, before, most, out[c, 2 * y], out[c, 2 * y + 1])


@forced
def _centre_row(means: Array, last: Array, before: Array, most: Array, upper: Array, lower: Array) -> None:
    """Does so in two rows of one channel, which is at most `most`, and that was `before`; `last`: means of the last
    channel.  Nothing branches, so that many pixels are reckoned at once."""
    (m0, m1), (b0, b1) = (most[0], most[1]), (before[0], before[1])
    for x in range(means.size - 2):
        p, q, r, s = m0[2 * x], m0[2 * x + 1], m1[2 * x], m1[2 * x + 1]
        i, j, k, m = b0[2 * x], b0[2 * x + 1], b1[2 * x], b1[2 * x + 1]
        a, b, d, e = upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]
        least = min(min(p, q), min(r, s))
        same = (p == i) & (q == j) & (r == k) & (s == m) & (least >= _FAINT)
        a, b = (a if same else a * (p / max(i, _FAINT))), (b if same else b * (q / max(j, _FAINT)))
        d, e = (d if same else d * (r / max(k, _FAINT))), (e if same else e * (s / max(m, _FAINT)))
        mean, base = means[x + 1], max(last[x + 1], _LEAST)
        apart = ((a + b) + (d + e)) * _QUARTER
        a, b, d, e = a - apart, b - apart, d - apart, e - apart
        part = min(min(_part(a, mean, p), _part(b, mean, q)), min(_part(d, mean, r), _part(e, mean, s)))
        beyond = mean > least  # there is less alpha: as much colour as alpha
        upper[2 * x] = _within(beyond, mean, base, part * a, p)
        upper[2 * x + 1] = _within(beyond, mean, base, part * b, q)
        lower[2 * x] = _within(beyond, mean, base, part * d, r)
        lower[2 * x + 1] = _within(beyond, mean, base, part * e, s)


@forced
def _within(beyond: bool, mean: np.float32, base: np.float32, apart: np.float32, most: np.float32) -> np.float32:
    return min(mean * (most / base), most) if beyond else min(max(mean + apart, _ZERO), most)


@forced
def _part(apart: np.float32, mean: np.float32, most: np.float32) -> np.float32:
    """How much of a difference from a mean stays within 0 and the most."""
    over, under = (most - mean) / apart, mean / -apart
    return over if apart > most - mean else under if -apart > mean else _ONE


@kernel
def _go_on(planes: Array, out: Array) -> None:
    """Writes the colours (3, h, w) of premultiplied planes, _NEAR more on each side, as if they were opaque: where they
    hardly are, the mean of the nearest that are; nothing where there are none."""
    for y in range(out.shape[1]):
        for x in range(out.shape[2]):
            alpha = planes[3, y + _NEAR, x + _NEAR]
            if alpha == _ONE:
                for c in range(3):
                    out[c, y, x] = planes[c, y + _NEAR, x + _NEAR]
            else:
                _mean_near(planes, y + _NEAR, x + _NEAR, out[:, y, x])


@inner
def _mean_near(planes: Array, y: int, x: int, out: Array) -> None:
    total = _ZERO
    for reach in range(_NEAR + 1):
        total = _ZERO
        out[:] = _ZERO
        for j in range(y - reach, y + reach + 1):
            for i in range(x - reach, x + reach + 1):
                total += planes[3, j, i]
                for c in range(3):
                    out[c] += planes[c, j, i]
        if total >= _ENOUGH:
            break
    if total > _ZERO:
        for c in range(3):
            out[c] = min(out[c] / total, _ONE)
