"""What was painted here, through selections, masks, tiles, merges, moves and placements: compared with painting without
each stroke."""

import numpy as np
import pytest

from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.session.here.painted_here import LEAST_SHARE, CanvasPixel, PaintedHere
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect.at(0, 0, 64, 48)
RED, GREEN, BLUE, WHITE, YELLOW = "#ff0000", "#00ff00", "#0000ff", "#ffffff", "#ffff00"
COLOURS = (RED, GREEN, BLUE, WHITE, YELLOW, "#ff00ff", "#00ffff", "#000000")
BOX = {"do": "select", "rect": [0, 16, 8, 24, 24]}
NONE = {"do": "select", "none": True}
PLACES = ((20, 20), (44, 20), (16, 8), (15, 9), (39, 31), (40, 20), (3, 3), (60, 44), (28, 14))


def session_of(commands):
    return replay(r.Recording(r.Header(FRAME, 5), tuple(map(c.parse, commands))))


def held_by(session):
    return lambda number: session.history.at(number - session.steps.count)


def shown(session, level, x, y, held=lambda number: None):
    return PaintedHere(None, held).at(CanvasPixel(level, x, y), session.painting, session.steps)


def pixel(painting, level, x, y):
    return composite(painting.root, level, Rect.at(x, y, 1, 1), layer_planes)[:, 0, 0].astype(float)


def stroke(*points, level=0, layer=None, **brush):
    told = {"do": "stroke", "level": level, "points": [list(p) for p in points], "brush": {"radius": 8, **brush}}
    return told if layer is None else {**told, "layer": layer}


def wash(colour, layer=None, **brush):
    return stroke((-10, 20), (80, 20), radius=40, hardness=0.9, colour=colour, layer=layer, **brush)


def check(commands, places=PLACES, level=0, slack=0.006, held=held_by, most=1):
    """Every stroke that is listed changes the pixel, any other does not; `most`: how much more than it shows itself."""
    whole = session_of(commands)
    others = {}
    for n, one in enumerate(commands):
        if one["do"] in ("stroke", "fill"):
            others[n] = session_of([*commands[:n], {"do": "view"}, *commands[n + 1 :]]).painting
    for x, y in places:
        found: dict[int, float] = {}
        for one in shown(whole, level, x, y, held(whole)):
            found[one.step.index] = found.get(one.step.index, 0.0) + one.share
        assert list(found) == sorted(found, reverse=True)
        for n, other in others.items():
            change = np.abs(pixel(whole.painting, level, x, y) - pixel(other, level, x, y)).max()
            share = found.get(n, LEAST_SHARE)
            assert change <= (share * most if n in found else share) + slack, ((x, y), n, change, found)
            if n in found:
                assert change >= share / 4 - slack, ((x, y), n, change, found)


