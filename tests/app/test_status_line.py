"""What the status line tells of memory."""

from app.desk.known import Known, known_after
from app.panels.status import _memory
from engine.studio.held.held_records import Held

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
