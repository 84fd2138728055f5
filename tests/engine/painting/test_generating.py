"""Strokes that place things, in a painting's life: portions, undo, files, what lies below, refusals."""

import json

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.tile_cache import TileCache
from engine.kernel_cache import NotCompiled
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import version_of
from engine.painting.value import Painting, Refusal
from engine.session import history
from engine.session.session import Session
from engine.texture.expression.placing.generated import Generated, LaidStroke

TEXT = """post = fade(mix(#804020, #e0c080, random(1)), fill(box(x, y + 0.5, 0.3, 0.9)))
leaf = fade(#308030, fill(circle(x, y, 0.9)))
row(over(scatter(leaf, 4, 0.2, distance(x, y + 0.7) < 0.3, 90*random(1)), post), 0.8, size)"""
DEFINED = {"do": "texture", "name": "posts", "maker": "expression", "text": TEXT}
BRUSH = {"mode": "generate", "radius": 13, "ink": [{"texture": "posts"}], "dynamics": {"radius": "pressure"}}
POINTS = [[6.0 * n, 30.0 + 3.0 * (n % 3), 0.6 + 0.02 * n] for n in range(18)]
PLACED = {"do": "stroke", "points": POINTS, "brush": BRUSH}
GROUND = {"do": "stroke", "points": [[-20, 25], [140, 25]], "brush": {"radius": 9, "colour": "#6080c0"}}
FRAME = Rect.at(0, 0, 128, 64)


def painted(*commands):
    session = Session(Painting(FRAME, 7), TileCache(32 << 20))
    for command in commands:
        session.do(c.parse(command))
    return session


def seen(painting, level=0, rect=FRAME):
    (layer,) = layers.layers(painting.root)
    return evaluate(layer.pyramid, level, rect.zoomed(level)).rgba


def test_it_is_the_same_in_portions_and_after_a_save_and_undone(tmp_path):
    session = painted(DEFINED, GROUND)
    before = seen(session.painting)
    live = session.begin(0, (0, 0), from_json(BRUSH))
    for row in POINTS:
        live.add(np.array([row]))
    told = live.preview(FRAME).rgba
    session.finish(live)
    after = seen(session.painting)
    assert (told == after).all()
    assert (seen(painted(DEFINED, GROUND, PLACED).painting) == after).all()
    assert version_of(session.log[-1]) == 2
    path = tmp_path / "a.ora"
    save(path, Snapshot(session.painting, session.recording()))
    opened = open_painting(path).painting
    for level in (0, 2):
        assert (seen(opened, level) == seen(session.painting, level)).all()
    session.do(c.parse({"do": "undo"}))
    assert (seen(session.painting) == before).all()


def test_points_that_lack_a_kernel_leave_the_stroke_as_it_was(monkeypatch):
    """As it is taken back it is asked where it lies, on a thread that would compile all that this needs."""

    def lacking(self, *about):
        raise NotCompiled("scene")

    live = painted(DEFINED).begin(0, (0, 0), from_json(BRUSH))
    for name in ("changed", "rect"):
        monkeypatch.setattr(LaidStroke, name, lacking)
    with pytest.raises(NotCompiled):
        live.add(np.array(POINTS))
    assert live.empty
    assert live.rect.empty


def test_what_lies_below_shows_between_things_and_alpha_is_their_own():
    alone, over = (painted(DEFINED, *more, PLACED).painting for more in ((), (GROUND,)))
    (layer,) = layers.layers(alone.root)
    (made,) = {ink.laid for ink in evaluate(layer.pyramid, 0, FRAME).inks if isinstance(ink, Generated)}
    for level in (0, 3):
        rect = Rect.at(20, 22, 40, 6)  # where the ground is even
        own = made.means(level, rect.zoomed(level))
        assert np.abs(seen(alone, level, rect) - own).max() < 1e-3
        below = seen(painted(GROUND).painting, level, rect)
        assert np.abs(seen(over, level, rect) - (own + (1 - own[3]) * below)).max() < 0.02


@pytest.mark.parametrize("more", [{"copies": [[1, 0, 0, 25, False]]}, {"layer": "locked"}])
def test_copies_and_locked_alpha(more):
    lock = ({"do": "layer", "add": "locked"}, {**GROUND, "layer": "locked"})
    lock += ({"do": "layer", "set": "locked", "alpha_locked": True},)
    session = painted(DEFINED, *(lock if "layer" in more else ()))
    empty = seen(session.painting) if "layer" in more else np.zeros((4, 64, 128), np.float32)
    session.do(c.parse({**PLACED, **more}))
    after = seen(session.painting)
    assert (after[:3] != empty[:3]).any()
    if "layer" in more:
        assert (after[3] == empty[3]).all()
        assert (seen(session.painting, 2)[3] <= 1.0).all()
    else:
        assert after[3, 40:60].max() > 0.9


def test_strokes_hold_few_bytes_and_what_is_packed_is_the_same(monkeypatch):
    """A thousand lie within 1 GB: what they hold in a session is bounded, also where they lie on one another."""
    short = {"do": "stroke", "points": POINTS[:5], "brush": {**BRUSH, "radius": 9}}
    strokes = [{**short, "origin": [20 * n % 90, 11 * n]} for n in range(6)]
    session = painted(DEFINED, GROUND)
    held = session.painting.root, session.history.held
    for stroke in strokes:
        session.do(c.parse(stroke))
    (layer,) = layers.layers(session.painting.root)
    (first,) = layers.layers(held[0])
    grown = layer.pyramid.nbytes - first.pyramid.nbytes + session.history.held - held[1]
    assert grown / len(strokes) < 400_000
    monkeypatch.setattr(history, "pack_laid", lambda record, before: None)
    plain = painted(DEFINED, GROUND, *strokes)
    for level, rect in ((0, FRAME), (1, Rect.at(30, 20, 40, 30)), (-3, Rect.at(0, 0, 512, 256))):
        assert (seen(session.painting, level, rect) == seen(plain.painting, level, rect)).all()
    for _ in strokes:
        session.do(c.parse({"do": "undo"}))
    while session.room.pending:
        session.room.step()
    assert (seen(session.painting) == seen(painted(DEFINED, GROUND).painting)).all()


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        ({**PLACED, "brush": {**BRUSH, "ink": [{"texture": "rock"}]}}, "a written texture, which places things"),
        ({**PLACED, "brush": {**BRUSH, "ink": []}}, "a written texture, which places things"),
        ({"do": "fill", "like": {"at": [1, 1]}, "brush": BRUSH}, "draw with it"),
    ],
)
def test_what_cannot_be_is_refused(command, expected):
    session = painted(DEFINED, GROUND)
    with pytest.raises(Refusal, match=expected):
        session.do(c.parse(json.loads(json.dumps(command))))
