"""A height map as ground: exact where it has pixels, as rough as it goes on below them, kept with the painting."""

import json

import numpy as np
import pytest
import tifffile
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording
from engine.painting.value import Painting, Refusal
from engine.session.replay import replay
from engine.session.session import Session
from engine.terrain.layer_heights import expanded
from engine.terrain.map_fitting import FittedMap, filled_in
from engine.terrain.plane import land

SIDE = 64
RECT = Rect.at(5, -7, SIDE, SIDE)


def hills(side=SIDE, seed=3):
    """Heights whose spectrum falls as that of ground, around a thousand."""
    f = np.fft.fftfreq(side)
    far = np.hypot(f[:, None], f[None, :])
    far[0, 0] = np.inf
    noise = np.fft.fft2(np.random.default_rng(seed).normal(size=(side, side))) / far**1.85
    return (np.fft.ifft2(noise).real * 3 + 1000).astype(np.float32)


def painting(path=None, heights=None):
    session = Session(Painting(Rect.at(0, 0, 128, 128), 1))
    session.do(c.AddLayer("Land"))
    session.do(c.SetLayer("Land", role="height"))
    if path is not None:
        tifffile.imwrite(path, hills() if heights is None else heights)
        session.do(c.DefineTexture("map", "image", Map({"path": str(path), "holds": "file"})))
    return session


def seen(session, level=0, rect=RECT):
    return land(session.painting, "Land").height(level, rect)


def told(heights, low=0.0, high=40.0):
    heights = heights.astype(np.float64)
    return (heights - heights.min()) * ((high - low) / (heights.max() - heights.min())) + low


@pytest.mark.parametrize("level", [0, 9, -3])
def test_its_pixels_lie_on_those_of_the_level_to_22_bits(tmp_path, level):
    session = painting(tmp_path / "a.tif")
    session.do(c.LayGround("map", RECT, level, ends=(0.0, 40.0)))
    found = seen(session, level) * 2.0**level
    assert np.abs(found - told(hills())).max() < 40 * 2**-22
    session.do(c.Undo())
    assert not seen(session, level).any()


def test_it_lies_under_what_is_painted_and_goes_on_as_rough_as_it_is(tmp_path):
    session = painting(tmp_path / "a.tif", hills(256))
    session.do(c.Stroke(0, (0, 0), np.array([[70.0, 70, 1, 0, 0, 0]]), Brush(radius=9, height=5.0)))
    before = seen(session, 0, Rect.at(0, 0, 256, 256))
    session.do(c.LayGround("map", Rect.at(0, 0, 256, 256), ends=(0.0, 80.0)))
    assert np.abs(seen(session, 0, Rect.at(0, 0, 256, 256)) - before - told(hills(256), 0, 80)).max() < 1e-4
    inner, strong = Rect.at(96, 96, 64, 64), []
    for level in range(-1, 4):
        rect = inner.zoomed(level)
        coarse = seen(session, level - 1, rect.zoomed(-1).grown(1))
        strong.append(float((seen(session, level, rect) - expanded(coarse)).std()))
    falls = np.array(strong[1:]) / strong[:-1]
    assert (falls > 0.35).all()
    assert (falls < 0.75).all()


def test_without_rock_nothing_is_added_below_its_pixels(tmp_path):
    session = painting(tmp_path / "a.tif")
    session.do(c.LayGround("map", RECT, rock=0.0))
    inner = RECT.grown(-8)
    coarse = seen(session, 0, inner.grown(1))
    assert np.abs(seen(session, 1, inner.zoomed(1)) - expanded(coarse)).max() < 1e-4


@pytest.mark.parametrize("rect", [Rect.at(0, 0, 256, 256), Rect.at(8, 16, 16, 16), Rect.at(-5, 3, 100, 75)])
def test_it_is_laid_as_fine_as_it_is_over_any_rectangle(rect):
    heights = hills().astype(np.float64)
    fitted = FittedMap(heights, 0, rect)
    level = fitted.own_level
    by = 2.0**level
    assert rect.width * by >= SIDE
    assert rect.height * by >= SIDE
    assert min(rect.width, rect.height) * by / 2 < SIDE
    if rect.width * by == SIDE:
        assert np.array_equal(fitted.at(level, fitted.rect_at(level)), heights)


