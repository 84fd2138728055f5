"""The level of which pixels what is turned or scaled by parts becomes: it loses nothing where that can be."""

import pytest

from app.desk.moving.laid_level import LaidLevel, laid_level
from engine.canvas.placing.pose import Pose, SourcePart
from engine.numeric.address import Rect
from engine.studio.moving.move_requests import Extent

SMALL = Extent("Sky", SourcePart(2, Rect(0, 0, 400, 300)), True, 2)
LARGE = Extent("Sky", SourcePart(-4, Rect(0, 0, 2000, 2000)), True, 5)


@pytest.mark.parametrize(
    ("c", "levels", "seen", "level"),
    [
        ((0.8, 0.6), 0, 0, 2),  # as fine as it was painted
        ((0.8, 0.6), 0, 5, 5),  # as fine as it is seen
        ((1.3, 0.0), 0, 0, 2),  # larger: pixel for pixel of the source, or more
        ((0.75, 0.0), 0, 0, 3),  # smaller: the next finer level holds all
        ((0.8, 0.6), -2, 0, 4),
        ((0.8, 0.6), 3, -3, -1),
    ],
)
def test_all_that_is_painted_and_seen_is_held(c, levels, seen, level):
    assert laid_level(SMALL, Pose(turned=c, levels=levels), seen) == LaidLevel(level, False)


def test_what_is_too_large_loses_its_finest_detail_and_that_is_told():
    found = laid_level(LARGE, Pose(turned=(0.8, 0.6)), -4)
    assert found is not None
    assert found.loses
    assert -4 <= found.level < 5


@pytest.mark.parametrize("pose", [Pose(at=(3, 4)), Pose(turn=1, levels=-3), Pose(mirror=True)])
def test_what_goes_exactly_has_none(pose):
    assert laid_level(SMALL, pose, 0) is None
