"""What the canvas shows of the hand besides the brush's circle."""

from __future__ import annotations

from dataclasses import dataclass

from app.canvas.view import Place


@dataclass(slots=True)
class HandSight:
    """`brush_at`: where the brush is while it trails the pen on a rope; `ghost`: where its dab is shown while its size
    is dragged; `palette_at`: where the pop-up palette is to be opened; framebuffer pixels."""

    brush_at: Place | None = None
    ghost: tuple[float, float] | None = None
    palette_at: tuple[float, float] | None = None
