"""The canvas on the card, drawn without any display: what covers what, and where."""

import numpy as np
import pytest

from app.canvas.screen import DARK, FADE, LIGHT, SCREEN_TILE, Screen, ScreenTile, cells, near_first
from app.canvas.view import Place, View
from engine.light.light import Light
from engine.light.lit_relief import lit, luminance
from engine.numeric.address import Rect
from engine.studio.results import Patch

SIZE = (640, 480)
RED, GREEN, CLEAR = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 0, 0)
FRAME = Rect(-100, -100, 100, 100)


@pytest.fixture
def screen(context):
    return Screen(context)


def view(level=0, fraction=0.0, centre=Place(0, 0, 0)):  # noqa: B008  # frozen
    return View(centre, level, fraction, *SIZE)


def patch(tile, colour, revision=1, area=None):
    area = area or Rect(0, 0, SCREEN_TILE, SCREEN_TILE)
    pixels = np.empty((area.height, area.width, 4), np.uint8)
    pixels[:] = colour
    return Patch(tile, area, pixels, revision)


def shown(screen, at, now=100.0, frame=FRAME, **insets):
    """The picture, uint8 (480, 640, 3), and whether something still fades."""
    target = screen.ctx.simple_framebuffer(SIZE)
    target.use()
    target.clear()
    plan = screen.plan(at, frame, now, **insets)
    screen.draw(plan)
    picture = np.frombuffer(target.read(), np.uint8).reshape(SIZE[1], SIZE[0], 3)[::-1]
    target.release()
    return picture.astype(int), plan.moving


def test_a_tile_lies_where_its_pixels_do(screen):
    at = view()
    screen.upload(patch((0, 0, 0), RED), at, 0.0)
    picture, moving = shown(screen, at)
    assert (picture[240 : 240 + 200, 320 : 320 + SCREEN_TILE] == RED[:3]).all()
    assert (picture[:239, :319, 0] != 255).any()
    assert tuple(picture[239, 319]) != RED[:3]
    assert not moving


def test_the_frame_is_light_paper_on_a_dark_desk(screen):
    picture, _ = shown(screen, view())
    assert picture[240, 320].min() > 255 * LIGHT - 16
    assert abs(picture[20, 20] - 255 * DARK).max() < 3
    assert len(np.unique(picture[150:330, 230:410])) > 1  # the squares


def test_translucent_paint_lets_the_paper_through(screen):
    at = view()
    screen.upload(patch((0, 0, 0), (64, 0, 0, 128)), at, 0.0)
    bare, _ = shown(Screen(screen.ctx), at)
    picture, _ = shown(screen, at)
    expected = 64 * np.array([1, 0, 0]) + bare[260, 340] * (127 / 255)
    assert abs(picture[260, 340] - expected).max() <= 2


def test_the_magnified_ancestor_shows_until_the_tile_has_come_then_it_fades_in(screen):
    coarse, fine = view(0), view(1, centre=Place(32, 32, 0))
    screen.upload(patch((0, 0, 0), GREEN), coarse, 0.0)
    picture, moving = shown(screen, fine)
    assert (picture[200:280, 300:340] == GREEN[:3]).all()
    assert not moving
    screen.upload(patch((1, 0, 0), RED), fine, 100.0)
    picture, moving = shown(screen, fine, 100.0 + FADE / 2)
    assert moving
    assert abs(picture[240, 320] - (128, 128, 0)).max() <= 2
    picture, moving = shown(screen, fine, 100.0 + 2 * FADE)
    assert not moving
    assert tuple(picture[240, 320]) == RED[:3]


def test_finer_tiles_fill_the_place_after_zooming_out(screen):
    near = view(1)
    for x in (0, 1):
        for y in (0, 1):
            screen.upload(patch((1, x, y), RED), near, 0.0)
    picture, _ = shown(screen, view(0))
    assert (picture[242:470, 322:560] == RED[:3]).all()


def test_a_part_of_a_tile_changes_that_part(screen):
    at = view()
    screen.upload(patch((0, 0, 0), RED), at, 0.0)
    screen.upload(patch((0, 0, 0), GREEN, 2, Rect(10, 20, 30, 50)), at, 0.0)
    picture, _ = shown(screen, at)
    assert (picture[260:290, 330:350] == GREEN[:3]).all()
    assert tuple(picture[259, 329]) == RED[:3]
    assert screen.revision(ScreenTile(0, 0, 0)) == 2


