"""A painted spectrum: symmetric while it is painted, and the same from its command as from the hand."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map
from scipy import ndimage

from engine.brush.settings import Brush, Component
from engine.checks.field_error import FieldError
from engine.makers import spectrum
from engine.makers.spectrum import Design
from engine.numeric.spectra import opposite, power
from engine.painting import commands as c
from engine.texture.table import TextureError

WHITE = Brush(radius=6, colour="#ffffff")
RING = Design((64, 64), (Map({"shape": "ring"}),))


def line(*points, brush=WHITE, layer=None):
    given = np.array(points, np.float64)
    table = np.zeros((len(given), 6))
    table[:, :2], table[:, 2] = given, 1.0
    return c.Stroke(0, (0, 0), table, brush, layer)


places = st.tuples(st.floats(-10, 74), st.floats(-10, 74))
brushes = st.builds(
    Brush,
    radius=st.floats(1, 20),
    colour=st.sampled_from(["#ffffff", "#000000", "#ff8020"]),
    mode=st.sampled_from(["paint", "erase", "smooth"]),
    flow=st.floats(0.1, 1),
    ink=st.sampled_from([(), (Component("rock"),)]),
)


@settings(deadline=None, max_examples=25)
@given(strokes=st.lists(st.tuples(st.lists(places, min_size=1, max_size=4), brushes), max_size=3), size=st.data())
def test_whatever_is_painted_is_symmetric(strokes, size):
    wide, high = size.draw(st.tuples(st.integers(8, 65), st.integers(8, 65)))
    for sheet in spectrum.SHEETS:
        painted = tuple(line(*points, brush=brush, layer=sheet) for points, brush in strokes)
        sheets = spectrum.drawn(Design((wide, high), RING.shapes, painted))
        assert sheets.amplitude.shape[1:] == sheets.phase.shape[1:] == (high, wide)
        assert np.array_equal(opposite(sheets.amplitude), sheets.amplitude)
        assert np.array_equal(opposite(sheets.phase), 1.0 - sheets.phase)
        assert sheets.amplitude.min() >= 0.0
        assert sheets.amplitude.max() <= 1.0


def test_a_stroke_appears_at_the_opposite_frequency_and_the_eraser_takes_both_away():
    blank = Design((64, 64))
    once = spectrum.drawn(Design((64, 64), (), (line((20, 20), (30, 20)),)))
    assert once.amplitude[0, 20, 25] == once.amplitude[0, 44, 39] == 1.0
    gone = spectrum.with_stroke(once, line((34, 44), (50, 44), brush=Brush(radius=12, mode="erase", hardness=1)))
    assert np.array_equal(gone.amplitude, spectrum.begun(blank).amplitude)


def test_a_pattern_is_not_symmetric_and_its_transform_is_the_texture():
    design = Design((64, 64), (), (line((20, 20), (30, 24)),), forward=True)
    sheets = spectrum.drawn(design)
    assert sheets.amplitude[0, 20, 20] == 1.0
    assert sheets.amplitude[0, 44, 44] == 0.0
    texture = spectrum.sample(sheets, design)
    assert texture.std() > 0.3
    assert not np.array_equal(texture, spectrum.sample(sheets, Design((64, 64))))


def test_opposite_sides_of_a_painted_phase_turn_opposite_ways():
    sheets = spectrum.drawn(Design((64, 64), (), (line((20, 20), layer="phase"),)))
    assert sheets.phase[0, 20, 20] == 1.0
    assert sheets.phase[0, 44, 44] == 0.0


def test_what_is_painted_is_the_spectrum_of_the_sample():
    sheets = spectrum.drawn(RING)
    found = np.sqrt(power(spectrum.sample(sheets, RING)[0]))
    asked = spectrum.amplitude(sheets.amplitude)[0]
    asked[32, 32] = 0.0
    keep = np.hypot(*np.mgrid[-32:32, -32:32]) < 31  # Nyquist rows are real: their amplitude is not theirs alone
    assert np.corrcoef(found[keep], asked[keep])[0, 1] > 0.9999


def test_the_hand_and_the_command_make_the_same_sample():
    stroke = line((10, 12), (30, 20), (50, 14), brush=Brush(radius=5, colour="#ffffff", ink=(Component("rock"),)))
    sheets = spectrum.begun(RING)
    live = spectrum.touch(sheets, stroke.brush)
    for point in stroke.points:
        live.add(point[None])
        spectrum.stroked(sheets, live)  # looked at in between
    by_hand = spectrum.sample(spectrum.stroked(sheets, live), RING)
    design = Design(RING.size, RING.shapes, (live.to_command(),))
    written = json.loads(json.dumps(c.to_json(c.DefineTexture("T", "spectrum", design.to_arguments()))))
    again = spectrum.read(c.parse(written).arguments)
    assert np.array_equal(spectrum.sample(spectrum.drawn(again), again), by_hand)


@pytest.mark.parametrize("colours", [1, 3])
def test_the_spectrum_of_a_picture(colours):
    y, x = np.mgrid[:150, :200]
    planes = np.ones((4, 150, 200), np.float32)
    planes[:3] = 0.5 + 0.4 * np.sin(x * 2 * np.pi / 8)
    if colours == 3:
        planes[1] = 0.5 + 0.4 * np.sin(y * 2 * np.pi / 16)
    found = spectrum.of_picture(planes, (64, 64))
    assert found.shape == (colours, 64, 64)
    assert np.unravel_index(found[0].argmax(), (64, 64)) in ((32, 24), (32, 40))
    if colours == 3:
        assert np.unravel_index(found[1].argmax(), (64, 64)) in ((28, 32), (36, 32))
    small = spectrum.of_picture(planes[:, :20, :33], (64, 64))
    assert small.shape == (colours, 64, 64)


@pytest.mark.parametrize("size", [(64, 48), (41, 33)])
def test_with_its_own_phases_the_sample_looks_like_the_picture(size):
    """An impulse response sampled of a picture (Lewis 1984, section 5.3); what is painted turns it further."""
    width, height = size
    planes = np.ones((4, 90, 75), np.float32)
    planes[:3] = ndimage.gaussian_filter(np.random.default_rng(1).random((90, 75)), 2.0)
    design = Design(size, (Map({"shape": "image", "path": "a.png"}),), phase="own")
    sheets = spectrum.drawn(design, lambda shape: planes)
    assert np.abs(sheets.phase + opposite(sheets.phase) - 1.0).max() < 1e-6
    sample = spectrum.sample(sheets, design)[0]
    top, left = (90 - height) // 2, (75 - width) // 2
    middle = planes[0, top : top + height, left : left + width]
    assert np.corrcoef(sample.ravel(), middle.ravel())[0, 1] > 0.8
    assert not spectrum.sample(sheets, replace(design, part="imaginary")).any()
    turned = spectrum.with_stroke(sheets, line((4, 4), (20, 9), layer="phase"))
    assert not np.array_equal(spectrum.sample(turned, design)[0], sample)
    shapes_alone = spectrum.drawn(replace(RING, phase="own"))
    assert (shapes_alone.phase == 0.5).all()


def test_a_shape_that_is_a_picture_needs_one():
    design = Design((32, 32), (Map({"shape": "image", "path": "a.png"}),))
    with pytest.raises(FieldError):
        spectrum.drawn(design)
    seen = spectrum.drawn(design, lambda shape: np.ones((4, 40, 40), np.float32) * (shape["path"] == "a.png"))
    assert not seen.amplitude.any()


@pytest.mark.parametrize(
    "arguments",
    [
        {"size": [4, 64]},
        {"size": [64, 5000]},
        {"size": 64},
        {"shapes": [{"shape": "star"}]},
        {"shapes": [{"shape": "ring", "frequency": "high"}]},
        {"shapes": {}},
        {"strokes": [{"do": "undo"}]},
        {"strokes": [{"level": 1, "points": [[0, 0]]}]},
        {"strokes": [{"points": [[0, 0]], "layer": "Ink"}]},
        {"strokes": [{"points": [[0, 0]], "origin": [10**30, 0]}]},
        {"shapes": [{"shape": "ring"}] * 65},
        {"strokes": [7]},
        {"phase": "loud"},
        {"part": "half"},
        {"forward": 1},
        {"seed": 0.5},
    ],
)
def test_bad_designs_are_told_in_one_line(arguments):
    with pytest.raises((FieldError, TextureError)) as told:
        spectrum.read(arguments)
    assert "\n" not in str(told.value)
    assert next(iter(arguments)).rstrip("s") in str(told.value)


def test_the_level_of_a_stroke_is_named_with_what_was_found():
    with pytest.raises(FieldError) as told:
        spectrum.read({"strokes": [{"points": [[0, 0]]}, {"level": 3, "points": [[0, 0]]}]})
    assert str(told.value) == "strokes[1].level: found 3, expected 0"


@pytest.mark.parametrize("phase", spectrum.PHASES)
@pytest.mark.parametrize("forward", [False, True])
def test_phases_survive_their_command(phase, forward):
    design = Design((16, 16), RING.shapes, phase=phase, forward=forward)
    assert spectrum.read(design.to_arguments()) == design
    assert spectrum.read({"forward": forward}).phase == ("zero" if forward else "random")
