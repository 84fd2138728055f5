"""Strokes of raster-ops on paintings: preview and commit, undo and replay, finer and coarser levels, cloning."""

import json

import numpy as np
import pytest

from engine.brush.checks import BrushError
from engine.brush.ops import OPS
from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.session.apply import Around, Painting, apply
from engine.strokes.paint_stroke import LiveStroke

FRAME = Rect.at(0, 0, 64, 64)
ROCK = [{"texture": "rock", "amount": 0.8, "colour": "#e0d0a0", "period": 24}]
GIVEN = {"clone": {"name": "clone", "layer": "A", "offset": [5, -3]}}
ALL = [*OPS, "formula"]


def op_of(name):
    return {"formula": "pressure*(colour-pic)*sin(x/9)"} if name == "formula" else GIVEN.get(name, name)


def stroke(points, **members):
    return {"do": "stroke", "points": points, **members}


def told(*commands, painting=None):
    painting = painting or Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(json.loads(json.dumps(command))), Around())
    return painting


GROUND = {"radius": 200, "hardness": 1, "colour": "#607080", "dynamics": {}}
TEXTURED = {"radius": 14, "colour": "#c04020", "ink": ROCK}
LINE = [[6, 30, 0.4], [50, 40, 1.0]]


def base(alpha_locked=False):
    return told(
        {"do": "layer", "add": "A"},
        stroke([[32, 32]], brush=GROUND) if not alpha_locked else stroke(LINE, brush={"radius": 20}),
        stroke([[10, 12], [60, 44]], brush=TEXTURED),
    )


def values(painting, level=0, rect=FRAME, layer="A"):
    return evaluate(layers.find(painting.root, layer).pyramid, level, rect).data


@pytest.mark.parametrize("name", ALL)
def test_the_preview_is_the_commit_also_in_portions(name):
    painting = base(alpha_locked=True)
    brush = from_json({"mode": "raster", "op": op_of(name), "radius": 12, "colour": "#80c0ff", "ink": ROCK})
    rng = np.random.default_rng(4)
    points = np.column_stack([rng.uniform(0, 64, (6, 2)), rng.uniform(0.2, 1, 6), np.zeros((6, 3))])
    live = LiveStroke(painting, 0, (0, 0), brush)
    for part in np.array_split(points, 4):
        live.lay(part)
        shown = live.preview(FRAME).data
    done = live.commit()
    assert values(done).shape[0] >= 4
    both = min(len(shown), len(values(done)))
    assert shown[:both].tobytes() == values(done)[:both].tobytes()
    whole = LiveStroke(painting, 0, (0, 0), brush)
    whole.lay(points)
    assert values(whole.commit()).tobytes() == values(done).tobytes()
    command = live.to_command()
    replayed = apply(painting, command, Around())
    for level in (0, 2, -2):
        rect = FRAME.zoomed(level)
        assert values(replayed, level, rect).tobytes() == values(done, level, rect).tobytes()
    assert (shown[:4] != values(painting)[:4]).any()


@pytest.mark.parametrize(
    ("op", "gain"),
    [
        ("multiply", 0.5),
        ("invert", -1.0),
        ("hue", 1.0),
        ("smooth", 0.0),
        ({"name": "contrast", "gain": 1.5}, 1.5),
        ({"name": "contrast", "gain": 4}, 2.0),
        ({"name": "lighten", "amount": 0.25}, 0.75),
        ({"name": "posterise", "levels": 3}, 0.0),
        ({"name": "sharpen", "amount": 0.5}, 1.5),
        ({"formula": "-1.5*(pic-0.5)"}, -0.5),
    ],
)
def test_finer_detail_is_multiplied_by_the_slope(op, gain):
    """Grey noise painted three levels finer than the op's stroke: what is left of it there, with its sign."""
    ground = told({"do": "layer", "add": "A"}, stroke([[32, 32]], brush={**GROUND, "colour": "#707070"}))
    rng = np.random.default_rng(1)
    dots = [
        stroke([[float(x), float(y)]], level=3, origin=[192, 192], brush={"radius": 3, "colour": colour})
        for x, y, colour in zip(*rng.uniform(0, 128, (2, 40)), ["#606060", "#808080"] * 20, strict=True)
    ]
    noisy = told(*dots, painting=ground)
    changed = told(
        stroke([[32, 32]], brush={**GROUND, "mode": "raster", "op": op, "colour": "#808080"}), painting=noisy
    )
    inner = Rect.at(192, 192, 128, 128)

    def detail(painting):
        """What lies at level 3 beyond what level 0 tells of it."""
        fine = values(painting, 3, inner)[:3]
        return fine - fine.reshape(3, 16, 8, 16, 8).mean(axis=(2, 4)).repeat(8, axis=1).repeat(8, axis=2)

    before, now = detail(noisy), detail(changed)
    assert before.std() > 0.005
    left = (before * now).sum() / (before * before).sum()
    assert left == pytest.approx(gain, abs=0.1)
    assert (values(changed, 3, inner)[3] == 1).all()


@pytest.mark.parametrize("name", [n for n in OPS if n not in ("erase", "displace", "clone")])
def test_an_even_colour_becomes_the_same_even_colour_at_every_level(name):
    painting = told({"do": "layer", "add": "A"}, stroke([[32, 32]], brush=GROUND))
    brush = {**GROUND, "mode": "raster", "op": op_of(name), "colour": "#c08040", "radius": 180}
    done = told(stroke([[32, 32]], brush=brush), painting=painting)
    here = values(done, 0, Rect(20, 20, 40, 40))[:4, 10, 10]
    for level, rect in ((-1, Rect(8, 8, 24, 24)), (-2, Rect(4, 4, 12, 12)), (2, Rect(80, 80, 160, 160))):
        there = values(done, level, rect)[:4]
        np.testing.assert_allclose(there, np.broadcast_to(here[:, None, None], there.shape), atol=4e-5)


