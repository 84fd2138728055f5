"""How far layers, groups and placements reach: to the pixel, wherever and however deep they were painted."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio.moving.move_requests import AskExtent, Extent
from engine.studio.moving.reaching import FOLLOWED, reach_of, trimmed
from engine.studio.studio import Studio


def stroke(x, y, level=0, length=40, radius=8):
    brush = {"radius": radius, "colour": "#306080", "hardness": 1}
    return {"do": "stroke", "level": level, "origin": [x, y], "points": [[0, 0], [length, 9]], "brush": brush}


def painted(*commands):
    session = Session()
    for command in commands:
        session.do(c.parse(command))
    return session


def found(session, name="Layer 1", level=0):
    return told(reach_of(session.painting, name, level, session.cache))


def told(work):
    while True:
        try:
            next(work)
        except StopIteration as end:
            return end.value


def bounds(session, name, level, rect):
    """The same by looking at every pixel of a rectangle that holds it."""
    root = layers.alone(layers.find(session.painting.root, name), session.painting.root)
    rows, columns = np.nonzero(composite(root, level, rect, layer_planes)[3])
    return Rect(
        rect.x0 + int(columns.min()), rect.y0 + int(rows.min()),
        rect.x0 + int(columns.max()) + 1, rect.y0 + int(rows.max()) + 1,
    )  # fmt: skip


@settings(deadline=None, max_examples=8)
@given(st.integers(-300, 300), st.integers(-300, 300), st.integers(0, 2))
def test_paint_is_held_to_the_pixel(x, y, level):
    session = painted(stroke(x, y), stroke(-40, 90))
    around = Rect(-400, -400, 400, 450).zoomed(level)
    assert found(session, level=level) == SourcePart(level, bounds(session, "Layer 1", level, around))


@pytest.mark.parametrize("level", [40, 300])
def test_paint_far_and_deep_is_held_to_the_pixel(level):
    x, y = 5 << level, -(3 << level)
    session = painted(stroke(x, y, level))
    part = found(session, level=level)
    assert part == SourcePart(level, bounds(session, "Layer 1", level, Rect.at(x - 99, y - 99, 300, 300)))
    coarse = found(session, level=level - 4)
    assert coarse.level == level - 4
    assert part.rect.zoomed(-4).grown(2).union(coarse.rect) == part.rect.zoomed(-4).grown(2)


def test_what_is_large_is_told_coarsely():
    session = painted(stroke(0, 0), stroke(1 << 40, 1 << 40, 30))
    part = found(session, level=30)
    assert max(part.rect.width, part.rect.height) << 30 - part.level >= 1 << 31 - 1
    assert part.level < 30 - 10
    session = painted(stroke(0, 0, length=900))
    assert found(session, level=50).level > 0
    assert max(found(session, level=50).rect[2:]) < 2 * FOLLOWED


def test_erased_paint_holds_nothing():
    session = painted(stroke(20, 30))
    erased = stroke(20, 30, radius=40)
    erased["brush"]["mode"] = "erase"
    session.do(c.parse(erased))
    assert found(session).rect.empty


def test_a_placement_is_told_in_the_places_of_its_source_and_a_group_by_all_that_it_shows():
    session = painted(
        stroke(20, 30),
        {"do": "layer", "add": "Copy", "kind": "placement", "of": "Layer 1", "at": [300, 0], "turn": 1},
        {"do": "layer", "add": "Group", "kind": "group"},
        {"do": "layer", "move": "Copy", "to": 0, "group": "Group"},
        {"do": "layer", "add": "Again", "kind": "placement", "of": "Group", "c": [0.8, 0.6]},
    )
    own = found(session)
    assert found(session, "Copy") == own
    turned = bounds(session, "Group", 0, Rect(0, -200, 400, 300))
    assert found(session, "Group").rect == turned
    assert found(session, "Again").rect == turned
    session.do(c.parse({"do": "layer", "set": "Copy", "rect": [0, 0, 0, 50, 60]}))
    assert found(session, "Copy") == SourcePart(0, Rect(0, 0, 50, 60))


@given(st.data())
def test_trimming_finds_what_is_filled(data):
    whole = Rect(-150, 40, 150, 240)
    spots = data.draw(st.lists(st.tuples(st.integers(-150, 149), st.integers(40, 239)), max_size=4))
    field = np.zeros((200, 300), bool)
    for x, y in spots:
        field[y - 40, x + 150] = True
    held = told(trimmed(whole, lambda rect: field[rect.slices(whole)]))
    if not spots:
        assert held.empty
        return
    xs, ys = zip(*spots, strict=True)
    assert held == Rect(min(xs), min(ys), max(xs) + 1, max(ys) + 1)


def test_the_window_is_told():
    sent = []
    studio = Studio(sent.append, lambda request: None)
    studio.easel.show(painted(stroke(20, 30)), None)
    for name in ("Layer 1", "nobody"):
        studio.do(AskExtent(name, 0))
        while studio.step():
            pass
    assert [one for one in sent if isinstance(one, Extent)] == [
        Extent("Layer 1", found(painted(stroke(20, 30)))),
        Extent("nobody", None),
    ]


def test_thousands_of_placements_in_one_another_are_taken_hold_of_and_baked():
    session = painted(stroke(10, 20))
    root, poses = session.painting.root, (Pose(at=(3, 1), mirror=True), Pose(at=(3, -1), mirror=True))
    source = layers.find(root, "Layer 1")
    chain = (
        Placement(100 + n, f"p{n}", visible=False, of=99 + n if n else source.id, pose=poses[n % 2])
        for n in range(2000)
    )
    session = Session(replace(session.painting, root=replace(root, children=(*root.children, *chain))))
    held, shown = found(session, "p1999"), bounds(session, "p1999", 0, Rect(-99, -99, 99, 99))
    assert poses[1].similarity.shown(held.rect, 0, 0) == shown
    session.do(c.parse({"do": "layer", "bake": "p1999"}))
    assert found(session, "p1999") == SourcePart(0, shown)


def test_a_layer_of_nothing_but_a_mask_reaches_as_far_as_that_and_goes_where_it_is_moved():
    session = painted(
        {"do": "layer", "add": "veil"},
        {"do": "select", "rect": [0, 10, 20, 50, 30]},
        {"do": "layer", "set": "veil", "mask": True},
    )
    assert found(session, "veil") == SourcePart(0, Rect(10, 20, 60, 50))
    session.do(c.parse({"do": "layer", "set": "veil", "at": [7, -5]}))
    assert found(session, "veil") == SourcePart(0, Rect(17, 15, 67, 45))
