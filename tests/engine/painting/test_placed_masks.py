"""Masks on placements: of what is seen, in any pose; painted on, moved along, kept in files, applied."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from engine.archive.imports import read_raster
from engine.archive.manifest import FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose
from engine.canvas.reading import layer_planes
from engine.files.limits import LIMITS
from engine.files.zip_reader import ZipArchive
from engine.numeric.address import Rect
from engine.numeric.similarity import since
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.recording import Header
from engine.painting.value import Refusal, first_painting
from engine.session.here.gazes import Gaze, Sightline
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect(0, 0, 60, 50)
AROUND = Rect(-40, -40, 90, 80)
OVAL = {"do": "select", "ellipse": [0, 12, 8, 30, 26], "feather": 2, "keep": "oval"}
EXACT, TURNED = {"at": [30, 20], "turn": 1}, {"at": [30, 4], "c": [0.8, 0.6]}


def stroke(layer="sky", **brush):
    points = [[5, 10], [50, 40]]
    return {"do": "stroke", "layer": layer, "points": points, "brush": {"radius": 9, "colour": "#c05020", **brush}}


def changed(**members):
    return {"do": "layer", "set": "again", **members}


def done(*commands, placing=EXACT):
    session = Session(first_painting(Header(FRAME)))
    again = {"do": "layer", "add": "again", "kind": "placement", "of": "sky", **placing}
    for command in ({"do": "layer", "add": "sky"}, stroke(), again, *commands):
        session.do(c.parse(command))
    return session


def masked(*commands, placing=EXACT):
    return done(OVAL, changed(mask="oval"), {"do": "select", "none": True}, *commands, placing=placing)


def picture(root, level=0, rect=AROUND, read=layer_planes):
    return composite(root, level, rect.zoomed(level), read)


def root_of(session):
    return session.painting.root


def grouped(root):
    """The tree with each placement's mask on a group around it."""
    nodes = []
    for node in root.children:
        if isinstance(node, Placement) and node.mask is not None:
            inner = layers.set_fields(Group(0, "root", children=(node,)), node.name, mask=None).children
            node = Group(node.id + 100, f"around {node.name}", children=inner, mask=node.mask)
        nodes.append(node)
    return Group(0, "root", children=tuple(nodes))


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
exact = st.builds(
    lambda x, y, levels, turn, mirror: {"at": [x, y], "levels": levels, "turn": turn, "mirror": mirror},
    st.integers(-30, 60),
    st.integers(-30, 60),
    st.integers(-2, 1),
    st.integers(0, 3),
    st.booleans(),
)


@settings(max_examples=6, deadline=None)
@given(selections, exact, st.integers(0, 3))
def test_it_is_as_on_the_same_paint_made_independent(selecting, placing, level):
    session = done(*selecting, changed(mask=True), placing=placing)
    own = done(*selecting, {"do": "layer", "bake": "again"}, changed(mask=True), placing=placing)
    found = picture(root_of(session), level)
    assert isinstance(layers.find(root_of(own), "again"), Layer)
    np.testing.assert_array_equal(found, picture(root_of(own), level))
    np.testing.assert_array_equal(found, picture(grouped(root_of(session)), level))
    session.do(c.parse({"do": "layer", "bake": "again"}))
    np.testing.assert_array_equal(picture(root_of(session), level), found)


