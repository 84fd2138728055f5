"""Matching on the engine's thread: step by step, the newest first, and what is used is what was seen."""

import numpy as np
import pytest
from immutables import Map
from PIL import Image

from engine.brush.settings import from_json, to_json
from engine.numeric.address import Rect
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


class Desk:
    """A studio, and what it has sent."""

    def __init__(self):
        self.sent = []
        self.studio = Studio(self.sent.append, self.sent.append)

    def ask(self, *requests):
        for request in requests:
            self.studio.do(request)

    def rest(self):
        steps = 0
        while self.studio.step():
            steps += 1
            assert steps < 5000
        return steps

    def pictures(self, ident):
        return [r.pixels for r in self.sent if isinstance(r, results.Picture) and r.ident == ident]

    @property
    def scene(self):
        return next(r for r in reversed(self.sent) if isinstance(r, tr.MatchScene))


@pytest.fixture
def desk():
    one = Desk()
    yield one
    one.studio.close()


@pytest.fixture
def example(tmp_path):
    pixels = np.random.default_rng(2).integers(0, 256, (12, 14, 3), np.uint8)
    Image.fromarray(pixels).resize((56, 48)).save(tmp_path / "a.png")
    Image.fromarray(pixels[::-1]).resize((40, 48)).save(tmp_path / "b.png")
    return tmp_path


def members(folder, **more):
    return Map({"path": str(folder / "a.png"), "size": (48, 32), "levels": 2, **more})


def test_a_preview_grows_step_by_step(desk, example):
    desk.ask(tq.MatchSet("match", members(example)))
    assert desk.rest() > 20
    assert len(desk.pictures("match texture")) == 5
    assert desk.pictures("match texture")[-1].shape == (32, 48, 4)
    assert desk.pictures("match example")[0].shape == (48, 56, 4)
    assert (desk.scene.done, desk.scene.levels, desk.scene.orientations) == (1.0, 2, 4)
    assert len(desk.scene.colours) == 3
    assert desk.scene.sizes == ((56, 48),)
    assert not desk.studio.pending


def test_a_structure_is_seen_soon_then_as_it_is_used(desk, example):
    given = Map({"path": str(example / "a.png"), "size": (48, 32), "structure": "objects"})
    desk.ask(tq.MatchSet("match", given))
    assert desk.rest() > 60
    seen = desk.pictures("match texture")
    assert {picture.shape for picture in seen} == {(32, 48, 4)}
    assert np.abs(seen[0].astype(int) - seen[-1]).mean() > 5  # first by histograms alone
    done = [r.done for r in desk.sent if isinstance(r, tr.MatchScene)]
    assert done == sorted(done)
    assert desk.scene.done == 1.0
    assert 0.0 <= desk.scene.copied <= 1.0
    desk.ask(tq.MatchUse("Stone", "match", given))
    assert desk.rest() < 4  # nothing is done twice
    made = desk.studio.easel.session.painting.textures["Stone"]
    assert made.parameters["structure"] == "objects"
    assert np.abs(made.source.data[:3].transpose(1, 2, 0) * 255 - seen[-1][..., :3]).max() < 0.51


def test_a_translucent_example_is_seen_and_used_so(desk, example):
    pixels = np.random.default_rng(4).integers(0, 256, (12, 14, 4), np.uint8)
    pixels[3:9, 3:9, 3] = 0
    Image.fromarray(pixels).resize((56, 48)).save(example / "a.png")
    given = members(example)
    desk.ask(tq.MatchSet("match", given))
    desk.rest()
    for ident in ("match example", "match texture"):
        seen = desk.pictures(ident)[-1]
        assert seen[..., 3].min() < 20
        assert (seen[..., :3] <= seen[..., 3:]).all()
    assert len(desk.scene.colours) == 4
    assert all(len(colour) == 3 for colour in desk.scene.colours)
    desk.ask(tq.MatchUse("Lace", "match", given))
    desk.rest()
    made = desk.studio.easel.session.painting.textures["Lace"]
    assert np.abs(made.source.data.transpose(1, 2, 0) * 255 - desk.pictures("match texture")[-1]).max() < 0.51
    assert made.instance({}, 0, 0).cover is not None
    given = given.set("axes", (1.0, 1.0, 0.5, 0.0))
    desk.ask(tq.MatchSet("match", given))
    desk.rest()
    assert not desk.scene.fault


