"""Where a fill of the window may run out of sight."""

import numpy as np
import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.filling.pouring import outruns
from engine.numeric.address import Rect
from engine.painting.fill_command import Like
from engine.studio.selecting.ants_records import Ants


@pytest.mark.parametrize(
    ("contiguous", "bounded", "may"),
    [(True, None, False), (True, False, False), (True, True, True), (False, None, True)],
)
def test_it_may_where_a_selection_bounds_it_or_where_its_parts_need_not_hang_together(contiguous, bounded, may):
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    if bounded is not None:
        desk.selecting.ants = Ants(True, (), 0, Rect(0, 0, 9, 9), np.zeros((0, 4), np.float32), bounded)
    assert outruns(desk, Like((3, 4), contiguous=contiguous)) == may
