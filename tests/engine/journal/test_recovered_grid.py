"""A painting of the coarse grid that was not closed is recovered on it."""

import numpy as np
from test_answers import draw
from test_killed import pixels
from test_recovering import left, painter

from engine.brush.settings import Brush
from engine.journal import entries
from engine.numeric.address import Rect
from engine.painting.recording import Header, Recording
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio.filing.recovering import recovered

FRAME = Rect(0, 0, 96, 64)


def test_the_grid_of_an_entry_is_that_of_its_painting(tmp_path):
    one = painter(tmp_path)
    one.post(q.New(FRAME, 3, grid=12))
    draw(one, 30, 1, Brush(radius=20.0, opacity=0.02))
    draw(one, 30, 2, Brush(radius=12.0, hardness=0.2))
    left(one)
    found = [recovered(entry.folder).session for entry in entries.listed(tmp_path)]
    (session,) = [each for each in found if each.log]
    assert session.painting.grid == session.recording().header.grid == 12
    header = Header(FRAME, 3, arithmetic=session.painting.arithmetic, grid=12)
    wanted = replay(Recording(header, tuple(session.log))).painting
    assert np.array_equal(pixels(session.painting), pixels(wanted))
    assert all(layer.pyramid.grid == 12 for layer in session.painting.root.children)
