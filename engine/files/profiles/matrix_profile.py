"""Pictures whose profile is three curves and a matrix (ICC.1:2010, 8.3.3): their colours as sRGB, of 8 or 16 bits.

Every step is arithmetic of our own, in a fixed order, so that the same picture gives the same colours everywhere.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.files.fault import FileError
from engine.files.profiles.icc_profile import Profile
from engine.numeric.elementary import powers

_ROWS = 1 << 18  # pixels that are converted at a time
# sRGB's primaries as columns, adapted to D50 as profiles are (IEC 61966-2-1, and Bradford's adaptation).
_SRGB = (
    (0.43606567, 0.38514709, 0.14306641),
    (0.22248840, 0.71687317, 0.06060791),
    (0.01391602, 0.09707642, 0.71409607),
)
_LEAST, _MOST_POWER = 0.05, 20.0
_PARAMETERS = {0: 1, 1: 3, 2: 4, 3: 5, 4: 7}  # of the kinds of parametric curves (10.16)
Matrix = tuple[tuple[float, ...], ...]


def matrix_conversion(profile: Profile) -> Callable[[np.ndarray], np.ndarray]:
    """Returns what makes sRGB of pixels, uint8 or uint16 (n, w, 4) with alpha last; FileError where the profile has
    not what that takes."""
    matrix = _product(_inverse(_SRGB), _columns(profile))
    curves = [_curve(profile, tag) for tag in (b"rTRC", b"gTRC", b"bTRC")]
    made: dict[int, tuple[list[np.ndarray], np.ndarray]] = {}

    def convert(pixels: np.ndarray) -> np.ndarray:
        top = 255 if pixels.dtype == np.uint8 else 65535
        if top not in made:
            places = np.arange(top + 1, dtype=np.float64) / top
            borders = (np.arange(top, dtype=np.float64) + 0.5) / top
            made[top] = [curve(places) for curve in curves], _decoded(borders)
        linear, borders = made[top]
        out = pixels.copy()
        flat, given = out.reshape(-1, 4), pixels.reshape(-1, 4)
        for start in range(0, len(flat), _ROWS):
            part = given[start : start + _ROWS]
            r, g, b = (linear[i][part[:, i]] for i in range(3))
            for i, (x, y, z) in enumerate(matrix):
                light = x * r + y * g + z * b
                flat[start : start + _ROWS, i] = np.searchsorted(borders, light, side="right")
        return out

    return convert


def _decoded(encoded: np.ndarray) -> np.ndarray:
    """Returns the light of sRGB's values, 0..1."""
    return np.where(encoded <= 0.04045, encoded / 12.92, powers((encoded + 0.055) / 1.055, 2.4))


def _columns(profile: Profile) -> Matrix:
    columns = []
    for name in (b"rXYZ", b"gXYZ", b"bXYZ"):
        tag = profile.tag(name)
        tag.raw(8, "a primary")
        columns.append([number / 65536 for number in map(int, tag.take("3i", "a primary"))])
    return tuple(zip(*columns, strict=True))


def _product(a: Matrix, b: Matrix) -> Matrix:
    return tuple(tuple(a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] for j in range(3)) for i in range(3))


def _inverse(m: Matrix) -> Matrix:
    def minor(i: int, j: int) -> float:
        k, n, p, q = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
        return m[k][p] * m[n][q] - m[k][q] * m[n][p]

    whole = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2)
    return tuple(tuple(minor(j, i) / whole for j in range(3)) for i in range(3))


def _curve(profile: Profile, name: bytes) -> Callable[[np.ndarray], np.ndarray]:
    """Returns a curve from values, 0..1 and rising, to light, 0..1."""
    tag = profile.tag(name)
    kind = tag.raw(8, "a curve")[:4]
    if kind == b"curv":
        count = tag.number("I", "a curve")
        if count == 0:
            return lambda x: x
        if count == 1:
            exponent = _checked(tag.number("H", "a curve") / 256, profile)
            return lambda x: powers(x, exponent)
        return _sampled(np.frombuffer(tag.raw(2 * count, "a curve"), ">u2") / 65535.0)
    if kind != b"para":
        raise FileError(profile.file, f"tag {name.decode()}: found a curve of kind {kind!a}, expected 'curv' or 'para'")
    form = tag.number("H", "a curve")
    tag.raw(2, "a curve")
    if form not in _PARAMETERS:
        raise FileError(profile.file, f"tag {name.decode()}: found a curve of form {form}, expected 0 to 4")
    return _parametric(form, [int(v) / 65536 for v in tag.take(f"{_PARAMETERS[form]}i", "a curve")], profile)


def _checked(exponent: float, profile: Profile) -> float:
    if not _LEAST <= exponent <= _MOST_POWER:
        raise FileError(profile.file, f"found a curve of power {exponent:g}, expected {_LEAST:g} to {_MOST_POWER:g}")
    return exponent


def _sampled(table: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    def light(x: np.ndarray) -> np.ndarray:
        at = x * (len(table) - 1)
        low = np.minimum(at.astype(np.intp), len(table) - 2)
        return np.asarray(table[low] + (at - low) * (table[low + 1] - table[low]))

    return light


def _parametric(form: int, told: list[float], profile: Profile) -> Callable[[np.ndarray], np.ndarray]:
    exponent = _checked(told[0], profile)
    a, b, c, d, e, f = (*told[1:], *(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)[len(told) - 1 :])
    if form in (1, 2):  # below -b / a there is c alone
        e = f = c
        c, d = 0.0, (-b / a if a else 0.0)
        e, f = (0.0, 0.0) if form == 1 else (e, f)

    def light(x: np.ndarray) -> np.ndarray:
        curved = powers(np.clip(a * x + b, 0.0, 4.0), exponent) + e
        found: np.ndarray = np.where(x >= d, curved, c * x + f) if form else curved
        return np.asarray(np.clip(found, 0.0, 1.0))

    return light
