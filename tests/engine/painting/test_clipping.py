"""Layers clipped to the one below: they show within its alpha, mix there, and belong to it."""

from dataclasses import replace

import numpy as np
import pytest

from engine.archive.imports import read_raster
from engine.archive.manifest import FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.files.limits import LIMITS
from engine.files.zip_reader import ZipArchive
from engine.numeric import blend
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import version_of
from engine.session.session import Session

WINDOW = Rect(-20, -20, 80, 70)


def stroke(layer, x=0, **brush):
    points = [[x, 0], [x + 30, 30]]
    return {
        "do": "stroke",
        "layer": layer,
        "points": points,
        "brush": {"radius": 12, "colour": "#d08040", "hardness": 0.4, **brush},
    }


def done(*commands):
    session = Session()
    named = ({"do": "layer", "add": name} for name in ("sky", "base", "shade"))
    painted = stroke("sky", 20, colour="#2060c0"), stroke("base"), stroke("shade", 14, colour="#408020", opacity=0.7)
    for command in (*named, *painted, {"do": "layer", "set": "shade", "clip": True}, *commands):
        session.do(c.parse(command))
    return session


def picture(painting, level=0):
    return composite(painting.root, level, WINDOW.zoomed(level), lambda one, at, rect: layer_planes(one, at, rect))


def shown(session, *hidden):
    for name in hidden:
        session.do(c.parse({"do": "layer", "set": name, "visible": False}))
    return picture(session.painting)


def test_it_shows_only_within_the_alpha_of_the_base():
    base = shown(done(), "sky", "shade")
    both = shown(done(), "sky")
    np.testing.assert_array_equal(both[3], base[3])
    layer = layer_planes(done().painting.root.children[2], 0, WINDOW)
    wanted = base.copy()
    blend.BLENDS["src-atop"].kernel(wanted.reshape(4, -1), np.ascontiguousarray(layer).reshape(4, -1), np.float32(1))
    np.testing.assert_allclose(both, wanted, atol=1e-6)
    assert (both[0] != base[0]).any()


def test_a_hidden_base_hides_it_and_the_opacity_of_the_base_is_that_of_both():
    np.testing.assert_array_equal(shown(done(), "base"), shown(done(), "base", "shade"))
    half = shown(done({"do": "layer", "set": "base", "opacity": 0.5}), "sky")
    np.testing.assert_allclose(half, 0.5 * shown(done(), "sky"), atol=1e-6)


@pytest.mark.parametrize("mode", ["multiply", "screen", "color", "soft-light"])
def test_blend_modes_mix_with_the_base_alone(mode):
    mixed = done({"do": "layer", "set": "shade", "blend": mode})
    found = shown(mixed, "sky")
    base = shown(done(), "sky", "shade")
    free = shown(done({"do": "layer", "set": "shade", "blend": mode, "clip": False}), "sky")
    np.testing.assert_array_equal(found[3], base[3])
    whole = base[3] == 1
    np.testing.assert_allclose(found[:, whole], free[:, whole], atol=1e-6)
    assert whole.any()


@pytest.mark.parametrize("level", [-2, 0, 3])
def test_it_is_the_atop_of_both_and_a_stroke_on_it_is_previewed_as_it_will_be(level):
    session = done({"do": "layer", "remove": "sky"})
    around = Rect(0, 0, 24, 20).zoomed(level)
    live = session.begin(level, (0, 0), Brush(radius=5.0, opacity=0.8), "shade")
    live.add(np.array([[around.x0 + 2, around.y0 + 3], [around.x1, around.y1]], np.float64))

    def read(layer, at, rect):
        return live.preview(rect).rgba if layer.name == "shade" else layer_planes(layer, at, rect)

    preview = composite(live.root, level, around, read)
    session.finish(live)
    committed = composite(session.painting.root, level, around, lambda one, at, rect: layer_planes(one, at, rect))
    np.testing.assert_array_equal(preview, committed)
    base, shade = (layer_planes(one, level, around) for one in session.painting.root.children)
    wanted = np.clip(base.reshape(4, -1), 0, 1)
    blend.BLENDS["src-atop"].kernel(wanted, np.ascontiguousarray(shade).reshape(4, -1), np.float32(1))
    np.testing.assert_allclose(committed.reshape(4, -1), wanted, atol=1e-6)
    assert committed[3].any()


def test_one_that_lies_on_nothing_is_shown_as_it_is():
    alone = [{"do": "layer", "remove": name} for name in ("sky", "base")]
    np.testing.assert_array_equal(
        picture(done(*alone).painting), picture(done(*alone, {"do": "layer", "set": "shade", "clip": False}).painting)
    )


def test_merged_down_it_looks_as_before_and_the_base_stays_what_it_is():
    session = done({"do": "layer", "set": "base", "opacity": 0.5, "blend": "multiply"})
    before = picture(session.painting)
    session.do(c.parse({"do": "layer", "merge": "shade"}))
    base = session.painting.root.children[1]
    assert (base.name, base.opacity, base.blend, base.clip) == ("base", 0.5, "multiply", False)
    np.testing.assert_allclose(picture(session.painting), before, atol=3e-5)


def test_it_is_kept_in_files_and_told_by_commands(tmp_path):
    painting = done().painting
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora").painting
    assert [node.clip for node in found.root.children] == [False, False, True]
    np.testing.assert_array_equal(picture(found), picture(painting))
    assert format_of(painting) == FORMAT
    assert version_of(c.parse({"do": "layer", "set": "shade", "clip": True})) == 2


@pytest.mark.parametrize("grouped", [False, True])
def test_other_programs_see_it_clipped(tmp_path, grouped):
    more = [{"do": "layer", "set": "base", "opacity": 0.5, "blend": "multiply"}]
    if grouped:
        group = {"do": "layer", "add": "shades", "kind": "group", "group": None}
        clip = {"do": "layer", "set": "shades", "clip": True}
        more += [group, {"do": "layer", "move": "shade", "to": 0, "group": "shades"}, clip]
        more += [{"do": "layer", "set": "shade", "clip": False}]
    painting = replace(done(stroke("base", hardness=1.0), *more).painting, frame=WINDOW)
    save(tmp_path / "a.ora", Snapshot(painting))
    with open(tmp_path / "a.ora", "rb") as file:
        theirs = read_raster(ZipArchive(file, "a.ora"), LIMITS, None, None).painting
    found = composite(theirs.root, 0, Rect.at(0, 0, 100, 90), lambda one, at, rect: layer_planes(one, at, rect))
    wanted = picture(painting)
    base = layer_planes(painting.root.children[1], 0, WINDOW)[3]
    sharp = (base == 0) | (base == 1)
    assert np.abs(found - wanted)[:, sharp].max() < 1.5 / 255
    assert np.abs(found - wanted).max() < 0.25
    hidden = replace(painting, root=layers.set_fields(painting.root, "base", visible=False))
    assert np.abs(picture(hidden) - wanted).max() > 0.2
