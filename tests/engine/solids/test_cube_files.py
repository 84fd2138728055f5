"""Cubes as files: pictures of their slices, folders of these, and cubes that grow from a picture."""

import numpy as np
import pytest
from PIL import Image

from engine.files.fault import FileError
from engine.solids.cube_files import is_column, read_cube, write_cube
from engine.solids.cube_growing import as_fine_as_voxels, drawn_cube, growing_cube

VOXELS = np.random.default_rng(1).integers(0, 256, (8, 8, 8, 3)).astype(np.uint8)
COLOURS = VOXELS.astype(np.float32) / np.float32(255.0)


def test_a_cube_comes_back_from_a_picture_and_from_a_folder_of_slices(tmp_path):
    write_cube(tmp_path / "c.png", COLOURS)
    assert is_column(str(tmp_path / "c.png"))
    assert np.array_equal(read_cube(str(tmp_path / "c.png")), COLOURS)
    folder = tmp_path / "slices"
    folder.mkdir()
    for z, pixels in enumerate(VOXELS):
        Image.fromarray(pixels).save(folder / f"slice-{z:04}.png")
    assert np.array_equal(read_cube(str(folder)), COLOURS)
    Image.fromarray(VOXELS[0, :4]).save(folder / "slice-0003.png")
    with pytest.raises(FileError, match=r"slice-0003\.png: found another size, expected 8 x 8"):
        read_cube(str(folder))


def test_what_is_no_cube_is_refused_and_nothing_is_written(tmp_path):
    Image.fromarray(VOXELS[0]).save(tmp_path / "flat.png")
    assert not is_column(str(tmp_path / "flat.png"))
    with pytest.raises(FileError, match="found one picture, expected"):
        read_cube(str(tmp_path / "flat.png"))
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileError, match="found 0 slices"):
        read_cube(str(tmp_path / "empty"))
    for wrong in (COLOURS[:4], COLOURS[:4, :4, :4]):
        with pytest.raises(FileError, match="expected as many each way, 8 to 256"):
            write_cube(tmp_path / "c.png", wrong)
    assert not (tmp_path / "c.png").exists()


def test_a_cube_grows_step_by_step_and_has_the_example_s_colours():
    example = np.random.default_rng(0).random((3, 24, 24)).astype(np.float32)
    example[2] *= 0.25
    steps = list(growing_cube(example, 3, side=8))
    assert [step.done for step in steps] == sorted(step.done for step in steps)
    assert all(step.cube is None for step in steps[:-1])
    cube = steps[-1].cube
    assert cube.shape == (8, 8, 8, 3)
    assert cube.mean(axis=(0, 1, 2)) == pytest.approx(example.mean(axis=(1, 2)), abs=0.05)


def test_a_large_picture_is_made_as_small_as_a_cube_can_show():
    for size, small in (((3, 40, 33), (3, 20, 16)), ((1, 300, 64), (1, 75, 16)), ((3, 31, 90), (3, 31, 90))):
        assert as_fine_as_voxels(np.full(size, 0.25, np.float32), 8).shape == small


def test_a_cube_is_drawn_out_of_a_picture_under_a_signal_along_it():
    example = np.random.default_rng(1).uniform(0.2, 1.0, (3, 24, 24)).astype(np.float32)
    *before, last = drawn_cube(example, 3, side=16)
    assert [step.cube for step in before] == [None] * len(before)
    cube = last.cube
    light = cube[:, 5, 7, 0] / cube[0, 5, 7, 0]
    assert np.ptp(light) > 0.1, "layers are seen"
    assert cube == pytest.approx(cube[:1] * light[:, None, None, None], abs=1e-5), "every slice is the picture"
    across = cube.max(axis=0)
    assert across.mean(axis=(0, 1)) == pytest.approx(example.mean(axis=(1, 2)), abs=0.1)
    assert np.abs(np.diff(across, axis=1, append=across[:, :1])).mean(axis=(0, 2))[-1] < 0.6, "it tiles"
