"""Bookmarks that stand in the land, and films through them."""

import math

import numpy as np
import pytest

from engine.checks.field_error import FieldError
from engine.film.aim import aim_at
from engine.film.land_flight import cameras
from engine.film.shooting import Film, Shooting
from engine.numeric.address import Rect
from engine.painting.commands import parse, to_json
from engine.painting.outlook import Outlook
from engine.painting.value import Painting
from engine.session.apply import Around, apply

FRAME = Rect.at(0, 0, 96, 64)
FAR, NEAR = Outlook(0, 48.0, 90.0, 60.0, 350.0, -25.0), Outlook(20, 48 << 20, 40 << 20, 1 << 20, 20.0, -10.0)


def test_an_outlook_is_told_as_it_is_read():
    told = {"do": "bookmark", "name": "ridge", "level": 0, "origin": [0, 0], "size": [96, 64]}
    told |= {"eye": [40, 123456789012345678901234567890, -5, 3.5], "turn": 12.5, "tilt": -8, "fov": 40}
    read = parse(told)
    assert read.outlook == Outlook(40, 123456789012345678901234567890, -5, 3.5, 12.5, -8, 40)
    assert {name: value for name, value in to_json(read).items() if name in told} == told
    assert apply(Painting(FRAME, 1), read, Around()).bookmarks["ridge"].outlook == read.outlook


@pytest.mark.parametrize("eye", [[0, 1, 2], [0.5, 1, 2, 3], [4000, 0, 0, 1], [0, 0, 0, 0], [0, 0, 0, -2], "here"])
def test_an_eye_that_is_nowhere_is_refused(eye):
    with pytest.raises(FieldError, match="eye"):
        parse({"do": "bookmark", "name": "a", "eye": eye})


def test_a_flight_goes_nearer_in_proportion_and_turns_the_shorter_way():
    seen = list(cameras((FAR, NEAR), 21, lambda outlook: 5.0))
    assert (seen[0].x, float(seen[-1].x), float(seen[-1].y)) == (48, 48.0, 40.0)
    assert seen[0].height == pytest.approx(60)
    assert seen[-1].height == pytest.approx(1)
    away = [math.dist((float(one.x), float(one.y)), (48, 40)) for one in seen]
    heights = [one.height for one in seen]
    assert sorted(away, reverse=True) == away
    assert sorted(heights, reverse=True) == heights
    assert all((one.azimuth + 180) % 360 - 180 <= 20.01 for one in seen)
    steep = list(cameras((FAR, NEAR), 21, lambda outlook: 40.0 if 55 < float(outlook.place()[1]) < 75 else 0.0))
    assert min(one.height for one in steep) > 0.2


def test_a_film_through_the_land_shows_it():
    painting = Painting(FRAME, 3)
    for row in (
        {"do": "layer", "add": "Height"},
        {"do": "layer", "set": "Height", "role": "height", "scale": 40, "sea": 0},
        {"do": "stroke", "points": [[48, 30]], "brush": {"radius": 20, "colour": "#ffffff", "hardness": 0.2}},
    ):
        painting = apply(painting, parse(row), Around())
    size = 48, 32
    film = Film((aim_at(0, FRAME, size),), size, fps=2.0, seconds=1.0, outlooks=(FAR, FAR))
    frames = list(Shooting(film, painting).frames(1))
    assert len(frames) == 2
    assert frames[0].shape == (32, 48, 3)
    assert not frames[0].flags.writeable
    sky, hill = frames[0][0].mean(axis=0), frames[0][24].mean(axis=0)
    assert sky[2] > sky[0]
    assert np.abs(sky - hill).max() > 20
