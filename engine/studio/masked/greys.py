"""How a mask looks by itself."""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect


def greys(planes: np.ndarray | None, area: Rect) -> np.ndarray:
    """Returns how a mask looks, opaque greys, float32 (4, h, w); `planes`: its alpha, None where nothing shows."""
    out = np.empty((4, area.height, area.width), np.float32)
    alpha = np.zeros((area.height, area.width), np.float32) if planes is None else planes[3]
    out[:3] = alpha
    out[3] = 1
    return out