LAYERED = [
    {"do": "layer", "add": "A"},
    wash(RED, "A"),
    {"do": "layer", "add": "B"},
    stroke((10, 20), (40, 20), colour=GREEN, layer="B", opacity=0.5),
    stroke((20, 10), (20, 40), colour=BLUE, layer="B"),
]
A_GROUP = [
    {"do": "layer", "add": "A"},
    wash(RED, "A"),
    {"do": "layer", "add": "G", "kind": "group"},
    {"do": "layer", "add": "B", "group": "G"},
    stroke((10, 20), (40, 20), colour=GREEN, layer="B", opacity=0.7),
    {"do": "layer", "add": "C", "group": "G"},
    stroke((20, 4), (20, 44), colour=BLUE, layer="C", opacity=0.8),
    {"do": "layer", "set": "G", "opacity": 0.6},
]
ONE = {"do": "layer", "add": "Layer 1"}
MOVE = {"at": [5, 3], "level": 0}
SCENES = {
    "selection": [wash(RED), BOX, wash(GREEN, opacity=0.6), NONE, stroke((28, 0), (28, 40), colour=BLUE)],
    "inverse selection": [wash(RED), BOX, {"do": "select", "invert": True}, wash(GREEN, opacity=0.6)],
    "feathered selection": [wash(RED), {**BOX, "feather": 4}, wash(GREEN), {"do": "select", "grow": 3}, wash(BLUE)],
    "kept selection": [
        {**BOX, "keep": "box"},
        NONE,
        wash(RED),
        {"do": "select", "saved": "box"},
        wash(GREEN, opacity=0.6),
        {"do": "select", "ellipse": [0, 0, 0, 40, 40], "op": "intersect"},
        wash(BLUE),
    ],
    "undone selection": [BOX, wash(RED), {"do": "undo", "count": 2}, wash(GREEN), {**BOX, "op": "add"}, wash(BLUE)],
    "filled selection": [wash(RED), BOX, {"do": "fill", "brush": {"colour": GREEN, "opacity": 0.5}}],
    "outline": [wash(RED), {"do": "select", "outline": [[10, 5], [50, 20], [12, 40]], "level": 0}, wash(GREEN)],
    "brush selection": [
        wash(RED),
        {"do": "select", "stroke": {"points": [[10, 20], [44, 20]], "brush": {"radius": 9}}},
        wash(GREEN),
    ],
    "mask": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "mask": True},
        NONE,
        wash(WHITE, "A", opacity=0.5),
    ],
    "mask of a group": [*A_GROUP, BOX, {"do": "layer", "set": "G", "mask": True}],
    "group": A_GROUP,
    "clip": [
        *LAYERED,
        {"do": "layer", "add": "C"},
        wash(WHITE, "C", opacity=0.5),
        {"do": "layer", "set": "C", "clip": True},
    ],
    "merge down": [
        *LAYERED,
        {"do": "layer", "set": "B", "opacity": 0.5},
        {"do": "layer", "merge": "B"},
        stroke((40, 10), (40, 40), colour=WHITE, layer="A", opacity=0.5),
    ],
    "merge with an eraser": [
        *LAYERED,
        stroke((20, 20), (30, 20), mode="erase", opacity=0.6, layer="B"),
        {"do": "layer", "merge": "B"},
    ],
    "merge of a mask": [*LAYERED, BOX, {"do": "layer", "set": "B", "mask": True}, {"do": "layer", "merge": "B"}],
    "merge of a clip": [
        {"do": "layer", "add": "A"},
        stroke((10, 20), (30, 20), colour=RED, layer="A", opacity=0.8),
        {"do": "layer", "add": "B"},
        wash(GREEN, "B", opacity=0.5),
        {"do": "layer", "set": "B", "clip": True},
        {"do": "layer", "merge": "B"},
        wash(BLUE, "A", opacity=0.1),
    ],
    "merged twice": [
        *LAYERED,
        {"do": "layer", "merge": "B"},
        {"do": "layer", "add": "C"},
        wash(WHITE, "C", opacity=0.4),
        {"do": "layer", "merge": "C"},
    ],
    "flattened group": [*A_GROUP, {"do": "layer", "flatten": "G"}, stroke((44, 0), (44, 40), colour=WHITE)],
    "flattened": [*A_GROUP, {"do": "layer", "flatten": None}],
    "cleared": [ONE, wash(RED), {"do": "layer", "clear": "Layer 1"}, stroke((20, 20), (30, 20), colour=BLUE)],
    "cleared where selected": [ONE, wash(RED), BOX, {"do": "layer", "clear": "Layer 1"}, NONE, wash(BLUE, opacity=0.2)],
    "moved": [
        ONE,
        stroke((20, 20), (30, 20), colour=RED),
        {"do": "layer", "set": "Layer 1", **MOVE},
        wash(BLUE, opacity=0.2),
    ],
    "moved and turned": [
        ONE,
        stroke((20, 20), (30, 20), colour=RED),
        stroke((20, 14), (20, 44), colour=GREEN),
        {"do": "layer", "set": "Layer 1", "at": [40, 0], "turn": 1},
        {"do": "layer", "set": "Layer 1", "at": [64, 0], "mirror": True},
    ],
    "moved with its mask": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "mask": True},
        {"do": "layer", "set": "B", **MOVE},
        {"do": "layer", "merge": "B"},
    ],
    "scaled": [
        ONE,
        stroke((20, 20), (30, 20), colour=RED),
        wash(GREEN, opacity=0.3),
        {"do": "layer", "set": "Layer 1", "at": [4, 2], "levels": -1},
    ],
    "placement": [
        *LAYERED,
        {"do": "layer", "add": "P", "kind": "placement", "of": "B", "at": [20, 10], "turn": 1, "opacity": 0.5},
    ],
    "placement of a part": [
        *LAYERED,
        {"do": "layer", "add": "P", "kind": "placement", "of": "B", "at": [9, 3], "rect": [0, 12, 12, 16, 16]},
    ],
    "repeated placement": [
        ONE,
        stroke((20, 20), (23, 20), radius=5, colour=RED),
        {"do": "layer", "add": "P", "kind": "placement", "of": "Layer 1", "rect": [0, 12, 12, 16, 16], "repeat": True},
    ],
    "turned placement": [
        *LAYERED,
        {"do": "layer", "add": "P", "kind": "placement", "of": "B", "at": [30, -10], "c": [0.8, 0.7]},
    ],
    "baked placement": [
        *LAYERED,
        {"do": "layer", "add": "P", "kind": "placement", "of": "B", "at": [9, 3]},
        {"do": "layer", "bake": "P"},
        stroke((44, 0), (44, 40), colour=WHITE, layer="P", opacity=0.5),
    ],
    "baked and turned": [
        *LAYERED,
        {"do": "layer", "add": "P", "kind": "placement", "of": "B", "at": [30, -10], "c": [0.8, 0.7]},
        {"do": "layer", "bake": "P"},
    ],
    "placed in itself": [
        wash(RED, opacity=0.6),
        stroke((20, 20), (30, 20), colour=GREEN),
        {
            "do": "layer",
            "add": "P",
            "kind": "placement",
            "of": None,
            "levels": -1,
            "at": [8, 8],
            "rect": [0, 0, 0, 64, 48],
        },
    ],
    "copied part": [
        *LAYERED,
        BOX,
        {"do": "layer", "duplicate": "A", "to": "Part", "selected": "copy"},
        {"do": "layer", "set": "A", "visible": False},
    ],
    "copied, pasted after a change": [
        *LAYERED,
        BOX,
        {"do": "layer", "copy": "A"},
        NONE,
        {"do": "layer", "clear": "A"},
        stroke((2, 2), (30, 2), layer="A", colour=WHITE, radius=4),
        {"do": "layer", "paste": "Part"},
        {"do": "layer", "set": "B", "opacity": 0.5},
    ],
    "cut and pasted": [*LAYERED, BOX, {"do": "layer", "cut": "B"}, {"do": "layer", "paste": "Part"}],
    "cut and moved": [
        *LAYERED,
        BOX,
        {"do": "layer", "duplicate": "B", "to": "Part", "selected": "cut", "at": [7, 2], "level": 0},
    ],
    "moved part": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "selected": "cut", **MOVE},
        wash(WHITE, "A", opacity=0.3),
    ],
    "moved part, turned": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "selected": "copy", "at": [20, -10], "c": [0.8, 0.7]},
    ],
    "moved part, turned and laid": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "selected": "cut", "at": [20, -10], "c": [0.8, 0.7], "baked": 1},
    ],
    "inverted mask": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "mask": True},
        {"do": "layer", "set": "B", "mask": {"op": "invert"}},
        {"do": "layer", "set": "A", "mask": True},
        {"do": "layer", "set": "A", "mask": {"op": "off"}},
    ],
    "applied mask": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "mask": True},
        {"do": "layer", "set": "B", "mask": {"op": "apply"}},
    ],
    "merge of an inverted mask": [
        *LAYERED,
        BOX,
        {"do": "layer", "set": "B", "mask": True},
        {"do": "layer", "set": "B", "mask": {"op": "invert"}},
        {"do": "layer", "merge": "B"},
    ],
    "moved group": [*A_GROUP, {"do": "layer", "set": "G", "at": [6, -3]}, {"do": "layer", "set": "A", "opacity": 0.5}],
    "symmetry": [
        wash(RED),
        {**stroke((10, 12), (14, 30), colour=GREEN), "symmetry": {"centre": [32, 24], "count": 3, "mirror": True}},
    ],
    "wrap": [
        {"do": "layer", "add": "T"},
        {"do": "layer", "set": "T", "wrap": [0, 0, 0, 32, 32]},
        stroke((30, 4), (34, 20), colour=RED, radius=6),
        stroke((-3, 16), (70, 16), colour=GREEN, radius=4, opacity=0.6),
    ],
    "wrapped once": [
        {"do": "layer", "add": "T"},
        {"do": "layer", "set": "T", "wrap": [0, 0, 0, 32, 32]},
        {**stroke((30, 4), (34, 20), colour=RED, radius=6), "symmetry": {"centre": [3, 3], "count": 2}},
        {"do": "layer", "set": "T", "wrap": None},
    ],
    "crop": [
        stroke((20, 20), (70, 20), colour=RED),
        {"do": "frame", "rect": [16, 8, 24, 24]},
        {"do": "layer", "clear": None, "outside": True},
        stroke((30, 10), (60, 40), colour=BLUE, opacity=0.4),
    ],
}


