"""A painting with all that can be painted with examples, and its file, for the tests of files."""

import io
import json
import zipfile
from dataclasses import replace

import numpy as np
import platformdirs
import pytest
from PIL import Image

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.files.limits import LIMITS
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.session.apply import Painting
from engine.session.session import Session

FRAME = Rect.at(-20, -10, 220, 150)
LEVELS = (-3, -1, 0, 1, 2)
MANIFEST = "inkfall/manifest.json"
DEEP = 7 << 90


def stroke(points, level=0, layer=None, origin=(0, 0), **brush):
    brush = {"radius": 14, "hardness": 1, **brush}
    told = {"do": "stroke", "level": level, "origin": list(origin), "points": points, "brush": brush}
    return told if layer is None else {**told, "layer": layer}


def grow(points, name, **more):
    level, layer, origin = more.pop("level", 0), more.pop("layer", None), more.pop("origin", (0, 0))
    return stroke(points, level, layer, origin, mode="example", example=name, **more)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Pictures of stripes and of spots, with a region; analyses go to a folder of the tests' own."""
    folder = tmp_path_factory.mktemp("pictures")
    y, x = np.mgrid[0:26, 0:30]
    stripes = np.stack([128 + 90 * np.sin(x), 90 + 60 * np.cos(y / 2), x * 8, 0 * x + 255], axis=-1).astype(np.uint8)
    Image.fromarray(stripes).save(folder / "stripes.png")
    spots = np.stack([y * 9, 0 * x + 60, 40 + 200 * ((x // 4 + y // 4) % 2), 255 - x * 4], axis=-1).astype(np.uint8)
    Image.fromarray(spots).save(folder / "spots.png")
    Image.fromarray(((np.hypot(x - 15, y - 13) < 11) * 255).astype(np.uint8)).save(folder / "mask.png")
    before = platformdirs.user_cache_path
    platformdirs.user_cache_path = lambda name: folder / "cache" / name
    yield folder
    platformdirs.user_cache_path = before


DEFINED = (
    {"do": "texture", "name": "stripes", "maker": "example", "path": "stripes.png", "kappa": 1},
    {"do": "texture", "name": "spots", "maker": "example", "path": "spots.png", "mask": "mask.png", "feather": 1},
)


def begun(folder):
    session = Session(Painting(FRAME, 11), TileCache(16 << 20), folder=folder)
    for command in DEFINED:
        session.do(c.parse(command))
    return session


@pytest.fixture(scope="module")
def session(folder):
    """A painting with all that can be painted with examples, paint below and above, and an example nobody uses."""
    session = begun(folder)
    for command in (
        {"do": "texture", "name": "idle", "maker": "example", "path": "spots.png", "e_max": 3.5},
        stroke([[0, 0], [150, 90]], colour="#3060c0"),
        grow([[10, 20], [130, 40]], "stripes", example_detail=1),
        grow([[60, 10], [60, 100]], "spots", radius=20),
        grow([[100, 60], [40, 90]], "stripes", depth=1.5, radius=9),
        grow([[140, 100]], "spots", level=1, depth=-2, radius=25, example_level=0),
        grow([[60, 60], [70, 40]], "stripes", level=1, depth=3, radius=12),
        stroke([[58, 50], [64, 55]], mode="erase", radius=5),
        stroke([[90, 40]], mode="erase", depth=1.5, radius=8),
        {"do": "layer", "add": "Group", "kind": "group", "group": None},
        {"do": "layer", "add": "inside", "group": "Group"},
        grow([[20, 110], [180, 120]], "stripes", depth=0, radius=17),
        {"do": "layer", "set": "Group", "opacity": 0.7},
        {"do": "layer", "duplicate": "inside", "to": "twin"},
        stroke([[150, 118]], colour="#ffffff", radius=5),  # flattens the twin's
        {"do": "layer", "add": "deep", "group": None},
        grow([[0, 0], [30, 12]], "spots", level=80, origin=(DEEP, -DEEP), radius=11),
        {"do": "texture", "name": "spots", "maker": "rock"},  # what is painted with stays as it is
    ):
        session.do(c.parse(command))
    return session


@pytest.fixture(scope="module")
def saved(session, tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "a.ora"
    save(path, Snapshot(session.painting, session.recording()))
    return path


@pytest.fixture(scope="module")
def members(saved):
    with zipfile.ZipFile(saved) as file:
        assert file.testzip() is None
        return {name: file.read(name) for name in file.namelist()}


def places(painting):
    for level in LEVELS:
        frame = painting.frame.zoomed(level)
        yield level, Rect.at(frame.x0, frame.y0, min(frame.width, 300), min(frame.height, 300))
    yield 80, Rect.at(DEEP - 20, -DEEP - 20, 80, 60)
    yield 79, Rect.at(DEEP - 20 >> 1, -DEEP - 20 >> 1, 50, 50)


def alike(one, other):
    """Whether two plots take the same pixels of the same example, by all that is to be kept."""
    facts = [(p.depth, p.level, p.name, p.key, p.region.seed, p.region.exemplar.origin.detail) for p in (one, other)]
    masks = [p.region.masks for p in (one, other)]
    return facts[0] == facts[1] and all(
        set(a) == set(b) and all(np.array_equal(a[k].data, b[k].data) for k in a) for a, b in zip(*masks, strict=True)
    )


def assert_same(one, other):
    """The same plots; and once they are grown, the same pixels at every level."""
    for a, b in zip(layers.layers(one.root), layers.layers(other.root), strict=True):
        assert len(a.growth) == len(b.growth)
        assert all(map(alike, a.growth, b.growth))
    one, other = settled(one), settled(other)
    for a, b in zip(layers.layers(one.root), layers.layers(other.root), strict=True):
        for level, rect in places(one):
            seen = [layer_planes(layer, level, rect) for layer in (a, b)]
            assert [s is None for s in seen] in ([True, True], [False, False])
            assert seen[0] is None or np.array_equal(*seen), (a.name, level)


def grown(painting):
    return [plot for layer in layers.layers(painting.root) for plot in layer.growth]


def rewritten(members, change=None, drop=()):
    file = io.BytesIO()
    kept = {name: data for name, data in members.items() if not name.startswith(tuple(drop))}
    kept.update(change or {})
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in kept.items():
            out.writestr(name, data)
    return file.getvalue()


def opened(data, tmp_path, **limits):
    path = tmp_path / "x.ora"
    path.write_bytes(data)
    return open_painting(path, limits=replace(LIMITS, **limits))


GONE = object()


def altered(members, path, value):
    manifest = json.loads(members[MANIFEST])
    place = manifest
    for step in path[:-1]:
        place = place[sorted(place)[step] if isinstance(place, dict) and isinstance(step, int) else step]
    last = sorted(place)[path[-1]] if isinstance(place, dict) and isinstance(path[-1], int) else path[-1]
    if value is GONE:
        del place[last]
    else:
        place[last] = value(place[last]) if callable(value) else value
    return {MANIFEST: json.dumps(manifest).encode()}


def forged(members):
    """Another checksum for the second plot of the first layer."""
    return rewritten(members, altered(members, ("layers", 0, "plots", 1, "crc"), lambda crc: crc ^ 1))
