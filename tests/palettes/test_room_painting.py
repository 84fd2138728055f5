"""The room: a floor tiled by wrap-around, light through a window, and on the wall the room itself."""

import io
import json
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
from engine.film.aim import aim_of
from engine.film.shooting import Film, Shooting
from engine.numeric.address import Rect
from engine.painting import commands
from engine.painting.grown import settled
from engine.painting.guiding.guides import Guide
from engine.painting.recording import read, read_from
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
    assert [c.kind for c in found if isinstance(c, Guide)] == ["perspective-1"]
    assert sum(isinstance(c, commands.Fill) for c in found) > 100
    assert RECORDING.stat().st_size <= 120_000


def test_its_script_writes_the_same_recording_again(tmp_path):
    """But for last bits of sines, which differ from machine to machine, where a place is rounded."""
    shutil.copy(GALLERY / "make_room.py", tmp_path)
    shutil.copytree(GALLERY / "interior", tmp_path / "interior")
    subprocess.run([sys.executable, tmp_path / "make_room.py"], env=os.environ, check=True)
    made, bundled = (file.read_text("utf-8").splitlines() for file in (tmp_path / RECORDING.name, RECORDING))
    assert len(made) == len(bundled)
    assert sum(a != b for a, b in zip(made, bundled, strict=True)) <= 3


def ends(painting, size):
    """The first, the last and the second frame of the film from the room into its picture, before they are packed."""
    out, into = (painting.bookmarks[name] for name in ("out", "in"))
    frames = list(Shooting(Film((aim_of(out, size), aim_of(into, size)), size, 4.0, 1.0), settled(painting)).frames(2))
    return frames[0], frames[-1], frames[1]


def assert_closed(painting, size):
    first, last, second = ends(painting, size)
    assert np.array_equal(first, last)
    assert not np.array_equal(first, second)


def test_a_film_into_its_picture_ends_with_the_frame_it_began_with():
    """With but its strokes without ink, which are painted in no time."""
    told = [json.loads(line) for line in RECORDING.read_text("utf-8").splitlines()]
    plain = [one for one in told if one.get("do") == "stroke" and "ink" not in one["brush"]]
    few = [told[0], *plain, *told[-3:]]
    del few[-3]["to"]
    lines = "\n".join(map(json.dumps, few)).encode()
    assert_closed(replay(read_from(io.BytesIO(lines), "few")).painting, (160, 120))


def test_the_film_in_the_readme_ends_as_it_began():
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
    assert_closed(painting, (480, 360))
    with Image.open(PICTURES / "room.png") as shown:
        size, picture = shown.size, np.asarray(shown.convert("RGB")).astype(float)
    small = Image.fromarray(seen).convert("RGB").resize(size, Image.Resampling.LANCZOS)
    assert np.abs(picture - np.asarray(small).astype(float)).mean() < 5.0
