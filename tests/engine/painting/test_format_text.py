"""`palettes/format.md` is enough to read a painting: a reader that follows it, and knows nothing of the program, finds
the same pixels."""

import hashlib
import io
import json
import struct
import zipfile
import zlib
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from engine.archive.grounds import lay_ground
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.session import Session

Q = 2.0**-16
TILE = 128
WIDTHS = (0, 2, 4, 8, 16, 32)


class Reader:
    """A layer of a file, as the text tells it: `tiles` by (level, x, y), each the residual (planes, 128, 128) in units
    of Q."""

    def __init__(self, path, number):
        with zipfile.ZipFile(path) as file:
            self.manifest = json.loads(file.read("inkfall/manifest.json"))
            self.unit = {"2^-16": Q, "2^-12": 2.0**-12}[self.manifest["unit"]]
            told = next(layer for layer in self.manifest["layers"] if layer["id"] == number)
            self.tiles = {}
            if "ground" in told:
                self.lay(told["ground"], file.read(told["ground"]["member"]))
            for member, count, size in told["packs"]:
                found = list(tiles_of(file.read(member)))
                assert len(found) == count
                assert sum(data.size * bits // 8 for _, _, data, bits in found) == size
                self.tiles.update({key: placed(corners, data) for key, corners, data, _ in found})
            self.sums = {name: [len(file.read(name)), sha(file.read(name))] for name in file.namelist()}

    def lay(self, ground, png):
        """The picture that the layer began with."""
        pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGBA"), np.float32).transpose(2, 0, 1)
        byte, unit = np.float32(1.0 / 255.0), np.float32(Q)
        alpha = np.rint(pixels[3] * byte / unit)
        colour = np.rint(pixels[:3] * (alpha * unit * byte) / unit)
        (x, y), (height, width) = ground["at"], alpha.shape
        values = {0: (x, y, np.concatenate([colour, alpha[None]]).astype(np.float64))}
        level = 0
        while values[level][2].any():
            x, y, fine = values[level]
            height, width = fine.shape[1:]
            even = np.pad(fine, ((0, 0), (y & 1, (y + height) & 1), (x & 1, (x + width) & 1)))
            mean = even.reshape(4, even.shape[1] // 2, 2, even.shape[2] // 2, 2).sum(axis=(2, 4))
            level -= 1
            values[level] = (x >> 1, y >> 1, np.rint(mean / 4.0))
        for level, (x, y, data) in values.items():
            height, width = data.shape[1:]
            residual = self.cut(values.get(level), x - 8, y - 8, width + 16, height + 16)
            above = self.cut(
                values.get(level - 1), (x - 8 >> 1) - 1, (y - 8 >> 1) - 1, width // 2 + 12, height // 2 + 12
            )
            residual -= expanded(above)[:, (y - 8) & 1 :, (x - 8) & 1 :][:, : height + 16, : width + 16]
            self.scatter(level, x - 8, y - 8, residual)
        for key in ground["gone"]:
            self.tiles.pop(tuple(key), None)

    @staticmethod
    def cut(found, x, y, width, height):
        out = np.zeros((4, height, width))
        if found is not None:
            left, top, data = found
            x0, y0 = max(x, left), max(y, top)
            x1, y1 = min(x + width, left + data.shape[2]), min(y + height, top + data.shape[1])
            if x1 > x0 and y1 > y0:
                out[:, y0 - y : y1 - y, x0 - x : x1 - x] = data[:, y0 - top : y1 - top, x0 - left : x1 - left]
        return out

    def scatter(self, level, x, y, data):
        for ty in range(y // TILE, (y + data.shape[1] - 1) // TILE + 1):
            for tx in range(x // TILE, (x + data.shape[2] - 1) // TILE + 1):
                part = self.cut((x, y, data), tx * TILE, ty * TILE, TILE, TILE)
                if part.any():
                    self.tiles[level, tx, ty] = part

    def value(self, level, x, y, width, height):
        """v of a rectangle of a level, in units of the grid: float64 (4, height, width)."""
        coarsest = min((key[0] for key in self.tiles), default=level + 1)
        if level < coarsest:
            return np.zeros((4, height, width))
        left, top = (x >> 1) - 1, (y >> 1) - 1
        above = self.value(level - 1, left, top, (x + width + 1 >> 1) + 1 - left, (y + height + 1 >> 1) + 1 - top)
        out = expanded(above)[:, y & 1 :, x & 1 :][:, :height, :width].copy()
        for (at, tx, ty), tile in self.tiles.items():
            if at == level:
                out += self.cut((tx * TILE, ty * TILE, tile), x, y, width, height)
        out[3] = np.clip(out[3], 0.0, 1.0 / self.unit)
        return out


def sha(data):
    return hashlib.sha256(data).hexdigest()


def expanded(p):
    """E of all but the outermost pixels, in units of Q."""
    near = p[:, 1:-1]
    rows = np.stack([3 * near + p[:, :-2], 3 * near + p[:, 2:]], axis=2).reshape(len(p), -1, p.shape[2])
    mid = rows[:, :, 1:-1]
    both = np.stack([3 * mid + rows[:, :, :-2], 3 * mid + rows[:, :, 2:]], axis=3)
    return np.rint(both.reshape(len(p), rows.shape[1], -1) / 16.0)


def tiles_of(pack):
    """The tiles of a pack: key, corners, data, bits."""
    assert pack[:8] == b"inkfall\x03"
    (length,) = struct.unpack("<I", pack[8:12])
    head, at = json.loads(pack[12 : 12 + length]), 12 + length
    told = iter(head["tiles"])
    for count, plain, stored in head["blocks"]:
        raw = zlib.decompress(pack[at : at + stored])
        assert len(raw) == plain
        at += stored
        yield from decoded(raw, [next(told) for _ in range(count)])
    assert at == len(pack)


def decoded(raw, heads):
    shapes = [(4 + 3 * len(inks), y1 - y0, x1 - x0) for *_, x0, y0, x1, y1, _, inks in heads]
    codes = [1 + planes * rows * -(-width // 32) for planes, rows, width in shapes]
    squares = [-(-rows // 16) * -(-width // 16) for _, rows, width in shapes]
    gains = [4 * (shape[0] - 1) * count for shape, count in zip(shapes, squares, strict=True)]
    lengths, at = [0] * 7, 0
    for (_, _, width), count in zip(shapes, codes, strict=True):
        for k, code in enumerate(raw[at + 1 : at + count]):
            for stream, size in streams(code, pieces(width)[k % len(pieces(width))]):
                lengths[stream] += size
        at += count
    ends = np.cumsum([at + sum(gains), *lengths])
    assert ends[-1] == len(raw)
    places, at, gained = list(ends[:-1]), 0, at
    for head, shape, count, size in zip(heads, shapes, codes, gains, strict=True):
        level, x, y, *corners, bits, _inks = head
        found = np.frombuffer(raw[gained : gained + size], np.uint8).astype(np.int64)
        found = found.reshape(shape[0] - 1, 2, 2, -1)  # plane, byte, of alpha or the plane before, square
        gain = ((found[:, 0] + 256 * found[:, 1]) ^ 0x8000) - 0x8000
        data = planes_of(raw, raw[at], raw[at + 1 : at + count], places, gain, shape)
        yield (level, int(x, 16), int(y, 16)), corners, wrapped(data, bits), bits
        at, gained = at + count, gained + size


def planes_of(raw, kind, codes, places, gain, shape):
    """The planes of a tile, of which the differences are `kind`."""
    planes, rows, width = shape
    data, differences = np.zeros(shape, np.int64), []
    squares = np.arange(rows)[:, None] // 16 * -(-width // 16) + np.arange(width) // 16
    codes = iter(codes)
    for number in range(planes):
        z = [[v for n in pieces(width) for v in numbers(raw, next(codes), n, places)] for _ in range(rows)]
        d = np.array([[-(v + 1) // 2 if v & 1 else v // 2 for v in row] for row in z])
        if number:
            first, second = gain[number - 1][:, squares]
            d = wrapped(d + (wrapped(first * differences[0] + second * differences[-1] + 128) >> 8))
        differences.append(d)
        plane = [3, 0, 1, 2][number] if number < 4 else number
        data[plane] = np.cumsum(d, axis=1) if kind in (1, 3) else d
        data[plane] = np.cumsum(data[plane], axis=0) if kind in (2, 3) else data[plane]
    return data


def wrapped(values, bits=32):
    return (values + (1 << bits - 1)) % (1 << bits) - (1 << bits - 1)


def pieces(width):
    """The pixels of the pieces of a row."""
    return [min(32, width - x) for x in range(0, width, 32)]


def streams(code, width):
    """Which streams a piece of that width lies in, and the bytes that it takes there."""
    if code == 1:
        return [(0, (width + 3) // 4)]
    if code == 2:
        return [(1, (width + 1) // 2)]
    return [(2, width)] if code == 3 else [(3 + b, width) for b in range({0: 0, 4: 2, 5: 4}[code])]


def numbers(raw, code, width, places):
    """The next piece's z."""
    z = [0] * width
    for number, (stream, size) in enumerate(streams(code, width)):
        part = raw[places[stream] : places[stream] + size]
        places[stream] += size
        each = min(WIDTHS[code], 8)
        for i in range(width):
            byte = part[i * each // 8]
            z[i] |= ((byte >> (i * each) % 8) & ((1 << each) - 1)) << 8 * number
    return z


def placed(corners, data):
    x0, y0, x1, y1 = corners
    tile = np.zeros((len(data), TILE, TILE))
    tile[:, y0:y1, x0:x1] = data
    return tile


def stroke(session, level, points, **settings):
    points = np.pad(np.asarray(points, float), ((0, 0), (0, 4)))
    points[:, 2] = 1.0
    session.do(c.Stroke(level, (0, 0), points, Brush(**settings)))


def check(session, path, places):
    save(path, Snapshot(session.painting))
    for layer in layers(session.painting.root):
        read = Reader(path, layer.id)
        for level, x, y in places:
            ours = evaluate(layer.pyramid, level, Rect.at(x, y, 70, 50)).data[:4]
            assert np.array_equal(read.value(level, x, y, 70, 50) * read.unit, ours), (layer.name, level, x, y)
        told = {name: entry for name, entry in read.sums.items() if name != "inkfall/manifest.json"}
        assert told == read.manifest["members"]


PLACES = [(-3, -4, -4), (-1, 20, 10), (0, 90, 70), (0, 101, 33), (1, 200, 160), (2, 419, 333), (4, 1700, 1401)]


@pytest.mark.parametrize("grid", [16, 12])
def test_a_stranger_reads_strokes_of_several_levels(tmp_path, grid):
    session = Session(Painting(grid=grid))
    stroke(session, 0, [[20, 20], [240, 160], [60, 190]], radius=24, colour="#c06030", hardness=0.2)
    stroke(session, 2, [[400, 330], [520, 400]], radius=30, colour="#104080", opacity=0.6)
    stroke(session, -1, [[10, 60], [100, 20]], radius=9, colour="#f0e0a0", opacity=0.4)
    stroke(session, 1, [[180, 150], [260, 190]], radius=14, mode="erase", opacity=0.7)
    check(session, tmp_path / "strokes.ora", PLACES)


def test_a_stranger_reads_what_was_painted_on_a_picture(tmp_path):
    rng = np.random.default_rng(5)
    pixels = rng.integers(0, 256, (87, 131, 4), np.uint8)
    session = Session()
    session.do(c.AddLayer("Photo"))
    (layer,) = layers(session.painting.root)
    root = replace(session.painting.root, children=(replace(layer, pyramid=lay_ground(pixels, 41, 23)),))
    session.painting = replace(session.painting, root=root)
    check(session, tmp_path / "bare.ora", PLACES)
    stroke(session, 1, [[180, 150], [260, 190]], radius=14, colour="#2060a0")
    stroke(session, 0, [[90, 70], [95, 75]], radius=30, mode="erase")
    check(session, tmp_path / "painted.ora", PLACES)
