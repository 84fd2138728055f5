"""Control channels of an example (Ritter et al. 2006, section 9; Hertzmann et al. 2001, "Image Analogies"): planes
beside its colours that tell what else there is to match, pixel by pixel, and how they are compared.

The channel `orientation` tells which way the example runs there, as 256 parts of a turn from rightwards, clockwise as
y points down.  `rim` tells how far inside the region a pixel lies; of what is painted it is not stored, but found of
the region.  What others tell is whoever names them's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from engine.numeric.elementary import atan2
from engine.texture.example.parameters import ORIENTATION, RIM_CHANNEL
from engine.texture.example.rim_distance import rim_distance

MOST_CHANNELS = 4
PART = 8 * 49 * 4  # energy of one step, of 255, of a channel that weighs as much as colours do
_MOST_WEIGHT = 1 << 14  # of all channels together: so energies stay within 32 bits


class Channel(NamedTuple):
    """`weight`: to colours; `turns`: how many copies of the example, turned all round, are learnt from; `width`: of a
    rim, in pixels of the example."""

    name: str
    weight: float = 1.0
    turns: int = 1
    width: int = 0


Channels = tuple[Channel, ...]


def ordered(channels: Sequence[Channel]) -> Channels:
    """Returns channels as planes lie: the orientation first, the rim, which is not stored, last."""
    return tuple(sorted(channels, key=lambda one: (one.name == RIM_CHANNEL, one.name != ORIENTATION, one.name)))


def stored_channels(channels: Channels) -> Channels:
    """Returns those that are stored with what is painted."""
    return tuple(one for one in channels if one.name != RIM_CHANNEL)


@dataclass(frozen=True, eq=False)
class Control:
    """`levels`: for each level of the exemplar, uint8 (channels, h, w), padded as it is; `turns`: for each how to get
    from one turned copy to another, int32 (5 + 2 copies): side of a copy's square, squares in a row, rows of them,
    padding, copies, then the cosine and the sine of each turn, times 2^14; empty without copies.  `usual`: what
    stored channels hold where nothing is told."""

    channels: Channels
    levels: tuple[np.ndarray, ...]
    turns: tuple[np.ndarray, ...]
    usual: tuple[int, ...]

    @cached_property
    def weights(self) -> np.ndarray:
        """Returns energies of a step of each channel: int32, those of the orientation, which goes round, negative."""
        found = [min(round(one.weight * PART), _MOST_WEIGHT // len(self.channels)) for one in self.channels]
        if self.channels[0].name == ORIENTATION:
            found[0] = -found[0]
        out = np.array(found, np.int32)
        out.flags.writeable = False
        return out

    @property
    def goes_on(self) -> bool:
        """Tells whether there is something of the example around its region, as there is around turned copies."""
        return bool(self.turns[0].size)

    @property
    def stored(self) -> int:
        """Counts the channels that are stored with what is painted."""
        return len(stored_channels(self.channels))

    @property
    def width(self) -> int:
        """Gives the width of the rim, in pixels of the finest level; 0 if it does not count."""
        return self.channels[-1].width if self.channels[-1].name == RIM_CHANNEL else 0

    def index(self, name: str) -> int | None:
        """Tells which of the stored channels has a name."""
        return next((n for n, one in enumerate(stored_channels(self.channels)) if one.name == name), None)

    def coarser(self, detail: int) -> Control | None:
        """Returns what is left of it where the finest levels are left out."""
        if detail >= len(self.levels):
            return None
        channels = tuple(one._replace(width=max(1, one.width >> detail)) if one.width else one for one in self.channels)
        return replace(self, channels=channels, levels=self.levels[detail:], turns=self.turns[detail:])


NO_WEIGHTS = np.zeros(0, np.int32)
NO_WEIGHTS.flags.writeable = False
NO_PLANES = np.zeros((0, 0, 0), np.uint8)
NO_PLANES.flags.writeable = False


def halved_planes(planes: np.ndarray, region: np.ndarray) -> np.ndarray:
    """Returns planes (C, h, w) a level coarser: each pixel has the values of the first of its four that lies in the
    region, bool (h, w); 0 where none does."""
    if region.shape[0] & 1 or region.shape[1] & 1:
        sides = [(0, n & 1) for n in region.shape]
        region, planes = np.pad(region, sides), np.pad(planes, [(0, 0), *sides])
    out = np.zeros((len(planes), region.shape[0] // 2, region.shape[1] // 2), planes.dtype)
    for y, x in ((1, 1), (1, 0), (0, 1), (0, 0)):
        np.copyto(out, planes[:, y::2, x::2], where=region[y::2, x::2])
    return out


def counts(n: int, levels: int) -> bool:
    """Tells whether the rim counts at a level: at the finest two, which it would change all the time, what is coarser
    has told."""
    return n > 1 or n == levels - 1


def rim_of(region: np.ndarray, width: int, n: int) -> np.ndarray:
    """Returns how far inside a region, (h, w), each pixel lies at level `n`: uint8."""
    out = np.empty(region.shape, np.uint8)
    rim_distance(np.ascontiguousarray(region, np.uint8), width, n, out)
    return out


def mean_direction(planes: np.ndarray) -> int:
    """Returns the mean of directions, uint8, as one."""
    counts = np.bincount(planes.reshape(-1), minlength=256)
    angles = [2.0 * np.pi * k / 256.0 for k in range(256)]
    table = _unit(angles)
    across = sum(int(n) * int(c) for n, (c, _) in zip(counts, table, strict=True))
    down = sum(int(n) * int(s) for n, (_, s) in zip(counts, table, strict=True))
    if across == 0 and down == 0:
        return 0
    return direction(float(down), float(across))


def direction(down: float, across: float) -> int:
    """Returns where something points as a part of 256 of a turn."""
    return int(np.floor(atan2(down, across) * (128.0 / np.pi) + 0.5)) & 255


def _unit(angles: Sequence[float]) -> list[tuple[int, int]]:
    from engine.numeric.elementary import cos, sin

    return [(int(np.rint(cos(a) * 16384.0)), int(np.rint(sin(a) * 16384.0))) for a in angles]


def unit_table(count: int) -> list[tuple[int, int]]:
    """Returns the cosine and sine of each of `count` parts of a turn, times 2^14."""
    return _unit([2.0 * np.pi * k / count for k in range(count)])