def test_the_newest_settings_win_and_tiles_come_first(desk, example):
    desk.ask(tq.MatchSet("match", members(example)))
    for _ in range(8):
        desk.studio.step()
    desk.ask(tq.MatchSet("match", members(example, iterations=1, seed=5)))
    desk.studio.look(q.Look(((0, 0, 0, -1),)))
    desk.studio.step()
    assert any(isinstance(r, results.Patch | results.Same) for r in desk.sent)
    desk.rest()
    assert len(desk.pictures("match texture")) == 1
    assert len(desk.pictures("match example")) == 1  # it is the same
    desk.ask(tq.MatchSet("match", None))
    assert not desk.studio.pending
    assert desk.scene.done == 0.0


def test_what_is_used_is_what_was_seen_and_replays(desk, example):
    given = members(example)
    desk.ask(tq.MatchSet("match", given))
    desk.rest()
    seen = desk.pictures("match texture")[-1]
    desk.ask(tq.MatchUse("Stone", "match", given))
    assert desk.rest() < 4  # nothing is done twice
    texture = desk.studio.easel.session.painting.textures["Stone"]
    assert texture.kind == "matched"
    assert np.abs(texture.source.data[:3].transpose(1, 2, 0) * 255 - seen[..., :3]).max() < 0.51
    (command,) = desk.studio.easel.session.log
    painting = Painting(arithmetic=desk.studio.easel.session.painting.arithmetic)
    alone = apply(painting, c.DefineTexture("Stone", "match", given)).textures["Stone"]
    assert alone.source.sha == texture.source.sha == command.arguments["sha"]
    assert alone.parameters == texture.parameters.delete("sha")


def test_a_series_is_made_for_use_between_strokes(desk, example):
    given = members(example, pattern=str(example / "b.png"), how="average")
    desk.ask(tq.MatchSet("mix", given), tq.MatchUse("Both", "mix", given.set("stages", 3)))
    desk.ask(q.Begin(0, (0, 0), from_json({"radius": 4})), q.Points(np.array([[0.0, 0, 1, 0, 0, 0]])))
    for _ in range(3000):
        desk.studio.step()
    assert not desk.studio.pending
    assert "Both" not in desk.studio.easel.session.painting.textures
    desk.ask(q.Points(np.array([[9.0, 0, 1, 0, 0, 0]])), q.Finish())
    desk.rest()
    assert desk.studio.easel.session.painting.textures["Both"].kind == "series"
    log = desk.studio.easel.session.log
    assert [type(command) for command in log] == [c.Stroke, c.DefineTexture]
    again = replay(Recording(desk.studio.easel.session.recording().header, tuple(log))).painting
    assert again.textures["Both"].source.sha == desk.studio.easel.session.painting.textures["Both"].source.sha


def test_a_rectangle_is_taken_as_the_canvas_is_now(desk):
    ink = [{"texture": "rock", "period": 8, "colour": "#ffffff"}]
    brush = from_json({"radius": 40, "colour": "#402010", "dynamics": {}, "ink": ink})
    desk.ask(q.New(Rect.at(0, 0, 64, 48)))

    def stroke(colour):
        points = np.array([[0.0, 24, 1, 0, 0, 0], [64.0, 24, 1, 0, 0, 0]])
        desk.ask(q.Do(c.Stroke(0, (0, 0), points, from_json({**to_json(brush), "colour": colour}))))

    stroke("#402010")
    given = Map({"rect": (0, 0, 0, 64, 48), "size": (32, 32), "levels": 2})
    desk.ask(tq.MatchSet("match", given))
    desk.rest()
    stroke("#1020ff")
    desk.ask(tq.MatchUse("View", "match", given))
    desk.rest()
    blue = desk.studio.easel.session.painting.textures["View"].source.data[:3].mean((1, 2))
    assert blue[2] > blue[0]
    log = desk.studio.easel.session.log
    again = replay(Recording(desk.studio.easel.session.recording().header, tuple(log))).painting
    assert again.textures["View"].source.sha == desk.studio.easel.session.painting.textures["View"].source.sha


@pytest.mark.parametrize(
    ("given", "message"),
    [({"path": "/nowhere/a.png"}, "/nowhere/a.png"), ({"path": "a", "levels": -1}, "a"), ({}, "path: found nothing")],
)
def test_faults_are_told_and_end_the_work(desk, given, message):
    desk.ask(tq.MatchSet("match", Map(given)))
    desk.rest()
    assert message in desk.scene.fault
    assert not desk.studio.pending
