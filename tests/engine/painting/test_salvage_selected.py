"""Damaged paintings with selections, masks, clipping, placements and picture layers: what can be had of them is had, as
`test_salvage` tells it; of selections and masks all levels coarser than those of damaged blocks, bit for bit."""

import numpy as np
import pytest
from PIL import Image
from test_salvage import (
    FRAME,
    MANIFESTS,
    RECORDING,
    all_can_be_had,
    anything_can_be_had,
    coarsest_lost,
    cuts,
    file_of,
    flips,
    packs_of,
    residuals,
    same,
    same_residuals,
    stroke,
)

from engine.canvas import layers
from engine.canvas.placing.placement import Placement
from engine.canvas.tile_cache import TileCache
from engine.files.fault import FileError
from engine.painting import commands as c
from engine.session.apply import Painting
from engine.session.damaged import open_or_salvage
from engine.session.session import Session

COMMANDS = (
    {"do": "texture", "name": "leaf", "maker": "image", "path": "leaf.png"},
    {"do": "layer", "add": "Photo", "kind": "picture", "texture": "leaf", "at": [10, 20]},
    {"do": "layer", "add": "A"},
    stroke(0, 60),
    stroke(80, 120, level=1, radius=12),
    {"do": "select", "ellipse": [0, -10, 20, 90, 70], "feather": 6, "keep": "round"},
    {"do": "layer", "set": "A", "mask": True},
    {"do": "layer", "add": "Group", "kind": "group", "group": None},
    {"do": "layer", "add": "B", "group": "Group"},
    stroke(20, 40, colour="#20a040"),
    {"do": "select", "rect": [-1, -10, 10, 30, 30], "keep": "box"},
    {"do": "select", "invert": True},
    {"do": "layer", "set": "Group", "mask": True},
    {"do": "layer", "add": "C", "group": None},
    {"do": "layer", "add": "Over", "group": None},
    stroke(10, 50, colour="#2040a0"),
    {"do": "layer", "set": "Over", "clip": True},
    {"do": "layer", "add": "Again", "kind": "placement", "of": "A", "at": [30, -10], "turn": 1, "group": None},
    {"do": "select", "outline": [[0, 20], [80, 40], [20, 90]], "feather": 3},
)


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pictures")
    y, x = np.mgrid[0:24, 0:40]
    pixels = np.stack([x * 6, y * 10, x * 3 + y, 255 - x * 2], axis=-1).astype(np.uint8)
    Image.fromarray(pixels).save(folder / "leaf.png")
    session = Session(Painting(FRAME, 11), TileCache(64 << 20), folder=folder)
    for command in COMMANDS:
        session.do(c.parse(command))
    return session


@pytest.fixture(scope="module", params=[True, False], ids=["recorded", "unrecorded"])
def file(session, request, tmp_path_factory):
    return file_of(session, tmp_path_factory.mktemp("saved"), recorded=request.param)


def selections(painting):
    """All of them, by what they are."""
    found = {("kept", name): one for name, one in painting.selections.items()}
    found |= {"selected": painting.selection} if painting.selection is not None else {}
    masked = (node for node in layers.walk(painting.root) if not isinstance(node, Placement) and node.mask is not None)
    return found | {("mask", node.name): node.mask for node in masked}


def packs_of_selections(file):
    """The packs of each of them, by the manifest as it was."""
    names = {node.id: node.name for node in layers.walk(file.painting.root)}
    for told in file.manifest["selections"]:
        what = ("mask", names[told["masks"]]) if "masks" in told else ("kept", told["name"]) if "name" in told else ""
        yield what or "selected", [member for member, *_ in told["packs"]]


def same_selections(one, other):
    one, other = selections(one), selections(other)
    return one.keys() == other.keys() and all(
        (a.inverse, a.off) == (other[what].inverse, other[what].off)
        and same_residuals(residuals(a.pyramid), residuals(other[what].pyramid))
        for what, a in one.items()
    )


def coarse(pyramid, missing):
    return {key: at for key, at in residuals(pyramid).items() if key.level < missing}


