"""Heights of a painting: the same bits for every window, no terraces, and what is seen from the canvas at level 0."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import LayerError
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.session.apply import Around, apply
from engine.terrain.layer_heights import Pixel, luma
from engine.terrain.plane import land

FRAME = Rect.at(0, 0, 192, 128)
ROCK = {"texture": "rock", "amount": 1, "period": 96, "roughness": 0.86, "colour": "#808080"}
PLACE = 70.3, 60.7  # of level 0, where the paint is thick at every level


def painted(*commands):
    painting = Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(command), Around())
    return painting


def stroke(level, radius, **brush):
    x, y = (int(v * 2.0**level) for v in PLACE)
    points = [[0, 0], [radius, radius / 2]]
    about = {"level": level, "origin": [x, y]} if level else {"points": [[x, y], [x + radius, y]]}
    return {"do": "stroke", "points": points, **about, "brush": {"radius": radius, "colour": "#404040", **brush}}


@pytest.fixture(scope="module")
def painting():
    return painted(
        stroke(0, 60, ink=[ROCK], hardness=0.6),
        stroke(2, 40, colour="#c0a060", opacity=0.5),
        stroke(9, 70, ink=[ROCK | {"period": 40, "roughness": 0.7, "colour": "#202020"}], opacity=0.6),
    )


def window(level, size=80):
    x, y = (int(v * 2**level) if level < 40 else int(v * 2**20) << (level - 20) for v in PLACE)
    return Rect.at(x - size // 2 + 3, y - size // 2 - 5, size, size)


@pytest.mark.parametrize("source", ["Layer 1", "composite", "alpha"])
@pytest.mark.parametrize("level", [-2, 0, 8, 16, 40])
def test_a_part_has_the_bits_of_the_whole_whatever_was_seen_before(painting, level, source):
    whole = window(level)
    about = Pixel(level - 32, whole.x0, whole.y0).above(level - 32) if level > 32 else None
    about = land(painting).about(level, whole) if level > 32 else about
    seen = land(painting, source, cache=TileCache(32 << 20))
    large = seen.height(level, whole, about)
    for x, y, w, h in ((0, 0, 1, 1), (17, 30, 23, 9), (40, 41, 40, 39)):
        part = Rect.at(whole.x0 + x, whole.y0 + y, w, h)
        alone = land(painting, source).height(level, part, about)
        assert np.array_equal(alone, large[part.slices(whole)])
        assert np.array_equal(seen.height(level, part, about), alone)


@pytest.mark.parametrize("level", [12, 40])
def test_two_threads_see_what_one_sees(painting, level):
    whole = window(level, 64)
    about = land(painting).about(level, whole) if level > 32 else None
    parts = [Rect.at(whole.x0 + x, whole.y0 + y, 32, 32) for y in (0, 32) for x in (0, 32)]
    shared = land(painting, "Layer 1", cache=TileCache(32 << 20))
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda part: shared.height(level, part, about), parts))
    once = land(painting, "Layer 1").height(level, whole, about)
    for part, values in zip(parts, found, strict=True):
        assert np.array_equal(values, once[part.slices(whole)])


def test_at_level_0_it_is_the_brightness_of_the_canvas(painting):
    rect = Rect.at(40, 30, 50, 40)
    layer = layers.find(painting.root, "Layer 1")
    planes = evaluate(layer.pyramid, 0, rect)
    seen = land(painting, "Layer 1", scale=100.0, sea=0.25, ground=0.5)
    expected = (luma(planes.data) + (1.0 - planes.data[3]) * 0.5 - 0.25) * 100.0
    assert np.allclose(seen.height(0, rect), expected, rtol=0, atol=1e-9)


def test_deeper_it_follows_the_canvas_to_its_grid(painting):
    layer = layers.find(painting.root, "Layer 1")
    for level in (1, 5, 10):
        rect = window(level, 40)
        planes = evaluate(layer.pyramid, level, rect)
        seen = land(painting, "Layer 1", scale=1.0, ground=0.0).height(level, rect)
        assert np.abs(seen - luma(planes.data)).max() < 2.0**-16 * (level + 2)


def test_there_are_no_terraces_deep_down():
    """The canvas has a few values in a window of level 16; heights have one for each pixel."""
    painting, rect = painted(stroke(0, 60, hardness=0.1, colour="#e0e0e0")), Rect.at(40 << 16, 60 << 16, 64, 64)
    layer = layers.find(painting.root, "Layer 1")
    canvas = luma(evaluate(layer.pyramid, 16, rect).data)
    seen = land(painting, "Layer 1").height(16, rect)
    assert len(np.unique(canvas)) < 4
    assert len(np.unique(seen)) > 0.95 * seen.size


def test_windows_beyond_level_32_are_told_from_a_pixel(painting):
    whole = window(40, 24)
    seen = land(painting, "Layer 1")
    about = seen.about(40, whole)
    assert about == Pixel(8, whole.x0 // 128 * 128 >> 32, whole.y0 // 128 * 128 >> 32)
    relative = seen.height(40, whole, about)
    assert np.array_equal(seen.height(40, whole), relative)
    assert len(np.unique(relative)) > 0.9 * relative.size
    at = Rect.at(about.x, about.y, 1, 1)
    shallow = window(14, 24)
    apart = seen.height(14, shallow) - seen.height(8, at)[0, 0]
    assert np.allclose(seen.height(14, shallow, about), apart, rtol=0, atol=1e-10)
    assert seen.height(8, at, about)[0, 0] == 0.0


def test_a_pixel_that_heights_are_told_from_is_no_finer_than_they(painting):
    with pytest.raises(ValueError, match="level 9, expected one of level 1 to 8"):
        land(painting).height(8, window(8), Pixel(9, 0, 0))


def test_peaks_are_not_cut_off():
    painting = painted(stroke(0, 60, colour="#000000", ink=[ROCK | {"colour": "#ffffff", "period": 8}]))
    assert land(painting, "Layer 1", scale=1.0, ground=0.0).height(0, FRAME).max() > 1.05


def test_what_is_not_painted_on_lies_as_high_as_the_rim():
    painting = painted(stroke(0, 300, colour="#808080"), {"do": "layer", "add": "hole"}, stroke(0, 9, mode="erase"))
    hole = painted(stroke(0, 30, colour="#808080"))
    assert land(painting, "Layer 1").ground == pytest.approx(128 / 255, abs=1e-4)
    assert land(hole).ground == 0.0
    assert land(hole, ground=0.25, scale=4.0).height(0, Rect.at(0, 0, 1, 1)) == 1.0


def test_layers_that_lie_over_one_another_are_as_high_as_they_look():
    painting = painted(
        stroke(0, 70, colour="#808080"),
        {"do": "layer", "add": "over"},
        {"do": "layer", "set": "over", "opacity": 0.5},
        stroke(0, 30, colour="#ffffff", layer="over"),
    )
    at = Rect.at(70, 60, 1, 1)
    seen = land(painting, "composite", scale=1.0).height(0, at)[0, 0]
    assert seen == pytest.approx(0.5 + 0.5 * 128 / 255, abs=1e-3)
    multiplied = apply(painting, parse({"do": "layer", "set": "over", "blend": "multiply"}), Around())
    assert land(multiplied, "composite", scale=1.0).height(0, at)[0, 0] == pytest.approx(128 / 255, abs=1e-3)


def test_a_source_that_is_not_there_is_named(painting):
    with pytest.raises(LayerError, match="'Nowhere'"):
        land(painting, "Nowhere")
