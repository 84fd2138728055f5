"""A placement of a layer that wraps around is made paint as it is seen: the tile again and again, as far as the
frame."""

import numpy as np
import pytest
from test_wrapping import CELL, moved, painted, seen, stroke, wrap

from engine.numeric.address import Rect
from engine.painting import commands as c

FRAME = {"do": "frame", "rect": [-300, -100, 700, 400]}
LINES = stroke([[-24, 60], [120, 130]], radius=12, hardness=0.4), stroke([[200, 20]], radius=20, colour="#d0a030")


@pytest.mark.parametrize("members", [{"at": [40, 8]}, {"at": [64, 0], "turn": 1, "mirror": True}, {"c": [0.8, 0.6]}])
def test_within_the_frame_it_looks_as_it_did(members):
    placed = {"do": "layer", "add": "Copy", "kind": "placement", "of": "Layer 1", **members}
    session = painted(wrap(), *LINES, FRAME, placed, {"do": "layer", "set": "Layer 1", "visible": False})
    inner = Rect.at(-250, -80, 600, 330)
    before = seen(session, inner)
    assert before[3].mean() > 0.05
    for side in (inner, moved(CELL, -CELL.width, 0), moved(CELL, CELL.width, 0)):
        assert seen(session, side)[3].any()
    session.do(c.parse({"do": "layer", "bake": "Copy"}))
    np.testing.assert_array_equal(seen(session, inner), before)
    session.do(c.Undo())
    np.testing.assert_array_equal(seen(session, inner), before)
