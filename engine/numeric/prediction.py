"""Two-dimensional linear prediction: an all-pole filter fitted to a sample continues it from what lies around.

Lewis 1984, section 6.1 ("small brushes") and figure 4; Makhoul 1975, "Linear prediction: a tutorial review".  A pixel
is foretold from those before it in raster order, `reach` pixels far (a nonsymmetric half-plane):

    v(p) = mean + sum over k of a_k (v(p + offset_k) - mean) + residual noise

The a_k are the least-squares ones over the sample (the covariance method, no window).  That method may give an
unstable filter, so the poles are looked at, and the coefficients shrunk until all lie inside the unit circle.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.kernel import Array, kernel
from engine.numeric.poles import pole_radius

REACH_CAP = 8
RADIUS = 0.999  # of the outermost pole, at most
_RIDGE = 1e-6  # of the sample's variance: what a perfectly regular sample leaves undetermined
_SHRINK = 0.98
_WORD = np.uint64(0xFFFF)


@dataclass(frozen=True, eq=False, slots=True)
class Predictor:
    """An all-pole filter for each of c channels, and what is to be told of it.

    `sample`: float32 (c, h, w), what it was fitted to.  `offsets`: int64 (n, 2), (dy, dx) before (0, 0) in raster
    order.  `coefficients`: float64 (c, n).  `mean`: float64 (c,).  `mixing`: float64 (c, c), lower triangular: times
    white noise of deviation 1 it has the covariance of the errors of prediction, so colours vary together as they do
    in the sample.  `radius`: of the outermost pole, below 1 for a stable filter.  `shrunk`: what the coefficients at
    distance d were multiplied by is its d-th power; 1 for a filter that was stable as fitted.
    """

    sample: np.ndarray
    reach: int
    offsets: np.ndarray
    coefficients: np.ndarray
    mean: np.ndarray
    mixing: np.ndarray
    radius: float
    shrunk: float

    @property
    def stable(self) -> bool:
        """Tells whether it is certain to be stable by the size of its coefficients, or by its poles."""
        return bool((np.abs(self.coefficients).sum(axis=1) < 1.0).all()) or self.radius < 1.0

    @property
    def verdict(self) -> str:
        """Tells whether it was stable as fitted, and how far out its outermost pole lies, in words."""
        return f"{'stable' if self.shrunk == 1.0 else 'made stable'}, poles to {self.radius:.3f}"

    @property
    def residual(self) -> np.ndarray:
        """Returns the deviation of the errors of prediction over the sample, float64 (c,)."""
        out: np.ndarray = np.sqrt((self.mixing**2).sum(axis=1))
        return out

    def spectrum(self, height: int, width: int) -> np.ndarray:
        """Returns the power spectrum that the filter makes of white noise: float64 (c, height, width), zero
        frequency at [height // 2, width // 2], its mean the variance of the texture."""
        impulse = np.zeros((len(self.mean), height, width))
        impulse[:, 0, 0] = 1.0
        for (dy, dx), values in zip(self.offsets, self.coefficients.T, strict=True):
            impulse[:, -dy % height, -dx % width] -= values
        gain = np.abs(np.fft.fft2(impulse)) ** 2
        power = (self.residual**2)[:, None, None] / np.maximum(gain, 1e-12)
        return np.fft.fftshift(power, axes=(1, 2))

    def continue_into(
        self,
        values: np.ndarray,
        mask: np.ndarray,
        noise: np.ndarray,
        known: np.ndarray | None = None,
        origin: tuple[int, int] = (0, 0),
    ) -> np.ndarray:
        """`values` float32 (c, h, w) with the pixels of `mask`, bool (h, w), foretold in raster order: a new array.

        `noise`: float32 (c, h, w) of deviation 1, see `noise_at`.  `known`: bool (h, w), where `values` may serve as
        memory; all that is not to be filled, if it is not given.  Where nothing is known, and beyond the array, the
        memory is the sample, laid periodically from place (0, 0) on; `origin` is the place (x, y) of the first pixel.
        ValueError if the shapes do not fit.
        """
        shape = (len(self.mean), *mask.shape)
        if values.shape != shape or noise.shape != shape or (known is not None and known.shape != mask.shape):
            raise ValueError(f"prediction: found {values.shape} and noise {noise.shape}, expected {shape}")
        known = ~mask if known is None else known & ~mask
        reach = self.reach
        height, width = mask.shape
        rows = (np.arange(-reach, height) + origin[1] % self.sample.shape[1]) % self.sample.shape[1]
        columns = (np.arange(-reach, width + reach) + origin[0] % self.sample.shape[2]) % self.sample.shape[2]
        memory = np.ascontiguousarray(self.sample[:, rows[:, None], columns[None, :]])
        inner = memory[:, reach:, reach : reach + width]
        inner[:, known] = values[:, known]
        errors = np.zeros(shape, np.float32)
        for row, parts in zip(errors, self.mixing, strict=True):
            for plane, part in zip(noise, parts, strict=True):
                row += plane * np.float32(part)
        steps = self.offsets[:, 0] * memory.shape[2] + self.offsets[:, 1]
        for plane, taps, mean, error in zip(memory, self.coefficients, self.mean, errors, strict=True):
            _continue(plane, reach, mask, steps, taps, mean, error)
        out = values.astype(np.float32)
        out[:, mask] = inner[:, mask]
        return out


def fit(sample: np.ndarray, reach: int = 3, arithmetic: int = LIBRARY) -> Predictor:
    """Returns the predictor of a sample (h, w) or (c, h, w), made stable if it is not.

    `reach`: 1 to 8 pixels; less is used where the sample has too few pixels to tell the coefficients.  ValueError if
    the sample is empty or holds values that are not finite.
    """
    planes = np.ascontiguousarray(sample if sample.ndim == 3 else sample[None], np.float32)
    if planes.ndim != 3 or not planes.size or not np.isfinite(planes).all():
        raise ValueError(f"prediction: found a sample of shape {sample.shape}, expected (c, h, w) of finite numbers")
    if not 1 <= reach <= REACH_CAP:
        raise ValueError(f"prediction: found a reach of {reach}, expected 1 to {REACH_CAP}")
    reach = _affordable(reach, *planes.shape[1:])
    offsets = half_plane(reach)
    mean = array_functions(arithmetic).mean(planes, axis=(1, 2), dtype=np.float64)
    centred = planes - mean[:, None, None]
    coefficients = np.stack([_least_squares(plane, reach, offsets) for plane in centred])
    fitted = Predictor(planes, reach, offsets, coefficients, mean, np.zeros((len(mean), len(mean))), 0.0, 1.0)
    return _with_errors(_stabilised(fitted, arithmetic), centred, arithmetic)


def half_plane(reach: int) -> np.ndarray:
    """Returns the places (dy, dx) before (0, 0) in raster order, at most `reach` rows and columns away: int64 (n,
    2)."""
    places = [(dy, dx) for dy in range(-reach, 1) for dx in range(-reach, reach + 1) if (dy, dx) < (0, 0)]
    return np.array(places, np.int64).reshape(-1, 2)


def noise_at(seed: int, x: int, y: int, shape: tuple[int, int, int]) -> np.ndarray:
    """White noise by place: float32 (c, h, w) of mean 0 and deviation 1, nearly normal, from (x, y) on."""
    channels, height, width = shape
    out = np.empty(shape, np.float32)
    for c in range(channels):
        bits = hash_plane(fold_key(seed, c), x, y, width, height)
        total = np.zeros((height, width), np.int64)
        for part in range(4):  # the sum of four uniform numbers: of variance 4 / 12
            total += ((bits >> np.uint64(16 * part)) & _WORD).astype(np.int64)
        out[c] = (total - 2 * 65535) * (np.sqrt(3.0) / 65536.0)
    return out


@kernel
def _continue(memory: Array, reach: int, mask: Array, steps: Array, taps: Array, mean: float, errors: Array) -> None:
    """Foretells the masked pixels of one plane, padded by `reach` above, left and right; `steps`: flat offsets."""
    height, width = mask.shape
    flat = memory.reshape(-1)
    for y in range(height):
        row = (y + reach) * memory.shape[1] + reach
        for x in range(width):
            if mask[y, x]:
                total = mean + np.float64(errors[y, x])
                for k in range(steps.size):
                    total += taps[k] * (np.float64(flat[row + x + steps[k]]) - mean)
                flat[row + x] = np.float32(total)


@kernel
def _add_products(plane: np.ndarray, reach: int, steps: np.ndarray, out: np.ndarray) -> None:
    """Adds v(p + step_i) v(p + step_j), j <= i, of all pixels p whose memory lies in the plane."""
    height, width = plane.shape
    flat = plane.reshape(-1)
    values = np.empty(steps.size)
    for y in range(reach, height):
        for x in range(reach, width - reach):
            for k in range(steps.size):
                values[k] = flat[y * width + x + steps[k]]
            for i in range(steps.size):
                row, value = out[i, : i + 1], values[i]
                for j in range(row.size):
                    row[j] += value * values[j]


@kernel
def _cholesky(matrix: np.ndarray) -> np.ndarray:
    """Returns the lower triangular root of a symmetric matrix with no negative eigenvalue, column by column."""
    n = matrix.shape[0]
    root = np.zeros((n, n))
    for j in range(n):
        for i in range(j, n):
            total = matrix[i, j]
            for k in range(j):
                total -= root[i, k] * root[j, k]
            if i == j:
                root[j, j] = np.sqrt(max(total, 0.0))
            elif root[j, j] > 1e-30:
                root[i, j] = total / root[j, j]
    return root


@kernel
def _solved(root: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Returns the x with root root' x = right."""
    n = right.size
    x = right.copy()
    for i in range(n):
        for k in range(i):
            x[i] -= root[i, k] * x[k]
        x[i] /= root[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            x[i] -= root[k, i] * x[k]
        x[i] /= root[i, i]
    return x


def _affordable(reach: int, height: int, width: int) -> int:
    """Returns the largest reach, up to the one wanted, with three equations for each coefficient; 0 if there is
    none."""
    while reach and max(0, height - reach) * max(0, width - 2 * reach) < 3 * 2 * reach * (reach + 1):
        reach -= 1
    return reach


def _shifted(planes: np.ndarray, reach: int, dy: int, dx: int) -> np.ndarray:
    """Returns the pixels at (dy, dx) from those whose whole memory lies in the sample: (c, h - reach, w - 2 reach)."""
    _, height, width = planes.shape
    return planes[:, reach + dy : height + dy, reach + dx : width - reach + dx]


def _least_squares(plane: np.ndarray, reach: int, offsets: np.ndarray) -> np.ndarray:
    """Coefficients (n,) by which a pixel of float64 (h, w), mean 0, follows from those at the offsets.

    Sums and the solution are made without BLAS, whose last digits depend on how many threads it has.
    """
    n = len(offsets)
    steps = np.concatenate([[0], offsets[:, 0] * plane.shape[1] + offsets[:, 1]])
    normal = np.zeros((n + 1, n + 1))
    _add_products(plane, reach, steps, normal)
    normal /= max(1, (plane.shape[0] - reach) * (plane.shape[1] - 2 * reach))
    if not n or normal[0, 0] <= 1e-12:
        return np.zeros(n)
    inner = normal[1:, 1:] + np.eye(n) * (_RIDGE * normal[0, 0])
    out: np.ndarray = _solved(_cholesky(inner), np.ascontiguousarray(normal[1:, 0]))
    return out


def _stabilised(fitted: Predictor, arithmetic: int) -> Predictor:
    """Returns the same with coefficients shrunk by a power of their distance, as the poles of speech filters are
    widened, until the outermost pole lies within RADIUS."""
    if not fitted.reach:
        return fitted
    distance = np.abs(fitted.offsets).max(axis=1)
    shrunk = 1.0
    while True:
        coefficients = fitted.coefficients * shrunk**distance
        radius = max(pole_radius(fitted.reach, fitted.offsets, taps, arithmetic) for taps in coefficients)
        if radius <= RADIUS:
            return replace(fitted, coefficients=coefficients, radius=radius, shrunk=shrunk)
        shrunk *= _SHRINK


def _with_errors(fitted: Predictor, centred: np.ndarray, arithmetic: int) -> Predictor:
    errors = _shifted(centred, fitted.reach, 0, 0).copy()
    for (dy, dx), taps in zip(fitted.offsets, fitted.coefficients.T, strict=True):
        errors -= _shifted(centred, fitted.reach, dy, dx) * taps[:, None, None]
    channels, mean = range(len(errors)), array_functions(arithmetic).mean
    covariance = np.array([[float(mean(errors[i] * errors[j])) for j in channels] for i in channels])
    return replace(fitted, mixing=_cholesky(covariance))
