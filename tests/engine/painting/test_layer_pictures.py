"""Small pictures of layers, and one layer seen alone."""

import numpy as np
import pytest
from stepped import stroke

from engine.canvas import layers
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio.results import Patch, Picture
from engine.studio.stack.small_frame import SIDE
from engine.studio.stack.stack_requests import ShowOnly, layer_picture
from engine.studio.studio import Studio


@pytest.fixture
def told():
    return []


@pytest.fixture
def studio(told):
    made = Studio(told.append, lambda request: None)
    made.do(q.New(Rect.at(0, 0, 200, 100)))
    yield made
    made.close()


def do(studio, *commands):
    for command in commands:
        studio.do(q.Do(command))
    while studio.step():
        pass


def pictures(told):
    """By layer the pictures that came; forgets what was told."""
    found = {one.ident: one.pixels for one in told if isinstance(one, Picture) and one.ident.startswith("layer ")}
    told.clear()
    return found


def is_painted(picture):
    assert (picture[..., 3] == 255).all()
    return len(np.unique(picture[..., :3].reshape(-1, 3), axis=0)) > 1


def test_each_layer_has_a_picture_and_a_stroke_makes_only_its_own_anew(studio, told):
    do(studio, c.AddLayer("One"), stroke(1, radius=20.0), c.AddLayer("Two"))
    found = pictures(told)
    assert set(found) == {layer_picture("One"), layer_picture("Two")}
    one = found[layer_picture("One")]
    assert one.shape == (25, 50, 4)  # of 200 x 100, two levels coarser: at most `SIDE`
    assert max(one.shape) <= SIDE
    assert is_painted(one)
    assert not is_painted(found[layer_picture("Two")])
    do(studio, stroke(2, radius=20.0))
    found = pictures(told)
    assert set(found) == {layer_picture("Two")}
    assert is_painted(found[layer_picture("Two")])
    do(studio, c.SetLayer("One", opacity=0.2, visible=False))
    assert pictures(told) == {}, "what is painted on it is the same"


def test_a_picture_shows_what_is_painted_though_it_is_hidden_masked_and_hardly_opaque(studio, told):
    do(studio, c.AddLayer("One"), stroke(1, radius=20.0))
    before = pictures(told)[layer_picture("One")]
    do(studio, c.SetLayer("One", visible=False, opacity=0.1), c.RenameLayer("One", "Two"))
    assert np.array_equal(pictures(told)[layer_picture("Two")], before)


def test_a_group_shows_what_lies_in_it_as_it_is_seen(studio, told):
    do(studio, c.AddLayer("G", kind="group"), c.AddLayer("In", group="G"), stroke(1, radius=30.0))
    assert is_painted(pictures(told)[layer_picture("G")])
    do(studio, c.SetLayer("In", visible=False))
    found = pictures(told)
    assert set(found) == {layer_picture("G")}
    assert not is_painted(found[layer_picture("G")])


def test_undo_brings_the_picture_back(studio, told):
    do(studio, c.AddLayer("One"))
    do(studio, stroke(1, radius=20.0))
    pictures(told)
    do(studio, c.Undo())
    assert not is_painted(pictures(told)[layer_picture("One")])


def seen(studio, told, level=0):
    """What the window is shown of a tile."""
    told.clear()
    studio.look(q.Look(((level, 0, 0, -1),)))
    while studio.step():
        pass
    return [one.pixels for one in told if isinstance(one, Patch)]


def test_one_layer_is_seen_alone_until_all_are_again_and_nothing_is_recorded(studio, told):
    do(studio, c.AddLayer("Below"), stroke(1, radius=30.0), c.AddLayer("Above"), stroke(4, radius=30.0))
    painting, log = studio.easel.session.painting, len(studio.easel.session.log)
    (both,) = seen(studio, told)
    studio.do(ShowOnly("Below"))
    (alone,) = seen(studio, told)
    assert not np.array_equal(alone, both)
    studio.do(ShowOnly("Above"))
    (other,) = seen(studio, told)
    assert not np.array_equal(alone, other)
    do(studio, stroke(7, radius=9.0))
    (painted,) = seen(studio, told)
    assert not np.array_equal(painted, other), "what is painted on it is seen"
    do(studio, c.Undo())
    studio.do(ShowOnly(None))
    (again,) = seen(studio, told)
    assert np.array_equal(again, both)
    assert studio.easel.session.painting.root is painting.root
    assert len(studio.easel.session.log) == log + 2
    assert layers.has(painting.root, "Below")


def test_a_layer_that_is_not_there_leaves_all_as_it_is(studio, told):
    do(studio, c.AddLayer("One"), stroke(1, radius=30.0))
    (before,) = seen(studio, told)
    studio.do(ShowOnly("gone"))
    (after,) = seen(studio, told)
    assert np.array_equal(before, after)
