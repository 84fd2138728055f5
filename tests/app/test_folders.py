"""What file dialogs list: names, sizes, dates, and small pictures."""

import os
import time

import numpy as np
import pytest
from PIL import Image

from app.desk import previews
from app.desk.files import carried_out
from app.desk.folders import ReadFolder, size_text
from app.desk.previews import FileRow, InTurn, Previews, small_picture
from engine.painting.value import Painting
from engine.studio.filing import documents


def listed(folder, endings=(".png", ".ora")):
    """What a dialog hears of a folder."""
    heard = []
    done = carried_out(ReadFolder(folder, endings, lambda *told: heard.append(told)))
    done.arrive(None)
    return heard[0]


def test_folders_come_first_and_only_files_with_the_endings(tmp_path):
    for name in ("b.PNG", "A.png", "c.txt", ".hidden.png"):
        (tmp_path / name).write_bytes(b"12345")
    (tmp_path / "zoo").mkdir()
    (tmp_path / "gone.png").symlink_to(tmp_path / "nothing")
    os.utime(tmp_path / "A.png", (1_700_000_000, 1_700_000_000))
    folder, rows, fault = listed(tmp_path)
    assert (folder, fault) == (tmp_path, "")
    assert [row.name for row in rows] == ["zoo", "A.png", "b.PNG", "gone.png"]
    assert [row.folder for row in rows] == [True, False, False, False]
    assert rows[1].size == 5
    assert rows[1].date == time.strftime("%Y-%m-%d %H:%M", time.localtime(1_700_000_000))


def test_a_folder_that_cannot_be_read_is_told(tmp_path):
    _, rows, fault = listed(tmp_path / "none")
    assert rows == ()
    assert "none" in fault


@pytest.mark.parametrize(
    ("size", "text"),
    [(0, "0 bytes"), (999, "999 bytes"), (1000, "1.0 kB"), (9949, "9.9 kB"), (9960, "10 kB"), (999_700, "1.0 MB"),
     (45_000_000, "45 MB"), (3 * 10**15, "3000 TB")],
)  # fmt: skip
def test_sizes_have_three_digits(size, text):
    assert size_text(size) == text


def test_a_picture_lies_on_paper_in_the_middle_of_its_field(tmp_path):
    pixels = np.zeros((20, 40, 4), np.uint8)
    pixels[:, :20] = 200, 10, 10, 255
    Image.fromarray(pixels).save(tmp_path / "half.png")
    small = small_picture(tmp_path / "half.png", 32)
    assert small.shape == (32, 32, 4)
    assert (small[..., 3] == 255).all()
    assert (small[:7] == previews.FIELD).all()
    assert abs(small[16, 4].astype(int) - (200, 10, 10, 255)).max() < 4
    assert abs(small[16, 28].astype(int) - previews.PAPER).max() < 4


def test_files_without_a_picture_have_none(tmp_path):
    whole = tmp_path / "whole.png"
    Image.new("RGB", (50, 50)).save(whole)
    for name, data in (("torn.png", whole.read_bytes()[:60]), ("empty.jpg", b""), ("no.ora", b"PK\3\4 no")):
        (tmp_path / name).write_bytes(data)
        assert small_picture(tmp_path / name, 16) is None
    assert small_picture(tmp_path / "not-there.png", 16) is None


def test_a_painting_shows_its_thumbnail(tmp_path):
    documents.save(tmp_path / "empty.ora", Painting(), None)
    assert small_picture(tmp_path / "empty.ora", 16).shape == (16, 16, 4)


def test_what_is_wanted_as_the_thread_ends_is_done():
    done = []
    for n in range(60):
        turn = InTurn("one", done.append)
        turn.want([n])
        while len(done) == 2 * n:  # it has done what there was, and is about to end
            time.sleep(0)
        turn.want([-n])
        turn.thread.join(90)
        assert done[2 * n :] == [n, -n]
        assert not turn.busy


def test_pictures_are_made_once_and_again_when_the_file_has_changed(tmp_path):
    Image.new("RGB", (8, 8)).save(tmp_path / "a.png")
    shelf = Previews(lambda: None)
    rows = FileRow("a.png", False, 10, 1), FileRow("a.txt", False), FileRow("b", True)
    found = []

    def ask(rows, count):
        shelf.ask(tmp_path, rows, 8)
        end = time.monotonic() + 90
        while len(found) < count and time.monotonic() < end:
            found.extend(shelf.take())
            time.sleep(0.01)

    ask(rows, 1)
    ask(rows, 1)
    ask((rows[0]._replace(changed=2),), 2)
    assert [picture.ident for picture in found] == [
        previews.ident(tmp_path, rows[0]),
        previews.ident(tmp_path, rows[0]._replace(changed=2)),
    ]
