"""Autocorrelations of periodic pictures, read off their power spectra, and filters that give them others.

Only small lags count, so no transform is made: a spectrum's power times a few waves.  Half spectra are those of
`real_fourier`: complex64 (n, h, w//2 + 1).  Lags are (n, 2l + 1, 2l + 1), the middle one being 0, for a pixel.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from engine.numeric import elementary
from engine.numeric.kernel import Array, kernel
from engine.numeric.matrices import combinations, products
from engine.numeric.solving import solved

_FIRM = 1e-4  # of the variance: what keeps the equations of a filter from having no solution
_LEAST, _MOST = 0.04, 25.0  # of a filter's power


def lags_of(half: np.ndarray, width: int, reach: int) -> np.ndarray:
    """Returns the autocorrelations of pictures, `width` wide, up to so many pixels: float64."""
    count, height, columns = half.shape
    across, _ = _waves(width, reach)
    down, _ = _waves(height, reach)
    wide = -(-columns // 8) * 8
    counted = np.zeros((len(across), wide), np.float32)
    counted[:, :columns] = across[:, :columns] * np.float32(2.0)
    counted[:, 0] *= np.float32(0.5)
    if width % 2 == 0:
        counted[:, columns - 1] *= np.float32(0.5)
    power = np.zeros((count * height, wide), np.float32)
    _power(np.ascontiguousarray(half).view(np.float32), power.reshape(count, height, wide))
    rows = products(power, counted).reshape(count, height, 2 * reach + 1)
    return _of_rows(rows, down.astype(np.float64), reach) / float(height * width) ** 2


def apply_filter(half: np.ndarray, width: int, now: np.ndarray, want: np.ndarray) -> None:
    """Multiplies half spectra by filters without phase that give what has the lags `now` the lags `want`; `now` reaches
    at least as far, and what it should for a filter that is quite right is twice as far."""
    reach, height = want.shape[1] // 2, half.shape[1]
    power = _responses(now, want)
    across, down = (_waves(n, reach)[0] for n in (width, height))
    columns = half.shape[2]
    floats = half.view(np.float32)
    for n in range(len(half)):
        rows = _by_rows(power[n], down, reach)
        _multiply(floats[n], combinations(rows, np.ascontiguousarray(across[:, :columns])))


def shortened(lags: np.ndarray, reach: int) -> np.ndarray:
    """Returns the same lags up to a shorter reach."""
    cut = lags.shape[-1] // 2 - reach
    return lags[..., cut : lags.shape[-2] - cut, cut : lags.shape[-1] - cut]


@lru_cache(maxsize=64)
def _waves(n: int, reach: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the cosines of 0 to `reach` turns along n places, and the sines of 1 to `reach`: (2 reach + 1, n),
    float32, and as float64."""
    turns = np.arange(reach + 1)[:, None] * np.arange(n)[None] % n * (2.0 * np.pi / n)
    cosines, sines = (elementary.mapped(wave, turns) for wave in (elementary.cos, elementary.sin))
    both = np.concatenate([cosines, sines[1:]])
    single = both.astype(np.float32)
    for made in (single, both):
        made.flags.writeable = False
    return single, both


