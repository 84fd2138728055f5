"""The sizes that a hand remembers: erasing has its own, and so have brushes that lay no paint."""

from __future__ import annotations

from dataclasses import dataclass, field

from engine.brush.settings import Brush


@dataclass(frozen=True, slots=True)
class Lock:
    """A size that is locked to the canvas: `radius` in pixels of the screen at a zoom, of which `shown` can be painted
    with."""

    radius: float
    shown: float
    level: int
    fraction: float


@dataclass(slots=True)
class Sizes:
    """`resting`: the radius that comes back when the brush erases no more, or does again, None while that is the same;
    `own`: those of presets that lay no paint, by name.  Pixels of the screen.  `lock`: how large the brush is on the
    canvas, None where it has its size on the screen."""

    resting: float | None = None
    own: dict[str, float] = field(default_factory=dict)
    lock: Lock | None = None

    def turned(self, radius: float) -> float:
        """Returns the radius of the pen's other end, which is taken now; `radius`: of the one that rests."""
        turned, self.resting = radius if self.resting is None else self.resting, radius
        return turned

    def leave(self, preset: str, brush: Brush) -> None:
        """Remembers the size of a brush that is put down."""
        if not brush.row.lays_ink:
            self.own[preset] = brush.radius

    def of(self, preset: str, brush: Brush) -> float:
        """Returns the size of a brush that is taken: the one that it had, if it lays no paint."""
        return brush.radius if brush.row.lays_ink else self.own.get(preset, brush.radius)
