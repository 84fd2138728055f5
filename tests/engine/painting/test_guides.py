"""Guides: steps that change no pixel, in recordings and files with all that they have."""

import json
import zipfile
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.export import Picture, export
from engine.archive.manifest import FORMAT, MANIFEST, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.checks import frozen
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.guiding.guides import GUIDE_KINDS, GUIDES_CAP, guides_after, read_guides, write_guide
from engine.session.apply import Painting, Refusal
from engine.session.replay import replay
from engine.session.session import Session

DEEP = c.Guide(
    "axis", "symmetry", 60, (3**200, -(5**90)), ((0.5, 0.25), (90.0, -3.5)), 7, True, False, extra=frozen({"new": [1]})
)
OFF = c.Guide("other", "symmetry", -2, (0, 0), ((0.0, 0.0), (0.0, -40.0)), off=True)
NAMES = st.sampled_from("abc")
MADE = st.builds(
    lambda name, count, x: replace(DEEP, name=name, count=count, at=(x, 1)), NAMES, st.integers(1, 64), st.integers()
)
COMMANDS = st.lists(
    st.one_of(MADE, st.builds(c.RemoveGuide, NAMES), st.builds(c.Undo, st.integers(1, 3)), st.builds(c.Redo)),
    max_size=14,
)


@settings(deadline=None, max_examples=50)
@given(COMMANDS)
def test_they_are_steps_that_undo_takes_back_and_a_replay_has_them(commands):
    session, past = Session(), [()]
    future = []
    for command in commands:
        now = past[-1]
        if isinstance(command, c.Undo | c.Redo):
            for _ in range(command.count):
                if isinstance(command, c.Undo) and len(past) > 1:
                    future.append(past.pop())
                elif isinstance(command, c.Redo) and future:
                    past.append(future.pop())
        elif isinstance(command, c.Guide):
            named = [guide.name for guide in now]
            after = tuple(command if g.name == command.name else g for g in now)
            past.append(after if command.name in named else (*now, command))
            future.clear()
        elif any(guide.name == command.name for guide in now):
            past.append(tuple(guide for guide in now if guide.name != command.name))
            future.clear()
        try:
            session.do(command)
        except Refusal:
            assert isinstance(command, c.RemoveGuide)
        assert tuple(session.painting.guides.values()) == past[-1]
    assert tuple(replay(session.recording()).painting.guides.values()) == past[-1]


def test_a_recording_and_a_file_hold_them(tmp_path):
    session = Session()
    for command in (c.AddLayer("A"), DEEP, OFF):
        session.do(command)
    told = [json.loads(line) for line in session.recording().lines()]
    assert told[0]["inkfall"] == 2
    assert [c.parse(one) for one in told[2:]] == [DEEP, OFF]
    assert format_of(session.painting) == FORMAT
    assert format_of(Painting()) < FORMAT
    save(tmp_path / "a.ora", Snapshot(session.painting, None))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        assert json.loads(file.read(MANIFEST))["inkfall"] == FORMAT
    assert list(open_painting(tmp_path / "a.ora").painting.guides.values()) == [DEEP, OFF]
    session.do(c.RemoveGuide("axis"))
    assert list(session.painting.guides.values()) == [OFF]


def test_no_export_shows_them(tmp_path):
    """Neither a picture nor the pictures within a file for other programs."""
    session = Session()
    for command in (c.AddLayer("A"), c.SetFrame(Rect(0, 0, 90, 70))):
        session.do(command)
    stroke = {"do": "stroke", "points": [[20, 20], [70, 60]], "brush": {"radius": 9, "colour": "#c03020"}}
    session.do(c.parse(stroke))
    bare = session.painting
    for n, kind in enumerate(GUIDE_KINDS):
        points = [[0, 0], [40, 12], [-9, 30]][: GUIDE_KINDS[kind].points]
        told = {"do": "guide", "name": kind, "kind": kind, "points": points, "snap": 0.5, "colour": "#ff0000"}
        session.do(c.parse({**told, "at": [10 + n, 30]}))
    assert len(session.painting.guides) == len(GUIDE_KINDS)
    pictures = []
    for name, painting in (("bare", bare), ("guided", session.painting)):
        export(tmp_path / f"{name}.png", Picture(painting))
        save(tmp_path / f"{name}.ora", Snapshot(painting, None))
        with zipfile.ZipFile(tmp_path / f"{name}.ora") as file:
            shown = [file.read(member) for member in ("mergedimage.png", "Thumbnails/thumbnail.png")]
        pictures.append([(tmp_path / f"{name}.png").read_bytes(), *shown])
    assert pictures[0] == pictures[1]
    opened = open_painting(tmp_path / "guided.ora").painting.guides
    assert list(opened.values()) == list(session.painting.guides.values())


def test_what_a_file_tells_wrongly_is_left_out_with_a_line():
    good = json.loads(json.dumps(write_guide(OFF)))
    told = [{"name": "x"}, good, good, 3]
    found, notes = read_guides(told)
    assert list(found.values()) == [OFF]
    assert len(notes) == 3


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"kind": "spiral"}, "kind"),
        ({"kind": []}, "kind"),
        ({"points": [[0, 0]]}, "points"),
        ({"points": [[0, 0], [0, 0]]}, "points"),
        ({"points": [[0, 0], [1e9, 0]]}, "points"),
        ({"points": [[0, 0], [10**400, 0]]}, "points"),
        ({"points": [[0, 0], [True, 0]]}, "points"),
        ({"count": 0}, "count"),
        ({"count": 65}, "count"),
        ({"mirror": 1}, "mirror"),
        ({"level": 5000}, "level"),
        ({"at": [0.5, 0]}, "at"),
        ({"name": ""}, "name"),
    ],
)
def test_what_is_wrong_is_named(change, place):
    good = {"do": "guide", "name": "a", "kind": "symmetry", "points": [[0, 0], [0, -4]]}
    assert isinstance(c.parse(good), c.Guide)
    with pytest.raises(FieldError) as caught:
        c.parse({**good, **change})
    assert caught.value.place == place


def test_there_are_not_too_many():
    guides = {str(n): replace(OFF, name=str(n)) for n in range(GUIDES_CAP)}
    assert len(guides_after(guides, replace(OFF, name="7"))) == GUIDES_CAP
    with pytest.raises(FieldError, match="guides already"):
        guides_after(guides, OFF)
    assert r.version_of(OFF) == r.version_of(c.RemoveGuide("a")) == 2
