"""A picture of land by rays tells truly by how many pixels it may be wrong, whatever way it looks, and can stop."""

import math
from fractions import Fraction

import numpy as np
import pytest

from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.session.session import Session
from engine.terrain.camera import Camera, windows_of
from engine.terrain.caster import cast
from engine.terrain.drape import cover_of
from engine.terrain.finer_land import FinerPicture, roomy
from engine.terrain.height_window import in_pixels
from engine.terrain.land_picture import Shot
from engine.terrain.picture_error import picture_error
from engine.terrain.plane import land
from engine.terrain.seen_parts import PART_WINDOWS

SIZE, CELLS, DEEPER = (160, 100), 128, 3
INK = {"texture": "rock", "amount": 1, "period": 60, "roughness": 0.86, "renew": False, "colour": "#ffffff"}


@pytest.fixture(scope="module")
def seen():
    session = Session(Painting(Rect.at(0, 0, 256, 256), 7))
    for row in (
        {"do": "layer", "add": "Height"},
        {"do": "layer", "set": "Height", "role": "height", "scale": 40, "sea": 0},
        {
            "do": "stroke",
            "points": [[128, 128]],
            "brush": {"radius": 400, "colour": "#404040", "hardness": 1, "ink": [INK]},
        },
    ):
        session.do(parse(row))
    return land(session.painting)


def windows(seen, azimuth, **more):
    camera = Camera(0, Fraction(128), Fraction(128), 12.0, azimuth, -24.0, 55.0)
    return camera, windows_of(seen, camera, cover_of(seen, False), camera.finest(SIZE), cells=CELLS, **more)


@pytest.mark.parametrize("azimuth", [0.0, 90.0, 180.0, 270.0])
def test_what_a_picture_shows_lies_no_farther_off_than_it_tells(seen, azimuth):
    camera, made = windows(seen, azimuth, sharp=True)
    told = picture_error(seen, made, camera, SIZE)
    with pytest.raises(Cancelled):
        picture_error(seen, made, camera, SIZE, lambda: True)
    right, up, forward = camera.axes()
    pixel = 2 * math.tan(math.radians(camera.fov) / 2) / SIZE[0]
    rays, hits = np.zeros((60, 6)), np.empty((60, 2))
    at = [(x, y) for y in range(35, 95, 10) for x in range(8, 160, 16)]
    for ray, (x, y) in zip(rays, at, strict=True):
        way = forward + (x - SIZE[0] / 2) * pixel * right - (y - SIZE[1] / 2) * pixel * up
        ray[2], ray[3:] = made.eye, way / np.linalg.norm(way)
    cast(made.heights, made.tops, made.mips, made.places, rays, hits)
    finest = made.levels[-1]
    worst, off = 0.0, []
    foot = Rect.at(128 << finest, 128 << finest, 1, 1)
    base = float(seen.height(finest, foot)[0, 0])
    for ray, (t, _) in zip(rays[hits[:, 0] > 0], hits[hits[:, 0] > 0], strict=True):
        x, y, z = (ray[:3] + ray[3:] * t).tolist()
        level = finest + DEEPER
        fine = Rect.at(*(math.floor(math.ldexp(128 + math.ldexp(a, -finest), level)) for a in (x, y)), 1, 1)
        true = math.ldexp(float(seen.height(level, fine)[0, 0]) - base, finest)
        off.append((abs(true - z) / (t * pixel)) ** 2)
        worst = max(worst, abs(true - z) / (t * pixel))
    assert (hits[:, 0] > 0).sum() > 40
    assert told is not None
    assert 0.25 < worst <= told.hard < 100.0
    assert math.sqrt(sum(off) / len(off)) <= told.rms < 0.5 * told.hard


def test_it_is_the_same_whatever_way_one_looks(seen):
    """Once one that looked at the top of the canvas was said to be wrong by twenty times as much."""
    told = []
    for azimuth in (0.0, 90.0, 180.0, 270.0):
        camera, made = windows(seen, azimuth)
        found = picture_error(seen, made, camera, SIZE)
        assert found is not None
        told.append(found.hard)
    assert max(told) < 4 * min(told)


def test_windows_can_be_given_up_and_come_to_the_same_piece_by_piece(seen):
    _, whole = windows(seen, 30.0)
    _, parts = windows(seen, 30.0, cancelled=lambda: False)
    assert (whole.heights == parts.heights).all()
    left = iter([False, False])
    with pytest.raises(Cancelled):
        windows(seen, 30.0, cancelled=lambda: next(left, True))