@given(st.integers(-70, 70), st.integers(-70, 70), st.integers(2, 90), st.integers(2, 90), st.integers(-3, 3))
def test_a_part_of_it_is_the_same_whatever_is_asked_for_beside_it(x, y, width, height, level):
    fitted = FittedMap(hills(16).astype(np.float64), 0, Rect.at(x, y, width, height), 3.0)
    whole = fitted.rect_at(level)
    if whole.width < 2 or whole.height < 2:
        return
    part = Rect(whole.x0 + 1, whole.y0, whole.x1, whole.y0 + 1)
    for asked in (fitted.at, fitted.rough):
        assert np.array_equal(asked(level, part), asked(level, whole)[:1, 1:])


@settings(max_examples=25)
@given(st.integers(0, 1 << 30), st.integers(1, 24), st.integers(1, 24), st.floats(0, 0.95))
def test_holes_are_closed_between_what_is_around_them(seed, height, width, part):
    rng = np.random.default_rng(seed)
    heights = rng.normal(size=(height, width))
    holes = rng.random((height, width)) < part
    holes[rng.integers(height), rng.integers(width)] = False
    found = filled_in(np.where(holes, np.nan, heights))
    assert np.array_equal(found[~holes], heights[~holes])
    assert found.min() >= heights[~holes].min() - 1e-12
    assert found.max() <= heights[~holes].max() + 1e-12


def test_the_rim_grows_from_nothing(tmp_path):
    session = painting(tmp_path / "a.tif")
    session.do(c.LayGround("map", RECT, ends=(40.0, 41.0), rim=10.0))
    found = seen(session)
    assert found[0].max() < 1.0
    assert found[12:-12, 12:-12].min() > 39.9


def test_to_scale_where_the_file_tells_its_pixels(tmp_path):
    session = painting()
    keys = (1, 1, 0, 1, 1024, 0, 1, 1)
    tags = [(33550, "d", 3, (30.0, 30.0, 0.0), True), (34735, "H", len(keys), keys, True)]
    tifffile.imwrite(tmp_path / "a.tif", hills(), extratags=tags)
    session.do(c.DefineTexture("map", "image", Map({"path": str(tmp_path / "a.tif"), "holds": "file"})))
    session.do(c.LayGround("map", RECT))
    assert np.abs(seen(session) - hills() / 30.0).max() < 1e-4


def test_the_file_may_be_gone_when_it_is_opened_or_played_again(tmp_path):
    lines = [
        {"inkfall": 2, "frame": [0, 0, 128, 128]},
        {"do": "layer", "add": "Land"},
        {"do": "layer", "set": "Land", "role": "height"},
        {"do": "ground", "path": "a.tif", "rect": [0, 5, -7, SIDE, SIDE], "range": [0, 40]},
    ]
    tifffile.imwrite(tmp_path / "a.tif", hills())
    (tmp_path / "r.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    session = replay(recording.read(tmp_path / "r.jsonl"))
    found = seen(session)
    assert np.abs(found - told(hills())).max() < 1e-4
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    (tmp_path / "a.tif").unlink()
    opened = open_painting(tmp_path / "a.ora")
    assert np.array_equal(land(opened.painting, "Land").height(0, RECT), found)
    again = Session(Painting(opened.painting.frame, 0, arithmetic=opened.painting.arithmetic))
    again.pictures = {t.source.sha: t.source for t in opened.painting.textures.values() if t.source}
    for command in session.log:
        again.do(command)
    assert np.array_equal(seen(again, 3, RECT.zoomed(3)), seen(session, 3, RECT.zoomed(3)))


WRONG = {
    "no heights": (c.LayGround("map", RECT), "role height", lambda s: s.do(c.SetLayer("Land", role=""))),
    "no texture": (c.LayGround("gone", RECT), "holds a file", lambda s: None),
    "no file": (
        c.LayGround("rock", RECT),
        "holds a file",
        lambda s: s.do(c.DefineTexture("rock", "rock", Map())),
    ),
    "too deep": (c.LayGround("map", RECT, 2000), "found level 2000", lambda s: None),
    "too thin": (c.LayGround("map", Rect.at(0, 0, 1 << 30, 2)), "about its shape", lambda s: None),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_laid_is_told_in_a_line(tmp_path, name):
    command, message, first = WRONG[name]
    session = painting(tmp_path / "a.tif")
    first(session)
    with pytest.raises(Refusal, match=message):
        session.do(command)


@pytest.mark.parametrize(
    "members",
    [
        {"rect": [0, 0, 0, 1, 40]},
        {"rect": [0, 0, 0, 40, 40], "range": [0]},
        {"rect": [0, 0, 0, 40, 40], "rock": -1},
        {"rect": [0, 0, 0, 40, 40], "of": ["low", 1]},
    ],
)
def test_members_that_are_none_are_refused(members):
    with pytest.raises(ValueError, match=r"rect|range|rock|of"):
        c.parse({"do": "ground", "texture": "map", **members})