@kernel
def _power(half: Array, out: Array) -> None:
    """out (n, h, >= c) = the power of pairs (n, h, 2c)."""
    for n in range(half.shape[0]):
        for y in range(half.shape[1]):
            line, into = half[n, y], out[n, y]
            for x in range(line.size // 2):
                into[x] = line[2 * x] * line[2 * x] + line[2 * x + 1] * line[2 * x + 1]


@kernel
def _of_rows(rows: Array, down: Array, reach: int) -> Array:
    """Returns lags (n, 2l + 1, 2l + 1) of rows (n, h, 2l + 1) that were multiplied by the waves across."""
    out = np.zeros((rows.shape[0], 2 * reach + 1, 2 * reach + 1))
    for n in range(rows.shape[0]):
        for dy in range(reach + 1):
            for dx in range(reach + 1):
                even, odd = 0.0, 0.0
                for y in range(rows.shape[1]):
                    even += rows[n, y, dx] * down[dy, y]
                    if dy > 0 and dx > 0:
                        odd += rows[n, y, reach + dx] * down[reach + dy, y]
                out[n, reach + dy, reach + dx] = out[n, reach - dy, reach - dx] = even - odd
                out[n, reach + dy, reach - dx] = out[n, reach - dy, reach + dx] = even + odd
    return out


def _responses(now: np.ndarray, want: np.ndarray) -> np.ndarray:
    """Returns the lags of the filters' power (n, 2l + 1, 2l + 1): the equations say that `now`, spread by them, is
    `want`."""
    reach, far = want.shape[1] // 2, now.shape[1] // 2
    one, apart, together = _places(reach)
    there = (np.abs(apart) <= far).all(axis=-1), (np.abs(together) <= far).all(axis=-1)
    inner, outer = (np.clip(where, -far, far) + far for where in (apart, together))
    twice = (one != 0).any(axis=1)
    matrices = now[:, inner[..., 0], inner[..., 1]] * there[0]
    matrices += now[:, outer[..., 0], outer[..., 1]] * (there[1] & twice)
    matrices += (_FIRM * np.maximum(now[:, far, far], 1e-20))[:, None, None] * np.eye(len(one))
    found = solved(matrices, want[:, one[:, 0] + reach, one[:, 1] + reach][..., None])[..., 0]
    out = np.empty(want.shape)
    out[:, reach + one[:, 0], reach + one[:, 1]] = out[:, reach - one[:, 0], reach - one[:, 1]] = found
    return out


@lru_cache(maxsize=16)
def _places(reach: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns the lags of one half, (m, 2), and how far each two are apart and together: (m, m, 2)."""
    steps = range(-reach, reach + 1)
    one = np.array([(y, x) for y in range(reach + 1) for x in steps if y > 0 or x >= 0])
    return one, one[:, None] - one[None], one[:, None] + one[None]


def _by_rows(power: np.ndarray, down: np.ndarray, reach: int) -> np.ndarray:
    """Returns what each row multiplies the waves across with: float32 (h, 2l + 1)."""
    right, left = power[:, reach:], power[:, reach::-1]  # dx = 0.. and dx = 0, -1, ..
    even = right + np.where(np.arange(reach + 1) > 0, left, 0.0)
    odd = (right - left)[:, 1:]
    out = np.empty((down.shape[1], 2 * reach + 1), np.float32)
    _fill_rows(np.ascontiguousarray(even), np.ascontiguousarray(odd), down, reach, out)
    return out


@kernel
def _fill_rows(even: Array, odd: Array, down: Array, reach: int, out: Array) -> None:
    """even (2l + 1, l + 1), odd (2l + 1, l): the filter's power by dy, both sides of dx together."""
    for y in range(out.shape[0]):
        for dx in range(reach + 1):
            total = even[reach, dx]
            for dy in range(1, reach + 1):
                total += (even[reach + dy, dx] + even[reach - dy, dx]) * np.float64(down[dy, y])
            out[y, dx] = np.float32(total)
        for dx in range(reach):
            total = 0.0
            for dy in range(1, reach + 1):
                total -= (odd[reach + dy, dx] - odd[reach - dy, dx]) * np.float64(down[reach + dy, y])
            out[y, reach + 1 + dx] = np.float32(total)


@kernel
def _multiply(half: Array, power: Array) -> None:
    """half (h, 2c) times the square root of the size of the filter's power (h, c), within its bounds."""
    least, most = np.float32(_LEAST), np.float32(_MOST)
    for y in range(half.shape[0]):
        line, by = half[y], power[y]
        for x in range(by.size):
            size = np.sqrt(min(max(abs(by[x]), least), most))
            line[2 * x] *= size
            line[2 * x + 1] *= size