@settings(max_examples=4, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(selections, exact | st.just(TURNED), exact | st.just(TURNED), st.integers(-2, 2))
def test_it_is_kept_replayed_taken_back_and_a_matter_of_each_pixel_alone(tmp_path, selecting, first, then, level):
    session = done(*selecting, changed(mask=True), changed(**then), placing=first)
    found, rect = picture(root_of(session), level), AROUND.zoomed(level)
    part = Rect(rect.x0 + rect.width // 3, rect.y0 + rect.height // 4, rect.x1, rect.y1)
    np.testing.assert_array_equal(composite(root_of(session), level, part, layer_planes), found[:, *part.slices(rect)])
    root = root_of(session)
    with ThreadPoolExecutor(2) as pool:
        for seen in pool.map(lambda _: picture(root, level), range(2)):
            np.testing.assert_array_equal(seen, found)
    np.testing.assert_array_equal(picture(root_of(replay(session.recording())), level), found)
    save(tmp_path / "a.ora", Snapshot(session.painting))
    np.testing.assert_array_equal(picture(root_of(open_painting(tmp_path / "a.ora")), level), found)
    assert format_of(session.painting) == FORMAT
    session.do(c.Undo())
    session.do(c.Undo())
    np.testing.assert_array_equal(picture(root_of(session), level), picture(root_of(done(placing=first)), level))


@pytest.mark.parametrize("placing", [EXACT, TURNED, {**EXACT, "rect": [0, 0, 0, 20, 18], "repeat": True}])
@pytest.mark.parametrize("level", [-1, 0, 2])
def test_it_hides_what_is_seen_whatever_the_pose(placing, level):
    session = masked(placing=placing)
    plain, mask = root_of(done(placing=placing)), layers.find(root_of(session), "again").mask
    alone = layers.alone(layers.find(plain, "again"), plain)
    share = mask.part(level, AROUND.zoomed(level))
    shown = layers.alone(layers.find(root_of(session), "again"), root_of(session))
    np.testing.assert_allclose(picture(shown, level), picture(alone, level) * share, atol=1e-6)
    assert picture(shown, level)[3].any()
    np.testing.assert_array_equal(picture(root_of(session), level), picture(grouped(root_of(session)), level))


def test_it_goes_along_and_comes_back_to_the_bit():
    session = masked()
    before, aside = picture(root_of(session)), Rect(AROUND.x0 + 7, AROUND.y0 - 3, AROUND.x1 + 7, AROUND.y1 - 3)
    session.do(c.parse({"do": "layer", "set": "sky", "visible": False}))
    hidden = picture(root_of(session))
    session.do(c.parse(changed(at=[37, 17])))
    np.testing.assert_array_equal(picture(root_of(session), rect=aside), hidden)
    assert layers.find(root_of(session), "again").mask.pose is None
    for pose in (TURNED, {"c": [0.6, -0.7], "levels": 1, "mirror": True}):
        session.do(c.parse(changed(**pose)))
        assert layers.find(root_of(session), "again").mask.pose == Pose(at=(37, 17), turn=1)
    session.do(c.parse(changed(**EXACT, levels=0, mirror=False)))
    session.do(c.parse({"do": "layer", "set": "sky", "visible": True}))
    np.testing.assert_array_equal(picture(root_of(session)), before)
    assert layers.find(root_of(session), "again").mask.pose is None


def test_turned_it_is_as_what_it_hides_turned():
    session = masked({"do": "layer", "set": "sky", "visible": False}, placing={"at": [0, 0]})
    held = root_of(session)
    session.do(c.parse(changed(**TURNED)))
    outer = Placement(90, "outer", of=layers.find(held, "again").id, pose=Pose(at=(30, 4), turned=(0.8, 0.6)))
    around = layers.alone(outer, layers.insert(held, outer))
    np.testing.assert_allclose(picture(root_of(session)), picture(around), atol=0.05)  # a product's mean
    assert picture(root_of(session))[3].sum() < 0.8 * picture(root_of(done(placing=TURNED)))[3].sum()


def test_moved_by_whole_pixels_what_is_turned_keeps_a_mask_that_can_be_painted_on():
    session = masked(changed(at=[33, 9]), placing=TURNED)
    assert layers.find(root_of(session), "again").mask.pose is None
    session.do(c.parse({**stroke("again", colour="#ffffff"), "onto": "mask"}))
    session.do(c.parse(changed(c=[0.6, 0.8])))
    with pytest.raises(Refusal, match="turned or scaled with it"):
        session.do(c.parse({**stroke("again"), "onto": "mask"}))
    for mask in ({"op": "invert"}, {"op": "off"}, {"op": "on"}):
        session.do(c.parse(changed(mask=mask)))
        assert layers.find(root_of(session), "again").mask.pose is not None
    session.do(c.parse({"do": "select", "mask": "again"}))
    seen = picture(root_of(session))
    session.do(c.parse(changed(mask={"op": "lay"})))
    assert layers.find(root_of(session), "again").mask.pose is None
    np.testing.assert_allclose(picture(root_of(session)), seen, atol=1 / 64)
    np.testing.assert_array_equal(picture(root_of(replay(session.recording()))), picture(root_of(session)))
    session.do(c.Undo())
    np.testing.assert_array_equal(picture(root_of(session)), seen)
    session.do(c.parse(changed(mask=True)))
    np.testing.assert_allclose(picture(root_of(session)), seen, atol=1 / 64)
    session.do(c.parse({**stroke("again"), "onto": "mask"}))


@pytest.mark.parametrize("level", [-1, 0, 2])
def test_a_stroke_on_it_is_previewed_as_it_will_be(level):
    session = masked()
    around = FRAME.zoomed(level)
    live = session.begin(level, (0, 0), Brush(radius=4.0, colour="#ffffff"), "again", onto="mask")
    live.add(np.array([[around.x0 + 2, around.y0 + 3], [around.x0 + 14, around.y0 + 11]], np.float64))

    def read(layer, at, rect):
        sheet = type(layer) is not Layer and at == level
        return live.preview(rect).rgba if sheet else layer_planes(layer, at, rect)

    preview, before = picture(live.root, level, read=read), session.painting
    session.finish(live)
    np.testing.assert_array_equal(preview, picture(root_of(session), level))
    found = areas(before, session.painting)(level)
    assert found is not None
    differs = (picture(before.root, level) != preview).any(0)
    for rect in found:
        differs[*rect.intersect(AROUND.zoomed(level)).slices(AROUND.zoomed(level))] = False
    assert found
    assert not differs.any()


def test_one_that_is_seen_elsewhere_too_changes_anywhere():
    session = masked({"do": "layer", "add": "third", "kind": "placement", "of": "again", "at": [3, 3]})
    before = session.painting
    session.do(c.parse({**stroke("again"), "onto": "mask"}))
    assert areas(before, session.painting)(0) is None
    shown = layers.alone(layers.find(root_of(session), "third"), root_of(session))
    there = Rect(AROUND.x0 + 3, AROUND.y0 + 3, AROUND.x1 + 3, AROUND.y1 + 3)
    plain = layers.alone(layers.find(root_of(session), "again"), root_of(session))
    np.testing.assert_array_equal(picture(shown, rect=there), picture(plain))
    session.do(c.parse({"do": "layer", "bake": "third"}))
    paint = layers.alone(layers.find(root_of(session), "third"), root_of(session))
    np.testing.assert_allclose(picture(paint, rect=there), picture(plain), atol=2**-15)


@pytest.mark.parametrize("placing", [{"at": [0, 0]}, TURNED])
def test_a_mask_that_hides_nothing_changes_no_bit(placing):
    wide = {**stroke(radius=40, hardness=1), "layer": "sky"}
    session = done(wide, {"do": "layer", "add": "below"}, stroke("below", colour="#20f040"), placing=placing)
    session.do(c.parse({"do": "layer", "move": "below", "to": 0}))
    plain = [picture(root_of(session), level) for level in (-2, 0, 3)]
    for name in ("again", "sky"):
        session.do(c.parse({**changed(mask={"op": "full"}), "set": name}))
        for level, found in zip((-2, 0, 3), plain, strict=True):
            np.testing.assert_array_equal(picture(root_of(session), level), found)


@pytest.mark.parametrize("placing", [EXACT, TURNED])
def test_applied_it_is_paint_of_its_own(placing):
    session = masked(placing=placing)
    before = picture(root_of(session))
    session.do(c.parse(changed(mask={"op": "apply"})))
    made = layers.find(root_of(session), "again")
    assert isinstance(made, Layer)
    assert made.mask is None
    np.testing.assert_allclose(picture(root_of(session)), before, atol=2**-14)
    session.do(c.Undo())
    np.testing.assert_array_equal(picture(root_of(session)), before)


@pytest.mark.parametrize("placing", [EXACT, TURNED])
def test_other_programs_see_it_masked_and_merged_it_is_paint(tmp_path, placing):
    session = masked(placing=placing)
    save(tmp_path / "a.ora", Snapshot(session.painting))
    with open(tmp_path / "a.ora", "rb") as file:
        theirs = read_raster(ZipArchive(file, "a.ora"), LIMITS, None, None).painting
    before = picture(root_of(session), rect=FRAME)
    assert np.abs(picture(theirs.root, rect=FRAME) - before).max() < 1.5 / 255
    session.do(c.parse({"do": "layer", "merge": "again"}))
    (made,) = root_of(session).children
    assert made.mask is None
    np.testing.assert_allclose(picture(root_of(session), rect=FRAME), before, atol=3e-5)


def test_copies_have_masks_of_their_own_and_groups_take_theirs_along():
    session = masked({"do": "layer", "duplicate": "again", "to": "other"})
    one, other = (layers.find(root_of(session), name).mask for name in ("again", "other"))
    assert one.pyramid.uid != other.pyramid.uid
    session = masked({"do": "layer", "set": "sky", "visible": False}, {"do": "layer", "add": "all", "kind": "group"})
    session.do(c.parse({"do": "layer", "move": "again", "group": "all", "to": 0}))
    before = picture(root_of(session))
    session.do(c.parse({"do": "layer", "set": "all", "at": [8, 4]}))
    there = Rect(AROUND.x0 + 8, AROUND.y0 + 4, AROUND.x1 + 8, AROUND.y1 + 4)
    np.testing.assert_array_equal(picture(root_of(session), rect=there), before)


def test_where_it_hides_all_nothing_is_seen_that_could_be_asked_about():
    root = root_of(masked({"do": "layer", "set": "sky", "visible": False}))
    found = picture(root, rect=FRAME)[3]
    for (y, x), alpha in np.ndenumerate(found[::9, ::9]):
        seen = sum(
            one.weight * one.alpha for one in Sightline(root, None).sights(Gaze.of(0, Rect.at(9 * x, 9 * y, 1, 1)))
        )
        assert seen == pytest.approx(float(alpha), abs=0.02)


@settings(max_examples=30, deadline=None)
@given(exact | st.just(TURNED), exact | st.just({"at": [3, 4], "c": [-0.9, 0.2]}))
def test_a_move_since_another_takes_places_from_one_to_the_other(first, then):
    def similarity(told):
        told = {**told, "at": tuple(told["at"])}
        turned = told.pop("c", None)
        return Pose(**told, turned=None if turned is None else tuple(turned)).similarity

    one, other = similarity(first), similarity(then)
    again = one.then(since(one, other))
    assert again.mirror == other.mirror
    for a, b in ((again.c, other.c), (again.t, other.t)):
        off = a + -b
        assert off.zero or max(abs(off.x), abs(off.y)).bit_length() - off.e < -150
