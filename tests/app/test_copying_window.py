"""Copy, cut and paste within the program, in the real window: what is pasted is what was there."""

import numpy as np
import pytest

pytestmark = pytest.mark.window


def unlike(one, other):
    return (np.abs(one.astype(int) - other.astype(int)).max(axis=2) > 24).sum()


def test_what_is_cut_is_pasted_where_it_was(program):
    app = program()
    app.settled()
    app.keys("1", "b")
    empty = app.canvas()
    app.stroke(*((320 + 10 * i, 340) for i in range(30)))
    app.until_rest((610, 340))
    painted = app.canvas_unlike(empty)
    app.keys("s")
    app.stroke((400, 260), (450, 300), (500, 420))
    app.keys("ctrl+x")
    app.wait_for("Cut what is selected of")
    app.keys("ctrl+shift+a")
    cut = app.canvas_unlike(painted)
    assert 0 < unlike(cut, empty) < unlike(painted, empty)
    app.keys("ctrl+v")
    assert app.comes_to(painted)
    app.keys("ctrl+c")
    app.wait_for("Copied \\u201cPasted 1")
    app.keys("ctrl+z")  # takes back what was pasted: copying is no step
    assert app.comes_to(cut)
    app.keys("ctrl+v")
    assert app.comes_to(painted)