def test_what_grows_is_the_same_worked_out_strip_by_strip(seen, monkeypatch):
    monkeypatch.setattr("engine.terrain.drape._STRIP", 1000)
    _, whole = windows(seen, 30.0)
    monkeypatch.setattr("engine.terrain.drape._STRIP", 40)
    _, strips = windows(seen, 30.0)
    assert np.array_equal(whole.colours, strips.colours)


def test_a_sharp_picture_has_more_land_near_the_eye_and_not_too_much_in_all(seen):
    deep = Camera(26, Fraction(128 << 26), Fraction(128 << 26), 20.0, 0.0, -24.0, 55.0)
    sides = []
    for sharp in (False, True):
        made = windows_of(seen, deep, cover_of(seen, False), deep.finest(SIZE), cells=16, sharp=sharp)
        sides.append(made.places[::-1, 2])
        assert 10 < len(made.levels) <= 19
    assert (sides[0][:8] == 4.0 ** np.arange(8)).all()
    assert (sides[1][:8] == 2.0 ** np.arange(8)).all()
    assert sides[1][-1] > 2.0**24  # as far as without


@pytest.mark.parametrize("finest", [33, 34, 38, 64])
def test_a_sharp_picture_is_told_from_one_place_however_deep_it_is(seen, finest):
    camera = Camera(finest, Fraction(128 << finest), Fraction(128 << finest), 20.0, 0.0, -24.0, 55.0)
    made = windows_of(seen, camera, cover_of(seen, False), finest, cells=16, sharp=True)
    assert min(made.levels) >= made.about.level
    assert np.isfinite(made.heights).all()


SMALL = 64, 40


def finer(seen, cancelled=None):
    """Windows of a small picture, the error of it, the finer picture, and its error."""
    camera = Camera(0, Fraction(128), Fraction(128), 12.0, 0.0, -24.0, 55.0)
    made = roomy(windows_of(seen, camera, cover_of(seen, False), camera.finest(SMALL), cells=256, sharp=True))
    usual = picture_error(seen, made, camera, SMALL)
    flat = np.zeros((SMALL[1], SMALL[0], 3), np.uint8)
    return made, usual, *FinerPicture(seen, made, Shot(camera, SMALL, 1), 256, cancelled).over(flat, usual)


def test_room_for_finer_windows_is_had_with_the_others(seen):
    camera = Camera(0, Fraction(128), Fraction(128), 12.0, 0.0, -24.0, 55.0)
    few, made = (
        windows_of(seen, camera, cover_of(seen, False), camera.finest(SMALL), cells=16, sharp=True, room=room)
        for room in (0, PART_WINDOWS)
    )
    for name in ("heights", "tops", "colours"):
        whole, before = getattr(roomy(made), name), getattr(made, name)
        assert np.shares_memory(whole, before)
        assert len(whole) == len(getattr(roomy(few), name)) == len(before) + PART_WINDOWS
        assert np.array_equal(before, getattr(few, name))


def test_the_last_picture_shows_finer_land_with_the_same_bits_for_any_number_of_threads(seen, monkeypatch):
    laid, lay = [], FinerPicture._lay

    def noted(picture, pool, one, grid, w):
        done = lay(picture, pool, one, grid, w)
        laid.append((one, grid, done[-1][0], picture._windows.heights[w].copy()))
        return done

    monkeypatch.setattr(FinerPicture, "_lay", noted)
    made, usual, picture, error = finer(seen)
    assert error.rms < 0.4 * usual.rms
    assert error.hard <= usual.hard
    assert (picture.min(axis=2)[20:] > 0).all()
    for one, grid, run, heights in laid[:: max(1, len(laid) // 4)]:
        area = Rect.at(grid.x + one.left + run.x0, grid.y + one.top + run.y0, run.width, run.height)
        told = in_pixels(seen.height(grid.level, area) - made.base, grid.level).astype(np.float32)
        assert np.array_equal(heights[run.y0 : run.y1, run.x0 : run.x1], told)
    monkeypatch.setattr("engine.terrain.finer_land._THREADS", 1)
    assert np.array_equal(finer(seen)[2], picture)
    asked = iter([False] * 5)
    with pytest.raises(Cancelled):
        finer(seen, lambda: next(asked, True))
