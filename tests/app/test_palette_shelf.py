"""Palettes that are brought in stay, under names of their own, and are written for others."""

from dataclasses import replace

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.files import carried_out
from app.desk.holding import kept_desk, palette_shelf
from app.desk.holding.palette_shelf import PALETTES, WritePalette, bring_palette, palette_to_write, shown_palette
from engine.files.swatches.colour_list import ColourList, NamedColour
from engine.files.swatches.palette_files import READERS, read_palette


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(palette_shelf, "palettes_folder", lambda: tmp_path / "palettes")
    monkeypatch.setattr(kept_desk, "kept_file", lambda: tmp_path / "desk.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.work = lambda job: carried_out(job).arrive(made)
    return made


def test_the_window_offers_all_that_can_be_read():
    assert tuple(READERS) == PALETTES


def test_a_palette_that_is_brought_in_is_shown_and_there_the_next_time(desk, tmp_path):
    (tmp_path / "a.gpl").write_text("GIMP Palette\nName: Sea\nColumns: 2\n0 0 255 blue\n0 255 0\n")
    for name in ("Sea", "Sea 2"):
        bring_palette(desk, tmp_path / "a.gpl")
        assert shown_palette(desk).name == name
    assert kept_desk.read_kept(kept_desk.kept_file())[0].palette == "Sea 2"
    found, faults = palette_shelf.load_palettes(tmp_path / "palettes")
    assert ({*found}, faults) == ({*desk.known.palettes}, [])


def test_one_that_is_none_is_refused_in_a_line_and_one_that_was_damaged_is_told(desk, tmp_path):
    (tmp_path / "a.kpl").write_bytes(b"nothing")
    bring_palette(desk, tmp_path / "a.kpl")
    assert desk.message.bad
    assert desk.message.text.startswith("No palette was brought in: a.kpl: ")
    assert not (tmp_path / "palettes").exists()
    (tmp_path / "palettes").mkdir()
    (tmp_path / "palettes" / "b.gpl").write_bytes(b"nothing")
    assert palette_shelf.load_palettes(tmp_path / "palettes")[1][0].startswith("b.gpl: line 1")


def test_what_is_shown_is_written_else_the_colours_painted_with(desk, tmp_path):
    desk.hand.colours = [(1.0, 0.0, 0.0), (0.0, 0.0, 0.0)]
    desk.work(WritePalette(palette_to_write(desk), tmp_path / "b.gpl"))
    assert [rgb for rgb, _ in read_palette(tmp_path / "b.gpl").colours] == desk.hand.colours
    shown = ColourList("Mine", (NamedColour((0.0, 1.0, 0.0), "green"),))
    desk.learn(palettes=(shown,))
    desk.kept = replace(desk.kept, palette="Mine")
    assert palette_to_write(desk) == shown
