"""The dialogs in the real window: how they look, and that they do what is asked of them."""

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]

TEXT = 60  # grey levels by which letters are lighter than what they lie on


def margins(button):
    """Of each line of text in a picture of a button: the pixels to the left of it, and to the right."""
    light = button.astype(int).max(axis=-1)
    letters = light > np.median(light) + TEXT
    rows = np.flatnonzero(np.diff(np.r_[False, letters.any(axis=1), False].astype(int)))
    found = [np.flatnonzero(letters[top:bottom].any(axis=0)) for top, bottom in rows.reshape(-1, 2)]
    return [(int(line[0]), button.shape[1] - 1 - int(line[-1])) for line in found]


def test_sizes_of_a_new_painting_stand_in_the_middle_of_their_buttons(program):
    app = program()
    app.do("mousemove", 640, 300)
    app.keys("ctrl+n")
    app.box("Start")
    screen = app.settled(60.0)
    for name in ("Screen", "Square", "Wide", "A4, 150 dpi", "Start", "Cancel"):
        lines = margins(screen[app.part(name)])
        assert lines
        assert all(abs(left - right) <= 2 for left, right in lines), f"{name}: {lines}"
    app.click("Square")
    app.click("Start")
    app.until_gone("Start")
    assert app.process.poll() is None
