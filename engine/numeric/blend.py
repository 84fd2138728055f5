"""The 20 composite operators of OpenRaster on premultiplied, sRGB-encoded planes.

W3C, "Compositing and Blending Level 1", sections 5.8 (simple alpha compositing), 9.1 (Porter-Duff), 10.1 (separable)
and 10.2 (non-separable blend modes); `plus` is that document's `lighter`.  With premultiplied source s, backdrop b,
their alphas sa, ba and the blend function B of the straight colours, a blend mode gives

    alpha = sa + ba (1 - sa)        colour = (1 - ba) s + (1 - sa) b + sa ba B(b / ba, s / sa)

Every kernel here works with M = sa ba B directly: most modes then need no division, and none divides by alpha in a
way that loses digits.  The layer's opacity o multiplies alpha and colour of the source, and B never sees it:

    colour = o s + (1 - o sa) b + o (M - ba s)

Kernels take C-contiguous float32 `backdrop` (4, n), changed in place, and `source` (4, n), and a float32 opacity.  The
source is clamped as for display (0 <= alpha <= 1, 0 <= colour <= alpha; NaN counts as 0); the backdrop must obey
that already, and does so afterwards.  A pixel's result depends on that pixel alone, bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.numeric.kernel import Array, dividing, forced, kernel
from engine.numeric.stand_in import or_plain

ZERO, HALF, ONE, TWO, TINY = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2), np.float32(1e-30)
_FLOAT32 = np.dtype(np.float32)
# Colour burn jumps where the backdrop is white, colour dodge where it is black.  A backdrop that was composited is
# white or black up to rounding; sixteen steps finer than the grid counts as equal.
NEAR = np.float32(2.0**-20)

Kernel = Callable[[np.ndarray, np.ndarray, np.float32], None]
F32 = np.float32
RGB = tuple[F32, F32, F32]
Channel = Callable[[F32, F32, F32, F32], F32]  # backdrop, source, each with alpha
Colour = Callable[[F32, F32, F32, F32, F32, F32, F32, F32], RGB]


@forced
def _clamp(value: F32, top: F32) -> F32:
    value = value if value > ZERO else ZERO  # in this order NaN becomes 0
    return value if value < top else top


def clamped(values: np.ndarray, top: np.ndarray | F32) -> np.ndarray:
    """`_clamp` of all values."""
    values = np.where(values > ZERO, values, ZERO)
    return np.where(values < top, values, top)


@forced
def _least(x: F32, y: F32) -> F32:
    return x if x < y else y


@forced
def _most(x: F32, y: F32) -> F32:
    return x if x > y else y


# --- separable blend modes: M for one channel ------------------------------------------------------------------------


@forced
def _multiply(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return s * b


@forced
def _screen(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return b * sa + s * ba - s * b


@forced
def _hard_light(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return TWO * s * b if TWO * s <= sa else sa * ba - TWO * (ba - b) * (sa - s)


@forced
def _overlay(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return TWO * s * b if TWO * b <= ba else sa * ba - TWO * (ba - b) * (sa - s)


@forced
def _darken(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return _least(b * sa, s * ba)


@forced
def _lighten(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return _most(b * sa, s * ba)


@forced
def _color_dodge(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    bright = sa * _least(ba, b * sa / _most(sa - s, TINY))
    return bright if b > NEAR else ZERO


@forced
def _color_burn(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    dark = sa * (ba - _least(ba, (ba - b) * sa / _most(s, TINY)))
    return dark if ba - b > NEAR else sa * ba


@forced
def _soft_light(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    cb = _least(b / _most(ba, TINY), ONE)
    low = ((np.float32(16) * cb - np.float32(12)) * cb + np.float32(4)) * cb
    d = low if cb <= np.float32(0.25) else np.sqrt(cb)
    slope = cb * (ONE - cb) if TWO * s <= sa else d - cb
    return sa * b + (TWO * s - sa) * ba * slope


@forced
def _difference(b: F32, ba: F32, s: F32, sa: F32) -> F32:
    return abs(b * sa - s * ba)


def _separable(mix: Channel) -> Kernel:
    @dividing
    def kernel(backdrop: np.ndarray, source: np.ndarray, opacity: np.float32) -> None:
        for i in range(backdrop.shape[1]):
            sa = _clamp(source[3, i], ONE)
            ba = backdrop[3, i]
            keep = ONE - opacity * sa
            alpha = opacity * sa + keep * ba
            for c in range(3):
                s = _clamp(source[c, i], sa)
                b = backdrop[c, i]
                over = opacity * s + keep * b
                backdrop[c, i] = _clamp(over + opacity * (mix(b, ba, s, sa) - ba * s), alpha)
            backdrop[3, i] = alpha

    out: Kernel = kernel
    return out


# --- non-separable blend modes: M for three channels, x = backdrop, y = source ---------------------------------------


@forced
def _lum(r: F32, g: F32, b: F32) -> F32:
    return np.float32(0.3) * r + np.float32(0.59) * g + np.float32(0.11) * b


@forced
def _set_lum(r: F32, g: F32, b: F32, light: F32, top: F32) -> RGB:
    """SetLum with ClipColor, for colours in 0..top instead of 0..1 (both are homogeneous)."""
    shift = light - _lum(r, g, b)
    r, g, b = r + shift, g + shift, b + shift
    low = _least(r, _least(g, b))
    high = _most(r, _most(g, b))
    up = light / _most(light - low, TINY) if low < ZERO else ONE
    down = (top - light) / _most(high - light, TINY) if high > top else ONE
    scale = _clamp(up, ONE) * _clamp(down, ONE)
    return light + (r - light) * scale, light + (g - light) * scale, light + (b - light) * scale


@forced
def _sat(r: F32, g: F32, b: F32) -> F32:
    return _most(r, _most(g, b)) - _least(r, _least(g, b))


@forced
def _set_sat(r: F32, g: F32, b: F32, sat: F32) -> RGB:
    """SetSat; depends on ratios of differences only, so it is given unscaled colours, whose differences are exact."""
    low = _least(r, _least(g, b))
    scale = sat / _most(_sat(r, g, b), TINY)
    return (r - low) * scale, (g - low) * scale, (b - low) * scale


@forced
def _hue(x0: F32, x1: F32, x2: F32, ba: F32, y0: F32, y1: F32, y2: F32, sa: F32) -> RGB:
    r, g, b = _set_sat(y0, y1, y2, _sat(x0, x1, x2) * sa)
    return _set_lum(r, g, b, _lum(x0, x1, x2) * sa, sa * ba)


@forced
def _saturation(x0: F32, x1: F32, x2: F32, ba: F32, y0: F32, y1: F32, y2: F32, sa: F32) -> RGB:
    r, g, b = _set_sat(x0, x1, x2, _sat(y0, y1, y2) * ba)
    return _set_lum(r, g, b, _lum(x0, x1, x2) * sa, sa * ba)


@forced
def _color(x0: F32, x1: F32, x2: F32, ba: F32, y0: F32, y1: F32, y2: F32, sa: F32) -> RGB:
    return _set_lum(y0 * ba, y1 * ba, y2 * ba, _lum(x0, x1, x2) * sa, sa * ba)


@forced
def _luminosity(x0: F32, x1: F32, x2: F32, ba: F32, y0: F32, y1: F32, y2: F32, sa: F32) -> RGB:
    return _set_lum(x0 * sa, x1 * sa, x2 * sa, _lum(y0, y1, y2) * ba, sa * ba)


def _inseparable(mix: Colour) -> Kernel:
    @dividing
    def kernel(backdrop: np.ndarray, source: np.ndarray, opacity: np.float32) -> None:
        for i in range(backdrop.shape[1]):
            sa = _clamp(source[3, i], ONE)
            y0, y1, y2 = _clamp(source[0, i], sa), _clamp(source[1, i], sa), _clamp(source[2, i], sa)
            x0, x1, x2, ba = backdrop[0, i], backdrop[1, i], backdrop[2, i], backdrop[3, i]
            m0, m1, m2 = mix(x0, x1, x2, ba, y0, y1, y2, sa)
            keep = ONE - opacity * sa
            alpha = opacity * sa + keep * ba
            backdrop[0, i] = _clamp(opacity * y0 + keep * x0 + opacity * (m0 - ba * y0), alpha)
            backdrop[1, i] = _clamp(opacity * y1 + keep * x1 + opacity * (m1 - ba * y1), alpha)
            backdrop[2, i] = _clamp(opacity * y2 + keep * x2 + opacity * (m2 - ba * y2), alpha)
            backdrop[3, i] = alpha

    out: Kernel = kernel
    return out


# --- Porter-Duff operators: the shares (Fa, Fb) of source and backdrop -----------------------------------------------


@forced
def _src_over(sa: F32, ba: F32) -> tuple[F32, F32]:
    return ONE, ONE - sa


@forced
def _dst_in(sa: F32, ba: F32) -> tuple[F32, F32]:
    return ZERO, sa


@forced
def _dst_out(sa: F32, ba: F32) -> tuple[F32, F32]:
    return ZERO, ONE - sa


@forced
def _src_atop(sa: F32, ba: F32) -> tuple[F32, F32]:
    return ba, ONE - sa


@forced
def _dst_atop(sa: F32, ba: F32) -> tuple[F32, F32]:
    return ONE - ba, sa


@forced
def _plus(sa: F32, ba: F32) -> tuple[F32, F32]:
    return ONE, ONE


def _porter_duff(shares: Callable[[F32, F32], tuple[F32, F32]]) -> Kernel:
    """fl(x y) and fl(x + y) are monotone, so colour <= alpha needs no clamp; only `plus` passes 1."""

    @dividing
    def kernel(backdrop: np.ndarray, source: np.ndarray, opacity: np.float32) -> None:
        for i in range(backdrop.shape[1]):
            sa = _clamp(source[3, i], ONE)
            ba = backdrop[3, i]
            fa, fb = shares(opacity * sa, ba)
            for c in range(3):
                s = opacity * _clamp(source[c, i], sa)
                backdrop[c, i] = _least(fa * s + fb * backdrop[c, i], ONE)
            backdrop[3, i] = _least(fa * (opacity * sa) + fb * ba, ONE)

    out: Kernel = kernel
    return out


# --- the table -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Blend:
    """One composite operator.

    `op`: its name in OpenRaster files.  `outside`: it also changes the backdrop where the source is empty (it clears
    it), so an empty source cannot be skipped.  `alone`: it shows the source where the backdrop is empty, unchanged
    in every such mode; the others leave nothing there.
    """

    name: str
    label: str
    tooltip: str
    kernel: Kernel
    outside: bool = False
    alone: bool = True

    @property
    def op(self) -> str:
        """Gives the mode's name as OpenRaster writes it."""
        return "svg:" + self.name


