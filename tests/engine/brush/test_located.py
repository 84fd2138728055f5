"""Textures that run along a stroke or lie in its dabs."""

import numpy as np
import pytest

from engine.brush.checks import BrushError
from engine.brush.copies import Copy
from engine.brush.located import Patches, located
from engine.brush.settings import from_json, to_json
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import version_of
from engine.session.session import Session

STRIPES = {"texture": "stripes", "amount": 1, "colour": "#ffffff", "period": 9, "angle": 90}
AREA = Rect(-10, -10, 140, 140)
BENT = [(20 + 3.1 * k, 60 + 22 * np.sin(k / 9)) for k in range(30)]


def brush(**members):
    told = {"radius": 14, "hardness": 0.9, "spacing": 0.15, "colour": "#000000", "dynamics": {}, "ink": [STRIPES]}
    return from_json(told | members)


def painted(brush, points, portion=1000, copies=()):
    session = Session()
    rows = np.array([[x, y, 1.0, 0, 0, 0] for x, y in points])
    live = session.begin(0, (0, 0), brush, copies=copies)
    for start in range(0, len(rows), portion):
        live.add(rows[start : start + portion])
    shown = live.preview(AREA).data.copy()
    session.finish(live)
    layer = next(iter(layers(session.painting.root)))
    found = evaluate(layer.pyramid, 0, AREA).data
    np.testing.assert_array_equal(found[:4], shown[:4])
    return found


def test_what_is_seen_at_places_is_the_texture_between_its_pixels():
    def fetch(rect):
        y, x = np.mgrid[rect.y0 : rect.y1, rect.x0 : rect.x1]
        return (x + 0.5 + 1000 * (y + 0.5))[None].astype(np.float32)

    places = np.random.default_rng(5).uniform(-150, 150, (2, 40, 30)).astype(np.float32)
    covered = np.ones((40, 30), np.float32)
    covered[7] = 0.0
    wanted = (places[0] + 1000 * places[1]) * covered
    np.testing.assert_allclose(located(places, covered, Patches(fetch))[0], wanted, atol=0.05)


def test_stripes_run_along_the_stroke():
    down = painted(brush(fixed="stroke"), [(60, 10), (60, 110)])[:3, 40:100]
    assert np.abs(np.diff(down[0][:, 60:80], axis=0)).max() < 0.02  # alike along the way
    assert np.ptp(down[0][30]) > 0.5  # light and dark across it
    lying = painted(brush(), [(60, 10), (60, 110)])[:3, 40:100]
    assert np.ptp(lying[0][:, 70]) > 0.5


def test_every_dab_has_the_same_piece():
    dots = painted(brush(fixed="dab", spacing=4, hardness=1), [(20, 20), (132, 20)])
    first, second = (dots[:, 16:44, x + 10 - 12 : x + 10 + 12] for x in (20, 76))
    np.testing.assert_array_equal(first, second)
    assert np.ptp(first[0][first[3] == 1]) > 0.5


@pytest.mark.parametrize("fixed", ["stroke", "dab"])
@pytest.mark.parametrize(
    "more",
    [
        {},
        {"density": {"texture": "rock", "period": 9}, "ink": []},
        {"shape": {"bristles": 9, "ratio": 0.5, "follow": "direction", "angle": 90}},
        {"shape": {"ratio": 0.4, "angle": 30}, "wet": {"amount": 0.5}},
        {"mode": "erase", "density": "rock"},
    ],
)
def test_a_stroke_is_the_same_in_whatever_portions_its_points_come(fixed, more):
    made = brush(fixed=fixed, **more)
    assert painted(made, BENT).tobytes() == painted(made, BENT, portion=1).tobytes()


def test_copies_turn_and_mirror_what_runs_along():
    mirrored = Copy(1.0, 0.0, 128.0, 0.0, True)
    both = painted(brush(fixed="stroke"), [(20, 30), (50, 60)], copies=(mirrored,))[:4, 10:138, 10:138]
    np.testing.assert_allclose(both, both[:, :, ::-1], atol=2e-3)


def test_only_rock_goes_on_below_the_level_of_the_stroke():
    assert len(painted(brush(fixed="stroke"), BENT)) == 4
    assert len(painted(brush(fixed="stroke", ink=[{"texture": "rock"}]), BENT)) == 7


def test_it_is_told_as_it_was_read_and_is_of_version_2():
    assert to_json(brush(fixed="dab"))["fixed"] == "dab"
    assert "fixed" not in to_json(brush())
    stroke = {"do": "stroke", "points": [[0, 0]]}
    assert version_of(parse({**stroke, "brush": {"fixed": "stroke"}})) == 2
    assert version_of(parse({**stroke, "brush": {"fixed": "canvas"}})) == 1
    with pytest.raises(BrushError, match=r'brush.fixed: found "paper", expected one of canvas, stroke, dab'):
        brush(fixed="paper")
