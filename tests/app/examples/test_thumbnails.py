"""Pictures of examples: how they are made, when, and how large they are shown."""

from dataclasses import replace

import numpy as np
from examples_at_hand import named
from immutables import Map
from PIL import Image

from app.desk.examples import thumbnails
from app.desk.examples.example_state import Entry
from app.panels.examples.examples_panel import tile
from engine.texture.example.parameters import Parameters


def test_a_thumbnail_is_cut_out_by_the_region(desk):
    seen = thumbnails.thumbnail(named(desk, "felt"), 64)
    assert seen.shape == (64, 64, 4)
    assert (seen[..., 3] == 255).all()
    assert (seen[0, 0, :3] == thumbnails.PAPER).all()
    assert (seen[32, 32, :3] != thumbnails.PAPER).any()


def test_thumbnails_are_made_once_and_again_for_another_region(desk, tmp_path):
    woken = []
    made = thumbnails.Shelf(lambda: woken.append(1))
    entry = named(desk, "felt")
    for known in (
        entry,
        entry,
        replace(entry, mask_sha="1"),
        Entry("no", "X", tmp_path / "no.png", None, Parameters(), True),
    ):
        made.ask((known,), 32)
        made._made.thread.join(90)
    assert [picture.ident for picture in made.take()] == ["example bundled felt"] * 2
    assert len(woken) == 2


def test_maps_that_are_pictures_are_read_once_as_dark_and_light_as_they_tell(desk, tmp_path):
    path = tmp_path / "sizes.png"
    Image.fromarray(np.array([[[0, 0, 0], [255, 255, 255], [90, 60, 30]]], np.uint8)).save(path)
    maps = Map({"size": Map({"path": str(path)}), "gone": str(tmp_path / "gone.png"), "rim": Map({"width": 9})})
    made = thumbnails.Shelf(lambda: None)
    for _ in range(2):
        made.ask((replace(named(desk, "felt"), maps=maps),), 32)
        made._made.thread.join(90)
    told = {picture.ident: picture.pixels for picture in made.take()}
    assert sorted(told) == ["example bundled felt", thumbnails.map_ident(str(path))]
    assert told[thumbnails.map_ident(str(path))].tolist() == [[[n, n, n, 255] for n in (0, 255, 60)]]


def test_thumbnails_grow_into_the_room_that_there_is():
    assert tile(26, (450.0, 280.0), 6.0, 16.0, 1.0) == 68.0  # the list scrolls
    wide = tile(26, (1096.0, 330.0), 6.0, 16.0, 1.0)
    assert 68.0 < wide < 104.0
    assert -(-26 // int(1102 / (wide + 6))) * (wide + 22) <= 330
    assert tile(3, (1096.0, 330.0), 6.0, 16.0, 1.5) == 156.0
