"""What the panel of solids asks for, and the slice that faces the eye."""

from types import SimpleNamespace

import numpy as np
import pytest

from app.desk.solids.solid_state import OBJECTS, SolidState, turned_by
from app.desk.solids.solid_work import Carve
from engine.files.fault import FileError
from engine.solids import objects


def test_the_window_knows_the_objects_that_there_are():
    assert set(OBJECTS) == set(objects.OBJECTS)


def test_what_is_seen_faces_the_eye():
    for turn, normal in (((0.0, 0.0), (0, -1, 0)), ((0.0, 90.0), (0, 0, 1)), ((90.0, 0.0), (-1, 0, 0))):
        assert SolidState(turn=turn).normal() == normal
        assert (turned_by(*turn) @ np.array(normal)).round(9).tolist() == [0.0, 0.0, 1.0]
    rng = np.random.default_rng(1)
    for about, tilt in rng.uniform(-90.0, 90.0, (50, 2)):
        found = np.array(SolidState(turn=(about, tilt)).normal(), float)
        towards = turned_by(about, tilt) @ (found / np.sqrt(found @ found))
        assert towards[2] > np.cos(np.radians(20.0))


def test_only_what_is_set_otherwise_is_carved_again():
    state = SolidState(material="granite", name="cube")
    assert state.lacks == 48
    state.carved = Carve(state.made, state.name, 4, None).carry_out()
    assert state.carved.cube.shape == (4, 4, 4, 3)
    assert state.lacks == 96
    state.set("pink", 0.9)
    assert state.lacks == 48
    other = Carve(state.made, state.name, 4, state.carved).carry_out()
    assert other.corners is state.carved.corners
    assert other.fewer is state.carved.fewer
    assert not np.array_equal(other.cube, state.carved.cube)
    state.carved, state.name = other, "torus"
    assert Carve(state.made, state.name, 4, other).carry_out().cube is other.cube
    state.drag(400.0, 500.0)
    assert state.turn == (10.0, 100.0)


def test_a_mesh_of_ones_own_is_shown_and_what_is_none_leaves_the_object_that_was_there(tmp_path):
    path = tmp_path / "pyramid.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    desk = SimpleNamespace(solid=SolidState(material="granite", name="cube"), say=lambda text, bad: told.append(text))
    told, state = [], desk.solid
    state.carved = Carve(state.made, "cube", 4, None).carry_out()
    work = Carve(state.made, str(path), 4, state.carved)
    assert len(work.carry_out().faces) == 4
    state.name = str(tmp_path / "none.obj")
    broken = Carve(state.made, state.name, 4, state.carved)
    with pytest.raises(FileError, match=r"none\.obj"):
        broken.carry_out()
    broken.fail(desk, "none.obj: cannot be read")
    assert state.name == "cube"
    assert told == ["none.obj: cannot be read"]
