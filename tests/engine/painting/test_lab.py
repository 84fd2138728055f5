"""The texture lab on the engine's thread: what it shows is what its command makes, undone and redone alike."""

from dataclasses import replace

import numpy as np
import pytest
from immutables import Map

from engine.brush.parts import Component, Surface
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.numeric.arithmetic import NEWEST
from engine.numeric.spectra import opposite
from engine.painting import commands as c
from engine.painting.recording import Recording
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio import results
from engine.studio.studio import Studio
from engine.studio.textures import texture_requests as tq
from engine.studio.textures import texture_results as tr

RING = tq.LabSet((64, 64), (Map({"shape": "ring"}),), seed=3)
WHITE = Brush(radius=5, colour="#ffffff")


class Desk:
    """A studio, and what it has sent."""

    def __init__(self):
        self.sent = []
        self.studio = Studio(self.sent.append, self.sent.append)

    def ask(self, *requests):
        for request in requests:
            self.studio.do(request)
        while self.studio.step():
            pass

    def picture(self, ident):
        return next(r for r in reversed(self.sent) if isinstance(r, results.Picture) and r.ident == ident).pixels

    @property
    def scene(self):
        return next(r for r in reversed(self.sent) if isinstance(r, tr.LabScene))

    def stroke(self, *points, brush=WHITE, kept=True):
        rows = [np.array([[x, y, 1.0, 0, 0, 0]]) for x, y in points]
        self.ask(tq.LabBegin(brush), *map(tq.LabPoints, rows), tq.LabEnd(kept))

    @property
    def log(self):
        return self.studio.easel.session.log


@pytest.fixture
def desk():
    one = Desk()
    yield one
    one.studio.close()


def sample_of(command):
    return apply(Painting(arithmetic=NEWEST), command).textures[command.name].source


def test_the_lab_shows_what_its_command_makes(desk):
    desk.ask(RING)
    desk.stroke((10, 12), (30, 20), (50, 14))
    desk.ask(tq.LabUse("Fur"))
    command = desk.log[-1]
    assert command.maker == "spectrum"
    source = desk.studio.easel.session.painting.textures["Fur"].source
    assert source == sample_of(c.parse(c.to_json(command)))
    shown = np.rint(source.data[0] * 255).astype(int)
    assert np.abs(shown - desk.picture("lab texture")[..., 0]).max() <= 1  # halves may round either way
    assert desk.scene.using == "Fur"


def test_a_stroke_is_seen_at_both_frequencies_while_it_is_painted(desk):
    desk.ask(tq.LabSet((64, 64)))
    assert desk.scene.silent
    desk.ask(tq.LabBegin(WHITE), tq.LabPoints(np.array([[20.0, 22, 1, 0, 0, 0]])))
    shown = desk.picture("lab spectrum")[..., 0]
    assert shown[22, 20] == shown[42, 44] == 255
    assert np.array_equal(opposite(shown), shown)
    assert not desk.scene.silent
    assert desk.scene.strokes == 0
    desk.ask(tq.LabEnd(kept=False))
    assert desk.scene.silent


def test_undo_redo_and_clear(desk):
    desk.ask(RING)
    seen = [desk.picture("lab texture")]
    for x in (12, 26, 40):
        desk.stroke((x, 10), (x, 20))
        seen.append(desk.picture("lab texture"))
    desk.ask(tq.LabStep(-2))
    assert np.array_equal(desk.picture("lab texture"), seen[1])
    desk.ask(tq.LabStep(1))
    assert np.array_equal(desk.picture("lab texture"), seen[2])
    desk.ask(tq.LabStep(0))
    assert np.array_equal(desk.picture("lab texture"), seen[0])
    assert (desk.scene.strokes, desk.scene.can_undo, desk.scene.can_redo) == (0, True, False)
    desk.ask(tq.LabStep(-1))
    assert np.array_equal(desk.picture("lab texture"), seen[2])
    desk.ask(tq.LabStep(9))
    assert desk.scene.strokes == 0
    desk.ask(tq.LabStep(-5), tq.LabStep(-1), tq.LabStep(2))
    assert np.array_equal(desk.picture("lab texture"), seen[2])


def test_other_shapes_slide_under_the_strokes(desk):
    desk.ask(RING)
    desk.stroke((10, 12), (30, 20))
    desk.stroke((10, 40), (30, 40))
    desk.ask(tq.LabSet((64, 64), (Map({"shape": "noise", "b": 1.0}),), seed=3))
    changed = desk.picture("lab texture")
    desk.ask(
        tq.LabStep(-1),
        tq.LabSet((64, 64), RING.shapes, seed=3),
        tq.LabStep(1),
    )
    other = desk.picture("lab texture")
    desk.ask(tq.LabSet((64, 64), (Map({"shape": "noise", "b": 1.0}),), seed=3))
    assert np.array_equal(desk.picture("lab texture"), changed)
    assert not np.array_equal(other, changed)


