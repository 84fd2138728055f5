"""Rays over land: against marching by small steps, across windows, and in pictures that are not mirrored."""

import math
import tracemalloc
from fractions import Fraction

import numpy as np
import pytest

from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.painting.value import Painting
from engine.terrain import beams, caster
from engine.terrain.camera import Camera, windows_of
from engine.terrain.caster import CELLS_PER_PIXEL, cast, maxima, mipmap_of, room_of
from engine.terrain.drape import Cover
from engine.terrain.land_picture import Shot, developed, exposed, refinement
from engine.terrain.plane import Land

CELLS = 64
COVER = Cover(None, -8.0, 8.0)


class Hills(Land):
    """Land of a formula, in pixels of level 0."""

    def height(self, level, rect, about=None):
        x, y = ((np.arange(a, b) + 0.5) / 2.0**level for a, b in ((rect.x0, rect.x1), (rect.y0, rect.y1)))
        x, y = x[None], y[:, None]
        return 6 * np.sin(x / 9) * np.cos(y / 7) + 2 * np.sin(x * 0.9 + y * 1.3) + np.sin(3.1 * x - 2.3 * y) / 2


class Letter(Land):
    """An F of walls, 40 pixels high, its stem from (20, 10) to (26, 54)."""

    def height(self, level, rect, about=None):
        x, y = ((np.arange(a, b) + 0.5) / 2.0**level for a, b in ((rect.x0, rect.x1), (rect.y0, rect.y1)))
        x, y = np.broadcast_arrays(x[None], y[:, None])
        stem = (x >= 20) & (x < 26) & (y >= 10) & (y < 54)
        arms = (x >= 20) & (x < 46) & (((y >= 10) & (y < 16)) | ((y >= 28) & (y < 34)))
        return np.where(stem | arms, 4.0, 0.0)


def made(kind):
    return kind(Painting(Rect.at(0, 0, 64, 64), 1), "composite", 1.0, 0.0, 0.0)


def rays(count, seed=4):
    random = np.random.default_rng(seed)
    start = np.c_[random.uniform(-6, 6, (count, 2)), random.uniform(45, 60, count)]
    turn, down = random.uniform(0, 2 * math.pi, count), random.uniform(-0.95, -0.4, count)
    down[:4] = 0.3  # towards the sky
    flat = np.sqrt(1 - down * down)
    return np.c_[start, flat * np.cos(turn), flat * np.sin(turn), down]


def surface(windows, w, x, y):
    """The bilinear surface of a window, in pixels of the finest."""
    side = windows.places[w, 2]
    i, j = (x - windows.places[w, 0]) / side, (y - windows.places[w, 1]) / side
    n = windows.heights.shape[1] - 1
    if not (0 <= i < n and 0 <= j < n):
        return None
    h, u, v, i, j = windows.heights[w].astype(float), i - int(i), j - int(j), int(i), int(j)
    top, low = h[j, i] + u * (h[j, i + 1] - h[j, i]), h[j + 1, i] + u * (h[j + 1, i + 1] - h[j + 1, i])
    return side * (top + v * (low - top))


def marched(windows, ray, step=0.01):
    """The first place where a ray is below the finest window there is, by small steps, then halved."""

    def above(t):
        x, y, z = ray[:3] + t * ray[3:]
        for w in range(len(windows.places) - 1, -1, -1):
            ground = surface(windows, w, x, y)
            if ground is not None:
                return z - ground
        return None

    t = 0.0
    while (gap := above(t)) is not None and t < 400:
        if gap < 0:
            low, high = t - step, t
            for _ in range(30):
                middle = (low + high) / 2
                low, high = (low, middle) if above(middle) < 0 else (middle, high)
            return high
        t += max(step, gap / 40)
    return -1.0


@pytest.fixture(scope="module")
def windows():
    """Three of hills, which have 64 cells each way."""
    camera = Camera(0, Fraction(32), Fraction(32), 6.0, tilt=-90.0)
    return windows_of(made(Hills), camera, COVER, 2, cells=CELLS)


