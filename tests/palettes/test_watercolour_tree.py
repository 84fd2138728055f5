"""The watercolour tree: washes grown from examples and laid over one another, as in Ritter et al. 2006, figure 5."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main
from engine.painting import commands
from engine.painting.recording import read

GALLERY = Path(__file__).resolve().parents[2] / "palettes" / "gallery"
RECORDING = GALLERY / "watercolour-tree.jsonl"
PICTURE = GALLERY.parent / "pictures" / "watercolour-tree.png"


def test_it_is_painted_with_washes_alone():
    found = read(RECORDING).commands
    strokes = [c for c in found if isinstance(c, commands.Stroke)]
    assert [s.brush.mode for s in strokes].count("paint") == 1  # the paper
    assert {s.brush.mode for s in strokes[1:]} == {"example", "erase"}
    defined = [c for c in found if isinstance(c, commands.DefineTexture) and c.maker == "example"]
    assert len(defined) >= 8
    assert all(c.arguments["bundled"] == f"wash-{c.name}" for c in defined)
    assert RECORDING.stat().st_size <= 400_000


def test_washes_lie_over_one_another():
    """On one layer, at depths of their own."""
    layer, depths = "", defaultdict(set)
    for line in RECORDING.read_text("utf-8").splitlines():
        command = json.loads(line)
        layer = command.get("add") or command.get("select") or layer
        if command.get("brush", {}).get("mode") == "example":
            depths[layer].add(command["brush"]["depth"])
    assert depths["Leaves"] == {0, 1, 2}
    assert sum(map(len, depths.values())) >= 15


@pytest.mark.nightly
def test_the_script_writes_the_same_recording_again(tmp_path):
    """But for last bits of sines, which differ from machine to machine, where a place is rounded."""
    shutil.copy(GALLERY / "make_watercolour_tree.py", tmp_path)
    shutil.copytree(GALLERY / "orchard", tmp_path / "orchard", ignore=shutil.ignore_patterns("__pycache__"))
    command = [sys.executable, tmp_path / "make_watercolour_tree.py"]
    assert subprocess.run(command, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}, check=False).returncode == 0
    made, bundled = (file.read_text("utf-8").splitlines() for file in (tmp_path / RECORDING.name, RECORDING))
    assert len(made) == len(bundled)
    assert sum(a != b for a, b in zip(made, bundled, strict=True)) <= 3


def test_it_plays(tmp_path):
    """It becomes the picture, but for what synthesis chooses within a wash."""
    played = tmp_path / "tree.png"
    assert main(["play", str(RECORDING), "--png", str(played)]) == 0
    seen, shown = (
        np.asarray(Image.open(file).convert("RGB").resize((60, 45), Image.Resampling.BOX), float)
        for file in (played, PICTURE)
    )
    assert np.abs(seen - shown).mean() < 2.0
    assert np.abs(seen - shown).max() < 40.0
    assert shown[:, 0].min() > 225.0  # the margin is paper
    assert shown.min() < 90.0


def test_the_picture_is_small():
    assert PICTURE.stat().st_size <= 900_000
