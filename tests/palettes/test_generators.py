"""Generators that come along: each shows things along a stroke, near and far, and its levels agree."""

import numpy as np
import pytest

from app.desk.holding.dipping import dipped
from app.desk.holding.generator_brushes import GENERATORS, generator_brushes
from engine.numeric.address import Rect
from engine.painting.value import Painting
from engine.studio.requests import Swatch
from engine.studio.textures.swatches import painted
from engine.texture.expression.defined import expression
from engine.texture.expression.library.bundled_texts import generator_library
from engine.texture.expression.placing.centre_line import simplified
from engine.texture.expression.placing.generated import LaidStroke, _drawn

NAMES = sorted(generator_library())
LINE = simplified([(0.1 * n, 0.1 * np.sin(0.2 * n), 1.0) for n in range(30)])
SHIMMER = 4.0 / 255.0  # rms, where leaves begin to be drawn one by one


SOON = ("hedge", "houses", "stone-wall")  # the others are slow proofs


@pytest.mark.parametrize("name", [pytest.param(n, marks=[] if n in SOON else [pytest.mark.nightly]) for n in NAMES])
def test_each_shows_things_near_and_far(name):
    made = expression({"text": generator_library()[name].text}, 0)
    laid = LaidStroke(0, made.text, 64.0, 5, (40, 90), LINE, made.values)
    for level, at in ((0, (60, 40)), (1, (190, 160)), (4, (1600, 1300))):
        rect = Rect.at(*at, 44, 36)
        seen, finer = laid.means(level, rect), laid.means(level + 1, rect.zoomed(1))
        assert np.isfinite(seen).all()
        tile = Rect.at(at[0] + 13, at[1] + 9, 19, 17)
        assert (seen[:, *tile.slices(rect)] == _drawn(laid, level, tile)).all(), level
        reduced = 0.25 * (finer[:, ::2, ::2] + finer[:, 1::2, ::2] + finer[:, ::2, 1::2] + finer[:, 1::2, 1::2])
        assert np.square(seen - reduced).mean() ** 0.5 < SHIMMER, level
    whole = laid.means(0, laid.rect(0))
    assert whole[3].max() > 0.95
    assert 0.05 < whole[3].mean() < 0.95
    assert (whole if "ink = pick" in made.text else whole[:3, whole[3] > 0.9]).std() > 0.03


@pytest.mark.parametrize("name", ["fence", "houses", "hedge"])
def test_season_and_style_are_seen(name):
    text = generator_library()[name].text
    known = [word for word in ("season", "style") if f"{word} = slider" in text]
    assert known
    seen = []
    for values in ({}, *({word: 1.0} for word in known)):
        made = expression({"text": text, "values": values}, 0)
        laid = LaidStroke(0, made.text, 16.0, 5, (40, 90), LINE, made.values)
        seen.append(laid.means(0, Rect.at(44, 70, 40, 30)))
    assert all(np.abs(one - seen[0]).mean() > 1e-4 for one in seen[1:]), known


def test_they_are_brushes_of_a_group():
    found = generator_brushes()
    assert {preset.group for preset in found} == {GENERATORS}
    assert {preset.brush.row.name for preset in found} == {"generate"}
    assert len({preset.name for preset in found}) == len(NAMES) >= 10
    dippings = [[dipped(one.brush, colour).ink for colour in ("#fe5b5b", "#000000")] for one in found]
    (drawn,) = [one.name for one, (red, black) in zip(found, dippings, strict=True) if red != black]
    assert drawn == "Hatching along the stroke"


def test_lines_along_the_stroke_are_of_the_hands_colour_and_leave_the_canvas_between():
    found = next(one for one in generator_brushes() if one.name == "Hatching along the stroke")
    brush = dipped(found.brush, "#fe5b5b")
    red, green, _, alpha = painted(Swatch("", brush, (312, 132), textures=found.textures), Painting())
    covered, between = (alpha > 0.7).mean(), (alpha[44:88, 100:200] < 0.1).mean()
    assert 0.05 < covered < 0.6
    assert 0.05 < between < 0.9
    assert np.abs(red - green - alpha * (0xFE - 0x5B) / 255).max() < 0.02
