"""Files of earlier formats still open, pixel for pixel: each was written by the program of its time."""

import hashlib
import struct
from pathlib import Path

import numpy as np
import pytest

from engine.archive import opening
from engine.archive.earlier import packs_of_format_1
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.files.fault import TooMuch
from engine.numeric.address import Rect
from engine.strokes.example_textures import key_of

OLD = Path(__file__).parent / "old"
# Rock under stripes under finer rock; SHA-256 of premultiplied float32 planes of the frame, by level.
FIRST = {
    -2: "2f22185d749b7ad4c196cf2ba4c36a3d",
    0: "4f7f850aa0c07d837f7d184d707b635c",
    1: "72bb94b4d9da8b5cd845264ef9196efa",
    2: "3a86c59b5e5d3e91c2487b52a872b539",
    4: "a740ea8792d31936bbc348c4b033315b",
}


def seen(painting, level):
    planes = evaluate(next(layers(painting.root)).pyramid, level, Rect(0, 0, 64, 48).zoomed(level)).data[:4]
    return hashlib.sha256(np.ascontiguousarray(planes).tobytes()).hexdigest()[:32]


@pytest.fixture(scope="module")
def opened():
    return open_painting(OLD / "format1.ora")


def test_what_a_file_of_the_first_format_decodes_at_once_is_counted_as_it_is_read(monkeypatch):
    (pyramid,) = (layer.pyramid for layer in layers(open_painting(OLD / "format1.ora").painting.root))
    size = sum(record.plain_size for _, record in pyramid.all_records())
    monkeypatch.setattr(opening, "_most_at_once", lambda manifest: 0)
    monkeypatch.setattr(opening, "memory_cap", lambda: size - 1)
    with pytest.raises(TooMuch):
        open_painting(OLD / "format1.ora")


def test_a_file_of_the_first_format_opens(opened):
    assert opened.native
    assert {level: seen(opened.painting, level) for level in FIRST} == FIRST


def test_what_ink_implied_when_the_second_format_began_is_implied_still():
    """The same painting, its colour left out: put back with the same roundings, no tile differs."""
    found = open_painting(OLD / "format2.ora")
    assert (found.native, found.notes) == (True, ())
    assert {level: seen(found.painting, level) for level in FIRST} == FIRST


# Two examples at three depths: depth, level, name and seed of each plot, and the first half of the SHA-256 of its mask.
PLOTS = [
    (-1.0, 1, "patch", 5, "e8c6e1268c078ccf1f1bf6754ef003f1"),
    (0.0, 0, "weave", 5, "004c3715723fc151fc478248f50e4528"),
    (2.5, 0, "patch", 5, "199ccec19cd2b6be15a07d9be3592fa9"),
]


def test_what_was_painted_with_examples_when_the_third_format_began():
    """The same regions of the same examples; what they grow into may be another, which is then told."""
    found = open_painting(OLD / "format3.ora")
    assert found.native
    assert not found.notes or "is grown anew" in found.notes[0]
    growth = next(layers(found.painting.root)).growth
    assert [(p.depth, p.level, p.name, p.region.seed, masked(p.region.masks[0])) for p in growth] == PLOTS
    textures = found.painting.textures
    details = {"patch": 0, "weave": 1}
    assert [p.key for p in growth] == [key_of(textures[p.name], details[p.name]) for p in growth]


def masked(masks):
    found = hashlib.sha256()
    for key, mask in sorted(masks.items()):
        found.update(repr(key).encode() + mask.data.tobytes())
    return found.hexdigest()[:32]


def test_it_is_saved_in_the_present_format(opened, tmp_path):
    save(tmp_path / "a.ora", Snapshot(opened.painting))
    again = open_painting(tmp_path / "a.ora")
    assert again.native
    assert {level: seen(again.painting, level) for level in FIRST} == FIRST


@pytest.mark.parametrize("dtype", [np.int16, np.int32])
def test_the_first_code_of_tiles(dtype):
    """Differences, zigzag, bytes apart: as the first format had it."""
    y, x = np.mgrid[0:9, 0:7]
    planes = np.array([x * 40 + y * 3, x * 3 + y * 40, (x + y) % 2 * 9 - 4, x * y - 20])
    bits, body = 8 * np.dtype(dtype).itemsize, b""
    for kind, plane in zip((2, 1, 0, 1), planes, strict=True):
        d = plane.astype(np.int64)
        if kind == 1:
            d[:, 1:] -= plane[:, :-1]
        if kind == 2:
            d[1:] -= plane[:-1]
        zigzag = ((d << 1) ^ (d >> 63)) & ((1 << bits) - 1)
        body += b"".join(((zigzag >> s) & 255).astype(np.uint8).tobytes() for s in range(0, bits, 8))
    raw = np.frombuffer(struct.pack("4B", 2, 1, 0, 1) + body, np.uint8)
    out = np.empty(planes.shape, dtype)
    assert len(raw) == packs_of_format_1.encoded_size(planes.shape, bits)
    assert packs_of_format_1.decoded(raw, [out]) == np.abs(planes).max()
    assert np.array_equal(out, planes)
