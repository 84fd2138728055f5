"""`inkfall ground`: a height map becomes a painting's land, and what it cannot do is told in one line."""

import numpy as np
import pytest
import tifffile
from command_line import refused

from app.__main__ import main
from engine.archive.opening import open_painting
from engine.numeric.address import Rect
from engine.terrain.plane import land

HEIGHTS = np.random.default_rng(6).normal(700, 90, (24, 40)).astype(np.float32)


def heights(path, rect):
    return land(open_painting(path).painting).height(0, rect)


def test_a_map_becomes_land_and_joins_what_is_there(tmp_path, capsys):
    tifffile.imwrite(tmp_path / "a.tif", HEIGHTS)
    out = tmp_path / "a.ora"
    assert main(["ground", str(tmp_path / "a.tif"), str(out), "--range", "-5,25"]) == 0
    assert "40 x 24 heights from" in capsys.readouterr().out
    low, high = HEIGHTS.min(), HEIGHTS.max()
    wanted = (HEIGHTS.astype(float) - low) * (30 / (high - low)) - 5
    assert np.abs(heights(out, Rect.at(0, 0, 40, 24)) - wanted).max() < 1e-4
    words = "--in", str(out), "--rect", "0,40,0,40,24", "--range", "-5,25"
    assert main(["ground", str(tmp_path / "a.tif"), str(tmp_path / "b.ora"), *words]) == 0
    both = heights(tmp_path / "b.ora", Rect.at(0, 0, 80, 24))
    assert np.abs(both - np.concatenate([wanted, wanted], axis=1)).max() < 1e-4


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--range", "3"), "--range: found '3'"),
        (("--range", "3,x"), "--range: found 'x'"),
        (("--rect", "0,0,0,1,5"), "rect"),
        (("--rock", "9"), "rock"),
    ],
)
def test_what_is_wrong_is_told(tmp_path, capsys, words, message):
    tifffile.imwrite(tmp_path / "a.tif", HEIGHTS)
    assert message in refused(capsys, "ground", str(tmp_path / "a.tif"), str(tmp_path / "a.ora"), *words)
    assert not (tmp_path / "a.ora").exists()


def test_a_file_that_is_no_map_is_told(tmp_path, capsys):
    (tmp_path / "a.tif").write_bytes(b"II*\0nothing")
    assert "a.tif" in refused(capsys, "ground", str(tmp_path / "a.tif"), str(tmp_path / "a.ora"))
    assert main(["ground", str(tmp_path / "none.exr"), str(tmp_path / "a.ora")]) == 2
    assert "none.exr" in capsys.readouterr().err