SLOW = {name for name, commands in SCENES.items() if any({"merge", "flatten"} & set(one) for one in commands)}


@pytest.mark.parametrize("scene", [pytest.param(s, marks=pytest.mark.nightly) if s in SLOW else s for s in SCENES])
def test_a_stroke_is_told_where_the_painting_without_it_differs(scene):
    check(SCENES[scene], most=2 if "clip" in scene else 1)


def test_what_a_selection_of_like_colour_kept_off_is_not_told():
    commands = [
        stroke((20, 20), (30, 20), colour=RED),
        {"do": "select", "like": {"at": [25, 20], "level": 0}},
        wash(GREEN, opacity=0.7),
        {**BOX, "op": "add"},
        {"do": "fill", "like": {"at": [50, 40]}, "open": True, "brush": {"colour": BLUE}},
    ]
    session = Session()
    for one in commands:
        session.do(c.parse(one))
    held = held_by(session)
    assert [one.step.index for one in shown(session, 0, 22, 20, held)] == [2, 0]
    assert [one.step.index for one in shown(session, 0, 38, 30, held)] == [4]
    assert [one.step.index for one in shown(session, 0, 60, 20, held)] == []


def told(session, x, y):
    return [(one.step.index, round(one.share, 3)) for one in shown(session, 0, x, y)]


