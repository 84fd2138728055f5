"""The easel: whatever is done and looked at, the window ends up with the picture that the painting is."""

import json
import time
from collections import deque

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.brush.settings import Brush, Component
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.value import Leak, Refusal
from engine.session.apply import apply
from engine.studio import faults, results
from engine.studio import requests as q
from engine.studio.filing.documents import opened
from engine.studio.sight import tile_rect
from engine.studio.studio import Studio
from opens import opens


class Window:
    """A window's memory of what it was sent."""

    def __init__(self):
        self.tiles, self.revisions, self.other = {}, {}, []
        self.posted = deque()
        self.studio = Studio(self.take, self.posted.append)

    def take(self, result):
        if isinstance(result, results.Patch):
            assert not result.pixels.flags.writeable
            whole = result.area.width == q.SCREEN_TILE and result.area.height == q.SCREEN_TILE
            if result.tile not in self.tiles:
                assert whole, "a part of a tile that the window never had"
                self.tiles[result.tile] = np.zeros((q.SCREEN_TILE, q.SCREEN_TILE, 4), np.uint8)
            a = result.area
            self.tiles[result.tile][a.y0 : a.y1, a.x0 : a.x1] = result.pixels
            self.revisions[result.tile] = result.revision
        elif isinstance(result, results.Same):
            self.revisions.update(dict.fromkeys(result.tiles, result.revision))
        else:
            self.other.append(result)
            if isinstance(result, results.Scene) and result.serial != getattr(self, "serial", 0):
                self.serial = result.serial
                self.tiles.clear()
                self.revisions.clear()

    def look(self, *tiles):
        self.studio.look(q.Look(tuple((*tile, self.revisions.get(tile, -1)) for tile in tiles)))

    def work(self):
        while self.studio.pending:
            self.studio.step()

    def written(self):
        """Waits for the files that are being written, and for what comes of it."""
        self.studio.close()
        while self.posted:
            self.studio.do(self.posted.popleft())

    def scene(self):
        return next(r for r in reversed(self.other) if isinstance(r, results.Scene))

    def check(self, *tiles):
        """What the window shows of these tiles is what the painting is."""
        for tile in tiles:
            assert np.array_equal(self.tiles[tile], to_premul8(self.studio.easel.picture(tile[0], tile_rect(tile)))), (
                tile
            )


def line(n, x=20.0, y=40.0, dx=9.0, dy=3.0):
    points = np.zeros((n, 6))
    points[:, 0] = x + dx * np.arange(n)
    points[:, 1] = y + dy * np.arange(n)
    points[:, 2] = 1.0
    return points


LEVELS = (-1, 0, 2)
VIEWS = {level: tuple((level, x, y) for x in (-1, 0) for y in (-1, 0)) for level in LEVELS}
BRUSHES = (
    Brush(radius=9.0),
    Brush(radius=30.0, opacity=0.5, colour="#cc2200"),
    Brush(radius=20.0, mode="erase"),
    Brush(radius=14.0, ink=(Component("rock", 0.7, "#88aaff"),)),
)
BRUSH_NUMBERS = st.sampled_from(range(len(BRUSHES)))
DEEDS = st.lists(
    st.one_of(
        st.tuples(st.sampled_from(["begin", "stroke", "stroke", "given up"]), st.sampled_from(LEVELS), BRUSH_NUMBERS),
        st.tuples(st.just("points"), st.floats(-120, 200), st.floats(-120, 200)),
        st.tuples(st.sampled_from(["finish", "undo", "undo", "redo", "add", "hide", "work", "half"])),
        st.tuples(st.just("look"), st.sampled_from(LEVELS)),
    ),
    min_size=4,
    max_size=16,
)


@given(DEEDS)
@settings(deadline=None, max_examples=60)
def test_the_window_ends_up_with_the_picture(deeds):
    window = Window()
    level = 0
    window.look(*VIEWS[0])
    for deed in deeds:
        match deed:
            case ("begin", at, brush):
                window.studio.do(q.Begin(at, (0, 0), BRUSHES[brush]))
            case ("stroke" | "given up" as end, at, brush):
                window.studio.do(q.Begin(at, (0, 0), BRUSHES[brush]))
                window.studio.do(q.Points(line(5, -30.0)))
                window.work()
                window.studio.do(q.Points(line(5, 50.0, 0.0)))
                window.studio.do(q.Finish() if end == "stroke" else q.Abandon())
            case ("points", x, y):
                window.studio.do(q.Points(line(5, x, y)))
            case ("finish",):
                window.studio.do(q.Finish())
            case ("undo",):
                window.studio.do(q.Do(c.Undo()))
            case ("redo",):
                window.studio.do(q.Do(c.Redo()))
            case ("add",):
                names = {row.name for row in window.scene().layers}
                window.studio.do(q.Do(c.AddLayer(f"Another {len(names)}")))
            case ("hide",):
                for row in window.scene().layers[:1]:
                    window.studio.do(q.Do(c.SetLayer(row.name, visible=not row.visible)))
            case ("look", at):
                level = at
                window.look(*VIEWS[level])
            case ("work",):
                window.work()
            case ("half",):
                window.studio.step()
        if deed[0] in ("work", "undo", "look"):
            window.work()
            window.check(*VIEWS[level])
    window.studio.do(q.Finish())
    for other in LEVELS:
        window.look(*VIEWS[other])
        window.work()
        window.check(*VIEWS[other])


