"""Pictures of a screen, compared."""

import numpy as np


def changed(a: np.ndarray, b: np.ndarray) -> int:
    """How many pixels of (h, w, 3) pictures differ by more than 12 of 255."""
    return int((np.abs(a - b).max(axis=-1) > 12).sum())
