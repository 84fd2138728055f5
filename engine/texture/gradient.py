"""Gradients as textures: colours along a line, around a point, or by angle, without a resolution of their own.

What a pixel shows is the mean of the ramp over the part of it that the pixel meets: where no knot lies in that, the
ramp's own value, so that even the steepest ramp has a soft edge one pixel wide at every level.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from engine.checks.field_error import FieldError
from engine.checks.values import described, is_number, is_within
from engine.numeric.address import Rect
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.numeric.elementary import angles
from engine.numeric.kernel import kernel

GRADIENTS = ("linear", "radial", "angular")
COLOURS_CAP = 64
_FAR_BITS = 50  # of the distance in pixels up to which halves of pixels count
_NEAREST = 2.0**-60  # pixels of its own level along the ramp at least
_STEEPEST = 900  # levels between a gradient's own and that of its pixels, beyond which it is as far as that

_COLOUR = re.compile(r"#(?:[0-9a-f]{6}|[0-9a-f]{8})")

RampKnots = tuple[tuple[float, str], ...]


@dataclass(frozen=True, slots=True)
class Gradient:
    """A gradient of a `shape`, from one place to another in pixels of `level`; `ramp`: places, 0..1, and colours.

    `covers`: not the colours, but what they hide.
    """

    base: int
    shape: str
    start: tuple[float, float]
    end: tuple[float, float]
    level: int
    ramp: RampKnots
    covers: bool = False

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        kind = "gradient-cover" if self.covers else "gradient"
        knots = (value for knot in self.ramp for value in knot)
        return (kind, self.base, self.shape, *self.start, *self.end, self.level, *knots)

    @property
    def cover(self) -> Gradient | None:
        """Returns what the gradient hides, for an ink that lies over another colour; None if it hides all."""
        opaque = all(_premultiplied(colour)[3] == 1.0 for _, colour in self.ramp)
        return None if opaque or self.covers else replace(self, covers=True)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`: premultiplied (4, h, w), of a cover (1, h,
        w)."""
        if level < self.base:
            raise ValueError(f"gradient: level {level} is coarser than the base level {self.base}")
        return self._means(level, rect, slice(3, 4) if self.covers else slice(0, 4))

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if level <= self.base or rect.empty:
            return None
        even, planes = rect.evened(), slice(3, 4) if self.covers else slice(0, 3)
        out = self._means(level, even, planes)
        if not subtract_expanded(out, self._means(level - 1, parents(even), planes)):
            return None
        inner = cut(out, rect, even)
        return inner if rect == even or inner.any() else None

    def _means(self, level: int, rect: Rect, planes: slice) -> np.ndarray:
        across, width = _offsets(self.start[0], self.level - level, rect.x0, rect.width)
        down, _ = _offsets(self.start[1], self.level - level, rect.y0, rect.height)
        reach_x, reach_y = self.end[0] - self.start[0], self.end[1] - self.start[1]
        squared = reach_x * reach_x + reach_y * reach_y
        at = np.empty((rect.height, rect.width))
        half = np.empty_like(at)
        if self.shape == "linear":
            _along(across, down, reach_x / squared, reach_y / squared, width, at, half)
        elif self.shape == "radial":
            _around(across, down, 1.0 / math.sqrt(squared), width, at, half)
        else:
            turn = float(angles(np.array([reach_y]), np.array([reach_x]))[0])
            _by_angle(across, down, turn, angles(*np.broadcast_arrays(down[:, None], across)), width, at, half)
        places = np.array([place for place, _ in self.ramp])
        colours = np.array([_premultiplied(colour) for _, colour in self.ramp])[:, planes]
        if self.shape == "angular":  # after one turn it begins again
            places, colours = _turned(places, colours)
        out = np.empty((colours.shape[1], rect.height, rect.width), np.float32)
        _ramp_means(at, half, places, np.ascontiguousarray(colours), out)
        return out


def gradient(parameters: Mapping[str, object], base: int) -> Gradient:
    """Returns the gradient that the parameters of a definition tell; FieldError names what is wrong."""
    shape = parameters.get("kind", "linear")
    if shape not in GRADIENTS:
        raise FieldError("kind", described(shape), f"one of {', '.join(GRADIENTS)}")
    start, end = (_place(parameters.get(name), name) for name in ("from", "to"))
    level = parameters.get("level", 0)
    if not isinstance(level, int) or isinstance(level, bool) or abs(level) > 1 << 12:
        raise FieldError("level", described(level), "an integer from -4096 to 4096")
    if max(abs(end[0] - start[0]), abs(end[1] - start[1])) < _NEAREST:
        raise FieldError("to", described(list(end)), "another place than from")
    return Gradient(base, shape, start, end, level, _ramp(parameters.get("ramp")))


def gradient_of_key(key: Sequence[object]) -> Gradient:
    """Returns the gradient whose key this is; FieldError names what is wrong."""
    base = key[1]
    if len(key) < 12 or len(key) % 2 or not isinstance(base, int):
        raise FieldError("key", described(list(key)), "[kind, base level, shape, from, to, level, ramp]")
    told = {"kind": key[2], "from": list(key[3:5]), "to": list(key[5:7]), "level": key[7]}
    ramp = [[key[n], key[n + 1]] for n in range(8, len(key), 2)]
    return replace(gradient({**told, "ramp": ramp}, base), covers=key[0] == "gradient-cover")


def _place(value: object, name: str) -> tuple[float, float]:
    pair = value if isinstance(value, list | tuple) and len(value) == 2 else ()
    if len(pair) != 2 or not all(is_number(one) and abs(one) <= 2.0**60 for one in pair):
        raise FieldError(name, described(value), "[x, y] within 2^60")
    return float(pair[0]) + 0.0, float(pair[1]) + 0.0


