"""What the window asks of single layers."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ShowOnly:
    """Shows a layer, group or placement alone, as it is by itself, in place of the painting; None: the painting.  No
    command: the painting stays what it is."""

    name: str | None


def layer_picture(name: str) -> str:
    """Returns under which name the small picture of a node is sent."""
    return f"layer {name}"
