"""What is bundled: the demo's recording is what its script writes, and every brush preset can paint."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.desk import presets as palette
from app.desk.holding.generator_brushes import generator_brushes
from app.desk.holding.written_brushes import written_brushes
from engine.brush import edits
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.makers.definitions import used
from engine.numeric.address import Rect
from engine.painting import commands
from engine.painting.recording import read
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.studio.requests import Swatch
from engine.studio.textures.swatches import painted

PALETTES = Path(__file__).resolve().parents[2] / "palettes"
DEMO = PALETTES / "demo"


def test_demo_reads_and_is_small():
    assert (DEMO / "demo.jsonl").stat().st_size <= 1_500_000
    strokes = [c for c in read(DEMO / "demo.jsonl").commands if isinstance(c, commands.Stroke)]
    assert min(s.level for s in strokes) < 0
    assert max(s.level for s in strokes) >= 12


def test_zoom_series_goes_ever_deeper():
    places = json.loads((DEMO / "demo.json").read_text("utf-8"))["zoom"]
    levels = [place[0] for place in places]
    assert levels == sorted(set(levels))
    assert levels[-1] >= 12
    assert all(len(place) == 5 and min(place[3:]) > 0 for place in places)


def test_script_writes_the_same_recording_again(tmp_path):
    """The script run where nothing of the bundled files is."""
    for file in [DEMO / "make_demo.py", *(DEMO / "scene").glob("*.py")]:
        copy = tmp_path / file.relative_to(DEMO)
        copy.parent.mkdir(exist_ok=True)
        copy.write_bytes(file.read_bytes())
    done = subprocess.run(
        [sys.executable, tmp_path / "make_demo.py"], env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}, check=False
    )
    assert done.returncode == 0
    for name in ("demo.jsonl", "demo.json"):
        assert (tmp_path / name).read_bytes() == (DEMO / name).read_bytes()


def test_presets_are_whole_and_can_paint():
    found, faults = palette.load_brushes(PALETTES / "brushes")
    assert not faults
    assert len(found) >= 16
    assert len({p.name for p in found}) == len(found)
    for preset in found:
        edits.check(preset.brush)


def test_no_two_brushes_have_one_name():
    bundled = palette.load_brushes(palette.bundled_folder())[0]
    names = [preset.name for preset in (*bundled, *generator_brushes(), *written_brushes())]
    assert len(names) == len(set(names)), sorted(name for name in names if names.count(name) > 1)


def test_every_preset_brings_all_it_needs_and_draws_itself():
    """On an empty painting, as the window's thumbnails are painted."""
    found, faults = palette.load_brushes(PALETTES / "brushes")
    assert not faults
    for preset in found:
        picture = painted(Swatch(preset.name, preset.brush, (104, 44), textures=preset.textures), Painting())
        assert picture[3].max() > 0.1, preset.name
        assert len(used(preset.brush, preset.textures)) == len(preset.textures), preset.name


def test_there_are_brushes_of_spectral_textures():
    makers = [{command.maker for command in p.textures} for p in palette.load_brushes(PALETTES / "brushes")[0]]
    assert sum(bool(found) and found <= {"spectrum", "sparse", "impulse"} for found in makers) >= 16


@pytest.mark.parametrize("name", ["Thaw", "Stony grass"])
def test_the_pen_chooses_between_two_matched_textures(name):
    """A hard touch paints the first example, whose layout both have, a light one the second: their colours, and how
    rough they are."""
    (preset,) = (found for found in palette.load_brushes(PALETTES / "brushes")[0] if found.name == name)
    (command,) = preset.textures
    assert (command.arguments["structure"], command.arguments["detail"]) == ("full", "learnt")
    painting = apply(Painting(Rect.at(0, 0, 200, 80)), command)

    def painted_at(pressure):
        points = np.array([[x, 40.0, pressure, 0.0, 0.0, x / 200] for x in (40.0, 160.0)])
        layer = next(iter(layers(apply(painting, commands.Stroke(0, (0, 0), points, preset.brush)).root)))
        return evaluate(layer.pyramid, 0, Rect.at(50, 28, 100, 24)).data[:3]

    light, middle, hard = (painted_at(pressure) for pressure in (0.1, 0.55, 1.0))
    for seen, member in ((hard, "path"), (light, "pattern")):
        example = np.asarray(Image.open(command.arguments[member]), np.float32).transpose(2, 0, 1) / 255
        assert np.abs(seen.mean((1, 2)) - example.mean((1, 2))).max() < 0.08
        assert seen.std() == pytest.approx(example.std(), rel=0.3)
    ends = [picture.mean((1, 2)) for picture in (light, hard)]
    along = (middle.mean((1, 2)) - ends[0]) @ (ends[1] - ends[0]) / np.square(ends[1] - ends[0]).sum()
    assert 0.3 < along < 0.7


def test_script_cuts_the_same_examples_again(tmp_path):
    for folder in ("examples", "brushes/examples"):
        (tmp_path / folder).mkdir(parents=True)
    own = PALETTES / "brushes" / "examples"
    names = sorted(file.name for file in own.glob("*.png"))
    assert names == ["gravel.png", "snow.png", "turf.png"]
    for file in [*(PALETTES / "examples").glob("*.png"), own / "make_examples.py"]:
        (tmp_path / file.relative_to(PALETTES)).write_bytes(file.read_bytes())
    script = tmp_path / "brushes" / "examples" / "make_examples.py"
    assert subprocess.run([sys.executable, script], check=False).returncode == 0
    for name in names:
        made, bundled = (np.asarray(Image.open(folder / name)) for folder in (script.parent, own))
        assert np.array_equal(made, bundled)


def test_brushes_that_grow_examples_show_more_than_their_rims_in_their_thumbnails():
    found = [preset for preset in palette.load_brushes(PALETTES / "brushes")[0] if preset.group == "Examples"]
    assert len(found) >= 8
    assert all(preset.brush.mode == "example" for preset in found)
    (brick,) = (preset for preset in found if preset.name == "Brick in plaster")
    picture = painted(Swatch("brick", brick.brush, (104, 44), textures=brick.textures), Painting())
    inside = picture[3] > 0.9
    red, _, blue, _ = picture[:, inside]
    assert inside.mean() > 0.2
    assert (red > 1.3 * blue).mean() > 0.5
