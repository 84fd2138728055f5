"""Layers that wrap around: shown as a cell without end, on which strokes lie as on a torus."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.manifest import FORMAT, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate
from engine.canvas.placing.cells import Repeats
from engine.canvas.placing.pose import SourcePart
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.value import Refusal
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio.moving.placed_stroke import areas_of

CELL = Rect.at(-24, 16, 256, 128)  # of whole pixels down to level -3
LOOKS = {
    "paint": {"colour": "#a03010", "opacity": 0.6, "flow": 0.5, "hardness": 0.3},
    "window": {"tip": {"texture": "rock", "from": "window"}, "spacing": 0.6},
    "erase": {"mode": "erase", "opacity": 0.7},
    "multiply": {"mode": "raster", "op": "multiply", "colour": "#40a060"},
    "smooth": {"mode": "smooth", "radius": 14},
}


def wrap(cell=CELL, level=0, name="Layer 1"):
    told = None if cell is None else [level, cell.x0, cell.y0, cell.width, cell.height]
    return {"do": "layer", "set": name, "wrap": told}


def stroke(points, origin=(0, 0), level=0, **brush):
    told = {"do": "stroke", "level": level, "origin": list(origin), "points": points}
    return told | {"brush": {"radius": 9, "colour": "#2060c0", "dynamics": {}, **brush}}


def painted(*commands):
    session = Session()
    for command in ({"do": "layer", "add": "Layer 1"}, *commands):
        session.do(c.parse(command))
    return session


def seen(session, rect, level=0):
    return composite(session.painting.root, level, rect, lambda one, at, part: layer_planes(one, at, part))


def own(session, rect, level=0):
    (layer,) = layers.layers(session.painting.root)
    return evaluate(layer.pyramid, level, rect).rgba


def moved(rect, x, y):
    return Rect(rect.x0 + x, rect.y0 + y, rect.x1 + x, rect.y1 + y)


places = st.tuples(st.integers(-600, 600), st.integers(-600, 600)).map(lambda at: [at[0] / 2, at[1] / 2])


@settings(deadline=None, max_examples=4)
@given(st.lists(places, min_size=1, max_size=4), st.sampled_from((0, 1, -2)))
def test_a_tile_is_that_of_the_strokes_painted_again_in_all_cells_around(points, level):
    """The oracle lays the dabs of all cells in one coverage by plain copies, over paint of every cell."""
    period = (CELL.width * 2.0**level, CELL.height * 2.0**level)
    wide = max(abs(v) for point in points for v in point) * 2 / min(period) + 3
    many = range(-min(7, int(wide)), min(7, int(wide)) + 1)
    shifts = [[1, 0, i * period[0], j * period[1]] for j in many for i in many if i or j]
    points = [[x / 4, y / 4] for x, y in points]
    line = stroke(points, level=level, opacity=0.6, radius=7)
    wrapped, plain = painted(wrap(), line), painted(line | {"copies": shifts[:255]})
    cell = CELL.zoomed(level)
    np.testing.assert_allclose(seen(wrapped, cell, level), own(plain, cell, level), atol=4 / 65536)
    assert seen(wrapped, cell, level)[3].max() > 0.5


@pytest.mark.parametrize("look", LOOKS)
@settings(deadline=None, max_examples=4)
@given(st.lists(places, min_size=1, max_size=5), st.sets(st.integers(1, 4)))
def test_in_any_portions_previewed_replayed_and_undone_it_is_the_same(look, points, cuts):
    session = painted(wrap(), stroke([[90, 80], [140, 100]], radius=40))
    before = session.painting
    command = c.parse(stroke(points, **LOOKS[look]))
    live = session.begin(command.level, command.origin, command.brush, command.layer, command.seed)
    for part in np.split(command.points, sorted(cuts)):
        live.add(part)
    preview = live.preview(CELL).rgba
    session.finish(live)
    np.testing.assert_array_equal(preview, own(session, CELL))
    told = [json.loads(line) for line in session.recording().lines()]
    assert told[0]["inkfall"] == 2
    again = replay(r.Recording(r.Header(), tuple(map(c.parse, told[1:]))))
    for level in (0, -2, 1):
        np.testing.assert_array_equal(seen(again, CELL.zoomed(level), level), seen(session, CELL.zoomed(level), level))
    session.do(c.Undo())
    assert session.painting.root is before.root


@settings(deadline=None, max_examples=8)
@given(st.lists(places, min_size=1, max_size=3), st.integers(-9, 9), st.integers(-1 << 200, 1 << 200))
def test_where_it_was_painted_from_matters_by_whole_cells_not_at_all(points, across, down):
    here = painted(wrap(), stroke(points))
    there = painted(wrap(), stroke(points, (across * CELL.width, down * CELL.height)))
    np.testing.assert_array_equal(own(here, CELL), own(there, CELL))


@settings(deadline=None, max_examples=8)
@given(st.integers(-3, 3), st.integers(-3, 3), st.integers(-40, 300), st.integers(-40, 200), st.integers(-3, 3))
def test_the_picture_is_the_tile_again_and_again(across, down, x, y, level):
    session = painted(wrap(), stroke([[-30, 20], [220, 150]], opacity=0.7, hardness=0.2))
    rect = Rect.at(x, y, 90, 70).zoomed(max(level, -3))
    shift = [int(n * side * 2.0**level) for n, side in ((across, CELL.width), (down, CELL.height))]
    np.testing.assert_array_equal(seen(session, rect, level), seen(session, moved(rect, *shift), level))


@pytest.mark.parametrize("level", [-3, -1, 0, 1, 3])
def test_at_the_rim_it_goes_on_as_in_the_middle(level):
    """The same strokes half a cell on: what lay on the rim lies in the middle, at every level."""
    half = CELL.width // 2, CELL.height // 2
    lines = [([[20, 16], [60, 40]], 20, "#c03020", 0), ([[-24, 70], [-20, 100]], 8, "#30a050", 1)]
    lines.append(([[232, 144], [225, 140]], 12, "#f0e020", 0))

    def made(x, y):
        strokes = (
            stroke(
                [[(px + x) * 2**at, (py + y) * 2**at] for px, py in points], level=at, radius=wide, colour=colour,
                opacity=0.8, hardness=0.2,
            )
            for points, wide, colour, at in lines
        )  # fmt: skip
        return painted(wrap(), *strokes)

    there = moved(CELL, *half).zoomed(level)
    np.testing.assert_allclose(
        seen(made(0, 0), CELL.zoomed(level), level), seen(made(*half), there, level), atol=8 / 65536
    )


spans = st.tuples(st.integers(-90, 90), st.integers(-90, 90), st.integers(1, 60), st.integers(1, 60))


@given(spans, spans, st.integers(1, 40), st.integers(1, 40))
def test_what_is_seen_again_and_again_is_found_wherever_it_is(part, rect, width, height):
    part, rect, cell = Rect.at(*part), Rect.at(*rect), Rect.at(3, -5, width, height)
    found = Repeats(part, cell)
    shown = Rect(0, 0, 0, 0)
    columns = [n for n in range(rect.x0, rect.x1) if any(part.x0 <= n + k * width < part.x1 for k in range(-250, 251))]
    rows = [n for n in range(rect.y0, rect.y1) if any(part.y0 <= n + k * height < part.y1 for k in range(-250, 251))]
    if columns and rows:
        shown = Rect(columns[0], rows[0], columns[-1] + 1, rows[-1] + 1)
    assert found.meets(rect) == (not shown.empty)
    if not shown.empty:
        assert found.intersect(rect) == shown


def test_a_live_stroke_tells_of_little_more_than_its_new_dabs_also_over_the_rim():
    cell = Rect.at(-24, 16, 1024, 1024)
    session = painted(wrap(cell))
    command = c.parse(stroke([[900, 60], [960, 60], [995, 60], [1010, 60]]))
    live = session.begin(command.level, command.origin, command.brush, command.layer, command.seed)
    live.add(command.points[:2])
    live.add(command.points[2:])
    seen = areas_of(live, 0, live.areas)
    (area,) = seen(0)
    assert seen(1) == []
    assert area.meets(Rect.at(-24, 60, 4, 4))  # it came in at the other side
    assert area.meets(Rect.at(995 - 3 * 1024, 60 + 1024, 4, 4))
    assert not area.meets(Rect.at(300, 16, 300, 1024))
    assert not area.meets(Rect.at(-24, 400, 1024, 300))


AROUND = {
    "smooth": {"mode": "smooth", "radius": 30},
    "evened": {"mode": "raster", "op": {"name": "smooth", "reach": 9}, "radius": 24},
    "sharpened": {"mode": "raster", "op": {"name": "sharpen", "reach": 9}, "radius": 24},
    "displaced": {"mode": "raster", "op": {"name": "displace", "distance": 20}, "radius": 24},
}


@pytest.mark.parametrize("look", AROUND)
def test_what_looks_around_sees_over_the_rim(look):
    """Smoothed, sharpened or shifted at the rim as in the middle: what lies at the other side lies beside it."""
    half = CELL.width // 2, CELL.height // 2

    def made(x, y):
        ground = [[[-22, 60], [-14, 110]], [[228, 70], [224, 90]], [[60, 18], [100, 20]], [[80, 140], [110, 142]]]
        lines = [
            stroke([[px + x, py + y] for px, py in points], radius=7, hardness=1, colour=colour)
            for points, colour in zip(ground, ("#c03020", "#30a050", "#f0e020", "#2030c0"), strict=True)
        ]
        over = stroke([[-24 + x, 50 + y], [-24 + x, 130 + y], [90 + x, 16 + y]], **AROUND[look])
        return painted(wrap(), *lines, over)

    there = moved(CELL, *half)
    there, here = seen(made(*half), there), seen(made(0, 0), CELL)
    assert np.abs(here[3, 30:60, :8] - here[3, 30:60, 8:16]).max() > 0
    np.testing.assert_allclose(here, there, atol=8 / 65536)


def test_the_cell_is_kept_in_files_told_by_commands_and_taken_off(tmp_path):
    session = painted(wrap(), stroke([[-24, 60], [10, 90]]))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    found = open_painting(tmp_path / "a.ora").painting
    (layer,) = found.root.children
    assert layer.wrap == SourcePart(0, CELL)
    assert format_of(session.painting) == FORMAT
    for told in (wrap(), wrap(None)):
        command = c.parse(told)
        assert c.to_json(command) == told
        assert r.version_of(command) == 2
    assert seen(session, moved(CELL, 2 * CELL.width, 0)).any()
    session.do(c.parse(wrap(None)))
    assert not seen(session, moved(CELL, 2 * CELL.width, 0)).any()
    session.do(c.Undo())
    assert session.painting.root.children[0].wrap is not None


def test_what_cannot_be_is_refused_and_nothing_is_lost():
    session = painted(wrap(), stroke([[0, 60]]))
    before = session.painting
    with pytest.raises(Refusal, match="zoom in"):
        session.do(c.parse(stroke([[0, 0]], level=-4)))
    with pytest.raises(Refusal, match="on this tile"):
        session.do(c.parse(stroke([[0, 0]], radius=300)))
    tiny = painted(wrap(Rect.at(0, 0, 2, 1)))
    with pytest.raises(Refusal, match="found a tile of 2 x 1 px at this level, expected at least 3 px each way"):
        tiny.do(c.parse(stroke([[0, 0]])))
    tiny.do(c.parse(stroke([[0, 0]], level=2, radius=1)))
    with pytest.raises(Refusal, match="wrap-around off"):
        session.do(c.parse({"do": "layer", "set": "Layer 1", "at": [5, 5]}))
    with pytest.raises(Refusal, match="wrap-around off"):
        session.do(c.parse({"do": "layer", "flatten": None}))
    assert session.painting is before
    for wrong in ([0, 0, 0, 0, 5], [0, 1, 2, 3], 7, [5000, 0, 0, 1, 1]):
        with pytest.raises(FieldError):
            c.parse({"do": "layer", "set": "Layer 1", "wrap": wrong})


@settings(deadline=None, max_examples=6)
@given(
    st.integers(-3, 3), st.integers(-3, 3), st.booleans(), st.sampled_from(({}, {"mode": "erase"})), st.integers(0, 1)
)
def test_what_is_selected_in_any_tile_limits_strokes_in_all(across, down, inverse, look, level):
    """The oracle: the stroke without a selection, where the shape, brought into the cell, is selected; else nothing."""
    oval = {
        "do": "select",
        "ellipse": [0, CELL.x0 + 30 + across * CELL.width, CELL.y0 - 20 + down * CELL.height, 90, 70],
    }
    ground, line = stroke([[60, 90]], radius=90), stroke([[20, 30], [180, 150]], level=level, radius=40, **look)
    free, chosen = painted(wrap(), ground, line), painted(wrap(), ground, oval)
    at = CELL.zoomed(level)
    before = own(chosen, at, level)
    wide = Rect.at(at.x0 - 4 * at.width, at.y0 - 4 * at.height, 9 * at.width, 9 * at.height)
    part = np.broadcast_to(chosen.painting.selection.part(level, wide), (wide.height, wide.width))
    folded = part.reshape(9, at.height, 9, at.width).max(axis=(0, 2))
    for command in ([{"do": "select", "invert": True}] if inverse else []) + [line]:
        chosen.do(c.parse(command))
    left = 1 - folded if inverse else folded
    after, without = own(chosen, at, level), own(free, at, level)
    np.testing.assert_array_equal(after[:, left == 0], before[:, left == 0])
    np.testing.assert_array_equal(after[:, left == 1], without[:, left == 1])
    assert (after != before).any()


def test_a_selection_over_too_many_tiles_is_refused_in_a_line():
    session = painted(wrap(Rect.at(0, 0, 16, 16)), {"do": "select", "rect": [0, 0, 0, 900, 900]})
    with pytest.raises(Refusal, match="found one over 3249 tiles of the layer, expected at most 1024"):
        session.do(c.parse(stroke([[5, 5]], radius=2)))


def test_the_mask_of_a_layer_that_wraps_bounds_its_repeats_and_is_not_repeated():
    session = painted(wrap(), stroke([[20, 60], [90, 70]]))
    beyond = moved(CELL, CELL.width, 0)
    shown = [seen(session, rect) for rect in (CELL, beyond)]
    session.do(c.parse({"do": "select", "rect": [0, beyond.x0, beyond.y0, beyond.width, beyond.height]}))
    session.do(c.parse({"do": "layer", "set": "Layer 1", "mask": True}))
    assert not seen(session, CELL).any()
    np.testing.assert_array_equal(seen(session, beyond), shown[1])
    assert shown[0].any()
