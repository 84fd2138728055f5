"""What placements show: exact ones are the source's very pixels in other places, others are sampled once, purely."""

from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.composite import composite
from engine.canvas.layers import EMPTY, Group, Layer, find
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.numeric.pyramid import reduce
from engine.numeric.similarity import IDENTITY, Dyadic
from engine.painting import commands as c
from engine.session.session import Session

WINDOW = Rect(-40, -30, 88, 70)
INK = [{"texture": "rock", "colour": "#e0d0b0", "period": 24}]


@cache
def painted():
    """Layers 'low' and 'high' in a group 'tree', with ink and paint of several levels."""
    session = Session()
    for command in (
        {"do": "layer", "add": "tree", "kind": "group"},
        {"do": "layer", "add": "low", "group": "tree"},
        {"do": "layer", "add": "high", "group": "tree"},
        {"do": "layer", "set": "high", "opacity": 0.7},
    ):
        session.do(c.parse(command))
    for layer, level, radius, ink in (
        ("low", 0, 30, INK),
        ("high", 1, 14, []),
        ("low", 3, 20, []),
        ("high", -2, 5, INK),
    ):
        points = [[-30 * 2.0**level, 8 * 2.0**level], [10, 20], [60 * 2.0**level, 50 * 2.0**level]]
        brush = {"radius": radius, "colour": "#305070", "ink": ink, "opacity": 0.8}
        session.do(c.parse({"do": "stroke", "level": level, "layer": layer, "points": points, "brush": brush}))
    return session.painting.root


def node(name):
    return find(painted(), name)


def picture(root, level, rect):
    return composite(root, level, rect, layer_planes)


def only(*shown):
    """The painted tree, hidden, and what shows it."""
    hidden = tuple(replace(child, visible=False) for child in painted().children)
    return replace(EMPTY, children=(*hidden, *shown))


def placed(name, pose, number=50, **more):
    return Placement(number, f"placed {number}", of=None if name is None else node(name).id, pose=pose, **more)


