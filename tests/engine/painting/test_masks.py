"""Layers shown within a mask: the value of a selection, at every level, while they are painted on and in files."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.imports import read_raster
from engine.archive.manifest import FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import shown
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_planes
from engine.files.limits import LIMITS
from engine.files.zip_reader import ZipArchive
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.recording import Header, version_of
from engine.painting.rendering import sheets
from engine.painting.value import Refusal, first_painting
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect(0, 0, 60, 50)
OVAL = {"do": "select", "ellipse": [0, 12, 8, 30, 26], "feather": 2, "keep": "oval"}
MASKED = {"do": "layer", "set": "sky", "mask": True}


def stroke(layer="sky", **brush):
    points = [[5, 10], [50, 40]]
    return {"do": "stroke", "layer": layer, "points": points, "brush": {"radius": 9, "colour": "#c05020", **brush}}


def done(*commands):
    session = Session(first_painting(Header(FRAME)))
    for command in ({"do": "layer", "add": "sky"}, stroke(), *commands):
        session.do(c.parse(command))
    return session


def masked(*commands):
    return done(OVAL, MASKED, {"do": "select", "none": True}, *commands)


def picture(root, level=0, rect=FRAME, read=layer_planes):
    return composite(root, level, rect.zoomed(level), read)


def wanted(layer, level, rect=FRAME):
    mask, rect = layer.mask, rect.zoomed(level)
    paint, alpha = layer_planes(layer, level, rect), shown(mask.pyramid, level, rect)
    part = 0 if alpha is None else np.clip(alpha[3], 0, 1)
    return np.zeros((4, rect.height, rect.width)) if paint is None else paint * (1 - part if mask.inverse else part)


@pytest.mark.parametrize("level", [-2, 0, 3])
@pytest.mark.parametrize("inverse", [False, True])
def test_it_multiplies_what_is_seen_at_every_level(level, inverse):
    session = done(OVAL, *([{"do": "select", "invert": True}] if inverse else []), MASKED)
    found = picture(session.painting.root, level)
    np.testing.assert_allclose(found, wanted(session.painting.root.children[0], level), atol=1e-6)
    assert found[3].any()
    assert (found != picture(done().painting.root, level)).any()


@pytest.mark.parametrize("level", [-2, 0, 3])
def test_a_stroke_on_it_is_previewed_as_it_will_be(level):
    session = masked()
    around = FRAME.zoomed(level)
    live = session.begin(level, (0, 0), Brush(radius=4.0), "sky")
    live.add(np.array([[around.x0 + 2, around.y0 + 3], [around.x0 + 14, around.y0 + 11]], np.float64))

    def read(layer, at, rect):
        return live.preview(rect).rgba if type(layer) is Layer else layer_planes(layer, at, rect)

    preview = picture(live.root, level, read=read)
    session.finish(live)
    np.testing.assert_array_equal(preview, picture(session.painting.root, level))


selections = st.builds(
    lambda kind, x, y, size, feather, invert: [
        {"do": "select", kind: [0, x, y, size, size], "feather": feather},
        *([{"do": "select", "invert": True}] if invert else []),
    ],
    st.sampled_from(["rect", "ellipse"]),
    st.integers(-5, 40),
    st.integers(-5, 30),
    st.integers(4, 40),
    st.sampled_from([0, 3]),
    st.booleans(),
)


@settings(max_examples=5, deadline=None)
@given(selections, st.integers(-2, 2), st.booleans())
def test_it_is_kept_replayed_taken_back_and_a_matter_of_each_pixel_alone(selecting, level, grouped):
    group = [{"do": "layer", "add": "all", "kind": "group", "group": None}]
    group += [{"do": "layer", "move": "sky", "to": 0, "group": "all"}, {**MASKED, "set": "all"}]
    session = done(*selecting, *(group if grouped else [MASKED]))
    root, rect = session.painting.root, FRAME.zoomed(level)
    found = picture(root, level)
    part = Rect(rect.x0 + rect.width // 3, rect.y0 + rect.height // 4, rect.x1, rect.y1)
    np.testing.assert_array_equal(composite(root, level, part, layer_planes), found[:, *part.slices(rect)])
    np.testing.assert_array_equal(picture(replay(session.recording()).painting.root, level), found)
    node = root.children[0]
    mask = layers.set_fields(root, node.name, mask=None)
    if not grouped:
        np.testing.assert_allclose(found, wanted(node, level), atol=1e-6)
    session.do(c.Undo())
    np.testing.assert_array_equal(picture(session.painting.root, level), picture(mask, level))


@pytest.mark.parametrize("grouped", [False, True])
def test_files_keep_it_and_show_it_to_other_programs(tmp_path, grouped):
    group = [{"do": "layer", "add": "all", "kind": "group", "group": None}]
    group += [{"do": "layer", "move": "sky", "to": 0, "group": "all"}]
    group += [{**MASKED, "set": "all", "mask": "oval"}, {**MASKED, "mask": None}]
    painting = masked(*(group if grouped else [])).painting
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora").painting
    for level in (-1, 0, 2):
        np.testing.assert_array_equal(picture(found.root, level), picture(painting.root, level))
    assert format_of(painting) == FORMAT
    with open(tmp_path / "a.ora", "rb") as file:
        theirs = read_raster(ZipArchive(file, "a.ora"), LIMITS, None, None).painting
    assert np.abs(picture(theirs.root) - picture(painting.root)).max() < 1.5 / 255


@pytest.mark.parametrize("inverse", [False, True])
def test_what_it_shows_is_selected_at_every_level_and_joins_what_was(inverse):
    session = masked(*([{"do": "layer", "set": "sky", "mask": {"op": "invert"}}] if inverse else []))
    mask = session.painting.root.children[0].mask
    session.do(c.parse({"do": "select", "mask": "sky"}))
    for level in (-2, 0, 3):
        rect = FRAME.zoomed(level)
        np.testing.assert_array_equal(session.painting.selection.part(level, rect), mask.part(level, rect))
    session.do(c.parse({"do": "layer", "set": "sky", "mask": {"op": "off"}}))
    session.do(c.parse({"do": "select", "mask": "sky"}))
    assert not session.painting.selection.off
    session.do(c.parse({"do": "select", "rect": [0, 0, 0, 20, 50]}))
    session.do(c.parse({"do": "select", "mask": "sky", "op": "intersect"}))
    both = session.painting.selection.part(0, FRAME)
    np.testing.assert_allclose(both[:, :20], mask.part(0, FRAME)[:, :20], atol=1e-4)
    assert not both[:, 21:].any()
    again = replay(session.recording()).painting
    np.testing.assert_array_equal(again.selection.part(0, FRAME), both)


def test_it_is_the_value_of_a_selection_and_can_be_taken_away():
    session = masked()
    shown_before = picture(session.painting.root)
    session.do(c.parse({"do": "select", "rect": [0, 0, 0, 5, 5], "keep": "oval"}))
    np.testing.assert_array_equal(picture(session.painting.root), shown_before)
    before = session.painting
    session.do(c.parse({**MASKED, "mask": "oval"}))
    assert areas(before, session.painting)(0) is None
    assert not picture(session.painting.root)[3, 6:].any()
    session.do(c.parse({**MASKED, "mask": None}))
    np.testing.assert_array_equal(picture(session.painting.root), picture(done().painting.root))
    for mask in (True, None, "oval"):
        command = c.parse({**MASKED, "mask": mask})
        assert c.to_json(command)["mask"] is mask or c.to_json(command)["mask"] == mask
        assert version_of(command) == 2


def test_it_moves_with_the_layer_and_is_seen_through_placements():
    session = masked({"do": "layer", "add": "again", "kind": "placement", "of": "sky", "at": [30, 20]})
    session.do(c.parse({"do": "layer", "set": "sky", "visible": False}))
    aside = Rect.at(30, 20, FRAME.width, FRAME.height)
    np.testing.assert_array_equal(picture(session.painting.root, rect=aside), picture(masked().painting.root))
    moved = masked({"do": "layer", "set": "sky", "at": [30, 20]})
    np.testing.assert_array_equal(picture(moved.painting.root, rect=aside), picture(masked().painting.root))
    turned = masked({"do": "layer", "set": "sky", "c": [0.8, 0.6]})
    assert np.abs(picture(turned.painting.root)[3]).sum() < 1.1 * picture(masked().painting.root)[3].sum()


def test_merged_it_is_part_of_the_paint():
    session = done({"do": "layer", "add": "top"}, stroke("top", colour="#2040f0"), OVAL, {**MASKED, "set": "top"})
    before = picture(session.painting.root)
    session.do(c.parse({"do": "layer", "merge": "top"}))
    (made,) = session.painting.root.children
    assert made.mask is None
    np.testing.assert_allclose(picture(session.painting.root), before, atol=3e-5)


@pytest.mark.parametrize(
    ("before", "command", "wrong"),
    [
        ([], MASKED, "nothing selected"),
        ([], {**MASKED, "mask": "moon"}, "'moon'"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(before, command, wrong):
    session = done(*before)
    with pytest.raises(Refusal, match=wrong):
        session.do(c.parse(command))


@pytest.mark.parametrize("inverse", [False, True])
def test_the_picture_that_a_file_shows_to_other_programs_is_within_the_mask(inverse):
    root = masked().painting.root
    mask = layers.find(root, "sky").mask
    root = layers.set_fields(root, "sky", mask=mask.inverted() if inverse else mask)
    places = {layer.id: FRAME for layer in layers.layers(root)}
    merged = np.concatenate([band for _, band in sheets(root, 0, FRAME, places)])
    plain = picture(layers.set_fields(root, "sky", mask=None))
    assert not np.array_equal(merged, to_rgba8(plain))
    np.testing.assert_array_equal(merged, to_rgba8(picture(root)))
