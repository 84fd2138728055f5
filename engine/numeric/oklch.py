"""Colours by lightness, chroma and hue: OkLCH after Ottosson 2020, "A perceptual color space for image processing".

By elementary functions of our own: the same bits on every machine.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.elementary import cos, power, sin
from engine.numeric.kernel import Array, inner, kernel
from engine.numeric.stand_in import or_interpreted

Encoded = tuple[float, float, float]
_DEGREE = 0.017453292519943295


def lab_of(rgb: Encoded) -> np.ndarray:
    """Returns lightness, 0..1, and the two axes of colour of encoded sRGB: float64 (3,)."""
    r, g, b = (v / 12.92 if v <= 0.04045 else power((v + 0.055) / 1.055, 2.4) for v in rgb)
    long = power(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b, 1 / 3)
    mid = power(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b, 1 / 3)
    short = power(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b, 1 / 3)
    return np.array(
        (
            0.2104542553 * long + 0.7936177850 * mid - 0.0040720468 * short,
            1.9779984951 * long - 2.4285922050 * mid + 0.4505937099 * short,
            0.0259040371 * long + 0.7827717662 * mid - 0.8086757660 * short,
        )
    )


@inner
def _channel(v: float) -> float:
    v = 12.92 * v if v <= 0.0031308 else 1.055 * power(v, 1.0 / 2.4) - 0.055
    return min(max(v, 0.0), 1.0)


@or_interpreted()
@kernel
def shift_colours(rows: Array, lab: Array) -> None:
    """Turns rows, float64 (n, 3), of a turn of the hue in degrees and factors of lightness and chroma into what these
    make of a colour, `lab` of `lab_of`: encoded sRGB, each channel held to 0..1."""
    for i in range(rows.shape[0]):
        turn, lighter, stronger = rows[i, 0] * _DEGREE, rows[i, 1], rows[i, 2]
        lightness, c, s = min(max(lab[0] * lighter, 0.0), 1.0), cos(turn) * stronger, sin(turn) * stronger
        a, b = c * lab[1] - s * lab[2], s * lab[1] + c * lab[2]
        long = lightness + 0.3963377774 * a + 0.2158037573 * b
        mid = lightness - 0.1055613458 * a - 0.0638541728 * b
        short = lightness - 0.0894841775 * a - 1.2914855480 * b
        long, mid, short = long * long * long, mid * mid * mid, short * short * short
        rows[i, 0] = _channel(4.0767416621 * long - 3.3077115913 * mid + 0.2309699292 * short)
        rows[i, 1] = _channel(-1.2684380046 * long + 2.6097574011 * mid - 0.3413193965 * short)
        rows[i, 2] = _channel(-0.0041960863 * long - 0.7034186147 * mid + 1.7076147010 * short)
