"""Damaged paintings: what can be had of them is had.

What can be had is told here, from where the damage lies, by a reader of its own:

1. all paint, bit for bit, with frame, layers and textures, if either the recording is whole, with the pictures that it
   needs and a manifest to find them by, or all packs and pictures are, with a manifest;
2. else, with a manifest: each layer whose packs are whole, bit for bit; of the others all levels coarser than those
   of damaged blocks, bit for bit, and within the frame the picture of the layer, to 2/255, if it is whole;
3. else all commands before the first that cannot be read or done;
4. else the layers' pictures, or that of all layers together.
"""

import io
import json
import struct
import zipfile
import zlib
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pytest
from PIL import Image
from sown import rewritten

from engine.archive.opening import open_painting
from engine.archive.salvage.ways import IN_PART
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.attenuate import fold
from engine.canvas.evaluate import evaluate
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.files.fault import Cancelled, FileError, TooMuch
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.session.apply import Painting
from engine.session.damaged import PLAYED, open_or_salvage
from engine.session.session import Session

FRAME = Rect.at(-30, 10, 150, 110)
FLIPS, CUTS = 150, 64
RECORDING, MANIFESTS = "inkfall/recording.jsonl", ("inkfall/manifest.json", "inkfall/manifest-again.json")
ROCK = [{"texture": "rock", "amount": 0.7, "colour": "#ffffff", "period": 24}]


def stroke(x, y, level=0, **more):
    brush = {"radius": 16, "colour": "#c04020", "hardness": 0.5, **more}
    return {"do": "stroke", "level": level, "origin": [x, y], "points": [[0, 0], [30, 15, 0.7]], "brush": brush}


COMMANDS = (
    stroke(0, 60),
    {"do": "layer", "add": "ink"},
    stroke(40, 50, ink=ROCK),
    stroke(80, 120, level=1, ink=ROCK, radius=12),
    {"do": "texture", "name": "leaf", "maker": "image", "path": "leaf.png"},
    {"do": "layer", "add": "Group", "kind": "group", "group": None},
    {"do": "layer", "add": "inside", "group": "Group"},
    stroke(20, 40, ink=[{"texture": "leaf", "amount": 1, "period": 20}]),
    {"do": "layer", "set": "Group", "opacity": 0.6, "blend": "multiply"},
    {"do": "layer", "add": "deep", "group": None},
    stroke(4, 8, level=-3, radius=5),
    stroke(200, 300, level=3, radius=40),
    {"do": "undo", "count": 1},
    stroke(250, 310, level=3, radius=50, mode="erase"),
    {"do": "bookmark", "name": "lake", "level": 0.5, "origin": [1, 2], "size": [30, 20]},
)


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """Four layers and levels -3 to 3, one of the textures a picture."""
    return played(len(COMMANDS), tmp_path_factory.mktemp("pictures"))


def played(count, folder):
    y, x = np.mgrid[0:24, 0:40]
    pixels = np.stack([x * 6, y * 10, x * 3 + y, 255 - x * 2], axis=-1).astype(np.uint8)
    Image.fromarray(pixels).save(folder / "leaf.png")
    session = Session(Painting(FRAME, 11), TileCache(64 << 20), folder=folder)
    for command in COMMANDS[:count]:
        session.do(c.parse(command))
    return session


@dataclass(frozen=True)
class Member:
    """`start`, `stop`: of its header and bytes in the file."""

    start: int
    stop: int


@dataclass(frozen=True)
class File:
    """A saved painting, and what a reader of ZIP files finds in it."""

    data: bytes
    members: dict
    manifest: dict
    painting: object

    def whole(self, name, damaged):
        own = self.members[name]
        return damaged[own.start : own.stop] == self.data[own.start : own.stop]


def file_of(session, folder, recorded=True):
    path = folder / "a.ora"
    save(path, Snapshot(session.painting, session.recording() if recorded else None))
    data = path.read_bytes()
    members = {}
    with zipfile.ZipFile(path) as archive:
        for info in archive.infolist():
            name, extra = struct.unpack_from("<2H", data, info.header_offset + 26)
            stop = info.header_offset + 30 + name + extra + info.compress_size
            members[info.filename] = Member(info.header_offset, stop)
        manifest = json.loads(archive.read(MANIFESTS[0]))
    return File(data, members, manifest, open_painting(path).painting)


