"""Sparse convolution whose copies are turned at random, Lewis' faulting: recorded, in files, the same in every part."""

import json

import numpy as np
import pytest

from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import version_of
from engine.texture.bounding import bound
from engine.texture.image import ImageSource
from engine.texture.table import TextureError, from_key, instance

WHOLE = Rect.at(-37, 11, 90, 70)


def step(height=32, width=32):
    data = np.ones((4, height, width), np.float32)
    data[:3] = np.arange(width) >= width // 2
    return ImageSource.of("step", data)


def made(turn=None, source=None, **parameters):
    turn = {} if turn is None else {"turn": turn}
    return instance("sparse", {"density": 4, "seed": 5, **parameters, **turn}, 0, 0, source or step())


def directions(field):
    """How much stronger slopes are across than down."""
    down, across = np.gradient(field[0].astype(np.float64))
    return np.square(across).mean() / np.square(down).mean()


def test_copies_point_all_ways_round():
    rect = Rect.at(0, 0, 200, 200)
    straight, turned = (made(turn).appearance(0, rect) for turn in (0.0, 1.0))
    assert directions(straight) > 3
    assert 0.6 < directions(turned) < 1.6
    assert turned.std() == pytest.approx(straight.std(), rel=0.25)


def test_where_nothing_is_turned_the_key_is_the_old_one():
    assert made(0.0).key == made().key
    assert len(made(0.5).key) == len(made().key) + 1


@pytest.mark.parametrize("turn", [0.25, 1.0])
def test_a_key_tells_it_again(turn):
    one = made(turn, renew=False)
    again = from_key(json.loads(json.dumps(one.key)), {one.source.sha: one.source})
    assert again == one
    assert np.array_equal(again.appearance(0, WHOLE), one.appearance(0, WHOLE))


@pytest.mark.parametrize("source", [step(), step(24, 48)])
@pytest.mark.parametrize("level", [0, 1, 4])
def test_a_part_has_the_bits_of_the_whole(source, level):
    one = made(0.6, source, period=24)
    whole = one.appearance(level, WHOLE)
    for part in (Rect.at(-37, 11, 1, 1), Rect.at(-20, 30, 33, 41)):
        assert np.array_equal(one.appearance(level, part), whole[:, *part.slices(WHOLE)])


def test_its_bound_holds():
    one = made(1.0, renew=False)
    for level in (0, 3):
        assert np.abs(one.bandpass(level + 1, WHOLE)).max() <= bound(one, level).hard


def test_it_is_of_version_2_and_within_a_turn():
    brush = {"radius": 9, "colour": "#000000", "ink": [{"texture": "sand", "amount": 1, "turn": 0.5}]}
    strokes = [{"do": "stroke", "points": [[0, 0]], "brush": brush}]
    strokes.append({"do": "texture", "name": "sand", "maker": "sparse", "path": "a.png", "turn": 0.5})
    assert [version_of(parse(stroke)) for stroke in strokes] == [2, 2]
    with pytest.raises(TextureError, match="turn"):
        made(1.5)
