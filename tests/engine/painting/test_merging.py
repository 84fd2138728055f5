"""Layers made one: what is seen stays at every level at which anything is stored, and ink goes on being refined."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.merging.merged import keeps_ink
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.numeric.grid import snapped_to, step_of
from engine.painting import commands as c
from engine.painting.recording import Header
from engine.painting.value import Refusal, first_painting
from engine.session.session import Session

WINDOW = Rect(-12, -12, 36, 30)
INKS = ([], [{"texture": "rock", "colour": "#e0d0b0", "period": 24}])


def stroke(layer, level=0, x=0, y=0, radius=14, ink=0, **brush):
    points = [[x, y], [x + 30, y + 18]]
    return {
        "do": "stroke", "layer": layer, "level": level, "points": points,
        "brush": {"radius": radius, "colour": "#a05030", "ink": INKS[ink], **brush},
    }  # fmt: skip


def done(*commands, grid=16):
    session = Session(first_painting(Header(grid=grid)))
    for command in commands:
        session.do(c.parse(command))
    return session


def do(session, **members):
    session.do(c.parse({"do": "layer", **members}))


def picture(painting, level, window=WINDOW):
    return composite(painting.root, level, window.zoomed(level), lambda one, at, rect: layer_planes(one, at, rect))


def stored(painting):
    return sorted({level for layer in layers.layers(painting.root) for level in layer.pyramid.levels})


strokes = st.builds(
    stroke,
    st.sampled_from(["low", "high"]),
    level=st.integers(-1, 1),
    x=st.integers(-12, 12),
    y=st.integers(-12, 12),
    radius=st.integers(3, 12),
    ink=st.integers(0, 1),
    opacity=st.sampled_from([0.5, 1.0]),
    hardness=st.sampled_from([0.3, 1.0]),
    colour=st.sampled_from(["#102030", "#f0c080"]),
    mode=st.sampled_from(["paint", "paint", "erase"]),
)
two = [{"do": "layer", "add": "low"}, {"do": "layer", "add": "high"}]


def as_before(session, made, grid, levels):
    before = {level: picture(session.painting, level) for level in levels}
    do(session, **made)
    for level, pixels in before.items():
        np.testing.assert_array_equal(picture(session.painting, level), snapped_to(pixels, step_of(grid)))
    return before


@settings(max_examples=2, deadline=None)
@given(st.lists(strokes, min_size=1, max_size=3), st.sampled_from([16, 12]), st.sampled_from([1.0, 0.3]))
def test_what_is_seen_stays_at_every_stored_level(painted, grid, opacity):
    session = done(*two, *painted, {"do": "layer", "set": "high", "opacity": opacity}, grid=grid)
    as_before(session, {"merge": "high"}, grid, stored(session.painting))
    assert [node.name for node in session.painting.root.children] == ["low"]


@settings(max_examples=2, deadline=None)
@given(st.lists(strokes, min_size=2, max_size=4), st.sampled_from(["multiply", "overlay", "dst-out", "src-atop"]))
def test_blend_modes_and_groups_stay_at_every_stored_level(painted, blend):
    session = done(
        *two,
        {"do": "layer", "add": "both", "kind": "group"},
        {"do": "layer", "set": "high", "blend": blend, "opacity": 0.7},
        {"do": "layer", "move": "low", "to": 0, "group": "both"},
        {"do": "layer", "move": "high", "to": 1, "group": "both"},
        *painted,
    )
    as_before(session, {"flatten": "both"}, 16, stored(session.painting))
    assert isinstance(layers.find(session.painting.root, "both"), layers.Layer)


def test_paint_beside_paint_stays_beyond_all_levels_with_its_ink():
    """Where one layer is seen, or an opaque one, nothing changes at any level: ink is refined on."""
    session = done(
        *two, stroke("low", x=-200, ink=1), stroke("low", level=1, x=-390), stroke("high", ink=1, x=120, opacity=0.6)
    )
    for level in (4,):
        for x in (-200 << level, 125 << level):
            rect = Rect.at(x, 5 << level, 64, 64)
            at = composite(session.painting.root, level, rect, lambda one, k, r: layer_planes(one, k, r))
            assert at[3].any()
            after = done(*map(c.to_json, session.log))
            do(after, merge="high")
            np.testing.assert_array_equal(
                composite(after.painting.root, level, rect, lambda one, k, r: layer_planes(one, k, r)), at
            )


def test_what_covers_is_as_it_was_at_every_level():
    session = done(*two, stroke("low", radius=40), stroke("high", radius=40, ink=1, hardness=1.0))
    rect = Rect.at(10 << 5, 8 << 5, 96, 96)
    before = composite(session.painting.root, 5, rect, lambda one, k, r: layer_planes(one, k, r))
    do(session, merge="high")
    (made,) = session.painting.root.children
    np.testing.assert_array_equal(layer_planes(made, 5, rect), before)
    assert np.unique(before[0]).size > 9


def test_all_that_is_seen_becomes_one_layer_and_what_is_hidden_stays():
    session = done(
        *two, stroke("low"), stroke("high", x=9),
        {"do": "layer", "add": "sketch"}, stroke("sketch", x=-9), {"do": "layer", "set": "sketch", "visible": False},
        {"do": "layer", "add": "top"}, stroke("top", y=12, opacity=0.5),
    )  # fmt: skip
    as_before(session, {"flatten": None}, 16, stored(session.painting))
    assert [node.name for node in session.painting.root.children] == ["low", "sketch"]
    assert session.painting.active == "low"
    session.do(c.Undo())
    assert len(session.painting.root.children) == 4


def test_ink_stays_ink_only_where_layers_lie_over_one_another():
    session = done(*two, stroke("low", ink=1), stroke("high", ink=1))
    low, high = session.painting.root.children
    assert keeps_ink((low, high))
    do(session, set="high", blend="multiply")
    assert not keeps_ink(session.painting.root.children)


def test_a_merged_layer_can_be_painted_on_saved_undone_and_replayed(tmp_path):
    session = done(
        *two, stroke("low", ink=1, radius=7), stroke("high", radius=7, x=9), {"do": "layer", "merge": "high"}
    )
    session.do(c.parse(stroke("low", level=1, x=3, radius=6, opacity=0.4)))
    again = done(*map(c.to_json, session.log))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    found = open_painting(tmp_path / "a.ora").painting
    for level in stored(session.painting):
        shown = picture(session.painting, level)
        np.testing.assert_array_equal(picture(again.painting, level), shown)
        np.testing.assert_array_equal(picture(found, level), shown)
    session.do(c.Undo(2))
    assert len(session.painting.root.children) == 2


def test_what_a_placement_shows_is_merged_with_what_lies_below():
    session = done(
        *two, stroke("low"), stroke("high", x=9),
        {"do": "layer", "add": "again", "kind": "placement", "of": "low", "at": [14, 3], "c": [0.8, 0.6]},
        {"do": "layer", "set": "low", "visible": False},
    )  # fmt: skip
    as_before(session, {"merge": "again"}, 16, [0])


def test_references_are_merged_with_references_alone_and_stay_when_all_that_is_seen_is():
    session = done(*two, stroke("low"), {"do": "layer", "add": "photo"}, stroke("photo", x=5))
    do(session, set="photo", role="reference")
    with pytest.raises(Refusal, match="'photo': found it a reference"):
        do(session, merge="photo")
    do(session, flatten=None)
    assert [node.name for node in session.painting.root.children] == ["low", "photo"]
    low = picture(done(*two, stroke("low")).painting, 0)
    do(session, set="photo", visible=False)
    np.testing.assert_array_equal(picture(session.painting, 0), low)
    do(session, set="photo", visible=True)
    do(session, set="low", role="reference")
    do(session, merge="photo")
    (made,) = session.painting.root.children
    assert (made.name, made.role) == ("low", "reference")


def test_clearing_takes_all_paint_and_only_that():
    session = done(*two, stroke("low"), stroke("high"), {"do": "layer", "set": "high", "opacity": 0.5})
    low = picture(done(*two, stroke("low")).painting, 0)
    do(session, clear="high")
    np.testing.assert_array_equal(picture(session.painting, 0), low)
    assert layers.find(session.painting.root, "high").opacity == 0.5
    session.do(c.Undo())
    assert (picture(session.painting, 0) != low).any()


@pytest.mark.parametrize(
    ("before", "made", "wrong"),
    [
        ([], {"merge": "low"}, "nothing below"),
        ([{"do": "layer", "set": "low", "locked": True}], {"merge": "high"}, "locked"),
        ([{"do": "layer", "set": "high", "visible": False}], {"merge": "high"}, "hidden"),
        ([{"do": "layer", "add": "p", "kind": "placement", "of": "high"}], {"merge": "high"}, "'p' showing it"),
        ([], {"flatten": "high"}, "no group"),
        ([{"do": "layer", "set": "high", "locked": True}], {"clear": "high"}, "locked"),
        ([{"do": "layer", "add": "g", "kind": "group"}], {"clear": "g"}, "no layer of paint"),
        ([], {"merge": "sea"}, "expected one of"),
    ],
)
def test_what_cannot_be_merged_is_refused_in_a_line(before, made, wrong):
    session = done(*two, stroke("low"), *before)
    painting = session.painting
    with pytest.raises(Refusal, match=wrong):
        do(session, **made)
    assert session.painting is painting
