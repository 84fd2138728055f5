"""Keys are bound otherwise: no key means two things, maps are read as they were written, hostile ones are told."""

import json
import random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from imgui_bundle import imgui  # noqa: F401  # before glfw, so that both use one libglfw

from app.actions.actions import ACTIONS, by_key, keyed, perform
from app.actions.binding import BringKeys, bound_with, change_keys, keys_with, lay_keys, owner_of
from app.actions.chosen_map import OWN_KEYS, take_map
from app.actions.key_maps import KEY_MAPS
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.keys import kept_keys
from app.desk.keys.kept_keys import GiveKeys, bound_of, read_keys
from app.desk.keys.key_state import brush_row
from app.desk.presets import Preset
from app.input.events import LEFT, MIDDLE, PAD, PenEvent
from app.keys import pointer_chord
from engine.brush.settings import Brush

ROWS = st.sampled_from([*sorted(ACTIONS), brush_row("Moss"), "of a newer program"])
KEYS = st.sampled_from(["B", "Ctrl+Z", "Alt+Shift+Ä", "Wheel up", "Ctrl+Middle button", "F12", "7", "+", "Ctrl++", "["])


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_keys, "kept_keys_file", lambda: tmp_path / "keys.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.learn(presets=(Preset("Moss", Brush(radius=9.0)),))
    made.work = lambda work: work.arrive(made, work.carry_out())
    yield made
    lay_keys({})


@settings(deadline=None)
@given(st.lists(st.tuples(ROWS, st.lists(KEYS, max_size=3)), max_size=12))
@example([("of a newer program", ["B"]), ("about", ["B"])])
def test_no_key_means_two_things_whatever_is_bound(bindings):
    bound = {}
    for row, keys in bindings:
        bound = bound_with(bound, row, tuple(keys))
        held = keys_with(bound)
        assert all(owner_of(bound, key) == row for key in keys if row in held)
        every = [key for keys in held.values() for key in keys]
        assert len(every) == len(set(every))
    assert bound_of(json.loads(json.dumps({"keys": bound}))) == {row: tuple(keys) for row, keys in bound.items()}


@pytest.mark.parametrize("name", KEY_MAPS)
def test_maps_that_come_along_are_whole_and_bind_each_key_once(name):
    bound = KEY_MAPS[name].bound
    assert set(bound) <= set(ACTIONS)
    assert bound_of({"keys": {row: list(keys) for row, keys in bound.items()}}) == bound
    lost = {row for row, keys in keys_with(bound).items() if not keys and ACTIONS[row].keys and row not in bound}
    assert lost <= {"fit", "draw_curve", "frame_tool", "match"}, "these have no key any more"


def test_what_is_bound_is_done_told_and_kept(desk, tmp_path):
    change_keys(desk, bound_with(desk.keys.bound, "eraser", ("Q", "Middle button")))
    change_keys(desk, bound_with(desk.keys.bound, brush_row("Moss"), ("E",)))
    assert (by_key("Q"), by_key("Middle button")) == (ACTIONS["eraser"], ACTIONS["eraser"])
    assert ACTIONS["quick_mask"].keys == ()
    assert keyed("Erase", "eraser") == "Erase  (Q)"
    assert perform(desk, by_key("E"))
    assert desk.hand.preset == "Moss"
    assert read_keys(tmp_path / "keys.json") == (desk.keys.bound, "")
    change_keys(desk, {})
    assert by_key("E") is ACTIONS["eraser"]


def test_a_brush_that_is_gone_is_told(desk):
    change_keys(desk, {brush_row("Gone"): ("F7",)})
    perform(desk, by_key("F7"))
    assert desk.message.bad


def test_buttons_and_wheels_have_names():
    def named(kind, mods=0, **told):
        return pointer_chord(PenEvent(kind, 0.0, 0.0, **told), mods)

    assert named("wheel", dy=1.0) == "Wheel up"
    assert named("wheel", mods=2, dy=-1.0) == "Ctrl+Wheel down"
    assert named("wheel", dy=-1.0, pad=True) == "Ring down"
    assert named("down", button=MIDDLE) == "Middle button"
    assert named("down", button=7) == "Button 7"
    assert named("down", button=PAD + 3) == "Pad button 3"
    assert named("down", button=LEFT) == named("move") == named("up", button=MIDDLE) == ""


