"""What is heaped stays where layers are merged, baked, moved by parts, copied: no thickness is lost silently."""

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.heaps.joined_heaps import heaps_joined
from engine.canvas.heaps.seen_heaps import heaped_on, thickness
from engine.canvas.placing.baking import leaves_heaps
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import version_of
from engine.painting.value import Painting, Refusal
from engine.session.apply import Around, apply
from engine.session.session import Session

FRAME = Rect.at(0, 0, 192, 128)
ADD = {"do": "layer", "add": "Layer 2"}
LEFT, BACK = {"points": [[40, 40]]}, {"points": [[60, 50]]}
MERGE = {"do": "layer", "merge": "Layer 2"}
SET_COPY = {"do": "layer", "set": "Copy"}


def thick(place, impasto=3, level=0, **brush):
    told = {"radius": 14, "hardness": 0.3, "colour": "#b04020", "impasto": impasto, **brush}
    return {"do": "stroke", "level": level, **place, "brush": told}


def painted(*commands):
    painting = Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(command), Around())
    return painting


def after(painting, *commands):
    for command in commands:
        painting = apply(painting, parse(command), Around())
    return painting


def thickness_of(painting, level=0, rect=FRAME):
    return thickness(painting.root, level, rect.zoomed(level))


@pytest.fixture(scope="module")
def two():
    return painted(thick(LEFT), ADD, thick(BACK, 1.5), thick(LEFT, -1, level=2))


SQUARE = {"do": "select", "rect": [0, 30, 30, 20, 20]}


@pytest.mark.parametrize(
    "commands",
    [
        [MERGE],
        [{"do": "layer", "set": "Layer 2", "opacity": 0.5}, MERGE],
        [{"do": "layer", "set": "Layer 1", "opacity": 0.5}, {"do": "layer", "set": "Layer 2", "clip": True}, MERGE],
        [{"do": "layer", "flatten": None}],
        [
            {"do": "layer", "add": "G", "kind": "group"},
            {"do": "layer", "move": "Layer 1", "group": "G", "to": 0},
            {"do": "layer", "move": "Layer 2", "group": "G", "to": 1},
            {"do": "layer", "flatten": "G"},
        ],
    ],
)
def test_merged_layers_are_as_thick_as_before(two, commands):
    *first, last = commands
    before = after(two, *first)
    merged = apply(before, parse(last), Around())
    assert sum(1 for _ in layers.layers(merged.root)) == 1
    for level in (-1, 0, 2, 3):
        found, wanted = thickness_of(merged, level), thickness_of(before, level)
        assert np.abs(wanted).max() > 0.5
        assert np.abs(found - wanted).max() < 2.0 ** (level - 10)  # few steps of the grid


def test_what_lies_on_one_layer_alone_keeps_its_bits():
    before = painted(thick(LEFT), ADD)
    merged = apply(before, parse(MERGE), Around())
    assert np.array_equal(thickness_of(merged, 3), thickness_of(before, 3))


def test_the_sum_of_heaps_is_their_sum_and_no_higher_than_one_holds(two):
    own, other = (layers.find(two.root, name).heaps for name in ("Layer 1", "Layer 2"))
    (unit,) = own
    both = heaps_joined([(own, 1.0), (other, 1.0)])
    assert {*both} == {*own, *other}
    read = [evaluate(heaps[unit], 0, FRAME).data[0] for heaps in (own, other, both) if unit in heaps]
    assert np.array_equal(sum(read[:-1]), read[-1])
    full = heaps_joined([(own, 1.0)] * 80)[unit]
    assert evaluate(full, 0, FRAME).data[0].max() == 8.0


