"""The paintings that were opened last: the newest first, each once, and nothing lost where the list is damaged."""

from pathlib import Path

import pytest

from engine.keeping import opened_before as kept
from engine.keeping.opened_before import MOST_OPENED, folder_to_begin, opened_before, remember_opened


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "state_folder", lambda name: tmp_path)
    return tmp_path


def test_the_newest_is_first_each_is_there_once_and_the_oldest_go(tmp_path):
    for i in range(MOST_OPENED + 3):
        remember_opened(tmp_path / f"{i}.ora")
    found = remember_opened(tmp_path / "9.ora")
    assert found == opened_before()
    assert [path.stem for path in found[:4]] == ["9", "14", "13", "12"]
    assert len(found) == len(set(found)) == MOST_OPENED


@pytest.mark.parametrize("text", [b"", b"{}", b"[1, null, []]", b"\xff", b"[" * 5000])
def test_a_damaged_list_is_empty_and_begun_anew(tmp_path, text):
    (tmp_path / "paintings.json").write_bytes(text)
    assert opened_before() == ()
    assert remember_opened(tmp_path / "a ü.ora") == opened_before() == (tmp_path / "a ü.ora",)


def test_one_that_cannot_be_written_is_known_all_the_same(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "state_folder", lambda name: tmp_path / "missing")
    assert remember_opened(tmp_path / "a.ora") == (tmp_path / "a.ora",)


def test_one_begins_where_the_last_painting_is_else_with_the_pictures_else_at_home(tmp_path, monkeypatch):
    there, pictures = tmp_path / "art", tmp_path / "Pictures"
    monkeypatch.setattr("platformdirs.user_pictures_path", lambda: pictures)
    assert folder_to_begin(()) == Path.home()
    pictures.mkdir()
    assert folder_to_begin((there / "a.ora",)) == pictures
    there.mkdir()
    assert folder_to_begin((there / "a.ora",)) == there