def test_what_is_shown_while_the_pen_moves_is_what_is_committed():
    window = Window()
    window.look(*VIEWS[0])
    window.work()
    window.studio.do(q.Begin(0, (0, 0), BRUSHES[3]))
    for k in range(4):
        window.studio.do(q.Points(line(6, 20.0 + 40 * k)))
        window.work()
    shown = {tile: window.tiles[tile].copy() for tile in VIEWS[0]}
    window.studio.do(q.Finish())
    window.tiles.clear()
    window.revisions.clear()
    window.look(*VIEWS[0])
    window.work()
    for tile in VIEWS[0]:
        assert np.array_equal(window.tiles[tile], shown[tile])


def test_points_that_wait_are_painted_before_any_picture_is_made():
    window = Window()
    window.look(*VIEWS[0])
    window.work()
    sent = len(window.revisions)
    window.studio.do(q.Begin(0, (0, 0), BRUSHES[0]))
    for _ in range(10):
        window.studio.do(q.Points(line(3)))
    assert len(window.revisions) == sent
    assert window.studio.pending


def test_a_tile_far_from_the_change_is_not_made_anew():
    window = Window()
    far = ((0, 40, 40),)
    window.look(*far)
    window.work()
    pixels = window.tiles[far[0]]
    window.studio.do(q.Begin(0, (0, 0), BRUSHES[0]))
    window.studio.do(q.Points(line(4)))
    window.studio.do(q.Finish())
    window.work()
    assert window.tiles[far[0]] is pixels
    assert window.revisions[far[0]] == window.studio.easel.viewer.sight.revision


def test_the_stroke_of_the_pen_is_the_stroke_of_the_command():
    window = Window()
    window.studio.do(q.Begin(1, (7, -3), BRUSHES[1]))
    for k in range(3):
        window.studio.do(q.Points(line(4, 30.0 * k)))
    window.studio.do(q.Finish())
    stroke = window.studio.easel.session.log[-1]
    assert isinstance(stroke, c.Stroke)
    again = apply(Window().studio.easel.session.painting, stroke)
    other = Window()
    other.studio.easel.session.painting = again
    rect = Rect(0, 0, 200, 200)
    assert np.array_equal(other.studio.easel.picture(1, rect), window.studio.easel.picture(1, rect))


def test_the_scene_tells_what_the_panels_show():
    window = Window()
    assert window.scene().layers == ()
    window.studio.do(q.Do(c.AddLayer("Low")))
    window.studio.do(q.Do(c.AddLayer("Group", kind="group")))
    window.studio.do(q.Do(c.AddLayer("In it", group="Group")))
    scene = window.scene()
    assert [(r.name, r.group, r.depth, r.parent, r.position) for r in scene.layers] == [
        ("Group", True, 0, None, 1),
        ("In it", False, 1, "Group", 0),
        ("Low", False, 0, None, 0),
    ]
    assert scene.can_undo
    assert scene.modified
    assert scene.active == "In it"


def test_picking_takes_the_colour_that_is_seen():
    window = Window()
    window.studio.do(q.Begin(0, (0, 0), Brush(radius=20.0, hardness=1.0, colour="#336699")))
    window.studio.do(q.Points(line(2, 50.0, 50.0, 4.0, 0.0)))
    window.studio.do(q.Pick(0, 52, 50))
    found = window.other[-1]
    assert found.alpha == 1.0
    assert np.allclose(found.rgb, (0x33 / 255, 0x66 / 255, 0x99 / 255), atol=1e-3)
    window.studio.do(q.Pick(0, 500, 500))
    assert window.other[-1].alpha == 0.0


