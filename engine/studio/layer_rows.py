"""The rows of the panel of layers, as the background worker tells them; light, as `results`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from engine.canvas.placing.pose import Pose, SourcePart


@dataclass(frozen=True, slots=True)
class Shows:
    """What a placement shows, and where: the node of that name; None: the whole painting; `part`: what of it."""

    name: str | None
    pose: Pose
    part: SourcePart | None = None


@dataclass(frozen=True, slots=True)
class LayerRow:
    """A layer, group or placement as the panel lists it, top-most first; `depth` counts the groups around it; `shows`:
    what a placement shows, None where it is none; `finest`: the finest level at which a layer stores anything;
    `reference`: it is no part of the picture; `height`: nor is it, being heights, of a `scale` and `sea`;
    `clip`: shown only where the one below has paint; `wrap`: the cell of which it shows repeats;
    `masked`: it has a mask of its own, within which it is shown unless that is put aside, `mask_off`; `mask_turned`:
    it was turned or scaled with the placement, and cannot be painted on."""

    name: str
    group: bool
    depth: int
    parent: str | None
    position: int
    opacity: float
    visible: bool
    blend: str
    locked: bool
    alpha_locked: bool
    shows: Shows | None = None
    finest: int | None = None
    reference: bool = False
    clip: bool = False
    wrap: SourcePart | None = None
    masked: bool = False
    mask_off: bool = False
    height: bool = False
    scale: float | None = None
    sea: float | None = None
    mask_turned: bool = False