def test_a_texture_in_use_follows_the_lab_and_the_next_stroke_paints_with_it(desk):
    desk.ask(RING, tq.LabUse("Cloth"))
    before = desk.studio.easel.session.painting.textures["Cloth"].source.sha
    version = desk.scene.version
    desk.stroke((10, 12), (30, 20))
    brush = Brush(radius=20, colour="#000000", ink=(Component("Cloth"),))
    desk.ask(q.Begin(0, (0, 0), brush), q.Points(np.array([[50.0, 50, 1, 0, 0, 0], [90, 60, 1, 0, 0, 0]])), q.Finish())
    painting = desk.studio.easel.session.painting
    assert painting.textures["Cloth"].source.sha != before
    desk.ask(tq.LabRest(WHITE, (80, 40)))
    assert desk.scene.version == version + 1
    assert desk.picture("lab stroke").shape == desk.picture("lab near").shape == (40, 80, 4)
    again = replay(desk.studio.easel.session.recording()).painting
    assert again.textures["Cloth"].source == painting.textures["Cloth"].source
    assert len(desk.log) == 2  # the definition that was painted with, and the stroke


@pytest.mark.parametrize("field", [Map(), Map({"field": "sparse"})])
def test_its_texture_serves_as_paper_and_as_a_dry_brush(desk, field):
    desk.ask(replace(RING, field=field), tq.LabUse("Cloth"))
    plain = Brush(radius=20, colour="#000000", opacity=0.5)  # pressed harder, paint would fill the paper
    points = q.Points(np.array([[50.0, 50, 1, 0, 0, 0], [90, 60, 1, 0, 0, 0]]))
    seen = []
    for brush in (plain, replace(plain, grain=Surface("Cloth", 0.9)), replace(plain, density=Surface("Cloth", 0.9))):
        desk.ask(q.Begin(-1, (0, 0), brush), points, q.Finish())
        seen.append(desk.studio.easel.picture(-1, Rect(60, 45, 80, 65))[3])
        desk.ask(q.Do(c.Undo()))
    assert seen[0].std() < 0.01
    assert seen[1].std() > 0.05
    assert seen[2].std() > 0.05


def test_definitions_that_nothing_was_painted_with_are_not_recorded(desk):
    desk.ask(RING, tq.LabUse("Cloth"))
    for x in (12, 20, 30):
        desk.stroke((x, 10), (x, 20))
        desk.ask(tq.LabRest(WHITE, (40, 20)))
    assert len(desk.log) == 1
    again = replay(desk.studio.easel.session.recording()).painting
    assert again.textures["Cloth"].source == desk.studio.easel.session.painting.textures["Cloth"].source


def test_a_texture_let_go_stays_as_it_is(desk):
    desk.ask(RING, tq.LabUse("Cloth"), tq.LabUse(""))
    desk.stroke((10, 12), (30, 20))
    desk.ask(tq.LabRest(WHITE, (40, 20)))
    assert len(desk.log) == 1


def test_the_spectrum_of_what_is_on_the_canvas(desk):
    points = np.array([[x, 32.0, 1, 0, 0, 0] for x in range(4, 64, 8)])
    brush = Brush(radius=100, ink=(Component("stripes", 1.0, "#ffffff", Map({"period": 8.0})),))
    desk.ask(q.Begin(0, (0, 0), brush), q.Points(points), q.Finish())
    desk.ask(tq.LabSet((64, 64), (Map({"shape": "canvas", "rect": (0, 0, 0, 64, 64)}),)))
    shown = desk.picture("lab spectrum")[32, :, 0].astype(int)
    assert set(np.argsort(shown)[-2:]) == {24, 40}
    desk.ask(tq.LabUse("Seen"))
    again = replay(desk.studio.easel.session.recording()).painting
    assert again.textures["Seen"].source == desk.studio.easel.session.painting.textures["Seen"].source


def test_the_spectrum_of_another_texture_stays_what_it_was(desk):
    points = np.array([[x, 32.0, 1, 0, 0, 0] for x in range(4, 64, 8)])
    brush = Brush(radius=100, ink=(Component("stripes", 1.0, "#ffffff", Map({"period": 8.0})),))
    stroke = q.Begin(0, (0, 0), brush), q.Points(points), q.Finish()
    view = Map({"rect": (0, 0, 0, 64, 64)})
    desk.ask(*stroke, q.Do(c.DefineTexture("View", "canvas", view)))
    desk.ask(tq.LabSet((64, 64), (Map({"shape": "texture", "texture": "View"}),)))
    shown = desk.picture("lab spectrum")
    assert set(np.argsort(shown[32, :, 0])[-2:]) == {24, 40}
    desk.ask(*stroke, tq.LabUse("Seen"), *stroke)
    assert np.array_equal(desk.picture("lab spectrum"), shown)
    again = replay(desk.studio.easel.session.recording()).painting
    assert again.textures["Seen"].source == desk.studio.easel.session.painting.textures["Seen"].source


