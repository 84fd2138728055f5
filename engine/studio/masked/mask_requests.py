"""What the window asks of masks."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ShowMask:
    """Shows the mask of a layer or group alone, in greys, in place of the painting; None: the painting."""

    name: str | None


def picture_name(name: str) -> str:
    """Returns under which name the small picture of a node's mask is sent."""
    return f"mask {name}"
