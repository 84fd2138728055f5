"""Thick paint in the light: flat places stay as painted, strokes in progress are seen as they will be."""

import numpy as np
import pytest

from engine.archive.export import Picture, lighting_of, shown_root
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.heaps.seen_heaps import heaped_on, thickness
from engine.canvas.reading import layer_planes
from engine.light.light import BY_IMPASTO, Light
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.lighting import pictured
from engine.painting.value import Painting
from engine.session.apply import Around, apply
from engine.strokes.live_heaps import live_heaps
from engine.strokes.paint_stroke import LiveStroke

FRAME = Rect.at(0, 0, 192, 128)
THICK = {"radius": 14, "hardness": 0.5, "colour": "#b04020", "impasto": 3}


def painted(*commands):
    painting = Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(command), Around())
    return painting


def stroke(y=60, level=0, **brush):
    return {"do": "stroke", "level": level, "points": [[40, y], [150, y]], "brush": {**THICK, **brush}}


def seen(painting, light, rect=FRAME, level=0):
    picture = Picture(painting, light=light)

    def read(layer, level, rect):
        return layer_planes(layer, level, rect)

    return pictured(shown_root(picture), level, rect, read, lighting_of(picture))


def test_a_ridge_of_paint_is_bright_towards_the_sun_and_flat_places_stay():
    painting = painted(stroke(radius=40, hardness=1, impasto=0), stroke())
    light = Light(azimuth=0, height=BY_IMPASTO, gloss=0.0)
    plain, lit = seen(painting, None), seen(painting, light)
    assert lit[0, 50, 95] > plain[0, 50, 95] > plain[0, 50, 95] - 0.05 > lit[0, 70, 95]
    assert np.array_equal(lit[:, :36], plain[:, :36])
    assert not np.array_equal(lit, plain)
    part = Rect(60, 40, 91, 77)
    assert np.array_equal(seen(painting, light, part), lit[:, 40:77, 60:91])
    bare = painted(stroke(impasto=0))
    assert np.array_equal(seen(bare, light), seen(bare, None))


def test_relief_is_as_steep_at_every_level():
    painting = painted(stroke(radius=30, hardness=0))
    light = Light(height=BY_IMPASTO, gloss=0.0)
    coarse, fine = (seen(painting, light, FRAME.zoomed(k), k) for k in (-1, 1))
    fewer = fine.reshape(4, 64, 4, 96, 4).mean((2, 4))
    assert np.abs(coarse - fewer).max() < 0.06


@pytest.mark.parametrize("brush", [{}, {"mode": "erase"}, {"mode": "smooth"}, {"impasto": -5}])
def test_a_stroke_in_progress_is_as_thick_as_it_will_be(brush):
    painting = painted(stroke(), stroke(52, impasto=0.2))
    live = LiveStroke(painting, 0, (0, 0), Brush(**{"radius": 20.0, "impasto": 1.5, **brush}))
    live.add(np.array([[60.0, 50.0], [120.0, 70.0]]))
    after = live.commit()
    whole = Rect(30, 20, 160, 100)
    then = heaped_on(layers.find(after.root, "Layer 1"), 0, whole)
    assert np.array_equal(live_heaps(live, whole), then)
    assert not np.array_equal(then, heaped_on(layers.find(painting.root, "Layer 1"), 0, whole))
    assert np.array_equal(thickness(after.root, 0, whole), then)


def test_hidden_and_pale_layers_are_less_thick():
    painting = painted(stroke())
    full = thickness(painting.root, 0, FRAME)
    half = apply(painting, parse({"do": "layer", "set": "Layer 1", "opacity": 0.5}), Around())
    gone = apply(painting, parse({"do": "layer", "set": "Layer 1", "visible": False}), Around())
    assert np.allclose(thickness(half.root, 0, FRAME), full / 2, rtol=0, atol=1e-6)
    assert not thickness(gone.root, 0, FRAME).any()


@pytest.mark.parametrize("holder", ["Layer 1", "Group"])
def test_paint_is_as_thick_as_its_masks_show_it(holder):
    painting = painted(stroke())
    full = thickness(painting.root, 0, FRAME)
    for row in (
        {"do": "layer", "add": "Group", "kind": "group"},
        {"do": "layer", "move": "Layer 1", "to": 0, "group": "Group"},
        {"do": "select", "rect": [0, 0, 0, 90, 200]},
        {"do": "select", "keep": "left"},
        {"do": "layer", "set": holder, "mask": "left"},
        {"do": "select", "none": True},
    ):
        painting = apply(painting, parse(row), Around())
    cut = thickness(painting.root, 0, FRAME)
    left, right = np.s_[:, : 90 - FRAME.x0], np.s_[:, 90 - FRAME.x0 :]
    assert full[left].any()
    assert full[right].any()
    assert np.array_equal(cut[left], full[left])
    assert not cut[right].any()
    off = apply(painting, parse({"do": "layer", "set": holder, "mask": {"op": "off"}}), Around())
    assert np.array_equal(thickness(off.root, 0, FRAME), full)
