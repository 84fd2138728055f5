"""What was painted with examples, saved and opened: the same regions, the same pixels once grown, and lies refused."""

import hashlib
import io
import json
import signal
import subprocess
import sys
import time
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from immutables import Map
from PIL import Image

from engine.canvas import layers
from engine.canvas.evaluate import TileCache
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.painting import growths as files
from engine.painting import maskpacks, opening
from engine.painting.archive import Snapshot, save
from engine.painting.export import Picture, export
from engine.painting.fault import FileError
from engine.painting.limits import LIMITS
from engine.painting.manifest import FORMAT, WITHOUT_EXAMPLES
from engine.painting.opening import open_painting
from engine.painting.painting import Painting
from engine.painting.session import Session
from engine.painting.settling import settled
from engine.texture.example import region as regions
from engine.texture.example.tiles import NONE, SIDE
from engine.texture.image import ImageSource

ROOT = Path(__file__).parents[3]
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
    """Pictures of stripes and of spots, with a region."""
    folder = tmp_path_factory.mktemp("pictures")
    y, x = np.mgrid[0:26, 0:30]
    stripes = np.stack([128 + 90 * np.sin(x), 90 + 60 * np.cos(y / 2), x * 8, 0 * x + 255], axis=-1).astype(np.uint8)
    Image.fromarray(stripes).save(folder / "stripes.png")
    spots = np.stack([y * 9, 0 * x + 60, 40 + 200 * ((x // 4 + y // 4) % 2), 255 - x * 4], axis=-1).astype(np.uint8)
    Image.fromarray(spots).save(folder / "spots.png")
    Image.fromarray(((np.hypot(x - 15, y - 13) < 11) * 255).astype(np.uint8)).save(folder / "mask.png")
    return folder


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
        set(a) == set(b) and all(np.array_equal(a[k], b[k]) for k in a) for a, b in zip(*masks, strict=True)
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


# ---- ours ----


def test_round_trip(session, saved):
    found = open_painting(saved)
    assert (found.native, found.notes) == (True, ())
    assert_same(session.painting, found.painting)
    assert len(grown(session.painting)) == 7
    assert {plot.level for plot in grown(session.painting)} == {0, 1, 80}
    assert {plot.name: plot.region.exemplar.pixels.dtype for plot in grown(found.painting)} == {
        "stripes": np.uint16,
        "spots": np.uint16,
    }
    assert not any(plot.settled for plot in grown(found.painting))  # nothing is grown by opening


def test_textures_come_back_whether_they_were_used_or_not(session, saved):
    one, other = session.painting.textures, open_painting(saved).painting.textures
    assert set(one) == set(other)
    for name, texture in one.items():
        assert (texture.kind, texture.parameters) == (other[name].kind, other[name].parameters)
        for own, found in ((texture.source, other[name].source), (texture.mask, other[name].mask)):
            assert own == found
            assert own is None or np.array_equal(own.data, found.data)
    assert other["idle"].kind == "example"
    assert other["idle"].mask is None


def test_each_example_is_stored_once(members):
    manifest = json.loads(members[MANIFEST])
    told = manifest["examples"]
    assert len(told) == 3  # stripes with and without detail for zooming in, spots as they were
    assert len({(e["picture"], e.get("mask")) for e in told.values()}) == 2
    assert len(manifest["pictures"]) == 3
    assert sum(name.startswith("inkfall/pictures/") for name in members) == 3


def test_the_same_painting_gives_the_same_bytes(session, saved, tmp_path):
    """However far it is grown when it is saved, and after it was opened."""
    again = tmp_path / "b.ora"
    save(again, Snapshot(settled(session.painting, 2), session.recording()))
    assert again.read_bytes() == saved.read_bytes()
    reopened = open_painting(saved)
    save(again, Snapshot(reopened.painting, reopened.recording))
    assert again.read_bytes() == saved.read_bytes()


def test_painting_goes_on_after_opening_as_it_would_have_without(session, saved):
    """Strokes with the same example join the plots that were opened."""
    reopened, straight = (
        Session(painting, TileCache(16 << 20)) for painting in (open_painting(saved).painting, session.painting)
    )
    for command in (
        grow([[120, 20], [150, 30]], "stripes", example_detail=1),
        stroke([[30, 30]], mode="erase", radius=11),
        grow([[70, 62]], "stripes", level=1, depth=3, radius=7),
        grow([[0, 100], [100, 100]], "idle", depth=1.5, radius=6),
    ):
        for one in (reopened, straight):
            one.do(c.parse({**command, "layer": "Layer 1"}))
    assert_same(straight.painting, reopened.painting)
    assert len(grown(straight.painting)) == 8


def test_a_painting_without_examples_is_one_of_the_format_before(session, folder, tmp_path):
    other = begun(folder)
    other.do(c.parse(stroke([[0, 0], [20, 5]])))
    for painting, expected in (
        (replace(other.painting, textures=Map()), WITHOUT_EXAMPLES),
        (other.painting, FORMAT),
        (session.painting, FORMAT),
    ):
        save(tmp_path / "a.ora", Snapshot(painting))
        with zipfile.ZipFile(tmp_path / "a.ora") as file:
            assert json.loads(file.read(MANIFEST))["inkfall"] == expected
            assert f'inkfall:format="{expected}"'.encode() in file.read("stack.xml")
        assert open_painting(tmp_path / "a.ora").native


def test_another_way_of_growing_is_told(members, tmp_path):
    found = opened(rewritten(members, altered(members, ("synthesis",), 99)), tmp_path)
    assert found.native
    assert len(found.notes) == 1
    assert "(revision 99, now 1)" in found.notes[0]


@pytest.mark.parametrize("depth", [0.1, -(2.0**31), 1e-300])
def test_depths_come_back_exactly(folder, tmp_path, depth):
    session = begun(folder)
    session.do(c.parse(grow([[5, 5]], "stripes", depth=depth)))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    assert [plot.depth for plot in grown(open_painting(tmp_path / "a.ora").painting)] == [depth]


# ---- at random ----

POINT = st.tuples(st.integers(-30, 200), st.integers(-20, 130)).map(list)
STROKES = st.one_of(
    st.builds(
        grow,
        st.lists(POINT, min_size=1, max_size=2),
        st.sampled_from(["stripes", "spots"]),
        depth=st.sampled_from([0, 2]),
        example_level=st.sampled_from([0, 1, -1]),
        example_detail=st.sampled_from([0, 1]),
        radius=st.integers(2, 30),
        layer=st.sampled_from(["below", "above"]),
    ),
    st.builds(
        stroke,
        st.lists(POINT, min_size=1, max_size=2),
        mode=st.sampled_from(["erase", "paint"]),
        radius=st.integers(2, 20),
        layer=st.sampled_from(["below", "above"]),
    ),
)


@given(st.lists(STROKES, min_size=1, max_size=5), st.lists(STROKES, max_size=2))
@settings(deadline=None, max_examples=12)
@example([grow([[0, 0]], "spots", layer="above"), stroke([[0, 0]], mode="erase", layer="above", radius=30)], [])
def test_anything_painted(folder, tmp_path_factory, painted, later):
    path = tmp_path_factory.mktemp("any") / "a.ora"
    session = begun(folder)
    for command in ({"do": "layer", "add": "below"}, {"do": "layer", "add": "G", "kind": "group"}):
        session.do(c.parse(command))
    session.do(c.parse({"do": "layer", "add": "above", "group": "G"}))
    for command in painted:
        session.do(c.parse(command))
    save(path, Snapshot(session.painting))
    written = path.read_bytes()
    reopened = Session(open_painting(path).painting, TileCache(16 << 20))
    assert_same(session.painting, reopened.painting)
    save(path, Snapshot(reopened.painting))
    assert path.read_bytes() == written
    for command in later:
        session.do(c.parse(command))
        reopened.do(c.parse(command))
    assert_same(session.painting, reopened.painting)


# ---- for others ----


def shown(png):
    pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGBA")).astype(float)
    return np.dstack([pixels[..., :3] * pixels[..., 3:] / 255, pixels[..., 3:]])


def test_others_see_what_is_grown(session, saved, members, tmp_path):
    export(tmp_path / "a.png", Picture(settled(session.painting)))
    ours = shown((tmp_path / "a.png").read_bytes())
    assert np.abs(ours - shown(members["mergedimage.png"])).max() <= 2
    export(tmp_path / "b.png", Picture(open_painting(saved).painting))
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "a.png").read_bytes()
    for layer in layers.layers(settled(session.painting).root):
        frame = next(e for e in stack_entries(members) if e.src == f"data/L{layer.id}.png")
        png = shown(members[f"data/L{layer.id}.png"])
        place = Rect.at(FRAME.x0 + frame.x, FRAME.y0 + frame.y, png.shape[1], png.shape[0])
        planes = layer_planes(layer, 0, place)
        expected = np.zeros((*png.shape[:2], 4), np.uint8) if planes is None else to_rgba8(planes)
        file = io.BytesIO()
        Image.fromarray(expected).save(file, "PNG")
        assert np.abs(png - shown(file.getvalue())).max() <= 2, layer.name
        assert layer.name == "deep" or png.any()


def stack_entries(members):
    from engine.painting.stackxml import parse_stack

    return list(parse_stack(members["stack.xml"], "a").root.layers())


def test_a_picture_below_stays_what_it_was(folder, tmp_path):
    """A layer that began as a picture: other programs see it grown over, the picture itself comes back."""
    Image.fromarray(np.full((60, 80, 4), 200, np.uint8)).save(tmp_path / "in.png")
    from engine.painting.documents import opened as document

    own = document(tmp_path / "in.png").session
    own = Session(own.painting, TileCache(16 << 20), folder=folder)
    own.do(c.parse(DEFINED[0]))
    bare = next(layers.layers(own.painting.root))
    own.do(c.parse(grow([[20, 20], [60, 30]], "stripes")))
    save(tmp_path / "a.ora", Snapshot(own.painting))
    found = open_painting(tmp_path / "a.ora")
    assert_same(own.painting, found.painting)
    layer = next(layers.layers(found.painting.root))
    assert bare.pyramid.ground is not None
    assert layer.pyramid.ground.pixels == bare.pyramid.ground.pixels
    again = replace(layer, growth=())
    assert np.array_equal(*(layer_planes(one, 0, Rect(0, 0, 80, 60)) for one in (bare, again)))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        assert shown(file.read(f"data/L{layer.id}.png")).std() > 5
    own.do(c.parse({"do": "undo"}))
    save(tmp_path / "b.ora", Snapshot(own.painting))
    assert_same(own.painting, open_painting(tmp_path / "b.ora").painting)


# ---- what lies ----


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


PLOT = ("layers", 0, "plots", 0)
EXAMPLE = ("examples", 0)
LIES = {
    "plots of text": (("layers", 0, "plots"), "all"),
    "plot of text": (PLOT, "x"),
    "no depth": ((*PLOT, "depth"), GONE),
    "depth of text": ((*PLOT, "depth"), "deep"),
    "depth beyond all": ((*PLOT, "depth"), 1e300),
    "level beyond all": ((*PLOT, "level"), 1 << 40),
    "no name": ((*PLOT, "name"), ""),
    "no seed": ((*PLOT, "seed"), None),
    "example that is not there": ((*PLOT, "example"), "none"),
    "no masks": ((*PLOT, "masks"), []),
    "masks of text": ((*PLOT, "masks"), ["x"]),
    "mask that is no member": ((*PLOT, "masks", 0, 0), "inkfall/none"),
    "mask that is a picture": ((*PLOT, "masks", 0, 0), "mergedimage.png"),
    "mask of fewer tiles": ((*PLOT, "masks", 0, 1), lambda n: n - 1),
    "mask of more tiles": ((*PLOT, "masks", 0, 1), lambda n: n + 1),
    "mask of no tile": ((*PLOT, "masks", 0, 1), 0),
    "mask beyond all memory": ((*PLOT, "masks", 0, 1), 1 << 40),
    "mask twice": ((*PLOT, "masks"), lambda masks: masks * 2),
    "a plot twice": (("layers", 0, "plots"), lambda plots: [*plots, plots[0]]),
    "a plot on another": (("layers", 0, "plots"), lambda plots: [*plots, {**plots[0], "example": plots[1]["example"]}]),
    "crc of text": ((*PLOT, "crc"), "x"),
    "examples of text": (("examples",), "all"),
    "no examples": (("examples",), GONE),
    "too many examples": (("examples",), lambda held: {str(n): held[min(held)] for n in range(1001)}),
    "example of text": (EXAMPLE, 3),
    "example without its picture": ((*EXAMPLE, "picture"), "0" * 64),
    "example of a mask of another": ((*EXAMPLE, "mask"), "0" * 64),
    "example of too much detail": ((*EXAMPLE, "detail"), 60),
    "example of an unknown way": ((*EXAMPLE, "parameters", "method"), "magic"),
    "example of kappa none": ((*EXAMPLE, "parameters", "kappa"), "none"),
    "example of a word more": ((*EXAMPLE, "parameters"), lambda held: {**held, "speed": 9}),
    "example of no parameters": ((*EXAMPLE, "parameters"), GONE),
    "synthesis 0": (("synthesis",), 0),
    "texture without its mask": (("textures", "idle", "mask"), "0" * 64),
    "texture without its picture": (("textures", "idle", "picture"), GONE),
    "texture with another parameter": (("textures", "idle", "parameters", "e_max"), 1e9),
}


@pytest.mark.parametrize("name", LIES)
def test_manifests_that_lie(members, tmp_path, name):
    with pytest.raises(FileError) as caught:
        opened(rewritten(members, altered(members, *LIES[name])), tmp_path)
    assert str(caught.value).startswith(str(tmp_path / "x.ora") + ": ")
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 500


def masked(members, data):
    """The file with other bytes for the first plot's mask, as the manifest names them."""
    manifest = json.loads(members[MANIFEST])
    name = manifest["layers"][0]["plots"][0]["masks"][0][0]
    manifest["members"][name] = [len(data), hashlib.sha256(data).hexdigest()]
    return {name: data, MANIFEST: json.dumps(manifest).encode()}


def test_a_mask_of_other_bytes_is_refused(members, tmp_path):
    tile = np.ones((1, SIDE, SIDE), np.uint8)
    keys = [(0, column) for column in range(40)]  # more tiles than the plot has
    bad = masked(members, maskpacks.pack(dict.fromkeys(keys, tile), keys))
    with pytest.raises(FileError, match=r"number of tiles|run of tiles"):
        opened(rewritten(members, bad), tmp_path)


def test_a_mask_that_another_program_changed_leaves_the_pictures(members, tmp_path):
    name = next(n for n in members if n.endswith(".masks"))
    other = bytearray(members[name])
    other[-1] ^= 1
    found = opened(rewritten(members, {name: bytes(other)}), tmp_path)
    assert not found.native
    assert "another program changed" in found.notes[0]


@pytest.mark.parametrize("drop", [".masks", "pictures/"])
def test_members_that_are_gone_are_told(members, tmp_path, drop):
    found = opened(rewritten(members, drop=[next(n for n in members if drop in n)]), tmp_path)
    assert not found.native
    assert found.notes[0] == opening.LOST


def test_flipped_bits_are_found(session, saved, tmp_path):
    """A flipped bit of a mask or of an example is refused, or the painting opens as pictures."""
    data = saved.read_bytes()
    with zipfile.ZipFile(saved) as file:
        held = [i for i in file.infolist() if i.filename.endswith(".masks") or "pictures/" in i.filename]
    for info in held:
        bad = bytearray(data)
        bad[info.header_offset + 60 + info.compress_size // 2] ^= 4
        with pytest.raises(FileError):
            opened(bytes(bad), tmp_path)


def test_an_example_too_large_for_one_is_refused(tmp_path):
    source = ImageSource.of("wide", np.ones((4, 8, 1025), np.float32))
    other = files.Texture(files.KIND, Map(), source)
    save(tmp_path / "a.ora", Snapshot(Painting(FRAME, 1, textures=Map({"wide": other}))))
    with pytest.raises(FileError, match="1025 x 8 pixels"):
        open_painting(tmp_path / "a.ora")


def test_a_region_is_as_if_it_had_been_painted(session):
    """Its coarser masks too."""
    for plot in grown(session.painting):
        made = files.region_of(plot.region.exemplar, plot.region.seed, plot.region.masks[0])
        assert len(made.masks) == len(plot.region.masks) == len(plot.region.exemplar.levels)
        for one, other in zip(made.masks, plot.region.masks, strict=True):
            assert set(one) == set(other)
            assert all(np.array_equal(one[key], other[key]) for key in one)
    empty = regions.empty(plot.region.exemplar)
    assert files.region_of(plot.region.exemplar, 0, NONE).masks == empty.masks


# ---- being killed ----

CHILD = """
import sys
from engine.painting.archive import Snapshot, save
from engine.painting.opening import open_painting
painting = open_painting(sys.argv[1]).painting
print("opened", flush=True)
for _ in range(100):
    save(sys.argv[2], Snapshot(painting))
    print("saved", flush=True)
"""


def test_killed_while_saving_the_file_is_whole(session, saved, tmp_path):
    target = tmp_path / "a.ora"
    target.write_bytes(saved.read_bytes())
    child = subprocess.Popen([sys.executable, "-c", CHILD, saved, target], stdout=subprocess.PIPE, cwd=ROOT)
    assert child.stdout.readline() == b"opened\n"
    assert child.stdout.readline() == b"saved\n"
    time.sleep(0.07)
    child.send_signal(signal.SIGKILL)
    child.wait()
    child.stdout.close()
    assert_same(session.painting, open_painting(target).painting)
