"""`inkfall texture mask`: a mask and colours of what lies on a picture's ground, and one line for what is none."""

import json

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main

SIZE = (90, 120)  # height and width


@pytest.fixture
def leaf(tmp_path):
    """A green disc on white paper, and where it is."""
    y, x = np.mgrid[: SIZE[0], : SIZE[1]]
    inside = np.hypot(y - 45, x - 70) < 25
    colours = np.where(inside[..., None], (60, 120, 40), (240, 238, 230)).astype(np.uint8)
    Image.fromarray(colours).save(tmp_path / "leaf.png")
    return tmp_path / "leaf.png", inside


def masked(path, *words, code=0):
    out = path.parent / "m.png"
    assert main(["texture", "mask", str(path), "--out", str(out), *words]) == code
    return (np.asarray(Image.open(out)), np.asarray(Image.open(path.parent / "m.colours.png"))) if code == 0 else None


def test_a_mask_and_colours_are_written(leaf, capsys):
    path, inside = leaf
    mask, colours = masked(path)
    assert mask.shape == SIZE
    assert (mask[inside] > 127).mean() > 0.98
    assert not mask[~inside & (mask < 128)].any() or (mask[~inside] > 127).mean() < 0.01
    assert np.array_equal(colours[..., 3], mask)
    assert not colours[mask == 0].any()
    assert np.abs(colours[mask > 0][:, :3].astype(int) - (60, 120, 40)).max() < 40
    told = capsys.readouterr().out
    assert told.count("\n") == 1
    assert "m.png and" in told


def test_it_is_told_in_json(leaf, capsys):
    masked(leaf[0], "--json")
    told = json.loads(capsys.readouterr().out)
    assert told["size"] == [120, 90]
    assert told["bits"] == 8
    assert not told["whole"]
    (place,) = told["regions"]
    assert np.abs(np.subtract(place, (42, 17, 58, 58))).max() < 6
    assert abs(told["inside"] - leaf[1].mean()) < 0.03


def test_what_is_dropped_is_no_part_of_it(leaf):
    mask, _ = masked(leaf[0], "--drop", "70,45,75,45", "--keep", "5,5", "--radius", "4")
    assert mask[45, 70:75].max() == 0
    assert mask[5, 5] == 255


def test_sixteen_bits_and_no_ground(tmp_path, capsys):
    Image.fromarray(np.full((30, 40), 3000, np.uint16)).save(tmp_path / "grey.png")
    assert main(["texture", "mask", str(tmp_path / "grey.png"), "--out", str(tmp_path / "m.png")]) == 0
    assert "no ground" in capsys.readouterr().out
    assert (np.asarray(Image.open(tmp_path / "m.png")) == 65535).all()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--keep", "120,3"), "--keep: found 120,3, expected a pixel of the picture, 120 x 90"),
        (("--drop", "1,2,3"), "found '1,2,3', expected X,Y"),
        (("--drop", "a,b"), "found 'a,b', expected X,Y"),
        (("--radius", "0"), "found '0', expected pixels above 0"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(leaf, capsys, words, told):
    masked(leaf[0], *words, code=2)
    assert told in capsys.readouterr().err


def test_the_picture_itself_is_not_written_over(leaf, capsys):
    path, _ = leaf
    before = path.read_bytes()
    assert main(["texture", "mask", str(path), "--out", str(path)]) == 2
    assert "the picture itself" in capsys.readouterr().err
    assert path.read_bytes() == before