def source_pixel(pose, level, source_level, x, y):
    """The pixel of the source whose middle is shown at the middle of a pixel, by fractions."""
    unit = Fraction(2) ** -level
    px, py = (x + Fraction(1, 2)) * unit, (y + Fraction(1, 2)) * unit
    px -= pose.at[0] * Fraction(2) ** -pose.level
    py -= pose.at[1] * Fraction(2) ** -pose.level
    for _ in range(pose.turn):  # a quarter clockwise is (x, y) -> (-y, x)
        px, py = py, -px
    px, py = (v * Fraction(2) ** -pose.levels for v in (px, py))
    if pose.mirror:
        px = -px
    return tuple(v * Fraction(2) ** source_level // 1 for v in (px, py))


poses = st.builds(
    Pose,
    at=st.tuples(st.integers(-200, 200), st.integers(-200, 200)),
    level=st.integers(-2, 1),
    levels=st.integers(-2, 3),
    turn=st.integers(0, 3),
    mirror=st.booleans(),
)


@settings(deadline=None)
@given(poses, st.integers(1, 3), st.sampled_from(["low", "high", "tree"]))
def test_an_exact_placement_shows_the_sources_very_pixels(pose, level, name):
    window = Rect(pose.at[0] - 40, pose.at[1] - 30, pose.at[0] + 50, pose.at[1] + 40)
    shown = picture(only(placed(name, pose)), level, window)
    at_level = level + pose.levels
    # Each coordinate of the source follows from one of the window's.
    row = [source_pixel(pose, level, at_level, x, window.y0) for x in range(window.x0, window.x1)]
    column = [source_pixel(pose, level, at_level, window.x0, y) for y in range(window.y0, window.y1)]
    places = [(across[0] + down[0] - row[0][0], across[1] + down[1] - row[0][1]) for down in column for across in row]
    xs, ys = [x for x, _ in places], [y for _, y in places]
    box = Rect(min(xs), min(ys), max(xs) + 1, max(ys) + 1)
    alone = replace(EMPTY, children=(replace(node(name), opacity=1.0, visible=True),))
    whole = picture(alone, at_level, box)
    expected = whole[:, np.array(ys) - box.y0, np.array(xs) - box.x0].reshape(shown.shape)
    np.testing.assert_array_equal(shown, expected)
    assert level != 1 or pose.level != 0 or shown.any() or not whole.any()


@pytest.mark.parametrize("shift", [1 << 60, -(1 << 300)])
def test_as_far_away_as_one_likes(shift):
    pose = Pose(at=(shift + 3, shift - 5), levels=-1, turn=1)
    shown = picture(only(placed("tree", pose)), 0, Rect.at(shift - 30, shift - 40, 80, 80))
    near = picture(only(placed("tree", replace(pose, at=(3, -5)))), 0, Rect.at(-30, -40, 80, 80))
    assert shown.any()
    np.testing.assert_array_equal(shown, near)


@pytest.mark.parametrize("by", [1, 2])
def test_a_move_by_parts_of_pixels_is_the_mean_of_finer_ones(by):
    pose = Pose(at=(5, 3), level=by)
    root = only(placed("tree", pose))
    finer = picture(root, by, WINDOW.zoomed(by))
    for _ in range(by):
        finer = reduce(finer)
    assert finer.any()
    np.testing.assert_allclose(picture(root, 0, WINDOW), finer, atol=2e-5)


def test_placements_of_placements_are_one():
    inner, outer = Pose(at=(7, -3), levels=-1, turn=1), Pose(at=(-20, 11), levels=1, turn=2, mirror=True)
    nested = only(placed("tree", inner, 50, visible=False), Placement(51, "outer", of=50, pose=outer))
    f = inner.similarity.then(outer.similarity)
    assert f.quarter is not None
    assert f.quarter[0] == 0
    found = picture(nested, 0, WINDOW)
    back = f.inverse().shown(WINDOW, 0, 0)
    source = picture(replace(EMPTY, children=(node("tree"),)), 0, back)
    source = source[:, ::-1] if f.mirror else source
    assert found.any()
    np.testing.assert_array_equal(found, np.rot90(source, -f.quarter[1], axes=(1, 2)))


TURNED = Pose(at=(13, 5), turned=(0.8660254037844387, 0.5))
SCALED = Pose(at=(-4, 9), turned=(1.3, 0.0))
TURNS = [TURNED, SCALED, Pose(at=(0, 3), turned=(0.6, -0.35), levels=1, mirror=True)]


@pytest.mark.parametrize("pose", TURNS)
@pytest.mark.parametrize("level", [-1, 0, 3])
def test_a_sampled_pixel_does_not_depend_on_what_else_was_asked_for(pose, level):
    root = only(placed("tree", pose, part=SourcePart(0, Rect(-20, -15, 70, 60))))
    whole = picture(root, level, WINDOW.grown(150))
    assert whole.any()
    for part in (WINDOW, Rect(-7, 3, 30, 4), Rect(100, -60, 171, 141)):
        np.testing.assert_array_equal(picture(root, level, part), whole[:, *part.slices(WINDOW.grown(150))])


@pytest.mark.parametrize("pose", TURNS)
def test_a_turned_picture_lies_where_it_should(pose):
    """The middle of mass of a stroke's dot goes where the similarity says."""
    session = Session()
    brush = {"radius": 6, "colour": "#ffffff"}
    session.do(c.parse({"do": "stroke", "points": [[21, -17], [21.5, -17]], "brush": brush}))
    layer = next(iter(session.painting.root.children))
    root = replace(EMPTY, children=(replace(layer, visible=False), Placement(9, "p", of=layer.id, pose=pose)))
    there = Rect(-100, -100, 100, 100)

    def middle(found):
        ys, xs = np.mgrid[there.y0 : there.y1, there.x0 : there.x1] + 0.5
        return (found * xs).sum() / found.sum(), (found * ys).sum() / found.sum()

    x, y = middle(picture(replace(EMPTY, children=(layer,)), 0, there)[3])
    re, im = pose.turned if pose.turned else (1, 0)
    scale = 2.0**pose.levels
    x = -x if pose.mirror else x
    expected = (re * x - im * y) * scale + pose.at[0], (im * x + re * y) * scale + pose.at[1]
    assert middle(picture(root, 0, there)[3]) == pytest.approx(expected, abs=0.02)


def test_what_is_turned_and_turned_back_is_sampled_once():
    """A turn in a turned group: one sampling through both, so that 64 small turns blur as one does."""
    c0 = (0.9925461516413221, 0.12186934340514748)  # 7 degrees
    nodes, of = [], node("high").id
    for number in range(60, 72):
        nodes.append(Placement(number, f"p{number}", of=of, pose=Pose(turned=c0), visible=number == 71))
        of = number
    many = picture(only(*nodes), 0, WINDOW)
    total = Dyadic.exactly(*c0)
    power = total
    for _ in range(11):
        power = power * total
    angle = (power.x / 2**power.e, power.y / 2**power.e)
    once = picture(only(placed("high", Pose(turned=angle))), 0, WINDOW)
    assert once.any()
    np.testing.assert_allclose(many, once, atol=2e-3)


def test_what_is_turned_within_a_turned_group_is_sampled_once():
    back = Pose(turned=(TURNED.turned[0], -TURNED.turned[1]))
    group = Group(60, "turned", visible=False, children=(placed("high", Pose(turned=TURNED.turned), 61),))
    root = only(group, Placement(62, "back", of=60, pose=back))
    plain = picture(replace(EMPTY, children=(replace(node("high"), opacity=1.0),)), 0, WINDOW)
    np.testing.assert_allclose(picture(root, 0, WINDOW), plain, atol=1e-3)


@pytest.mark.parametrize("pose", [Pose(at=(3, 4)), Pose(at=(3, 4), levels=-1, turn=3), TURNED])
def test_only_the_part_is_shown(pose):
    part = SourcePart(1, Rect(-21, 8, 44, 57))
    free = picture(only(placed("tree", pose)), 0, WINDOW)
    cut = picture(only(placed("tree", pose, part=part)), 0, WINDOW)
    xs, ys = np.meshgrid(np.arange(WINDOW.x0, WINDOW.x1), np.arange(WINDOW.y0, WINDOW.y1))
    box = part.rect
    inside = np.zeros(xs.shape)
    for i, (x, y) in enumerate(zip(xs.flat, ys.flat, strict=True)):
        u, v = pose.similarity.back((2 * int(x) + 1, 2 * int(y) + 1), 0, part.level, 0)
        inside.flat[i] = min(u - box.x0, box.x1 - u, v - box.y0, box.y1 - v)
    assert cut.any()
    assert not cut[:, inside < -4].any()
    np.testing.assert_array_equal(cut[:, inside > 8], free[:, inside > 8])
    assert free[:, inside > 8].any()


@pytest.mark.parametrize(
    "part", [SourcePart(0, Rect(-20, -10, 33, 21)), SourcePart(-1, Rect(0, 0, 9, 7)), SourcePart(1, Rect(3, 1, 8, 900))]
)
@pytest.mark.parametrize("level", [-1, 0, 2])
def test_a_cell_is_repeated_without_end(part, level):
    root = only(placed("tree", Pose(at=(1 << 40, 0)), part=part, repeat=True))
    cell = part.rect.zoomed(level - part.level)
    by = max(0, part.level - level)
    across, down = (
        (part.rect.width << 6) >> (part.level - level + 6),
        (part.rect.height << 6) >> (part.level - level + 6),
    )
    away = Rect.at((1 << 40 + level) if level >= 0 else (1 << 40) >> -level, 0, 60, 50)
    whole = picture(root, level, away)
    assert whole.any()
    if not by or (across << by, down << by) == (part.rect.width, part.rect.height):
        moved = Rect(away.x0 + 9 * across, away.y0 - 4 * down, away.x1 + 9 * across, away.y1 - 4 * down)
        np.testing.assert_array_equal(picture(root, level, moved), whole)
        source = picture(replace(EMPTY, children=(node("tree"),)), level, cell)
        first = Rect.at(away.x0 + cell.x0, cell.y0, cell.width, cell.height)
        np.testing.assert_array_equal(picture(root, level, first), source)


def test_a_hidden_source_is_shown_and_a_placement_has_its_own_opacity():
    layer = node("low")
    shown = picture(only(placed("low", Pose(), opacity=0.5)), 0, WINDOW)
    half = picture(replace(EMPTY, children=(replace(layer, opacity=0.5),)), 0, WINDOW)
    np.testing.assert_array_equal(shown, half)


@pytest.mark.parametrize("levels", [-1, -2])
def test_a_picture_that_contains_itself_is_the_same_a_turn_deeper(levels):
    ground = Session()
    brush = {"radius": 90, "colour": "#406080", "hardness": 1, "ink": INK}
    ground.do(c.parse({"do": "stroke", "points": [[-20, 64], [150, 64]], "brush": brush}))
    layer = next(iter(ground.painting.root.children))
    frame = SourcePart(0, Rect(0, 0, 128, 128))
    pose = Pose(at=(32, 48), levels=levels)
    root = replace(EMPTY, children=(layer, Placement(9, "itself", pose=pose, part=frame)))
    f = pose.similarity
    for level in (3, 4, 9):
        rect = Rect(40 << level, 60 << level, (40 << level) + 150, (60 << level) + 90)
        deeper = f.shown(rect, level, level - levels)
        assert (deeper.width, deeper.height) == (rect.width, rect.height)
        np.testing.assert_array_equal(picture(root, level, rect), picture(root, level - levels, deeper))


def test_a_layer_alone_stays_as_it_is():
    assert isinstance(node("low"), Layer)
    assert picture(replace(EMPTY, children=(node("low"),)), 0, WINDOW).any()


def in_one_another(count, poses, part=None):
    """So many placements in one another, the last of them seen."""
    first = placed("low", poses[0], 50, visible=count == 1)
    more = (
        Placement(50 + n, f"placed {n}", visible=n == count - 1, of=49 + n, pose=poses[n % len(poses)], part=part)
        for n in range(1, count)
    )
    return only(first, *more)


def test_thousands_of_exact_placements_in_one_another_are_drawn_as_one():
    poses = [Pose(at=(7, -3), levels=-1, turn=1), Pose(at=(-20, 11), levels=1, mirror=True), Pose(at=(3, 1), turn=2)]
    chain = loops.checked(in_one_another(3000, poses))
    f = IDENTITY
    for n in range(3000):
        f = f.then(poses[n % 3].similarity)
    window = f.shown(WINDOW, 0, 0)
    found = picture(chain, 0, window)
    assert found.any()
    np.testing.assert_array_equal(found, picture(only(placed("low", Pose.of(f))), 0, window))


def test_a_row_of_moves_by_parts_of_pixels_is_one_move():
    """By ever smaller parts: each would be the mean of finer pixels of the one before."""
    poses = [Pose(at=(1, 1), level=2 * n) for n in range(1, 8)]
    one = poses[0].similarity
    for pose in poses[1:]:
        one = one.then(pose.similarity)
    found = picture(in_one_another(7, poses), 0, WINDOW)
    assert found.any()
    np.testing.assert_array_equal(found, picture(only(placed("low", Pose.of(one))), 0, WINDOW))


def test_parts_cut_out_of_parts_are_what_lies_in_all():
    poses, part = [Pose(at=(5, 2)), Pose(at=(0, 0), turn=1)], SourcePart(0, Rect(-30, -20, 40, 30))
    nested = picture(in_one_another(3, poses, part), 0, WINDOW)
    inner = Group(70, "g", visible=False, children=(placed("low", poses[0]),))
    outer = Group(71, "h", visible=False, children=(Placement(72, "in", of=70, pose=poses[1], part=part),))
    by_groups = only(inner, outer, Placement(73, "out", of=71, pose=poses[0], part=part))
    assert nested.any()
    np.testing.assert_array_equal(nested, picture(by_groups, 0, WINDOW))


def test_a_turned_placement_of_thousands_is_drawn():
    chain = in_one_another(2000, [Pose(at=(2, 1)), Pose(at=(-2, -1))])
    turned = replace(chain, children=(*chain.children[:-1], replace(chain.children[-1], pose=TURNED)))
    near = only(placed("low", Pose(at=(2, 1)), visible=False), Placement(51, "turned", of=50, pose=TURNED))
    found = picture(loops.checked(turned), 0, WINDOW)
    assert found.any()
    np.testing.assert_array_equal(found, picture(near, 0, WINDOW))
