"""Keys in the real window: those of the canvas do not go on into a field that opens after them."""

import time

import pytest

pytestmark = pytest.mark.window


def test_keys_just_before_a_dialog_are_not_typed_into_it(program):
    app = program()
    app.move_to((640, 300))
    app.settled()
    app.do("key", "--delay", 2, *"bebxxxccc", "ctrl+s")
    app.box("name", "Save as")
    time.sleep(1.0)  # its text cursor blinks
    app.keys("Return")
    end = time.monotonic() + 90
    while not list(app.folder.glob("*.ora")) and time.monotonic() < end:
        time.sleep(0.1)
    assert [path.name for path in app.folder.glob("*.ora")] == ["untitled.ora"]


def test_a_field_takes_what_is_typed_right_after_a_click(program):
    """The radius of the brush, by Ctrl and a click on its slider."""
    app = program()
    app.settled()
    radius = app.part("Radius")
    number = radius[0], slice(150, radius[1].stop)  # the slider's right end
    before = app.screen()[number].astype(int)
    app.move_to(app.at("Radius"))
    app.do("keydown", "ctrl")
    app.do("click", 1, "keyup", "ctrl", "key", "--delay", 2, *"78", "Return")
    app.wait_until(lambda: "typing on" in app.log.read_text(), "no field takes what is typed")
    app.wait_until(lambda: not app.typing(), "the field is still there")
    app.move_to((640, 300))
    assert abs(app.settled()[number].astype(int) - before).max() > 60


@pytest.mark.nightly
def test_a_digit_typed_over_a_field_that_has_no_focus_leaves_the_picture_as_it_is(program):
    app = program()
    app.keys("2")
    app.park()
    before = app.settled()[60:740, 270:970]
    for field, panel in (("Opacity", "settings"), ("Find", "brushes")):
        app.move_to(app.at(field, window=panel))
        app.keys("4")
        app.wait_until(lambda: any(name.startswith("Nothing takes") for _, name in app.boxes()), "it is not told")
        app.do("mousemove", 120, 119)
        app.until_gone("Nothing takes what is typed: click a field first, or a slider with Ctrl held")
    app.park()
    assert (app.settled()[60:740, 270:970] == before).all()
    app.move_to((640, 300))
    app.keys("4")
    app.park()
    assert (app.settled()[60:740, 270:970] != before).any()
