"""What the status line tells of a selection."""

import numpy as np
import pytest

from app.panels.selection_chip import chip_text
from engine.numeric.address import Rect
from engine.studio.selecting.ants_records import Ants, Measure

NO_LINES = np.empty((0, 4), np.float32)


def told(selected=True, bounded=True, measure=None):
    return chip_text(Ants(selected, (), 0, Rect(0, 0, 9, 9), NO_LINES, bounded, None, measure))


@pytest.mark.parametrize(
    ("feather", "bounded", "expected"),
    [
        (0, True, "1,240 × 800"),
        (4, True, "1,240 × 800, feather 4"),
        (4, False, "all but 1,240 × 800, feather 4"),
    ],
)
def test_its_size_and_feather_are_told(feather, bounded, expected):
    assert told(bounded=bounded, measure=Measure(3, Rect.at(-5, 7, 1240, 800), feather)) == expected


def test_nothing_is_told_of_nothing_and_all_is_called_so():
    assert chip_text(None) == told(selected=False) == ""
    assert told(bounded=False) == "All selected"
