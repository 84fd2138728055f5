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
        editable = stored.mutate()
        for place, record in stored.items():
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
