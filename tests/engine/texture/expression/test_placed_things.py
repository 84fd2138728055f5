"""Things along a stroke: the same pixels whatever else is looked at, sharp at every depth; what is refused."""

import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.texture import table
from engine.texture.expression.defined import expression
from engine.texture.expression.placing.centre_line import POINTS_MOST, simplified
from engine.texture.expression.placing.front_first import from_front
from engine.texture.expression.placing.generated import COVER_OF, Generated, LaidStroke

TREES = """leaf = fade(mix(#2c4a20, #8aa848, 0.4*random(1) - 0.6*outer(y)), fill(circle(x, y, 0.9)))
crown = scatter(leaf, 9, 0.15, circle(x, y + 0.5, 0.4) < 0, 60*random(2), 0.4)
tree = over(crown, fade(#5c4630, fill(segment(x, y, 0, 0, 0, -0.4, 0.08))))
over(row(tree, 1, size, 1, 10*(random(3) - 0.5)), fade(#807060, fill(abs(across) - 0.1)))"""
MEADOW = "scatter(fade(#d04060, fill(star(x, y, 5, 0.9, 0.4))), 7, 0.1, abs(across) < 0.6, 360*random(1))"
LINE = simplified([(0.1 * n, 0.3 * np.sin(0.2 * n), 1.0 - 0.004 * n) for n in range(80)])


def laid(text, seed=3):
    return LaidStroke(0, expression({"text": text}, 0).text, 24.0, seed, (1 << 40, -77), LINE)


@pytest.mark.parametrize("text", [TREES, MEADOW])
def test_a_piece_is_the_same_whatever_else_is_asked_for(text):
    made = laid(text)
    for level in (0, 3):
        whole = Rect.at((40 + (1 << 40)) << level, -90 << level, 70, 40)
        seen = made.means(level, whole)
        assert 0.0 < seen[3].mean() < 1.0
        assert (seen[:3] <= seen[3]).all()
        for piece in (Rect.at(whole.x0 + 31, whole.y0 + 3, 9, 30), Rect.at(whole.x0 + 1, whole.y0 + 7, 60, 2)):
            rows, columns = piece.slices(whole)
            assert (made.means(level, piece) == seen[:, rows, columns]).all()
    assert not (made.means(0, whole.zoomed(-3)) == laid(text, 4).means(0, whole.zoomed(-3))).all()


def test_edges_are_sharp_at_every_depth_and_outside_nothing_is():
    made = laid(TREES)
    seen = made.means(6, Rect.at(((1 << 40) + 60) << 6, -90 << 6, 96, 96))
    between = (seen[3] > 0.02) & (seen[3] < 0.98)
    assert between.mean() < 0.05
    rect = made.rect(2)
    around = rect.grown(8)
    outside = made.means(2, around).copy()
    rows, columns = rect.slices(around)
    outside[:, rows, columns] = 0.0
    assert not outside.any()


def test_a_key_tells_all_of_it():
    made = Generated(laid(TREES), COVER_OF)
    told = [list(part) if isinstance(part, tuple) else part for part in made.key]
    again = table.from_key(told, {})
    assert again is made
    assert pickle.loads(pickle.dumps(made)) is made
    assert again.key == made.key
    for place, wrong in ((3, 0), (5, [1]), (6, [1, 2]), (6, []), (6, [0.5] * 3), (2, "row(")):
        with pytest.raises(FieldError):
            table.from_key([*told[:place], wrong, *told[place + 1 :]], {})


def test_a_line_has_few_points_and_ends_where_the_stroke_does():
    places = [(0.01 * n, 0.02 * (n % 7), 1.0) for n in range(5000)]
    line = simplified(places)
    assert len(line.told) <= 3 * POINTS_MOST
    assert abs(line.points[-1, 0] - places[-1][0]) < 1e-3
    alone = simplified([(0.0, 0.0, 1.0)])
    along, across, _, size = alone.about(np.array([0.0, 3.0]), np.array([2.0, 0.0]))
    assert np.isfinite(along).all()
    assert abs(across[0]) == 2.0
    assert (size == 1.0).all()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a = along; row(fade(#ff0000, a), 1, 1)", "outer(along)"),
        ("warp(scatter(fill(x), 3, 1), x, y)", "where the texture is as it is"),
        ("scatter(row(x, 1, 1), 3, 1)", "only the stroke has a line"),
        ("row(x, 1, scatter(x, 3, 1))", "things are only looked at"),
        ("row(x, 1, #ff0000)", "a number"),
        ("row(x, x, 1)", "one that does not"),
        ("scatter(scatter(scatter(scatter(scatter(x, 2, 1), 2, 1), 2, 1), 2, 1), 2, 1)", "4 within one another"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(text, expected):
    with pytest.raises(FieldError, match="line 1, column") as caught:
        expression({"text": text}, 0)
    assert expected in str(caught.value)


def test_lines_may_have_the_names_of_the_newer_words():
    rect = Rect.at(0, 0, 16, 8)
    old = expression({"text": "row = floor(y*9); size = 0.2; outer = size*row; along = outer; along + 0.1*x"}, 0)
    new = expression({"text": "a = floor(y*9); b = 0.2; c = b*a; d = c; d + 0.1*x"}, 0)
    assert (old.appearance(0, rect) == new.appearance(0, rect)).all()
    assert old.at(0).whole is None


@given(st.lists(st.tuples(st.sampled_from([-2.0, -0.0, 0.0, 0.5, 3.0]), st.integers(0, 3)), max_size=40))
def test_the_order_from_front_to_back_is_by_depth_then_number_then_place(things):
    depth, number = np.array(things, np.float64).reshape(-1, 2).T
    assert (from_front(depth, number) == np.lexsort((number, -depth))).all()
