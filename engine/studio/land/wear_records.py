"""What the window asks about erosion, and what it is told."""

from __future__ import annotations

from dataclasses import dataclass

from engine.painting.layering.erode_command import Erode


@dataclass(frozen=True, slots=True)
class WearDown:
    """Wears heights down, piece by piece, and then in one step; the newest counts."""

    command: Erode


@dataclass(frozen=True, slots=True)
class StopWearing:
    """Leaves heights as they are."""


@dataclass(frozen=True, slots=True)
class WornTold:
    """The part, 0..1, that is done of the erosion that was asked for; None: it is done, or was given up."""

    part: float | None = None


WearRequest = WearDown | StopWearing
