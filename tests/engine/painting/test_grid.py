"""The grid on which a painting's values lie: which one it has, and that it keeps it wherever it goes."""

import io
import json
import struct
import zipfile

import numpy as np
import pytest

from app.__main__ import main
from engine.archive.manifest import FINE_FORMAT, PLACED_FORMAT
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.value import first_painting
from engine.session.damaged import open_or_salvage
from engine.session.replay import replay
from engine.session.session import Session

FRAME = {"frame": [0, 0, 160, 96]}
SHOWN = Rect(0, 0, 160, 96)
ROCK = [{"texture": "rock", "period": 30, "amount": 0.6, "colour": "#e0d0b0"}]
COMMANDS = (
    {"do": "stroke", "points": [[8, 8], [150, 80]], "brush": {"radius": 30, "hardness": 0.3, "ink": ROCK}},
    {"do": "stroke", "level": 1, "points": [[20, 90], [280, 60]], "brush": {"radius": 9, "colour": "#3060c0"}},
    {"do": "stroke", "points": [[20, 40], [150, 50]], "brush": {"radius": 40, "opacity": 0.03, "colour": "#ffffff"}},
    {"do": "layer", "add": "over"},
    {"do": "stroke", "level": -1, "points": [[5, 30], [70, 20]], "brush": {"radius": 20, "flow": 0.02, "hardness": 0}},
)
LATER = (
    {"do": "stroke", "points": [[5, 90], [150, 10]], "brush": {"radius": 50, "opacity": 0.01, "colour": "#80ff20"}},
    {"do": "undo"},
    {"do": "stroke", "points": [[5, 10], [150, 90]], "brush": {"radius": 50, "opacity": 0.02, "mode": "erase"}},
    {"do": "layer", "add": "third"},
    {"do": "stroke", "points": [[5, 50], [150, 50]], "brush": {"radius": 20, "opacity": 0.5}},
)
BOOKMARK = {"do": "bookmark", "name": "here", "level": 0, "origin": [0, 0], "size": [64, 48]}


def recording(header, *commands):
    lines = "\n".join(map(json.dumps, [{**FRAME, **header}, *commands]))
    return r.read_from(io.BytesIO(lines.encode()), "a.jsonl")


def told(found):
    """The header that a recording is written with."""
    return json.loads(next(iter(found.lines())))


def again(found):
    return r.read_from(io.BytesIO("\n".join(found.lines()).encode()), "b.jsonl")


def values(painting):
    """All planes of all layers at some levels."""
    return [
        evaluate(layer.pyramid, level, SHOWN.zoomed(level)).data
        for layer in layers(painting.root)
        for level in (-2, -1, 0, 1)
    ]


def assert_same(one, other):
    assert (one.grid, [layer.pyramid.grid for layer in layers(one.root)]) == (
        other.grid,
        [layer.pyramid.grid for layer in layers(other.root)],
    )
    for mine, theirs in zip(values(one), values(other), strict=True):
        assert np.array_equal(mine, theirs)


def on_grid(painting, grid):
    return all((planes * 2.0**grid % 1 == 0).all() for planes in values(painting))


@pytest.mark.parametrize(
    ("header", "grid"),
    [
        ({"inkfall": 1}, 16),
        ({"inkfall": 1, "grid": 12}, 16),  # unknown to version 1, and so without a meaning
        ({"inkfall": 2}, 16),
        ({"inkfall": 2, "grid": 16}, 16),
        ({"inkfall": 2, "grid": 12}, 12),
        ({"inkfall": 2, "grid": 12, "arithmetic": 1}, 12),
    ],
)
def test_only_the_header_tells_the_grid(header, grid):
    found = recording(header, *COMMANDS)
    painting = replay(found).painting
    assert found.header.grid == painting.grid == grid
    assert on_grid(painting, 16)
    assert on_grid(painting, 12) == (grid == 12)


