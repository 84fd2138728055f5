"""The frame by its handles: whole pixels, what lies opposite stays, and its ratio where that is wanted."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.desk.framing.frame_state import dragged
from app.desk.moving.box import INSIDE, SCALES
from engine.numeric.address import Rect

FRAME = Rect.at(10, -20, 400, 300)
moves = st.integers(-900, 900)


@given(st.sampled_from([*SCALES]), moves, moves, st.booleans())
def test_a_handle_takes_its_sides_along_and_leaves_those_opposite(grip, x, y, keep):
    found, (across, down) = dragged(FRAME, grip, x, y, keep), SCALES[grip]
    assert found.width >= 1
    assert found.height >= 1
    assert across <= 0 or found.x0 == FRAME.x0
    assert across >= 0 or found.x1 == FRAME.x1
    assert down <= 0 or found.y0 == FRAME.y0
    assert down >= 0 or found.y1 == FRAME.y1
    if keep:
        assert abs(found.width * 3 - found.height * 4) <= 4
    else:
        assert found.width == max(1, FRAME.width + across * x) if across else FRAME.width
        assert found.height == max(1, FRAME.height + down * y) if down else FRAME.height


@given(moves, moves)
def test_within_it_all_of_it_moves(x, y):
    assert dragged(FRAME, INSIDE, x, y) == Rect.at(10 + x, -20 + y, 400, 300)


@pytest.mark.window
def test_the_frame_is_dragged_in_the_window_and_no_paint_is_lost(program):
    app = program()
    app.settled()
    empty = app.canvas()
    app.stroke(*((380 + 12 * i, 400) for i in range(24)))
    painted = app.canvas_unlike(empty)
    app.do("mousemove", *app.at("move"), "sleep", 0.3, "click", 3)
    app.click("tool frame_tool")
    app.box("frame left")
    left, right = app.at("frame left"), app.at("frame right")
    app.stroke(left, ((left[0] + 300), left[1]))
    app.until(lambda screen: abs(app.at("frame left")[0] - left[0] - 300) < 8)
    assert app.at("frame right") == right
    app.keys("ctrl+z")
    app.click("To paint")
    app.until(lambda screen: app.at("frame top left")[0] > left[0] + 50)
    assert 340 < app.at("frame top left")[0] < 380
    assert 656 < app.at("frame bottom right")[0] < 696
    app.keys("ctrl+z", "Return")  # which ends the tool
    assert app.comes_to(painted)
