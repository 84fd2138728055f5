"""`inkfall export` and `info`: what a saved painting shows and tells."""

import json

import numpy as np
import pytest
import tifffile
from command_line import HEADER, pixels, refused
from zarr import open_group

from app.__main__ import main

PLACES = ["-4,0,0,4,3", "0,0,0,64,48", "3,150,130,100,80", "12,90000,70000,64,64", f"60,{30 << 60},{25 << 60},32,24"]


@pytest.mark.parametrize("place", PLACES)
def test_a_reopened_painting_shows_the_same_pixels(script, saved, tmp_path, place):
    played, reopened = tmp_path / "played.png", tmp_path / "reopened.png"
    assert main(["play", str(script), "--png", str(played), "--rect", place]) == 0
    assert main(["export", str(saved), str(reopened), "--rect", place]) == 0
    assert pixels(played).any()
    assert np.array_equal(pixels(played), pixels(reopened))


def test_endings_depths_and_layers(saved, tmp_path, capsys):
    shown = {}
    for name, words in {
        "a.png": [],
        "b.tif": [],
        "c.tiff": ["--layer", "Sky"],
        "d.PNG": ["--depth", "16"],
    }.items():
        assert main(["export", str(saved), str(tmp_path / name), *words]) == 0
        shown[name] = pixels(tmp_path / name)
    assert np.array_equal(shown["a.png"], shown["b.tif"])
    assert not np.array_equal(shown["a.png"], shown["c.tiff"])
    capsys.readouterr()


def test_pyramids(saved, tmp_path, capsys):
    whole, tiff, zarr, deep = (tmp_path / name for name in ("a.png", "a.tif", "a.zarr", "a.dzi"))
    place = ["--rect", "5,9,9,1500,900"]
    for out, *words in ((whole,), (tiff, "--pyramid"), (zarr,), (f"{zarr}/",), (deep,)):
        assert main(["export", str(saved), str(out), *place, *words]) == 0
        assert f"wrote {str(out).rstrip('/')}" in capsys.readouterr().out
    with tifffile.TiffFile(tiff) as file:
        assert [level.shape for level in file.series[0].levels] == [(900, 1500, 4), (450, 750, 4), (225, 375, 4)]
        assert np.array_equal(file.series[0].levels[0].asarray(), pixels(whole))
    assert np.array_equal(open_group(zarr, mode="r")["0"][:], pixels(whole).transpose(2, 0, 1))
    assert np.array_equal(pixels(deep.with_name("a_files") / "11" / "0_0.png"), pixels(whole)[:511, :511])
    assert "--pyramid: found it for .png" in refused(capsys, "export", saved, tmp_path / "b.png", "--pyramid")
    (tmp_path / "mine.zarr").mkdir()
    assert "a folder that is no Zarr" in refused(capsys, "export", saved, tmp_path / "mine.zarr", status=1)
    assert "expected at most" in refused(capsys, "export", saved, tmp_path / "b.zarr", "--rect", f"0,0,0,{1 << 40},1")


