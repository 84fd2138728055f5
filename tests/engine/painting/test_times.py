"""Commands may tell when they were asked for: that is kept, and changes no pixel."""

import numpy as np
import pytest

from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.times import time_of, timed
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio.studio import Studio

STROKE = {"do": "stroke", "points": [[4, 4], [28, 20, 0.7]], "brush": {"radius": 6, "ink": [{"texture": "Stone"}]}}
COMMANDS = (
    {"do": "texture", "name": "Stone", "maker": "rock", "period": 8},
    STROKE,
    {"do": "layer", "add": "Above"},
    {"do": "layer", "set": "Above", "opacity": 0.5},
    STROKE,
    {"do": "undo"},
    {"do": "redo"},
    {"do": "view", "level": 1},
)


@pytest.mark.parametrize("told", COMMANDS, ids=lambda told: told["do"])
def test_a_time_is_read_back_as_it_was_given(told):
    command = timed(c.parse(told), 1795375243.125)
    assert c.to_json(command) == {**c.to_json(c.parse(told)), "time": 1795375243.125}
    assert time_of(c.parse(c.to_json(command))) == 1795375243.125
    assert timed(command, 5.0) is command  # that of the first asking stays
    assert timed(c.parse(told), None) == c.parse(told)


@pytest.mark.parametrize("time", ["noon", True, None, [1], {"at": 1}, -1, 1e300])
def test_what_is_no_time_is_kept_but_none(time):
    command = c.parse({"do": "undo", "time": time})
    assert time_of(command) is None
    assert c.to_json(command) == {"do": "undo", "time": time}


def test_times_change_no_pixel_and_no_texture():
    plain = replay(r.Recording(commands=tuple(map(c.parse, COMMANDS))))
    told = replay(r.Recording(commands=tuple(timed(c.parse(one), 100.5 + n) for n, one in enumerate(COMMANDS))))
    assert told.painting.textures["Stone"].parameters == plain.painting.textures["Stone"].parameters
    rect = r.Header().frame
    one, other = (composite(s.painting.root, 0, rect, layer_planes) for s in (plain, told))
    assert np.array_equal(one, other)
    assert one.any()
    assert [time_of(command) for command in told.log] == [100.5 + n for n in range(len(COMMANDS))]
    assert next(told.recording().lines()).startswith('{"inkfall":1')  # an old program reads it as well


def test_the_studio_records_when_it_was_asked():
    studio = Studio(lambda result: None, lambda request: None)
    brush = c.parse({**STROKE, "brush": {"radius": 3}}).brush
    points = c.parse(STROKE).points
    asked = [q.Begin(0, (0, 0), brush), q.Points(points), q.Finish(), q.Do(c.AddLayer("Above")), q.Do(c.Undo())]
    for n, request in enumerate(asked):
        studio.do(q.at_time(request, 1000.0 + n))
    studio.do(q.Do(c.Redo()))
    assert [time_of(command) for command in studio.easel.session.log] == [1000.0, 1003.0, 1004.0, None]
