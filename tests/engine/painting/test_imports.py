"""Pictures and other programs' files as paintings."""

import io
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from engine.archive.imports import Pasted, clean_name, open_image, pasted
from engine.archive.members import LOST
from engine.archive.opening import open_painting
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.node_checks import MAX_NAME
from engine.files.fault import FileError
from engine.files.limits import LIMITS
from engine.files.png_writer import write_png
from engine.files.stack_xml import OURS
from engine.numeric.address import Rect
from engine.numeric.colour import from_rgba8, to_rgba8, to_rgba16
from engine.painting.rendering import strips


def image(height, width, seed=0, dtype=np.uint8):
    rng = np.random.default_rng(seed)
    pixels = rng.integers(0, np.iinfo(dtype).max + 1, (height, width, 4)).astype(dtype)
    pixels[::3, ::2, 3] = 0
    pixels[pixels[:, :, 3] == 0] = 0
    return pixels


def png(pixels):
    file = io.BytesIO()
    write_png(file, pixels)
    return file.getvalue()


def ora(stack, members, tmp_path, attributes='w="50" h="40"'):
    path = tmp_path / "a.ora"
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("mimetype", "image/openraster")
        file.writestr("stack.xml", f"<image {attributes}><stack>{stack}</stack></image>")
        for name, data in members.items():
            file.writestr(name, data)
    return path


# ---- pixels ----


def test_pasted_pixels_come_back_to_the_bit():
    pixels = image(300, 170)
    pyramid = pasted(iter(np.array_split(pixels, 7)), -37, 1000)
    shown = evaluate(pyramid, 0, Rect.at(-37, 1000, 170, 300)).rgba
    assert np.array_equal(shown, from_rgba8(pixels))
    assert np.array_equal(to_rgba8(shown), pixels)
    around = evaluate(pyramid, 0, Rect.at(-60, 980, 220, 340)).rgba
    assert not around[:, :20].any()
    assert not around[:, :, :23].any()


def test_pasted_in_bands_is_pasted_at_once(monkeypatch):
    pixels = image(400, 64)
    whole = pasted(iter([pixels]), 5, -70)
    monkeypatch.setattr("engine.archive.imports.PIXELS", 64 * 100)
    monkeypatch.setattr("engine.archive.grounds.LAID", 64 * 20)
    parts = pasted(iter(np.array_split(pixels, 40)), 5, -70)
    assert parts.last.depth > 2
    rect = Rect.at(5, -70, 64, 400)
    assert np.array_equal(evaluate(parts, 0, rect).data, evaluate(whole, 0, rect).data)
    coarse = rect.zoomed(-3).grown(1)
    assert np.abs(evaluate(parts, -3, coarse).data - evaluate(whole, -3, coarse).data).max() < 0.001


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_rows_whose_number_is_known_are_put_away_and_laid_as_at_once(monkeypatch, kind):
    pixels = image(300, 64, dtype=kind)
    whole = pasted(iter([pixels]), 5, -70)
    monkeypatch.setattr("engine.archive.grounds.LAID", 64 * 20)
    monkeypatch.setattr("engine.keeping.memory.budget", lambda: 1 << 12)
    parts = pasted(iter(np.array_split(pixels, 30)), 5, -70, height=300)
    assert parts.ground is not None
    for level in (0, -1, -3):
        rect = Rect.at(5, -70, 64, 300).zoomed(level).grown(1)
        assert np.array_equal(evaluate(parts, level, rect).data, evaluate(whole, level, rect).data)
    with parts.ground.pixels.opened() as file:
        assert file.read() == whole.ground.pixels


def test_no_room_on_disk_for_a_picture_is_told_in_a_line(tmp_path, monkeypatch):
    (tmp_path / "a.png").write_bytes(png(image(40, 64)))
    monkeypatch.setattr("engine.archive.grounds.LAID", 64)
    monkeypatch.setattr("engine.keeping.memory.budget", lambda: 1 << 10)
    monkeypatch.setattr("engine.keeping.disk_raster.spill_folder", lambda: tmp_path / "missing")
    with pytest.raises(FileError, match="cannot be put away on disk: No such file"):
        open_image(tmp_path / "a.png")


def test_16_bits_are_kept(tmp_path):
    pixels = image(20, 30, dtype=np.uint16)
    pixels[:, :, 3] = 65535
    (tmp_path / "a.png").write_bytes(png(pixels))
    shown = evaluate(layers.find(open_image(tmp_path / "a.png").painting.root, "a").pyramid, 0, Rect(0, 0, 30, 20))
    assert np.array_equal(to_rgba16(shown.rgba), pixels)


def test_empty_tiles_are_not_stored():
    pixels = np.zeros((400, 400, 4), np.uint8)
    pixels[300, 300] = 255
    assert len(Pasted(pixels, Rect(0, 0, 400, 400)).tiles) == 1
    assert not pasted(iter([np.zeros((5, 5, 4), np.uint8)]), 0, 0).levels


def test_a_picture_becomes_a_painting(tmp_path):
    Image.fromarray(image(20, 30)[:, :, :3]).save(tmp_path / "Ferns & co.jpg", quality=95)
    found = open_image(tmp_path / "Ferns & co.jpg")
    assert found.painting.frame == Rect(0, 0, 30, 20)
    assert found.painting.active == "Ferns & co"
    assert not found.native
    assert found.notes == ()


