"""A stroke that has ended goes at once, with its mask and all that it read: nothing waits for a look for garbage."""

import gc
import weakref

import numpy as np
import pytest

from engine.brush.settings import from_json
from engine.session.session import Session

POINTS = np.array([[10.0, 10, 1, 0, 0, 0], [90, 60, 1, 0, 0, 0.1]])
MODES = {
    "paint": {},
    "ink": {"ink": [{"texture": "rock", "period": 16}]},
    "erase": {"mode": "erase"},
    "smooth": {"mode": "smooth"},
    "multiply": {"mode": "raster", "op": "multiply"},
    "smear": {"mode": "raster", "op": {"name": "displace", "distance": 5}},
    "grain": {"grain": {"texture": "rock", "amount": 0.5, "period": 9}},
    "impasto": {"impasto": 2},
}


@pytest.fixture
def uncollected():
    gc.disable()
    yield
    gc.enable()


@pytest.mark.parametrize("mode", MODES)
def test_it_goes_at_once(mode, uncollected):
    session = Session()
    for members in ({}, MODES[mode]):
        live = session.begin(0, (0, 0), from_json({"radius": 9, "colour": "#204060", **members}))
        live.add(POINTS)
        live.preview(live.rect)
        session.finish(live)
        there = weakref.ref(live)
        del live
        assert there() is None
