"""How far out the poles of a two-dimensional all-pole filter lie, which tells whether it is stable.

Ekstrom & Woods 1976, "Two-dimensional spectral factorization": along its own row such a filter must be stable, and down
the rows for every frequency across.  In arithmetic 1 the poles are eigenvalues of companion matrices.  In arithmetic 2
Schur's and Cohn's recursion tells whether all lie within a circle, and the circle is narrowed down by halves, to
_CLOSE: what is foretold hangs on the answer, which is the same on every processor.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.kernel import inner, kernel

_FREQUENCIES = 128  # across half a turn, at which the poles are looked for
_LEAST = 1e-9  # of what a row of the filter is divided by
_CLOSE = 2.0**-32  # of the radius that is found


def pole_radius(reach: int, offsets: np.ndarray, taps: np.ndarray, arithmetic: int = LIBRARY) -> float:
    """Tells how far out the outermost pole lies; the filter is stable if that is less than 1.

    `offsets` int64 (n, 2), (dy, dx) before (0, 0) in raster order, at most `reach` rows and columns away; `taps`
    float64 (n,): v(p) = sum of taps_k v(p + offset_k).
    """
    table = np.zeros((reach + 1, 2 * reach + 1))  # [-dy, dx + reach]
    table[-offsets[:, 0], offsets[:, 1] + reach] = taps
    angles = np.pi * np.arange(_FREQUENCIES + 1) / _FREQUENCIES
    if arithmetic == LIBRARY:
        along = _outermost(table[0, reach - 1 :: -1][None].astype(complex))
        waves = np.exp(1j * angles[:, None] * np.arange(-reach, reach + 1))
        rows = (waves[:, None, :] * table).sum(axis=2)  # (frequencies, reach + 1)
        lead = 1.0 - rows[:, :1]
        return max(along, _outermost(rows[:, 1:] / np.where(np.abs(lead) > _LEAST, lead, _LEAST)))
    waves = array_functions(arithmetic).waves(angles[:, None] * np.arange(-reach, reach + 1))
    return float(_within(table, waves.real.copy(), waves.imag.copy()))


def _outermost(taps: np.ndarray) -> float:
    """Returns the largest |z| with z^n = sum of taps_k z^(n - k), over rows of complex (m, n)."""
    n = taps.shape[1]
    companion = np.zeros((len(taps), n, n), complex)
    companion[:, 0] = taps
    companion[:, np.arange(1, n), np.arange(n - 1)] = 1.0
    return float(np.abs(np.linalg.eigvals(companion)).max())


@kernel
def _within(table: np.ndarray, cosines: np.ndarray, sines: np.ndarray) -> float:
    """Returns the radius of the circle around all poles of a filter, `table` (n + 1, 2n + 1), whose rows are looked at
    for waves (frequencies, 2n + 1)."""
    n = table.shape[0] - 1
    real, imaginary = np.zeros(n + 1), np.zeros(n + 1)
    for k in range(1, n + 1):
        real[k] = table[0, n - k]
    radius = _widened(real, imaginary, 0.0)
    for f in range(cosines.shape[0]):
        for k in range(n + 1):
            real[k] = imaginary[k] = 0.0
            for i in range(2 * n + 1):
                real[k] += table[k, i] * cosines[f, i]
                imaginary[k] += table[k, i] * sines[f, i]
        a, b = 1.0 - real[0], -imaginary[0]
        size = a * a + b * b
        if not size > _LEAST * _LEAST:
            a, b, size = _LEAST, 0.0, _LEAST * _LEAST
        for k in range(1, n + 1):
            x, y = real[k], imaginary[k]
            real[k], imaginary[k] = (x * a + y * b) / size, (y * a - x * b) / size
        radius = _widened(real, imaginary, radius)
    return radius


@inner
def _widened(real: np.ndarray, imaginary: np.ndarray, radius: float) -> float:
    """Returns the radius, or that of the circle around all z with z^n = sum of taps_k z^(n - k), k = 1, ..., n, if that
    is larger; taps in two parts, the first of which is not looked at."""
    if _all_inside(real, imaginary, radius):
        return radius
    most = 1.0  # Cauchy's bound
    for k in range(1, real.size):
        most += abs(real[k]) + abs(imaginary[k])
    least = radius
    while most - least > _CLOSE * most:
        between = 0.5 * (least + most)
        if _all_inside(real, imaginary, between):
            most = between
        else:
            least = between
    return most


@inner
def _all_inside(real: np.ndarray, imaginary: np.ndarray, radius: float) -> bool:
    """Tells whether all such z lie within a circle (Schur 1917, Cohn 1922): whether each of the polynomials in
    z / radius to which the recursion leads has a last coefficient smaller than its first."""
    n = real.size - 1
    a, b = np.zeros(n + 1), np.zeros(n + 1)
    a[0], scale = 1.0, 1.0
    for k in range(1, n + 1):
        if radius > 0.0:
            scale /= radius
            a[k], b[k] = -real[k] * scale, -imaginary[k] * scale
        elif real[k] != 0.0 or imaginary[k] != 0.0:
            return False
    for m in range(n, 0, -1):
        p, q = a[m], b[m]  # the first coefficient is 1
        left = 1.0 - (p * p + q * q)
        if not left > 0.0:
            return False
        for k in range((m + 1) // 2 + 1):  # the k-th, less the last times the conjugate of the one as far from the end
            j = m - k
            if j < k:
                break
            x, y, u, v = a[k], b[k], a[j], b[j]
            a[k], b[k] = (x - (p * u + q * v)) / left, (y - (q * u - p * v)) / left
            a[j], b[j] = (u - (p * x + q * y)) / left, (v - (q * x - p * y)) / left
    return True