def test_names_are_made_fit():
    assert clean_name(" a\nb\u200b\x07 ", "x") == "a b"
    assert clean_name("\t", "Layer 1") == "Layer 1"
    assert len(clean_name("n" * 999, "x")) == MAX_NAME


# ---- OpenRaster ----


def test_layers_groups_and_modes(tmp_path):
    top, inner = image(10, 20, 1), image(40, 50, 2)
    path = ora(
        '<layer name="A" src="/data/a.png" x="5" y="-3" opacity="0.5" composite-op="svg:screen"/>'
        '<stack name="A" isolation="isolate" visibility="hidden">'
        '<layer name="B" src="data/b.png" selected="true" edit-locked="true"/><layer src="data/a.png"/></stack>',
        {"data/a.png": png(top), "data/b.png": png(inner)},
        tmp_path,
    )
    found = open_painting(path)
    root = found.painting.root
    assert [node.name for node in layers.walk(root)] == ["A", "Layer 2", "B", "A 2"]
    assert found.notes == ()
    assert found.painting.frame == Rect(0, 0, 50, 40)
    assert found.painting.active == "B"
    group, first = root.children
    assert (group.visible, group.isolated) == (False, True)
    assert (first.opacity, first.blend) == (0.5, "screen")
    assert group.children[1].locked
    assert np.array_equal(to_rgba8(evaluate(first.pyramid, 0, Rect.at(5, -3, 20, 10)).rgba), top)


def test_what_cannot_be_kept_is_told(tmp_path):
    path = ora(
        '<layer name="P" src="data/a.png" composite-op="krita:dissolve"/><layer name="N" src="data/none.png"/>'
        '<layer name="S" src="data/a.svg"/><layer name="no source"/>',
        {"data/a.png": png(image(4, 4)), "data/a.svg": b"<svg/>"},
        tmp_path,
    )
    found = open_painting(path)
    assert [node.name for node in layers.walk(found.painting.root)] == ["S", "N", "P"]
    notes = "\n".join(found.notes)
    for word in ("krita:dissolve", "none.png", "a.svg", "left out"):
        assert word in notes


def test_thousands_of_notes_are_cut_short(tmp_path):
    stack = "".join(f'<layer name="L{i}" src="x{i}.png"/>' for i in range(100))
    assert len(open_painting(ora(stack, {}, tmp_path)).notes) == 21


def test_our_attributes_without_our_members(tmp_path):
    """PyORA keeps the attributes and drops the members: a plain file, and said so."""
    attributes = f'w="9" h="9" xmlns:inkfall="{OURS}" inkfall:format="1"'
    found = open_painting(ora('<layer src="a.png"/>', {"a.png": png(image(9, 9))}, tmp_path, attributes))
    assert found.notes == (LOST,)


HOSTILE = {
    "no stack.xml": (None, {}, "no member 'stack.xml'"),
    "not an archive": (b"hello", {}, "no end record"),
    "damaged picture": ('<layer src="a.png"/>', {"a.png": png(image(9, 9))[:-30]}, "member 'a.png'"),
    "EPS called PNG": ('<layer src="a.png"/>', {"a.png": b"%!PS-Adobe-3.0 EPSF-3.0\n"}, "not a PNG"),
    "empty picture": ('<layer src="a.png"/>', {"a.png": b""}, "not a PNG"),
    "groups too deep": ("<stack>" * 40 + "</stack>" * 40, {}, "at most 32"),
    "a small picture many times": (
        '<layer src="a.png"/>' * 1900, {"a.png": png(np.zeros((2000, 2000, 4), np.uint8))}, "all layers together"
    ),
    "a picture 300 times": (
        '<layer src="a.png"/>' * 300, {"a.png": png(np.zeros((2000, 1000, 4), np.uint8))}, "again have 598000000"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile(name, tmp_path):
    stack, members, expected = HOSTILE[name]
    if isinstance(stack, str):
        path = ora(stack, members, tmp_path)
    else:
        path = tmp_path / "a.ora"
        path.write_bytes(stack or b"PK\5\6" + bytes(18))
    with pytest.raises(FileError) as caught:
        open_painting(path)
    assert str(caught.value).startswith(str(path))
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)


def test_claims_are_added_up_before_anything_is_decoded(tmp_path):
    path = ora('<layer src="a.png"/>' * 3, {"a.png": png(image(10, 10))}, tmp_path)
    with pytest.raises(FileError, match="300 pixels; expected at most 299"):
        open_painting(path, limits=replace(LIMITS, total_pixels=299))
    assert open_painting(path, limits=replace(LIMITS, total_pixels=300)).notes == ()


def test_other_programs_files_save_as_ours(tmp_path):
    from engine.archive.saving import Snapshot, save

    path = ora('<layer src="a.png" x="3" y="3"/>', {"a.png": png(image(30, 30))}, tmp_path)
    found = open_painting(path)
    save(tmp_path / "b.ora", Snapshot(found.painting))
    again = open_painting(tmp_path / "b.ora")
    assert again.native
    one, two = (
        np.concatenate([s.copy() for s in strips(p.root, 0, Rect(0, 0, 50, 40))], axis=1)
        for p in (found.painting, again.painting)
    )
    assert np.array_equal(one, two)