def test_the_phases_of_what_is_on_the_canvas(desk):
    points = np.array([[x, 32.0, 1, 0, 0, 0] for x in range(4, 64, 8)])
    desk.ask(q.Begin(0, (0, 0), Brush(radius=100, ink=(Component("rock", 1.0),))), q.Points(points), q.Finish())
    made = tq.LabSet((64, 64), (Map({"shape": "canvas", "rect": (0, 0, 0, 64, 64)}),), "painted")
    desk.ask(made)
    flat = desk.picture("lab texture")
    desk.ask(replace(made, phase="own", sheet="phase"))
    own = desk.picture("lab texture")
    assert not np.array_equal(own, flat)
    desk.stroke((10, 12), (30, 20))
    assert not np.array_equal(desk.picture("lab texture"), own)
    desk.ask(tq.LabUse("Seen"))
    again = replay(desk.studio.easel.session.recording()).painting
    assert again.textures["Seen"].source == desk.studio.easel.session.painting.textures["Seen"].source


@pytest.mark.parametrize("shape", [{"shape": "image", "path": "none.png"}, {"shape": "texture", "texture": "None"}])
def test_a_picture_that_is_not_there_is_told_once(desk, shape):
    desk.ask(RING)
    before = desk.picture("lab texture")
    desk.studio.do(tq.LabSet((64, 64), (Map(shape),)))
    with pytest.raises((FileError, FieldError)):
        desk.studio.step()
    assert not desk.studio.pending
    desk.ask(RING)
    assert np.array_equal(desk.picture("lab texture"), before)


def test_another_size_keeps_what_was_painted(desk):
    desk.ask(tq.LabSet((64, 64)))
    desk.stroke((16, 16))
    desk.ask(tq.LabSet((128, 128)))
    assert desk.picture("lab spectrum")[32, 32, 0] == 255


def test_forward_paints_a_pattern_without_its_mirror_image(desk):
    desk.ask(tq.LabSet((64, 64)))
    desk.stroke((16, 16))
    assert desk.picture("lab spectrum")[48, 48, 0] == 255
    desk.ask(tq.LabSet((64, 64), forward=True))
    assert desk.picture("lab spectrum")[16, 16, 0] == 255
    assert desk.picture("lab spectrum")[48, 48, 0] < 40
    desk.ask(tq.LabUse("T"))
    assert desk.studio.easel.session.painting.textures["T"].source == sample_of(c.parse(c.to_json(desk.log[-1])))


def test_the_phase_has_a_sheet_of_its_own(desk):
    desk.ask(RING)
    random = desk.picture("lab texture")
    desk.ask(tq.LabSet((64, 64), RING.shapes, "painted", sheet="phase"))
    flat = desk.picture("lab texture")
    desk.stroke((10, 12), (30, 20))
    assert not np.array_equal(desk.picture("lab texture"), flat)
    assert not np.array_equal(flat, random)
    assert desk.log == []


def test_analysis_comes_piece_by_piece_and_the_newest_counts(desk):
    points = np.array([[32.0, 32.0, 1, 0, 0, 0]])
    desk.ask(q.Begin(0, (0, 0), Brush(radius=10, hardness=1.0)), q.Points(points), q.Finish())
    desk.studio.do(q.Analyse(0, Rect(0, 0, 64, 64)))
    desk.studio.step()
    desk.ask(q.Analyse(0, Rect(0, 0, 96, 64)))
    found = [r for r in desk.sent if isinstance(r, tr.Found)]
    assert [r.done for r in found].count(True) == 1
    assert found[-1].done
    assert found[-1].lines["Size"] == "96 × 64 px"
    assert int(found[-1].lines["Colours"]) >= 2
    for ident in found[-1].pictures:
        assert desk.picture(ident).shape[2] == 4
    assert len(found[-1].pictures) == 4
    assert found[-1].rings
    desk.studio.do(q.Analyse(0, Rect(0, 0, 64, 64)))
    desk.ask(q.Analyse())
    assert [r for r in desk.sent if isinstance(r, tr.Found)][-1] is found[-1]


def test_analysis_of_nothing(desk):
    desk.ask(q.Analyse(0, Rect(-3, 5, 30, 25)))
    found = [r for r in desk.sent if isinstance(r, tr.Found)][-1]
    assert found.done
    assert found.lines["Colours"] == "1"


def test_a_recording_of_the_lab_replays_from_its_lines(desk):
    desk.ask(RING)
    desk.stroke((10, 12), (30, 20), brush=Brush(radius=4, colour="#ffffff", ink=(Component("rock"),)))
    desk.ask(tq.LabUse("A"))
    kept = desk.studio.easel.session.recording()
    again = replay(Recording(kept.header, tuple(c.parse(c.to_json(x)) for x in kept.commands))).painting
    assert again.textures["A"].source == desk.studio.easel.session.painting.textures["A"].source
