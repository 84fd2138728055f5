"""What is selected of a layer, moved: its very pixels within the layer, or shown above it, as one step."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_selecting import GROUND, seen, selected, told

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.merging import laid
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import UNMOVED
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Refusal
from engine.session.lifting.moved_part import lifted_part, part_tried
from engine.session.replay import replay
from engine.session.session import Session
from engine.texture.placed import oriented

WINDOW = Rect(-128, -128, 640, 640)  # of level 1, the finest at which anything was painted
BOX = {"do": "select", "rect": [1, 40, 30, 150, 120]}
OVAL = {"do": "select", "ellipse": [0, 20, 10, 90, 80], "feather": 5}
INK = {
    "do": "stroke",
    "points": [[10, 30], [50, 50]],
    "brush": {"radius": 12, "ink": [{"texture": "rock", "amount": 1}]},
}
TURNED = {"do": "layer", "set": "Paint", "c": [0.8, 0.6], "at": [32, -5], "selected": "cut"}

BAKED = {**TURNED, "baked": 1}


def to(x, y, **more):
    return {"do": "layer", "set": "Paint", "level": 1, "at": [x, y], "selected": "cut", **more}


def planes(painting, name="Paint", level=1, rect=WINDOW):
    out = np.zeros((4, rect.height, rect.width), np.float32)
    found = layer_planes(layers.find(painting.root, name), level, rect)
    return out if found is None else found


def raster(before, chosen, similarity):
    """The pixels of a picture after those that are chosen were moved by whole pixels, turned and mirrored."""
    out = before * (1 - chosen)
    rect = similarity.shown(WINDOW, 1, 1)
    moved = oriented(before * chosen, similarity)
    part = rect.intersect(WINDOW)
    over = np.zeros_like(before)
    over[:, *part.slices(WINDOW)] = moved[:, *part.slices(rect)]
    return over + (1 - over[3]) * out


@given(
    st.integers(-20, 60), st.integers(-20, 60), st.integers(30, 200), st.integers(0, 3), st.booleans(),
    st.integers(-120, 120), st.integers(-120, 120),
)  # fmt: skip
@settings(max_examples=4, deadline=None)
def test_what_is_moved_is_the_very_pixels_at_the_level_of_the_selection(x, y, side, turn, mirror, across, down):
    session = told(Session(GROUND), {"do": "select", "rect": [1, x, y, side, side]})
    before, chosen = planes(GROUND), session.painting.selection.part(1, WINDOW)
    if not np.any(before[3] * chosen):
        return
    command = to(across + (WINDOW.x1 if turn in (1, 2) else 0), down, turn=turn, mirror=mirror)
    told(session, command)
    similarity = c.parse(command).placing.posed(UNMOVED).similarity
    expected = raster(before, np.asarray(chosen, np.float32), similarity)
    np.testing.assert_allclose(planes(session.painting), expected, atol=2**-14)
    assert len(list(layers.walk(session.painting.root))) == len(list(layers.walk(GROUND.root)))
    told(session, {"do": "undo"})
    assert (planes(session.painting) == before).all()
    assert np.array_equal(session.painting.selection.part(1, WINDOW), chosen)


@pytest.mark.parametrize("where", [to(50, 21, turn=1), to(3, 4, levels=-1, mirror=True), BAKED])
def test_what_is_tried_looks_as_what_is_done_and_is_one_step(where):
    session = told(Session(GROUND), OVAL, {"do": "layer", "set": "Paint", "opacity": 0.5, "blend": "multiply"})
    before, steps = session.painting, session.steps.count
    command = c.parse(where)
    lifted = lifted_part(before, layers.find(before.root, "Paint"), "cut")
    tried = part_tried(before, lifted, command.placing.posed(UNMOVED))
    session.do(command)
    off = np.abs(seen(tried, 0) - seen(session.painting, 0))
    assert off.max() <= 0.03  # coarser levels than the finest follow as means
    if where is BAKED:
        assert np.abs(seen(tried, 1) - seen(session.painting, 1)).max() <= 2**-14
    assert session.steps.count == steps + 1
    told(session, {"do": "undo"})
    assert (seen(session.painting, 0) == seen(before, 0)).all()
    assert session.painting.selection is before.selection


def test_ink_that_is_moved_stays_ink_and_is_selected_where_it_goes():
    session = told(Session(GROUND), INK, {"do": "select", "rect": [0, -64, -64, 256, 256]})
    before = session.painting
    told(session, {"do": "layer", "set": "Paint", "at": [512, 256], "selected": "cut"})
    near, there = Rect(-40, -40, 360, 300), Rect(984, 472, 1384, 812)  # of level 1
    one = evaluate_sparse(layers.find(before.root, "Paint").pyramid, 1, near, None)
    other = evaluate_sparse(layers.find(session.painting.root, "Paint").pyramid, 1, there, None)
    np.testing.assert_allclose(one.data[:4], other.data[:4], atol=2**-14)
    assert [len(found.inks) for found in (one, other)] == [1, 1]
    moved, was = (p.selection.part(1, rect) for p, rect in ((session.painting, there), (before, near)))
    assert np.array_equal(moved, was)


def test_what_is_turned_by_parts_is_shown_above_and_can_be_baked(tmp_path):
    session = told(Session(GROUND), OVAL, TURNED)
    names = [node.name for node in layers.walk(session.painting.root)]
    assert names[-3:] == ["Paint", "Paint part (source)", "Paint part"]
    assert session.painting.active == "Paint part"
    assert [node.name for node in layers.walk(session.steps.root)] == names
    assert isinstance(layers.find(session.painting.root, "Paint part"), Placement)
    middle = session.painting.selection.part(0, Rect(47, 73, 49, 75))  # where the middle of the oval is turned to
    assert np.all(np.asarray(middle) > 0.9)
    told(session, {"do": "layer", "bake": "Paint part"})
    assert planes(session.painting, "Paint part")[3].any()


@given(
    st.lists(
        st.sampled_from([to(30, 5), to(0, 0, turn=2, selected="copy"), TURNED, BAKED, BOX]), min_size=1, max_size=3
    )
)
@settings(max_examples=3, deadline=None)
def test_a_replay_and_a_saved_file_show_the_same(commands):
    session = Session()
    told(session, {"do": "layer", "add": "Paint"}, {"do": "stroke", "points": [[20, 10], [120, 90]]}, OVAL)
    for command in commands:
        try:
            told(session, command)
        except Refusal as refused:
            assert "no paint where it is selected" in str(refused)  # noqa: PT017
    shown = seen(session.painting, 0)
    again = replay(session.recording()).painting
    assert (seen(again, 0) == shown).all()
    assert np.array_equal(selected(again, 0), selected(session.painting, 0))


def test_what_is_turned_by_parts_is_laid_into_its_layer_and_painted_on():
    session = told(Session(GROUND), OVAL, BAKED)
    assert [node.name for node in layers.walk(session.painting.root)] == [
        node.name for node in layers.walk(GROUND.root)
    ]
    assert session.painting.active == GROUND.active
    laid = planes(session.painting)
    told(session, {"do": "stroke", "points": [[48, 74], [60, 90]], "layer": "Paint"})
    assert np.abs(planes(session.painting) - laid).max() > 0.1
    told(session, {"do": "undo"}, {"do": "undo"})
    assert (planes(session.painting) == planes(GROUND)).all()


def test_a_level_coarser_than_all_paint_is_refused():
    session = told(Session(GROUND), OVAL)
    with pytest.raises(Refusal, match="where its paint begins"):
        session.do(c.parse({**BAKED, "baked": -60}))


def test_a_moved_part_is_saved_and_opened(tmp_path):
    session = told(Session(GROUND), OVAL, to(33, 7, mirror=True), {**BAKED, "selected": "copy"})
    place = tmp_path / "moved.ora"
    save(place, Snapshot(session.painting))
    opened = open_painting(place).painting
    assert (seen(opened, 0) == seen(session.painting, 0)).all()
    assert np.array_equal(selected(opened, 0), selected(session.painting, 0))


def test_a_copy_leaves_what_is_there():
    session = told(Session(GROUND), BOX, to(900, 0, selected="copy"))
    before = planes(GROUND)
    assert (planes(session.painting) == before).all()
    moved = planes(session.painting, rect=Rect(WINDOW.x0 + 900, WINDOW.y0, WINDOW.x1 + 900, WINDOW.y1))
    chosen = np.asarray(Session(GROUND).do(c.parse(BOX)).selection.part(1, WINDOW))
    np.testing.assert_allclose(moved, before * chosen, atol=2**-14)


CLIPPED = (
    {"do": "layer", "add": "Shade"},
    {"do": "stroke", "points": [[0, 60], [150, 60]], "brush": {"radius": 30, "colour": "#102030"}},
    {"do": "layer", "set": "Shade", "clip": True},
    {"do": "layer", "add": "Top"},
)


def test_what_is_clipped_to_a_layer_stays_so_when_a_part_is_laid_above():
    far = {**TURNED, "at": [4000, 0]}  # nothing of it is seen in the window
    session = told(Session(GROUND), *CLIPPED, BOX, far)
    alone = told(Session(GROUND), *CLIPPED, BOX, {"do": "layer", "clear": "Paint"})
    assert (seen(session.painting, 1) == seen(alone.painting, 1)).all()
    names = [node.name for node in session.painting.root.children]
    assert names[names.index("Paint") :] == ["Paint", "Shade", "Paint part (source)", "Paint part", "Top"]


def test_what_has_too_many_tiles_is_merged_level_by_level(monkeypatch):
    few = told(Session(GROUND), BOX, to(12, 9)).painting
    monkeypatch.setattr(laid, "_MOST_LAID", 1)
    session = told(Session(GROUND), BOX, to(12, 9))
    np.testing.assert_allclose(planes(session.painting), planes(few), atol=2**-13)


@pytest.mark.parametrize(
    ("before", "command", "why"),
    [
        ({"do": "select", "rect": [0, 5000, 5000, 9, 9]}, to(1, 1), "found no paint where it is selected"),
        ({"do": "select", "none": True}, to(1, 1), "found nothing selected"),
        ({"do": "layer", "set": "Paint", "locked": True}, to(1, 1), "found it locked"),
        ({"do": "layer", "add": "G", "kind": "group"}, {**to(1, 1), "set": "G"}, "found no layer of paint"),
        (
            {"do": "layer", "add": "P", "kind": "placement", "of": "Paint"},
            {**to(1, 1), "set": "P"},
            "no layer of paint",
        ),
    ],
)
def test_what_cannot_be_moved_is_refused(before, command, why):
    session = told(Session(GROUND), OVAL, before)
    painting = session.painting
    with pytest.raises(Refusal, match=why):
        session.do(c.parse(command))
    assert session.painting is painting


def test_it_goes_only_with_a_place():
    with pytest.raises(FieldError, match="selected"):
        c.parse({"do": "layer", "set": "Paint", "selected": "cut", "opacity": 0.5})
    with pytest.raises(FieldError, match="baked"):
        c.parse({"do": "layer", "set": "Paint", "at": [3, 4], "baked": 2})
