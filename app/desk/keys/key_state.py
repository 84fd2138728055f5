"""Which keys are bound otherwise than they come, and the key that is waited for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Bound = Mapping[str, tuple[str, ...]]  # keys by what they do: a row of ACTIONS in app.actions, or `brush_row` of a name
_BRUSH = "brush:"
_SEEN_IN = 6  # frames in which a key of a panel is done and drawn


@dataclass(slots=True)
class KeyState:
    """`bound`: what is bound otherwise than it comes; `listening`: the next press is for the list of keys, which takes
    it from `pressed`; `told`: a line about a map that was brought in; `own`: what a ready-made map replaced; `panel`:
    the number of the panel that keys go through, None while they are the canvas's, `turning`: it is another one from
    now on; `frames` that are to follow until what a key did is seen."""

    bound: Bound = field(default_factory=dict)
    listening: bool = False
    pressed: str = ""
    told: str = ""
    own: Bound = field(default_factory=dict)
    panel: int | None = None
    turning: bool = False
    frames: int = 0

    def stir(self) -> None:
        """A key was pressed, or let go."""
        self.frames = _SEEN_IN

    def stirred(self) -> bool:
        """Tells whether what a key does in a panel is still to be seen; asked once a frame."""
        self.frames = max(0, self.frames - 1)
        return self.frames > 0 and self.panel is not None


def brush_row(preset: str) -> str:
    """Returns what a brush is called in a map of keys."""
    return _BRUSH + preset


def brush_of(row: str) -> str:
    """Returns the brush that a row of a map of keys takes; "" where it is none."""
    return row.removeprefix(_BRUSH) if row.startswith(_BRUSH) else ""
