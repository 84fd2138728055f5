"""Commands that read paintings show what was painted with examples as it was, or say that it is not."""

import json
import zipfile

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main
from engine.archive.plot_files import OTHERWISE

MANIFEST = "inkfall/manifest.json"


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """A painting with a stroke of an example, and the picture of it that playing writes."""
    folder = tmp_path_factory.mktemp("drawn")
    y, x = np.mgrid[0:24, 0:24]
    Image.fromarray(np.dstack([x * 10, y * 10, (x + y) % 5 * 50]).astype(np.uint8)).save(folder / "weave.png")
    lines = (
        {"inkfall": 1, "frame": [0, 0, 90, 60], "seed": 4},
        {"do": "texture", "name": "weave", "maker": "example", "path": "weave.png"},
        {
            "do": "stroke",
            "points": [[10, 10], [70, 40]],
            "brush": {"mode": "example", "example": "weave", "radius": 12},
        },
    )
    (folder / "a.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    assert main(["play", str(folder / "a.jsonl"), "--save", str(folder / "a.ora"), "--png", str(folder / "a.png")]) == 0
    return folder


def test_exported_as_it_was_drawn(drawn, tmp_path, capsys):
    assert main(["export", str(drawn / "a.ora"), str(tmp_path / "a.png")]) == 0
    assert (tmp_path / "a.png").read_bytes() == (drawn / "a.png").read_bytes()
    assert len(np.unique(np.asarray(Image.open(drawn / "a.png")).reshape(-1, 4), axis=0)) > 40
    assert main(["export", str(drawn / "a.ora"), str(tmp_path / "b.ora")]) == 0
    assert (tmp_path / "b.ora").read_bytes() == (drawn / "a.ora").read_bytes()
    assert capsys.readouterr().err == ""


def test_analysed_as_it_was_drawn(drawn, capsys):
    facts = []
    for name in ("a.ora", "a.png"):
        assert main(["analyse", str(drawn / name), "--json"]) == 0
        facts.append(json.loads(capsys.readouterr().out))
    assert facts[0]["colours"] == facts[1]["colours"] > 40


def test_a_layer_with_nothing_but_examples_is_not_told_to_be_empty(drawn, capsys):
    assert main(["info", str(drawn / "a.ora")]) == 0
    told = capsys.readouterr().out
    assert "0 bytes; no paint\n    example 'weave' at depth 0" in told
    assert "empty" not in told


@pytest.mark.parametrize("command", ["export", "analyse"])
def test_told_if_it_is_not_what_it_was(drawn, tmp_path, capsys, command):
    with zipfile.ZipFile(drawn / "a.ora") as old, zipfile.ZipFile(tmp_path / "a.ora", "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name == MANIFEST:
                told = json.loads(data)
                told["layers"][0]["plots"][0]["crc"] ^= 1
                data = json.dumps(told).encode()
            new.writestr(name, data)
    assert main([command, str(tmp_path / "a.ora"), *([str(tmp_path / "a.png")] if command == "export" else [])]) == 0
    assert capsys.readouterr().err == f"inkfall: {tmp_path / 'a.ora'}: {OTHERWISE}\n"