def test_a_part_of_a_tile_that_is_not_there_is_dropped(screen):
    screen.upload(patch((0, 5, 5), RED, 3, Rect(0, 0, 8, 8)), view(), 0.0)
    assert screen.revision(ScreenTile(0, 5, 5)) == -1


def test_a_tile_that_becomes_transparent_shows_the_paper_again(screen):
    at = view()
    screen.upload(patch((0, 0, 0), RED), at, 0.0)
    screen.upload(patch((0, 0, 0), CLEAR, 2), at, 0.0)
    assert np.array_equal(shown(screen, at)[0], shown(Screen(screen.ctx), at)[0])


def test_nothing_is_drawn_under_the_panels(screen):
    screen.upload(patch((0, 0, 0), RED), view(), 0.0)
    picture, _ = shown(screen, view(), insets=(100, 10, 50, 20))
    assert not picture[:, :100].any()
    assert not picture[:10].any()
    assert picture[11, 101].any()


def test_plans_are_equal_where_nothing_changes(screen):
    at = view()
    screen.upload(patch((0, 0, 0), RED), at, 0.0)
    first = screen.plan(at, FRAME, 100.0)
    assert screen.plan(at, FRAME, 101.0) == first
    assert screen.plan(view(centre=Place(1, 0, 0)), FRAME, 101.0) != first
    assert screen.plan(at, FRAME, 101.0, insets=(10, 0, 0, 0)) != first
    assert screen.plan(at, None, 101.0) != first
    screen.upload(patch((0, 0, 0), GREEN, 2, Rect(0, 0, 9, 9)), at, 102.0)
    assert screen.plan(at, FRAME, 103.0) != first


def test_plans_differ_while_a_tile_fades_in(screen):
    at = view(1, centre=Place(32, 32, 0))
    screen.upload(patch((0, 0, 0), GREEN), view(), 0.0)
    screen.upload(patch((1, 0, 0), RED), at, 100.0)
    early, later = (screen.plan(at, FRAME, 100.0 + part * FADE) for part in (0.3, 0.6))
    assert early.moving
    assert early != later


def test_old_tiles_make_room(screen):
    at = view()
    for n in range(400):
        screen.upload(patch((0, n, 0), RED), at, 0.0)
    assert screen.revision(ScreenTile(0, 0, 0)) == -1
    assert screen.revision(ScreenTile(0, 399, 0)) == 1


def test_forgetting_drops_all(screen):
    screen.upload(patch((0, 0, 0), RED), view(), 0.0)
    screen.forget()
    assert screen.revision(ScreenTile(0, 0, 0)) == -1


