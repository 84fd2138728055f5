"""Slices through a material: at right angles, seamless, and textures of a painting."""

from itertools import product

import numpy as np
import pytest
from immutables import Map

from engine.canvas import layers
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.makers.definitions import named_files, portable
from engine.makers.makers import define
from engine.painting.commands import DefineTexture
from engine.painting.textures import Around
from engine.solids.cube_files import read_cube, write_cube
from engine.solids.material_sliders import MATERIALS
from engine.solids.materials import COLOURS, Seen
from engine.solids.slicing import SLICE_SIDE, Slice, sides, slice_size, sliced
from engine.solids.solid_lookup import Procedural

NORMALS = [normal for normal in product(range(-2, 3), repeat=3) if any(normal)]


def test_rows_and_columns_stand_on_the_normal_and_on_one_another():
    for normal in NORMALS:
        across, down = sides(normal)
        assert np.dot(across, normal) == np.dot(down, normal) == np.dot(across, down) == 0
        width, height = slice_size(Slice(Procedural("wood"), normal, 0.0, 512))
        assert 4 <= min(width, height) <= max(width, height) <= SLICE_SIDE
        assert width / height == pytest.approx(np.linalg.norm(across) / np.linalg.norm(down), rel=0.02)


@pytest.mark.parametrize("material", MATERIALS)
def test_a_slice_shows_the_material_and_has_no_seam(material):
    cut = Slice(Procedural(material, 4), (1, 1, 0), 0.7, 24)
    colours = sliced(cut)
    assert colours.shape == (3, 24, 34)
    steps = np.abs(np.diff(colours, axis=2)).mean(axis=(0, 1))
    assert np.abs(colours[:, :, 0] - colours[:, :, -1]).mean() < 2.5 * steps.max()
    across, down = np.array(sides((1, 1, 0)))
    places = [(10 + x) / 34 * across + (7 + y) / 24 * down for x, y in product((0.25, 0.75), repeat=2)]
    there = COLOURS[material](Seen(0.35 * np.array([[1, 1, 0]]) + places, 4, 0.5 / 24), MATERIALS[material].values({}))
    assert colours[:, 7, 10] == pytest.approx(there.mean(axis=0), abs=1e-6)


def defined(**members):
    return define(DefineTexture("t", "solid", Map(members)), layers.EMPTY, Around())


def test_a_slice_is_a_texture_that_travels_with_a_brush():
    texture = defined(material="granite", normal=(1, 0, 2), unit=16, seed=5)
    assert texture.source is not None
    assert (texture.source.width, texture.source.height) == (16, 36)
    assert portable("t", texture.kind, texture.parameters).maker == "solid"
    other = defined(material="granite", normal=(1, 0, 2), unit=16, seed=6)
    assert other.source.sha != texture.source.sha
    assert defined(material="granite", normal=(1, 0, 2), unit=16, seed=5).source.sha == texture.source.sha


def test_a_slice_through_a_cube_is_the_cube_s_and_travels_with_its_picture(tmp_path):
    rng = np.random.default_rng(2)
    voxels = rng.random((8, 8, 8, 3)).astype(np.float32)
    write_cube(tmp_path / "c.png", voxels)
    np.save(tmp_path / "c.npy", read_cube(str(tmp_path / "c.png")))
    members = {"unit": 16, "normal": (0, 1, 0), "depth": 0.3}
    texture = defined(cube=str(tmp_path / "c.png"), **members)
    assert texture.source is not None
    assert texture.source.sha == defined(cube=str(tmp_path / "c.npy"), **members).source.sha
    own = portable("t", texture.kind, texture.parameters)
    assert own.maker == "solid"
    assert named_files(own) == (str(tmp_path / "c.png"),)
    assert portable("t", texture.kind, texture.parameters.set("cube", "c.png")) is None
    write_cube(tmp_path / "c.png", 1.0 - voxels)
    with pytest.raises(FileError, match="not those that were there"):
        defined(cube=str(tmp_path / "c.png"), sha=texture.source.sha, **members)
    with pytest.raises(FileError, match="found no cube there"):
        defined(cube=str(tmp_path / "none.png"))


WRONG = (
    {"cube": "a.png", "material": "wood"},
    {"cube": 3},
    {"material": "slate"},
    {"material": ["wood"]},
    {},
    {"material": "wood", "normal": (0, 0, 0)},
    {"material": "wood", "normal": (0, 0, 3)},
    {"material": "wood", "values": Map({"rings": 1})},
    {"material": "wood", "values": Map({"bands": 9})},
    {"material": "wood", "values": 3},
    {"material": "wood", "unit": 4096},
    {"material": "wood", "depth": 1e9},
)


@pytest.mark.parametrize("members", WRONG)
def test_what_is_wrong_is_refused_by_its_member(members):
    with pytest.raises(FieldError) as told:
        defined(**members)
    assert told.value.place in ("material", "cube", "normal", "values", "unit", "depth")