def hostile():
    """Some that are wrong in each of the ways that there are, and what chance makes of a good one."""
    yield from (
        "",
        "[]",
        "{",
        "{}",
        '{"keys": 3}',
        '{"keys": []}',
        '{"keys": {"undo": "Z"}}',
        '{"keys": {"undo": [1]}}',
    )
    for key in (
        "",
        " ",
        "Ctrl+",
        "Ctrl",
        "z",
        "Shift+Ctrl+Z",
        "Escape",
        "Ctrl+Space",
        "F99",
        "Wheel",
        "Left button",
        "\0",
    ):
        yield json.dumps({"keys": {"undo": [key]}})
    yield json.dumps({"keys": {"undo": ["Z"], "redo": ["Z"]}})
    yield json.dumps({"keys": {"undo": ["Z"] * 9}})
    yield json.dumps({"keys": {f"row {i}": [] for i in range(2001)}})
    yield json.dumps({"keys": {"x" * 201: []}})
    yield "[" * 100_000
    yield '{"keys": {"undo": ["Z"]}, "keys": {"undo": ["Y"]}}'
    good = json.dumps({"keys": {"undo": ["Ctrl+Z"], "brush:Größe": ["Wheel up", "7"]}}, ensure_ascii=False).encode()
    chance = random.Random(4)
    for _ in range(60):
        bad = bytearray(good[: chance.randrange(len(good))])
        if bad and chance.random() < 0.5:
            bad[chance.randrange(len(bad))] ^= 1 << chance.randrange(8)
        yield bytes(bad)


@pytest.mark.parametrize("data", [pytest.param(data, id=str(i)) for i, data in enumerate(hostile())])
def test_hostile_maps_are_told_in_a_line_and_nothing_is_lost(desk, tmp_path, data):
    path = tmp_path / "keys.json"
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    bound, fault = read_keys(path)
    assert bound == {}
    assert fault.startswith("keys.json: ")
    assert fault.isprintable()
    before = desk.keys.bound = {"undo": ("F8",)}
    brought = tmp_path / "brought.json"
    path.rename(brought)
    desk.work(BringKeys(brought))
    assert (desk.keys.bound, desk.keys.told.startswith("brought.json: ")) == (before, True)
    brought.rename(path)
    change_keys(desk, {"undo": ("F9",)})
    assert read_keys(path) == ({"undo": ("F9",)}, "")
    assert (tmp_path / "keys.damaged.json").exists()


def test_a_map_goes_from_desk_to_desk(desk, tmp_path):
    change_keys(desk, {"undo": ("F8",), "of a newer program": ("F9",)})
    desk.work(GiveKeys(desk.keys.bound, tmp_path / "given.json"))
    given = desk.keys.bound
    change_keys(desk, {})
    desk.work(BringKeys(tmp_path / "given.json"))
    assert (desk.keys.bound, desk.keys.told) == (given, "Brought in given.json, 1 of what there is not")
    desk.work(BringKeys(tmp_path / "none.json"))
    assert desk.keys.told == "none.json: there is no such file"


def test_a_ready_made_map_leaves_the_way_back_to_ones_own(desk):
    change_keys(desk, bound_with(desk.keys.bound, "eraser", ("Q",)))
    change_keys(desk, bound_with(desk.keys.bound, brush_row("Moss"), ("F12",)))
    own = desk.keys.bound
    assert "“Your own” has yours again" in take_map(desk, "krita", OWN_KEYS)
    assert desk.keys.bound == {**KEY_MAPS["krita"].bound, brush_row("Moss"): ("F12",)}
    assert "“Your own”" not in take_map(desk, "photoshop", "krita")
    take_map(desk, OWN_KEYS, "photoshop")
    assert desk.keys.bound == own
