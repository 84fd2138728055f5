"""What the status line tells of memory, and of what the tool in hand does."""

from dataclasses import replace
from pathlib import Path

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.known import Known, known_after
from app.desk.outside import bringing
from app.desk.outside.arriving import welcome_arrived
from app.panels.status import _memory, _work, now_possible
from engine.numeric.address import Rect
from engine.studio.held.held_records import Held
from engine.studio.layer_rows import LayerRow
from engine.studio.results import Note, Scene

MB = 1 << 20


def test_nothing_is_told_before_the_engine_tells():
    assert _memory(Known().held)[0] == ""


def test_who_holds_memory_is_told_in_megabytes_and_what_is_left_is_the_program():
    held = Held((("Painting", 0), ("Undo", 33 * MB), ("Pictures", 5)), 1200 * MB, 512 * MB)
    label, hint, _, _ = _memory(known_after(Known(), held, 0.0).held)
    assert label == "1,200 MB"
    assert hint.splitlines() == [
        "Memory",
        "  0 MB  Painting",
        " 33 MB  Undo",
        "1,167 MB  The program itself",
        "Paintings may take 512 MB; preferences.toml says how much",
    ]


def test_what_lies_on_disk_is_told_where_there_is_any():
    assert "Put away on disk: 70 MB" in _memory(Held((), 300 * MB, 512 * MB, 70 * MB))[1]


ROW = LayerRow("Sky", False, 0, None, 0, 1.0, True, "src-over", False, False, masked=True)


def desk_on(row):
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    desk.known = replace(
        desk.known, ready=True, scene=Scene(Rect(0, 0, 9, 9), (row,), row.name, True, False, True, None)
    )
    return desk


def test_one_is_told_that_the_brush_hides_and_shows_while_a_mask_is_painted_on():
    desk = desk_on(ROW)
    assert now_possible(desk) == "Paint with the chosen brush (Alt+drag: its size)"
    desk.masks.layer = "Sky"
    assert now_possible(desk) == "Paint on the mask: black hides, white shows again"
    desk.hand.erase()
    assert now_possible(desk) == "Hide with the eraser"
    desk.hand.use("pan")
    assert now_possible(desk).startswith("Drag the picture")


@pytest.mark.parametrize("meanwhile", ["brush", "pan"])
def test_a_picture_is_told_to_be_on_its_way_until_it_lies_there_and_then_it_is_what_is_moved(meanwhile):
    desk = desk_on(replace(ROW, name="sky"))
    bringing.lay(desk, Path("sky.png"), "sky", (300, 300), Place(0, 0, 0))
    welcome_arrived(desk)  # something else of the painting has changed
    assert desk.message.text == "Bringing in “sky 2”…"
    assert _work(desk).endswith("bringing in")
    assert desk.hand.tool == "brush"
    desk.hand.use(meanwhile)
    desk.known = replace(desk.known, scene=desk_on(replace(ROW, name="sky 2")).known.scene)
    welcome_arrived(desk)
    assert desk.message.text.startswith("Drag “sky 2”")
    assert _work(desk) == ""
    assert desk.hand.tool == ("move" if meanwhile == "brush" else meanwhile)


def test_what_cannot_be_brought_in_is_waited_for_no_longer():
    desk = desk_on(ROW)
    bringing.lay(desk, Path("sky.png"), "sky", (300, 300), Place(0, 0, 0))
    desk.told(Note("sky.png: found no picture", bad=True))
    assert _work(desk) == ""


@pytest.mark.parametrize(("side", "refined"), [(400, True), (5000, False)])
def test_a_picture_that_is_too_large_is_not_extrapolated_and_that_is_told(side, refined):
    desk, posted = desk_on(replace(ROW, name="sky")), []
    desk.post = posted.append
    bringing._Lay(Path("sky.png"), Place(0, 0, 0), detail=0.5).arrive(desk, (side, side, refined))
    assert ("detail" in posted[0].command.arguments) == refined
    assert ("profile" in posted[0].command.arguments) == refined
    assert ("extrapolated" in desk.message.text) == (not refined)