def test_a_rectangle_as_a_painting(saved, tmp_path, capsys):
    out = tmp_path / "part.ora"
    assert main(["export", str(saved), str(out), "--rect", "1,20,20,60,41", "--layer", "Sky"]) == 0
    capsys.readouterr()
    assert main(["info", str(out), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["frame"] == [10, 10, 30, 21]
    assert [row["name"] for row in told["layers"]] == ["Sky"]
    whole, part = tmp_path / "whole.png", tmp_path / "part.png"
    for path, picture in ((saved, whole), (out, part)):
        assert main(["export", str(path), str(picture), "--layer", "Sky", "--rect", "4,320,320,99,99"]) == 0
    assert np.array_equal(pixels(whole), pixels(part))


def test_bookmarks_are_listed(tmp_path, capsys):
    script, path = tmp_path / "a.jsonl", tmp_path / "a.ora"
    marks = [
        {"name": "mill", "level": 3.5, "origin": [5**40, -4.25], "size": [1024, 768], "angle": 15},
        {"name": "sea", "level": 0, "origin": [0, 0], "size": [64, 48], "zz_later": [1]},
    ]
    script.write_text(HEADER.replace(": 1", ": 2") + "".join(f"{json.dumps({'do': 'bookmark', **m})}\n" for m in marks))
    assert main(["play", str(script), "--save", str(path)]) == 0
    capsys.readouterr()
    assert main(["info", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["bookmarks"] == marks
    assert main(["info", str(path)]) == 0
    assert f"bookmark: 'mill', 1024 x 768 at {5**40}, -4.25 of level 3.5" in capsys.readouterr().out


def test_a_group_as_a_painting_can_be_painted_on(tmp_path, capsys):
    script, whole, part = (tmp_path / name for name in ("a.jsonl", "a.ora", "b.ora"))
    script.write_text(
        HEADER + '{"do": "layer", "add": "Both", "kind": "group"}\n'
        '{"do": "layer", "add": "one", "group": "Both"}\n{"do": "stroke", "points": [[9, 9]], "brush": {}}\n'
    )
    assert main(["play", str(script), "--save", str(whole)]) == 0
    assert main(["export", str(whole), str(part), "--layer", "Both"]) == 0
    capsys.readouterr()
    assert main(["info", str(part), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["active"] == "one"


def test_info(saved, capsys):
    assert main(["info", str(saved), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["native"] is True
    assert [row["name"] for row in told["layers"]] == ["Sky", "Top"]
    assert told["inks"] == [["rock", 0, 16.0, 0.5, 7]]
    assert told["commands"] == 7
    assert max(told["levels"]) == 3
    assert told["bytes"] == sum(row["bytes"] for row in told["layers"]) > 1000
    level, x, y, width, _ = told["layers"][1]["bounds"]
    assert level == 3
    assert (x, y) == (191, 151)
    assert 75 < width < 82
    assert main(["info", str(saved)]) == 0
    assert "layer 'Top'" in capsys.readouterr().out


WRONG_PAINTINGS = {
    "no file": ["info", "{dir}/none.ora"],
    "a folder": ["info", "{dir}"],
    "a recording": ["info", "{script}"],
    "exr of 16 bits": ["export", "{saved}", "{dir}/o.exr", "--depth", "16"],
    "no ending": ["export", "{saved}", "{dir}/o"],
    "no such layer": ["export", "{saved}", "{dir}/o.png", "--layer", "x"],
    "depth": ["export", "{saved}", "{dir}/o.png", "--depth", "12"],
    "deep painting": ["export", "{saved}", "{dir}/o.ora", "--depth", "16"],
    "onto itself": ["export", "{saved}", "{saved}"],
    "export of nothing": ["export", "{dir}/none.ora", "{dir}/o.png"],
}


@pytest.mark.parametrize("words", WRONG_PAINTINGS.values(), ids=WRONG_PAINTINGS)
def test_wrong_paintings_and_endings(script, saved, tmp_path, capsys, words):
    refused(capsys, *(word.format(dir=tmp_path, script=script, saved=saved) for word in words))
    assert list(tmp_path.iterdir()) == []


def test_a_cut_painting_is_refused(saved, tmp_path, capsys):
    whole = saved.read_bytes()
    for part in (0, 1, 100, len(whole) // 2, len(whole) - 1):
        path = tmp_path / "cut.ora"
        path.write_bytes(whole[:part])
        assert str(path) in refused(capsys, "info", path)
        assert str(path) in refused(capsys, "export", path, tmp_path / "o.png")
    assert not (tmp_path / "o.png").exists()


def test_what_was_painted_at_a_place(saved, tmp_path, capsys):
    capsys.readouterr()
    assert main(["info", str(saved), "--at", "0,26,21", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["at"] == [0, 26, 21]
    top, sky = told["strokes"]
    assert (top["index"], top["layer"], top["level"], top["textures"]) == (4, "Top", 3, [])
    assert (sky["index"], sky["layer"], sky["textures"], sky["seed"], sky["time"]) == (2, "Sky", ["rock"], 7, None)
    assert sky["brush"]["colour"] == "#803010"
    assert 0 < top["shows"] < 1
    assert main(["info", str(saved), "--at", "0,60,3"]) == 0
    assert capsys.readouterr().out == "no stroke shows there\n"
    assert main(["info", str(saved), "--at", f"60,{26 << 60},{21 << 60}"]) == 0
    assert capsys.readouterr().out.startswith("command 4: paint #000000, radius 9 at level 3, on 'Top'; ")
    assert "expected L,X,Y: three integers" in refused(capsys, "info", saved, "--at", "0,5")
    part = tmp_path / "part.ora"
    assert main(["export", str(saved), str(part), "--layer", "Sky"]) == 0
    assert "found no recording" in refused(capsys, "info", part, "--at", "0,26,21", status=1)


def test_a_placement_is_told_and_exported_as_a_picture_alone(script, tmp_path, capsys):
    more = [
        {"do": "layer", "add": "Again", "kind": "placement", "of": "Sky", "at": [9, -4], "turn": 1},
        {"do": "layer", "add": "Both ways", "kind": "placement", "of": "Again", "mirror": True},
    ]
    longer, placed = tmp_path / "longer.jsonl", tmp_path / "placed.ora"
    longer.write_text("\n".join([script.read_text().strip(), *map(json.dumps, more)]) + "\n")
    assert main(["play", str(longer), "--save", str(placed)]) == 0
    assert main(["export", str(placed), str(tmp_path / "again.png"), "--layer", "Again"]) == 0
    assert pixels(tmp_path / "again.png").any()
    capsys.readouterr()
    assert main(["info", str(placed), "--json"]) == 0
    rows = {row["name"]: row for row in json.loads(capsys.readouterr().out)["layers"]}
    assert (rows["Again"]["kind"], rows["Again"]["of"], rows["Again"]["at"]) == ("placement", "Sky", [9, -4])
    assert main(["info", str(placed)]) == 0
    assert "placement 'Both ways'; src-over 1; of 'Again'" in capsys.readouterr().out
    assert "expected it baked" in refused(capsys, "export", placed, tmp_path / "again.ora", "--layer", "Again")
