"""Strokes with density, grain, shaping, rim and tip on paintings: preview, portions, undo, replay, files."""

import json

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.commands import parse, to_json
from engine.session.apply import Around, Painting, apply
from engine.session.session import Session
from engine.strokes.paint_stroke import LiveStroke

FRAME = Rect.at(0, 0, 200, 160)
INK = [
    {"texture": "rock", "amount": 0.8, "colour": "#e0d0a0", "shaping": "threshold"},
    {"texture": "stripes", "period": 12, "shaping": [[0, 0.2], [1, 0.9]]},
]
GRAIN = {"texture": "rock", "period": 14, "amount": 0.9, "level": 1}
EDGE = {"curve": "wet", "width": 0.6, "colour": "#101830"}
PARTS = {
    "shaping": {"ink": INK, "shaping": "compress"},
    "density": {"density": {"texture": "stripes", "period": 6, "angle": 80, "amount": 0.9, "shaping": "negate"}},
    "grain": {"grain": GRAIN},
    "edge": {"edge": EDGE, "ink": INK[:1]},
    "sample": {"tip": {"texture": "squares", "angle": 20}, "spacing": 0.8},
    "window": {"tip": {"texture": "rock", "from": "window", "shaping": "stretch"}},
    "extent": {"extent": True, "ink": [{"texture": "rings", "colour": "#ffffff"}], "radius": 16},
    "all": {"ink": INK, "density": "rock", "grain": GRAIN, "edge": EDGE, "shaping": "root", "tip": "rock"},
}
MODES = ["paint", "erase", "smooth", "raster"]
RINGS = {"do": "texture", "name": "rings", "maker": "sparse", "size": [24, 24], "shapes": [{"shape": "ring"}]}
RNG = np.random.default_rng(11)
POINTS = np.column_stack([RNG.uniform(20, 180, 9), RNG.uniform(20, 140, 9), RNG.uniform(0.2, 1, 9), np.zeros((9, 3))])
GROUND = {"radius": 70, "hardness": 1, "colour": "#c08040", "ink": INK[1:], "dynamics": {}}


def brush_of(name, mode="paint"):
    return {"radius": 24, "opacity": 0.8, "colour": "#203a70", "mode": mode, "op": "multiply", **PARTS[name]}


def stroke(brush, points=POINTS, **members):
    return {"do": "stroke", "points": points.tolist(), "brush": brush, **members}


def told(*commands):
    painting = Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(json.loads(json.dumps(command))), Around())
    return painting


def base(locked=False):
    found = [RINGS, {"do": "layer", "add": "A"}, stroke(GROUND, np.array([[100.0, 80, 1]]))]
    return told(*found, *([{"do": "layer", "set": "A", "alpha_locked": True}] if locked else []))


def values(painting, level=0, rect=FRAME):
    return evaluate(layers.find(painting.root, "A").pyramid, level, rect).data


@pytest.mark.parametrize("name", PARTS)
@pytest.mark.parametrize("mode", MODES)
def test_the_preview_is_the_commit_also_in_portions(name, mode):
    painting = base(locked=mode == "paint" and name in ("edge", "grain"))
    brush = from_json(brush_of(name, mode))
    live = LiveStroke(painting, 0, (0, 0), brush)
    shown = values(painting)
    for part in np.array_split(POINTS, 4):
        dirty = live.lay(part).intersect(FRAME)
        again = live.preview(FRAME).data
        if len(again) == len(shown):  # outside what was told to be dirty nothing changed
            still = np.ones((FRAME.height, FRAME.width), bool)
            still[dirty.slices(FRAME)] = False
            assert again[:, still].tobytes() == shown[:, still].tobytes()
        shown = again
    done = live.commit()
    found = values(done)
    assert shown[:4].tobytes() == found[:4].tobytes()
    whole = LiveStroke(painting, 0, (0, 0), brush)
    whole.lay(POINTS)
    assert values(whole.commit()).tobytes() == found.tobytes()
    replayed = apply(painting, parse(json.loads(json.dumps(to_json(live.to_command())))), Around())
    for level in (0, 2, -2):
        rect = FRAME.zoomed(level)
        assert values(replayed, level, rect).tobytes() == values(done, level, rect).tobytes()
    assert (found[:4] != values(painting)[:4]).any()


@pytest.mark.parametrize("name", PARTS)
def test_the_parts_change_what_is_painted(name):
    painting = base()
    plain = apply(base(), parse(stroke(_plain(name))), Around())
    made = apply(painting, parse(stroke(brush_of(name))), Around())
    assert np.abs(values(made)[:4] - values(plain)[:4]).mean() > 0.01


def _plain(name):
    given = {
        k: v for k, v in brush_of(name).items() if k not in ("density", "grain", "edge", "tip", "shaping", "extent")
    }
    ink = [{k: v for k, v in part.items() if k != "shaping"} for part in given.get("ink", [])]
    return given | {"ink": ink}


def test_paper_is_felt_at_the_same_places_at_every_level():
    """The peaks that a light stroke met at level 0 are those that it meets at level 2."""
    brush = {"radius": 60, "opacity": 0.4, "hardness": 1, "dynamics": {}, "grain": {"texture": "rock", "period": 48}}
    line = np.array([[80.0, 80, 1], [120, 80, 1]])
    coarse = told({"do": "layer", "add": "A"}, stroke(brush, line))
    fine = told({"do": "layer", "add": "A"}, stroke(brush | {"radius": 240}, line * [4, 4, 1], level=2))
    part = Rect.at(60, 40, 80, 80)
    a, b = values(coarse, 0, part)[3], values(fine, 0, part)[3]
    assert a.std() > 0.05
    assert np.corrcoef(a.ravel(), b.ravel())[0, 1] > 0.85


def test_undo_replay_and_files(tmp_path):
    several = [("all", "paint"), ("edge", "raster"), ("window", "erase"), ("grain", "smooth"), ("extent", "paint")]
    commands = [
        RINGS,
        {"do": "texture", "name": "weave", "maker": "squares", "period": 5},
        stroke(GROUND, np.array([[100.0, 80, 1]])),
        *(stroke(brush_of(name, mode), np.roll(POINTS, i, 0)) for i, (name, mode) in enumerate(several)),
        stroke({"radius": 20, "grain": "weave", "opacity": 0.5, "tip": {"texture": "weave", "from": "window"}}),
        {"do": "undo", "count": 2},
        {"do": "redo"},
    ]
    one, two = played(commands), played(commands)
    assert pixels(one.painting) == pixels(two.painting)
    path = tmp_path / "a.ora"
    save(path, Snapshot(one.painting, one.recording()))
    opened = open_painting(path)
    assert pixels(opened.painting) == pixels(one.painting)
    assert list(opened.recording.commands) == list(one.log)


def played(commands):
    session = Session(Painting(FRAME, 7), TileCache(64 << 20))
    for command in commands:
        session.do(parse(json.loads(json.dumps(command))))
    return session


def pixels(painting):
    layer = next(layers.layers(painting.root))
    return [evaluate(layer.pyramid, level, FRAME.zoomed(level)).data.tobytes() for level in (-1, 0, 2)]
