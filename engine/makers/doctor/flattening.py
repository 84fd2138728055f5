"""Light that falls off over a picture, and a plane seen at a slant: found, and taken out.

Of pictures float32 (C, h, w) in 0..1 that are the same texture all over, apart from these.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.makers.doctor.measuring import grey_of

_LIT = 0.12  # of the variance of the brightness that a smooth surface explains
_STRIPS = 8  # along a side, in which frequencies are compared
_SLOW = 8  # of a picture's width: light hardly changes over such a part to each side
_SLANTED = 0.35  # by how much they change from one end to the other, in parts of the mean
_SURE = 0.8  # of their changes that a straight line explains
_HALF = 0.5
_DARKEST = 0.02
_TURNED = ("up", "down", "left", "right")


@dataclass(frozen=True, slots=True)
class Gradients:
    """`light`: the part of the brightness' variance that is light, 0 where there is hardly any; `slant`: where the
    plane goes farther away, "up", "down", "left", "right", or ""; `nearer`: how many times as large things are at the
    near end as at the far one."""

    light: float = 0.0
    slant: str = ""
    nearer: float = 1.0


def gradients(picture: np.ndarray) -> Gradients:
    """Measures both."""
    grey = grey_of(picture)
    if min(grey.shape) < 8 * _STRIPS or float(grey.std()) < 1e-4:
        return Gradients()
    logarithm = np.log(np.maximum(grey, _DARKEST)).astype(np.float64)
    surface = _surface(logarithm)
    light = float(surface.var() / max(logarithm.var(), 1e-12))
    slant, nearer = _slant(logarithm - surface)
    return Gradients(light if light > _LIT else 0.0, slant, nearer)


def evened(picture: np.ndarray, found: Gradients) -> np.ndarray:
    """Returns a picture without what was found."""
    out = picture
    if found.light:
        grey = grey_of(picture)
        surface = _surface(np.log(np.maximum(grey, _DARKEST)).astype(np.float64))
        gain = np.exp(surface.mean() - surface).astype(np.float32)
        most = out[3:4] if len(out) == 4 else np.float32(1.0)
        out = out.copy()
        out[:3] = np.clip(out[:3] * gain, 0.0, most)
    if found.slant:
        out = _upright(out, found)
    return np.ascontiguousarray(out, np.float32)


def _surface(values: np.ndarray) -> np.ndarray:
    """Returns the smooth surface, of the second degree, nearest to values (h, w)."""
    height, width = values.shape
    y = np.linspace(-1.0, 1.0, height)[:, None] * np.ones((1, width))
    x = np.linspace(-1.0, 1.0, width)[None] * np.ones((height, 1))
    terms = np.stack([np.ones_like(x), x, y, x * y, x * x, y * y]).reshape(6, -1)
    factors = np.linalg.lstsq(terms @ terms.T, terms @ values.reshape(-1), rcond=None)[0]
    out: np.ndarray = (factors @ terms).reshape(values.shape)
    return out


def _slant(values: np.ndarray) -> tuple[str, float]:
    """Returns whither the plane goes away, and how many times as large things are at the near end; ("", 1) if they are
    as large all over.  Along the plane's level lines frequencies are as one over the distance from the horizon."""
    best, whither, nearer = 0.0, "", 1.0
    for axis in (0, 1):
        lengths = _lengths(values if axis == 0 else values.T)
        places = np.arange(_STRIPS) - (_STRIPS - 1) / 2
        slope = float((places * lengths).sum() / (places * places).sum())
        fitted = lengths.mean() + slope * places
        sure = 1.0 - float(((lengths - fitted) ** 2).sum() / max(((lengths - lengths.mean()) ** 2).sum(), 1e-12))
        change = abs(slope) * _STRIPS / max(float(lengths.mean()), 1e-12)
        if change > max(best, _SLANTED) and sure > _SURE:
            first, last = (float(lengths.mean() + sign * slope * _STRIPS / 2) for sign in (-1, 1))
            best, nearer = change, max(first, last) / max(min(first, last), 1e-3)
            whither = _TURNED[2 * axis + (0 if slope > 0 else 1)]
    return whither, min(nearer, 8.0)


def _lengths(values: np.ndarray) -> np.ndarray:
    """Returns how long things are along the rows of each of some strips, the upper first.  What varies over more than a
    few of them is light, and left out."""
    height, far, out = values.shape[0] // _STRIPS, values.shape[1] // _SLOW, np.empty(_STRIPS)
    for n in range(_STRIPS):
        strip = values[n * height : (n + 1) * height]
        slow = np.cumsum(np.pad(strip, ((0, 0), (far + 1, far)), mode="reflect"), axis=1)
        strip = strip - (slow[:, 2 * far + 1 :] - slow[:, : -2 * far - 1]) / (2 * far + 1)
        out[n] = _half_gone(strip)
    return out


def _half_gone(strip: np.ndarray) -> float:
    """Returns how far along its rows a strip is half like itself: pixels."""
    before, whole = 1.0, max(float((strip * strip).mean()), 1e-12)
    for lag in range(1, strip.shape[1] // 2):
        now = float((strip[:, lag:] * strip[:, :-lag]).mean()) / whole
        if now < _HALF:
            return float(lag) - (_HALF - now) / (before - now)
        before = now
    return float(strip.shape[1] // 2)


def _upright(picture: np.ndarray, found: Gradients) -> np.ndarray:
    """Returns what lies at a slant as it is from above: as wide as the near end, and the part that all rows have."""
    turn = {"up": 0, "down": 2, "left": 3, "right": 1}[found.slant]
    seen = np.rot90(picture, turn, (1, 2))  # the far end is above
    _, height, width = seen.shape
    far = 1.0 / found.nearer
    # A row at the distance t, 1 near and `nearer` far, lies at s = 1 / t between the horizon and the near end.
    rows = round(height * min(found.nearer, 2.0))
    t = np.linspace(found.nearer, 1.0, rows)
    s = 1.0 / t
    at = (s - far) / (1.0 - far) * (height - 1)
    out = np.empty((len(seen), rows, int(width * far)), np.float32)
    steps = np.arange(out.shape[2]) - (out.shape[2] - 1) / 2
    for n in range(rows):
        out[:, n] = _row(seen, at[n], (width - 1) / 2 + steps * s[n])
    return np.rot90(out, -turn, (1, 2))


def _row(picture: np.ndarray, y: float, x: np.ndarray) -> np.ndarray:
    """Returns a picture at places (y, x) within it, straight lines between its pixels."""
    top = min(int(y), picture.shape[1] - 2)
    down = np.float32(y - top)
    left = np.clip(x.astype(np.int64), 0, picture.shape[2] - 2)
    across = (x - left).astype(np.float32)
    line = picture[:, top] * (1 - down) + picture[:, top + 1] * down
    out: np.ndarray = line[:, left] * (1 - across) + line[:, left + 1] * across
    return out
