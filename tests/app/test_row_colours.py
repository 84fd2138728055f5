"""Colours of rows of the panel of layers are kept by paintings."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.files import carried_out
from app.desk.stack import row_colours
from app.desk.stack.row_colours import MOST_PAINTINGS, colour_rows, follow_rows, rows_of


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(row_colours, "_file", lambda: tmp_path / "state" / "rows.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.work = lambda job: carried_out(job).arrive(made)
    return made


def shown(desk, serial, path=None):
    desk.learn(scene=SimpleNamespace(serial=serial, path=path))
    follow_rows(desk)


def test_colours_are_there_again_with_their_painting_and_not_with_another(desk):
    shown(desk, 1)
    colour_rows(desk, ["Sky", "Sea"], "blue")
    shown(desk, 1, Path("a.ora"))  # it is saved
    colour_rows(desk, ["Sea"], "green")
    shown(desk, 2, Path("b.ora"))
    assert desk.stack.colours == {}
    shown(desk, 3, Path("a.ora"))
    assert desk.stack.colours == {"Sky": "blue", "Sea": "green"}
    colour_rows(desk, ["Sky", "Sea"], "")
    shown(desk, 4, Path("b.ora"))
    shown(desk, 5, Path("a.ora"))
    assert desk.stack.colours == {}


def test_a_damaged_file_is_told_in_a_line_and_put_aside(desk, tmp_path):
    (tmp_path / "state").mkdir()
    (tmp_path / "state" / "rows.json").write_text('{"a.ora": [3]}')
    shown(desk, 1, Path("a.ora"))
    assert desk.message.bad
    assert desk.message.text.startswith("rows.json: rows: found")
    colour_rows(desk, ["Sky"], "red")
    assert (tmp_path / "state" / "rows.damaged.json").exists()
    shown(desk, 2, Path("a.ora"))
    assert desk.stack.colours == {"Sky": "red"}
    assert rows_of({"a": {"Sky": "plaid", "Sea": "red"}}) == {"a": {"Sea": "red"}}
    assert len(rows_of({str(n): {} for n in range(MOST_PAINTINGS + 9)})) == MOST_PAINTINGS
