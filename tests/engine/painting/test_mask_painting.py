"""Painting on masks: white shows and black hides, with whatever a brush can do, at every level."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.mask_sheet import sheet_of
from engine.journal.records import Touch, read_touch, told_brush, told_touch
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.recording import Header, version_of
from engine.painting.value import Refusal, first_painting
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect(0, 0, 60, 50)
FULL = {"do": "layer", "set": "sky", "mask": {"op": "full"}}
POINTS = [[5, 10], [50, 40]]


def stroke(layer="sky", points=POINTS, level=0, **brush):
    about = {"radius": 9, "colour": "#c05020", **brush}
    return {"do": "stroke", "layer": layer, "level": level, "points": points, "brush": about}


def on_mask(**told):
    return {**stroke(**told), "onto": "mask"}


def done(*commands, layers_=("sky",)):
    session = Session(first_painting(Header(FRAME)))
    for name in layers_:
        session.do(c.parse({"do": "layer", "add": name}))
        session.do(c.parse(stroke(name, [[5, 25], [55, 25]], radius=24, hardness=1)))
    for command in commands:
        session.do(c.parse(command))
    return session


def picture(root, level=0):
    return composite(root, level, FRAME.zoomed(level), layer_planes)


def shows(root, level=0, name="sky"):
    """How far each place of a layer shows, by its mask."""
    sheet = sheet_of(layers.find(root, name))
    planes = layer_planes(sheet, level, FRAME.zoomed(level))
    alpha = np.zeros((FRAME.zoomed(level).height, FRAME.zoomed(level).width)) if planes is None else planes[3]
    return 1 - alpha if sheet.inverse else alpha


brushes = st.builds(
    lambda grey, radius, opacity, mode: {
        "colour": "#" + 3 * f"{grey:02x}",
        "radius": radius,
        "opacity": opacity,
        "mode": mode,
        **({"op": {"name": "invert"}} if mode == "raster" else {}),
    },
    st.integers(0, 255),
    st.sampled_from([3.0, 11.5]),
    st.sampled_from([0.3, 1.0]),
    st.sampled_from(["paint", "erase", "smooth", "raster"]),
)
drawn = st.tuples(brushes, st.integers(-2, 2), st.integers(0, 40), st.booleans())


@settings(max_examples=8, deadline=None)
@given(st.lists(drawn, min_size=1, max_size=3), st.sampled_from(["full", "empty"]))
def test_it_is_what_the_same_strokes_make_of_greys_and_multiplies_alpha(strokes, begins):
    white = begins == "full"
    ground = {"do": "fill", "layer": "greys", "brush": {"colour": "#ffffff" if white else "#000000"}}
    greys = [
        {"do": "select", "rect": [-2, -64, -64, 192, 192]},
        {**ground, "level": -2},
        {"do": "select", "none": True},
    ]
    plain = done(layers_=("sky", "greys"))
    plain.do(c.parse({"do": "layer", "clear": "greys"}))
    for command in greys:
        plain.do(c.parse(command))
    masked = done({**FULL, "mask": {"op": begins}})
    for brush, level, x, down in strokes:
        points = [[x * 2.0**level, 5 * 2.0**level], [(55 - x) * 2.0**level, (45 if down else 8) * 2.0**level]]
        points = [[round(v * 64) / 64 for v in point] for point in points]
        masked.do(c.parse(on_mask(points=points, level=level, **brush)))
        plain.do(c.parse(stroke("greys", points, level, **brush)))
    if all(brush["mode"] in ("paint", "raster") for brush, *_ in strokes) and all(
        not level for _, level, *_ in strokes
    ):
        wanted = layer_planes(layers.find(plain.painting.root, "greys"), 0, FRAME)[0]
        np.testing.assert_allclose(shows(masked.painting.root), wanted, atol=2e-5)
    for level in (-1, 0, 1):
        bare = picture(layers.set_fields(masked.painting.root, "sky", mask=None), level)
        part = np.clip(shows(masked.painting.root, level), 0, 1)
        np.testing.assert_allclose(picture(masked.painting.root, level), bare * part, atol=1e-6)
    np.testing.assert_array_equal(picture(replay(masked.recording()).painting.root), picture(masked.painting.root))
    masked.do(c.Undo(len(strokes)))
    assert (shows(masked.painting.root) == white).all()


def test_black_hides_white_shows_and_an_eraser_hides():
    session = done(FULL, on_mask(colour="#000000", hardness=1))
    hidden = shows(session.painting.root)
    assert hidden[25, 27] == 0
    assert hidden[2, 55] == 1
    paint = layers.find(session.painting.root, "sky").pyramid
    session.do(c.parse(on_mask(colour="#ffffff", hardness=1, radius=14)))
    assert (shows(session.painting.root) == 1).all()
    session.do(c.parse(on_mask(mode="erase", hardness=1)))
    np.testing.assert_array_equal(shows(session.painting.root), hidden)
    session.do(c.parse(on_mask(colour="#808080", hardness=1, radius=14)))
    assert shows(session.painting.root)[25, 27] == np.rint(128 / 255 * 65536) / 65536
    assert layers.find(session.painting.root, "sky").pyramid is paint


@pytest.mark.parametrize("begins", ["full", "empty"])
@pytest.mark.parametrize("level", [-1, 0, 2])
def test_its_preview_is_what_is_committed_and_nothing_else_is_drawn_anew(begins, level):
    session = done({**FULL, "mask": {"op": begins}})
    before = session.painting
    brush = from_json({"radius": 5, "colour": "#7f7f7f", "ink": [{"texture": "rock", "amount": 0.4}]})
    live = session.begin(level, (0, 0), brush, "sky", onto="mask")
    live.add(np.array([[2.0, 3.0], [18.0, 12.0]]))

    def read(layer, at, rect):
        return live.preview(rect).rgba if type(layer) is type(live.layer) else layer_planes(layer, at, rect)

    preview = composite(live.root, level, FRAME.zoomed(level), read)
    session.finish(live)
    np.testing.assert_array_equal(preview, picture(session.painting.root, level))
    changed = areas(before, session.painting)(0)
    assert changed
    outside = np.ones((FRAME.height, FRAME.width), bool)
    for rect in changed:
        outside[rect.intersect(FRAME).slices(FRAME)] = False
    assert (picture(before.root) == picture(session.painting.root))[:, outside].all()


def test_fills_and_selections_reach_it():
    square = {"do": "select", "rect": [0, 10, 10, 20, 20]}
    ramp = {"do": "texture", "name": "ramp", "maker": "gradient", "kind": "linear", "from": [10, 0], "to": [30, 0]}
    faded = {"ink": [{"texture": "ramp"}], "colour": "#000000"}
    ramp["ramp"] = [[0, "#000000"], [1, "#ffffff"]]
    session = done(FULL, square, ramp, {"do": "fill", "layer": "sky", "onto": "mask", "brush": faded})
    found = shows(session.painting.root)
    assert (np.diff(found[15, 10:30]) > 0).all()
    outside = np.ones_like(found, bool)
    outside[10:30, 10:30] = False
    assert (found[outside] == 1).all()
    session.do(c.parse(on_mask(colour="#000000", hardness=1)))
    assert (shows(session.painting.root)[outside] == 1).all()
    assert shows(session.painting.root)[20, 20] == 0


def test_its_ops_and_files_and_groups(tmp_path):
    group = [{"do": "layer", "add": "all", "kind": "group", "group": None}]
    group += [{"do": "layer", "move": "sky", "to": 0, "group": "all"}, {**FULL, "set": "all"}]
    dark = {"colour": "#303030"}
    session = done(FULL, on_mask(**dark), *group, {**on_mask(**dark), "layer": "all", "level": 1})
    session.do(c.parse({**FULL, "mask": {"op": "off"}}))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    again = open_painting(tmp_path / "a.ora").painting
    for level in (-1, 0, 1):
        np.testing.assert_array_equal(picture(again.root, level), picture(session.painting.root, level))
    assert layers.find(again.root, "sky").mask.off
    put_aside = picture(session.painting.root)
    session.do(c.parse({**FULL, "mask": None}))
    np.testing.assert_array_equal(picture(session.painting.root), put_aside)
    session.do(c.Undo())
    session.do(c.parse({**FULL, "mask": {"op": "on"}}))
    before, hides = picture(session.painting.root), shows(session.painting.root)
    session.do(c.parse({**FULL, "mask": {"op": "invert"}}))
    np.testing.assert_array_equal(shows(session.painting.root), 1 - hides)
    session.do(c.Undo())
    session.do(c.parse({**FULL, "mask": {"op": "apply"}}))
    assert layers.find(session.painting.root, "sky").mask is None
    np.testing.assert_allclose(picture(session.painting.root), before, atol=3e-5)


def test_a_copy_of_a_layer_has_a_mask_of_its_own():
    session = done(FULL, {"do": "layer", "duplicate": "sky", "to": "two"}, on_mask(colour="#000000"))
    assert (shows(session.painting.root, name="two") == 1).all()
    assert (shows(session.painting.root) < 1).any()


def test_commands_tell_it_again():
    for told in (on_mask(), {**FULL, "mask": {"op": "invert"}}, {"do": "fill", "brush": {}, "onto": "mask"}):
        command = c.parse(told)
        assert c.parse(c.to_json(command)) == command
        assert version_of(command) == 2
    assert c.to_json(c.parse(on_mask()))["onto"] == "mask"
    touch = Touch(2, (1 << 70, 5), from_json({"radius": 3}), 1.5, (), "sky", "mask")
    assert read_touch(told_touch(touch, told_brush(touch.brush)), {}) == touch


@pytest.mark.parametrize(
    ("command", "wrong"),
    [
        (on_mask(layer="two"), "no mask"),
        ({**FULL, "set": "two", "mask": {"op": "invert"}}, "no mask"),
        (on_mask(mode="example", example="torn-rag-paper"), "expected a layer to grow"),
        ({**FULL, "set": "all", "mask": {"op": "apply"}}, "found a group"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(command, wrong):
    group = {"do": "layer", "add": "all", "kind": "group", "group": None}
    session = done(FULL, group, {**FULL, "set": "all"}, layers_=("sky", "two"))
    before = session.painting
    with pytest.raises(Refusal, match=wrong):
        session.do(c.parse(command))
    assert session.painting is before


def test_on_a_locked_layer_it_is_refused():
    session = done(FULL, {"do": "layer", "set": "sky", "locked": True})
    with pytest.raises(Refusal, match="locked"):
        session.do(c.parse(on_mask()))
