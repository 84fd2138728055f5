"""The hand: the brush changes only as a whole record, and keeps its name and textures until another is taken."""

import pytest

from app.desk.hand import HISTORY, LARGEST, SMALLEST, Hand
from engine.brush.settings import Brush
from engine.painting.commands import parse

FUR, MOSS = (parse({"do": "texture", "name": name, "maker": "rock"}) for name in ("fur", "moss"))


def test_a_brush_that_is_altered_keeps_its_name_and_textures_and_another_brings_its_own():
    hand = Hand()
    hand.take(Brush(radius=3.0), "Pen", (FUR,))
    hand.change(radius=5.0, hardness=0.25)
    assert (hand.brush, hand.preset, hand.needs) == (Brush(radius=5.0, hardness=0.25), "Pen", (FUR,))
    hand.take(Brush(radius=4.0))
    assert (hand.brush, hand.preset, hand.needs) == (Brush(radius=4.0), "Pen", (FUR,))
    hand.take(Brush(), "Round", ())
    assert (hand.preset, hand.needs) == ("Round", ())


def test_the_brush_and_the_tool_change_only_through_the_hand():
    hand = Hand()
    for name in ("brush", "preset", "needs", "tool", "erasing"):
        with pytest.raises(AttributeError):
            setattr(hand, name, getattr(hand, name))


def test_a_texture_that_is_brought_takes_the_place_of_the_one_of_its_name():
    hand, other = Hand(), parse({"do": "texture", "name": "fur", "maker": "rock", "period": 20})
    hand.bring(FUR, MOSS)
    hand.bring(other)
    assert hand.needs == (MOSS, other)


def test_only_the_brush_erases():
    hand = Hand()
    hand.use("pan")
    hand.erase()
    assert (hand.tool, hand.erasing) == ("brush", True)
    hand.use("zoom")
    assert (hand.tool, hand.erasing) == ("zoom", False)
    hand.erase(False)
    assert (hand.tool, hand.erasing) == ("brush", False)


def test_the_size_stays_within_bounds():
    hand = Hand()
    for factor, end in ((1.5, LARGEST), (0.5, SMALLEST)):
        for _ in range(60):
            hand.resize(factor)
        assert hand.brush.radius == end


def test_the_brush_is_dipped_into_the_colour_and_the_colour_remembered_once():
    hand = Hand()
    hand.colour = (1.0, 0.0, 0.0)
    hand.swap()
    assert (hand.colour, hand.other_colour) == ((1.0, 1.0, 1.0), (1.0, 0.0, 0.0))
    assert hand.dipped() == Brush(colour="#ffffff")
    for i in [*range(HISTORY + 5), 7]:
        hand.colour = (i / 100, 0.0, 0.0)
        hand.remember()
    assert len(hand.colours) == HISTORY
    assert hand.colours[:2] == [(0.07, 0.0, 0.0), ((HISTORY + 4) / 100, 0.0, 0.0)]
    assert hand.colours.count((0.07, 0.0, 0.0)) == 1
