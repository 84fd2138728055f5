"""The real window starts with damaged files of the artist's own, and opens what is whole of a damaged painting."""

import numpy as np
import pytest
from PIL import Image

from engine.archive.saving import Snapshot, save
from engine.painting import commands as c
from engine.session.session import Session

pytestmark = pytest.mark.window


FRAME = slice(80, 595), slice(5, 695)  # rows and columns of the canvas on which the frame lies


def damaged(path):
    """A painting without a recording, two layers of it, the paint of the upper one damaged; and whole."""
    session = Session()
    for n, colour in enumerate(("#c04020", "#2040c0")):
        session.do(c.parse({"do": "layer", "add": f"Layer {n}"}))
        points = [[200, 200 + 200 * n], [800, 300 + 200 * n]]
        session.do(c.parse({"do": "stroke", "points": points, "brush": {"radius": 60, "colour": colour}}))
    whole = path.with_name("whole.ora")
    save(whole, Snapshot(session.painting))
    data = bytearray(whole.read_bytes())
    data[data.rindex(b"inkfall\x03") + 3000] ^= 8
    path.write_bytes(data)
    return whole


@pytest.mark.nightly
def test_damaged_files_are_told_kept_and_opened_as_far_as_they_are_whole(program, tmp_path):
    brushes, examples = tmp_path / "config" / "inkfall" / "brushes", tmp_path / "data" / "inkfall" / "examples"
    path = tmp_path / "lake.ora"
    whole = damaged(path)
    brushes.mkdir(parents=True)
    examples.mkdir(parents=True)
    Image.fromarray(np.zeros((9, 9, 3), np.uint8)).save(examples / "moss.png")
    torn = {
        brushes / "torn.json": b'{"name": "Torn", "brush": {"rad',
        examples / "moss.toml": b'title = "Moss"\nkappa = \xff',
        tmp_path / "config" / "inkfall" / "preferences.toml": b"[kept]\nversions = ",
        path: path.read_bytes(),
    }
    for file, data in torn.items():
        file.write_bytes(data)
    app = program(str(whole))
    app.wait_for("painting 1 shown")
    app.click("2 notes", "status")  # of the preferences, and of the others
    app.box("torn.json: Unterminated string starting at: line 1 column 28 (char 27)")
    assert ("", "2 files of brushes, examples and the desk are damaged; they are kept as they are") in app.boxes()
    app.keys("Escape")
    shown = app.canvas()
    app.keys("ctrl+o")
    app.box("name", "Open")
    app.settled()
    app.fill(str(path))
    app.keys("Return")
    app.wait_for("painting 2 shown")
    app.box("lake.ora: 2 things are not as they were", "status")
    # Beside the paint, a faint veil of the coarser levels stays where tiles of the level looked at are gone.
    seen = np.abs(app.canvas() - shown)[FRAME]
    assert seen.max() <= 4, "the picture of the layer does not stand in for its tiles"
    app.click("Details", "status")
    assert app.box("the file is damaged: this is a copy of what is whole of it")
    app.settled()
    app.keys("Escape")
    app.stroke((400, 300), (500, 350))
    app.keys("ctrl+s")
    app.box("name", "Save as")  # it is a new painting, and asks for a name
    app.keys("Escape")
    assert {file: file.read_bytes() for file in torn} == torn
