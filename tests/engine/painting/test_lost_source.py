"""A file whose placement shows what is not there: its picture stands for it, and a line tells so."""

import json
import zipfile

import numpy as np
import pytest
from test_selecting import GROUND, seen, told

from engine.archive.manifest import MANIFEST
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.layers import Layer
from engine.numeric.address import Rect
from engine.session.session import Session

AGAIN = {"do": "layer", "add": "Again", "kind": "placement", "of": "Paint", "at": [300, 40], "c": [0.8, 0.6]}
THIN = {"do": "layer", "set": "Again", "opacity": 0.5}


def altered(path, to, source):
    """A copy of a file whose placement shows the node of another number."""
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(to, "w") as new:
        for info in old.infolist():
            data = old.read(info)
            if info.filename == MANIFEST:
                manifest = json.loads(data)
                manifest["layers"][-1]["source"] = source
                data = json.dumps(manifest).encode()
            new.writestr(info, data)


@pytest.mark.parametrize("frame", [[0, 0, 500, 300], [-40, -20, 9000, 9000]])
def test_what_shows_what_is_not_there_is_opened_as_its_picture(tmp_path, frame):
    session = told(Session(GROUND), {"do": "frame", "rect": frame}, AGAIN, THIN)
    save(tmp_path / "whole.ora", Snapshot(session.painting))
    altered(tmp_path / "whole.ora", tmp_path / "lost.ora", 77)
    opened = open_painting(tmp_path / "lost.ora")
    assert opened.native
    assert "layer 'Again': what it shows is not in the file; its picture stands for it" in opened.notes
    layer = layers.find(opened.painting.root, "Again")
    assert isinstance(layer, Layer)
    assert layer.opacity == 0.5
    level, rect = (0, Rect(300, 40, 460, 250)) if frame[2] < 9000 else (-3, Rect(300, 40, 460, 250))
    before, after = seen(session.painting, level, rect), seen(opened.painting, level, rect)
    assert before.any()
    np.testing.assert_allclose(after, before, atol=1.5 / 255 if level == 0 else 0.1)
    save(tmp_path / "again.ora", Snapshot(opened.painting))
    once_more = open_painting(tmp_path / "again.ora")
    assert not once_more.notes
    assert (seen(once_more.painting, level, rect) == after).all()
