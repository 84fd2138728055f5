"""The region of an example as steps tell it: what each takes and changes, and what a recording of it means."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from plantings import blob, meadow, texture

from engine.brush.footprint import Footprint
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.painting import recording
from engine.painting.points import rounded
from engine.painting.recording import Header, Recording
from engine.session.replay import replay
from engine.session.session import Session
from engine.strokes.example_region import followed, lay, round_brush, smoothed
from engine.strokes.example_textures import exemplar_of

__all__ = ["meadow"]
HEIGHT, WIDTH = 40, 60
NONE = np.zeros((HEIGHT, WIDTH), bool)


def picture():
    made = np.zeros((4, HEIGHT, WIDTH), np.float32)
    made[3] = 1.0
    return made


def stroke(op, *points, radius=5.0):
    return {"op": op, "stroke": {"points": [list(at) for at in points], "brush": {"radius": radius, "hardness": 1.0}}}


def test_a_stroke_is_round_and_has_no_gaps():
    found = followed(NONE, [stroke("add", (10.0, 20.0), (50.0, 20.0))], picture())
    rows, columns = np.nonzero(found)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (15, 24, 5, 54)
    assert found[20, 5:55].all()
    assert not found[15, 5]  # round ends
    assert abs(found.sum() - (400 + np.pi * 25)) < 25
    assert not NONE.any()


@pytest.mark.parametrize("points", [[(-500.0, -500.0), (-400.0, -300.0)], [(1e4, 3.0)], [(-20.0, 20.0), (90.0, 20.0)]])
def test_a_stroke_may_leave_the_picture(points):
    assert followed(NONE, [stroke("add", *points)], picture()).any() == (points[0][0] == -20.0)


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.tuples(st.integers(-900, 6900), st.integers(-900, 4900)), min_size=1, max_size=12),
    st.floats(0.5, 30.0),
    st.integers(1, 5),
)
def test_a_stroke_takes_the_same_in_pieces_as_whole(places, radius, piece):
    """What is seen while the pen moves is what the recording means."""
    rows = rounded(np.array([[x / 100, y / 100, 1, 0, 0, 0] for x, y in places]))
    brush = round_brush(round(radius, 1))
    live, footprint = NONE.copy(), Footprint(brush, (0, 0))
    for start in range(0, len(rows), piece):
        lay(live, footprint, rows[start : start + piece])
    told = {
        "points": rows[:, :2].tolist(),
        "brush": {"radius": brush.radius, "hardness": 1.0, "spacing": brush.spacing},
    }
    assert np.array_equal(followed(NONE, [{"op": "add", "stroke": told}], picture()), live)


def test_ops_join_what_is_taken_to_what_was():
    left, right = stroke("replace", (20.0, 20.0)), (30.0, 20.0)
    a = followed(NONE, [left], picture())
    b = followed(NONE, [stroke("replace", right, radius=9.0)], picture())
    for op, expected in (("add", a | b), ("subtract", a & ~b), ("intersect", a & b), ("replace", b)):
        assert np.array_equal(followed(NONE, [left, stroke(op, right, radius=9.0)], picture()), expected)
    assert np.array_equal(followed(a, [{"invert": True}, {"invert": True}], picture()), a)
    assert followed(a, [{"all": True}], picture()).all()
    seen = picture()
    seen[3, :, 30:] = 0.0
    assert np.array_equal(followed(a, [{"alpha": True}], seen), seen[3] > 0)


def test_a_colour_takes_what_is_alike():
    seen = picture()
    for columns, red in ((slice(0, 20), 200), (slice(20, 30), 210), (slice(30, 50), 0), (slice(50, 60), 200)):
        seen[0, :, columns] = np.float32(red / 255)

    def taken(tolerance, contiguous):
        like = {"at": [5, 5], "tolerance": tolerance, "contiguous": contiguous}
        return followed(~NONE, [{"op": "subtract", "like": like}], seen)[0]

    assert not taken(0.01, True)[:20].any()
    assert taken(0.01, True)[20:].all()
    assert np.array_equal(taken(0.05, True), np.arange(WIDTH) >= 30)
    assert np.array_equal(taken(0.05, False), (np.arange(WIDTH) >= 30) & (np.arange(WIDTH) < 50))


def test_smoothing_takes_specks_and_pinholes_and_keeps_the_rest():
    inside = np.zeros((60, 60), bool)
    inside[10:50, 10:50] = True
    clean = inside.copy()
    inside[30, 30] = False
    inside[3, 3] = True
    found = smoothed(inside)
    assert found[30, 30]
    assert not found[3, 3]
    assert (found != clean).sum() < 40  # corners
    assert smoothed(np.ones((5, 9), bool)).all()
    assert not smoothed(np.zeros((5, 9), bool)).any()


@pytest.mark.parametrize(
    ("step", "told"),
    [
        (7, "region[0]: found 7, expected an object"),
        ({}, "region[0]: found"),
        ({"all": True, "invert": True}, "region[0]: found"),
        ({"all": 1}, "region[0].all: found 1"),
        ({"op": "xor", "all": True}, "region[0].op: found 'xor'"),
        ({"like": {"at": [60, 3]}}, "region[0].like.at: found"),
        ({"like": {"at": [5, 3], "tolerance": 2}}, "region[0].like.tolerance: found 2"),
        ({"stroke": 3}, "region[0].stroke: found 3"),
        ({"stroke": {"level": 2, "points": [[0, 0]]}}, "region[0].stroke.level: found 2"),
    ],
)
def test_what_is_no_step_is_told(step, told):
    with pytest.raises(FieldError) as fault:
        followed(NONE, [step], picture())
    assert str(fault.value).replace('"', "'").startswith(told)
    assert "\n" not in str(fault.value)


def test_a_recording_tells_the_region_and_means_the_same_without_the_mask(meadow, tmp_path):
    Image.fromarray(blob(1)).save(tmp_path / "x.png")
    steps = [{"all": True}, stroke("subtract", (9.0, 9.0), (30.0, 20.0)), {"smooth": True}]
    command = texture("t", "x.png", region=steps)
    session = Session(folder=tmp_path)
    session.do(command)
    made = session.painting.textures["t"]
    expected = followed(NONE[:, :40], steps, np.zeros((4, 40, 40), np.float32))
    assert np.array_equal(exemplar_of(made).mask, expected)
    assert 0 < expected.sum() < expected.size
    recording.write(Recording(Header(), tuple(session.log)), tmp_path / "r.jsonl")
    head, line = (tmp_path / "r.jsonl").read_text().splitlines()
    assert json.loads(head)["inkfall"] == 2
    assert json.loads(line)["mask_sha"] == made.mask.sha
    again = replay(recording.read(tmp_path / "r.jsonl")).painting.textures["t"]
    assert again.mask.sha == made.mask.sha
    (tmp_path / "r.jsonl").write_text(head + "\n" + line.replace('"smooth":true', '"smooth":false') + "\n")
    with pytest.raises(FileError, match="is not what was there when it was recorded"):
        replay(recording.read(tmp_path / "r.jsonl"))


def test_a_recording_without_regions_says_version_1(tmp_path):
    recording.write(Recording(Header(), (texture("t", "x.png", mask="m.png"),)), tmp_path / "r.jsonl")
    assert json.loads((tmp_path / "r.jsonl").read_text().splitlines()[0])["inkfall"] == 1
