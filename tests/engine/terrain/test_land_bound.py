"""Land is nowhere farther from its heights than it promises: as far as ten levels say, with paint at several depths."""

import numpy as np
import pytest

from engine.canvas import layers
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.session.apply import Around, apply
from engine.terrain.layer_heights import expanded
from engine.terrain.plane import land

FRAME = Rect.at(0, 0, 192, 128)
PLACE = 71, 60
DEEPER = 4
RIDGED = [[0, 0], [0.5, 1], [1, 0]]


def ink(**about):
    return {"texture": "rock", "amount": 1, "period": 96, "roughness": 0.86, "renew": False, **about}


def painted(*strokes):
    painting = Painting(FRAME, 7)
    for level, radius, brush in strokes:
        x, y = (v << level for v in PLACE)
        told = {"level": level, "origin": [x, y], "points": [[0, 0], [radius, radius // 2]]}
        brush = {"radius": radius, "colour": "#404040", "hardness": 0.6, **brush}
        painting = apply(painting, parse({"do": "stroke", **told, "brush": brush}), Around())
    return painting


PAINTINGS = {
    "mountain": painted((0, 60, {"ink": [ink(colour="#ffffff")]})),
    "stones": painted(
        (0, 60, {"ink": [ink(colour="#ffffff")]}),
        (2, 30, {"ink": [ink(period=20, roughness=0.5, colour="#a0c080")], "opacity": 0.7}),
        (7, 40, {"colour": "#f0e0d0"}),
    ),
    "ridge": painted((0, 60, {"ink": [ink(shaping=RIDGED, colour="#ffffff")]})),
    "bands": painted((0, 50, {"ink": [ink(colour="#c0c0c0"), ink(texture="squares", angle=30, period=20)]})),
    "bare": painted((0, 40, {"opacity": 0.5}), (5, 20, {"mode": "erase"})),
}


@pytest.mark.parametrize("name", PAINTINGS)
def test_land_keeps_its_promise_at_ten_levels(name):
    seen = land(PAINTINGS[name], "Layer 1", scale=100.0)
    for level in (0, 1, 2, 3, 4, 6, 7, 9, 12, 16):
        rect = Rect.at((PLACE[0] << level) - 3, (PLACE[1] << level) + 2, 18, 15)
        promised = seen.bound(level, rect)
        assert promised is not None
        far = seen.height(level, rect.grown(3))
        for _ in range(DEEPER):
            far = expanded(far)
        fine = rect.zoomed(DEEPER)
        edge = (far.shape[0] - fine.height) // 2
        far = far[edge : edge + fine.height, edge : edge + fine.width]
        left = seen.height(level + DEEPER, fine) - far
        assert np.abs(left).max() <= promised.hard
        assert np.sqrt((left * left).mean()) <= 1.5 * promised.rms  # that of a small place
        assert promised.rms <= promised.hard
    assert seen.bound(40, Rect.at(PLACE[0] << 40, PLACE[1] << 40, 8, 8)) is not None


def test_it_is_of_use():
    """Rock that lasts: no ten times more than there is, and half for each level as its roughness says."""
    seen = land(PAINTINGS["mountain"], "Layer 1", scale=100.0)
    bounds = [seen.bound(level, Rect.at(PLACE[0] << level, PLACE[1] << level, 24, 24)).hard for level in (6, 8, 10)]
    assert bounds[0] / bounds[1] == pytest.approx(2 ** (2 * 0.86), rel=0.1)
    assert bounds[1] / bounds[2] == pytest.approx(2 ** (2 * 0.86), rel=0.1)
    rect = Rect.at(PLACE[0] << 8, PLACE[1] << 8, 24, 24)
    step = np.abs(np.diff(seen.height(12, rect.zoomed(4))[::16, ::16])).max()
    assert bounds[1] < 10 * step


def test_where_nothing_is_known_nothing_is_promised():
    renewed = painted((0, 60, {"ink": [ink(renew=True)]}))
    near, away = Rect.at(60, 50, 8, 8), Rect.at(-900, -900, 8, 8)
    assert land(renewed, "Layer 1").bound(0, near) is None
    assert land(renewed, "Layer 1").bound(0, away).hard < 1e-9
    two = apply(PAINTINGS["mountain"], parse({"do": "layer", "add": "over"}), Around())
    assert land(two).bound(0, near) == land(two, "Layer 1").bound(0, near)
    told = {"points": [[60, 50], [80, 60]], "layer": "over", "brush": {"radius": 30, "colour": "#404040"}}
    two = apply(two, parse({"do": "stroke", **told}), Around())
    assert land(two).bound(0, near) is None
    assert land(two).bound(0, away) == (0.0, 0.0)
    multiplied = apply(two, parse({"do": "layer", "set": "over", "blend": "multiply"}), Around())
    assert land(multiplied, "composite").bound(0, away) is None
    assert layers.find(multiplied.root, "over").blend == "multiply"
