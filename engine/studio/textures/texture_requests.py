"""What the window asks for of the texture lab, of matching, and of regions of examples.

Light on purpose, as `requests`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from immutables import Map

if TYPE_CHECKING:
    from engine.brush.settings import Brush

_NOTHING: Map[str, Any] = Map()


@dataclass(frozen=True, slots=True)
class LabSet:
    """What the texture lab makes of the spectrum that is painted in it (`spectrum.Design`), and what of it is shown.

    `sheet`: "amplitude" or "phase"; `field`: the members of the texture command besides the design's own.
    """

    size: tuple[int, int] = (256, 256)
    shapes: tuple[Map[str, Any], ...] = ()
    phase: str = "random"
    seed: int = 0
    part: str = "real"
    forward: bool = False
    field: Map[str, Any] = _NOTHING
    sheet: str = "amplitude"


@dataclass(frozen=True, slots=True)
class LabBegin:
    """A stroke in the lab, on its sheet: `radius` of the brush and the points in pixels of the spectrum."""

    brush: Brush


@dataclass(frozen=True, slots=True)
class LabPoints:
    """More of it, as Points."""

    points: np.ndarray


@dataclass(frozen=True, slots=True)
class LabEnd:
    """The pen lifts; `kept` unless the stroke is to be dropped."""

    kept: bool = True


@dataclass(frozen=True, slots=True)
class LabStep:
    """Takes back strokes of the lab (`count` < 0), does them again (> 0), or takes all away (0)."""

    count: int


@dataclass(frozen=True, slots=True)
class LabRest:
    """The lab has come to rest: a texture in use follows it; shows a stroke of `brush` with its texture in the ink,
    pictures `size` (width, height) large."""

    brush: Brush
    size: tuple[int, int]


@dataclass(frozen=True, slots=True)
class LabUse:
    """Defines the lab's texture under a name; from now on it follows the lab, until another name is used or none."""

    name: str


@dataclass(frozen=True, slots=True)
class MatchSet:
    """What the matching panel is to show: the members of a texture command of `maker`, "match" or "mix"; None where
    there is no example yet.  The newest counts."""

    maker: str = "match"
    arguments: Map[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class MatchUse:
    """Defines the texture of such a command under a name, as soon as it is made."""

    name: str
    maker: str
    arguments: Map[str, Any]


@dataclass(frozen=True, slots=True)
class DoctorAsk:
    """A picture file is to be examined; "" for none any more.  `flat`: without the light and the slant that are found
    in it."""

    path: str
    flat: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class RegionOpen:
    """The region of an example is to be painted.  `picture`: premultiplied RGBA, float32 (4, h, w); `first`: what the
    region begins with, bool (h, w), both read-only; `steps`: those of `example_region` taken since.  What was painted
    under this name before stays, and is shown."""

    ident: str
    picture: np.ndarray
    first: np.ndarray
    steps: tuple[Map[str, Any], ...] = ()


@dataclass(frozen=True, slots=True)
class RegionBegin:
    """A stroke in a region, which adds to it or takes from it (`op`: "add", "subtract"); the radius and the points in
    pixels of the example."""

    ident: str
    op: str
    radius: float


@dataclass(frozen=True, slots=True)
class RegionPoints:
    """More of it, as Points."""

    points: np.ndarray


@dataclass(frozen=True, slots=True)
class RegionEnd:
    """The pen lifts; `kept` unless the stroke is to be dropped."""

    kept: bool = True


@dataclass(frozen=True, slots=True)
class RegionDo:
    """A step of `example_region` is taken; `instead` of the last one, which is as if it had not been."""

    ident: str
    step: Map[str, Any]
    instead: bool = False


@dataclass(frozen=True, slots=True)
class RegionTravel:
    """Takes back steps of a region (`count` < 0), or takes them again (> 0)."""

    ident: str
    count: int


@dataclass(frozen=True, slots=True)
class RegionSaved:
    """A region was written when it had these steps; it goes by another name from now on."""

    ident: str
    name: str
    steps: tuple[Map[str, Any], ...]


@dataclass(frozen=True, slots=True)
class RegionClose:
    """A region is not painted any more."""

    ident: str


RegionRequest = (
    RegionOpen | RegionBegin | RegionPoints | RegionEnd | RegionDo | RegionTravel | RegionSaved | RegionClose
)
LabRequest = LabSet | LabBegin | LabPoints | LabEnd | LabStep | LabRest | LabUse
MatchRequest = MatchSet | MatchUse | DoctorAsk
