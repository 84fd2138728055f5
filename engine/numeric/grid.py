"""The dyadic grid on which every stored and shown value lies.

All pixel values (premultiplied colour, alpha, ink amplitudes) are multiples of Q = 2^-16 with |v| <= 16, kept in
float32.  There, expand, reduce, sums and differences are exact, so a result never depends on order, thread,
vector width or the path by which a tile was reached.

A painting may have been created with the coarser grid of 2^-12, for smaller files: all values of its layers lie there,
a subset of the other, and their pyramids round to it; strokes are worked out on the grid of 2^-16 until they are laid
down (engine/canvas/dither.py).  Grids are named by their bits, 16 and 12; kernels are given the `step`, 2^-16 or 2^-12.
"""

import numpy as np

from engine.numeric.arithmetic import COARSE, FINE
from engine.numeric.kernel import inlined

Q = 2.0**-16
LIMIT = 16.0
FINE_STEP = np.float32(Q)
_STEPS = {FINE: FINE_STEP, COARSE: np.float32(2.0**-COARSE)}

# Adding and taking away 192 rounds to the grid: float32 in [128, 256) has a spacing of exactly 2^-16, and the
# addition rounds to nearest, ties to even.  Valid for |v| < 64; two additions instead of a call, and it vectorises.
SNAP = np.float32(192.0)


@inlined
def snap(value: np.float32) -> np.float32:
    """Returns the nearest grid value to a float32 `value`, |value| < 64; ties to even."""
    return (value + SNAP) - SNAP


_WIDE = np.float32(1.5 * 2**23)  # of a step, of which float32 knows no parts there


@inlined
def snap_to(value: np.float32, step: np.float32) -> np.float32:
    """Returns the nearest multiple of a grid's step, |value| < 2^22 steps; ties to even: as `snap` for 2^-16."""
    far = _WIDE * step
    return (value + far) - far


def snapped_to(values: np.ndarray, step: np.float32) -> np.ndarray:
    """As `snap_to`, of float32 values, plainly."""
    far = _WIDE * step
    out: np.ndarray = (values + far) - far
    return out


def step_of(grid: int) -> np.float32:
    """Returns the step of the grid of so many bits."""
    return _STEPS[grid]


def snapped(values: np.ndarray) -> np.ndarray:
    """Returns the array rounded to the grid, as float32, clipped to |v| <= 16."""
    if isinstance(values, np.ndarray) and values.dtype == np.float32:
        out = np.clip(values, -LIMIT, LIMIT)
        out += SNAP
        out -= SNAP
        result: np.ndarray = out
        return result
    return np.clip(np.rint(np.asarray(values, np.float64) / Q) * Q, -LIMIT, LIMIT).astype(np.float32)