@pytest.mark.parametrize("value", [0, 13, 20, True, "12", None, 12.0, [12]])
def test_another_grid_is_refused_in_one_line(value, tmp_path, capsys):
    path = tmp_path / "a.jsonl"
    path.write_text(json.dumps({"inkfall": 2, **FRAME, "grid": value}) + "\n")
    assert main(["play", str(path), "--png", str(tmp_path / "a.png")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "a.jsonl" in line
    assert "line 1: header.grid: found" in line
    assert "expected 16 or 12" in line
    with pytest.raises(FileError, match=r"header\.grid"):
        recording({"inkfall": 2, "grid": value})


def test_a_member_without_meaning_gets_none_when_the_version_rises():
    session = replay(recording({"inkfall": 1, "grid": 12}, *COMMANDS, BOOKMARK))
    header = told(session.recording())
    assert (header["inkfall"], header["grid"]) == (2, 16)
    assert again(session.recording()).header.grid == 16
    assert told(replay(recording({"inkfall": 1, "grid": 12}, *COMMANDS)).recording())["grid"] == 12


@pytest.mark.parametrize("grid", [12, 16])
def test_a_painting_keeps_its_grid_saved_opened_and_painted_on(tmp_path, grid):
    found = recording({"inkfall": 2, "grid": grid}, *COMMANDS)
    session = Session(first_painting(found.header))
    for command in found.commands:
        session.do(command)
    written = session.recording()
    assert told(written).get("grid", 16) == grid == again(written).header.grid
    path = tmp_path / "a.ora"
    save(path, Snapshot(session.painting, written))
    with zipfile.ZipFile(path) as file:
        manifest = json.loads(file.read("inkfall/manifest.json"))
    assert (manifest["unit"], manifest["inkfall"]) == (f"2^-{grid}", PLACED_FORMAT if grid == 12 else FINE_FORMAT)
    opened = open_painting(path)
    assert opened.native
    assert_same(session.painting, opened.painting)
    assert_same(replay(opened.recording).painting, opened.painting)
    on = Session(opened.painting, log=opened.recording.commands)
    assert on.base.grid == grid
    for command in LATER:
        session.do(c.parse(command))
        on.do(c.parse(command))
    assert_same(session.painting, on.painting)
    assert_same(replay(again(on.recording())).painting, on.painting)
    save(path, Snapshot(on.painting, on.recording()))
    assert_same(open_painting(path).painting, on.painting)


def test_files_of_the_coarse_grid_are_smaller(tmp_path):
    sizes = []
    for grid in (16, 12):
        save(tmp_path / "a.ora", Snapshot(replay(recording({"inkfall": 2, "grid": grid}, *COMMANDS)).painting))
        with zipfile.ZipFile(tmp_path / "a.ora") as file:
            sizes.append(sum(m.file_size for m in file.infolist() if m.filename.startswith("inkfall/layers/")))
    assert sizes[1] < 0.75 * sizes[0]


def damaged(source, out, names):
    """Writes the file anew, 40 bytes turned round in the middle of each member whose name begins so."""
    data = bytearray(source.read_bytes())
    with zipfile.ZipFile(source) as file:
        for member in file.infolist():
            if member.filename.startswith(names):
                start = member.header_offset + 30 + sum(struct.unpack_from("<HH", data, member.header_offset + 26))
                middle = start + member.compress_size // 2
                data[middle : middle + 40] = bytes(255 - byte for byte in data[middle : middle + 40])
    out.write_bytes(data)
    return out


@pytest.mark.parametrize("gone", ["inkfall/recording.jsonl", "inkfall/manifest.json"])
def test_damaged_files_are_had_on_their_grid(tmp_path, gone):
    session = replay(recording({"inkfall": 2, "grid": 12}, *COMMANDS))
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    path = damaged(tmp_path / "a.ora", tmp_path / "b.ora", gone)
    assert_same(open_or_salvage(path).painting, session.painting)


def test_a_layer_that_lost_tiles_shows_its_picture_on_the_grid(tmp_path):
    session = replay(recording({"inkfall": 2, "grid": 12}, *COMMANDS[1:3]))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    path = damaged(tmp_path / "a.ora", tmp_path / "b.ora", "inkfall/layers/")
    found = open_or_salvage(path).painting
    assert found.grid == 12
    assert on_grid(found, 12)
    (mine,), (theirs,) = (list(layers(painting.root))[:1] for painting in (found, session.painting))
    shown, wanted = (evaluate(layer.pyramid, 0, SHOWN).rgba for layer in (mine, theirs))
    assert np.abs(shown - wanted).max() < 2.5 / 255


def test_info_tells_the_grid(tmp_path, capsys):
    session = replay(recording({"inkfall": 2, "grid": 12}, *COMMANDS))
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    assert main(["info", str(tmp_path / "a.ora"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["grid"] == 12
    assert main(["info", str(tmp_path / "a.ora")]) == 0
    assert "grid" in capsys.readouterr().out


@pytest.mark.nightly
@pytest.mark.parametrize("opacity", [0.002, 0.005, 0.02])
def test_a_thousand_soft_strokes_do_not_band(opacity):
    """Against the same on the fine grid, in levels of 8 bits: no shift, and a grain that is less than one, in place of
    terraces; rounded to the nearest, half a level would be missing, and up to five where most strokes overlap."""
    rng = np.random.default_rng(1)
    brush = {"radius": 90, "hardness": 0, "opacity": opacity, "colour": "#f0c890"}
    ends = [(x - 60, y, x + 60, y) for x, y in zip(rng.normal(160, 60, 1000), rng.normal(96, 40, 1000), strict=True)]
    ground = {"do": "stroke", "points": [[-50, 96], [370, 96]], "brush": {"radius": 300, "colour": "#304878"}}
    soft = [{"do": "stroke", "points": [[a, b], [c, d]], "brush": brush} for a, b, c, d in ends]
    pictures = []
    for grid in (16, 12):
        painting = replay(recording({"inkfall": 2, "grid": grid}, ground, *soft)).painting
        (layer,) = layers(painting.root)
        pictures.append(evaluate(layer.pyramid, 0, Rect(0, 0, 320, 192)).rgba[:3] * 255)
    fine, coarse = pictures
    error = coarse - fine
    assert abs(error.mean()) < 0.03
    assert error.std() < 0.6
    smooth = error.reshape(3, 24, 8, 40, 8).mean(axis=(2, 4))  # what one sees as bands is left of it
    assert np.abs(smooth).max() < 0.4
    assert (np.abs(np.rint(coarse) - np.rint(fine)) > 1).mean() < 0.005
    assert longest_run(np.rint(coarse)) <= longest_run(np.rint(fine)) + 4


def longest_run(values):
    """The most pixels in a row that are equal."""
    rows = values.reshape(-1, values.shape[-1])
    return max(int(np.diff(np.flatnonzero(np.r_[True, np.diff(row) != 0, True])).max()) for row in rows)
