"""Keys are bound in the list that F1 shows: by a click and a press, wheel and buttons, too; a conflict is told."""

import json

import numpy as np
import pytest

pytestmark = pytest.mark.window


def bound_in(app):
    path = app.folder / "config" / "inkfall" / "keys.json"
    return json.loads(path.read_text("utf-8"))["keys"] if path.exists() else {}


@pytest.mark.nightly
def test_a_key_and_a_wheel_are_bound_in_the_list_and_work_at_once_and_at_the_next_start(program):
    app = program()
    app.settled()
    app.keys("F1")
    app.box("find keys")
    app.settled()
    app.click("find keys")
    app.type("eraser")
    app.until_gone("row new")
    app.click("key eraser 0")
    app.box("Press a key…")
    app.keys("b")
    app.box("conflict")
    app.click("Take it")
    app.wait_until(lambda: bound_in(app) == {"brush": [], "eraser": ["B"]}, "not bound")
    app.click("find keys")
    app.fill("zoom in")
    app.until_gone("row zoom")
    app.click("key in -1")
    app.box("Press a key…")
    for words in (("keydown", "ctrl"), ("click", 4), ("keyup", "ctrl")):  # each at a time of its own
        app.do(*words)
    app.wait_until(lambda: bound_in(app).get("in") == ["+", "=", "PageUp", "Ctrl+Wheel up"], "the wheel is not bound")
    app.keys("Escape")
    app.until_gone("find keys")
    lit = app.part("eraser")
    before = app.parked()[lit]
    app.keys("b")
    app.until(lambda screen: np.abs(screen[lit] - before).max() > 40)
    app.process.terminate()
    app.process.wait(90)
    app = program()
    app.settled()
    before = app.parked()[lit]
    app.keys("b")
    app.until(lambda screen: np.abs(screen[lit] - before).max() > 40)


def test_a_key_map_that_is_damaged_is_told_in_a_line_and_the_program_starts(program, tmp_path):
    folder = tmp_path / "config" / "inkfall"
    folder.mkdir(parents=True)
    (folder / "keys.json").write_text('{"keys": {"undo": ["Q"], "redo": ["Q"]}}')
    app = program()
    told = 'keys.json: keys.redo: found Q, which "undo" has, expected a key of its own; the file is kept as it is'
    app.wait_until(lambda: any(name.startswith(told[:40]) for _, name in app.boxes()), "no line tells of it")
    assert (folder / "keys.json").exists()