def _ramp(value: object) -> RampKnots:
    pairs = value if isinstance(value, list | tuple) and 2 <= len(value) <= COLOURS_CAP else ()
    out: list[tuple[float, str]] = []
    for pair in pairs:
        if not (isinstance(pair, list | tuple) and len(pair) == 2 and is_within(pair[0], 0.0, 1.0)):
            break
        if not isinstance(pair[1], str) or not _COLOUR.fullmatch(pair[1].lower()) or (out and pair[0] <= out[-1][0]):
            break
        out.append((float(pair[0]) + 0.0, pair[1].lower()))
    if not out or len(out) < len(pairs):
        raise FieldError("ramp", described(value), f'2 to {COLOURS_CAP} of [place, "#rrggbb[aa]"], rising from 0 to 1')
    return tuple(out)


def _premultiplied(colour: str) -> tuple[float, float, float, float]:
    """Returns encoded red, green and blue times alpha, and alpha, of "#rrggbb" or "#rrggbbaa"."""
    told = bytes.fromhex(colour[1:])
    red, green, blue, alpha = (*(value / 255.0 for value in told), 1.0)[:4]
    return red * alpha, green * alpha, blue * alpha, alpha


def _offsets(start: float, coarser: int, first: int, count: int) -> tuple[np.ndarray, float]:
    """Returns how far the middles of pixels lie from the start, in pixels of the gradient's level, and the width of
    one; by place alone, whatever else is asked for.  `coarser`: levels of the gradient's above that of the pixels."""
    coarser = max(-_STEEPEST, min(_STEEPEST, coarser))
    own = Fraction(start) / Fraction(2) ** coarser  # in pixels of their level
    whole = math.floor(own)
    part = float(own - whole)
    width = math.ldexp(1.0, coarser)
    off = first - whole
    if abs(off) + count < 1 << _FAR_BITS:
        return (np.arange(off, off + count) + (0.5 - part)) * width, width
    return np.array([_far(off + n, part, coarser) for n in range(count)]), width


def _far(off: int, part: float, coarser: int) -> float:
    """Returns one offset, of any size."""
    if abs(off) < 1 << _FAR_BITS:
        return (off + (0.5 - part)) * math.ldexp(1.0, coarser)
    bits = abs(off).bit_length() - _FAR_BITS
    return math.ldexp(float(off >> bits), min(bits + coarser, _STEEPEST))


def _turned(places: np.ndarray, colours: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns a ramp with the turns before and after it."""
    whole = np.concatenate([[0.0], places[(places > 0.0) & (places < 1.0)], [1.0]])
    shown = np.array([np.interp(whole, places, colours[:, c]) for c in range(colours.shape[1])]).T
    return np.concatenate([whole - 1.0, whole, whole + 1.0]), np.concatenate([shown, shown, shown])


@kernel
def _along(
    across: np.ndarray, down: np.ndarray, x: float, y: float, width: float, at: np.ndarray, half: np.ndarray
) -> None:
    reach = 0.5 * width * (abs(x) + abs(y))
    for j in range(at.shape[0]):
        for i in range(at.shape[1]):
            at[j, i] = across[i] * x + down[j] * y
            half[j, i] = reach


@kernel
def _around(across: np.ndarray, down: np.ndarray, scale: float, width: float, at: np.ndarray, half: np.ndarray) -> None:
    for j in range(at.shape[0]):
        for i in range(at.shape[1]):
            at[j, i] = math.sqrt(across[i] * across[i] + down[j] * down[j]) * scale
            half[j, i] = 0.5 * width * scale


@kernel
def _by_angle(
    across: np.ndarray, down: np.ndarray, turn: float, angle: np.ndarray, width: float, at: np.ndarray, half: np.ndarray
) -> None:
    """Parts of a turn, clockwise from `turn`, 0..1."""
    whole = 2.0 * math.pi
    for j in range(at.shape[0]):
        for i in range(at.shape[1]):
            part = (angle[j, i] - turn) / whole
            at[j, i] = part - math.floor(part)
            far = math.sqrt(across[i] * across[i] + down[j] * down[j])
            half[j, i] = min(0.5 * width / (whole * far), 0.5) if far > 0.0 else 0.5


@kernel
def _ramp_means(at: np.ndarray, half: np.ndarray, places: np.ndarray, colours: np.ndarray, out: np.ndarray) -> None:
    """Writes the mean of a ramp over at - half .. at + half: float64 (h, w) to float32 (channels, h, w).

    `places` rise; `colours` (knots, channels).  The ramp goes on past its ends as it ends there.
    """
    last = places.shape[0] - 1
    for j in range(at.shape[0]):
        for i in range(at.shape[1]):
            low, high = at[j, i] - half[j, i], at[j, i] + half[j, i]
            first = 0
            while first <= last and places[first] <= low:
                first += 1
            if first > last or places[first] >= high or high <= low:
                n = min(max(first, 1), last)
                part = min(max((at[j, i] - places[n - 1]) / (places[n] - places[n - 1]), 0.0), 1.0)
                for c in range(out.shape[0]):
                    out[c, j, i] = colours[n - 1, c] + part * (colours[n, c] - colours[n - 1, c])
                continue
            for c in range(out.shape[0]):
                total, n, left = 0.0, first, low
                while left < high:
                    right = high if n > last else min(high, places[n])
                    if right > left:
                        k = min(max(n, 1), last)
                        part = (0.5 * (left + right) - places[k - 1]) / (places[k] - places[k - 1])
                        part = min(max(part, 0.0), 1.0)
                        total += (right - left) * (colours[k - 1, c] + part * (colours[k, c] - colours[k - 1, c]))
                    left, n = right, n + 1
                out[c, j, i] = total / (high - low)
