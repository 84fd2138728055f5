"""Smooth paths from raw pen samples, while they come in.

The path is the uniform quadratic B-spline whose control points are the samples (the limit of Chaikin's corner
cutting, Chaikin 1974): it runs from midpoint to midpoint; the first and the last sample count twice, so that it begins
and ends there.  It is handed on as a polyline that is near it to a tenth of a pixel.  Pressure, tilt and time are
smoothed with it.
"""

from __future__ import annotations

import numpy as np

from engine.brush.samples import COLUMNS, cleaned
from engine.brush.steadying import STEADIED

TOLERANCE = 0.1  # px between the curve and its polyline
PIECES_CAP = 256  # of one curve piece
_TIME, _TURN = 5, 6


class Smoother:
    """Raw samples of one stroke in, points of its smooth path out; in any portions the same path, bit for bit.

    `stabiliser`, 0..1: how much the hand is steadied, in a `way` of STEADIED; `unit`: how many of the samples' pixels
    one of the screen is.  `finish` closes the path at the last sample, unless the way has it end where the brush is.
    """

    def __init__(
        self, stabiliser: float = 0.0, tolerance: float = TOLERANCE, way: str = "weighted", unit: float = 1.0
    ) -> None:
        strength = min(max(stabiliser, 0.0), 1.0)
        self._follow = STEADIED[way].make(strength, unit) if strength else None
        self._to_the_pen = STEADIED[way].to_the_pen
        self._tolerance = tolerance
        self._recent: np.ndarray | None = None  # the last two control points
        self._raw: np.ndarray | None = None  # the last sample as it came
        self.dropped = 0

    @property
    def at(self) -> tuple[float, float] | None:
        """Returns where the brush is, which may trail the pen; None before it begins."""
        if self._recent is None or not len(self._recent):
            return None
        return float(self._recent[-1, 0]), float(self._recent[-1, 1])

    def add(self, samples: np.ndarray) -> np.ndarray:
        """Returns the points, float64 (m, 6..7), by which `samples`, float64 (n, 2..7), lengthen the path.

        The path stays half a sample behind the pen until `finish`.  Samples that are not finite are dropped and
        counted; BrushError beyond 2^31 px.
        """
        samples, dropped = cleaned(samples)
        self.dropped += dropped
        if not len(samples):
            return samples
        first = samples[:1] if self._raw is None else samples[:0]
        if samples.shape[1] > _TURN:
            samples[:, _TURN:] = self._unwound(samples[:, _TURN:])
        steadied = self._steadied(samples)
        before = samples[:0] if self._recent is None else self._recent
        controls = np.concatenate([before, first, first, steadied[len(first) :]])
        self._recent = controls[-2:]
        self._raw = samples[-1]
        return np.concatenate([first, _pieces(controls, self._tolerance)])

    def finish(self) -> np.ndarray:
        """Returns the last points: to the last sample, where the pen left."""
        if self._raw is None or self._recent is None:
            return np.empty((0, COLUMNS))
        before, last = self._recent
        end = self._raw[None] if self._to_the_pen or self._follow is None else last[None]
        if np.array_equal(last, end[0]):
            return _pieces(np.stack([before, last, last]), self._tolerance) if (before != last).any() else end[:0]
        return _pieces(np.concatenate([self._recent, end, end]), self._tolerance)

    def _unwound(self, turns: np.ndarray) -> np.ndarray:
        """Returns rotations, float64 (n, 1) in degrees, without jumps by whole turns."""
        before = turns[:1] if self._raw is None else self._raw[None, _TURN:]
        out: np.ndarray = np.unwrap(np.concatenate([before, turns]), axis=0, period=360.0)[1:]
        return out

    def _steadied(self, samples: np.ndarray) -> np.ndarray:
        """Returns the samples with the positions that the brush has as it follows them."""
        if self._follow is None:
            return samples
        out = samples.copy()
        before = self._raw if self._raw is not None else samples[0]
        x, y = (samples[0] if self._recent is None else self._recent[-1])[:2].tolist()
        time = float(before[_TIME])
        for i, sample in enumerate(samples.tolist()):
            passed = sample[_TIME] - time
            time = sample[_TIME]
            x, y = self._follow((x, y), (sample[0], sample[1]), passed)
            out[i, 0], out[i, 1] = x, y
        return out


def _pieces(controls: np.ndarray, tolerance: float) -> np.ndarray:
    """Returns the polyline of the spline pieces around every control point but the first and the last, each without its
    beginning.  A control point given twice makes the curve pass through it."""
    if len(controls) < 3:
        return controls[:0]
    before, middle, after = controls[:-2], controls[1:-1], controls[2:]
    start, end = 0.5 * (before + middle), 0.5 * (middle + after)
    bend = (start - middle) + (end - middle)
    # A parabola's chord is |bend| / (4 n^2) away from it when it is cut into n parts.
    off = np.sqrt(bend[:, 0] * bend[:, 0] + bend[:, 1] * bend[:, 1])
    parts = np.clip(np.ceil(np.sqrt(off / (4.0 * tolerance))), 1, PIECES_CAP).astype(np.int64)
    which = np.repeat(np.arange(len(middle)), parts)
    step = np.arange(len(which)) - np.repeat(np.cumsum(parts) - parts, parts) + 1
    t = (step / parts[which])[:, None]
    away = start[which] - middle[which]
    # start + 2 t (middle - start) + t^2 bend; at t = 1 exactly the next piece's start
    curve = start[which] - (2.0 * t) * away + (t * t) * bend[which]
    ends = np.cumsum(parts) - 1
    curve[ends] = end
    out: np.ndarray = curve
    return out