@pytest.fixture(scope="module")
def recorded(session, tmp_path_factory):
    return file_of(session, tmp_path_factory.mktemp("saved"))


@pytest.fixture(scope="module")
def unrecorded(session, tmp_path_factory):
    return file_of(session, tmp_path_factory.mktemp("saved"), recorded=False)


def flips(data, count, seed=5):
    rng = np.random.default_rng(seed)
    for place, bit in zip(rng.choice(len(data), count, replace=False), rng.integers(8, size=count), strict=True):
        bad = bytearray(data)
        bad[place] ^= 1 << int(bit)
        yield int(place), bytes(bad)


def cuts(data, count):
    for length in np.linspace(100, len(data) - 1, count).astype(int):
        yield int(length), data[:length]


# ---- what is the same ----


@lru_cache(maxsize=8)
def residuals(pyramid):
    """All that is stored of a layer: equal ones look the same at every level."""
    found = {}
    for key, record in fold(pyramid).all_records():
        full = np.zeros((record.data.shape[0], 128, 128), np.int32)
        r = record.rect
        full[:, r.y0 : r.y1, r.x0 : r.x1] = record.data
        found[key] = [full[:4], *((ink.key, full[4 + 3 * i : 7 + 3 * i]) for i, ink in enumerate(record.inks))]
    return found


def same_residuals(one, other):
    if one.keys() != other.keys():
        return False
    return all(
        len(a) == len(b)
        and np.array_equal(a[0], b[0])
        and all(same_ink(*pair) for pair in zip(a[1:], b[1:], strict=True))
        for a, b in ((one[key], other[key]) for key in one)
    )


def same_ink(one, other):
    return one[0] == other[0] and np.array_equal(one[1], other[1])


def tree(painting):
    """All properties of the layers, without their paint."""
    told = [
        (type(n).__name__, n.id, n.name, n.opacity, n.visible, n.blend, n.locked, layers.place(painting.root, n.name))
        for n in layers.walk(painting.root)
    ]
    return told, painting.frame, painting.seed, painting.active, painting.bookmarks


def same(one, other):
    if tree(one) != tree(other) or set(one.textures) != set(other.textures):
        return False
    pairs = zip(layers.layers(one.root), layers.layers(other.root), strict=True)
    return all(same_residuals(residuals(a.pyramid), residuals(b.pyramid)) for a, b in pairs)


# ---- what can be had ----


def all_can_be_had(file, damaged):
    known = any(file.whole(name, damaged) for name in MANIFESTS)
    pictures = all(file.whole(n, damaged) for n in file.members if n.startswith("inkfall/pictures/"))
    packs = all(file.whole(n, damaged) for n in file.members if n.endswith(".tiles"))
    recording = RECORDING in file.members and file.whole(RECORDING, damaged)
    return known and pictures and (packs or recording)


def anything_can_be_had(file, damaged):
    shown = "mergedimage.png" in file.members and file.whole("mergedimage.png", damaged)
    return (
        all_can_be_had(file, damaged)
        or shown
        or any(file.whole(n, damaged) for n in MANIFESTS)
        or commands_whole(file, damaged, 0)
    )


def packs_of(file, name):
    """The packs of a layer, by the manifest as it was."""

    def found(nodes):
        for node in nodes:
            yield from found(node.get("children", ()))
            if node["name"] == name and "packs" in node:
                yield from (member for member, _, _ in node["packs"])

    return list(found(file.manifest["layers"]))


def coarsest_lost(file, member, damaged):
    """The coarsest level of the tiles in the damaged blocks of a pack; of all, if its head is damaged."""
    start = file.data.index(b"inkfall\x03", file.members[member].start)
    (length,) = struct.unpack_from("<I", file.data, start + 8)
    at = start + 12 + length
    head = json.loads(file.data[start + 12 : at])
    levels = [tile[0] for tile in head["tiles"]]
    if damaged[start:at] != file.data[start:at]:
        return min(levels)
    lost = []
    for count, _, stored in head["blocks"]:
        own, levels = levels[:count], levels[count:]
        lost += own if damaged[at : at + stored] != file.data[at : at + stored] else []
        at += stored
    return min(lost, default=99)  # the header of the member alone: nothing is lost