def test_a_disc_gives_the_mean_of_its_paint_and_a_layer_what_it_has_alone():
    window = Window()
    for layer, colour, x in (("Low", "#ff0000", 0), ("High", "#0000ff", 200)):
        window.studio.do(q.Do(c.AddLayer(layer)))
        window.studio.do(q.Begin(0, (0, 0), Brush(radius=40.0, hardness=1.0, colour=colour, dynamics=Map())))
        window.studio.do(q.Points(line(2, float(x), 50.0, 100.0, 0.0)))
        window.studio.do(q.Finish())
    picks = [(95, 0, None), (200, 0, None), (200, 0, "Low"), (200, 0, "none of that name"), (150, 60, None)]
    for x, radius, layer in picks:
        window.studio.do(q.Pick(0, x, 50, radius, layer))
    red, blue, nothing, seen, both = [found for found in window.other if isinstance(found, results.Picked)]
    assert (red.rgb, blue.rgb, seen.rgb) == ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 1.0))
    assert nothing.alpha == 0.0
    assert both.rgb[0] == pytest.approx(both.rgb[2], abs=0.05)
    assert both.rgb[0] + both.rgb[2] == pytest.approx(1.0, abs=0.01)
    assert 0.3 < both.alpha < 0.9
    window.studio.do(q.Do(c.SetLayer("High", opacity=0.5, visible=False)))
    window.studio.do(q.Pick(0, 200, 50, 0, "High"))
    assert (window.other[-1].rgb, window.other[-1].alpha) == ((0.0, 0.0, 1.0), 1.0)


@pytest.mark.parametrize("mode", ["paint", "erase", "smooth"])
def test_a_preset_paints_its_own_thumbnail(mode):
    window = Window()
    window.studio.do(q.Swatch("it", Brush(radius=10.0, mode=mode), (104, 44)))
    picture = window.other[-1]
    assert picture.pixels.shape == (44, 104, 4)
    assert len(np.unique(picture.pixels[..., 3])) > 4


def test_the_ink_mixers_picture_is_covered_everywhere_and_shows_more_when_nearer():
    window = Window()
    brush = Brush(radius=16.0, colour="#203040", ink=(Component("rock", 0.8, "#ffffff"),))
    window.studio.do(q.Swatch("ink", brush, (96, 48), "fill"))
    flat = window.other[-1].pixels
    assert (flat[..., 3] == 255).all()
    assert flat[..., 0].std() > 4
    window.studio.do(q.Swatch("near", brush, (96, 48), "fill", 4))
    assert window.other[-1].pixels[..., 0].std() > 1


def test_a_file_that_was_written_is_known_when_its_post_is_carried_out(tmp_path):
    window = Window()
    window.studio.do(q.Do(c.AddLayer("more")))
    window.studio.do(q.Save(tmp_path / "p.ora"))
    window.studio.close()
    assert window.scene().modified
    assert window.studio.easel.path is None
    window.other.clear()
    window.written()
    scene, saved, writing = window.other
    assert (scene.path, scene.modified) == (tmp_path / "p.ora", False)
    assert saved == results.Saved(tmp_path / "p.ora")
    assert writing == results.Writing()


def test_a_file_that_cannot_be_written_is_told_and_leaves_the_painting_modified(tmp_path):
    window = Window()
    window.studio.do(q.Do(c.AddLayer("more")))
    window.studio.do(q.Save(tmp_path / "missing" / "p.ora"))
    window.written()
    note, writing = window.other[-2:]
    assert note.bad
    assert str(tmp_path) in note.text
    assert writing == results.Writing()
    assert window.studio.easel.modified


def test_saving_and_opening_give_the_same_picture(tmp_path):
    window = Window()
    window.studio.do(q.Begin(0, (0, 0), BRUSHES[3]))
    window.studio.do(q.Points(line(12)))
    window.studio.do(q.Finish())
    window.studio.do(q.Save(tmp_path / "p.ora"))
    window.written()
    assert any(isinstance(r, results.Saved) for r in window.other)
    assert not window.scene().modified
    other = Window()
    opens(other.studio, other.posted, tmp_path / "p.ora")
    assert other.scene().path == tmp_path / "p.ora"
    assert not other.scene().modified
    for level in LEVELS:
        other.look(*VIEWS[level])
        other.work()
        for tile in VIEWS[level]:
            assert np.array_equal(other.tiles[tile], to_premul8(window.studio.easel.picture(level, tile_rect(tile))))
    assert other.studio.easel.session.log


def test_a_recording_plays_to_the_same_painting_live_or_not(tmp_path):
    lines = [
        '{"inkfall": 1, "frame": [0, 0, 200, 200], "seed": 3}',
        '{"do": "view", "level": 0, "origin": [0, 0], "size": [200, 200]}',
        '{"do": "stroke", "points": [[10, 10], [60, 90], [120, 40]], "brush": {"radius": 7}}',
        '{"do": "stroke", "level": 1, "points": [[50, 50], [90, 60]], "brush": {"radius": 20, "mode": "erase"}}',
    ]
    (tmp_path / "r.jsonl").write_text("\n".join(lines) + "\n")
    pictures = []
    for live in (False, True):
        window = Window()
        opens(window.studio, window.posted, tmp_path / "r.jsonl", live)
        while window.studio.due is not None:
            window.studio.play()
        assert any(isinstance(r, results.Looked) for r in window.other)
        pictures.append(window.studio.easel.picture(1, Rect(0, 0, 400, 400)))
    assert np.array_equal(*pictures)
    assert pictures[0][3].max() > 0.5


