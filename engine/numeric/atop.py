"""Compositing that keeps the backdrop's alpha: what is clipped to what lies below.

With the names of `blend`, colour = o ba s + (1 - o sa) b + o (M - ba s), alpha = ba: what the operator gives, less the
source where there is no backdrop.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.blend import ONE, Blend, clamped


def atop(row: Blend, backdrop: np.ndarray, source: np.ndarray, opacity: np.float32) -> None:
    """Composites as a kernel of `blend` does, in place, within the backdrop's alpha; operators that make holes make
    them."""
    alpha = backdrop[3].copy()
    row.kernel(backdrop, source, opacity)
    if not row.alone or row.outside:
        return
    beyond = opacity * (ONE - alpha) * clamped(source[:3], clamped(source[3], ONE))
    backdrop[:3] = clamped(backdrop[:3] - beyond, alpha)
    backdrop[3] = alpha
