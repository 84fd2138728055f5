"""Favourites and colours are kept between sessions, and lie under the pointer after a right click."""

import json
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.actions.actions import ACTIONS, by_key, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.holding import kept_desk
from app.desk.holding.desk_record import MOST_FAVOURITES, KeptDesk
from app.desk.holding.favourites import digit_of, star
from app.desk.presets import Preset
from app.input.events import RIGHT, PenEvent
from app.tools.asking_gestures import pick_or_pop_up
from engine.brush.settings import Brush
from engine.studio import requests as q

BRUSHES = tuple(Preset(f"B{i}", Brush(radius=1.0 + i)) for i in range(12))
NAMES = st.lists(st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=20), max_size=9, unique=True)
COLOURS = st.lists(st.integers(0, 0xFFFFFF).map(lambda n: f"#{n:06x}"), max_size=24, unique=True)


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_desk, "kept_file", lambda: tmp_path / "inkfall" / "desk.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.known = replace(made.known, presets=BRUSHES)
    made.kept = KeptDesk(())
    made.work = lambda work: work.arrive(made, work.carry_out())
    return made


def test_a_star_gives_a_brush_the_next_digit_and_takes_it_back(desk):
    for preset in BRUSHES[:3]:
        star(desk, preset)
    star(desk, BRUSHES[1])
    assert [digit_of(desk, preset) for preset in BRUSHES[:4]] == [1, 0, 2, 0]
    assert perform(desk, by_key("Ctrl+2"))
    assert desk.hand.preset == "B2"
    assert not perform(desk, ACTIONS["favourite_3"])
    kept, fault = kept_desk.read_kept(kept_desk.kept_file())
    assert (kept, fault) == (desk.kept, "")


def test_there_are_as_many_favourites_as_digits_and_those_that_are_gone_make_room(desk):
    for preset in BRUSHES[:MOST_FAVOURITES]:
        star(desk, preset)
    star(desk, BRUSHES[10])
    assert digit_of(desk, BRUSHES[10]) == 0
    assert desk.message.bad
    desk.known = replace(desk.known, presets=BRUSHES[1:])
    star(desk, BRUSHES[10])
    assert [digit_of(desk, BRUSHES[1]), digit_of(desk, BRUSHES[10])] == [1, 9]


def test_colours_are_kept_once_they_are_others_and_come_first_again(desk):
    desk.hand.colour = (1.0, 0.0, 0.0)
    desk.hand.remember()
    kept_desk.keep_colours(desk)
    written = kept_desk.kept_file().stat().st_mtime_ns
    desk.hand.remember()
    kept_desk.keep_colours(desk)
    assert kept_desk.kept_file().stat().st_mtime_ns == written
    desk.hand.colours = [(0.0, 0.0, 1.0)]
    kept_desk.restore(desk, kept_desk.read_kept(kept_desk.kept_file())[0])
    assert desk.hand.colours == [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)]


@settings(deadline=None)
@given(NAMES, COLOURS)
def test_what_is_kept_is_read_again(tmp_path_factory, names, colours):
    path = tmp_path_factory.mktemp("kept") / "desk.json"
    path.write_text(json.dumps({"favourites": names, "colours": colours, "later": 1}), "utf-8")
    assert kept_desk.read_kept(path) == (KeptDesk(tuple(names), tuple(colours)), "")


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{", '{"favourites": 3}', '{"colours": ["red"]}', '{"colours": ["#12345g"]}', '{"favourites": [1]}',
     "[" * 100_000, '{"colours": [null]}', "\0\0\0", '{"favourites": "' + "x" * (2 << 20) + '"}'],
)  # fmt: skip
def test_a_damaged_file_is_told_in_a_line_and_put_aside_before_another_is_written(desk, text):
    path = kept_desk.kept_file()
    path.parent.mkdir()
    path.write_text(text)
    kept, fault = kept_desk.read_kept(path)
    assert kept == KeptDesk()
    assert fault.startswith("desk.json: ")
    assert "\n" not in fault
    star(desk, BRUSHES[0])
    assert path.with_name("desk.damaged.json").read_text() == text
    assert kept_desk.read_kept(path) == (KeptDesk(("B0",)), "")


def event(kind, x, y):
    return PenEvent(kind, 500.0 + x, 400.0 + y, button=RIGHT)


def test_a_right_click_opens_the_palette_there_and_a_drag_picks(desk):
    posted = []
    desk.post = posted.append
    gesture = pick_or_pop_up(desk, event("down", 0, 0))
    next(gesture)
    gesture.send(event("move", 3, 2))  # a pen is never still
    with pytest.raises(StopIteration):
        gesture.send(event("up", 3, 3))
    assert (desk.hand_sight.palette_at, posted) == ((500.0, 400.0), [])
    desk.hand_sight.palette_at = None
    gesture = pick_or_pop_up(desk, event("down", 0, 0))
    next(gesture)
    for x in (4, 30, 60):
        gesture.send(event("move", x, 0))
    with pytest.raises(StopIteration):
        gesture.send(event("up", 1, 0))
    assert desk.hand_sight.palette_at is None
    assert [type(request) for request in posted] == [q.Pick] * 3
