"""The room: a floor tiled by wrap-around, light through a window, and on the wall the room itself."""

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
RECORDING = GALLERY / "room.jsonl"
PICTURES = GALLERY.parent / "pictures"


def test_its_floor_is_a_tile_laid_in_rows_and_it_hangs_on_its_own_wall():
    found = read(RECORDING).commands
    laid = [c for c in found if isinstance(c, commands.AddPlacement)]
    assert sum(c.placing.repeat is True for c in laid) > 4
    assert [c.name for c in laid if c.placing.of is None] == ["The room"]
    assert any(isinstance(c, commands.SetLayer) and isinstance(c.wrap, type(laid[-1].placing.part)) for c in found)
    assert sum(isinstance(c, commands.SetLayer) and c.mask is True for c in found) > 4
    assert sum(isinstance(c, commands.Fill) for c in found) > 100
    assert RECORDING.stat().st_size <= 120_000


def test_its_script_writes_the_same_recording_again(tmp_path):
    """But for last bits of sines, which differ from machine to machine, where a place is rounded."""
    shutil.copy(GALLERY / "make_room.py", tmp_path)
    subprocess.run([sys.executable, tmp_path / "make_room.py"], env=os.environ, check=True)
    made, bundled = (file.read_text("utf-8").splitlines() for file in (tmp_path / RECORDING.name, RECORDING))
    assert len(made) == len(bundled)
    assert sum(a != b for a, b in zip(made, bundled, strict=True)) <= 3


def test_the_last_frame_of_its_film_is_the_first():
    with Image.open(PICTURES / "room.webp") as film:
        first = np.asarray(film.convert("RGB")).astype(int)
        film.seek(film.n_frames - 1)
        last = np.asarray(film.convert("RGB")).astype(int)
    assert np.abs(first - last).mean() < 4.0  # the film is packed with loss


@pytest.mark.nightly
def test_on_its_wall_it_is_the_same_and_the_picture_shows_it(tmp_path):
    painting = replay(read(RECORDING)).painting
    outer, inner = tmp_path / "outer.png", tmp_path / "inner.png"
    export(outer, Picture(painting))
    export(inner, Picture(painting, 2, Rect.at(604 * 4, 150 * 4, 1024, 768)))
    seen = read_image(outer)[0]
    assert np.array_equal(seen, read_image(inner)[0])
    with Image.open(PICTURES / "room.png") as shown:
        size, picture = shown.size, np.asarray(shown.convert("RGB")).astype(float)
    small = Image.fromarray(seen).convert("RGB").resize(size, Image.Resampling.LANCZOS)
    assert np.abs(picture - np.asarray(small).astype(float)).mean() < 5.0