def lost_of(file, damaged, folder):
    """Says what is lost that can be had; "" for nothing.  Damage is told where the file does not open as it was."""
    path = folder / "damaged.ora"
    path.write_bytes(damaged)
    try:
        found = open_or_salvage(path)
    except FileError as error:
        return f"refused: {error}" if anything_can_be_had(file, damaged) else ""
    if not found.native and not found.notes:
        return "nothing is told"
    if all_can_be_had(file, damaged):
        return "" if same(found.painting, file.painting) else "not all of the paint"
    if found.native:
        return "nothing is told"
    if any(file.whole(name, damaged) for name in MANIFESTS):
        return "; ".join(lost_of_layers(file, damaged, found.painting))
    whole = next(n for n in range(len(COMMANDS), -1, -1) if commands_whole(file, damaged, n))
    return "" if same(found.painting, played(whole, folder / "pictures").painting) else f"not all {whole} commands"


def lost_of_layers(file, damaged, painting):
    (found, *about), (whole, *expected) = tree(painting), tree(file.painting)
    if found[: len(whole)] != whole or about != expected:
        yield "the layers, or what else there is"
    pictures = all(file.whole(n, damaged) for n in file.members if n.startswith("inkfall/pictures/"))
    for layer in layers.layers(file.painting.root):
        torn = [member for member in packs_of(file, layer.name) if not file.whole(member, damaged)]
        missing = min((coarsest_lost(file, member, damaged) for member in torn), default=99)
        if not pictures and layer.name == "inside":
            missing = -99
        before, after = residuals(layer.pyramid), residuals(layers.find(painting.root, layer.name).pyramid)
        coarse, now = ({key: at for key, at in found.items() if key.level < missing} for found in (before, after))
        if not same_residuals(coarse, now):
            yield f"levels of {layer.name} coarser than {missing}"
        png = f"data/L{layer.id}.png"
        if missing < 99 and file.whole(png, damaged) and file.whole("stack.xml", damaged):
            one, other = (picture(layers.find(p.root, layer.name)) for p in (file.painting, painting))
            if np.abs(one - other).max() > 2:
                yield f"the picture of {layer.name}"


def picture(layer):
    """The part in the frame, premultiplied, in units of 1/255."""
    planes = layer_planes(layer, 0, FRAME)
    if planes is None:
        return np.zeros((4, FRAME.height, FRAME.width))
    return 255.0 * np.minimum(np.maximum(planes, 0), planes[3:])


def commands_whole(file, damaged, count):
    """Whether so many commands can be read, and done without the picture of a texture, if that is not whole."""
    own = file.members[RECORDING]
    inflate, text = zlib.decompressobj(-15), b""
    length = struct.unpack_from("<H", file.data, own.start + 26)[0]
    text = inflate.decompress(damaged[own.start + 30 + length : own.stop])
    named = next(n for n, command in enumerate(COMMANDS) if command["do"] == "texture")
    return text.count(b"\n") > count and count <= named


# ---- the proof ----


def all_lost(file, damaged, folder):
    """By the place of the damage, what is lost of that which can be had."""
    (folder / "pictures").mkdir()
    told = ((place, lost_of(file, bad, folder)) for place, bad in damaged)
    return {place: lost for place, lost in told if lost}


def test_no_flip_and_no_cut_loses_paint_that_can_be_had(recorded, tmp_path):
    some = [*list(flips(recorded.data, FLIPS))[::5], *list(cuts(recorded.data, CUTS))[::5]]
    assert not all_lost(recorded, some, tmp_path)


@pytest.mark.nightly
def test_none_of_many_does(recorded, tmp_path):
    assert not all_lost(recorded, [*flips(recorded.data, FLIPS), *cuts(recorded.data, CUTS)], tmp_path)


def test_without_a_recording_each_layer_is_had_as_far_as_it_is_whole(unrecorded, tmp_path):
    assert not all_lost(unrecorded, list(flips(unrecorded.data, FLIPS, seed=6))[::8], tmp_path)


@pytest.mark.nightly
def test_without_a_recording_none_of_many_does(unrecorded, tmp_path):
    assert not all_lost(unrecorded, flips(unrecorded.data, FLIPS, seed=6), tmp_path)


# ---- strangers ----


