"""What the worker tells of the texture lab, of matching, and of regions of examples.

Light on purpose, as `results`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from immutables import Map


@dataclass(frozen=True, slots=True, eq=False)
class RegionScene:
    """The region of an example that is painted, whose picture is "region IDENT".

    `size`: width, height; `steps`: taken so far; `inside`: bool (h, w), read-only, `share` of
    all pixels, 0..1; `modified`: whether there are others
    than when it was saved; `opaque`: whether the example has no holes.
    """

    ident: str
    size: tuple[int, int]
    steps: tuple[Map[str, Any], ...]
    inside: np.ndarray
    share: float
    can_undo: bool
    can_redo: bool
    modified: bool
    opaque: bool


@dataclass(frozen=True, slots=True)
class LabScene:
    """What the lab's panel shows besides the pictures "lab spectrum", "lab texture", "lab stroke", "lab near".

    `shapes`: the rows of `shapes.SHAPES`; `silent`: nothing sounds, the texture is flat; `using`: the texture of the
    painting that follows the lab; `version`: another number, and that texture has changed.
    """

    shapes: tuple[Any, ...]
    strokes: int
    can_undo: bool
    can_redo: bool
    silent: bool
    using: str = ""
    version: int = 0


@dataclass(frozen=True, slots=True)
class Found:
    """A part of what Analyse asked for; those not found yet are missing.  `lines`: by name of the facts, how each
    reads; `rings`: frequency in cycles per pixel, power and that of the all-pole model, of each ring; pictures come as
    Picture, under the names in `pictures`."""

    lines: Map[str, str]
    rings: tuple[tuple[float, float, float], ...] = ()
    pictures: tuple[str, ...] = ()
    done: bool = False


@dataclass(frozen=True, slots=True)
class MatchScene:
    """What the matching panel shows besides the pictures "match example", "match second", "match texture".

    `done`: how far the texture is, 0..1; `levels`, `orientations`: of its pyramid; `colours`: of its axes, sRGB;
    `fault`: what is wrong with what was asked for; `making`: the texture being made for use; `copied`: which part of
    it is copied from the example, 0..1, -1 while that is not known.
    """

    done: float = 0.0
    levels: int = 0
    orientations: int = 0
    colours: tuple[tuple[float, float, float], ...] = ()
    sizes: tuple[tuple[int, int], ...] = ()  # width and height of the examples
    fault: str = ""
    making: str = ""
    copied: float = -1.0


@dataclass(frozen=True, slots=True)
class DoctorTrial:
    """One way in which a texture was made of an example (a row of `trying.TRIED`), whose picture is "doctor WAY": how
    far it is from the example, which part is copied, and in how many seconds; or what is amiss."""

    way: str
    title: str
    apart: float
    copied: float
    seconds: float
    fault: str = ""


@dataclass(frozen=True, slots=True)
class DoctorScene:
    """What is known of the picture file `path`, which is the picture "doctor example": its `kinds`, where light falls
    off and whither it slants, and what was tried so far; the `advice`, "" until that is known, and why; `fault`: what
    is wrong with the file."""

    path: str
    kinds: tuple[str, ...] = ()
    light: float = 0.0
    slant: str = ""
    trials: tuple[DoctorTrial, ...] = ()
    advice: str = ""
    why: str = ""
    fault: str = ""


TextureResult = RegionScene | LabScene | Found | MatchScene | DoctorScene
