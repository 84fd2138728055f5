"""What the window asks for while something on the canvas is dragged."""

from __future__ import annotations

from dataclasses import dataclass

from engine.painting.layering.placing_members import Placing


@dataclass(frozen=True, slots=True)
class Try:
    """Shows a layer, group or placement elsewhere, and changes nothing; None: as the painting has it."""

    name: str
    placing: Placing | None
