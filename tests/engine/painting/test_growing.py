"""Strokes with examples: the final pixels depend on the recording alone, whatever happens on the way."""

import io
import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plantings import PLACES, alike, fresh, meadow, pixels, stroke, texture

from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.growth import is_settled, previewed, settling
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.grown import settled, waiting, with_grown
from engine.session.apply import Refusal
from engine.session.replay import replay
from engine.strokes.example_stroke import LiveGrowth, kind_of
from engine.strokes.paint_stroke import LiveStroke

__all__ = ["meadow"]

SPOTS = st.tuples(st.integers(0, 90), st.integers(0, 70))
POINTS = st.lists(SPOTS, min_size=1, max_size=3).map(lambda spots: [list(spot) for spot in spots])
EXAMPLES = st.builds(
    stroke,
    POINTS,
    level=st.sampled_from([0, 0, 0, -1]),
    seed=st.sampled_from([None, 3]),
    example=st.sampled_from("ab"),
    depth=st.sampled_from([None, None, 1]),
    radius=st.sampled_from([6, 12]),
    example_level=st.sampled_from([None, None, None, 0]),
    example_detail=st.sampled_from([0, 0, 1]),
)
COMMANDS = st.one_of(
    EXAMPLES,
    EXAMPLES,
    EXAMPLES,
    st.builds(stroke, POINTS, mode=st.just("erase"), depth=st.sampled_from([None, 0, 1]), radius=st.just(5)),
    st.builds(stroke, POINTS, mode=st.sampled_from(["paint", "smooth"]), radius=st.just(4)),
    st.builds(lambda at, name: c.Swap(0, at, name), SPOTS, st.sampled_from("ab")),
    st.builds(c.Undo, st.integers(1, 2)),
    st.builds(c.Redo, st.integers(1, 2)),
    st.just(c.DuplicateLayer("Layer 1", "Copy")),
    st.just(texture("a", "b.png", kappa=4.0)),
)


def done(session, commands, after=lambda session: None):
    for command in commands:
        try:
            session.do(command)
        except Refusal:
            continue
        after(session)
    return session


def refined(session, steps=None):
    """Refines all that waits, or takes some steps of it."""
    for layer in waiting(session.painting.root):
        states = itertools.islice(settling(previewed(layer.growth), (0, PLACES[1][1])), steps)
        *_, grown = itertools.chain([layer.growth], states)
        root = with_grown(session.painting.root, layer.name, layer.growth, grown)
        session.amend(replace(session.painting, root=root))


def replayed(session):
    text = "\n".join(session.recording().lines()).encode()
    return replay(r.read_from(io.BytesIO(text), "log", session.folder)).painting


@settings(deadline=None, max_examples=12)
@given(st.lists(COMMANDS, min_size=2, max_size=6), st.data())
def test_the_pixels_depend_on_the_recording_alone(meadow, commands, data):
    plain = done(fresh(meadow), commands)
    wanted = pixels(plain.painting)
    at_once = done(fresh(meadow), commands, refined)
    assert alike(wanted, pixels(at_once.painting))
    in_steps = done(fresh(meadow), commands, lambda s: refined(s, data.draw(st.integers(0, 9))))
    assert alike(wanted, pixels(in_steps.painting, 2))
    assert alike(wanted, pixels(replayed(in_steps), 2))
    assert plain.log == in_steps.log == at_once.log
    for session in (plain, at_once, in_steps):
        session.do(c.Undo(3))
    assert alike(pixels(plain.painting), pixels(at_once.painting))
    assert alike(pixels(plain.painting), pixels(in_steps.painting))
    for session in (plain, at_once, in_steps):
        session.do(c.Redo(3))
    assert alike(pixels(plain.painting), pixels(at_once.painting))
    assert alike(pixels(plain.painting), pixels(in_steps.painting))


