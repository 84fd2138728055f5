"""Generators that come along: each shows things along a stroke, near and far, and its levels agree."""

import numpy as np
import pytest

from app.desk.holding.dipping import dipped
from app.desk.holding.generator_brushes import GENERATORS, generator_brushes
from engine.numeric.address import Rect
from engine.texture.expression.defined import expression
from engine.texture.expression.library.bundled_texts import generator_library
from engine.texture.expression.placing.centre_line import simplified
from engine.texture.expression.placing.generated import LaidStroke

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
        reduced = 0.25 * (finer[:, ::2, ::2] + finer[:, 1::2, ::2] + finer[:, ::2, 1::2] + finer[:, 1::2, 1::2])
        assert np.square(seen - reduced).mean() ** 0.5 < SHIMMER, level
    whole = laid.means(0, laid.rect(0))
    assert whole[3].max() > 0.95
    assert 0.05 < whole[3].mean() < 0.95
    assert whole[:3][:, whole[3] > 0.9].std() > 0.03


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
    assert all(dipped(one.brush, "#fe5b5b").ink == dipped(one.brush, "#000000").ink for one in found)
