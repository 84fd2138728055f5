"""Paintings made with spectral textures: saved, opened and replayed, they are the same at every depth."""

import numpy as np
import pytest
from PIL import Image

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.apply import Painting
from engine.session.session import Session


def stroke(level, *ink, **more):
    brush = {"radius": 40, "colour": "#705030", "hardness": 0.6, "ink": list(ink), **more}
    return {"do": "stroke", "level": level, "origin": [20, 30], "points": [[0, 0], [50, 20, 0.8]], "brush": brush}


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    folder = tmp_path_factory.mktemp("samples")
    pixels = np.random.default_rng(1).integers(0, 255, (40, 56, 3), np.uint8)
    Image.fromarray(pixels).save(folder / "leaf.png")
    Image.fromarray(pixels[..., 0]).save(folder / "grain.png")
    session = Session(Painting(Rect.at(0, 0, 120, 90), 11), TileCache(32 << 20), folder=folder)
    rock = {"texture": "rock", "amount": 0.4, "colour": "#ffffff", "period": 24}
    for command in (
        {"do": "texture", "name": "pebbles", "maker": "sparse", "path": "grain.png", "density": 6},
        {"do": "texture", "name": "leaves", "maker": "sparse", "path": "leaf.png", "spread": 0.7},
        {"do": "texture", "name": "cloth", "maker": "spectrum", "path": "grain.png", "phase": "zero"},
        stroke(0, rock, {"texture": "pebbles", "amount": 0.7, "colour": "#00ff00", "period": 30, "quantise": 3}),
        stroke(1, {"texture": "leaves", "amount": 0.5}, {"texture": "cloth", "amount": 0.3, "shaping": "negate"}),
    ):
        session.do(c.parse(command))
    return session


PLACES = [(-2, Rect.at(0, 0, 40, 30))] + [(k, Rect.at(30 << k, 38 << k, 100, 90)) for k in (0, 1, 3, 7, 40)]


def assert_same(one, other):
    for a, b in zip(layers.layers(one.root), layers.layers(other.root), strict=True):
        for level, rect in PLACES:
            p, q = evaluate(a.pyramid, level, rect), evaluate(b.pyramid, level, rect)
            assert p.inks == q.inks
            assert np.array_equal(p.data, q.data), level
            assert len(p.inks) >= 4
            assert np.ptp(p.data[0]) > 0.001 or level == 40


def test_saved_and_opened(session, tmp_path):
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    found = open_painting(tmp_path / "a.ora")
    assert found.native
    assert found.notes == ()
    assert_same(session.painting, found.painting)
    for name, texture in found.painting.textures.items():
        own = session.painting.textures[name]
        assert (texture.kind, texture.parameters) == (own.kind, own.parameters)
        assert np.array_equal(texture.source.data, own.source.data)


def test_replayed_bit_for_bit(session):
    again = Session(Painting(Rect.at(0, 0, 120, 90), 11), TileCache(32 << 20), folder=session.folder)
    for command in session.recording().commands:
        again.do(command)
    assert_same(session.painting, again.painting)


def test_detail_goes_on_in_the_painting(session):
    layer = next(iter(layers.layers(session.painting.root)))
    for level in (2, 5, 9, 14):
        data = evaluate(layer.pyramid, level, Rect.at(45 << level, 40 << level, 128, 128)).rgba[1]
        fine = data - data.reshape(32, 4, 32, 4).mean((1, 3)).repeat(4, 0).repeat(4, 1)
        assert fine.std() > 0.002
