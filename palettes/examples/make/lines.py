"""Many short curved lines, later ones over earlier ones: fibres, hair, threads, blades."""

from __future__ import annotations

import numpy as np
from ground import FINE, numbers
from PIL import Image, ImageDraw


def curves(seed: int, starts: np.ndarray, angles: np.ndarray, length: float, bend: float, steps: int = 7) -> np.ndarray:
    """Lines from `starts` (k, 2), leaving at `angles`, turning `bend` radians or so: (k, steps, 2) in pixels."""
    count = len(starts)
    chance = numbers(seed, 3, count)
    turn = (chance[0] - 0.5) * 2.0 * bend / steps
    step = length * (0.5 + chance[1]) / steps
    headings = angles[:, None] + turn[:, None] * np.arange(steps)[None, :] * (1.0 + 0.5 * chance[2][:, None])
    moves = np.stack([np.cos(headings), np.sin(headings)], axis=-1) * step[:, None, None]
    moves[:, 0] = 0.0
    return starts[:, None, :] + np.cumsum(moves, axis=1)


class Sheet:
    """Something to draw lines on: colours and how covered it is, `size` pixels square, finely."""

    def __init__(self, size: int, rgb: np.ndarray | None = None) -> None:
        n = size * FINE
        start = np.zeros((n, n, 3)) if rgb is None else rgb
        self._rgb = Image.fromarray(np.round(np.clip(start, 0.0, 1.0) * 255.0).astype(np.uint8), "RGB")
        self._cover = Image.new("L", (n, n), 0 if rgb is None else 255)
        self._tools = ImageDraw.Draw(self._rgb), ImageDraw.Draw(self._cover)

    def line(self, points: np.ndarray, rgb: np.ndarray, width: float) -> None:
        """One line of that width."""
        path = [tuple(p) for p in (points * FINE).tolist()]
        wide = max(1, round(width * FINE))
        self._tools[0].line(path, tuple(int(v * 255.0) for v in np.clip(rgb, 0.0, 1.0)), wide, joint="curve")
        self._tools[1].line(path, 255, wide, joint="curve")

    def shape(self, points: np.ndarray, rgb: np.ndarray) -> None:
        """One filled polygon."""
        path = [tuple(p) for p in (points * FINE).tolist()]
        self._tools[0].polygon(path, tuple(int(v * 255.0) for v in np.clip(rgb, 0.0, 1.0)))
        self._tools[1].polygon(path, 255)

    def laid(self) -> tuple[np.ndarray, np.ndarray]:
        """Colours (n, n, 3) and cover (n, n), 0..1."""
        return np.asarray(self._rgb) / 255.0, np.asarray(self._cover) / 255.0
