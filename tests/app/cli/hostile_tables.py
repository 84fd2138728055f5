"""Recordings that tell what cannot be, or too much, by what is wrong with them."""

from itertools import pairwise
from typing import Any

from hostile import (
    BEFORE,
    DEEPEST,
    FAR,
    FRAME,
    GROUND,
    HALF,
    RIGHT,
    RING,
    Commands,
    fill,
    layer,
    like,
    placed,
    select,
    stroke,
)


def _chain(count: int, **pose: Any) -> Commands:
    """So many placements, each of the one before."""
    names = ["A", *(f"p{i}" for i in range(count))]
    return [*GROUND[:2], *(placed(name, of, **pose) for of, name in pairwise(names))]


def _fan(count: int, **pose: Any) -> Commands:
    """Groups of two placements of the group before: 2^count copies of a layer."""
    out, last = GROUND[:2], "A"
    for i in range(count):
        group = f"g{i}"
        out = [*out, layer("add", group, kind="group", group=None)]
        out += [placed(f"{group} {side}", last, group=group, at=[side * 7, i], **pose) for side in (0, 1)]
        last = group
    return out


def _hidden(commands: Commands) -> Commands:
    """Only the topmost node of a fan is seen."""
    last = [told for told in commands if told.get("kind") == "group"][:-1]
    return [*commands, *(layer("set", told["add"], visible=False) for told in last)]