def lost_of_parts(file, damaged, painting):
    for layer in layers.layers(file.painting.root):
        if layer.name != "Photo":  # its ground is a picture of its own
            torn = [member for member in packs_of(file, layer.name) if not file.whole(member, damaged)]
            missing = min((coarsest_lost(file, member, damaged) for member in torn), default=99)
            now = layers.find(painting.root, layer.name).pyramid
            if not same_residuals(coarse(layer.pyramid, missing), coarse(now, missing)):
                yield f"levels of {layer.name} coarser than {missing}"
    before, after = selections(file.painting), selections(painting)
    for what, packs in packs_of_selections(file):
        torn = [member for member in packs if not file.whole(member, damaged)]
        missing = min((coarsest_lost(file, member, damaged) for member in torn), default=99)
        wanted = coarse(before[what].pyramid, missing)
        if wanted and what not in after:
            yield f"{what}, of which levels coarser than {missing} are whole"
        elif what in after and not same_residuals(wanted, coarse(after[what].pyramid, missing)):
            yield f"levels of {what} coarser than {missing}"


def lost_of(file, damaged, folder):
    """Says what is lost that can be had; "" for nothing."""
    path = folder / "damaged.ora"
    path.write_bytes(damaged)
    try:
        found = open_or_salvage(path)
    except FileError as error:
        recorded = RECORDING in file.members
        return f"refused: {error}" if (anything_can_be_had(file, damaged) if recorded else seen(file, damaged)) else ""
    if not found.native and not found.notes:
        return "nothing is told"
    if all_can_be_had(file, damaged):
        right = same(found.painting, file.painting) and same_selections(found.painting, file.painting)
        return "" if right else "not all of the paint, or of what is selected"
    if found.native:
        return "nothing is told"
    known = any(file.whole(name, damaged) for name in MANIFESTS)
    return "; ".join(lost_of_parts(file, damaged, found.painting)) if known else ""


def seen(file, damaged):
    return any(file.whole(name, damaged) for name in (*MANIFESTS, "mergedimage.png"))


def all_lost(file, damaged, folder):
    told = ((place, lost_of(file, bad, folder)) for place, bad in damaged)
    return {place: lost for place, lost in told if lost}


def test_no_flip_and_no_cut_loses_what_can_be_had(file, tmp_path):
    assert file.painting.selection is not None
    some = [*list(flips(file.data, 150, seed=8))[::10], *list(cuts(file.data, 64))[::10]]
    assert not all_lost(file, some, tmp_path)


@pytest.mark.nightly
def test_none_of_many_does(file, tmp_path):
    assert not all_lost(file, [*flips(file.data, 150, seed=8), *cuts(file.data, 64)], tmp_path)


def bad_in(file, member):
    """The file with a bit flipped in the middle of a member, where it is long enough."""
    own = file.members[member]
    bad = bytearray(file.data)
    bad[(own.start + own.stop) // 2] ^= 1
    return bytes(bad)


def test_every_member_of_a_selection_and_a_layer_is_had_as_far_as_it_is_whole(session, tmp_path):
    file = file_of(session, tmp_path, recorded=False)
    packs = [name for name in file.members if name.endswith(".tiles")]
    assert sum("selections" in name for name in packs) >= 5
    assert not all_lost(file, ((name, bad_in(file, name)) for name in packs), tmp_path)


def test_a_masked_picture_does_not_take_paint_away(session, tmp_path):
    """What the mask hides is in the layer's packs alone, not in its picture."""
    file = file_of(session, tmp_path, recorded=False)
    member = packs_of(file, "A")[-1]
    path = tmp_path / "damaged.ora"
    path.write_bytes(bad_in(file, member))
    found = open_or_salvage(path)
    kept = layers.find(found.painting.root, "A")
    hidden = [node for node in layers.walk(found.painting.root) if not node.visible]
    assert kept.mask is not None
    assert [node.name for node in hidden] == ["As it was 1"]
    assert any("nothing stands in for that" in note for note in found.notes)
