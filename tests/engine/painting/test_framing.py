"""Another frame, and what is cleared: nothing is lost by the one, and nothing outside it by the other."""

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import Header, version_of
from engine.painting.value import first_painting
from engine.session.replay import replay
from engine.session.session import Session

FIRST = Rect(0, 0, 90, 70)
WINDOW = Rect(-30, -30, 120, 100)


def stroke(level=0, **brush):
    points = [[-10, -10], [60 * 2.0**level, 50 * 2.0**level]]
    return {"do": "stroke", "level": level, "points": points, "brush": {"radius": 12, "colour": "#204080", **brush}}


def done(*commands):
    session = Session(first_painting(Header(FIRST)))
    for command in commands:
        session.do(c.parse(command))
    return session


def picture(painting, level=0):
    return composite(painting.root, level, WINDOW.zoomed(level), lambda one, at, rect: layer_planes(one, at, rect))


def test_another_frame_changes_no_pixel_and_is_undone():
    session = done(stroke())
    before = picture(session.painting)
    session.do(c.parse({"do": "frame", "rect": [-20, 5, 300, 20]}))
    assert session.painting.frame == Rect.at(-20, 5, 300, 20)
    np.testing.assert_array_equal(picture(session.painting), before)
    session.do(c.parse({"do": "undo"}))
    assert session.painting.frame == FIRST
    session.do(c.parse({"do": "redo"}))
    assert session.painting.frame == Rect.at(-20, 5, 300, 20)


def test_its_recording_begins_with_the_first_frame_also_from_a_file(tmp_path):
    session = done(
        stroke(), {"do": "frame", "rect": [0, 0, 40, 30]}, stroke(1), {"do": "frame", "rect": [5, 5, 40, 30]}
    )
    assert session.recording().header.frame == FIRST
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    found = open_painting(tmp_path / "a.ora")
    assert found.painting.frame == Rect.at(5, 5, 40, 30)
    again = Session(found.painting, log=found.recording.commands)
    again.do(c.parse({"do": "frame", "rect": [0, 0, 7, 7]}))
    assert again.recording().header.frame == FIRST
    assert again.base.frame == FIRST
    played = replay(again.recording()).painting
    assert played.frame == Rect.at(0, 0, 7, 7)
    np.testing.assert_array_equal(picture(played), picture(again.painting))
    assert version_of(c.parse({"do": "frame", "rect": [0, 0, 7, 7]})) == 2


@pytest.mark.parametrize("rect", [[0, 0, 0, 5], [0, 0, 5], [0, 0, 5, 1 << 41], [0.5, 0, 5, 5], None])
def test_what_is_no_frame_is_refused(rect):
    with pytest.raises(FieldError, match="rect"):
        c.parse({"do": "frame", "rect": rect})


def test_what_lies_outside_the_frame_is_taken_off_and_nothing_inside():
    session = done(
        stroke(), {"do": "layer", "add": "top"}, stroke(2), stroke(-2), {"do": "frame", "rect": [10, 8, 40, 30]}
    )
    before = {level: picture(session.painting, level) for level in (0, 2)}
    session.do(c.parse({"do": "layer", "clear": None, "outside": True}))
    frame = session.painting.frame
    for level, pixels in before.items():
        rows, columns = frame.zoomed(level).grown(-8 << level if level else 0).slices(WINDOW.zoomed(level))
        after = picture(session.painting, level)
        if level == 0:
            np.testing.assert_array_equal(after[:, rows, columns], pixels[:, rows, columns])
            after[:, rows, columns] = 0
            assert not after.any()
        else:
            np.testing.assert_array_equal(after[:, rows, columns], pixels[:, rows, columns])
    session.do(c.parse({"do": "undo"}))
    np.testing.assert_array_equal(picture(session.painting, 2), before[2])


@pytest.mark.parametrize("invert", [False, True])
def test_of_a_selection_only_what_is_selected_is_cleared(invert):
    turn = [{"do": "select", "invert": True}] if invert else []
    session = done(stroke(), stroke(1), {"do": "select", "rect": [0, 10, 8, 20, 18]}, *turn)
    before = picture(session.painting)
    session.do(c.parse({"do": "layer", "clear": "Layer 1"}))
    after = picture(session.painting)
    inside = np.zeros(before.shape[1:], bool)
    inside[Rect.at(10, 8, 20, 18).slices(WINDOW)] = True
    cleared = inside ^ invert
    assert before[3][cleared].any()
    assert not after[:, cleared].any()
    np.testing.assert_array_equal(after[:, ~cleared], before[:, ~cleared])
