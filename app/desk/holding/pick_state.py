"""What is set of taking colours from the painting."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class PickState:
    """`radius`: of the disc whose mean counts, pixels, 0 for the pixel alone; `layer`: of the layer that is chosen,
    else of what is seen; `ink`: the ink that lies there is taken, too; `asked`: where that is asked for."""

    radius: int = 0
    layer: bool = False
    ink: bool = False
    asked: tuple[int, int, int] | None = None
