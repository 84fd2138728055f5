"""The level of which pixels what is selected becomes where it is laid into its layer, turned or scaled by parts."""

from __future__ import annotations

from typing import NamedTuple

from engine.canvas.placing.pose import Pose
from engine.numeric.address import TILE
from engine.numeric.similarity import Similarity
from engine.studio.moving.move_requests import Extent

_MOST = (1 << 24) // TILE**2  # tiles that are laid at once
_DENSER = 19  # of 16: from so many pixels of a source for one that shows it on, some of it is lost


class LaidLevel(NamedTuple):
    """`loses`: some of the paint is finer."""

    level: int
    loses: bool


def laid_level(extent: Extent | None, pose: Pose, seen: int) -> LaidLevel | None:
    """Returns the level for what reaches so far, in a pose that is seen at a level: that, or a finer one that holds all
    that is painted, if it has not too many tiles.  None where it is laid exactly, or that is not known."""
    similarity = pose.similarity
    if similarity.quarter is not None or extent is None or extent.part is None or extent.finest is None:
        return None
    whole = extent.finest - similarity.like_levels + _denser(similarity)
    level, part = max(whole, seen), extent.part
    while similarity.shown(part.rect, part.level, level).area > _MOST * TILE**2:
        level -= 1
    return LaidLevel(level, level < whole)


def _denser(similarity: Similarity) -> int:
    """Returns 1 where the source's level of like density has more pixels than what shows it, else 0."""
    n, e = similarity.squared
    by = e + 2 * similarity.like_levels  # there are 2^by / n of them for each
    return int(_DENSER**2 * n << max(-by, 0) < 256 << max(by, 0))
