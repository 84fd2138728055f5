"""Pictures that lie, on every way that brings one in: taken, or refused in one line, and nothing is half done."""

import hostile
import hostile_pictures
import pytest
from test_hostile_files import judged

from engine.files.fault import FileError
from engine.files.layered.reading_layers import read_layers, read_sheet
from engine.studio.filing.documents import opened

GROUND = [hostile.layer("add", "A"), hostile.stroke()]
POURED = {"do": "fill", "brush": {"ink": [{"texture": "t"}]}, "like": {"at": [60, 40]}, "open": True}


def _texture(maker, name):
    return {"do": "texture", "name": "t", "maker": maker, "path": name}


def _laid(name, **more):
    return [*GROUND, _texture("image", name), hostile.layer("add", "P", kind="picture", texture="t", at=[4, 4], **more)]


def _painted(name, maker, **brush):
    return [*GROUND, _texture(maker, name), hostile.stroke([9, 9], [30, 20], brush={"radius": 8, **brush})]


# What the window asks for as a picture comes in so, by the button of its card.
WAYS = {
    "Layer": _laid,
    "Reference": lambda name: _laid(name, role="reference"),
    "Ground": lambda name: _laid(name, role="height"),
    "Texture": lambda name: _painted(name, "image", ink=[{"texture": "t"}]),
    "Fill": lambda name: [*GROUND, _texture("image", name), POURED],
    "Example": lambda name: _painted(name, "example", mode="example", example="t"),
}


def _grouped(path):
    read_layers(path)
    read_sheet(path, path.name)


DIRECTLY = {"Open": opened, "Group": _grouped}


def refusal(way, path):
    """Why a file is not taken by what reads it; "" if it is."""
    try:
        way(path)
    except FileError as error:
        return str(error)
    return ""


def taken(folder, capsys, way, ending, data):
    """Whether a file is taken so; if it is not, nothing is saved."""
    path, told, saved = folder / f"in{ending}", folder / "a.jsonl", folder / "a.ora"
    path.write_bytes(data)
    saved.unlink(missing_ok=True)
    if way in DIRECTLY:
        line = refusal(DIRECTLY[way], path)
        assert "\n" not in line
        return not line
    told.write_bytes(hostile.lines(WAYS[way](path.name)))
    found = judged(capsys, "play", told, "--save", saved)
    assert saved.exists() == found
    return found


QUICK = 41  # every so many of them in the suite


@pytest.mark.parametrize(
    ("files", "each"),
    [
        (hostile_pictures.quick_ones, QUICK),
        pytest.param(hostile_pictures.all_of_them, 1, marks=pytest.mark.nightly),
    ],
)
def test_each_is_taken_or_refused_in_one_line(tmp_path, capsys, files, each):
    cases = [
        (way, ending, data)
        for _, ending, data in files()
        for way in ("Open", *(("Group",) if ending in (".ora", ".psd") else WAYS))
    ]
    done = [taken(tmp_path, capsys, *case) for case in cases[::each]]
    assert 0 < sum(done) < len(done)
    assert not [path.name for path in tmp_path.iterdir() if ".part" in path.name]
