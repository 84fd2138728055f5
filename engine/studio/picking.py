"""Taking a colour from the painting: of a pixel, or the mean of a disc; of what is seen, or of one layer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.canvas.layers import Group, Layer, find, has
from engine.numeric.address import Rect
from engine.studio.requests import Pick
from engine.studio.results import Picked

LARGEST_DISC = 256  # px, of the radius


def looked_over(request: Pick) -> Rect:
    """Returns the pixels that a pick looks at."""
    radius = min(max(request.radius, 0), LARGEST_DISC)
    return Rect.at(request.x - radius, request.y - radius, 2 * radius + 1, 2 * radius + 1)


def alone(root: Group, layer: str | None) -> Group | None:
    """Returns the root of a layer of paint by itself, over nothing, as opaque as its paint is; None where there is no
    such layer."""
    node = find(root, layer) if layer is not None and has(root, layer) else None
    if not isinstance(node, Layer):
        return None
    shown = replace(node, visible=True, opacity=1.0, blend="src-over", clip=False, mask=None)
    return replace(root, children=(shown,), paper=None, mask=None)


def averaged(picture: np.ndarray) -> Picked:
    """Returns the mean colour of the disc within a square picture, float32 (4, n, n), premultiplied: what covers more
    counts for more."""
    n = picture.shape[1]
    away = np.arange(n) - n // 2
    disc = away[:, None] ** 2 + away**2 <= (n // 2) ** 2
    *colour, alpha = (float(picture[i][disc].mean(dtype=np.float64)) for i in range(4))
    r, g, b = (min(1.0, max(0.0, v / alpha)) if alpha > 0 else 0.0 for v in colour)
    return Picked((r, g, b), alpha)
