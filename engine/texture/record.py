"""The record that every maker of texture fills: what it looks like at a level, and what each finer level adds.

Perlin & Velho 1995, sections 3.3 and 5.1.  An *instance* is one texture bound to a base level; it is what a plane
triple (red, green, blue amplitude) of ink refers to.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY

if TYPE_CHECKING:
    from engine.texture.image import ImageSource

LEARNT = "learnt"  # the detail of a texture that is refined by what was learnt of it
_LASTING = "lasting "


def told_kind(kind: str, arithmetic: int, renew: bool = True) -> str:
    """Returns how a key names a kind of texture that is worked out in an arithmetic, and whether its older octaves are
    renewed; `kind_of_key` is the inverse."""
    named = kind if renew else _LASTING + kind
    return named if arithmetic == LIBRARY else f"{named}#{arithmetic}"


def kind_of_key(told: str) -> tuple[str, int, bool]:
    """Returns the kind, the arithmetic, and whether octaves are renewed, as the first part of a key tells."""
    named, _, number = told.rpartition("#")
    everywhere = bool(named) and number == str(EVERYWHERE)
    kind = named if everywhere else told
    renew = not kind.startswith(_LASTING)
    return kind if renew else kind[len(_LASTING) :], EVERYWHERE if everywhere else LIBRARY, renew


class Instance(Protocol):
    """One texture at one base level: hashable, immutable, the same values for the same place for ever.

    `key`: a JSON-ready tuple of strings and numbers that tells this instance from every other; instances are equal
    when their keys are, and sort by it.
    `base`: the level at which it was first painted; `bandpass` is zero at that level and above (coarser).
    """

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from every other; JSON-ready."""
        ...

    @property
    def base(self) -> int:
        """Gives the level at which the texture was first painted."""
        ...

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """S at `level` over `rect`: float32 (1 or 3 or 4, h, w).  Nominal range -1..1 for procedural textures;
        0..1 premultiplied RGBA (4 planes) for images."""
        ...

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """S_level - E S_(level-1) over `rect`: float32 (1 or 3, h, w); None where it is known to be zero all over.

        A function of level and pixel alone: any rectangle cut from a larger one holds bit-identical values.
        """
        ...


def pictures_of(made: Instance) -> tuple[ImageSource, ...]:
    """Returns the pictures that a texture needs: its own, what was learnt of that, those of textures that it names."""
    while (inner := getattr(made, "inner", None)) is not None:
        made = inner
    found = [getattr(made, name, None) for name in ("source", "maps")]
    found += [one for _, each in getattr(made, "named", ()) for one in pictures_of(each)]
    return tuple(one for one in found if one is not None)
