"""The dyadic grid on which every stored and shown value lies.

All pixel values (premultiplied colour, alpha, ink amplitudes) are multiples of Q = 2^-16 with |v| <= 16, kept in
float32.  There, expand, reduce, sums and differences are exact, so a result never depends on order, thread,
vector width or the path by which a tile was reached.
"""

import numpy as np

from engine.numeric.kernel import inlined

Q = 2.0**-16
LIMIT = 16.0

# Adding and taking away 192 rounds to the grid: float32 in [128, 256) has a spacing of exactly 2^-16, and the
# addition rounds to nearest, ties to even.  Valid for |v| < 64; two additions instead of a call, and it vectorises.
SNAP = np.float32(192.0)


@inlined
def snap(value: np.float32) -> np.float32:
    """Returns the nearest grid value to a float32 `value`, |value| < 64; ties to even."""
    return (value + SNAP) - SNAP


def snapped(values: np.ndarray) -> np.ndarray:
    """Returns the array rounded to the grid, as float32, clipped to |v| <= 16."""
    if isinstance(values, np.ndarray) and values.dtype == np.float32:
        out = np.clip(values, -LIMIT, LIMIT)
        out += SNAP
        out -= SNAP
        result: np.ndarray = out
        return result
    return np.clip(np.rint(np.asarray(values, np.float64) / Q) * Q, -LIMIT, LIMIT).astype(np.float32)
