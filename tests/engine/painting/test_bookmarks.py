"""Bookmarks: kept in order, by no undo taken back, in recordings and files with all that they have."""

import json
import math
from dataclasses import replace
from decimal import Decimal, localcontext

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.checks import frozen
from engine.checks.field_error import FieldError
from engine.numeric.scaling import scaled
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.places import BOOKMARKS_CAP, NO_BOOKMARKS, bookmarks_after, middle_of
from engine.session.apply import STEPS, Painting, Refusal
from engine.session.replay import replay
from engine.session.session import Session

DEEP = c.Bookmark("deep", 60.25, (3**200, -(5**90)), (1024.5, 768), -12.5, True, frozen({"lens": [0, 1, 2, 3.5]}))
NAMES = st.sampled_from("abcd")
PLACES = st.builds(c.Bookmark, NAMES, st.floats(-99, 99), st.tuples(st.integers(), st.floats(-1e9, 1e9)))
STEPS_AND_PLACES = st.lists(
    st.one_of(
        PLACES,
        st.builds(c.RemoveBookmark, NAMES),
        st.builds(c.RenameBookmark, NAMES, NAMES),
        st.builds(c.AddLayer, NAMES),
        st.builds(c.Undo, st.integers(1, 3)),
        st.builds(c.Redo, st.integers(1, 3)),
    ),
    max_size=20,
)


def plain_bookmarks(commands):
    """What the bookmarks are after commands, told as a list."""
    marks = []
    for command in commands:
        names = [mark.name for mark in marks]
        if isinstance(command, c.Bookmark):
            if command.name in names:
                marks[names.index(command.name)] = command
            else:
                marks.append(command)
        elif isinstance(command, c.RemoveBookmark):
            marks = [mark for mark in marks if mark.name != command.name]
        elif isinstance(command, c.RenameBookmark) and command.name in names and command.to not in names:
            marks[names.index(command.name)] = replace(marks[names.index(command.name)], name=command.to)
    return marks


@settings(deadline=None, max_examples=100)
@given(STEPS_AND_PLACES)
def test_undo_and_redo_leave_bookmarks_as_they_are(commands):
    session = Session()
    for command in commands:
        before = session.painting
        try:
            session.do(command)
        except Refusal:
            assert session.painting is before
    assert list(session.painting.bookmarks.values()) == plain_bookmarks(commands)
    assert list(session.painting.bookmarks) == [mark.name for mark in plain_bookmarks(commands)]
    again = replay(session.recording()).painting
    assert list(again.bookmarks.items()) == list(session.painting.bookmarks.items())
    assert [node.name for node in again.root.children] == [node.name for node in session.painting.root.children]


def test_they_are_no_steps_and_change_no_layer():
    session = Session()
    session.do(c.AddLayer("A"))
    root = session.painting.root
    session.do(DEEP)
    assert not STEPS & {c.Bookmark, c.RemoveBookmark, c.RenameBookmark}
    assert session.history.undo_count == 1
    assert session.painting.root is root
    with pytest.raises(TypeError):
        session.painting.bookmarks["x"] = DEEP


@pytest.mark.parametrize("command", [c.RemoveBookmark("x"), c.RenameBookmark("x", "y"), c.RenameBookmark("a", "deep")])
def test_what_cannot_be_done_is_refused_in_one_line(command):
    session = Session()
    for mark in (DEEP, c.Bookmark("a")):
        session.do(mark)
    with pytest.raises(Refusal, match=r"^bookmark.*: found .*, expected .* name .*$"):
        session.do(command)
    assert len(session.log) == 2


def test_there_are_not_too_many():
    marks = {str(n): c.Bookmark(str(n)) for n in range(BOOKMARKS_CAP)}
    assert len(bookmarks_after(marks, c.Bookmark("7", 3.0))) == BOOKMARKS_CAP
    with pytest.raises(FieldError, match="bookmarks already"):
        bookmarks_after(marks, c.Bookmark("one more"))


@pytest.mark.parametrize(
    ("told", "version"),
    [
        ([], 1),
        ([c.View(1.0)], 1),
        ([DEEP], 2),
        ([c.AddLayer("A"), c.RemoveBookmark("a")], 2),
        ([c.RenameBookmark("a", "b")], 2),
    ],
)
def test_a_recording_with_them_is_of_version_2(told, version):
    header, *_ = r.Recording(commands=tuple(told)).lines()
    assert json.loads(header)["inkfall"] == version


@pytest.mark.parametrize("known", [True, False], ids=["with its recording", "without"])
def test_a_file_holds_them(tmp_path, known):
    session = Session()
    for command in (DEEP, c.AddLayer("A"), c.Bookmark("a", -3.0, (0.25, -7)), c.Bookmark("b")):
        session.do(command)
    path = tmp_path / "a.ora"
    save(path, Snapshot(session.painting, session.recording() if known else None))
    found = open_painting(path)
    assert list(found.painting.bookmarks.items()) == list(session.painting.bookmarks.items())
    assert (found.recording is not None) == known
    assert not found.notes


def test_a_file_without_any_says_nothing_of_them(tmp_path):
    save(tmp_path / "a.ora", Snapshot(Painting()))
    assert open_painting(tmp_path / "a.ora").painting.bookmarks == NO_BOOKMARKS


@pytest.mark.parametrize(
    "told", [{"name": "a", "remove": True}, {"name": "a", "level": "x"}, {"level": 1}, {"name": "b"}, 7]
)
def test_a_file_with_a_wrong_one_opens_without_that_and_tells_it(tmp_path, monkeypatch, told):
    import engine.archive.manifest as manifest

    painting = Painting(bookmarks={"b": c.Bookmark("b"), "a": c.Bookmark("a")})
    monkeypatch.setattr(manifest, "write_bookmark", lambda mark: {"name": "b"} if mark.name == "b" else told)
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora")
    assert dict(found.painting.bookmarks) == {"b": c.Bookmark("b")}
    (note,) = found.notes
    assert note.startswith("a bookmark is left out: bookmarks[1]")


@given(
    st.floats(-400, 400),
    st.integers(-(1 << 400), 1 << 400) | st.floats(-1e9, 1e9),
    st.floats(2.0**-20, 2.0**40),
)
@settings(deadline=None, max_examples=50)
def test_the_middle_of_one_is_exact_at_any_depth(level, origin, size):
    x, y, exponent = middle_of(c.Bookmark("a", level, (origin, 0), (size, 1 << 40)))
    with localcontext() as context:
        context.prec = 300
        scale = Decimal(2) ** -Decimal(level)
        told = Decimal(x) * Decimal(2) ** -exponent
        assert abs(told - (Decimal(origin) + Decimal(size) / 2) * scale) < scale * Decimal(2) ** -28
        assert abs(Decimal(y) * Decimal(2) ** -exponent - (1 << 39) * scale) < scale * Decimal(2) ** -28


@given(st.integers(-(1 << 9000), 1 << 9000), st.integers(-300, 300))
@settings(deadline=None, max_examples=50)
def test_whole_levels_are_exact(value, levels):
    expected = value << levels if levels >= 0 else (value + (1 << -levels - 1)) >> -levels
    assert scaled(value, float(levels)) == expected


def test_places_of_the_deepest_level_are_exact():
    place = 3**5000
    assert scaled(place, 4000.5) == math.isqrt((place * place << 8001) * 4) + 1 >> 1
    assert scaled(scaled(place, 4000.7), -4000.7) == place