def test_a_thousand_levels_deep_the_tile_is_where_it_should_be(screen):
    centre = Place((1 << 1000) + 128, 128, 1000)
    at = view(1000, centre=centre)
    tile = (1000, (1 << 1000) // SCREEN_TILE, 0)
    screen.upload(patch(tile, RED), at, 0.0)
    picture, _ = shown(screen, at)
    assert (picture[240 - 127 : 240 + 127, 320 - 127 : 320 + 127] == RED[:3]).all()
    assert tuple(picture[240, 320 - 130]) != RED[:3]


def test_tiles_are_asked_for_from_the_pointer_outwards():
    at = view()
    ordered = near_first(at, cells(at, 0), 600, 440)
    assert ordered[0] == ScreenTile(0, 1, 0)
    assert set(ordered) == set(cells(at, 0))


def painted_tiles(screen, at, seed=4, heights=None):
    """Uploads smooth paint over four tiles, perhaps with heights; returns what lies there, float32 (4, 512, 512)."""
    rng = np.random.default_rng(seed)
    coarse = rng.random((3, 9, 9))
    y, x = np.mgrid[0:512, 0:512] / 64
    waves = np.stack([one[y.astype(int), x.astype(int)] for one in coarse])
    ramp = 0.4 + 0.3 * np.sin(x * 5 + y * 3) * waves
    pixels = np.concatenate([np.rint(255 * ramp), np.full((1, 512, 512), 255)]).astype(np.uint8).transpose(1, 2, 0)
    for row in (0, 1):
        for column in (0, 1):
            tile = slice(256 * row, 256 * (row + 1)), slice(256 * column, 256 * (column + 1))
            part, known = np.ascontiguousarray(pixels[tile]), None if heights is None else heights[tile].copy()
            screen.upload(Patch((0, column - 1, row - 1), Rect(0, 0, 256, 256), part, 1, known), at, 0.0)
    return (pixels.transpose(2, 0, 1) / np.float32(255)).astype(np.float32)


@pytest.mark.parametrize("light", [Light(300, 40, 8, 0.3), Light(120, 70, -20, 0)])
def test_the_light_is_that_of_the_law_across_the_seams_of_tiles(screen, light):
    at = view()
    planes = painted_tiles(screen, at)
    picture, _ = shown(screen, at, light=light)
    expected = 255 * lit(planes, luminance(planes), light)[:3].transpose(1, 2, 0)
    rows, columns = slice(240 - 239, 240 + 239), slice(320 - 255, 320 + 255)  # all but the rims of screen and paint
    assert abs(picture[rows, columns] - expected[255 - 239 : 255 + 239]).max() <= 1


def test_heights_of_tiles_are_finer_than_their_pixels_and_may_be_others(screen):
    at, light = View(Place(0, 0, 0), 0, 0.0, 400, 300), Light(300, 30, 60, 0.3, "a layer")
    y, x = np.mgrid[0:512, 0:512]
    heights = np.rint(40000 + 900 * np.sin(x / 9) * np.cos(y / 7)).astype(np.uint16)  # of two steps of eight bits
    planes = painted_tiles(screen, at, heights=heights)
    target = screen.ctx.simple_framebuffer((400, 300))
    target.use()
    screen.draw(screen.plan(at, None, 100.0, light=light))
    picture = np.frombuffer(target.read(), np.uint8).reshape(300, 400, 3)[::-1].astype(int)
    target.release()
    expected = 255 * lit(planes, (heights / np.float32(65535)).astype(np.float32), light)[:3].transpose(1, 2, 0)
    seen = expected[255 - 150 : 255 + 150, 255 - 200 : 255 + 200]  # to the screen's border
    assert abs(seen - 255 * planes[:3, 106:406, 56:456].transpose(1, 2, 0)).max() > 15
    assert abs(picture - seen).max() <= 1


def test_where_no_heights_have_come_those_of_the_pixels_show(screen):
    at, light = view(), Light(300, 40, 8, 0.3)
    painted_tiles(screen, at)
    plain, _ = shown(screen, at, light=light)
    painted_tiles(screen, at, heights=np.zeros((512, 512), np.uint16))
    flat, _ = shown(screen, at, light=light)
    assert not np.array_equal(flat, plain)
    assert np.array_equal(flat, shown(screen, at)[0])
    painted_tiles(screen, at)
    again, _ = shown(screen, at, light=light)
    assert np.array_equal(again, plain)


def test_what_is_flat_and_what_is_no_paint_stay_as_they_are_in_the_light(screen):
    at = view()
    screen.upload(patch((0, 0, 0), (120, 30, 30, 255)), at, 0.0)
    plain, _ = shown(screen, at)
    picture, _ = shown(screen, at, light=Light(315, 30, 30, 1))
    same = (picture == plain).all(axis=2)
    assert same[242:, 322:574].all()
    assert same[:238].all()
    assert same[:, :318].all()
    assert not same[300:400, 319:321].all()
    again, _ = shown(screen, at)
    assert np.array_equal(again, plain)


def test_with_a_colour_of_paper_paint_stands_off_from_it(screen):
    at = view()
    screen.upload(patch((0, 0, 0), (60, 60, 60, 255)), at, 0.0)
    light = Light(270, 45, 10, 0)
    picture, _ = shown(screen, at, paper="#3c3c3c", light=light)
    assert (picture == 60).all()
    picture, _ = shown(screen, at, paper="#ffffff", light=light)
    assert (picture[300, 321] == 60).all()
    assert picture[300, 320, 0] < 60
