"""Paint on solids: where it lies, what covers what, the same in every unit, kept and taken back with the painting."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from immutables import Map

from engine.archive.manifest import FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.painting.commands import parse, to_json
from engine.painting.layering.touch_command import VOXELS, Touch, read_touches, write_touches
from engine.painting.recording import version_of
from engine.painting.value import Painting, Refusal
from engine.session.session import Session
from engine.solids.painted.touching import Touched

STEADY = Map({"opacity": [(0, 1), (1, 1)]})


class _Grey:
    gloss = 0.4

    def colours(self, points, finest):
        return np.full((len(points), 3), 0.5)


def _painted(*strokes):
    return Touched(_Grey(), strokes, VOXELS)


def _stroke(*points, **brush):
    given = {"radius": 12.0, "hardness": 0.5, "colour": "#ff0000", "dynamics": STEADY} | brush
    return Touch("agate", tuple((*map(float, point), 1.0)[:4] for point in points), Brush(**given))


def _plainly(strokes, points):
    """The same, place by place and stroke by stroke: the distance to each part of the line, in the nearest unit."""
    out = np.full((len(points), 3), 0.5)
    for stroke in strokes:
        line = np.array(stroke.points) / VOXELS
        radius, inner = stroke.brush.radius / VOXELS, stroke.brush.hardness * stroke.brush.radius / VOXELS
        cover = np.zeros(len(points))
        for a, b in zip(line[:-1, :3], line[1:, :3], strict=True):
            for shift in np.mgrid[-2:3, -2:3, -2:3].reshape(3, -1).T:
                gone = points + shift - a
                t = np.clip((gone @ (b - a)) / ((b - a) @ (b - a)), 0.0, 1.0)
                far = ((gone - t[:, None] * (b - a)) ** 2).sum(axis=1)
                u = np.clip((far - inner**2) / (radius**2 - inner**2), 0.0, 1.0)
                cover = np.maximum(cover, stroke.brush.opacity * (1.0 - u) ** 2 * (1.0 + 2.0 * u))
        colour = [int(stroke.brush.colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
        to = 0.5 if stroke.brush.mode == "erase" else np.array(colour)
        out += (to - out) * cover[:, None]
    return out


def test_paint_lies_where_it_was_laid_stroke_over_stroke():
    strokes = (
        _stroke((10, 20, 30), (200, 90, 60), (260, 250, 40)),
        _stroke((100, 20, 40), (100, 120, 40), radius=20, colour="#00ff40", opacity=0.6),
        _stroke((120, 40, 40), (90, 70, 45), mode="erase", radius=9),
    )
    points = np.random.default_rng(3).uniform(0.0, 1.0, (40_000, 3))
    found, wanted = _painted(*strokes).over(points, np.full((40_000, 3), 0.5), 0.0), _plainly(strokes, points)
    assert np.abs(found - wanted).max() < 1e-9
    assert (np.abs(found - 0.5).max(axis=1) > 0.1).sum() > 200
    assert _painted(*strokes).gloss == 0.4


@given(
    st.lists(st.tuples(*[st.floats(-300, 300)] * 3), min_size=1, max_size=4),
    st.tuples(*[st.integers(-2, 2)] * 3),
    st.floats(1, 96),
)
def test_a_solid_with_paint_on_it_repeats(points, shift, radius):
    solid = _painted(_stroke(*points, radius=radius))
    at = np.concatenate([np.array(points) / VOXELS, np.random.default_rng(1).uniform(0, 1, (50, 3))])
    seen, moved = solid.colours(at, 0.001), solid.colours(at + np.array(shift), 0.001)
    assert np.abs(seen - moved).max() < 1e-6
    assert np.abs(seen[: len(points)] - (1.0, 0.0, 0.0)).max() < 1e-6


def test_pressure_tells_what_the_brush_follows():
    points = np.array([[100.0, 100.0, 100.0], [109.0, 100.0, 100.0]]) / VOXELS
    follows = Map({"radius": "pressure", "opacity": "pressure"})
    light = Touch("agate", ((100.0, 100.0, 100.0, 0.5),), Brush(radius=16, colour="#ff0000", dynamics=follows))
    found = _painted(light).colours(points, 0.001)
    assert found[0].tolist() == [0.75, 0.25, 0.25]
    assert found[1].tolist() == [0.5, 0.5, 0.5]


def test_a_stroke_may_be_broken():
    line, dots = (
        _stroke((20, 30, 40), (120, 30, 40)),
        Touch("a", ((20, 30, 40, 1), (120, 30, 40, 1)), Brush(radius=12), (1,)),
    )
    middle = np.array([[70.0, 30.0, 40.0], [20.0, 30.0, 40.0]]) / VOXELS
    assert _painted(line).colours(middle, 0.001)[:, 0].tolist() == [1.0, 1.0]
    assert _painted(dots).colours(middle, 0.001)[:, 0].tolist() == [0.5, 0.0]
    assert _painted(dots).cells().sum() < _painted(line).cells().sum()


TOUCH = {"do": "touch", "solid": "agate", "points": [[128, 20.5, 30], [140, 20, 30, 0.5]], "brush": {"radius": 9}}
CUT = {"do": "texture", "maker": "solid", "material": "agate", "unit": 32, "depth": 0.12}


def _done(*commands):
    session = Session(Painting(seed=3))
    for command in commands:
        session.do(parse(command))
    return session


def test_a_stroke_on_a_solid_is_a_step_kept_with_the_painting(tmp_path):
    touches = TOUCH | {"brush": {"radius": 40, "colour": "#ff2000"}}
    session = _done(touches, touches, {"do": "undo"}, CUT | {"name": "cut", "touches": "agate"}, CUT | {"name": "bare"})
    painting = session.painting
    assert len(painting.touches["agate"]) == 1
    assert format_of(painting) == FORMAT
    cut, bare = (painting.textures[name].source.sha for name in ("cut", "bare"))
    assert cut != bare
    session.do(parse({"do": "undo"}))
    assert not session.painting.touches
    assert session.painting.textures["cut"].source.sha == cut  # strokes keep the ink that they had
    session.do(parse({"do": "redo"}))
    save(tmp_path / "p.ora", Snapshot(session.painting, session.recording()))
    found = open_painting(tmp_path / "p.ora").painting
    assert found.touches == painting.touches
    assert found.textures["cut"].source.sha == cut
    session.do(parse({"do": "touch", "solid": "agate", "clear": True}))
    assert not session.painting.touches


def test_the_command_is_told_and_read_back():
    command = parse(TOUCH)
    assert json.loads(json.dumps(to_json(command))) == to_json(parse(to_json(command)))
    assert parse(to_json(command)) == command
    assert version_of(command) == 2
    found, notes = read_touches([*write_touches(Map({"agate": (command,)})), {"solid": "agate"}, 7])
    assert found["agate"] == (command,)
    assert len(notes) == 2


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ({"do": "touch", "solid": "agate", "clear": True}, "no paint"),
        (CUT | {"name": "x", "touches": "agate"}, "touches"),
    ],
)
def test_what_cannot_be_done_is_refused(command, told):
    with pytest.raises(Refusal, match=told):
        _done(command)


@pytest.mark.parametrize(
    "wrong",
    [
        {"points": []},
        {"points": [[1, 2]]},
        {"points": [[1, 2, 3, 4]]},
        {"points": [[1, 2, float("nan")]]},
        {"points": [[1, 2, 1e9]]},
        {"brush": {"radius": 97}},
        {"solid": 3},
        {"breaks": [2]},
        {"breaks": [0]},
    ],
)
def test_what_is_wrong_with_a_stroke_is_named(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        parse(TOUCH | wrong)
