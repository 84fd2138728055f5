"""What is painted on the layer of heights in the view of the land: relief of the size that is seen, at any depth."""

import dataclasses
import math

import numpy as np
import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.land.land_relief import in_relief
from app.input.events import PenEvent
from app.tools.painting_gestures import begin_stroke
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting
from engine.session.apply import Around, apply
from engine.studio.layer_rows import LayerRow
from engine.studio.requests import Begin
from engine.studio.results import Scene
from engine.terrain.plane import land

LEVEL = 15
PLACE = 70 << LEVEL, 61 << LEVEL
HILL = {"radius": 50, "colour": "#808080", "hardness": 0.1}
BEGUN = (
    {"do": "layer", "add": "Layer 1"},
    {"do": "layer", "set": "Layer 1", "role": "height", "scale": 60},
    {"do": "stroke", "points": [[70, 60], [110, 70]], "brush": HILL},
)


def begun(brush, heights=True, on=True):
    """The brush of a stroke that is begun at the level that is seen."""
    posted = []
    desk = Desk(View(Place(*PLACE, LEVEL), LEVEL, 0.0, 800, 600), posted.append)
    row = LayerRow("Layer 1", False, 0, None, 0, 1.0, True, "src-over", False, False, height=heights)
    desk.learn(scene=Scene(Rect(0, 0, 64, 64), (row,), "Layer 1", False, False, False, None))
    desk.hand.take(brush)
    desk.hand.colour = brush.rgb
    desk.land.on = on
    begin_stroke(desk, PenEvent("down", 400.0, 300.0, 0.0))
    return next(one.brush for one in posted if isinstance(one, Begin))


@pytest.mark.parametrize(("colour", "part"), [("#000000", -0.25), ("#ffffff", 0.25), ("#404040", -0.125)])
def test_paint_by_lightness_has_heights_of_the_level_seen(colour, part):
    painting = Painting(Rect.at(0, 0, 192, 128), 7)
    for told in BEGUN:
        painting = apply(painting, parse(told), Around())
    brush = begun(Brush(radius=12.0, hardness=0.0, colour=colour))
    told = {"do": "stroke", "level": LEVEL, "origin": list(PLACE), "points": [[0, 0]], "brush": {"radius": 12}}
    stroke = dataclasses.replace(parse(told), brush=brush)
    around = Rect.at(PLACE[0] - 20, PLACE[1] - 20, 40, 40)
    before, after = (land(one).height(LEVEL, around) for one in (painting, apply(painting, stroke, Around())))
    laid = np.ldexp(after - before, LEVEL)
    assert laid[20, 20] == pytest.approx(12 * part, rel=0.1)
    assert np.abs(laid).max() <= 3.01
    assert abs(laid[0, 0]) < 1e-4


@pytest.mark.parametrize(
    ("brush", "heights", "on"),
    [
        (Brush(height="auto"), True, True),
        (Brush(height=-3.0), True, True),
        (Brush(mode="erase"), True, True),
        (Brush(mode="smooth"), True, True),
        (Brush(), False, True),
        (Brush(), True, False),
    ],
)
def test_other_brushes_layers_and_views_stay_as_they_are(brush, heights, on):
    assert begun(brush, heights, on).height == brush.height


def test_relief_grows_with_the_brush():
    lying = [in_relief(Brush(radius=radius, colour="#ffffff")).height for radius in (0.5, 8.0, 900.0)]
    assert lying == pytest.approx([0.125, 2.0, 225.0])
    assert math.isclose(in_relief(Brush(colour="#000000")).height, -4.0)
