"""Pictures of examples: how they are made, when, and how large they are shown."""

from dataclasses import replace

from examples_at_hand import named

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
        made._thread.join(20)
    assert [picture.ident for picture in made.take()] == ["example bundled felt"] * 2
    assert len(woken) == 2


def test_thumbnails_grow_into_the_room_that_there_is():
    assert tile(26, (450.0, 280.0), 6.0, 16.0, 1.0) == 68.0  # the list scrolls
    wide = tile(26, (1096.0, 330.0), 6.0, 16.0, 1.0)
    assert 68.0 < wide < 104.0
    assert -(-26 // int(1102 / (wide + 6))) * (wide + 22) <= 330
    assert tile(3, (1096.0, 330.0), 6.0, 16.0, 1.5) == 156.0
