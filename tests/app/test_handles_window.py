"""What is moved, scaled and turned by the handles of its box, in the real window."""

import json
import math

import numpy as np
import pytest

from engine.canvas import layers
from engine.canvas.placing.placement import Placement
from engine.studio.filing.documents import opened

pytestmark = pytest.mark.window
CORNERS = "top left", "top right", "bottom right", "bottom left"


@pytest.fixture
def app(with_stroke):
    return with_stroke


def handles(app):
    """Where the corners of the box are."""
    app.park()
    app.until_rest()
    return [app.at(f"{name} handle") for name in CORNERS]


def nodes(app, folder):
    app.save_as(folder / "moved.ora")
    return {node.name: node for node in layers.walk(opened(folder / "moved.ora").painting.root)}


def test_a_corner_scales_by_powers_of_two_exactly_and_escape_gives_it_up(app, tmp_path):
    painted = app.canvas()
    app.keys("v")
    (x0, y0), _, (x1, y1), _ = handles(app)
    app.drag((x1, y1), ((x0 + x1) // 2, (y0 + y1) // 2))
    app.box("exactly 50 %")
    app.keys("Escape")
    app.until_gone("exactly 50 %")
    app.do("mouseup", 1)
    app.keys("b")
    assert app.comes_to(painted)
    app.keys("v")
    handles(app)
    app.drag((x1, y1), ((x0 + x1) // 2, (y0 + y1) // 2))
    app.do("mouseup", 1)
    app.keys("b")
    app.canvas_unlike(painted)
    found = nodes(app, tmp_path)
    assert list(found) == ["Layer 1"]  # it is paint still, half as large
    app.keys("ctrl+z")
    assert app.comes_to(painted)


@pytest.mark.nightly
def test_the_handle_above_turns_as_one_step_and_back_to_nothing_lost(app, tmp_path):
    painted = app.canvas()
    app.keys("v")
    a, b, c, d = handles(app)
    middle = (a[0] + c[0]) // 2, (a[1] + c[1]) // 2
    up = app.at("turn handle")
    app.drag(up, (middle[0] + 60, middle[1] - 50))
    dragged = app.settled()[60:740, 270:970].astype(int)  # by the card
    app.do("mouseup", 1)
    assert np.abs(app.settled()[60:740, 270:970] - dragged).mean() < 0.5
    turned = handles(app)
    assert math.dist(turned[1], b) > 20
    app.keys("b")
    once = app.canvas_unlike(painted)
    app.keys("v")
    handles(app)
    app.drag(app.at("turn handle"), (middle[0], middle[1] - 70))
    app.box("exactly 0°")
    app.do("mouseup", 1)
    np.testing.assert_allclose(handles(app), [a, b, c, d], atol=1)
    app.keys("b")
    assert app.comes_to(painted)
    placement = nodes(app, tmp_path)["Layer 1"]
    assert isinstance(placement, Placement)
    assert placement.pose.similarity.quarter == (0, 0)
    app.keys("ctrl+z")
    assert app.comes_to(once)
    app.keys("ctrl+z")
    assert app.comes_to(painted)


@pytest.mark.nightly
def test_alt_drags_a_copy_in_one_step(app, tmp_path):
    painted = app.canvas()
    app.keys("v")
    handles(app)
    app.do("keydown", "alt")
    app.drag((500, 357), (580, 437))
    app.box("exactly copy  +80, +80 px")
    app.do("mouseup", 1)
    app.do("keyup", "alt")
    app.box("Layer 1 copy 1")
    app.keys("b")
    both = app.canvas_unlike(painted)
    by = np.abs(both - painted).max(axis=2) > 20
    old = np.abs(painted - np.roll(painted, (40, 40), axis=(0, 1))).max(axis=2) > 20
    assert by[: 380 - 60].sum() < 0.2 * old.sum()  # what was there is there
    app.keys("ctrl+z")
    assert app.comes_to(painted)
    app.until_gone("Layer 1 copy 1")


def test_a_stroke_on_what_is_shown_again_paints_its_source_too(app):
    once = app.canvas()
    app.click("show_again")
    app.box("Layer 1 again")
    app.canvas_unlike(once)
    app.keys("v")  # it is chosen already
    handles(app)
    app.drag((500, 300), (500, 480))
    app.do("mouseup", 1)
    app.keys("b")
    apart = app.canvas()
    app.stroke((600, 600), (700, 620))
    both = app.canvas_unlike(apart)
    rows = np.flatnonzero((np.abs(both - apart).max(axis=2) > 40).any(axis=1)) + 60
    assert {row for row in rows if row > 590}
    assert {row for row in rows if row < 500}  # on the layer itself
    app.keys("ctrl+z")
    assert app.comes_to(apart)


@pytest.mark.nightly
def test_painting_on_what_is_turned_offers_what_can_be_done(app):
    app.keys("v")
    handles(app)
    x, y = app.at("turn handle")
    app.drag((x, y), (x + 60, y + 20))
    app.do("mouseup", 1)
    app.keys("b")
    app.box("source")  # of its row: the card shows it turned before the engine has done it
    turned = app.canvas()
    app.stroke((600, 500), (700, 520))
    app.box("Go to source", "status")
    app.click("Make independent", "status")
    app.click("Make independent", "Make independent")  # its rock goes no finer then
    app.until_gone("source")
    app.settled()
    app.stroke((600, 500), (700, 520))
    app.canvas_unlike(turned)


@pytest.mark.nightly
def test_numbers_are_typed_and_what_is_turned_back_or_mirrored_twice_is_as_it_was(app):
    painted = app.canvas()
    app.keys("v")
    corners = handles(app)
    for typed in ("30", "0"):
        app.click("angle field")
        app.fill(typed)
        app.keys("Return")
        app.park()
        app.box("sampled" if typed == "30" else "exact")
    for name in ("mirror_layer", "mirror_layer_down"):
        for _ in range(2):
            app.click(name)
            app.settled()
    np.testing.assert_allclose(handles(app), corners, atol=1)
    app.keys("b")
    assert app.comes_to(painted)
    app.keys(*["ctrl+z"] * 4)
    assert app.comes_to(painted)
    app.keys("ctrl+z")
    app.canvas_unlike(painted)
    app.keys("ctrl+z")
    assert app.comes_to(painted)


@pytest.mark.nightly
def test_what_making_it_independent_loses_is_told_before(program, tmp_path):
    broad = {"do": "stroke", "points": [[20, 20], [800, 300], [100, 700]], "brush": {"radius": 60}}
    fine = {"do": "stroke", "level": 19, "origin": [400 << 19, 300 << 19], "points": [[5, 5], [90, 70]], "brush": {}}
    copy = {"do": "layer", "add": "Copy", "kind": "placement", "of": "Tree", "at": [10, 0], "c": [0.9, 0.3]}
    rows = {"inkfall": 2}, {"do": "layer", "add": "Tree"}, broad, fine, copy
    (tmp_path / "deep.jsonl").write_text("\n".join(map(json.dumps, rows)))
    app = program(str(tmp_path / "deep.jsonl"))
    app.click("Copy")
    seen = app.canvas()
    app.click("independent", "layers")
    app.box("Make independent", "Make independent")
    app.click("Cancel", "Make independent")
    app.until_gone("Cancel")
    app.box("source")  # it shows another layer still
    app.click("independent", "layers")
    app.click("Make independent", "Make independent")
    app.until_gone("source")  # of a row: it shows nothing else any more
    assert np.abs(app.canvas() - seen).max() <= 4
    made = nodes(app, tmp_path)["Copy"]
    assert 0 < made.pyramid.finest < 19
