"""The heights that come with tiles while the light is on: those of what is painted, whatever was painted since."""

import numpy as np
import pytest
from test_easel import Window, line

from engine.brush.settings import Brush
from engine.light.light import BY_ALPHA, BY_PICTURE
from engine.light.lit_relief import luminance
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results

TILE = (0, 0, 0)
WHOLE = Rect(0, 0, q.SCREEN_TILE, q.SCREEN_TILE)


class LitWindow(Window):
    """One that wants heights of a source, and keeps them as it keeps pixels."""

    def __init__(self, source):
        self.source, self.heights = source, {}
        super().__init__()
        for name in ("seen", "hidden"):
            self.studio.do(q.Do(c.parse({"do": "layer", "add": name})))
        self.studio.do(q.Do(c.parse({"do": "layer", "set": "hidden", "visible": False})))

    def take(self, result):
        super().take(result)
        if isinstance(result, results.Patch):
            assert (result.heights is None) == (self.source is None)
            if result.heights is not None:
                assert not result.heights.flags.writeable
                a, known = result.area, self.heights.setdefault(result.tile, np.zeros((256, 256), np.uint16))
                known[a.y0 : a.y1, a.x0 : a.x1] = result.heights

    def look(self, *tiles):
        wanted = tuple((*tile, self.revisions.get(tile, -1)) for tile in tiles)
        self.studio.look(q.Look(wanted, self.source))
        self.work()

    def stroke(self, layer, finish=True):
        """Paints on a layer by pieces, each of which is seen."""
        self.studio.do(q.Begin(0, (0, 0), Brush(radius=20.0, colour="#c0a080"), layer))
        points = line(12)
        for some in (points[:5], points[5:]):
            self.studio.do(q.Points(some))
            self.look(TILE)
        self.studio.do(q.Finish() if finish else q.Abandon())
        self.look(TILE)

    def picture(self, source):
        """The heights that the painting implies."""
        if source == "hidden":
            self.studio.do(q.Do(c.parse({"do": "layer", "set": "seen", "visible": False})))
            self.studio.do(q.Do(c.parse({"do": "layer", "set": "hidden", "visible": True})))
        planes = self.studio.easel.picture(0, WHOLE)
        return planes[3] if source == BY_ALPHA else luminance(planes)


@pytest.mark.parametrize("source", [BY_PICTURE, BY_ALPHA, "hidden"])
def test_heights_are_those_of_the_painting_after_every_change(source):
    window = LitWindow(source)
    window.look(TILE)
    window.stroke("seen")
    window.stroke("hidden")
    window.stroke("hidden", finish=False)
    assert window.heights[TILE].any()
    apart = window.heights[TILE] / 65535 - window.picture(source)
    assert abs(apart).max() <= 0.51 / 65535


def test_heights_come_when_the_light_goes_on_and_stay_away_without_it():
    window = LitWindow(None)
    window.look(TILE)
    window.stroke("seen")
    assert not window.heights
    window.source = BY_PICTURE
    window.look(TILE)
    before = window.heights[TILE].copy()
    assert before.any()
    window.source = "hidden"
    window.look(TILE)
    assert not window.heights[TILE].any()
    window.source = "a layer that is gone"
    window.look(TILE)
    assert np.array_equal(window.heights[TILE], before)
    window.source = None
    window.stroke("seen")
