"""The pop-up palette in the real window: under the pointer with a right click, gone with what is chosen."""

import json

import pytest

pytestmark = pytest.mark.window


def test_a_right_click_opens_favourites_under_the_pointer_and_choosing_escape_and_a_press_beside_close_them(program):
    app = program()
    app.settled()
    empty = app.canvas()
    app.move_to((640, 400))
    app.do("click", 3)
    left, top, right, bottom = app.box("pop-up wheel")
    assert left < 640 < right
    assert top < 400 < bottom
    first = [line for line in app.log.read_text().splitlines() if '"pop-up wheel"' in line]
    assert [json.loads(line[4:])[2:] for line in first] == [[left, top, right, bottom]], "not at once where it stays"
    app.click("favourite 3")
    app.until_gone("pop-up wheel")
    assert "Brush marks" in {name for _, name in app.boxes()}, "not Gouache"
    for close in (lambda: app.keys("Escape"), lambda: app.click((300, 700))):
        app.move_to((640, 400))
        app.do("click", 3)
        app.box("favourite 1")
        close()
        app.until_gone("favourite 1")
    assert app.comes_to(empty)
