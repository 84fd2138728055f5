"""The collage and the orange: cut from bundled examples, as in Ritter et al. 2006, figure 5."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main
from engine.painting import commands
from engine.painting.recording import read

GALLERY = Path(__file__).resolve().parents[2] / "palettes" / "gallery"
NAMES = ("collage", "orange")
MOSTLY_NIGHTLY = [pytest.param("collage", marks=pytest.mark.nightly), "orange"]


def strokes(name: str) -> list[commands.Stroke]:
    return [c for c in read(GALLERY / f"{name}.jsonl").commands if isinstance(c, commands.Stroke)]


@pytest.mark.parametrize("name", NAMES)
def test_pieces_are_grown_from_bundled_examples(name):
    made = read(GALLERY / f"{name}.jsonl").commands
    defined = {c.name: c.arguments for c in made if isinstance(c, commands.DefineTexture) and c.maker == "example"}
    assert all(arguments["bundled"] == key for key, arguments in defined.items())
    assert {s.brush.example for s in strokes(name) if s.brush.mode == "example"} == set(defined)
    assert len(defined) >= 4
    assert (GALLERY / f"{name}.jsonl").stat().st_size <= 400_000


def test_the_collage_shows_what_lies_below_tissue():
    grown = [s.brush.example for s in strokes("collage") if s.brush.mode == "example"]
    assert sum(name.endswith("tissue") for name in grown) >= 6
    assert len(set(grown)) >= 9


def test_the_orange_is_shaded_by_raster_operations():
    modes = [s.brush.mode for s in strokes("orange")]
    assert modes.count("raster") >= 40
    assert modes.count("example") >= 12


@pytest.mark.parametrize("name", MOSTLY_NIGHTLY)
def test_scripts_write_the_same_recordings_again(name, tmp_path):
    """But for last bits of sines, which differ from machine to machine, where a place is rounded."""
    shutil.copy(GALLERY / f"make_{name}.py", tmp_path)
    shutil.copytree(GALLERY / "cutting", tmp_path / "cutting", ignore=shutil.ignore_patterns("__pycache__"))
    command = [sys.executable, tmp_path / f"make_{name}.py"]
    assert subprocess.run(command, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}, check=False).returncode == 0
    files = (tmp_path / f"{name}.jsonl", GALLERY / f"{name}.jsonl")
    made, bundled = (file.read_text("utf-8").splitlines() for file in files)
    assert len(made) == len(bundled)
    assert sum(a != b for a, b in zip(made, bundled, strict=True)) <= 3


@pytest.mark.parametrize("name", MOSTLY_NIGHTLY)
def test_it_becomes_the_picture(name, tmp_path, capsys):
    """But for what synthesis chooses within a piece, and the few colours of the file."""
    shown = GALLERY.parent / "pictures" / f"{name}.png"
    assert shown.stat().st_size <= 900_000
    played = tmp_path / f"{name}.png"
    assert main(["play", str(GALLERY / f"{name}.jsonl"), "--png", str(played)]) == 0
    small = (np.asarray(Image.open(file).convert("RGB").reduce(20), float) for file in (played, shown))
    apart = np.abs(np.subtract(*small))
    assert apart.mean() < 3.0
    assert apart.max() < 60.0
