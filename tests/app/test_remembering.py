"""What a window remembers is read as it was written; a damaged file is told in a line, and put aside."""

import json
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.exporting.export_state import EXPORT_FORMATS, FINER, ExportState
from app.desk.presets import Preset
from app.desk.remembering import kept_views, kept_window
from app.desk.remembering.kept_views import ReadViews, ViewsWatched, show_as_before, views_of
from app.desk.remembering.kept_window import KeepWindow, Remembering, read_window, restore_found, restore_window
from app.desk.remembering.window_record import KeptHand, KeptWindow, window_json, window_of
from app.desk.solids.kept_solid import KeptSolid
from app.desk.solids.solid_state import DEEPEST_SLICE, OBJECTS, SOLID_SCALES
from app.input.window_box import WindowBox, box_in_points, fitted_box, read_box
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.solids.material_sliders import MATERIALS
from engine.studio.results import Scene

NAMES = st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
COLOUR = st.integers(0, 0xFFFFFF).map(lambda n: f"#{n:06x}")
BOXES = st.builds(
    WindowBox,
    st.tuples(st.integers(-9000, 9000), st.integers(-9000, 9000), st.integers(320, 9000), st.integers(240, 9000)),
    st.booleans(),
)
EXPORTS = st.builds(
    ExportState, NAMES, st.integers(*FINER), st.sampled_from(sorted(EXPORT_FORMATS)), *[st.booleans()] * 3
)
HANDS = st.builds(
    KeptHand,
    st.none() | st.builds(lambda radius: Preset("Mine", Brush(radius=radius)), st.floats(0.5, 900)),
    st.none() | st.tuples(COLOUR, COLOUR),
    st.none() | st.floats(0, 1),
    st.sampled_from(["", "weighted"]),
)
TABLES = st.dictionaries(NAMES, st.booleans(), max_size=5).map(lambda told: tuple(told.items()))
FOLDERS = st.dictionaries(NAMES, NAMES, max_size=5).map(lambda told: tuple(told.items()))
SOLIDS = st.builds(
    KeptSolid,
    st.sampled_from(sorted(MATERIALS)),
    st.sampled_from(OBJECTS),
    st.integers(0, 99_999),
    st.floats(0, 1).map(lambda x: Map({"agate": Map(warp=x, speckle=x), "wood": Map(rings=9.0)})) | st.just(Map()),
    st.floats(*SOLID_SCALES),
    st.floats(0, DEEPEST_SLICE),
)
KEPT = st.builds(KeptWindow, st.none() | BOXES, st.booleans(), NAMES, TABLES, FOLDERS, HANDS, EXPORTS, solid=SOLIDS)


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_window, "kept_window_file", lambda: tmp_path / "window.json")
    monkeypatch.setattr(kept_views, "_place", lambda: tmp_path / "views.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.known = replace(made.known, presets=(Preset("Mine", Brush(radius=4.0)),))
    made.work = lambda work: work.arrive(made, work.carry_out())
    return made


@settings(deadline=None)
@given(KEPT)
def test_what_is_written_is_read(kept):
    assert window_of(json.loads(json.dumps(window_json(kept)))) == kept


def test_what_is_remembered_is_laid_on_the_desk_again(desk, tmp_path):
    box = WindowBox((40, 30, 900, 700))
    desk.hand.take(Brush(radius=77.0), "Mine")
    desk.hand.colour, desk.export.format, desk.opened.folders = (1.0, 0.0, 0.0), "exr", {"Film": tmp_path}
    desk.remembered.folded["Layers"] = False
    desk.solid.material, desk.solid.name = "marble", "/a/mesh/of/mine.obj"
    desk.solid.set("warp", 0.4)
    watched = Remembering(lambda: box)
    watched.watch(desk, 1.0)
    assert not (tmp_path / "window.json").exists(), "it has been so but once"
    watched.watch(desk, 1.5)
    watched.watch(desk, 2.1)
    kept, fault = read_window(tmp_path / "window.json")
    assert (kept, fault) == (desk.remembered.kept, "")
    assert read_box(tmp_path / "window.json") == box
    (tmp_path / "small.json").write_text('{"box": [40, 30, 900, 700]}')
    assert read_box(tmp_path / "small.json") == box
    other = Desk(desk.view, [].append)
    other.known = replace(other.known, presets=(Preset("Mine", Brush(radius=4.0)),))
    restore_window(other, kept)
    restore_found(other, kept_window.found_again(kept))
    assert (other.hand.brush.radius, other.hand.original.radius, other.hand.preset) == (77.0, 4.0, "Mine")
    assert (other.hand.colour, other.export.format, other.opened.folders) == (
        (1.0, 0.0, 0.0),
        "exr",
        {"Film": tmp_path},
    )
    assert other.remembered.folded == {"Layers": False}
    assert (other.solid.made, other.solid.name) == (("marble", 1, (("warp", 0.4),)), "teapot")


@pytest.mark.parametrize(("strip", "opened"), [("lab", "lab"), ("of a newer program", "")])
def test_what_was_open_below_the_canvas_is_again_once_the_engine_is_there(desk, strip, opened):
    restore_window(desk, KeptWindow(strip=strip, export=ExportState("of a newer program")))
    watched = Remembering(lambda: None, ("lab", "match"))
    watched.watch(desk, 1.0)
    assert desk.strip == ""
    desk.learn(ready=True)
    watched.watch(desk, 3.0)
    assert (desk.strip, desk.export.area) == (opened, "frame")


def test_folders_that_are_gone_and_brushes_that_are_gone_are_not_laid_there(desk, tmp_path):
    kept = KeptWindow(folders=(("Film", str(tmp_path / "gone")),), hand=KeptHand(Preset("Gone", Brush(radius=9.0))))
    restore_found(desk, kept_window.found_again(kept))
    assert (desk.opened.folders, desk.hand.preset) == ({}, "")


DAMAGED = (
    "", "[]", "{", "null", '"\\ud800"', "[" * 100_000, '{"box": [1, 2, 3]}', '{"box": [0, 0, 9, 9]}',
    '{"box": [0, 0, 800, 1e300]}', '{"welcomed": 3}', '{"folded": {"a": 1}}', '{"folders": []}',
    '{"folders": {"a": 2}}',
    '{"brush": 7}', '{"brush": {"name": "a", "radius": "wide"}}', '{"colours": ["red", "blue"]}', '{"colours": 3}',
    '{"export": {"finer": 99}}', '{"export": {"area": null}}', '{"stabiliser": 1e999}', '{"strip": {}}', "\0\0",
    '{"solid": 1}', '{"solid": {"seed": 1.5}}', '{"solid": {"scale": 9e9}}',
    '{"solid": {"values": {"wood": {"warp": "much"}}}}',
)  # fmt: skip


@pytest.mark.parametrize("text", DAMAGED)
def test_a_damaged_file_is_told_in_a_line_and_put_aside(desk, tmp_path, text):
    path = tmp_path / "window.json"
    path.write_text(text)
    kept, fault = read_window(path)
    read_box(path)
    assert kept == KeptWindow()
    assert fault.startswith("window.json: ")
    assert "\n" not in fault
    desk.work(KeepWindow(KeptWindow(welcomed=True)))
    assert (tmp_path / "window.damaged.json").read_text() == text
    assert read_window(path) == (KeptWindow(welcomed=True), "")


def test_each_cut_of_a_file_is_read_or_told(desk, tmp_path):
    path = tmp_path / "window.json"
    desk.work(KeepWindow(KeptWindow(WindowBox((0, 0, 800, 600)), hand=KeptHand(Preset("A", Brush())))))
    data = path.read_bytes()
    for place in range(0, len(data), 9):
        path.write_bytes(data[:place])
        assert read_window(path)[1].startswith("window.json: ")
        assert read_box(path) is None


def test_a_window_comes_up_on_a_screen_and_no_larger_than_that():
    screens = [(0, 0, 1280, 800), (1280, 0, 1920, 1080)]
    assert fitted_box((1400, 100, 800, 600), screens) == ((1400, 100, 800, 600), True)
    assert fitted_box((1000, 300, 4000, 3000), screens) == ((1280, 0, 1920, 1080), True)
    assert not fitted_box((5000, 5000, 800, 600), screens)[1]
    assert fitted_box((3, 4, 500, 400), []) == ((3, 4, 500, 400), False)
    assert box_in_points((5, 6), (1600, 1200), (1600, 1200), 2.0) == WindowBox((5, 6, 800, 600))
    assert box_in_points((5, 6), (800, 600), (1600, 1200), 2.0) == WindowBox((5, 6, 800, 600))


def shown(desk, serial, path):
    desk.known = replace(
        desk.known, scene=Scene(Rect(0, 0, 640, 400), (), None, False, False, False, path, serial=serial)
    )


def test_a_painting_is_seen_again_as_it_was_left(desk, tmp_path):
    path, watched = tmp_path / "a.ora", ViewsWatched()
    shown(desk, 1, path)
    desk.view = replace(desk.view, centre=Place((1 << 90) + 12345, 77, 80), level=60, fraction=0.25, angle=0.5)
    watched.watch(desk, 1.0)
    left = desk.view
    shown(desk, 2, tmp_path / "b.ora")
    show_as_before(desk, tmp_path / "b.ora")
    assert desk.view.level < 5
    watched.watch(desk, 2.0)
    desk.remembered.views = {}
    desk.work(ReadViews())
    show_as_before(desk, path)
    assert (desk.view.level, desk.view.angle) == (60, pytest.approx(0.5))
    assert desk.view.to_screen(left.to_canvas(300, 200)) == pytest.approx((300, 200), abs=1.0)


@pytest.mark.parametrize("text", ["[]", '{"a": 3}', '{"a": {"do": "undo"}}', '{"a": {"do": "bookmark"}}'])
def test_views_that_are_none_are_told_and_put_aside(desk, tmp_path, text):
    path = tmp_path / "views.json"
    path.write_text(text)
    desk.work(ReadViews())
    assert desk.message.bad
    assert desk.message.text.startswith("views.json: ")
    shown(desk, 1, tmp_path / "a.ora")
    watched = ViewsWatched()
    watched.watch(desk, 1.0)
    watched.end(desk)
    assert (tmp_path / "views.damaged.json").read_text() == text
    assert len(views_of(json.loads(path.read_text()))) == 1