def test_a_baked_placement_is_as_thick_as_its_source():
    turned = {
        "do": "layer",
        "add": "Copy",
        "kind": "placement",
        "of": "Layer 1",
        "at": [64, 0],
        "levels": -1,
        "turn": 1,
    }
    before = painted(thick(LEFT), turned)
    baked = apply(before, parse({"do": "layer", "bake": "Copy"}), Around())
    source, made = (layers.find(baked.root, name) for name in ("Layer 1", "Copy"))
    there = heaped_on(made, 0, Rect(-200, -200, 300, 300))
    assert there.max() == pytest.approx(heaped_on(source, 0, FRAME).max() / 2, rel=0.05)


@pytest.mark.parametrize("way", ["cut", "copy"])
def test_a_part_that_is_moved_takes_its_thickness_along(way):
    before = painted(thick(LEFT), SQUARE)
    placing = {"do": "layer", "set": "Layer 1", "at": [64, 32], "selected": way}
    there = thickness_of(apply(before, parse(placing), Around()))
    whole = thickness_of(before)
    assert np.abs(there[62:82, 94:114] - whole[30:50, 30:50]).max() < 2.0**-8
    left = 0.0 if way == "cut" else whole[40, 40]
    assert there[40, 40] == pytest.approx(left, abs=2.0**-8)
    rest = np.abs(there - whole)
    rest[28:52, 28:52] = rest[60:84, 92:116] = 0
    assert rest.max() < 2.0**-8


def test_a_part_that_is_turned_by_an_angle_loses_no_thickness():
    before = painted(thick(LEFT), SQUARE)
    turn = {"do": "layer", "set": "Layer 1", "c": [0.8, 0.6], "selected": "cut"}
    laid = apply(before, parse({**turn, "baked": 0}), Around())
    assert np.array_equal(thickness_of(laid), thickness_of(before))
    above = apply(before, parse(turn), Around())
    held = next(one for one in layers.layers(above.root) if one.name.endswith("(source)"))
    assert np.abs(heaped_on(held, 0, FRAME) + thickness_of(above) - thickness_of(before)).max() < 2.0**-8


def test_what_is_cut_and_pasted_is_as_thick():
    before = painted(thick(LEFT), SQUARE)
    for commands in (
        [{"do": "layer", "cut": "Layer 1"}, {"do": "layer", "paste": "P"}],
        [{"do": "layer", "duplicate": "Layer 1", "to": "P", "selected": "cut"}],
    ):
        found = thickness_of(after(before, *commands))
        assert np.abs(found - thickness_of(before)).max() < 2.0**-8


def test_a_group_with_heights_in_it_is_not_merged():
    heights = painted(
        thick(LEFT),
        {"do": "layer", "set": "Layer 1", "role": "height"},
        {"do": "layer", "add": "G", "kind": "group"},
        {"do": "layer", "move": "Layer 1", "group": "G", "to": 0},
    )
    with pytest.raises(Refusal, match="found it a height"):
        apply(heights, parse({"do": "layer", "flatten": "G"}), Around())


def test_merging_is_undone_saved_and_opened(two, tmp_path):
    session = Session(two)
    session.do(parse(MERGE))
    merged = thickness_of(session.painting, 2)
    session.do(parse({"do": "undo"}))
    assert np.array_equal(thickness_of(session.painting, 2), thickness_of(two, 2))
    session.do(parse({"do": "redo"}))
    assert np.array_equal(thickness_of(session.painting, 2), merged)
    save(tmp_path / "thick.ora", Snapshot(session.painting))
    again = open_painting(tmp_path / "thick.ora").painting
    assert np.array_equal(thickness_of(again, 2), merged)
    assert version_of(parse(thick(LEFT))) == 2


def test_what_is_baked_flat_is_told_before():
    at = {"do": "layer", "add": "Copy", "kind": "placement", "of": "Layer 1", "at": [64, 0]}
    before = painted(thick(LEFT), at)
    exact, turned = (layers.find(one.root, "Copy") for one in (before, after(before, {**SET_COPY, "c": [0.8, 0.6]})))
    assert not leaves_heaps(before.root, exact)
    assert leaves_heaps(before.root, turned)
    assert not leaves_heaps(painted(thick(LEFT, 0), at).root, turned)
