"""The pictures of many placements in a file: small, and what each of them shows, for programs that know none."""

import zipfile
from dataclasses import replace
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.session.session import Session

FRAME = Rect(0, 0, 200, 150)


def strewn(count):
    """A painting with placements of a layer and of a group all over its frame, exact and turned."""
    session = Session()
    for command in (
        {"do": "layer", "add": "Leaf"},
        {"do": "stroke", "points": [[5, 5], [25, 15]], "brush": {"radius": 5}},
        {"do": "layer", "add": "Two", "kind": "group", "group": None},
        {"do": "layer", "add": "Inner", "group": "Two"},
        {"do": "stroke", "points": [[-20, 30], [4, 12]], "brush": {"radius": 3, "colour": "#a03010"}},
    ):
        session.do(c.parse(command))
    root = session.painting.root
    of = [layers.find(root, name).id for name in ("Leaf", "Two")]
    made = tuple(
        Placement(
            100 + n,
            f"copy {n}",
            of=of[n % 2],
            pose=Pose(
                at=(n * 37 % 260 - 30, n * 23 % 200 - 20),
                turned=(0.8, 0.6) if n % 3 == 0 else None,
                turn=n % 4 if n % 3 else 0,
            ),
        )
        for n in range(count)
    )
    return replace(session.painting, root=replace(root, children=(*root.children, *made)), frame=FRAME)


@pytest.mark.parametrize("count", [4, 34])
def test_each_is_what_the_placement_shows_within_its_frame(count, tmp_path):
    painting, path = strewn(count), tmp_path / "strewn.ora"
    save(path, Snapshot(painting))
    areas = []
    with zipfile.ZipFile(path) as file:
        told = {one.get("src"): one for one in ElementTree.fromstring(file.read("stack.xml")).iter("layer")}
        for node in painting.root.children[2:]:
            name = f"data/L{node.id}.png"
            picture = np.asarray(Image.open(BytesIO(file.read(name))))
            y, x = int(told[name].get("y", 0)), int(told[name].get("x", 0))
            whole = np.zeros((FRAME.height, FRAME.width, 4), np.uint8)
            whole[y : y + picture.shape[0], x : x + picture.shape[1]] = picture
            shown = composite(layers.alone(node, painting.root), 0, FRAME, layer_planes)
            np.testing.assert_array_equal(whole, to_rgba8(shown))
            areas.append(picture.shape[0] * picture.shape[1])
    assert (max(areas) < FRAME.area / 4) == (count > 32)  # few are as large as the frame, as they always were