_ROWS = (
    Blend("src-over", "Normal", "Lays the layer over what is below", _porter_duff(_src_over)),
    Blend("multiply", "Multiply", "Darkens like ink on paper or stacked slides", _separable(_multiply)),
    Blend("screen", "Screen", "Lightens like two projectors on one wall", _separable(_screen)),
    Blend("overlay", "Overlay", "Multiplies over darks, screens over lights", _separable(_overlay)),
    Blend("darken", "Darken", "Keeps the darker value of each channel", _separable(_darken)),
    Blend("lighten", "Lighten", "Keeps the lighter value of each channel", _separable(_lighten)),
    Blend("color-dodge", "Colour dodge", "Brightens, most of all under light paint", _separable(_color_dodge)),
    Blend("color-burn", "Colour burn", "Darkens, most of all under dark paint", _separable(_color_burn)),
    Blend("hard-light", "Hard light", "Multiplies under darks, screens under lights", _separable(_hard_light)),
    Blend("soft-light", "Soft light", "Darkens or lightens gently, like a diffuse lamp", _separable(_soft_light)),
    Blend("difference", "Difference", "Shows how far both differ; white inverts", _separable(_difference)),
    Blend("color", "Colour", "Hue and saturation of the layer, lightness of what is below", _inseparable(_color)),
    Blend("luminosity", "Luminosity", "Lightness of the layer, colour of what is below", _inseparable(_luminosity)),
    Blend("hue", "Hue", "Hue of the layer, saturation and lightness of what is below", _inseparable(_hue)),
    Blend("saturation", "Saturation", "Saturation of the layer, the rest from below", _inseparable(_saturation)),
    Blend("plus", "Add", "Adds both, as light adds up", _porter_duff(_plus)),
    Blend("dst-in", "Mask", "Keeps what is below only where the layer is", _porter_duff(_dst_in), True, False),
    Blend("dst-out", "Erase", "Erases what is below where the layer is", _porter_duff(_dst_out), False, False),
    Blend("src-atop", "Clip", "Shows the layer only where something is below", _porter_duff(_src_atop), False, False),
    Blend("dst-atop", "Backfill", "Keeps what is below on the layer's shape", _porter_duff(_dst_atop), True),
)
BLENDS: dict[str, Blend] = {row.name: row for row in _ROWS}