LONG = (
    '{"inkfall": 1, "frame": [0, 0, 200, 200], "seed": 3}\n'
    '{"do": "stroke", "points": [[10, 10], [60, 90], [120, 40], [150, 150], [20, 120]], "brush": {}, "by": "x"}\n'
)


@pytest.fixture
def half_played(tmp_path, monkeypatch):
    """A window in which a recording plays, in the middle of its only stroke."""
    monkeypatch.setattr("engine.studio.filing.playing.PIECE", 1e-6)  # one point at a time
    (tmp_path / "long.jsonl").write_text(LONG)
    window = Window()
    opens(window.studio, window.posted, tmp_path / "long.jsonl", True)
    window.studio.play()
    assert window.studio.easel.live is not None
    return window


def _played_out(window):
    end = time.monotonic() + 90
    while window.studio.due is not None:
        assert time.monotonic() < end, "the recording does not end"
        window.studio.play()
    return [type(command) for command in window.studio.easel.session.log]


@pytest.mark.parametrize("request_", [q.Begin(0, (0, 0), Brush()), q.Do(c.AddLayer("New"))])
def test_a_recordings_stroke_is_whole_though_the_artist_does_something_meanwhile(half_played, request_):
    window = half_played
    window.studio.do(request_)
    stroke = window.studio.easel.session.log[0]
    assert len(stroke.points) == 5
    assert dict(stroke.extra) == {"by": "x"}
    if isinstance(request_, q.Begin):
        window.studio.do(q.Points(line(3)))
        for _ in range(5):
            window.studio.play()  # the hand's stroke comes first
        window.studio.do(q.Points(line(2)))
        window.studio.do(q.Finish())
        assert [len(command.points) for command in window.studio.easel.session.log] == [5, 5]
    assert len(_played_out(window)) == 2


LEAKING = '{"inkfall": 2, "frame": [0, 0, 90, 90], "seed": 3}\n{"do": "fill", "like": {"at": [5, 5]}, "brush": {}}\n'
RUNS_OUT = "found a region that reaches the border of 90 x 90 at 0, 0, expected one within, or open"


def test_a_fill_of_a_file_that_leaks_is_told_of_and_asks_nobody(tmp_path):
    """The question is for those who just filled."""
    path = tmp_path / "leaking.jsonl"
    path.write_text(LEAKING)
    assert opened(path).notes == (f"line 2: fill: {RUNS_OUT}",)
    window = Window()
    opens(window.studio, window.posted, path, True)
    with pytest.raises(Refusal, match=RUNS_OUT) as refused:
        window.studio.play()
    assert faults.told(refused.value, "").offers == ()
    with pytest.raises(Leak):
        window.studio.do(q.Do(c.parse(json.loads(LEAKING.splitlines()[1]))))


def test_points_of_a_stroke_that_was_refused_do_not_join_the_recordings(half_played):
    window = half_played
    window.studio.do(q.Points(line(3)))
    window.studio.do(q.Abandon())
    assert _played_out(window) == [c.Stroke]
    assert len(window.studio.easel.session.log[0].points) == 5


@pytest.mark.parametrize("swelling", [False, True])
def test_the_artist_is_told_whether_the_filter_that_continues_a_texture_is_stable(swelling):
    """A filter that continues what swells along a row would swell for ever."""
    window = Window()
    if swelling:
        for x in range(20, 64):
            colour = f"#{min(round(1.3 ** (x - 40)) + 1, 255):02x}0000"
            brush = Brush(radius=3.0, hardness=1.0, colour=colour)
            window.studio.do(q.Do(c.Stroke(0, (x, 0), line(40, 0, 0, 0, 2), brush)))
    else:
        rocky = Brush(radius=40.0, ink=(Component("rock", 0.9, "#88aaff", Map({"period": 9.0})),))
        window.studio.do(q.Do(c.Stroke(0, (0, 0), line(3), rocky)))
    op = Map({"name": "predict", "reach": 3, "window": 32})
    window.studio.do(q.Begin(0, (40, 40), Brush(radius=5.0, mode="raster", op=op)))
    window.studio.do(q.Points(line(2, 0, 0)))
    window.studio.do(q.Finish())
    [told] = [r.text for r in window.other if isinstance(r, results.Note)]
    how, poles = told.removeprefix("Continued by a filter of reach 3: ").split(", poles to ")
    assert how == ("made stable" if swelling else "stable")
    assert 0.0 < float(poles) < 1.0