def test_hits_are_those_of_marching(windows):
    some = rays(40)
    hits = np.empty((len(some), 2))
    cast(windows.heights, windows.tops, windows.mips, windows.places, some, hits)
    expected = np.array([marched(windows, ray) for ray in some])
    assert (expected > 0).sum() > 20
    assert ((hits[:, 0] >= 0) == (expected >= 0)).all()
    assert np.abs(hits[:, 0] - expected).max() < 1e-4
    assert set(hits[:, 1]) >= {-1.0, 2.0, 3.0}


def test_working_out_windows_takes_little_more_room_than_they_do(windows, monkeypatch):
    """Once heights and colours of a whole window came and went several times over, 60 MB."""
    monkeypatch.setattr("engine.terrain.camera._ROWS_AT_ONCE", 32)
    monkeypatch.setattr("engine.terrain.drape._STRIP", 32)
    camera = Camera(0, Fraction(64), Fraction(64), 9.0, 0.0, -12.0)
    tracemalloc.start()
    made_here = windows_of(made(Hills), camera, COVER, 2, cells=256)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    held = made_here.heights.nbytes + made_here.tops.nbytes + made_here.colours.nbytes
    assert held < 8.4 * made_here.heights.size
    assert most - held < 20 * made_here.heights[0].nbytes


def test_maxima_are_of_the_corners_of_all_cells():
    h = np.random.default_rng(1).normal(size=(9, 9)).astype(np.float32)
    offsets, sides = mipmap_of(8)
    found = maxima(h)
    assert len(found) == offsets[-1] + 1 == room_of((offsets, sides))
    for k, side in list(enumerate(sides))[1:]:
        wide = 8 // side
        for j in range(side):
            for i in range(side):
                part = h[j * wide : (j + 1) * wide + 1, i * wide : (i + 1) * wide + 1]
                assert found[offsets[k] + j * side + i] == part.max()


def test_a_finer_window_becomes_the_coarser_one_at_its_rim(windows):
    w = len(windows.places) - 1
    x, y, side = windows.places[w]
    for k in range(0, CELLS, 5):
        for at in ((x + k * side, y), (x, y + k * side)):
            assert surface(windows, w, *at) == pytest.approx(surface(windows, w - 1, *at), abs=1e-4)


def shown(kind, camera, size=(48, 48), samples=1, finest=0):
    land = made(kind)
    seen = windows_of(land, camera, COVER, finest, cells=CELLS)
    shot = Shot(camera, size, samples, sun=(300.0, 80.0))
    return developed(exposed(seen, shot, 64), samples)


def test_an_f_reads_as_an_f_from_above():
    camera = Camera(0, Fraction(32), Fraction(32), 60.0, tilt=-90.0, fov=56.0)
    picture = shown(Letter, camera, (64, 64)).astype(float)
    wanted = made(Letter).height(0, Rect.at(0, 0, 64, 64)) > 2
    edges = np.abs(np.diff(picture.sum(axis=2), axis=1))[:, 1:]
    assert edges[12:52, 16:30].max() > 20
    scores = {}
    for name, letter in {"F": wanted, "mirrored": wanted[:, ::-1], "upside down": wanted[::-1]}.items():
        outline = np.abs(np.diff(letter.astype(float), axis=1))[:, 1:]
        scores[name] = np.corrcoef(outline.ravel(), edges.ravel())[0, 1]
    assert max(scores, key=scores.get) == "F", scores


def test_pictures_have_the_same_bits_for_one_thread_and_two(monkeypatch):
    camera = Camera(0, Fraction(32), Fraction(60), 9.0, 0.0, -12.0)
    pictures = []
    for count in (1, 2):
        monkeypatch.setattr("os.cpu_count", lambda count=count: count)
        pictures.append(shown(Hills, camera, (40, 30), samples=2))
    assert np.array_equal(*pictures)
    assert pictures[0][:4, :, 2].mean() > pictures[0][-4:, :, 2].mean()  # sky above, ground below


def test_land_becomes_the_sky_where_it_ends_even_without_haze():
    camera = Camera(0, Fraction(32), Fraction(32), 40.0, 180.0, 0.0, 3.0)
    seen = windows_of(made(Letter), camera, COVER, 0, cells=CELLS)
    light = exposed(seen, Shot(camera, (8, 64), 1, sun=(300.0, 80.0)), 1e9)
    steps = np.abs(np.diff(light, axis=0)).max(axis=(1, 2))
    assert steps[30:].max() < 0.1