@settings(deadline=None, max_examples=12)
@given(st.data())
def test_a_stroke_grows_to_the_same_pixels_however_it_is_drawn(meadow, data):
    session = done(fresh(meadow), [stroke([[20, 20], [70, 20]]), stroke([[20, 50], [70, 50]], example="b", depth=1)])
    brush = from_json(
        {"radius": 8, "spacing": 0.5, "dynamics": {}, "mode": "example", "example": data.draw(st.sampled_from("ab"))}
    )
    path = np.zeros((15, 6))
    path[:, 0], path[:, 1], path[:, 2] = 10 + 4 * np.arange(15), 35, 1.0  # a dab on every point
    whole = session.do(c.Stroke(0, (0, 0), path[[0, -1]], brush))
    session.do(c.Undo())
    live = session.begin(0, (0, 0), brush)
    assert isinstance(live, LiveGrowth)
    for part in np.array_split(path, data.draw(st.integers(1, 6))):
        live.add(part)
        assert live.bed.behind
        live.bed.follow()
        for grown in itertools.islice(settling(live.bed.growth), data.draw(st.integers(0, 12))):
            live.bed.follow(grown)
    assert alike(pixels(whole), pixels(session.finish(live)))
    session.do(c.Undo())
    cut = data.draw(st.integers(1, 13))
    for part in (path[: cut + 1], path[cut:]):
        session.do(c.Stroke(0, (0, 0), part, brush))
    assert alike(pixels(whole), pixels(session.painting))


def growth(session, name="Layer 1"):
    return layers.find(session.painting.root, name).growth


def test_depths_and_examples_join_replace_or_lie_over(meadow):
    line = [[10, 30], [80, 30]]
    across = [[45, 5], [45, 70]]
    join = done(fresh(meadow), [stroke(line), stroke(across)])
    take = done(fresh(meadow), [stroke(line), stroke(across, example="b")])
    over = done(fresh(meadow), [stroke(line), stroke(across, example="b", depth=1)])
    assert [plot.name for plot in growth(join)] == ["a"]
    assert sorted(plot.name for plot in growth(take)) == ["a", "b"]
    assert [(plot.name, plot.depth) for plot in growth(over)] == [("a", 0.0), ("b", 1.0)]
    covered = [
        sum(int(t.data.sum()) for t in plot.region.masks[0].values()) for s in (take, over) for plot in growth(s)
    ]
    assert sum(covered[:2]) < sum(covered[2:])


def test_redefining_a_texture_changes_nothing_that_is_painted(meadow):
    session = done(fresh(meadow), [stroke([[10, 30], [80, 30]])])
    before = pixels(session.painting)
    done(session, [texture("a", "b.png")])
    assert alike(before, pixels(session.painting))
    done(session, [stroke([[45, 5], [45, 70]])])  # the same name, another example: it takes the place
    assert len(growth(session)) == 2


def test_the_eraser_takes_paint_and_all_examples_or_those_of_a_depth(meadow):
    both = [
        stroke([[10, 60]], mode="paint"),
        stroke([[30, 30]]),
        stroke([[40, 30]], example="b", depth=2),
    ]
    session = done(fresh(meadow), [*both, stroke([[10, 60], [30, 30], [40, 30]], mode="erase", radius=30)])
    assert growth(session) == ()
    assert not any(picture.any() for picture in pixels(session.painting))
    session = done(fresh(meadow), [*both, stroke([[10, 60], [30, 30], [40, 30]], mode="erase", radius=30, depth=2)])
    assert [plot.depth for plot in growth(session)] == [0.0]
    assert pixels(session.painting)[1][3, 76, 26] == 1.0  # the paint


def test_paint_over_an_example_makes_paint_of_it_and_elsewhere_does_not(meadow):
    session = done(fresh(meadow), [stroke([[20, 20]]), stroke([[85, 75]], mode="paint", radius=3)])
    assert len(growth(session)) == 1
    before = pixels(session.painting)
    session.do(stroke([[24, 20]], mode="paint", radius=3, colour="#ff0000"))
    assert growth(session) == ()
    after = pixels(session.painting)
    assert np.allclose(after[1][:, 36, 40], (1, 0, 0, 1))
    assert np.array_equal(after[1][:, 80:], before[1][:, 80:])
    assert np.array_equal(after[1][:, 20:60, 20:30], before[1][:, 20:60, 20:30])
    session.do(c.Undo())
    assert alike(before, pixels(session.painting))
    session.do(c.Redo())
    assert alike(after, pixels(session.painting))


