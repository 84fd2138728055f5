"""Brushes of the artist's own: under the name that was asked for, none lost to another."""

import json

import pytest
from immutables import Map

from app.desk import presets
from app.desk.presets import Preset
from engine.brush.settings import Brush, Component


def test_a_saved_brush_is_read_again_with_all_it_has(tmp_path):
    ink = (Component("rock", 0.4, "#c04020", Map({"period": 20.0}), ((0.0, 1.0), (1.0, 0.0))),)
    brush = Brush(radius=30.0, mode="raster", op=Map({"name": "contrast", "gain": 2.0}), ink=ink, shaping="negate")
    path = presets.save_brush(Preset("Größe à la main", brush), tmp_path / "brushes")
    found, faults = presets.load_brushes(tmp_path / "brushes")
    assert not faults
    assert found == [Preset("Größe à la main", brush, path, "Own")]


def test_saving_again_replaces_and_another_name_never_does(tmp_path):
    presets.save_brush(Preset("A b", Brush(radius=1.0)), tmp_path)
    presets.save_brush(Preset("A b", Brush(radius=2.0)), tmp_path)
    presets.save_brush(Preset("a-B", Brush(radius=3.0)), tmp_path)
    found, _ = presets.load_brushes(tmp_path)
    assert {p.name: p.brush.radius for p in found} == {"A b": 2.0, "a-B": 3.0}
    assert not list(tmp_path.glob("*.part"))


def test_a_brush_of_ones_own_can_be_deleted_and_twice_is_no_fault(tmp_path):
    presets.save_brush(Preset("A", Brush()), tmp_path)
    presets.save_brush(Preset("B", Brush()), tmp_path)
    first, _ = presets.load_brushes(tmp_path)
    presets.delete(first[0])
    presets.delete(first[0])
    assert [preset.name for preset in presets.load_brushes(tmp_path)[0]] == ["B"]


@pytest.mark.parametrize("name", ["", "   ", "///", "..", "CON", "x" * 500, "a\nb\0c"])
def test_any_name_can_be_saved(name, tmp_path):
    name = presets.free_brush_name(name, ())
    path = presets.save_brush(Preset(name, Brush()), tmp_path)
    assert path.parent == tmp_path
    assert json.loads(path.read_text("utf-8"))["name"] == name
    assert len(path.name) < 60


def test_a_bundled_brush_keeps_its_name_for_itself():
    bundled, _ = presets.load_brushes(presets.bundled_folder())
    assert presets.free_brush_name("Pencil", bundled) == "Pencil 2"
    assert presets.free_brush_name("  my   own ", bundled) == "my own"


def test_brushes_are_found_by_group_or_by_words_of_any():
    made = [("Pencil", "Basic"), ("Charcoal stick", "Dry media"), ("Charcoal cliff", "Rock & earth"), ("Mine", "Own")]
    all_of_them = tuple(Preset(name, Brush(), None, group) for name, group in made)

    def names(group, words):
        return [(title, [p.name for p in members]) for title, members in presets.found(all_of_them, group, words)]

    assert [title for title, _ in names("", "")] == ["Basic", "Dry media", "Rock & earth", "Own"]
    assert names("Basic", " ") == [("Basic", ["Pencil"])]
    assert names("Basic", "CHAR") == [("Dry media", ["Charcoal stick"]), ("Rock & earth", ["Charcoal cliff"])]
    assert names("", "rock char") == [("Rock & earth", ["Charcoal cliff"])]
    assert names("", "oil") == []
    assert names("No such", "") == []


def test_enter_takes_the_brush_whose_name_is_nearest():
    made = [("Ink spatter", "Wet media"), ("Wet in wet", "Wet media"), ("Soft eraser", "Basic"), ("Eraser", "Basic")]
    made += [("Moss carpet", "Ground"), ("Moss", "Plants")]
    all_of_them = tuple(Preset(name, Brush(), None, group) for name, group in made)
    for words, name in (
        ("wet in wet", "Wet in wet"),
        ("Wet", "Wet in wet"),
        ("eras", "Eraser"),
        ("wet  INK", "Ink spatter"),
        ("moss", "Moss"),
        ("moss ", "Moss"),
    ):
        nearest = presets.nearest(all_of_them, words)
        assert nearest is not None
        assert nearest.name == name
    assert presets.nearest(all_of_them, " ") is None
    assert presets.nearest(all_of_them, "oil") is None
