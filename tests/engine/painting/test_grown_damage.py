"""Files of what was painted with examples that lie or are damaged: refused in one line, or opened as pictures."""

import hashlib
import json
import zipfile

import numpy as np
import pytest
from immutables import Map
from sown import (
    FRAME,
    GONE,
    MANIFEST,
    altered,
    folder,
    members,
    opened,
    rewritten,
    saved,
    session,
)

from engine.archive import maskpacks
from engine.archive import plot_files as files
from engine.archive.members import LOST
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.files.fault import FileError
from engine.session.apply import Painting
from engine.texture.example.tiles import TILE_SIDE, sealed
from engine.texture.image import ImageSource

__all__ = ["folder", "members", "saved", "session"]

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
    tile = sealed(np.ones((1, TILE_SIDE, TILE_SIDE), np.uint8))
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
    assert found.notes[0] == LOST


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
