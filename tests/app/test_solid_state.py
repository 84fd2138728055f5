"""What the panel of solids asks for, and the slice that faces the eye."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from app.desk.solids import cube_work
from app.desk.solids.cube_work import ListCubes, bring_cube
from app.desk.solids.shown_solid import MAP_SCALE, turned_by
from app.desk.solids.solid_state import OBJECTS, SolidState
from app.desk.solids.solid_work import BEHIND, Carve, Rest, pictures_at_rest
from app.panels.solids.solid_panel import SolidPanel
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
    path = _pyramid(tmp_path)
    desk = SimpleNamespace(solid=SolidState(material="granite", name="cube"), say=lambda text, bad: told.append(text))
    told, state = [], desk.solid
    state.carved = Carve(state.made, "cube", 4, None).carry_out()
    work = Carve(state.made, path, 4, state.carved)
    assert len(work.carry_out().faces) == 4
    state.name = str(tmp_path / "none.obj")
    broken = Carve(state.made, state.name, 4, state.carved)
    with pytest.raises(FileError, match=r"none\.obj"):
        broken.carry_out()
    broken.fail(desk, "none.obj: cannot be read")
    assert state.name == "cube"
    assert told == ["none.obj: cannot be read"]


class _Desk:
    """A desk that carries out at once what is posted, while there is `patience`."""

    def __init__(self, state, patience=10_000):
        self.solid, self.strip, self.told, self.patience = state, "solid", [], patience
        self.known = SimpleNamespace(scene=None)

    def work(self, work):
        self.patience -= 1
        if self.patience >= 0:
            work.arrive(self, work.carry_out())

    def say(self, text, bad=False):
        self.told.append(text)


def _pyramid(folder):
    path = folder / "pyramid.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    return str(path)


def test_what_rests_is_drawn_where_the_card_draws_it_and_no_longer_than_it_rests(tmp_path):
    state = SolidState(material="granite", name=_pyramid(tmp_path), room=(40, 30))
    state.carved = replace(Carve(state.made, state.name, 4, None).carry_out(), whole=True)
    seen = state.seen
    desk = _Desk(state)
    desk.work(Rest(seen, pictures_at_rest(seen)))
    assert state.rest.of == state.seen
    back = np.rint(255.0 * np.array(BEHIND))
    inside = (state.rest.pixels != back).any(axis=2)
    turned = state.carved.corners[:, :3] @ turned_by(*state.turn).T
    away = 6.4 - turned[:, 2]
    lens = 15 / state.carved.nearness / away
    across, down = 20 + turned[:, 0] * lens, 15 - turned[:, 1] * lens
    rows, columns = np.nonzero(inside)
    assert (columns.min(), columns.max() + 1) == pytest.approx((across.min(), across.max()), abs=1.5)
    assert (rows.min(), rows.max() + 1) == pytest.approx((down.min(), down.max()), abs=1.5)
    state.drag(5.0, 0.0)
    assert state.rest.of != state.seen
    late = Rest(seen, pictures_at_rest(seen))
    late.arrive(_Desk(state, 0), (None, True))
    assert state.resting is None


def test_a_cube_is_brought_kept_and_shown(tmp_path, monkeypatch):
    monkeypatch.setattr(cube_work, "own_cubes", lambda: tmp_path / "kept")
    np.save(tmp_path / "a b.npy", np.random.default_rng(0).random((9, 9, 9, 3)))
    desk = _Desk(SolidState(name=_pyramid(tmp_path)))
    bring_cube(desk, tmp_path / "a b.npy")
    bring_cube(desk, tmp_path / "a b.npy")
    assert [path.rpartition("/")[2] for path in desk.solid.cubes] == ["a-b-2.png", "a-b.png"]
    assert desk.solid.material == desk.solid.cubes[0]
    assert desk.solid.growing is None
    desk.solid.carved = Carve(desk.solid.made, desk.solid.name, 48, None).carry_out()
    assert desk.solid.carved.cube.shape == (9, 9, 9, 3)
    assert desk.solid.lacks == 0


def test_a_picture_goes_around_the_object_at_the_scale_that_is_set(tmp_path):
    tiles = np.zeros((16, 16, 3), np.uint8)
    tiles[:, :8] = 200, 40, 90
    Image.fromarray(tiles).save(tmp_path / "stripes.png")
    state = SolidState(name="sphere", room=(24, 16), scale=0.7, painting=True)
    state.wrap(str(tmp_path / "stripes.png"))
    assert (state.wrapped, state.painting) == (True, False)
    state.carved = Carve(state.made, state.name, 24, None).carry_out()
    assert state.aspect.scale == MAP_SCALE
    equator = np.array([(np.cos(a), np.sin(a), 0.0) for a in np.linspace(0.0, 2.0 * np.pi, 4000, endpoint=False)])
    red = state.carved.solid.colours(MAP_SCALE * equator + 0.5, 1e-4)[:, 0]
    assert (np.diff(red > 0.4) != 0).sum() == 2 * round(2.0 * np.pi * 0.7)  # whole stripes: no seam
    for told in ({"scale": 1.4}, {"name": "torus"}):
        before = state.carved
        for name, value in told.items():
            setattr(state, name, value)
        assert state.lacks == 48
        state.carved = Carve(state.made, state.name, 24, before).carry_out()
        assert not np.array_equal(state.carved.cube, before.cube)
    state.material = "granite"
    assert not state.wrapped
    assert state.made[2] == ()


def test_the_panel_has_drawn_what_rests_each_time_that_it_was_turned(tmp_path, monkeypatch):
    monkeypatch.setattr(cube_work, "own_cubes", lambda: tmp_path / "kept")
    np.save(tmp_path / "c.npy", np.random.default_rng(0).random((8, 8, 8, 3)))
    state = SolidState(material=str(tmp_path / "c.npy"), name=_pyramid(tmp_path), room=(24, 16))
    desk, panel = _Desk(state), SolidPanel()
    for _ in range(3):
        for _ in range(2):  # carved, then drawn
            panel.wants(desk, 0.0)
        assert state.rest is not None
        assert state.rest.of == state.seen
        state.drag(5.0, 0.0)
    state.turning = True
    panel.wants(desk, 0.0)
    assert state.resting is None


def test_growing_is_stopped_and_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(cube_work, "own_cubes", lambda: tmp_path / "kept")
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (16, 16, 3), dtype=np.uint8)).save(tmp_path / "p.png")
    posted = []
    desk = _Desk(SolidState())
    desk.work = posted.append
    bring_cube(desk, tmp_path / "p.png")
    posted[0].arrive(desk, (None, True))
    assert posted == [posted[0], posted[0]]
    desk.solid.growing = None
    posted[0].arrive(desk, (None, True))
    assert len(posted) == 2
    assert not (tmp_path / "kept").exists()


def test_a_cube_that_is_gone_gives_way_to_the_solid_that_was_shown(tmp_path):
    desk = _Desk(SolidState(material=str(tmp_path / "none.png")))
    work = Carve(desk.solid.made, "cube", 48, None)
    with pytest.raises(FileError, match=r"none\.png"):
        work.carry_out()
    work.fail(desk, "none.png: cannot be read")
    assert desk.solid.material == "agate"
    assert ListCubes().carry_out() is not None
