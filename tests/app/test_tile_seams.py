"""Which textures are said not to fit a tile."""

from dataclasses import replace

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.filling.gradients import lay
from app.desk.filling.pouring import post_fill
from app.desk.guides.tile_seams import seams, tell_seams
from engine.canvas.placing.pose import SourcePart
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.fill_command import Fill, Like
from engine.studio.layer_rows import LayerRow
from engine.studio.results import Scene

CELL = SourcePart(0, Rect.at(-7, 3, 256, 192))


def desk():
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 800, 600), [].append)
    image = (("wall", "image"),)
    made.learn(scene=Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None, texture_kinds=image,
                           texture_widths=(("wall", 64),)))  # fmt: skip
    return made


def brush(**members):
    return c.parse({"do": "stroke", "points": [[0, 0]], "brush": members}).brush


@pytest.mark.parametrize(
    ("ink", "level", "fits"),
    [
        ({"texture": "rock"}, 0, False),
        ({"texture": "white"}, 0, True),
        ({"texture": "stripes", "period": 32}, 0, True),
        ({"texture": "stripes", "period": 32, "angle": 90}, 0, True),
        ({"texture": "stripes", "period": 32, "angle": 30}, 0, False),
        ({"texture": "stripes", "period": 48}, 0, False),
        ({"texture": "stripes", "period": 128}, 0, False),
        ({"texture": "stripes", "period": 128}, 1, True),
        ({"texture": "wall"}, 0, True),
        ({"texture": "wall", "period": 100}, 0, False),
    ],
)
def test_a_period_fits_that_divides_both_sides_at_the_level_painted_on(ink, level, fits):
    assert (seams(desk(), CELL, level, brush(ink=[ink])) == ()) == fits


def test_it_is_said_once_and_again_when_others_do_not_fit():
    made = desk()
    rocky = brush(ink=[{"texture": "rock"}], grain={"texture": "squares", "period": 7, "level": 0})
    tell_seams(made, CELL, 0, rocky)
    assert "“rock”, “squares”" in made.message.text
    made.say("")
    tell_seams(made, CELL, 0, rocky)
    assert made.message.text == ""
    tell_seams(made, CELL, 0, brush(ink=[{"texture": "rock"}]))
    assert "“rock”" in made.message.text


def test_fills_gradients_and_examples_tell_it_too():
    made = desk()
    row = LayerRow("Tile", False, 0, None, 0, 1.0, True, "normal", False, False, wrap=CELL)
    made.learn(scene=replace(made.known.scene, layers=(row,), active="Tile"))
    post_fill(made, Fill(brush(ink=[{"texture": "stripes", "period": 48}]), Like((3, 4), 0)))
    assert "“stripes”" in made.message.text
    lay(made, Place(10, 10, 0), 0, (0.0, 0.0), (90.0, 20.0))
    assert "“Gradient”" in made.message.text
    post_fill(made, Fill(brush(ink=[{"texture": "stripes", "period": 32}]), Like((3, 4), 0)))
    assert made.guides.seams == ()
    assert seams(made, CELL, 0, brush(mode="example", example="moss")) == ("moss",)