def test_a_live_stroke_of_paint_shows_what_its_commit_will_be(meadow):
    """Over an example, which it makes paint of, and with the eraser, which takes it away."""
    for brush in ({"mode": "paint", "colour": "#00ff00"}, {"mode": "erase"}):
        session = done(fresh(meadow), [stroke([[20, 20], [60, 20]])])
        refined(session)
        live = session.begin(0, (0, 0), from_json({"radius": 6, "dynamics": {}, **brush}))
        assert isinstance(live, LiveStroke)
        for x in (5, 30, 45):
            live.add(np.array([[x, 25.0]]))
            if live.bed is not None:
                live.bed.follow()
        assert live.flattened == (brush["mode"] == "paint")
        after = session.finish(live)
        direct = done(fresh(meadow), [stroke([[20, 20], [60, 20]]), live.to_command()])
        assert alike(pixels(after), pixels(direct.painting))


def test_whatever_looks_at_the_canvas_sees_the_final_pixels(meadow):
    canvas = c.parse({"do": "texture", "name": "piece", "maker": "canvas", "rect": [0, 10, 10, 40, 30]})
    clone = stroke([[40, 60]], mode="raster", op={"name": "clone", "layer": "Layer 1", "offset": [0, -40]}, radius=8)
    found = []
    for after in (lambda session: None, refined):
        session = done(fresh(meadow), [stroke([[10, 20], [70, 20]]), c.AddLayer("top")], after)
        done(session, [canvas, stroke([[40, 60]], mode="paint", radius=20), clone], after)
        found.append((session.painting.textures["piece"].source, pixels(session.painting)))
    assert found[0][0] == found[1][0]
    assert alike(found[0][1], found[1][1])
    assert found[0][1][1][0, 76, 56] != 0.0


@pytest.mark.parametrize(("level", "far"), [(60, 1 << 90), (-70, -(1 << 40)), (4096, 1 << 5000)])
def test_examples_grow_at_any_level_and_place(meadow, level, far):
    places = ((level, Rect.at(far, far, 100, 80)), (level - 2, Rect.at(far >> 2, far >> 2, 30, 30)))
    found = []
    for count in (1, 2):
        session = fresh(meadow)
        for x, name in ((20, "a"), (50, "b"), (60, "a")):
            told = c.to_json(stroke([[x, 30], [x + 20, 40]], level, example=name)) | {"origin": [far, far]}
            session.do(c.parse(told))
        session.do(c.Swap(level, (far + 20, far + 30), "b"))
        found.append(pixels(session.painting, count, places))
    assert alike(*found)
    assert found[0][0][3].any()
    assert found[0][1][3].any()


def test_an_eraser_may_be_as_large_as_it_likes(meadow):
    grown = [stroke([[20, 20]]), stroke([[60, 60]], depth=1)]
    path = [[9, 9], [20, 20]]
    session = done(fresh(meadow), [*grown, stroke(path, mode="erase", radius=4000, depth=1, example_level=8)])
    assert [plot.depth for plot in growth(session)] == [0.0]
    session.do(stroke([[9, 9]], mode="erase", radius=2500))
    assert growth(session) == ()


def test_an_eraser_under_alpha_lock_takes_nothing(meadow):
    lock = c.SetLayer("Layer 1", alpha_locked=True)
    session = done(fresh(meadow), [stroke([[20, 20]]), lock])
    before = growth(session)
    session.do(stroke([[20, 20]], mode="erase"))
    assert growth(session) is before


def test_swapping_an_example_is_one_step(meadow):
    session = done(fresh(meadow), [stroke([[20, 20], [60, 20]]), stroke([[20, 60], [60, 60]], depth=1)])
    before = pixels(session.painting)
    session.do(c.Swap(0, (40, 20), "b"))
    assert [plot.name for plot in growth(session)] == ["b", "a"]
    assert growth(session)[0].shown  # at once, as coarse as it is
    direct = done(fresh(meadow), [stroke([[20, 20], [60, 20]], example="b"), stroke([[20, 60], [60, 60]], depth=1)])
    assert alike(pixels(session.painting), pixels(direct.painting))
    session.do(c.Swap(1, (80, 40), "b", detail=1))
    session.do(c.Undo(2))
    assert alike(before, pixels(session.painting))
    assert c.parse(c.to_json(session.log[-2])) == c.Swap(1, (80, 40), "b", detail=1)


