"""Files of layers from other programs, brought into a painting as a group: one step, its pictures kept with it."""

import io
import random
import zipfile

import numpy as np
import pytest
from PIL import Image
from psd_tools import PSDImage
from psd_tools.constants import BlendMode, Compression

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.files.fault import FileError
from engine.files.layered import layer_sheet
from engine.files.layered.reading_layers import read_layers, read_sheet
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.colour import from_rgba8
from engine.painting import commands as c
from engine.painting.layering.pictures_member import BroughtGroup, BroughtPicture
from engine.painting.value import Painting, Refusal
from engine.session.replay import replay
from engine.session.session import Session

VIEW = Rect(-5, -5, 60, 50)


def pixels(seed, width, height):
    out = np.random.default_rng(seed).integers(0, 256, (height, width, 4), np.uint8)
    out[out[..., 3] == 0] = 0
    return out


def png(array):
    out = io.BytesIO()
    Image.fromarray(array).save(out, "PNG")
    return out.getvalue()


SKY, TREE, LEAF = pixels(1, 40, 30), pixels(2, 7, 20), pixels(3, 12, 5)
STACK = """<image version="0.0.3" w="40" h="30"><stack>
<stack name="Trees" opacity="0.5" composite-op="svg:multiply">
<layer name="Leaf" src="data/leaf.png" x="-3" y="4" visibility="hidden" composite-op="svg:nonesuch"/>
<layer name="Tree" src="data/tree.png" x="20" y="9" opacity="0.25"/></stack>
<layer name="Sky" src="data/sky.png"/></stack></image>"""


@pytest.fixture
def ora(tmp_path):
    path = tmp_path / "garden.ora"
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("mimetype", "image/openraster")
        file.writestr("stack.xml", STACK)
        for name, array in (("sky", SKY), ("tree", TREE), ("leaf", LEAF)):
            file.writestr(f"data/{name}.png", png(array))
    return path


@pytest.fixture
def psd(tmp_path):
    image = PSDImage.new("RGB", (40, 30))
    image.create_pixel_layer(Image.fromarray(SKY), name="Sky", compression=Compression.ZIP)
    group = image.create_group(name="Trees", opacity=128, blend_mode=BlendMode.MULTIPLY)
    tree = group.create_pixel_layer(Image.fromarray(TREE), name="Tree", top=9, left=20, opacity=51)
    tree.update_mask(Image.fromarray(TREE[2:, 3:, 3]), 11, 23)  # the library writes alpha as a mask
    leaf = group.create_pixel_layer(Image.fromarray(LEAF), name="Leaf", top=4, left=-3)
    leaf.visible, leaf.blend_mode, leaf.clipping = False, BlendMode.VIVID_LIGHT, True
    path = tmp_path / "garden.psd"
    image.save(path)
    return path


def children(found):
    def one(child):
        if isinstance(child, layer_sheet.FoundGroup):
            return BroughtGroup(child.name, children(child), child.opacity, child.visible, child.blend, child.isolated)
        part = (child.part.x0, child.part.y0, child.part.width, child.part.height)
        return BroughtPicture(child.name, part, child.at, child.opacity, child.visible, child.blend, child.clip)

    return tuple(map(one, found.children))


def brought(path, level=0, at=(0, 0)):
    session = Session(Painting(Rect(0, 0, 40, 30), arithmetic=EVERYWHERE))
    session.do(c.AddLayer("Below"))
    session.do(c.parse({"do": "texture", "name": "Garden", "maker": "image", "path": str(path)}))
    session.do(c.AddPictures("garden", "Garden", children(read_layers(path).root), level, at))
    return session


def seen(painting, level=0):
    return composite(painting.root, level, VIEW, layer_planes)


def layer_pixels(painting, name, level, rect):
    return layer_planes(layers.find(painting.root, name), level, rect, None)


@pytest.mark.parametrize("level", [0, 3, -2])
def test_an_ora_comes_in_as_a_group_of_its_layers(ora, level):
    painting = brought(ora, level, (5, 6)).painting
    group = layers.find(painting.root, "garden")
    assert [node.name for node in group.children] == ["Sky", "Trees"]
    trees = layers.find(painting.root, "Trees")
    assert (trees.opacity, trees.blend, trees.isolated) == (0.5, "multiply", True)
    leaf, tree = layers.find(painting.root, "Leaf"), layers.find(painting.root, "Tree")
    assert [(one.opacity, one.visible, one.blend) for one in (tree, leaf)] == [
        (0.25, True, "src-over"),
        (1.0, False, "src-over"),
    ]
    for name, array, at in (("Sky", SKY, (5, 6)), ("Tree", TREE, (25, 15)), ("Leaf", LEAF, (2, 10))):
        rect = Rect.at(*at, array.shape[1], array.shape[0])
        assert np.array_equal(layer_pixels(painting, name, level, rect), from_rgba8(array))
        around = layer_pixels(painting, name, level, rect.grown(9))
        around[:, 9:-9, 9:-9] = 0
        assert not around.any()
    assert painting.active == "garden"