TURN = {"c": [0.6, 0.8], "at": [5, 3]}
MANY: dict[str, Commands] = {
    "a chain of 3,000 exact placements": _chain(3000, at=[1, 0]),
    "a chain of 3,000 turned placements": _chain(3000, **TURN),
    "a chain of 3,000 halves": _chain(3000, levels=-1, at=[5, 3]),
    "a chain of 3,000 of which one is seen": [
        *_chain(3000, at=[1, 0]),
        *(layer("set", f"p{i}", visible=False) for i in range(2999)),
    ],
    "3,000 placements of one layer": [*GROUND[:2], *(placed(f"p{i}", "A", at=[i % 60, i // 60]) for i in range(3000))],
    "3,000 turned placements of one layer": [
        *GROUND[:2],
        *(placed(f"p{i}", "A", at=[i % 60, i // 60], c=[0.9, 0.3]) for i in range(3000)),
    ],
    "a fan of 2^20": _fan(20),
    "a fan of 2^20 of which one is seen": _hidden(_fan(20)),
    "a turned fan of 2^20": _hidden(_fan(20, c=[0.9, 0.3])),
    "a fan of 2^60": _hidden(_fan(60)),
    "a fan of halves, 2^20": _hidden(_fan(20, levels=-1)),
    "16 copies of the painting in itself": [
        *GROUND,
        *(placed(f"p{i}", None, **{**HALF, "at": [i * 3, i * 2]}) for i in range(16)),
    ],
    "200 copies of the painting in itself": [
        *GROUND,
        *(placed(f"p{i}", None, **{**HALF, "at": [i % 30, i // 8]}) for i in range(200)),
    ],
    "1,000 selections that are kept": [*GROUND, *(select(rect=[0, i, 0, 9, 9], keep=f"k{i}") for i in range(1000))],
    "1,000 masks set": [*BEFORE, *[layer("set", "A", mask="kept"), layer("set", "A", mask=None)] * 500],
    "255 copies of a large dab": [
        *GROUND,
        stroke([0, 0], brush={"radius": 60}, copies=[[1, 0, i, i] for i in range(255)]),
    ],
    "255 copies far apart": [*GROUND, stroke([0, 0], copies=[[1, 0, i << 20, -i << 20] for i in range(255)])],
    "255 copies, 1024 times as large": [*GROUND, stroke([0, 0], copies=[[1024, 0, i * 9, i] for i in range(255)])],
    "an outline of 100,000 points": [
        *GROUND,
        select(outline=[[i % 317 * 7 % 64, i % 211 * 5 % 48] for i in range(100_000)]),
    ],
    "a gradient of 65 stops": [*GROUND, {**RIGHT["gradient"], "ramp": [[i / 64, "#ffffff"] for i in range(65)]}],
    "grown by 4,096 px at every turn": [
        *GROUND,
        *[select(rect=[0, 0, 0, 9, 9], grow=4096, feather=4096), select(grow=4096)] * 6,
    ],
}

SHRINKING: dict[str, Commands] = {
    "of itself at scale 1": [*GROUND, placed("P", None, rect=[0, *FRAME])],
    "of itself at scale 2": [*GROUND, placed("P", None, rect=[0, *FRAME], levels=1)],
    "of itself at .51": [*GROUND, placed("P", None, rect=[0, *FRAME], levels=-1, c=[1.02, 0])],
    "of itself without a rect": [*GROUND, placed("P", None, levels=-1)],
    "of itself repeated": [*GROUND, placed("P", None, **HALF, repeat=True)],
    "of its own name": [*GROUND, placed("P", "P", **HALF)],
    "of nobody": [*GROUND, placed("P", "nobody")],
    "in a loop, multiplied": [*GROUND, placed("P", None, **HALF), layer("set", "P", blend="multiply")],
    "in a loop, made larger": [*GROUND, placed("P", None, **HALF), layer("set", "P", levels=0)],
    "in a loop, without its rect": [*GROUND, placed("P", None, **HALF), layer("set", "P", rect=None)],
    "in a loop, repeated later": [*GROUND, placed("P", None, **HALF), layer("set", "P", repeat=True)],
    "into the group it shows": [
        *(*GROUND, layer("add", "G", kind="group"), layer("move", "B", to=0, group="G")),
        *(placed("P", "G", group=None), layer("move", "P", to=0, group="G")),
    ],
    "one another, at scale 1": [
        *(*GROUND, layer("add", "G", kind="group"), layer("add", "H", kind="group", group=None)),
        *(placed("P", "G", group="H", rect=[0, *FRAME]), placed("Q", "H", group="G", rect=[0, *FRAME])),
    ],
    "one another, halved once": [
        *(*GROUND, layer("add", "G", kind="group"), layer("add", "H", kind="group", group=None)),
        *(placed("P", "G", group="H", rect=[0, *FRAME]), placed("Q", "H", group="G", **HALF)),
    ],
    "a group that holds it, moved into it": [
        *(*GROUND, layer("add", "G", kind="group"), layer("add", "H", kind="group", group="G")),
        layer("move", "G", to=0, group="H"),
    ],
    "a source that is removed": [*GROUND, placed("P", "A"), layer("remove", "A")],
    "a source in a group that is removed": [
        *(*GROUND, layer("add", "G", kind="group"), layer("move", "A", to=0, group="G"), placed("P", "A", group=None)),
        layer("remove", "G"),
    ],
    "a source that is merged": [*GROUND, placed("P", "B"), layer("merge", "B")],
    "a source that is flattened": [*GROUND, placed("P", "B"), layer("flatten", None)],
    "a source that becomes a placement of it": [
        *GROUND,
        placed("P", "A"),
        layer("set", "A", c=[0.6, 0.8]),
        layer("set", "A (source)", levels=3),
    ],
    "baked of the painting": [*GROUND, placed("P", None, **HALF), layer("bake", "P")],
    "baked at level 4096": [*GROUND, placed("P", "A", levels=4096, level=DEEPEST), layer("bake", "P")],
    "at level 4096": [*GROUND, placed("P", "A", level=DEEPEST, at=[1, 1], levels=-DEEPEST)],
    "at level -4096": [*GROUND, placed("P", "A", level=-DEEPEST, at=[1, 1])],
    "2^8192 times as large": [*GROUND, placed("P", "A", levels=8192)],
    "2^-8192 times as large": [*GROUND, placed("P", "A", levels=-8192)],
    "of itself at 2^-8192": [*GROUND, placed("P", None, rect=[0, *FRAME], levels=-8192)],
    "of itself, of a rect at level 4096": [*GROUND, placed("P", None, rect=[DEEPEST, 0, 0, 1, 1], levels=-1)],
    "of itself, of a rect at level -4096": [*GROUND, placed("P", None, rect=[-DEEPEST, 0, 0, 1, 1], levels=-1)],
    "of itself, of a rect without end": [*GROUND, placed("P", None, rect=[0, -FAR, -FAR, 2 * FAR, 2 * FAR], levels=-1)],
    "repeated, a cell of 2^-4096 px": [*GROUND, placed("P", "A", rect=[DEEPEST, 0, 0, 1, 1], repeat=True)],
    "repeated, a cell of 10^400 px": [*GROUND, placed("P", "A", rect=[0, 0, 0, FAR, 1], repeat=True)],
    "repeated and turned, a cell of a pixel": [
        *GROUND,
        placed("P", "A", rect=[6, 0, 0, 1, 1], repeat=True, c=[0.6, 0.8]),
    ],
    "repeated far away": [*GROUND, placed("P", "A", rect=[0, 0, 0, 9, 9], repeat=True, at=[FAR, -FAR])],
    "turned, at 10^400": [*GROUND, placed("P", "A", c=[0.6, 0.8], at=[FAR, FAR])],
    "turned by the least that there is": [*GROUND, placed("P", "A", c=[1, 5e-324])],
}

SELECTING: dict[str, Commands] = {
    "nothing by a rect that is subtracted": [
        *GROUND,
        select(rect=[0, 0, 0, 9, 9]),
        select(op="subtract", rect=[0, 0, 0, 9, 9]),
    ],
    "nothing by layers apart": [*GROUND, select(rect=[0, 1000, 0, 9, 9]), select(op="intersect", layer="A")],
    "nothing shrunk": [*GROUND, select(rect=[0, 0, 0, 9, 9], grow=-100)],
    "nothing of an empty layer": [*GROUND, layer("add", "C"), select(layer="C")],
    "all that is not all": [*GROUND, select(all=True), select(invert=True)],
    "a rect of 2^-4096 px": [*GROUND, select(rect=[DEEPEST, 0, 0, 1, 1]), stroke()],
    "a rect of level -4096": [*GROUND, select(rect=[-DEEPEST, 0, 0, 1, 1]), stroke()],
    "a rect 10^400 px away": [*GROUND, select(rect=[0, FAR, -FAR, 9, 9]), stroke(), layer("clear", "A")],
    "a rect of 10^400 px": [*GROUND, select(rect=[0, 0, 0, FAR, 9])],
    "a rect of 2^40 px": [*GROUND, select(rect=[0, 0, 0, 1 << 40, 9])],
    "an ellipse of 65,536 px": [*GROUND, select(ellipse=[0, 0, 0, 65536, 65536])],
    "a long thin ellipse": [*GROUND, select(ellipse=[0, 0, 0, 65536, 1], grow=4096)],
    "an outline of no area": [*GROUND, select(outline=[[0, 0], [30, 0], [60, 0]])],
    "an outline far out": [*GROUND, select(outline=[[0, 0], [16777216, 0], [0, 16777216]])],
    "an outline at 1e300": [*GROUND, select(outline=[[0, 0], [1e300, 0], [0, 1e300]])],
    "a stroke of 4000 px": [*GROUND, select(stroke={"points": [[0, 0], [9000, 9000]], "brush": {"radius": 4000}})],
    "a stroke that erases": [*GROUND, select(stroke={"points": [[9, 9]], "brush": {"mode": "erase"}})],
    "a stroke with copies": [*GROUND, select(stroke={"points": [[9, 9]], "copies": [[1, 0, 2, 2]]})],
    "like a pixel far away": [*GROUND, select(**like(10**30, 3))],
    "like in too large a rect": [*GROUND, select(**like(3, 3, rect=[0, 0, 1 << 20, 1 << 20]))],
    "like a pixel outside its rect": [*GROUND, select(**like(3, 3, rect=[100, 100, 9, 9]))],
    "like with a gap of 1024": [*GROUND, select(**like(3, 3, gap=1024))],
    "like at level 4096": [*GROUND, select(**like(3, 3, level=DEEPEST, rect=[0, 0, 90, 90]))],
    "like at level -4096": [*GROUND, select(**like(0, 0, level=-DEEPEST, rect=[0, 0, 9, 9]))],
    "kept of nobody": [*GROUND, select(saved="nobody")],
    "a layer that is not there": [*GROUND, select(layer="nobody")],
    "two shapes": [*GROUND, select(rect=[0, 0, 0, 9, 9], all=True)],
    "a mask that is not kept": [*GROUND, layer("set", "A", mask="nobody")],
    "a mask of nothing selected": [*GROUND, layer("set", "A", mask=True)],
    "a mask of a placement": [*BEFORE, placed("P", "A"), layer("set", "P", mask="kept")],
    "copied where there is no paint": [
        *GROUND,
        select(rect=[0, 999, 0, 9, 9]),
        layer("duplicate", "A", to="C", selected="copy"),
    ],
    "cut of a group": [*GROUND, layer("add", "G", kind="group"), layer("duplicate", "G", to="C", selected="cut")],
    "cut of a layer that is locked": [
        *GROUND,
        layer("set", "A", locked=True),
        layer("duplicate", "A", to="C", selected="cut"),
    ],
    "pasted before it is copied": [*GROUND, layer("duplicate", "C", to="D")],
    "pasted with nothing copied": [*GROUND, layer("paste", "C")],
    "pasted under a name that is taken": [*GROUND, layer("copy", "A"), layer("paste", "B")],
    "pasted as 1": [*GROUND, layer("copy", "A"), layer("paste", 1)],
    "copied of a group": [*GROUND, layer("add", "G", kind="group"), layer("copy", "G")],
    "cut of a locked layer": [*GROUND, layer("set", "A", locked=True), layer("cut", "A")],
}

PAINTING: dict[str, Commands] = {
    "a fill that leaks": [*GROUND, fill(**like(60, 2))],
    "a fill that leaks through a gap": [*GROUND, RING, fill(**like(30, 24, rect=[0, 0, 60, 40]))],
    "a fill of nothing selected": [*GROUND, fill()],
    "a fill of all": [*GROUND, select(all=True), fill()],
    "a fill of all but a part": [*GROUND, select(rect=[0, 0, 0, 9, 9]), select(invert=True), fill()],
    "a fill outside its rect": [*GROUND, fill(**like(30, 24, rect=[100, 100, 9, 9]))],
    "a fill of 10^400 px": [*GROUND, fill(**like(30, 24, rect=[0, 0, FAR, 9]), open=True)],
    "a fill of 2^24 px": [*GROUND, fill(**like(30, 24, rect=[-2000, -2000, 4096, 4096], tolerance=1), open=True)],
    "a fill at level 4096": [*GROUND, fill(**like(3, 3, level=DEEPEST, rect=[0, 0, 90, 90]), open=True)],
    "a fill at level -4096": [*GROUND, fill(**like(0, 0, level=-DEEPEST, rect=[0, 0, 9, 9]), open=True)],
    "a fill of a group": [*GROUND, layer("add", "G", kind="group"), fill(**like(3, 3), open=True, layer="G")],
    "a fill of a placement": [*GROUND, placed("P", "A"), fill(**like(3, 3), open=True, layer="P")],
    "a fill of a locked layer": [*GROUND, layer("set", "A", locked=True), fill(**like(3, 3), open=True, layer="A")],
    "a fill like nobody": [*GROUND, fill(**like(3, 3, of="nobody"), open=True)],
    "a fill with an example that is none": [
        *GROUND,
        fill(**like(3, 3), open=True, brush={"mode": "example", "example": "no"}),
    ],
    "a fill with a formula that divides by 0": [
        *GROUND,
        fill(**like(3, 3), open=True, brush={"mode": "raster", "op": {"formula": "pic/0"}}),
    ],
    "a tolerance of 2": [*GROUND, fill(**like(3, 3, tolerance=2), open=True)],
    "a gap of 1025": [*GROUND, fill(**like(3, 3, gap=1025), open=True)],
    "a torus without sides": [*GROUND, layer("set", "A", wrap=[0, 0, 0, 0, 0])],
    "a torus of 10^9 px": [*GROUND, layer("set", "A", wrap=[0, 0, 0, 10**9, 10**9]), stroke(layer="A")],
    "a torus of a pixel": [*GROUND, layer("set", "A", wrap=[0, 0, 0, 1, 1]), stroke(layer="A")],
    "a torus of 2^-4096 px": [*GROUND, layer("set", "A", wrap=[DEEPEST, 0, 0, 1, 1]), stroke(layer="A")],
    "a torus of 2^4096 px": [*GROUND, layer("set", "A", wrap=[-DEEPEST, 0, 0, 1, 1]), stroke(layer="A")],
    "a torus, painted too coarsely": [*GROUND, layer("set", "A", wrap=[0, 0, 0, 9, 9]), stroke(layer="A", level=-5)],
    "a torus, painted finely": [
        *GROUND,
        layer("set", "A", wrap=[0, 0, 0, 32, 32]),
        stroke([5, 5], layer="A", level=20),
    ],
    "a torus, moved": [*GROUND, layer("set", "A", wrap=[0, 0, 0, 32, 32]), layer("set", "A", at=[3, 3])],
    "a torus, merged": [*GROUND, layer("set", "B", wrap=[0, 0, 0, 32, 32]), layer("merge", "B")],
    "a torus of a group": [*GROUND, layer("add", "G", kind="group"), layer("set", "G", wrap=[0, 0, 0, 32, 32])],
    "a thin torus filled": [
        *GROUND,
        layer("set", "A", wrap=[0, 0, 0, 1, 32]),
        fill(**like(3, 3), open=True, layer="A"),
    ],
    "copies of scale 0": [*GROUND, stroke(copies=[[0, 0, 1, 1]])],
    "copies of 2^11": [*GROUND, stroke(copies=[[2048, 0, 1, 1]])],
    "copies beyond 2^30": [*GROUND, stroke(copies=[[1, 0, 2**31, 1]])],
    "256 copies": [*GROUND, stroke(copies=[[1, 0, i, 1] for i in range(256)])],
    "65 parts of a turn": [*GROUND, stroke(symmetry={"centre": [0, 0], "count": 65})],
    "a mirror without direction": [*GROUND, stroke(symmetry={"centre": [0, 0], "mirror": [0, 0]})],
    "copies and symmetry": [*GROUND, stroke(copies=[[1, 0, 3, 3]], symmetry={"centre": [0, 0], "count": 2})],
    "a gradient without length": [*GROUND, {**RIGHT["gradient"], "to": [0, 0]}],
    "a gradient of stops that fall": [*GROUND, {**RIGHT["gradient"], "ramp": [[1, "#ffffff"], [0, "#000000"]]}],
    "a gradient of level 4096": [
        *GROUND,
        {**RIGHT["gradient"], "level": DEEPEST},
        stroke(brush={"ink": [{"texture": "r"}]}),
    ],
    "a gradient of level -4096": [
        *GROUND,
        {**RIGHT["gradient"], "level": -DEEPEST},
        stroke(brush={"ink": [{"texture": "r"}]}),
    ],
    "a gradient of 1e-300 px": [
        *GROUND,
        {**RIGHT["gradient"], "to": [1e-300, 0]},
        stroke(brush={"ink": [{"texture": "r"}]}),
    ],
    "a gradient painted at level 4096": [
        *GROUND,
        RIGHT["gradient"],
        stroke(level=DEEPEST, brush={"ink": [{"texture": "r"}]}),
    ],
}

LAYERING: dict[str, Commands] = {
    "clipped to nothing": [*GROUND, layer("set", "A", clip=True), layer("set", "B", clip=True)],
    "clipped to a placement of itself": [
        *GROUND,
        placed("P", None, **HALF),
        layer("move", "P", to=0),
        layer("set", "A", clip=True),
    ],
    "a clipped placement of the painting": [*GROUND, placed("P", None, **HALF), layer("set", "P", clip=True)],
    "the lowest merged": [*GROUND, layer("merge", "A")],
    "a locked layer merged": [*GROUND, layer("set", "A", locked=True), layer("merge", "B")],
    "a placement of the painting merged": [*GROUND, placed("P", None, **HALF), layer("merge", "P")],
    "flattened with the painting in itself": [*GROUND, placed("P", None, **HALF), layer("flatten", None)],
    "merged onto a clipped one": [
        *GROUND,
        layer("set", "B", clip=True),
        layer("add", "C"),
        stroke(),
        layer("merge", "C"),
    ],
    "paint of two levels 8192 apart merged": [
        *GROUND,
        stroke(level=DEEPEST, layer="A"),
        stroke(level=-DEEPEST, layer="B"),
        layer("merge", "B"),
    ],
    "paint of two levels 8192 apart flattened": [
        *GROUND,
        stroke(level=DEEPEST),
        stroke(level=-DEEPEST),
        layer("flatten", None),
    ],
    "an empty painting flattened": [layer("flatten", None)],
    "an empty group flattened": [layer("add", "G", kind="group"), layer("flatten", "G")],
    "a layer flattened": [*GROUND, layer("flatten", "A")],
    "no layer cleared": [*GROUND, layer("clear", "nobody")],
    "the outside of an endless frame cleared": [
        *GROUND,
        {"do": "frame", "rect": [0, 0, 1 << 40, 1 << 40]},
        layer("clear", None, outside=True),
    ],
    "the outside of a frame far away cleared": [
        *GROUND,
        {"do": "frame", "rect": [FAR, FAR, 9, 9]},
        layer("clear", None, outside=True),
        {"do": "frame", "rect": FRAME},
    ],
    "a frame of 0": [*GROUND, {"do": "frame", "rect": [0, 0, 0, 9]}],
    "a frame of 2^41": [*GROUND, {"do": "frame", "rect": [0, 0, 1 << 41, 9]}],
    "a frame of 1.5": [*GROUND, {"do": "frame", "rect": [0, 0, 1.5, 9]}],
    "paper of a word": [{"do": "paper", "colour": "white"}],
    "paper with alpha": [{"do": "paper", "colour": "#ffffff80"}],
    "a picture of nothing": [layer("add", "C", kind="picture", texture="nothing")],
    "a picture of a gradient": [*BEFORE, layer("add", "C", kind="picture", texture="ramp")],
    "a picture whose file is gone": [
        {"do": "texture", "name": "t", "maker": "image", "path": "gone.png", "sha": "0" * 64}
    ],
    "a picture of other pixels": [
        {"do": "texture", "name": "t", "maker": "image", "path": "spots.png", "sha": "0" * 64}
    ],
    "a picture at level 4096": [
        {"do": "texture", "name": "t", "maker": "image", "path": "spots.png"},
        layer("add", "C", kind="picture", texture="t", level=DEEPEST, at=[FAR, 0]),
    ],
    "a picture at level -4096": [
        {"do": "texture", "name": "t", "maker": "image", "path": "spots.png"},
        layer("add", "C", kind="picture", texture="t", level=-DEEPEST),
    ],
    "a role that is none": [*GROUND, layer("set", "A", role="height map")],
    "a role of a group": [*GROUND, layer("add", "G", kind="group"), layer("set", "G", role="reference")],
    "the role of what is copied": [*GROUND, layer("set", "A", role="copied"), layer("duplicate", "A", to="C")],
    "a reference merged onto paint": [*GROUND, layer("set", "B", role="reference"), layer("merge", "B")],
    "a guide without points": [{"do": "guide", "name": "g", "kind": "symmetry", "points": []}],
    "a guide of another kind": [{"do": "guide", "name": "g", "kind": "spline", "points": [[0, 0], [1, 1]]}],
    "a guide beyond 2^24": [{"do": "guide", "name": "g", "kind": "symmetry", "points": [[1e9, 0], [0, 0]]}],
    "a guide that is removed twice": [RIGHT["guide"], *[{"do": "guide", "name": "g", "remove": True}] * 2],
    "two verbs": [layer("add", "A", bake="A")],
    "no verb": [{"do": "layer"}],
    "a bake of a layer": [*GROUND, layer("bake", "A")],
    "undone behind its beginning": [*GROUND, {"do": "undo", "count": 10**9}, {"do": "redo", "count": 10**9}],
    "undone 10^400 times": [*GROUND, {"do": "undo", "count": FAR}],
}
RECORDED: dict[str, Commands] = {
    f"{about}: {name}": commands
    for about, table in (
        ("placing", SHRINKING),
        ("selecting", SELECTING),
        ("painting", PAINTING),
        ("layering", LAYERING),
    )
    for name, commands in table.items()
}