def _place(target: np.ndarray, source: np.ndarray, opacity: F32) -> None:
    """As `place`, plainly."""
    alpha = clamped(source[3], ONE)
    target[:3], target[3] = opacity * clamped(source[:3], alpha), opacity * alpha


@or_plain(_place)
@kernel
def place(target: np.ndarray, source: np.ndarray, opacity: F32) -> None:
    """Write `opacity` times the clamped source: what every mode with `alone` gives on an empty backdrop."""
    for i in range(target.shape[1]):
        sa = _clamp(source[3, i], ONE)
        for c in range(3):
            target[c, i] = opacity * _clamp(source[c, i], sa)
        target[3, i] = opacity * sa


@kernel
def place_pair(target: Array, lower: Array, upper: Array, lower_opacity: F32, upper_opacity: F32) -> None:
    """`place` of one source, then `src-over` of another, with the same bits, in one pass over memory."""
    for i in range(target.shape[1]):
        la, ua = _clamp(lower[3, i], ONE), _clamp(upper[3, i], ONE)
        keep = ONE - upper_opacity * ua
        for c in range(3):
            below = lower_opacity * _clamp(lower[c, i], la)
            target[c, i] = upper_opacity * _clamp(upper[c, i], ua) + keep * below
        target[3, i] = upper_opacity * ua + keep * (lower_opacity * la)


