"""Brush presets: files in, files out, and damaged ones."""

from pathlib import Path

import pytest

from engine.brush.checks import BrushError
from engine.brush.kinds import check
from engine.brush.presets import Preset, load, load_folder, save
from engine.brush.settings import Brush, from_json

BUNDLED = Path(__file__).parents[3] / "palettes" / "brushes"

DAMAGED = {
    "empty": b"",
    "not json": b'{"name": "a"',
    "list": b"[]",
    "no name": b'{"brush": {}}',
    "no brush": b'{"name": "a"}',
    "bad radius": b'{"name": "a", "brush": {"radius": -3}}',
    "nan": b'{"name": "a", "brush": {"radius": NaN}}',
    "infinite": b'{"name": "a", "brush": {"radius": 1e999}}',
    "twice": b'{"name": "a", "name": "b", "brush": {}}',
    "latin": b'{"name": "\xe9", "brush": {}}',
    "deep": b"[" * 100_000,
    "digits": b'{"name": "a", "brush": {"radius": ' + b"1" * 5000 + b"}}",
    "huge": b" " * 300_000,
    "group": b'{"name": "a", "group": 3, "brush": {}}',
}


def test_round_trip(tmp_path):
    preset = Preset(
        "Grüner Stift", from_json({"radius": 3, "later": [1]}), "Meine", from_json({"kept": {"a": 1}}).extra
    )
    save(tmp_path / "a.json", preset)
    assert load(tmp_path / "a.json") == preset
    save(tmp_path / "a.json", Preset("Other", Brush()))
    assert load(tmp_path / "a.json").name == "Other"
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


@pytest.mark.parametrize("case", DAMAGED)
def test_a_damaged_file_is_one_line(tmp_path, case):
    path = tmp_path / "brush.json"
    path.write_bytes(DAMAGED[case])
    with pytest.raises(BrushError) as caught:
        load(path)
    line = str(caught.value)
    assert line.startswith(str(path))
    assert "expected" in line
    assert "\n" not in line


def test_a_folder_gives_its_good_presets_and_tells_of_the_others(tmp_path):
    save(tmp_path / "z.json", Preset("A", Brush(), "G"))
    save(tmp_path / "b.json", Preset("B", Brush(), "G"))
    (tmp_path / "bad.json").write_bytes(b"{")
    (tmp_path / "folder.json").mkdir()
    (tmp_path / "readme.txt").write_text("no preset")
    presets, faults = load_folder(tmp_path)
    assert [p.name for p in presets] == ["A", "B"]
    assert len(faults) == 2
    assert load_folder(tmp_path / "missing") == ([], [])


def test_the_bundled_presets_are_usable():
    presets, faults = load_folder(BUNDLED)
    assert not faults
    assert {"Pencil", "Soft airbrush", "Eraser"} <= {p.name for p in presets}
    for preset in presets:
        check(preset.brush)