def lying(file, path, value):
    """The file with another manifest at both ends, whose sums are right."""
    manifest = json.loads(json.dumps(file.manifest))
    place = manifest
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    with zipfile.ZipFile(io.BytesIO(file.data)) as old:
        members = {name: old.read(name) for name in old.namelist()}
    return rewritten(members, dict.fromkeys(MANIFESTS, json.dumps(manifest).encode()))


LIES = {
    "frame of text": (("frame",), "all"),
    "two layers of an id": (("layers", 0, "id"), 2),
    "a pack of fewer tiles": (("layers", 0, "packs", 0, 1), 1),
    "a pack that is a picture": (("layers", 0, "packs", 0, 0), "mergedimage.png"),
    "another sum": (("members", "inkfall/layers/1/0.tiles", 1), "0" * 64),
    "a texture of no kind": (("textures", "leaf", "kind"), "marble"),
}


@pytest.mark.parametrize("name", LIES)
def test_of_a_manifest_that_lies_the_recording_is_played(recorded, tmp_path, name):
    path = tmp_path / "a.ora"
    path.write_bytes(lying(recorded, *LIES[name]))
    Image.open(recorded_leaf(recorded)).save(tmp_path / "leaf.png")
    with pytest.raises(FileError):
        open_painting(path)
    found = open_or_salvage(path)
    assert found.notes[0] == PLAYED
    assert same(found.painting, recorded.painting)


def recorded_leaf(file):
    leaf = file.painting.textures["leaf"].source
    out = io.BytesIO()
    Image.fromarray(to_rgba8(leaf.data)).save(out, "PNG")
    return out


def test_what_asks_for_too_much_is_not_salvaged(recorded, tmp_path):
    path = tmp_path / "a.ora"
    path.write_bytes(lying(recorded, ("layers", 0, "packs", 0, 2), 1 << 60))
    with pytest.raises(TooMuch, match="more than this machine has"):
        open_or_salvage(path)


def test_what_another_program_changed_is_no_damage(recorded, tmp_path):
    """Its picture is shown, not the paint of before; also of a file that is damaged afterwards."""
    with zipfile.ZipFile(io.BytesIO(recorded.data)) as old:
        members = {name: old.read(name) for name in old.namelist()}
    white = io.BytesIO()
    Image.new("RGBA", Image.open(io.BytesIO(members["data/L1.png"])).size, "white").save(white, "PNG")
    data = rewritten(members, {"data/L1.png": white.getvalue()})
    path = tmp_path / "a.ora"
    for whole, bad in ((True, data), (False, data[:-9])):
        path.write_bytes(bad)
        found = open_or_salvage(path)
        assert not found.native
        assert sum("another program changed" in note for note in found.notes) == 1
        assert (found.notes[0] == IN_PART) == (not whole)
        layer = layers.find(found.painting.root, "Layer 1")
        assert evaluate(layer.pyramid, 0, Rect.at(40, 60, 1, 1)).rgba.min() == 1.0


def test_hostile_bytes_are_refused_or_opened(recorded, unrecorded, tmp_path):
    rng = np.random.default_rng(3)
    path = tmp_path / "a.ora"
    for turn in range(24):
        data = bytearray((recorded, unrecorded)[turn % 2].data)
        for place in rng.integers(0, len(data), 40):
            data[place : place + int(rng.integers(1, 3000))] = rng.bytes(int(rng.integers(0, 3000)))
        path.write_bytes(bytes(data))
        told = opened_or_refused(path)
        assert told
        assert all("\n" not in line for line in told)


def opened_or_refused(path):
    """What is told of a damaged file."""
    try:
        found = open_or_salvage(path)
    except FileError as error:
        return (str(error),)
    assert not found.native
    return found.notes


def test_progress_and_cancelling_while_the_recording_is_played(recorded, tmp_path):
    path = tmp_path / "a.ora"
    torn = bytearray(recorded.data)
    torn[recorded.members["inkfall/layers/2/0.tiles"].start + 9000] ^= 1
    path.write_bytes(bytes(torn))
    told = []
    open_or_salvage(path, told.append)
    assert len(told) >= len(COMMANDS)
    assert told[-1] == 1.0
    with pytest.raises(Cancelled):
        open_or_salvage(path, told.append, lambda: told[-1] == 5 / len(COMMANDS))
    assert told[-1] == 5 / len(COMMANDS)
