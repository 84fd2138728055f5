"""Files of the artist's own, cut and flipped at every byte: they are read without a fault, told if nothing can be made
of them, and stay as they are."""

import json

import numpy as np
import pytest
from immutables import Map
from PIL import Image

from app.desk import presets
from app.desk.examples import example_state
from app.desk.presets import Preset
from engine.brush.settings import Brush, Component
from engine.keeping.preferences import read_preferences
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.studio.requests import Swatch
from engine.studio.textures import swatch_files

INK = (Component("mine", 0.4, "#c04020", Map({"period": 20.0}), ((0.0, 1.0), (1.0, 0.0))),)
TEXTURE = parse({"do": "texture", "name": "mine", "maker": "sparse", "path": "/none.png", "spacing": 9})


def brush(folder):
    path = presets.save_brush(Preset("Größe", Brush(radius=30.0, ink=INK), textures=(TEXTURE,)), folder)
    return path, lambda: presets.load_brushes(folder)


def paper(folder):
    path = folder / "laid.json"
    told = {"name": "Laid", "grain": {"texture": "canvas", "amount": 0.5, "period": 12}, "textures": []}
    path.write_text(json.dumps(told))
    return path, lambda: presets.load_papers(folder)


def example(folder):
    rng = np.random.default_rng(2)
    Image.fromarray(rng.integers(0, 255, (12, 14, 3), np.uint8)).save(folder / "moss.png")
    Image.fromarray((rng.random((12, 14)) * 255).astype(np.uint8)).save(folder / "moss.mask.png")
    (folder / "moss.toml").write_text('title = "Moss"\ngroup = "Wood"\nkappa = 3.0\nfeather = 2\n')
    entry = example_state.load_examples(folder, True)[0][0]
    steps = {"mask_sha": entry.mask_sha, "base": True, "steps": [{"kind": "disc", "points": [[1, 2.5]]}]}
    (folder / "moss.region.json").write_text(json.dumps(steps))
    return folder, lambda: example_state.load_examples(folder, True)


def parameters(folder):
    return example(folder)[0] / "moss.toml", lambda: example_state.load_examples(folder, True)


def mask(folder):
    return example(folder)[0] / "moss.mask.png", lambda: example_state.load_examples(folder, True)


def region(folder):
    return example(folder)[0] / "moss.region.json", lambda: example_state.load_examples(folder, True)


def preferences(folder):
    path = folder / "preferences.toml"
    path.write_text("[kept]\nversions = 5\ngigabytes = 2.5\n")

    def read():
        found, faults = read_preferences(path)
        return [found], list(faults)

    return path, read


KINDS = {f.__name__: f for f in (brush, paper, parameters, mask, region, preferences)}


def damages(data, rng):
    for place in range(len(data)):
        bad = bytearray(data)
        bad[place] ^= 1 << int(rng.integers(8))
        yield bytes(bad)
        yield data[:place]


@pytest.mark.parametrize("name", KINDS)
def test_each_cut_and_flip_is_read_or_told_and_nothing_is_changed(name, tmp_path):
    path, read = KINDS[name](tmp_path)
    data = path.read_bytes()
    whole, faults = read()
    assert len(whole) == 1
    assert not faults
    others = {other: other.read_bytes() for other in tmp_path.iterdir() if other != path}
    told = 0
    for bad in damages(data, np.random.default_rng(1)):
        path.write_bytes(bad)
        found, faults = read()
        assert found or faults
        assert all(path.name in line or path.stem in line for line in faults)
        assert path.read_bytes() == bad
        told += bool(faults)
    assert {other: other.read_bytes() for other in tmp_path.iterdir() if other != path} == others
    assert told > len(data) / 4 or name == "region"  # of a region that is not to be read there is the mask


def test_a_brush_is_not_saved_over_a_damaged_one(tmp_path):
    path, read = brush(tmp_path)
    path.write_bytes(path.read_bytes()[:-9])
    kept = path.read_bytes()
    presets.save_brush(Preset("Größe", Brush(radius=3.0)), tmp_path)
    assert path.read_bytes() == kept
    assert [preset.brush.radius for preset in read()[0]] == [3.0]


def test_pictures_of_brushes_that_are_damaged_are_painted_anew(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    request, pixels = Swatch("a", Brush(radius=4.0), (5, 3), kept=True), np.full((3, 5, 4), 77, np.uint8)
    swatch_files.keep(request, Painting(), pixels)
    path = next(tmp_path.rglob("*.npy"))
    data = path.read_bytes()
    assert np.array_equal(swatch_files.kept(request, Painting()), pixels)
    for bad in damages(data, np.random.default_rng(1)):
        path.write_bytes(bad)
        found = swatch_files.kept(request, Painting())
        assert found is None or found.shape == pixels.shape
