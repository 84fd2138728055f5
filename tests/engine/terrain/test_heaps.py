"""Heights that brushes heap: as fine at any depth, the same bits for every window, taken by erasers, undone, saved."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.heaps.heaps import exponent, share
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import version_of
from engine.painting.value import Painting
from engine.session.apply import Around, apply
from engine.session.session import Session
from engine.terrain.layer_heights import Pixel, expanded
from engine.terrain.plane import IMPASTO, land

FRAME = Rect.at(0, 0, 192, 128)
PLACE = 70, 61
ROLE = {"do": "layer", "set": "Layer 1", "role": "height", "scale": 60}
MOUNTAIN = {
    "do": "stroke",
    "points": [[70, 60], [110, 70]],
    "brush": {"radius": 50, "colour": "#808080", "hardness": 0.1},
}


def at(level):
    return tuple(v << level if level >= 0 else v >> -level for v in PLACE)


def stroke(level, radius=12.0, **brush):
    """A dab at one place, at any level."""
    told = {"radius": radius, "hardness": 0, "height": "auto", **brush}
    return {"do": "stroke", "level": level, "origin": list(at(level)), "points": [[0, 0]], "brush": told}


def painted(*commands):
    painting = Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(command), Around())
    return painting


def window(level, half=20):
    x, y = at(level)
    return Rect(x - half, y - half, x + half, y + half)


def heights(painting, level, rect=None, source="Layer 1"):
    """Of a window of a level, in pixels of that level."""
    return np.ldexp(land(painting, source).height(level, rect or window(level)), level)


def laid(painting, before, level, rect=None):
    return heights(painting, level, rect) - heights(before, level, rect)


@pytest.fixture(scope="module")
def ground():
    return painted(MOUNTAIN, ROLE)


@pytest.mark.parametrize("level", [0, 8, 16, 40])
def test_a_stone_is_as_high_and_as_fine_at_any_depth(ground, level):
    found = laid(apply(ground, parse(stroke(level)), Around()), ground, level)
    stone = laid(apply(ground, parse(stroke(0)), Around()), ground, 0)
    assert found.max() == pytest.approx(3.0, abs=0.05)
    assert np.abs(found - stone).max() < 0.02
    assert found[0, 0] == pytest.approx(0.0, abs=1e-3)
    assert len(np.unique(found)) > 40


@pytest.mark.parametrize("level", [-2, 0, 8, 16, 40])
def test_a_part_has_the_bits_of_the_whole(ground, level):
    painting = apply(ground, parse(stroke(level)), Around())
    painting = apply(painting, parse(stroke(max(level - 5, -3), height=-4)), Around())
    whole = window(level)
    seen = land(painting, "Layer 1")
    about = seen.about(level, whole) if level > 32 else None
    large = seen.height(level, whole, about)
    for x, y, w, h in ((0, 0, 1, 1), (7, 13, 20, 9), (20, 11, 20, 29)):
        piece = Rect.at(whole.x0 + x, whole.y0 + y, w, h)
        assert np.array_equal(land(painting, "Layer 1").height(level, piece, about), large[piece.slices(whole)])


def test_strokes_add_up_in_any_order(ground):
    one, other = stroke(8), stroke(8, height=-5, radius=20)
    first = apply(apply(ground, parse(one), Around()), parse(other), Around())
    second = apply(apply(ground, parse(other), Around()), parse(one), Around())
    assert np.array_equal(heights(first, 8), heights(second, 8))
    twice = apply(apply(ground, parse(one), Around()), parse(one), Around())
    single = laid(apply(ground, parse(one), Around()), ground, 8)
    assert np.abs(laid(twice, ground, 8) - 2 * single).max() < 1e-3


def test_an_eraser_takes_the_stone_and_leaves_the_mountain(ground):
    stone = apply(ground, parse(stroke(8)), Around())
    gone = apply(stone, parse(stroke(8, radius=60, hardness=1, mode="erase", spacing=1)), Around())
    assert np.abs(laid(gone, ground, 8)).max() < 1e-3
    hill = apply(ground, parse(stroke(0, radius=40, height=20)), Around())
    kept = apply(hill, parse(stroke(16, radius=60, hardness=1, mode="erase")), Around())
    assert np.array_equal(heights(kept, 16), heights(hill, 16))


def test_a_smoother_lowers_the_top(ground):
    stone = apply(ground, parse(stroke(8)), Around())
    smooth = apply(stone, parse(stroke(8, radius=60, mode="smooth", hardness=1)), Around())
    assert 0.2 < laid(smooth, ground, 8).max() < 0.9 * laid(stone, ground, 8).max()
    assert layers.find(smooth.root, "Layer 1").pyramid is layers.find(ground.root, "Layer 1").pyramid


def test_it_paints_nothing_on_the_layer_of_heights_and_nothing_without_the_role(ground):
    before, plain = layers.find(ground.root, "Layer 1"), painted(MOUNTAIN)
    after = layers.find(apply(ground, parse(stroke(3)), Around()).root, "Layer 1")
    assert after.pyramid is before.pyramid
    assert after.heaps
    paint = layers.find(apply(plain, parse(stroke(3)), Around()).root, "Layer 1")
    assert not paint.heaps
    assert paint.pyramid is not layers.find(plain.root, "Layer 1").pyramid


def test_impasto_lies_beside_the_paint(ground):
    plain = painted(MOUNTAIN)
    thick = apply(plain, parse(stroke(0, height=None, impasto=2)), Around())
    thin = apply(plain, parse(stroke(0, height=None)), Around())
    own, other = (layers.find(one.root, "Layer 1") for one in (thick, thin))
    assert np.array_equal(evaluate(own.pyramid, 0, FRAME).data, evaluate(other.pyramid, 0, FRAME).data)
    assert heights(thick, 0, source=IMPASTO).max() == pytest.approx(2.0, abs=0.05)
    assert not heights(thin, 0, source=IMPASTO).any()


def test_the_land_keeps_its_promise(ground):
    painting = ground
    for level in (0, 3, 7):
        painting = apply(painting, parse(stroke(level, radius=20)), Around())
    seen = land(painting, "Layer 1")
    for level in (0, 1, 2, 3, 5, 8):
        rect = window(level, 8)
        promised, far = seen.bound(level, rect), seen.height(level, rect.grown(3))
        for _ in range(4):
            far = expanded(far)
        edge = (far.shape[0] - 256) // 2
        left = np.abs(seen.height(level + 4, rect.zoomed(4)) - far[edge : edge + 256, edge : edge + 256]).max()
        assert left <= promised.hard


def test_undo_save_and_open_keep_the_bits(tmp_path):
    session = Session(Painting(FRAME, 7))
    for command in (MOUNTAIN, ROLE, stroke(9)):
        session.do(parse(command))
    stone = heights(session.painting, 9)
    session.do(parse(stroke(9, height=-2)))
    crater = session.painting
    session.do(parse({"do": "undo"}))
    assert np.array_equal(heights(session.painting, 9), stone)
    session.do(parse({"do": "redo"}))
    assert np.array_equal(heights(session.painting, 9), heights(crater, 9))
    save(tmp_path / "land.ora", Snapshot(session.painting))
    again = open_painting(tmp_path / "land.ora").painting
    assert np.array_equal(heights(again, 9), heights(crater, 9))
    assert np.array_equal(heights(again, 12), heights(crater, 12))
    more = apply(again, parse(stroke(10)), Around())
    assert np.array_equal(heights(more, 10), heights(apply(crater, parse(stroke(10)), Around()), 10))


@settings(max_examples=60, deadline=None)
@given(
    st.floats(2.0**-20, 4000.0).flatmap(lambda high: st.sampled_from([high, -high])),
    st.integers(-60, 4000),
)
def test_every_height_fits_its_heap_and_leaves_room(height, level):
    unit = exponent(height, level)
    assert 2.0**-7 < abs(share(height, level, unit)) <= 0.25


def test_windows_of_level_40_fit_with_a_pixel_elsewhere(ground):
    painting = apply(ground, parse(stroke(40)), Around())
    whole = window(40)
    far = Pixel(40, whole.x0 + (1 << 20), whole.y0).above(8)
    seen = land(painting, "Layer 1").height(40, whole, far)
    assert np.array_equal(
        land(painting, "Layer 1").height(40, Rect(*whole[:2], whole.x0 + 9, whole.y1), far), seen[:, :9]
    )


def test_what_is_heaped_goes_with_its_layer(ground):
    painting = apply(ground, parse(stroke(8)), Around())
    x, y = at(8)
    moved = apply(painting, parse({"do": "layer", "set": "Layer 1", "level": 8, "at": [64, 32]}), Around())
    there = Rect(x - 20, y - 20, x + 20, y + 20)
    beside = Rect(x + 44, y + 12, x + 84, y + 52)
    assert np.allclose(laid(moved, _moved(ground), 8, beside), laid(painting, ground, 8, there), rtol=0, atol=1e-3)
    cleared = apply(painting, parse({"do": "layer", "clear": "Layer 1"}), Around())
    assert not layers.find(cleared.root, "Layer 1").heaps
    rect = {"do": "select", "rect": [8, x - 3, y - 3, 6, 6]}
    part = apply(apply(painting, parse(rect), Around()), parse({"do": "layer", "clear": "Layer 1"}), Around())
    left = np.ldexp(land(part, "Layer 1", ground=0.0).height(8, there), 8)
    bare = np.ldexp(land(painting, "Layer 1", ground=0.0).height(8, there), 8)
    assert left[20, 20] < bare[20, 20] - 2.9
    assert left[5, 20] == pytest.approx(bare[5, 20], abs=0.5)  # the canvas rounds


def _moved(painting):
    return apply(painting, parse({"do": "layer", "set": "Layer 1", "level": 8, "at": [64, 32]}), Around())


@pytest.mark.parametrize(("name", "found"), [("height", 5000), ("height", "low"), ("impasto", None)])
def test_a_height_that_cannot_be_is_refused(name, found):
    with pytest.raises(FieldError, match=f"brush.{name}"):
        parse(stroke(0, **{name: found}))


def test_a_recording_that_heaps_is_one_of_version_2():
    assert version_of(parse(stroke(0))) == version_of(parse(stroke(0, height=None, impasto=1))) == 2
    assert version_of(parse(stroke(0, height=None, impasto=0))) == 1


INK = [
    {"texture": "rock", "amount": 0.6, "colour": "#ffffff", "period": 6, "roughness": 0.9, "renew": False, "seed": 3}
]


@pytest.mark.parametrize("level", [0, 8, 16])
def test_ink_makes_a_stone_rough_at_any_depth(ground, level, tmp_path):
    told = stroke(level, radius=24, colour="#000000", ink=INK)
    painting = apply(ground, parse(told), Around())
    x, y = at(level)
    fine = Rect((x << 6) - 30, (y << 6) - 30, (x << 6) + 30, (y << 6) + 30)
    rough, smooth = (
        heights(one, level + 6, fine) for one in (painting, apply(ground, parse(stroke(level, radius=24)), Around()))
    )
    assert np.abs(np.diff(rough, 2)).max() > 20 * np.abs(np.diff(smooth, 2)).max()
    seen = land(painting, "Layer 1")
    part = Rect(fine.x0 + 7, fine.y0 + 3, fine.x0 + 30, fine.y0 + 44)
    assert np.array_equal(seen.height(level + 6, part), seen.height(level + 6, fine)[part.slices(fine)])
    save(tmp_path / "stone.ora", Snapshot(painting))
    again = open_painting(tmp_path / "stone.ora").painting
    assert np.array_equal(heights(again, level + 6, fine), rough)


def test_a_heap_is_full_at_some_time(ground):
    painting = ground
    for _ in range(40):
        painting = apply(painting, parse(stroke(4, height=3.9, ink=INK, hardness=1, radius=8)), Around())
    (heap,) = layers.find(painting.root, "Layer 1").heaps.values()
    data = evaluate(heap, 4, window(4)).data
    assert data[0].max() == 8.0
    assert np.abs(data[4:]).max() == 2.0
