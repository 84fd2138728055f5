"""The real program in a real window: what an artist does in the first minutes, judged by pictures of the screen."""

import time
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.window

WAVE = [(380 + 12 * i, 400 + (30 if i % 8 < 4 else -30)) for i in range(24)]


def differing(a, b, by=3):
    """How many pixels differ by more than `by` of 255."""
    return int((np.abs(a - b).max(axis=-1) > by).sum())


def test_paint_zoom_undo_save_reopen(program, tmp_path):
    app = program(fresh=True)
    empty = app.canvas()
    app.keys("bracketright", "bracketright", "bracketright", "bracketright")
    app.stroke(*WAVE)
    app.wait_for("all brushes ready")  # until then some of it may be a sketch
    painted = app.canvas_unlike(empty)
    assert differing(empty, painted) > 1500

    # Twenty levels in and out about one point: exactly the same picture again.
    app.move_to((600, 400))
    app.wheel(80)
    deep = app.settled()
    assert differing(deep[60:740, 270:970].astype(int), painted) > 1000
    app.wheel(-80)
    app.settled()
    assert app.comes_to(painted)

    # A stroke at depth changes nothing where it is too small to be seen, and undo takes both back.
    app.keys("ctrl+z")
    assert app.comes_to(empty)
    app.keys("ctrl+shift+z")
    assert app.comes_to(painted)

    app.save_as(tmp_path / "picture.ora")
    assert app.comes_to(painted)
    app.keys("ctrl+q")
    assert app.process.wait(90) == 0

    again = program(str(tmp_path / "picture.ora"))
    again.wait_for("painting 1 shown")
    assert again.comes_to(painted)


def test_a_stroke_twenty_levels_deep_is_there_again_after_going_away(program):
    app = program()
    app.move_to((600, 400))
    app.wheel(80)
    bare = app.canvas()
    app.stroke(*WAVE)
    deep = app.canvas_unlike(bare)
    app.move_to((600, 400))
    app.wheel(-80)
    far = app.canvas()
    app.move_to((600, 400))
    app.wheel(80)
    assert app.comes_to(deep)
    assert differing(far, deep) > 1500


def test_the_keys_for_the_view_and_the_panels(program):
    app = program()
    empty = app.canvas()
    app.stroke(*WAVE[:12])
    before = app.canvas_unlike(empty)
    app.keys("m")
    mirrored = app.canvas()
    assert differing(before, mirrored) > 300
    app.keys("m")
    assert app.comes_to(before)
    app.keys("Tab")
    hidden = app.settled()
    app.keys("Tab")
    shown = app.settled()
    assert differing(hidden[:, :240].astype(int), shown[:, :240].astype(int)) > 5000
    app.keys("1")
    app.canvas()
    app.keys("f")
    assert app.comes_to(before)


def test_an_idle_window_sleeps(program):
    """Once the engine has warmed up, thumbnails are painted, and frames linger no more."""
    app = program()
    app.wait_for("all brushes ready")
    app.settled()

    def used() -> float:
        fields = Path(f"/proc/{app.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / 100

    end, taken = time.monotonic() + 90.0, 4.0
    while taken > 0.12:  # 3 % of one core
        assert time.monotonic() < end, f"{taken:.2f} s of the processor in 4"
        before = used()
        time.sleep(4)
        taken = used() - before


def test_the_first_frame_comes_before_the_engine(program):
    app = program(fresh=True)
    first = next(line for line in app.log.read_text().splitlines() if not line.startswith(("box ", "gone ")))
    assert first.startswith("first frame")
    assert first.endswith("numba False")


def test_escape_abandons_a_stroke(program):
    app = program()
    empty = app.canvas()
    app.do("mousemove", 400, 400, "mousedown", 1, "mousemove", 500, 420, "mousemove", 600, 400)
    app.until_rest((600, 400))  # the key goes another way than the pointer, and may be there before it
    app.keys("Escape")
    app.do("mouseup", 1)
    assert app.comes_to(empty)


def test_what_the_window_system_lost_is_drawn_again(program):
    app = program()
    app.stroke(*WAVE)
    shown = app.canvas()
    app.do("search", "--name", "Inkfall", "windowunmap", "--sync")
    assert differing(shown, app.screen()[60:740, 270:970].astype(int)) > 100_000
    app.do("search", "--name", "Inkfall", "windowmap", "--sync")
    assert app.comes_to(shown)


def test_hovering_shows_in_a_panel_that_was_at_rest(program):
    app = program()
    at, part = app.at("eraser"), app.part("eraser")
    still = app.parked()[part]
    time.sleep(1.5)  # frames linger
    over = app.parked(at)[part]
    assert differing(still, over) > 100
    assert np.array_equal(app.parked()[part], still)


def test_what_was_in_the_middle_comes_back_when_a_strip_is_closed_by_its_sign(with_stroke):
    before = with_stroke.canvas()
    with_stroke.keys("p")
    with_stroke.click("close", "strip")
    with_stroke.until_gone("sample")
    assert with_stroke.comes_to(before)