@kernel
def over_pair(backdrop: Array, lower: Array, upper: Array, lower_opacity: F32, upper_opacity: F32) -> None:
    """`src-over` of two sources, one after the other, with the same bits, in one pass over memory."""
    for i in range(backdrop.shape[1]):
        la, ua = _clamp(lower[3, i], ONE), _clamp(upper[3, i], ONE)
        bare, keep = ONE - lower_opacity * la, ONE - upper_opacity * ua
        for c in range(3):
            below = lower_opacity * _clamp(lower[c, i], la) + bare * backdrop[c, i]
            backdrop[c, i] = upper_opacity * _clamp(upper[c, i], ua) + keep * below
        backdrop[3, i] = upper_opacity * ua + keep * (lower_opacity * la + bare * backdrop[3, i])


@kernel
def opaque(source: np.ndarray) -> bool:
    """Tells whether alpha is at least 1 everywhere in (4, n); stops in the first run of 1024 pixels where it is not."""
    n = source.shape[1]
    for start in range(0, n, 1024):
        stop = min(start + 1024, n)
        run = source[3, start:stop]
        full = 0
        for i in range(run.size):
            full += run[i] >= ONE
        if full < stop - start:
            return False
    return True


def flat(planes: np.ndarray) -> np.ndarray:
    """(4, h, w) as the read-only C-contiguous (4, n) of the kernels; copied only if the memory is laid out otherwise.

    Always read-only, so that each kernel is compiled for one type.
    """
    rows = planes.reshape(4, -1)
    flags = rows.flags
    if not flags.c_contiguous or rows.dtype is not _FLOAT32:
        rows = np.array(rows, np.float32, order="C")
        flags = rows.flags
    if flags.writeable:
        flags.writeable = False
    return rows


def blend(op: str, backdrop: np.ndarray, source: np.ndarray, opacity: float = 1.0) -> None:
    """Composite `source` onto `backdrop`, in place; both float32 (4, h, w), the backdrop C-contiguous.

    ValueError: the operator is unknown, the shapes differ, or the backdrop is of another type or layout.
    """
    if op not in BLENDS:
        raise ValueError(f"blend: found {op!r}, expected one of {', '.join(BLENDS)}")
    if backdrop.shape != source.shape or backdrop.ndim != 3 or len(backdrop) != 4:
        raise ValueError(f"blend: found shapes {backdrop.shape} and {source.shape}, expected (4, h, w) twice")
    if backdrop.dtype != np.float32 or not backdrop.flags.c_contiguous:
        raise ValueError(f"blend: found a {backdrop.dtype} backdrop, expected C-contiguous float32")
    BLENDS[op].kernel(backdrop.reshape(4, -1), flat(source), np.float32(opacity))
