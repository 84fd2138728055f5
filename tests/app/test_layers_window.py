"""The list of layers in the real window."""

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.canvas import layers

pytestmark = pytest.mark.window


def test_the_tooltip_of_a_layer_covers_no_row(program):
    app = program()
    app.settled()
    for name in ("Layer 1", "Layer 2", "Layer 3"):
        app.click("add_layer")
        app.box(name)
    rows = [app.part(name) for name in ("Layer 2", "Layer 1")]  # below the one that is pointed at
    left = app.part("eye")[1].start
    merge, remove = app.box("merge_down"), app.box("remove")
    assert merge[2] <= remove[0], "the buttons below the list lie upon one another"
    assert remove[2] - remove[0] == merge[2] - merge[0], "the button that deletes is cut off by the end of the screen"
    column = slice(rows[0][0].start, 730), slice(left, 1280)
    still = app.parked()
    for over in ("Layer 3", "eye"):
        app.move_to(app.at(over))
        app.box("tooltip")
        pointed = app.settled().astype(int)
        app.box("tooltip")
        assert np.array_equal(pointed[column], still[column]), f"the tooltip of {over} covers what is below"


def test_a_stroke_on_a_hidden_layer_is_told_and_the_layer_shown_at_a_click(program):
    app = program()
    empty = app.canvas()
    app.click("add_layer")
    app.box("Layer 1")
    eye, at = app.part("eye"), app.at("Layer 1", 0.9)  # there the pointer covers no sign
    shown = app.parked(at)[eye]
    app.click("eye")
    app.until(lambda screen: (np.abs(screen[eye] - shown) > 60).any(), at)  # it is crossed out
    app.stroke(*((380 + 12 * i, 400) for i in range(24)))
    app.box("Show layer", "status")
    assert np.array_equal(app.canvas(), empty)
    app.click("Show layer", "status")
    app.until_gone("Show layer")
    app.canvas_unlike(empty)


@pytest.mark.nightly
def test_another_active_layer_is_brought_into_sight(program):
    app = program()
    for count in range(1, 10):
        app.click("add_layer")
        app.box(f"Layer {count}")
        if count == 5:
            app.box("Layer 1")  # as many are in sight with the ink mixer open
    app.until_gone("Layer 1")  # below the end of the list
    app.keys(*["ctrl+z"] * 8)
    app.box("Layer 1")
    app.keys(*["ctrl+shift+z"] * 8)
    app.box("Layer 9")


@pytest.mark.nightly
def test_how_high_and_how_wet_the_land_is_are_dragged_in_one_step_each(program, tmp_path):
    app = program()
    app.settled()
    app.click("add_layer")
    app.box("Layer 1")
    app.click("Layer menu")
    app.click("Height")
    app.box("Water")
    for name, to in (("Height", 0.9), ("Water", 0.25)):
        app.drag(app.at(name, 0.4), app.at(name, to))
        app.do("mouseup", 1)
    app.save_as(tmp_path / "a.ora")
    hills = layers.find(open_painting(tmp_path / "a.ora").painting.root, "Layer 1")
    assert hills.role == "height"
    assert hills.scale > 300
    assert 0.15 < hills.sea < 0.35
    app.box("Water")
    app.keys("ctrl+z", "ctrl+z", "ctrl+z")  # both drags, and the role
    app.until_gone("Water")


def test_a_layer_is_seen_alone_by_its_eye_and_renamed_by_its_menu(with_stroke):
    app = with_stroke
    both = app.canvas()
    app.box("picture of Layer 1")
    app.click("add_layer")
    app.box("Layer 2")
    app.do("keydown", "alt")
    app.click("eye")  # the top-most: of the one just added, on which nothing lies
    app.do("keyup", "alt")
    app.box("Show all", "status")
    app.canvas_unlike(both)
    app.click("Show all", "status")
    app.until_gone("Show all")
    assert app.comes_to(both)
    app.move_to(app.at("Layer 2"))
    app.do("click", 3)
    app.click("Rename")
    app.fill("Sky")
    app.keys("Return")
    app.box("Sky")


def test_several_rows_are_chosen_grouped_dragged_and_hidden_in_one_step_each_and_found_by_name(program, tmp_path):
    app = program()
    app.settled()
    for name in ("Layer 1", "Layer 2", "Layer 3"):
        app.click("add_layer")
        app.box(name)
    app.do("keydown", "ctrl")
    app.click("Layer 1")
    app.do("keyup", "ctrl")
    app.keys("ctrl+g")
    app.box("Group 1")
    app.keys("ctrl+z")
    app.until_gone("Group 1")
    app.click("Layer 3")
    app.do("keydown", "shift")
    app.click("Layer 2")
    app.do("keyup", "shift")
    app.drag(app.at("Layer 2", 0.3), app.at("Layer 1", 0.3, 0.9))
    app.do("mouseup", 1)
    app.wait_until(lambda: app.box("Layer 1")[1] < app.box("Layer 3")[1], "they were not dragged")
    app.click("find layer")
    app.type("er 2")
    app.until_gone("Layer 3")
    app.keys("Escape")
    app.box("Layer 3")
    app.click("remove")
    app.until_gone("Layer 3")
    app.save_as(tmp_path / "a.ora")
    assert [node.name for node in layers.walk(open_painting(tmp_path / "a.ora").painting.root)] == ["Layer 1"]
    app.keys("ctrl+z")
    app.box("Layer 2")
    app.box("Layer 3")


@pytest.mark.nightly
def test_a_row_is_coloured_by_its_menu_and_so_again_with_its_painting(program, tmp_path):
    app = program()
    app.settled()
    app.click("add_layer")
    row = app.part("Layer 1")
    edge = row[0], slice(1004, 1012)
    plain = app.parked()[edge]
    app.move_to(app.at("Layer 1"))
    app.do("click", 3)
    app.click("row red")
    app.until_gone("row red")
    red = app.until(lambda screen: (np.abs(screen[edge] - plain) > 60).any())[edge]
    app.save_as(tmp_path / "a.ora")
    app.wait_until((tmp_path / "state/inkfall/recent/rows.json").exists, "the colour is not kept")
    app.close()
    again = program(str(tmp_path / "a.ora"))
    again.box("Layer 1")
    again.until(lambda screen: np.array_equal(screen[edge], red))
