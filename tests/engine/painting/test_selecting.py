"""What strokes do where something is selected: nothing outside, in every mode; commands, undo, replay, files."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sown import (
    DEFINED,
    folder,  # noqa: F401
)

from engine.archive.manifest import FINE_FORMAT, FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import parse_header, version_of
from engine.painting.value import Refusal
from engine.session.replay import replay
from engine.session.session import Session
from engine.texture.example import tiles

WINDOW = Rect(-40, -40, 200, 180)
FEW = settings(max_examples=4, deadline=None)
BRUSHES = {
    "paint": {"colour": "#d04020"},
    "ink": {"ink": [{"texture": "rock", "amount": 0.4}]},
    "erase": {"mode": "erase"},
    "smooth": {"mode": "smooth"},
    "invert": {"mode": "raster", "op": "invert"},
    "sharpen": {"mode": "raster", "op": "sharpen"},
    "rim": {"colour": "#2060c0", "edge": {"amount": 0.8, "width": 0.3}},
}


def told(session, *commands):
    for command in commands:
        session.do(c.parse(command))
    return session


def stroke(n, level=0, **brush):
    x, y = (37 * n % 120) * 2.0**level, (53 * n % 100) * 2.0**level
    look = {"radius": 22 * 2.0**level, "colour": f"#{40 + 37 * n % 200:02x}6080", **brush}
    return {"do": "stroke", "level": level, "points": [[x, y], [x + 70, y + 30], [x + 20, y + 80]], "brush": look}


def ground():
    """A painting that has paint and ink at several levels."""
    return told(Session(), {"do": "layer", "add": "Paint"}, stroke(1), stroke(2, -1), stroke(3, 1), stroke(4))


GROUND = ground().painting


def seen(painting, level, rect=WINDOW):
    at = rect.zoomed(level)
    out = np.zeros((4, at.height, at.width), np.float32)
    found = composite(painting.root, level, at, layer_planes)
    return out if found is None else found


def selected(painting, level, rect=WINDOW):
    at = rect.zoomed(level)
    out = np.empty((at.height, at.width), np.float32)
    out[...] = painting.selection.part(level, at)
    return out


def outside(painting, level, made, by=8):
    """The pixels of a level that may not change: those not selected, and elsewhere than at the level that the strokes
    were made at, those farther from the rim than the contract says."""
    free = selected(painting, level) > 0
    if level == made:
        return ~free
    steps = by << max(0, level - made)
    around = np.pad(free, steps)
    grown = np.zeros_like(free)
    sums = np.pad(around.astype(np.int64).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    side = 2 * steps + 1
    grown = sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side] > 0
    return ~grown


shapes = st.one_of(
    st.builds(lambda x, y, w, h: {"rect": [0, x, y, w, h]}, *[st.integers(0, 60)] * 2, *[st.integers(20, 90)] * 2),
    st.builds(lambda x, y, w, h: {"ellipse": [1, x, y, w, h]}, *[st.integers(0, 120)] * 2, *[st.integers(40, 180)] * 2),
    st.builds(lambda x, y: {"outline": [[x, y], [x + 80, y + 9], [x + 33, y + 70]]}, *[st.floats(0, 60)] * 2),
    st.builds(lambda x: {"stroke": {"points": [[x, 9], [60, 90]], "brush": {"radius": 14}}}, st.floats(0, 60)),
)
changes = st.sampled_from([{}, {"feather": 3}, {"grow": 5}, {"grow": -3}, {"feather": 2, "grow": 2}])


@pytest.mark.parametrize("mode", BRUSHES)
@FEW
@given(shape=shapes, change=changes, inverse=st.booleans(), level=st.sampled_from([-1, 0, 1]))
def test_a_stroke_changes_nothing_outside_what_is_selected(mode, shape, change, inverse, level):
    session = told(Session(GROUND), {"do": "select", **shape, **change})
    if inverse:
        told(session, {"do": "select", "invert": True})
    before = session.painting
    told(session, stroke(5, level, **BRUSHES[mode]), stroke(8, level, **BRUSHES[mode]))
    after = session.painting
    for looked in (-1, 0, 1):
        away = outside(before, looked, level)
        assert (seen(after, looked)[:, away] == seen(before, looked)[:, away]).all()


@pytest.mark.parametrize("mode", ["paint", "erase", "invert", "rim"])  # which look at no pixel but their own
def test_a_stroke_within_is_the_stroke_without_a_selection(mode):
    free = told(Session(GROUND), stroke(5, 0, **BRUSHES[mode]))
    chosen = told(Session(GROUND), {"do": "select", "ellipse": [0, 9, 20, 100, 90]}, stroke(5, 0, **BRUSHES[mode]))
    inside = selected(chosen.painting, 0) == 1.0
    assert (seen(chosen.painting, 0)[:, inside] == seen(free.painting, 0)[:, inside]).all()
    assert (seen(chosen.painting, 0) != seen(free.painting, 0)).any()


def test_what_is_selected_wholly_costs_nothing_and_changes_nothing():
    free, chosen = ground(), told(ground(), {"do": "select", "all": True})
    for session in (free, chosen):
        told(session, stroke(5))
    assert (seen(free.painting, 0) == seen(chosen.painting, 0)).all()
    assert chosen.begin(0, (0, 0), c.parse(stroke(1)).brush).limit is None
    assert told(chosen, {"do": "select", "none": True}).painting.selection is None


@pytest.mark.parametrize("mode", ["paint", "erase", "smooth", "sharpen"])
def test_the_preview_is_what_is_committed(mode):
    session = told(ground(), {"do": "select", "ellipse": [0, 20, 10, 90, 80], "feather": 3})
    command = c.parse(stroke(5, 0, **BRUSHES[mode]))
    live = session.begin(command.level, command.origin, command.brush)
    for row in command.points:
        live.add(row[None])
        live.preview(WINDOW)
    preview = live.preview(WINDOW)
    done = session.finish(live)
    layer = next(iter(layers.layers(done.root)))
    assert (preview.rgba == layer_planes(layer, 0, WINDOW)).all()


def grown(folder):  # noqa: F811
    return told(Session(folder=folder), DEFINED[0], {"do": "layer", "add": "Paint"})


EXAMPLE = {"mode": "example", "example": "stripes", "radius": 30}


def plots(painting):
    return next(iter(layers.layers(painting.root))).growth


def pixels(painting, level=0):
    """The pixels of a level that anything grown takes."""
    at = WINDOW.zoomed(level)
    out = np.zeros((at.height, at.width), bool)
    for plot in plots(painting):
        for key, tile in plot.region.masks[0].items():
            place = tiles.rect_of(key)
            part = place.intersect(at)
            if not part.empty:
                out[part.slices(at)] |= tile.data[0][part.slices(place)] != 0
    return out


def test_examples_grow_and_are_erased_within_what_is_selected(folder):  # noqa: F811
    session = told(grown(folder), {"do": "select", "rect": [0, 30, 20, 50, 60]}, stroke(0, 0, **EXAMPLE))
    free = told(grown(folder), stroke(0, 0, **EXAMPLE))
    inside = selected(session.painting, 0) >= 0.5
    assert pixels(session.painting).any()
    assert (pixels(session.painting) == (pixels(free.painting) & inside)).all()
    told(free, {"do": "select", "rect": [0, 30, 20, 50, 60]}, stroke(0, 0, mode="erase", radius=30))
    assert pixels(free.painting).any()
    assert not pixels(free.painting)[inside & pixels(session.painting)].any()
    assert (pixels(free.painting) & ~inside).any()


def test_paint_outside_what_is_selected_leaves_what_grew_there_alone(folder):  # noqa: F811
    session = told(grown(folder), stroke(0, 0, **EXAMPLE), {"do": "select", "rect": [0, 400, 400, 50, 60]})
    before = plots(session.painting)
    told(session, stroke(0))
    assert plots(session.painting) is before
    told(session, {"do": "select", "none": True}, stroke(0))
    assert not plots(session.painting)


@pytest.mark.parametrize("inverse", [False, True])
def test_a_layer_is_cleared_where_it_is_selected(inverse):
    session = told(Session(GROUND), {"do": "select", "ellipse": [0, 20, 10, 90, 80]})
    if inverse:
        told(session, {"do": "select", "invert": True})
    before = seen(session.painting, 0)
    told(session, {"do": "layer", "clear": "Paint"})
    after, chosen = seen(session.painting, 0), selected(session.painting, 0)
    assert (after[:, chosen == 0.0] == before[:, chosen == 0.0]).all()
    assert before[:, chosen == 1.0].any()
    assert not after[:, chosen == 1.0].any()
    fine = Rect(50, 40, 70, 60)
    assert seen(session.painting, 2, fine).any() == inverse


def test_a_region_is_filled_within_what_is_selected():
    rect = {"do": "select", "rect": [0, 30, 20, 50, 60]}
    session = told(Session(), {"do": "layer", "add": "Paint"}, rect)
    told(session, {"do": "fill", "like": {"at": [40, 40], "rect": [0, 0, 120, 120]}, "open": True, "brush": {}})
    alpha = seen(session.painting, 0)[3]
    assert (alpha > 0).sum() == 50 * 60
    assert (alpha == selected(session.painting, 0)).all()


def test_selecting_is_a_step_and_what_is_kept_comes_back():
    session = told(Session(), {"do": "select", "rect": [0, 0, 0, 60, 60], "keep": "square"})
    first = session.painting
    told(session, {"do": "select", "op": "add", "ellipse": [0, 40, 0, 60, 60]})
    assert (selected(session.painting, 0) != selected(first, 0)).any()
    told(session, {"do": "undo"})
    assert session.painting.selection is first.selection
    told(session, {"do": "redo"}, {"do": "select", "saved": "square"})
    assert (selected(session.painting, 0) == selected(first, 0)).all()


def test_a_layer_is_selected_by_its_alpha_exactly_at_every_level():
    session = told(ground(), {"do": "select", "layer": "Paint"})
    for level in (-2, 0, 1, 3):
        rect = Rect(10, 10, 60, 50)
        assert (selected(session.painting, level, rect) == seen(session.painting, level, rect)[3]).all()


@FEW
@given(
    st.lists(
        st.tuples(st.sampled_from(["replace", "add", "subtract", "intersect"]), shapes, changes), min_size=1, max_size=5
    ),
    st.integers(0, 99),
)
def test_a_replay_and_the_file_equal_the_session(tmp_path_factory, steps, seed):
    session = ground()
    for n, (op, shape, change) in enumerate(steps):
        try:
            told(session, {"do": "select", "op": op, **shape, **change, **({"keep": "one"} if n == 1 else {})})
        except Refusal:  # nothing would be left
            continue
        told(session, stroke(seed + n, n % 2, **list(BRUSHES.values())[(seed + n) % len(BRUSHES)]))
        if n == 2:
            told(session, {"do": "undo", "count": 2}, {"do": "redo"})
    again = replay(session.recording())
    path = tmp_path_factory.mktemp("file") / "p.ora"
    save(path, Snapshot(session.painting))
    opened = open_painting(path).painting
    for painting in (again.painting, opened):
        for level in (-2, 0, 1):
            assert (seen(painting, level) == seen(session.painting, level)).all()
            if session.painting.selection is not None:
                assert (selected(painting, level) == selected(session.painting, level)).all()
        assert set(painting.selections) == set(session.painting.selections)


def test_files_and_recordings_without_selections_say_nothing_of_them(tmp_path):
    plain, chosen = ground(), told(ground(), {"do": "select", "all": True})
    assert format_of(plain.painting) == FINE_FORMAT
    assert format_of(chosen.painting) == FORMAT
    assert max(map(version_of, chosen.log)) == 2
    assert parse_header(json.loads(next(iter(chosen.recording().lines())))).frame == chosen.painting.frame
    told(chosen, {"do": "select", "none": True})
    save(tmp_path / "a.ora", Snapshot(replace(plain.painting)))
    assert b"selections" not in (tmp_path / "a.ora").read_bytes()
    assert format_of(chosen.painting) == FINE_FORMAT


@pytest.mark.parametrize(
    ("members", "message"),
    [
        ({}, "nothing to select"),
        ({"rect": [0, 0, 0, 0, 5]}, "W and H at least 1"),
        ({"rect": [4097, 0, 0, 5, 5]}, "L from -4096 to 4096"),
        ({"rect": [0, 0, 0, 1 << 40, 5]}, "take a coarser level"),
        ({"rect": [0, 0, 0, 10**400, 5]}, "found an integer of about 400 digits x 5 px"),
        ({"ellipse": [4096, 0, 0, 1 << 17, 5]}, "take a coarser level"),
        ({"rect": [0, 0, 0, 5, 5], "all": True}, "at most one of"),
        ({"rect": [0, 0, 0, 5.5, 5]}, "5 integers"),
        ({"outline": [[0, 0], [5, 5]]}, "3 points or more"),
        ({"outline": [[0, 0], [5, float("nan")], [9, 0]]}, "y from"),
        ({"outline": [[0, 0], [5, 5], [9, 9]]}, "nothing would be selected"),
        ({"outline": [[0, 0], [1e7, 1e7], [1e7, 0]]}, "take a coarser level"),
        ({"stroke": {"brush": {}}}, "stroke.points"),
        ({"stroke": {"points": [[0, 0]], "seed": 4}}, "brush, and copies or symmetry"),
        ({"layer": "none of these"}, "expected one of"),
        ({"mask": "Paint"}, "a layer or group that has one"),
        ({"mask": "none of these"}, "expected one of"),
        ({"saved": "none of these"}, "none was kept"),
        ({"op": "xor", "all": True}, '"intersect"'),
        ({"rect": [0, 0, 0, 9, 9], "grow": -5}, "nothing would be selected"),
        ({"rect": [0, 0, 0, 9, 9], "feather": -1}, "from 0 to 4096"),
        ({"rect": [0, 0, 0, 9, 9], "grow": float("inf")}, "from -4096 to 4096"),
        ({"grow": 3}, "a selection to change"),
        ({"invert": True}, "nothing would be selected"),
        ({"rect": [0, 0, 0, 9, 9], "keep": ""}, "printable"),
        ({"none": 1}, "true"),
    ],
)
def test_what_cannot_be_selected_is_refused_in_one_line(members, message):
    session = ground()
    before = session.painting
    with pytest.raises((Refusal, FieldError), match=message) as caught:
        told(session, {"do": "select", **members})
    assert "\n" not in str(caught.value)
    assert session.painting is before


@FEW
@given(
    st.integers(2, 5),
    st.sampled_from((False, True, [3, 5])),
    st.sampled_from(({}, {"tip": {"texture": "squares", "angle": 20}}, {"grain": {"texture": "rock", "amount": 0.8}})),
)
def test_a_stroke_and_its_copies_select_what_they_cover(count, mirror, look):
    line = {"points": [[10, 20], [50, 30], [40, 70]], "brush": {"radius": 9, "hardness": 0.5, **look}}
    line["symmetry"] = {"centre": [70, 60], "count": count, "mirror": mirror}
    session = told(Session(), {"do": "stroke", **line}, {"do": "select", "stroke": line})
    command = session.log[-1]
    assert c.parse(c.to_json(command)) == command
    assert command.source != replace(command.source, copies=())
    np.testing.assert_array_equal(selected(session.painting, 0), seen(session.painting, 0)[3])


@pytest.mark.parametrize("level", [-4096, 4096])
def test_the_coarsest_and_the_finest_level_can_be_selected_on(level):
    session = told(Session(), {"do": "select", "ellipse": [level, 3, 4, 70, 60]})
    part = session.painting.selection.part(level, Rect(0, 0, 90, 90))
    assert 3000 < part.sum() < 3400