REFUSED = {
    "no such texture": (stroke([[9, 9]], example="c"), "brush.example: found 'c', nothing of that name, expected a t"),
    "another kind": (stroke([[9, 9]], example="r"), "brush.example: found 'r', a texture of kind rock"),
    "level too far": (stroke([[9, 9]], example_level=9), "brush.example_level: found 9, expected from -8 to 8"),
    "too large": (stroke([[9, 9]], radius=100, example_level=5), "brush.radius: found 3200 px on the example's level"),
    "alpha lock": (stroke([[9, 9]], layer="locked"), "found layer 'locked' with locked alpha"),
    "alpha lock, erased": (stroke([[9, 9]], layer="locked", mode="erase", depth=1), "with locked alpha"),
    "alpha lock, swapped": (c.Swap(0, (50, 50), "b", "locked"), "swap: found layer 'locked' with locked alpha"),
    "swap nothing": (c.Swap(0, (5, 5), "b"), "swap: found nothing painted with an example there on layer"),
    "swap of another depth": (c.Swap(0, (50, 50), "b", depth=3.0), "swap: found nothing painted"),
    "swap for nothing": (c.Swap(0, (50, 50), "c"), "swap.example: found 'c', nothing of that name"),
    "swap on no layer": (c.Swap(0, (50, 50), "b", "x"), "'x'"),
}


@pytest.mark.parametrize(("command", "told"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_is_refused_in_a_line(meadow, command, told):
    rock = c.DefineTexture("r", "rock")
    lock = [c.AddLayer("locked"), c.SetLayer("locked", alpha_locked=True), c.SelectLayer("Layer 1")]
    session = done(fresh(meadow), [rock, stroke([[50, 50]]), *lock])
    before, log = session.painting, list(session.log)
    with pytest.raises(Refusal) as caught:
        session.do(command)
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)
    assert session.painting is before
    assert session.log == log


def test_a_stroke_that_becomes_too_large_is_as_it_was(meadow):
    session = fresh(meadow)
    brush = from_json({"radius": 2, "dynamics": {}, "mode": "example", "example": "a"})
    live, plain = session.begin(0, (0, 0), brush), kind_of(brush)(session.painting, 0, (0, 0), brush)
    for one in (live, plain):
        one.add(np.array([[5.0, 5.0], [20.0, 5.0]]))
    with pytest.raises(ValueError, match="squares"):
        live.add(np.array([[1e6, 5.0]]))
    for one in (live, plain):
        one.add(np.array([[30.0, 20.0]]))
    assert alike(pixels(live.commit()), pixels(plain.commit()))
    assert len(live.to_command().points) == 3


def test_amending_is_no_step_and_undo_keeps_what_was_refined(meadow):
    session = done(fresh(meadow), [stroke([[20, 20], [60, 20]])])
    state, log = session.state, list(session.log)
    refined(session)
    assert session.state is state
    assert session.log == log
    assert is_settled(growth(session))
    wanted = growth(session)
    done(session, [stroke([[20, 60]]), c.Undo()])
    assert growth(session) is wanted  # not grown again
    refined(session)
    done(session, [c.Undo(), c.Redo()])
    assert growth(session) is wanted
    held = session.history.held
    done(session, [c.Redo(), c.Undo()])
    assert session.history.held == held
    assert settled(session.painting) is session.painting


def test_a_wet_stroke_takes_up_what_was_grown_however_its_points_come(meadow):
    wet = from_json({"radius": 8, "hardness": 0.6, "wet": {"amount": 0.8, "length": 0.9}, "dynamics": {}})
    points = np.zeros((24, 6))
    points[:, 0], points[:, 1], points[:, 2] = np.linspace(2, 90, 24), 30.0, 1.0  # from bare canvas onto what is grown
    found = []
    for portion in (24, 1):
        session = fresh(meadow)
        session.do(stroke([[60, 30]], example="a", radius=14))
        live = session.begin(0, (0, 0), wet)
        for start in range(0, len(points), portion):
            live.add(points[start : start + portion])
        session.finish(live)
        found.append(pixels(session.painting))
    assert alike(*found)
