"""Recording files: read strictly, written back with all that they held."""

import pytest

from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.painting import recording as r
from engine.painting.commands import AddLayer, Redo, RemoveLayer, Stroke, Undo, View

HEADER = '{"inkfall": 1, "frame": [0, 0, 64, 48], "seed": 7}'
STROKE = '{"do": "stroke", "level": 0, "origin": [3, 4], "points": [[0, 0], [9.5, 2, 0.25]], "brush": {"radius": 3}}'


def stored(tmp_path, text):
    path = tmp_path / "a.jsonl"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_reads_what_the_contract_says(tmp_path):
    found = r.read(stored(tmp_path, f"{HEADER}\n{STROKE}\n"))
    assert found.header.frame == Rect.at(0, 0, 64, 48)
    assert found.header.seed == 7
    assert found.folder == tmp_path
    (stroke,) = found.commands
    assert isinstance(stroke, Stroke)
    assert stroke.origin == (3, 4)
    assert stroke.brush.radius == 3.0


@pytest.mark.parametrize(
    "text",
    [f"\ufeff{HEADER}\n{STROKE}", f"\n{HEADER}\r\n\r\n   \n{STROKE}\r\n\n", f"{HEADER}\n{STROKE}".encode()],
    ids=["byte order mark", "blank lines, CRLF", "no last newline"],
)
def test_line_ends_and_marks(tmp_path, text):
    assert len(r.read(stored(tmp_path, text)).commands) == 1


def test_written_and_read_back(tmp_path):
    text = (
        '{"inkfall": 1, "frame": [-5, 0, 64, 48], "seed": -7, "by": "me"}\n' + STROKE + '\n{"do": "undo", "why": [1]}\n'
    )
    first = r.read(stored(tmp_path, text))
    r.write(first, tmp_path / "b.jsonl")
    again = r.read(tmp_path / "b.jsonl")
    assert again.header == first.header
    assert again.commands == first.commands
    assert again.header.extra["by"] == "me"


HOSTILE = {
    "empty": ("", "found no line"),
    "blank": ("\n\n", "found no line"),
    "no header": (STROKE, "line 1: header: found no member inkfall"),
    "newer": (
        '{"inkfall": 3}',
        "line 1: header.inkfall: found 3 (a newer Inkfall wrote this), expected a version up to 2",
    ),
    "version a word": ('{"inkfall": "1"}', "header.inkfall: found"),
    "version nan": ('{"inkfall": NaN}', "line 1: found NaN"),
    "frame of three": ('{"inkfall": 1, "frame": [0, 0, 1]}', "header.frame: found"),
    "empty frame": ('{"inkfall": 1, "frame": [0, 0, 0, 5]}', "header.frame: found"),
    "frame too large": ('{"inkfall": 1, "frame": [0, 0, 9999999999999, 5]}', "header.frame: found"),
    "seed a float": ('{"inkfall": 1, "seed": 0.5}', "header.seed: found 0.5"),
    "no object": (f"{HEADER}\n[]", "line 2: found [], expected an object"),
    "bad line": (f"{HEADER}\n\n{STROKE}\n{{", "line 4: column 2: found"),
    "infinity": (f'{HEADER}\n{{"do": "view", "level": 1e999}}', "line 2: found '1e999'"),
    "twice": (f'{HEADER}\n{{"do": "undo", "do": "redo"}}', "line 2: found 'do' given twice"),
    "deep": (f"{HEADER}\n{'[' * 200_000}", "line 2: found brackets nested too deeply"),
    "binary": (b"\x89PNG\r\n\x1a\n\x00\x00", "line 1: byte 1: found bytes that are not UTF-8"),
    "zip": (b"PK\x03\x04\x14\x00\x00\x00", "line 1"),
    "utf-16": ("\ufeff" + HEADER, None),
    "long line": (f"{HEADER}\n{' ' * (9 << 20)}", "line 2: found more than 8 MiB"),
}


@pytest.mark.parametrize(("text", "message"), HOSTILE.values(), ids=HOSTILE)
def test_what_is_wrong_is_named_with_file_and_line(tmp_path, text, message):
    path = stored(tmp_path, text.encode("utf-16") if message is None else text)
    with pytest.raises(FileError) as caught:
        r.read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert (message or "line 1") in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_or_a_folder(tmp_path):
    for path in (tmp_path / "none.jsonl", tmp_path):
        with pytest.raises(FileError, match="cannot be read"):
            r.read(path)


def test_an_endless_line_is_given_up_early():
    class Endless:
        given = 0

        def readline(self, limit):
            self.given += limit
            return b"x" * limit

    source = Endless()
    with pytest.raises(FileError, match="more than 8 MiB"):
        r.read_from(source, "pipe")
    assert source.given < 9 << 20


@pytest.mark.parametrize(
    ("commands", "reach"),
    [
        ([], 0),
        ([AddLayer("a")], 0),
        ([AddLayer("a"), Undo(5)], 1),
        ([AddLayer("a"), AddLayer("b"), Undo(), Undo(), Redo(), Undo()], 2),
        ([AddLayer("a"), AddLayer("b"), Undo(), RemoveLayer("a"), Undo(), Undo()], 2),
        ([AddLayer("a"), AddLayer("b"), Undo(), RemoveLayer("a"), Undo()], 1),
        ([AddLayer("a"), View(), AddLayer("b"), AddLayer("c"), Undo(2)], 2),
        ([AddLayer("a"), AddLayer("b"), AddLayer("c"), Undo(2), AddLayer("b"), Undo(2)], 3),
    ],
)
def test_how_far_undo_goes(commands, reach):
    assert r.undo_reach(commands, frozenset({AddLayer, RemoveLayer, Stroke})) == reach