def test_strokes_of_merged_layers_lie_as_they_lay():
    session = Session()
    small = {"radius": 3, "hardness": 0.9}
    for one in (
        {"do": "layer", "add": "A"},
        {"do": "layer", "add": "B"},
        stroke((10, 10), (14, 10), colour=GREEN, layer="B", **small),
        stroke((12, 10), (20, 10), colour=RED, layer="A", **small),
        {"do": "layer", "set": "B", "opacity": 0.25},
        {"do": "layer", "merge": "B"},
        stroke((16, 10), (24, 10), colour=BLUE, layer="A", opacity=0.5, **small),
    ):
        session.do(c.parse(one))
    assert told(session, 8, 10) == [(2, 0.25)]
    assert told(session, 11, 10) == [(3, 0.75), (2, 0.25)]
    assert told(session, 20, 10) == [(6, 0.5), (3, 0.5)]
    assert told(session, 24, 10) == [(6, 0.5)]
    session.do(c.Undo(2))
    assert told(session, 20, 10) == [(3, 1.0)]


def test_what_was_copied_of_strokes_that_are_undone_hides_what_lies_below():
    """It is no stroke of the steps that are done; while those are, or are again, it is."""
    small = {"radius": 6, "hardness": 1}
    session = Session()
    for one in (
        {"do": "layer", "add": "A"},
        wash(RED),
        BOX,
        stroke((20, 20), (30, 20), colour=GREEN, **small),
        {"do": "layer", "set": "A", "mask": True},
        {"do": "layer", "copy": "A"},
    ):
        session.do(c.parse(one))
    held = lambda number: held_by(session)(number) or session.painting  # noqa: E731  # the last is that of the present
    paste = c.parse({"do": "layer", "paste": "B"})
    session.do(paste)
    assert [one.step.index for one in shown(session, 0, 22, 20, held)] == [3]
    session.do(c.Undo(4))
    session.do(c.Redo(3))
    session.do(paste)
    assert [one.step.index for one in shown(session, 0, 22, 20, held)] == [3]
    session.do(c.Undo(4))
    session.do(c.parse(NONE))
    session.do(paste)
    assert shown(session, 0, 22, 20, held) == ()
    assert [one.step.index for one in shown(session, 0, 60, 40, held)] == [1]  # beside it
