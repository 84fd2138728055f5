"""Colour that ink implies: taken out and put back bit for bit, whatever lies there; and textures that changed."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive import implied, implied_kernels, opening
from engine.archive.grounds import with_tiles
from engine.archive.implied import needed, ordered, restored, without
from engine.archive.manifest import FINE_FORMAT
from engine.archive.opening import open_painting
from engine.archive.packing import pack, unpack
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.canvas.store import Pyramid, Record
from engine.numeric.address import Rect, TileKey
from engine.numeric.grid import FINE_STEP
from engine.numeric.pyramid import expand
from engine.painting.cascade import Cascade
from engine.painting.commands import parse
from engine.painting.rendering import folded_layers
from engine.session.apply import Painting, apply
from engine.texture.rock import Rock
from engine.texture.table import from_key


def painted(*strokes):
    painting = Painting(Rect(0, 0, 300, 300), 3)
    for points, level, brush in strokes:
        painting = apply(painting, parse({"do": "stroke", "points": points, "level": level, "brush": brush}))
    return next(layers(folded_layers(painting.root))).pyramid


def ink(texture, colour="#e0d0b0", amount=0.5, **parameters):
    return [{"texture": texture, "amount": amount, "colour": colour, **parameters}]


ROCK = {"radius": 60, "hardness": 0.4, "colour": "#405060", "ink": ink("rock", period=40)}
SCENES = {
    "rock": [([[-50, 80], [150, 120], [200, -30]], 0, ROCK)],
    "rock of many colours": [
        ([[50, 80], [150, 120]], 0, {**ROCK, "colour": colour, "opacity": opacity})
        for colour, opacity in (("#ff0000", 1.0), ("#00ff80", 0.7), ("#0000ff", 0.3))
    ],
    "four textures, two levels": [
        ([[20, 20], [150, 100]], 0, {**ROCK, "ink": ink("stripes", period=7, angle=30)}),
        ([[20, 100], [150, 20]], 0, {**ROCK, "ink": ink("squares", period=11) + ink("rock", "#ffffff")}),
        ([[90, 10], [90, 150]], 0, {**ROCK, "ink": ink("sawtooth", period=5), "opacity": 0.5}),
        ([[200, 200], [400, 300]], 2, ROCK),
        ([[10, 60], [40, 70]], -1, {**ROCK, "radius": 20, "ink": ink("rock", seed=5)}),
    ],
    "paint on finer levels of rock": [
        ([[20, 20], [150, 100]], 0, ROCK),
        ([[80, 80], [250, 170]], 1, {**ROCK, "ink": ink("rock", "#102030", period=9), "opacity": 0.8}),
        ([[160, 160], [500, 340]], 2, {**ROCK, "radius": 30, "colour": "#ffffff", "ink": []}),
        ([[160, 200], [500, 380]], 2, {**ROCK, "radius": 30, "ink": ink("stripes", period=9)}),
    ],
    "no ink": [([[50, 80], [150, 120]], 0, {"radius": 30, "colour": "#123456"})],
    "ink taken away": [([[50, 80], [150, 120]], 0, ROCK), ([[90, 90], [100, 100]], 0, {"radius": 90, "mode": "erase"})],
    "far away": [([[16_000_099.5, -15_999_000.0]], 0, ROCK)],
}


def coded(pyramid):
    tiles = ordered(list(pyramid.all_records()))
    return without(Cascade(pyramid, needed(tiles)), tiles)


def reopened(tiles, run=map, same=True):
    """The pyramid of what lies in a pack; `same`: whether every tile has the colour that it had."""
    found = unpack(pack(tiles), "a", lambda key: from_key(key, {}))
    levels = {}
    for key, record, _ in found:
        levels.setdefault(key.level, {})[key.x, key.y] = record
    pyramid = with_tiles(Pyramid(), levels)
    assert (restored(pyramid, found, run) == 0) == same
    return pyramid


def assert_same(a, b):
    left, right = dict(a.all_records()), dict(b.all_records())
    assert left.keys() == right.keys()
    for key, record in left.items():
        other = right[key]
        assert (record.rect, record.inks, record.data.dtype) == (other.rect, other.inks, other.data.dtype)
        assert np.array_equal(record.data, other.data), key
        assert not other.data.flags.writeable


@pytest.mark.parametrize("name", SCENES)
def test_every_residual_comes_back(name):
    pyramid = painted(*SCENES[name])
    tiles = coded(pyramid)
    assert_same(pyramid, reopened(tiles))
    assert (name == "no ink") == all(entry is None for _, _, entry in tiles)


@pytest.mark.parametrize("name", SCENES)
def test_tiles_of_many_inks_are_the_same_each_by_itself(name, monkeypatch):
    pyramid = painted(*SCENES[name])
    together = pack(coded(pyramid))
    monkeypatch.setattr(implied, "ABOVE_AT_ONCE", 0)
    assert pack(coded(pyramid)) == together


def test_little_is_left_of_rock():
    """Where one stroke covers all, its colour is amplitude times rock: nothing but roundings remains."""
    pyramid = painted(([[-200, 150], [500, 150]], 0, {**ROCK, "radius": 400, "hardness": 1.0}))
    left = {key: record for key, record, entry in coded(pyramid) if key.level == 0 and entry is not None}
    inner = left[TileKey(0, 1, 1)].data[:3]
    assert np.abs(pyramid.levels[0][1, 1].data[:3]).max() > 3000
    assert np.abs(inner).max() <= 1
    assert (inner == 0).mean() > 0.9


def test_sizes_of_packs():
    pyramid = painted(*SCENES["rock"])
    tiles = coded(pyramid)
    size = len(pack(tiles))
    assert size < 160_000  # in the second format 193,000, of 508,000 with nothing left out
    assert size < 0.6 * len(pack([(key, record, None) for key, record in pyramid.all_records()]))


@settings(deadline=None, max_examples=12)
@given(
    st.integers(0, 1 << 30),
    st.tuples(st.integers(0, 9), st.integers(0, 9), st.integers(1, 20), st.integers(1, 20)),
    st.sampled_from([np.int16, np.int32]),
    st.sampled_from([1, 300, 20000]),
    st.booleans(),
)
def test_any_residual_comes_back(seed, corners, dtype, spread, ramped):
    """Residuals that no stroke makes, on ink that lies above: taken out or not, they come back."""
    rng = np.random.default_rng(seed)
    rock = (Rock(0, 30.0, 0.5, 9),)
    above = rng.integers(-20000, 20001, (7, 128, 128)).astype(np.int16)
    above[3] = 32000
    here = rng.integers(-spread, spread + 1, (7, corners[3], corners[2]))
    if ramped:
        here[0] += np.arange(corners[2]) * 500
    own = np.clip(here, -32767, 32767).astype(dtype)
    levels = {
        -1: {(0, 0): Record(Rect(0, 0, 128, 128), above, rock, 0)},
        0: {(0, 0): Record(Rect.at(*corners), own, rock, 0), (3, 0): Record(Rect.at(*corners), own, rock, 0)},
    }
    for tiles in levels.values():
        for record in tiles.values():
            record.data.flags.writeable = False
    pyramid = with_tiles(Pyramid(), levels)
    assert_same(pyramid, reopened(coded(pyramid)))


def plain_implied(alpha, amplitudes, seen, factors):
    """What ink implies of a colour, in float64: lists over inks."""
    out = factors[0] * alpha
    for k, (a, s) in enumerate(zip(amplitudes, seen, strict=True)):
        out = out + factors[1 + 2 * k] * a + (a + factors[2 + 2 * k] * alpha) * s
    return out


def test_the_kernel_is_the_plain_form():
    rng = np.random.default_rng(4)
    unit = 2.0**-16
    parents = (rng.integers(0, 60000, (10, 9, 11)) * unit).astype(np.float32)
    data = rng.integers(-900, 901, (7, 11, 13)).astype(np.int16)  # rows from 1, columns from 1 of the 14 x 18 children
    data.flags.writeable = False
    around = rng.uniform(-1, 1, (2, 1, 14, 17)).astype(np.float32)
    start = np.array([2, 3], np.int64)
    seen = around[:, :, 2:13, 3:16]
    factors = rng.uniform(-0.4, 0.4, (3, 5)).astype(np.float32)
    place = np.array([0, 0, 1, 1], np.int64)
    sources, own = np.array([4, 7], np.int64), np.array([4, -1], np.int64)
    out = data.copy()
    detail = rng.uniform(-0.1, 0.1, (2, 1, 11, 13)).astype(np.float32)
    detail[1] = 0.0
    implied_kernels.exchange(
        data, parents, place, sources, own, around, start, detail, FINE_STEP, factors, np.int32(1), out
    )
    below = expand(parents)[:, 1:12, 1:14].astype(np.float64)
    for c in range(3):
        amplitudes = [below[4 + c] + data[4 + c] * unit, below[7 + c]]
        wanted = plain_implied(np.clip(below[3] + data[3] * unit, 0, 1), amplitudes, seen[:, 0], factors[c])
        texture = np.rint(amplitudes[0] * detail[0, 0] / unit) * unit
        expected = np.rint((wanted - below[c] - texture) / unit) + data[c]
        assert np.abs(out[c] - ((expected + 32768) % 65536 - 32768)).max() <= 1  # float32, which wraps in int16
    assert np.array_equal(out[3:], data[3:])


@pytest.mark.parametrize("stride", [1, 4])
def test_terms_that_made_a_colour_are_found(stride):
    """Colour made of known terms, on the expanded parents, gives those terms, from all pixels or some of them."""
    rng = np.random.default_rng(8)
    unit = 2.0**-16
    parents = (rng.integers(10000, 50000, (10, 9, 11)) * unit).astype(np.float32)
    data = rng.integers(-900, 901, (7, 11, 13)).astype(np.int16)
    around = rng.uniform(-1, 1, (2, 1, 14, 17)).astype(np.float32)
    detail = rng.uniform(-0.1, 0.1, (2, 1, 11, 13)).astype(np.float32)
    factors = rng.uniform(-0.05, 0.05, (3, 5)).astype(np.float32)
    place, start = np.array([0, 0, 1, 1], np.int64), np.array([2, 3], np.int64)
    sources, own = np.array([4, 7], np.int64), np.array([4, -1], np.int64)
    data[:3], parents[:3] = 0, 0.0  # what is implied is then the whole residual, but for texture
    wide = data.astype(np.int32)
    implied_kernels.exchange(
        data, parents, place, sources, own, around, start, detail, FINE_STEP, factors, np.int32(1), wide
    )
    wide.flags.writeable = False
    found = implied_kernels.fit(wide, parents, place, sources, own, around, start, detail, FINE_STEP, stride)
    assert np.abs(found - factors).max() < 2e-4


# ---- what changed ----


def test_another_colour_is_noticed():
    tiles = coded(painted(*SCENES["rock"]))
    at = next(i for i, (_, _, entry) in enumerate(tiles) if entry is not None)
    key, record, entry = tiles[at]
    tiles[at] = key, record, replace(entry, terms=(entry.terms[0] + (1 << 20), *entry.terms[1:]))
    found = reopened(tiles, same=False)
    assert not np.array_equal(dict(found.all_records())[key].data[:3], record.data[:3])


def test_terms_beyond_all_values_are_noticed():
    tiles = coded(painted(*SCENES["rock"]))
    at = next(i for i, (_, _, entry) in enumerate(tiles) if entry is not None)
    key, record, entry = tiles[at]
    tiles[at] = key, record, replace(entry, terms=tuple([implied.TERM_CAP] * len(entry.terms)))
    reopened(tiles, same=False)


def test_a_painting_opens_with_a_texture_that_changed(tmp_path, monkeypatch):
    painting = Painting(Rect(0, 0, 200, 150), 3)
    points, level, brush = SCENES["rock"][0]
    painting = apply(painting, parse({"do": "stroke", "points": points, "level": level, "brush": brush}))
    save(tmp_path / "a.ora", Snapshot(painting))
    before = open_painting(tmp_path / "a.ora")
    assert (before.native, before.notes) == (True, ())
    read = lambda opened: next(iter(layers(opened.painting.root))).pyramid  # noqa: E731
    area = Rect(0, 0, 200, 150)
    seen = evaluate(read(before), 0, area).rgba  # tiles are decoded when they are looked at
    made = Rock.appearance
    monkeypatch.setattr(Rock, "appearance", lambda self, level, rect: made(self, level, rect) * np.float32(1.001))
    found = open_painting(tmp_path / "a.ora")
    assert found.native
    assert re.fullmatch("the textures of this version are not quite .* of [0-9]+ tiles differs", found.notes[0])
    difference = evaluate(read(found), 0, area).rgba - seen
    assert 0 < np.abs(difference).max() < 0.01  # about as much as the texture did
    monkeypatch.setattr(opening, "TEXTURES", 2)
    assert open_painting(tmp_path / "a.ora").notes[0].endswith("differs (revision 1, now 2)")


def test_the_manifest_tells_the_revision(tmp_path):
    import zipfile

    save(tmp_path / "a.ora", Snapshot(Painting(Rect(0, 0, 20, 15), 3)))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        told = json.loads(file.read("inkfall/manifest.json"))
    assert (told["inkfall"], told["texture"]) == (FINE_FORMAT, implied.TEXTURES)
