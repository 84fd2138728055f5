"""Numbers typed for what is moved: exact to their last digit, and nothing else is taken for one."""

from dataclasses import replace
from fractions import Fraction

import pytest

from app.desk.known import Known
from app.desk.moving.move_state import MoveState
from app.panels.controls.number_field import typed_number
from engine.numeric.address import Rect
from engine.studio.layer_rows import LayerRow
from engine.studio.moving.move_requests import Extent
from engine.studio.results import Scene


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("30°", 30), (" 50 %", 50), ("−12", -12), ("12,5", Fraction(25, 2)), ("+7.", 7), (str(1 << 4000), 1 << 4000),
        *((bad, None) for bad in ("", "e", "1e9", "nan", "inf", "1/0", "--1", "0x10", "9" * 2501, "9" * 2499)),
    ],
)  # fmt: skip
def test_a_number_is_taken_as_it_is_typed(text, value):
    assert typed_number(text) == value


def test_what_waits_is_done_though_another_scene_tells_the_same():
    """After an undo and another step a scene may equal the one before; paint lies elsewhere all the same."""
    state, posted, done = MoveState(), [], []
    row = LayerRow("Sky", False, 0, None, 0, 1.0, True, "src-over", False, False)
    scenes = [Scene(Rect(0, 0, 9, 9), (row,), "Sky", True, False, True, None) for _ in range(2)]
    assert scenes[0] == scenes[1]
    for scene in scenes:
        known = replace(Known(), scene=scene)
        state.wants(posted.append, known, 0)
        state.wants(posted.append, known, 0)
    assert len(posted) == 2
    state.sure(known, lambda: done.append(1))
    state.told(Extent("Sky", None))
    state.sure(known, lambda: done.append(2))
    assert done == [1, 2]
