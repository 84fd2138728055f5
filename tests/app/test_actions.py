"""The table of actions is complete: what has a key has a hint, and no key means two things."""

from collections import Counter

import pytest
from imgui_bundle import imgui  # noqa: F401  # before glfw, so that both use one libglfw

import glfw  # isort: skip

from app import icons
from app.actions.actions import ACTIONS, MENUS, by_key, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.keys import chord
from app.panels.brush.brush_panel import BrushPanel  # noqa: F401  # the panels name actions; importing them checks the names
from app.panels.dialogs.dialogs import DIALOGS
from app.tools.tools import TOOLS


@pytest.fixture
def desk():
    return Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)


@pytest.mark.parametrize("name", sorted(ACTIONS))
def test_every_action_has_a_title_a_menu_and_a_hint(name):
    action = ACTIONS[name]
    assert action.title
    assert action.hint
    offers = {"try_again", "free_space", "start_engine"}  # of notices alone: in no menu
    assert (action.menu.partition("/")[0] in MENUS) == (name not in offers)
    assert action.menu or name in offers


def test_no_key_means_two_things():
    counts = Counter(key for action in ACTIONS.values() for key in action.keys)
    assert not [key for key, n in counts.items() if n > 1]


@pytest.mark.parametrize(
    ("keys", "name"),
    [
        ("Ctrl+Z", "undo"), ("Ctrl+Shift+Z", "redo"), ("Ctrl+S", "save"), ("Ctrl+O", "open"), ("Ctrl+N", "new"),
        ("E", "eraser"), ("B", "brush"), ("[", "smaller"), ("]", "larger"), ("X", "swap"), ("D", "default"),
        ("Tab", "panels"), ("F", "fit"), ("M", "mirror"), ("1", "one"), ("2", "fit"), ("Escape", "escape"),
    ],
)  # fmt: skip
def test_the_usual_keys(keys, name):
    assert by_key(keys) is ACTIONS[name]


def test_every_tool_has_an_icon_and_a_hint_and_can_be_chosen(desk):
    for name, tool in TOOLS.items():
        assert tool.hint
        assert tool.icon in vars(icons).values()
        perform(desk, ACTIONS[name])
        assert desk.hand.tool == name


def test_every_dialog_that_an_action_asks_for_is_there(desk):
    for action in ACTIONS.values():
        desk.asked.dialog = ""
        if action.title.endswith("…"):
            action.do(desk)
            assert desk.asked.dialog in DIALOGS


def test_nothing_that_needs_the_engine_is_allowed_before_it_is_there(desk):
    for name in ("undo", "redo", "save", "open", "new", "add_layer", "remove", "duplicate", "export"):
        assert not ACTIONS[name].when(desk)


def test_the_eraser_toggles(desk):
    perform(desk, ACTIONS["eraser"])
    assert desk.hand.erasing
    perform(desk, ACTIONS["eraser"])
    assert not desk.hand.erasing


def test_brackets_change_the_size_and_back(desk):
    before = desk.hand.brush.radius
    perform(desk, ACTIONS["larger"])
    assert desk.hand.brush.radius > before
    perform(desk, ACTIONS["smaller"])
    assert desk.hand.brush.radius == pytest.approx(before, abs=0.02)


def test_the_size_of_the_brush_stays_within_bounds(desk):
    for _ in range(200):
        desk.hand.resize(1.5)
    assert desk.hand.brush.radius == 2000
    for _ in range(200):
        desk.hand.resize(0.5)
    assert desk.hand.brush.radius == 0.5


def test_a_press_is_written_as_in_the_table():
    assert chord(glfw.KEY_PAGE_UP, 0, 0) == "PageUp"
    assert chord(glfw.KEY_ESCAPE, 0, 0) == "Escape"
    assert chord(glfw.KEY_TAB, 0, glfw.MOD_CONTROL | glfw.MOD_SHIFT) == "Ctrl+Shift+Tab"


def test_plus_is_the_upper_sign_of_its_key(monkeypatch):
    monkeypatch.setattr(glfw, "get_key_name", lambda key, scancode: "=")
    assert chord(glfw.KEY_EQUAL, 21, 0) == "="
    assert chord(glfw.KEY_EQUAL, 21, glfw.MOD_SHIFT) == "+"
    assert by_key(chord(glfw.KEY_EQUAL, 21, glfw.MOD_SHIFT)) is ACTIONS["in"]


def test_unsaved_changes_are_asked_about(desk):
    went = []
    desk.guard(lambda: went.append(desk))
    assert went == [desk]
    desk.behind = lambda: True  # a stroke may be among what is still to be carried out
    desk.guard(lambda: went.append(desk))
    assert went == [desk]
    assert desk.asked.dialog == "unsaved"
