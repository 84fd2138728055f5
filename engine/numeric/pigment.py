"""Colours as paint: mixed by absorption and scattering, so that blue and yellow make green (Kubelka & Munk 1931).

A colour's reflectance in eight bands of light is r P_r + g P_g + b P_b of its linear sRGB.  The three curves sum to 1
in each band; they are the smoothest for which the eye, the CIE's observer of 1931 (the fits of Wyman, Sloan & Shirley
2013) under daylight D65, sees the primaries of sRGB, and `_SEEN` brings bands back to linear sRGB exactly.  Of a paint
of reflectance R, K / S = (1 - R)^2 / 2R in each band.  A colour scatters the more the lighter it is, S = Y^(3/4), so
that black does not drown white; K and S of a mixture are the means of those of its parts.

So paint is a vector, K of each band and S, that mixes linearly.  Premultiplied by alpha, and followed by it, it is what
a wet brush takes up, carries and lays; mixed as light, that vector is red, green and blue as they are encoded.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from engine.numeric.elementary import powers
from engine.numeric.kernel import Array, inner

BANDS = 8
LIGHT, PIGMENT = 3, BANDS + 1  # numbers of a vector
_LEAST = 0.02  # what even the darkest paint reflects
_STEPS = 4096

_RED = (0.116, 0.0, 0.0, 0.0, 0.0, 0.0, 0.53, 1.0)
_GREEN = (0.0, 0.0, 0.292, 0.788, 1.0, 0.998, 0.406, 0.0)
_BLUE = (0.884, 1.0, 0.708, 0.212, 0.0, 0.002, 0.064, 0.0)
_SEEN = (
    (0.035369515656548, 0.031151641766576, -0.083852669603892, -0.1865937175903, -0.221819579362296,
     0.164158526894293, 0.565296055436661, 0.69629022680241),
    (-0.036364538796409, -0.056267123648078, 0.053908509907012, 0.204436409302427, 0.440991438063357,
     0.343407581363563, 0.09716901554839, -0.047281291740263),
    (0.257856044316626, 0.596325073333012, 0.239413612509798, 0.038774355398187, -0.038917118809588,
     -0.049620018538605, -0.029618398018513, -0.014213550190917),
)  # fmt: skip


@cache
def paints() -> np.ndarray:
    """Returns what kernels need to know of it, not to be written to, float64 (3, 4097): linear sRGB by its encoded form
    in steps of 1/4096, the encoded form by the root of the linear one; the curves of red, green, blue and what the
    bands are seen as."""
    at = np.arange(_STEPS + 1) / _STEPS
    out = np.zeros((3, _STEPS + 1))
    out[0] = np.where(at <= 0.04045, at / 12.92, powers((at + 0.055) / 1.055, 2.4))
    out[1] = np.where(at * at <= 0.0031308, 12.92 * (at * at), 1.055 * powers(at * at, 1.0 / 2.4) - 0.055)
    out[2, : 6 * BANDS] = np.array((_RED, _GREEN, _BLUE, *_SEEN)).ravel()
    out.flags.writeable = False
    return out


@inner
def _between(row: Array, value: float) -> float:
    at = min(max(value, 0.0), 1.0) * _STEPS
    i = min(int(at), _STEPS - 1)
    return row[i] + (row[i + 1] - row[i]) * (at - i)  # type: ignore[no-any-return]


@inner
def to_paint(red: float, green: float, blue: float, told: Array, into: Array) -> None:
    """Writes encoded sRGB as a vector: of light where `into` has 3 numbers, of pigment where it has 9."""
    if into.shape[0] == LIGHT:
        into[0], into[1], into[2] = red, green, blue
        return
    r, g, b = _between(told[0], red), _between(told[0], green), _between(told[0], blue)
    y = _LEAST + (1.0 - _LEAST) * (0.2126 * r + 0.7152 * g + 0.0722 * b)
    root = np.sqrt(y)
    scatter = root * np.sqrt(root)
    for k in range(BANDS):
        curves = told[2]
        seen = r * curves[k] + g * curves[BANDS + k] + b * curves[2 * BANDS + k]
        seen = _LEAST + (1.0 - _LEAST) * seen
        into[k] = scatter * ((1.0 - seen) * (1.0 - seen) / (2.0 * seen))
    into[BANDS] = scatter


@inner
def from_paint(vector: Array, told: Array) -> tuple[float, float, float]:
    """The encoded sRGB of a vector, which may be multiplied by anything above 0 if it is of pigment."""
    if vector.shape[0] == LIGHT:
        return vector[0], vector[1], vector[2]
    r, g, b = 0.0, 0.0, 0.0
    for k in range(BANDS):
        ratio = vector[k] / vector[BANDS]
        seen = (1.0 + ratio - np.sqrt(ratio * ratio + 2.0 * ratio) - _LEAST) / (1.0 - _LEAST)
        curves = told[2]
        r += seen * curves[3 * BANDS + k]
        g += seen * curves[4 * BANDS + k]
        b += seen * curves[5 * BANDS + k]
    return (
        _between(told[1], np.sqrt(max(r, 0.0))),
        _between(told[1], np.sqrt(max(g, 0.0))),
        _between(told[1], np.sqrt(max(b, 0.0))),
    )
