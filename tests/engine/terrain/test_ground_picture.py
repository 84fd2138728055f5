"""A height map as the ground of the land: 16 bits of it are kept, and it is the only layer of heights."""

import numpy as np
from PIL import Image

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.session import Session
from engine.terrain.plane import heights_of, land

SIDE = 32
RECT = Rect.at(5, 7, SIDE, SIDE)


def test_a_height_map_is_the_ground_and_another_one_takes_its_place(tmp_path):
    codes = np.random.default_rng(5).integers(0, 1 << 16, (SIDE, SIDE), np.uint16)
    Image.fromarray(codes).save(tmp_path / "map.png")
    session = Session(Painting(Rect.at(0, 0, 64, 64), 1))
    session.do(c.parse({"do": "texture", "name": "map", "maker": "image", "path": str(tmp_path / "map.png")}))
    told = {"do": "layer", "kind": "picture", "texture": "map", "at": [5, 7], "role": "height"}
    session.do(c.parse({**told, "add": "First"}))
    session.do(c.parse({**told, "add": "Second"}))
    assert heights_of(session.painting).name == "Second"
    assert [node.role for node in session.painting.root.children] == ["", "height"]
    found = land(session.painting, scale=100.0).height(0, RECT)
    assert np.abs(found - codes / 65535 * 100).max() < 100 * 2**-16
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    (tmp_path / "map.png").unlink()
    again = land(open_painting(tmp_path / "a.ora").painting, scale=100.0)
    assert np.array_equal(again.height(0, RECT), found)
    session.do(c.Undo())
    assert heights_of(session.painting).name == "First"