def test_a_psd_comes_in_likewise(psd):
    painting = brought(psd).painting
    trees, tree = layers.find(painting.root, "Trees"), layers.find(painting.root, "Tree")
    leaf = layers.find(painting.root, "Leaf")
    assert (trees.opacity, trees.blend) == (128 / 255, "multiply")
    assert tree.opacity == 51 / 255
    assert (leaf.visible, leaf.blend, leaf.clip) == (False, "src-over", True)
    masked = TREE.copy()
    masked[:2, :, 3] = masked[:, :3, 3] = 0
    for name, array, at in (("Sky", SKY, (0, 0)), ("Tree", masked, (20, 9)), ("Leaf", LEAF, (-3, 4))):
        rect = Rect.at(*at, array.shape[1], array.shape[0])
        assert np.array_equal(layer_pixels(painting, name, 0, rect), from_rgba8(array)), name
    (note,) = read_layers(psd).notes
    assert note == "layer 'Leaf': mode 'vivid light' is not known; shown as normal"


@pytest.mark.parametrize("kind", ["ora", "psd"])
def test_it_is_one_step_and_stays_with_the_painting(kind, request, tmp_path):
    path = request.getfixturevalue(kind)
    session = brought(path, 1, (3, -4))
    shown, before = seen(session.painting, 1), session.history.undo_count
    assert np.array_equal(seen(replay(session.recording()).painting, 1), shown)
    path.unlink()
    session.do(c.Undo())
    assert [node.name for node in layers.walk(session.painting.root)] == ["Below"]
    session.do(c.Redo())
    assert session.history.undo_count == before == 2
    assert np.array_equal(seen(session.painting, 1), shown)
    assert session.steps.root.children[1].children[0].name == "Sky"
    save(tmp_path / "ours.ora", Snapshot(session.painting, session.recording()))
    opened = open_painting(tmp_path / "ours.ora")
    assert np.array_equal(seen(opened.painting, 1), shown)
    again = Session(Painting(arithmetic=EVERYWHERE))
    again.pictures = opened.pictures
    for command in opened.recording.commands:
        again.do(command)
    assert np.array_equal(seen(again.painting, 1), shown)


def test_layers_of_8_and_16_bits_share_a_sheet(tmp_path):
    deep = PSDImage.new("RGB", (8, 8), depth=16)
    deep.create_pixel_layer(Image.fromarray(pixels(4, 8, 8)), name="Deep")
    deep.save(tmp_path / "deep.psd")
    assert read_sheet(tmp_path / "deep.psd", "deep.psd").dtype == np.uint16
    (one,) = read_layers(tmp_path / "deep.psd").root.pictures()
    found = read_sheet(tmp_path / "deep.psd", "deep.psd")[one.part.slices(Rect(0, 0, 8, 8))]
    assert np.array_equal(found, pixels(4, 8, 8).astype(np.uint16) * 257)


def test_a_photoshop_file_without_layers_is_one_picture(tmp_path):
    PSDImage.frompil(Image.fromarray(SKY[..., :3])).save(tmp_path / "flat.psd")
    found = read_layers(tmp_path / "flat.psd")
    assert [(one.name, one.size) for one in found.root.pictures()] == [("Picture", (40, 30))]
    assert np.array_equal(read_sheet(tmp_path / "flat.psd", "flat.psd")[..., :3], SKY[..., :3])


def test_what_does_not_fit_is_refused_in_a_line_and_nothing_is_brought_in(ora, monkeypatch):
    session = brought(ora)
    before, steps = session.painting, len(session.log)
    for children_, line in (
        ((BroughtPicture("Far", (30, 0, 90, 9)),), r"layer 'Far': found part \[30, 0, 90, 9\], expected one within .*"),
        ((BroughtPicture("Sky", (0, 0, 1, 1)),), "layer name: found 'Sky' twice, expected a name not in use"),
    ):
        with pytest.raises(Refusal, match=f"^{line}$"):
            session.do(c.AddPictures("more", "Garden", children_))
    assert session.painting is before
    assert len(session.log) == steps
    monkeypatch.setattr(layer_sheet, "SHEET", 900)
    with pytest.raises(FileError, match=r"its layers side by side have \d+ pixels; expected at most 900$"):
        read_layers(ora)


@pytest.mark.parametrize("kind", ["ora", "psd"])
def test_damaged_files_are_refused_in_a_line_or_read(kind, request, tmp_path):
    """Cut short, or with some bytes changed; nothing but a FileError comes of it."""
    data, chance = request.getfixturevalue(kind).read_bytes(), random.Random(9)
    path, refused = tmp_path / f"hurt.{kind}", list[str]()
    for turn in range(60):
        hurt = bytearray(data[: chance.randrange(len(data))] if turn % 3 == 0 else data)
        for _ in range(0 if turn % 3 == 0 else chance.choice((1, 4, 30))):
            hurt[chance.randrange(len(hurt))] = chance.choice((0, 255, chance.randrange(256)))
        path.write_bytes(hurt)
        try:
            read_layers(path)
            read_sheet(path, str(path))
        except FileError as error:
            refused.append(str(error))
    assert len(refused) > 20
    assert all(line.startswith(f"{path}: ") and "\n" not in line for line in refused)


@pytest.mark.parametrize(("at", "value"), [(12, b"\0\x3c"), (14, b"\x7f\xff\xff\xff"), (18, bytes(4))])
def test_a_head_that_no_photoshop_file_has_is_told_in_plain_words(psd, at, value):
    data = psd.read_bytes()
    psd.write_bytes(data[:at] + value + data[at + len(value) :])
    with pytest.raises(
        FileError, match=r"garden.psd: \d+ x \d+ pixels in \d+ channels; expected 1 to 300000 .*, 1 to 56"
    ):
        read_layers(psd)
