"""Which keys are bound otherwise than they come, and the key that is waited for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Bound = Mapping[str, tuple[str, ...]]  # keys by what they do: a row of ACTIONS in app.actions, or `brush_row` of a name
_BRUSH = "brush:"


@dataclass(slots=True)
class KeyState:
    """`bound`: what is bound otherwise than it comes; `listening`: the next press is for the list of keys, which takes
    it from `pressed`; `told`: a line about a map that was brought in; `own`: what a ready-made map replaced."""

    bound: Bound = field(default_factory=dict)
    listening: bool = False
    pressed: str = ""
    told: str = ""
    own: Bound = field(default_factory=dict)


def brush_row(preset: str) -> str:
    """Returns what a brush is called in a map of keys."""
    return _BRUSH + preset


def brush_of(row: str) -> str:
    """Returns the brush that a row of a map of keys takes; "" where it is none."""
    return row.removeprefix(_BRUSH) if row.startswith(_BRUSH) else ""
