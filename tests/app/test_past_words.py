"""The history: what steps are called, and which are shown together."""

import pytest
from immutables import Map

from app.desk.past.past_state import runs_of, step_name
from app.panels.past.film_strip import _ICONS
from engine.painting import commands as c
from engine.session.steps import LoggedStep
from engine.studio.past.step_words import _SIGNS, told

BOX = {"do": "select", "rect": [0, 1, 1, 9, 9]}
FILL = {"do": "fill", "like": {"at": [1, 1]}}
STROKE = {"do": "stroke", "points": [[1, 1]]}


def step(number, command):
    return told(LoggedStep(number, number + 1, {number: c.parse(command)}, Map()), 0)


WORDS = {
    "Select: rectangle": BOX,
    "Select more: ellipse": {"do": "select", "ellipse": [0, 1, 1, 9, 9], "op": "add"},
    "Select less: like colour": {"do": "select", "like": {"at": [1, 1]}, "op": "subtract"},
    "Select: outline": {"do": "select", "outline": [[0, 0], [9, 1], [3, 9]], "level": 0},
    "Select: mask of “A”": {"do": "select", "mask": "A"},
    "Invert selection": {"do": "select", "invert": True},
    "Fill: Paint": FILL,
    "Fill: Erase": {**FILL, "brush": {"mode": "erase"}},
    "Fill: Multiply": {**FILL, "brush": {"mode": "raster", "op": "multiply"}},
    "Adjust: Levels": {
        "do": "fill",
        "whole": True,
        "brush": {"mode": "raster", "op": {"name": "levels", "black": 0.1}},
    },
    "Sharpen": {**STROKE, "brush": {"mode": "raster", "op": "sharpen"}},
    "Formula": {**STROKE, "brush": {"mode": "raster", "op": {"formula": "pic"}}},
    "Paint on the mask: Paint": {**STROKE, "onto": "mask"},
    "Paint": STROKE,
    "Move “A”": {"do": "layer", "set": "A", "at": [1, 1]},
    "Turn “A”": {"do": "layer", "set": "A", "at": [1, 1], "c": [0.8, 0.7]},
    "Mirror “A”": {"do": "layer", "set": "A", "mirror": True},
    "Move a part of “A”": {"do": "layer", "set": "A", "at": [1, 1], "selected": "cut"},
    "Order of “A”": {"do": "layer", "move": "A", "to": 1},
    "Merge “A” down": {"do": "layer", "merge": "A"},
    "Cut “A”": {"do": "layer", "cut": "A"},
    "Paste “A”": {"do": "layer", "paste": "A"},
    "Merge visible": {"do": "layer", "flatten": None},
    "Apply mask of “A”": {"do": "layer", "set": "A", "mask": {"op": "apply"}},
    "Unlock “A”": {"do": "layer", "set": "A", "locked": False},
}


@pytest.mark.parametrize("words", WORDS)
def test_steps_are_called_what_an_artist_would(words):
    assert step_name(step(0, WORDS[words]), ()) == words


def test_fills_selections_and_moves_of_a_layer_are_shown_together_and_apart_from_strokes():
    move = WORDS["Move “A”"]
    commands = [STROKE, STROKE, FILL, FILL, STROKE, BOX, {"do": "select", "invert": True}, move, move, STROKE]
    runs = runs_of([step(n, command) for n, command in enumerate(commands)])
    assert [len(run.steps) for run in runs] == [2, 2, 1, 2, 2, 1]


def test_every_step_that_is_no_stroke_has_an_icon():
    signs = {step(0, command).sign for command in WORDS.values() if command["do"] != "stroke"}
    assert signs == {"selection", "fill", "move", "mask", "merge", "layer", "copy"}
    assert signs <= _ICONS.keys()
    assert set(_SIGNS.values()) <= _ICONS.keys()
