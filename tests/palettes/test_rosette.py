"""The rosette: symmetry, fills, and a painting that contains itself, whose film never ends."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from engine.archive.export import Picture, export
from engine.files.images import read_image
from engine.numeric.address import Rect
from engine.painting import commands
from engine.painting.recording import read
from engine.session.replay import replay

GALLERY = Path(__file__).resolve().parents[2] / "palettes" / "gallery"
RECORDING = GALLERY / "rosette.jsonl"
PICTURES = GALLERY.parent / "pictures"


def test_it_is_drawn_with_symmetry_filled_and_contains_itself():
    found = read(RECORDING).commands
    assert sum(len(c.copies) for c in found if isinstance(c, commands.Stroke)) > 100
    assert sum(isinstance(c, commands.Fill) for c in found) > 60
    (again,) = (c for c in found if isinstance(c, commands.AddPlacement))
    assert again.placing.of is None
    assert RECORDING.stat().st_size <= 40_000


def test_the_script_writes_the_same_recording_again(tmp_path):
    """But for last bits of sines, which differ from machine to machine, where a place is rounded."""
    shutil.copy(GALLERY / "make_rosette.py", tmp_path)
    subprocess.run([sys.executable, tmp_path / "make_rosette.py"], env=os.environ, check=True)
    made, bundled = (file.read_text("utf-8").splitlines() for file in (tmp_path / RECORDING.name, RECORDING))
    assert len(made) == len(bundled)
    assert sum(a != b for a, b in zip(made, bundled, strict=True)) <= 3


@pytest.mark.nightly
def test_a_turn_deeper_it_is_the_same_and_the_picture_shows_it(tmp_path):
    painting = replay(read(RECORDING)).painting
    outer, inner = tmp_path / "outer.png", tmp_path / "inner.png"
    export(outer, Picture(painting))
    corner = (512 - 64) * 8
    export(inner, Picture(painting, 3, Rect.at(corner, corner, 1024, 1024)))
    seen = read_image(outer)[0]
    assert np.array_equal(seen, read_image(inner)[0])
    with Image.open(PICTURES / "rosette.png") as shown:
        half = np.asarray(shown.convert("RGB"))[:, :512].astype(float)
    small = np.asarray(Image.fromarray(seen).convert("RGB").resize((512, 512), Image.Resampling.LANCZOS)).astype(float)
    assert np.abs(half - small).mean() < 1.0
