"""Fold: apply every attenuation that waits.  No value at any level changes; nothing waits any more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engine.canvas.attenuate import effective
from engine.canvas.compact import compact
from engine.canvas.store import Pyramid
from engine.numeric.address import TileKey


def fold(pyramid: Pyramid) -> Pyramid:
    """Returns the same values without pending attenuations: what a file stores.  The past of `pyramid` is kept."""
    levels = pyramid.levels
    for level, stored in pyramid.levels.items():
        if not (places := _places(pyramid, level)):
            continue
        editable = stored.mutate()
        for place in places:
            record = stored[place]
            settled = effective(pyramid, TileKey(level, *place), record)
            if settled is record:
                continue
            smaller = compact(settled.rect, settled.data.astype(np.int32), settled.inks, pyramid.depth)
            if smaller is None:
                editable.pop(place)
            else:
                editable.set(place, smaller)
        finished = editable.finish()
        levels = levels.set(level, finished) if len(finished) else levels.delete(level)
    return replace(pyramid, levels=levels, settled=pyramid.depth, waits=None)


def _places(pyramid: Pyramid, level: int) -> set[tuple[int, int]]:
    """Returns the places of a level's records that any attenuation meets."""
    found: set[tuple[int, int]] = set()
    for waiting in pyramid.waiting():
        if waiting.change.level < level:
            found.update((key.x, key.y) for key, _ in pyramid.records(level, waiting.change.reach(level)))
    return found