def test_an_edge_keeps_its_shape_at_finer_levels():
    """Inverting at level 0 what has a sharp rim at level 3: alpha stays there bit for bit, colours within it."""
    brush = {"radius": 40, "hardness": 1, "colour": "#303030"}
    painting = told({"do": "layer", "add": "A"}, stroke([[130, 130], [300, 250]], level=3, brush=brush))
    done = told(stroke([[32, 32]], brush={**GROUND, "mode": "raster", "op": "invert"}), painting=painting)
    fine = Rect(96, 96, 352, 352)
    old, new = values(painting, 3, fine), values(done, 3, fine)
    assert new[3].tobytes() == old[3].tobytes()
    inside = old[3] == 1
    straight = new[0][inside]
    assert abs(np.median(straight) - (1 - 0x30 / 255)) < 0.01
    assert np.isfinite(new).all()


def test_clone_copies_another_layer_or_the_old_pixels_of_its_own():
    painting = told({"do": "layer", "add": "B"}, painting=base())
    brush = {**GROUND, "mode": "raster", "op": {"name": "clone", "layer": "A", "offset": [0, 0]}}
    done = told(stroke([[32, 32]], brush=brush), painting=painting)
    for level in (0, 1, 3):
        rect = FRAME.zoomed(level)
        source, copied = values(done, level, rect), values(done, level, rect, "B")
        np.testing.assert_allclose(copied[:4], source[:4], atol=0.02 if level else 1e-6)
    shifted = told(
        stroke([[32, 32]], brush={**brush, "op": {**brush["op"], "offset": [7, 2]}}, layer="A"), painting=painting
    )
    want = values(painting, 0, Rect(7, 2, 71, 66))
    np.testing.assert_allclose(values(shifted)[:4], want[:4], atol=1e-6)


def test_a_stroke_too_large_to_be_continued_is_refused_and_stays_as_it_was():
    brush = from_json({"mode": "raster", "op": "predict", "radius": 40})
    live = LiveStroke(base(), 0, (0, 0), brush)
    live.add(np.array([[10.0, 10.0]]))
    before = live.preview(FRAME).data
    with pytest.raises(BrushError, match="predict"):
        live.add(np.array([[4000.0, 4000.0]]))
    assert live.preview(FRAME).data.tobytes() == before.tobytes()
    assert len(live.to_command().points) == 1


def test_pressure_of_a_formula_is_the_pens():
    painting = told({"do": "layer", "add": "A"}, stroke([[32, 32]], brush={**GROUND, "colour": "#000000"}))
    brush = {"mode": "raster", "op": {"formula": "pressure"}, "radius": 8, "hardness": 1, "dynamics": {}}
    done = told(stroke([[10, 20, 0.25], [50, 20, 0.75]], brush=brush), painting=painting)
    row = values(done)[0, 20]
    assert row[10] == pytest.approx(0.25 + 0.5 * 8 / 40, abs=0.06)  # of the dabs that reach there
    assert row[50] == pytest.approx(0.75, abs=0.02)
    assert (np.diff(row[12:50]) > -1e-4).all()


def test_locked_transparency_is_kept_and_a_texture_gives_detail():
    painting = base(alpha_locked=True)
    locked = told({"do": "layer", "set": "A", "alpha_locked": True}, painting=painting)
    for op in ("toward", "displace", "invert"):
        done = told(stroke(LINE, brush={"mode": "raster", "op": op, "radius": 20}), painting=locked)
        for level in (0, 2):
            rect = FRAME.zoomed(level)
            assert values(done, level, rect)[3].tobytes() == values(locked, level, rect)[3].tobytes()
    plain = told({"do": "layer", "add": "A"}, stroke([[32, 32]], brush=GROUND))
    brush = {**GROUND, "mode": "raster", "op": "multiply", "colour": "#000000", "ink": ROCK}
    done = told(stroke([[32, 32]], brush=brush), painting=plain)
    fine = values(done, 3, Rect.at(200, 200, 128, 128))[0]
    coarse = values(done, 0, Rect.at(25, 25, 16, 16))[0].repeat(8, axis=0).repeat(8, axis=1)
    assert (fine - coarse).std() > 0.004


@pytest.mark.parametrize("name", ["multiply", "contrast", "gradient"])
def test_coarse_strokes_change_what_finer_shaped_textures_painted(name):
    """The finer texture has no appearance at the level of the stroke."""
    cloud = {"do": "texture", "name": "cloud", "maker": "spectrum", "size": [32, 32], "shapes": [{"shape": "noise"}]}
    ink = [{"texture": "cloud", "period": 40, "colour": "#ffffff", "shaping": "steps"}]
    before = told(
        {"do": "layer", "add": "A"},
        cloud,
        {**stroke([[20, 100], [220, 120]], brush={"radius": 60, "colour": "#803010", "ink": ink}), "level": 2},
    )
    after = told(stroke(LINE, brush={"mode": "raster", "op": name, "colour": "#404060", "ink": ink}), painting=before)
    assert np.abs(values(after)[:4] - values(before)[:4]).max() > 0.1
    fine = Rect.at(0, 0, 256, 256)
    changed = values(after, 2, fine)[:4]
    assert np.isfinite(changed).all()
    assert np.abs(changed - values(before, 2, fine)[:4]).max() > 0.1