def test_a_picture_becomes_sharper_until_it_is_the_one_that_is_asked_for():
    camera = Camera(0, Fraction(32), Fraction(60), 9.0, 0.0, -12.0)
    seen = windows_of(made(Hills), camera, COVER, 0, cells=CELLS)
    shot = Shot(camera, (42, 30), 6, sun=(300.0, 60.0))
    stages = list(refinement(seen, shot, 64))
    assert [(stage.by, stage.samples, stage.picture.shape[:2]) for stage in stages] == [
        (4, 1, (8, 11)),
        (1, 1, (30, 42)),
        (1, 4, (30, 42)),
        (1, 6, (30, 42)),
    ]
    last = developed(exposed(seen, shot, 64), 6)
    assert np.array_equal(stages[-1].picture, last)
    means = [stage.picture[: 28 // stage.by, : 40 // stage.by].mean(axis=(0, 1)) for stage in stages]
    assert np.abs(np.array(means) - means[-1]).max() < 8
    with pytest.raises(Cancelled):
        next(refinement(seen, shot, 64, lambda: True))


CONE = 0.03


def marched_by_cone(windows, ray, step=0.01):
    """As `marched`, in the finest window whose cells are not too small for a pixel there."""
    last = len(windows.places) - 1

    def above(t):
        x, y, z = ray[:3] + t * ray[3:]
        for w in range(last, -1, -1):
            near = w == 0 or t < CELLS_PER_PIXEL * windows.places[w, 2] / CONE
            ground = surface(windows, w, x, y) if near else None
            if ground is not None:
                return z - ground
        return None

    t = 0.0
    while (gap := above(t)) is not None and gap >= 0 and t < 400:
        t += max(step, gap / 40)
    return t if gap is not None and gap < 0 else -1.0


def test_rays_of_a_picture_begin_where_there_is_no_land_before(windows, monkeypatch):
    """The plain forms of what is compiled: beams begin near the land, and from there rays meet what marching does."""
    for module, name in ((beams, "_overlooks"), (caster, "_first_hit")):
        monkeypatch.setattr(module, name, getattr(module, name).py_func)
    w, o, room = windows, np.array([0.0, 0.0, windows.eye + 20]), np.empty(5)
    highest = float((w.tops[:, -1] * w.places[:, 2]).max())
    near = []
    for left, top in np.random.default_rng(2).uniform(-0.8, 0.8, (12, 2)):
        corners = np.array([[left + CONE * 4 * (q & 1), top + CONE * 4 * (q >> 1), -0.9] for q in range(4)])
        corners *= 1.0 / np.linalg.norm(corners, axis=1).min()
        begin = beams.clear_until.py_func(
            w.heights, w.tops, w.mips, w.places, o, corners, CONE, highest, 0.0, 1e3, room
        )
        for parts in ((0.1, 0.2), (0.9, 0.4), (0.5, 0.9)):
            d = corners[0] + parts[0] * (corners[1] - corners[0]) + parts[1] * (corners[2] - corners[0])
            size = float(np.linalg.norm(d))
            expected = marched_by_cone(w, np.r_[o, d / size])
            tables = w.heights, w.tops, w.mips, w.places
            hit, where = caster.nearest_land.py_func(*tables, o, d / size, begin * size, 1e3, CONE, 1)
            assert (hit >= 0) == (expected >= 0)
            if hit >= 0:
                assert abs(hit - expected) < 1e-2 * max(1.0, w.places[where, 2])
                near.append(begin * size / hit)
    assert len(near) > 20
    assert max(near) <= 1.0
    assert np.median(near) > 0.7


def test_haze_hides_what_is_far_and_none_hides_nothing():
    camera = Camera(0, Fraction(32), Fraction(64), 9.0, 0.0, -12.0)
    seen = windows_of(made(Hills), camera, COVER, 0, cells=CELLS)
    bare, usual, thick = (
        exposed(seen, Shot(camera, (24, 16), 1, haze=haze), 16)[-4:, :, 1] for haze in (0.0, 1.0, 50.0)
    )
    assert bare.std() > usual.std() > 2 * thick.std()
    assert bare.mean() < usual.mean() < thick.mean()
    assert thick.mean() == pytest.approx(0.69, abs=0.05)
