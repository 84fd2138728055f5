"""The still life: few points of a pen make very many regions of colour, as Lewis 1984 says of spectral brushes."""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.__main__ import main
from app.desk import presets
from engine.painting import commands
from engine.painting.recording import read

PALETTES = Path(__file__).resolve().parents[2] / "palettes"
RECORDING = PALETTES / "gallery" / "still-life.jsonl"
POINTS, PIXELS, REGIONS = 10_000, 250_000, 100_000  # at most, exactly, at least


@pytest.mark.nightly
def test_ten_thousand_points_make_a_hundred_thousand_regions(tmp_path, capsys):
    strokes = [c for c in read(RECORDING).commands if isinstance(c, commands.Stroke)]
    assert sum(len(stroke.points) for stroke in strokes) <= POINTS
    picture = str(tmp_path / "still-life.png")
    assert main(["play", str(RECORDING), "--png", picture]) == 0
    capsys.readouterr()
    assert main(["analyse", picture, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["pixels"] == PIXELS
    assert found["regions"] >= REGIONS


def test_it_is_made_with_spectral_textures_and_raster_operations():
    found = read(RECORDING).commands
    makers = [c.maker for c in found if isinstance(c, commands.DefineTexture)]
    assert makers.count("spectrum") == len(makers) >= 10
    brushes = [c.brush for c in found if isinstance(c, commands.Stroke)]
    assert {"paint", "raster"} <= {brush.mode for brush in brushes}
    assert RECORDING.stat().st_size <= 1 << 20


@pytest.mark.parametrize(("name", "count"), [("lake-morning", 2283), ("portrait", 1587)])
def test_what_was_painted_with_the_pen_has_its_strokes(name, count):
    strokes = [c for c in read(RECORDING.with_name(f"{name}.jsonl")).commands if isinstance(c, commands.Stroke)]
    assert len(strokes) == count
    assert {stroke.level for stroke in strokes} == {0, 2}  # from near, too
    assert all(stroke.points[:, 2].max() <= 1.0 and len(set(stroke.points[:, 2])) > 1 for stroke in strokes)
    assert sum(stroke.brush.wet is not None for stroke in strokes) > 150


def test_script_writes_the_same_recording_again(tmp_path):
    for name in ("gallery", "brushes"):
        left_out = shutil.ignore_patterns("*.jsonl", "__pycache__")
        shutil.copytree(PALETTES / name, tmp_path / name, ignore=left_out)
    script = tmp_path / "gallery" / "make_still_life.py"
    environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
    assert subprocess.run([sys.executable, script], env=environment, check=False).returncode == 0
    assert (tmp_path / "gallery" / RECORDING.name).read_bytes() == RECORDING.read_bytes()


def test_the_sheet_of_brushes_shows_what_is_painted():
    spec = importlib.util.spec_from_file_location("make_sheet", PALETTES / "pictures" / "make_sheet.py")
    assert spec is not None
    assert spec.loader is not None
    sheet = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sheet)
    found = {preset.name: preset for preset in presets.load_brushes(presets.bundled_folder())[0]}
    for name in ("Fur", "Rust", "Leaves"):  # one that paints, one that changes what is there, one that grows
        painting = sheet.painted(found[name].brush, found[name].textures)
        size = (sheet.WIDE, sheet.TALL)
        picture = np.asarray(sheet.seen(painting, 0, (size[0] / 2, size[1] / 2), size), np.float64)
        assert picture.shape == (sheet.TALL, sheet.WIDE, 3)
        assert picture.std() > 20
