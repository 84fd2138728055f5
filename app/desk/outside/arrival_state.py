"""What is on its way into the painting."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Arriving:
    """`name`: of the layer or group that is on its way, empty for none; `hint`: what is told when it is there; `tool`:
    what was in hand as it was asked for."""

    name: str = ""
    hint: str = ""
    tool: str = ""
