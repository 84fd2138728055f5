"""Recordings and paintings that tell of placements, selections, fills and the like what cannot be."""

import json
from collections.abc import Iterator
from typing import Any

FRAME = [0, 0, 64, 48]
HEAD = {"inkfall": 2, "frame": FRAME, "seed": 7}
FAR, DEEPEST = 10**400, 4096
NAN, INF = float("nan"), float("inf")  # as JSON writes them: NaN, Infinity
Commands = list[Any]
# What stands in the place of each member once.
WRONG = (None, True, "x", "", -1, 0, 4097, -4097, 0.5, 1e308, 1e-320, FAR, NAN, -INF, [], {}, [[]], [[0]], ["x", {}])


def stroke(*points: list[float], **more: Any) -> dict[str, Any]:
    return {"do": "stroke", "points": list(points) or [[8, 8], [50, 40]], "brush": {"radius": 6}, **more}


def layer(verb: str, name: Any, **more: Any) -> dict[str, Any]:
    return {"do": "layer", verb: name, **more}


def placed(name: str, of: Any, **more: Any) -> dict[str, Any]:
    return layer("add", name, kind="placement", of=of, **more)


def select(**more: Any) -> dict[str, Any]:
    return {"do": "select", **more}


def fill(**more: Any) -> dict[str, Any]:
    return {"do": "fill", "brush": {"colour": "#206080"}, **more}


def like(x: int, y: int, **more: Any) -> dict[str, Any]:
    return {"like": {"at": [x, y], **more}}


RAMP = [[0, "#ff0000"], [1, "#0000ff80"]]
GROUND = [layer("add", "A"), stroke(), layer("add", "B"), stroke([20, 20])]
HALF = {"levels": -1, "rect": [0, *FRAME], "at": [10, 10]}
RING = stroke([20, 10], [44, 10], [44, 38], [20, 38], [20, 12], brush={"radius": 2, "hardness": 1, "dynamics": {}})
# One of each new command and member, all of them right.
RIGHT: dict[str, dict[str, Any]] = {
    "placement": placed("P", "A", at=[3, 4], level=1, levels=-1, turn=1, mirror=True, rect=[0, 0, 0, 9, 9]),
    "turned": placed("P", "A", c=[0.6, 0.8], repeat=True, rect=[0, 0, 0, 9, 9], to=1, group=None),
    "moved": layer("set", "A", at=[3, 4], levels=1, turn=2),
    "bake": layer("bake", "P"),
    "merge": layer("merge", "B"),
    "flatten": layer("flatten", None),
    "clear": layer("clear", "A", outside=True),
    "mask": layer("set", "A", mask="kept"),
    "clip": layer("set", "B", clip=True, opacity=0.5),
    "wrap": layer("set", "A", wrap=[0, 0, 0, 32, 32]),
    "role": layer("set", "B", role="reference"),
    "copy": layer("duplicate", "A", to="C", selected="copy", aside=True),
    "copy of a part": layer("copy", "A"),
    "cut": layer("cut", "A"),
    "picture": layer("add", "C", kind="picture", texture="ramp", level=1, at=[2, 3], role="reference"),
    "pictures": layer(
        "add",
        "C",
        kind="pictures",
        texture="ramp",
        level=1,
        at=[2, 3],
        children=[
            {"name": "D", "part": [0, 0, 1, 1], "at": [3, 4], "opacity": 0.5, "visible": False, "clip": True},
            {"name": "E", "children": [{"name": "F", "part": [0, 0, 1, 1]}], "blend": "multiply", "isolated": False},
        ],
    ),
    "painting": layer(
        "add", "C", kind="painting", texture="ramp", level=1, at=[2, 3], children=["D", {"name": "E", "children": []}]
    ),
    "frame": {"do": "frame", "rect": [1, 2, 30, 40]},
    "paper": {"do": "paper", "colour": "#f0e0d0"},
    "guide": {
        "do": "guide",
        "name": "g",
        "kind": "symmetry",
        "level": 1,
        "at": [3, 4],
        "points": [[0, 0], [0, 9]],
        "count": 6,
    },
    "bookmark": {"do": "bookmark", "name": "b", "level": 1.5, "origin": [0, 0], "size": [20, 20], "angle": 3},
    "expression": {
        "do": "texture",
        "name": "w",
        "maker": "expression",
        "text": "a = slider(0.5, 0, 1); a*noise(x, y)",
        "period": 64,
        "level": 1,
        "seed": 3,
        "values": {"a": 0.25},
    },
    "gradient": {
        "do": "texture",
        "name": "r",
        "maker": "gradient",
        "kind": "radial",
        "from": [0, 0],
        "to": [9, 9],
        "level": 1,
        "ramp": RAMP,
    },
    "rect": select(rect=[1, 10, 10, 30, 30], op="add", feather=2, grow=1, keep="k"),
    "ellipse": select(ellipse=[0, 10, 10, 30, 30]),
    "outline": select(outline=[[0, 0], [30, 0], [9, 20]], level=1, origin=[2, 2]),
    "selecting stroke": select(
        stroke={"points": [[9, 9], [30, 30]], "brush": {"radius": 9}, "level": 1, "origin": [1, 1]}
    ),
    "selecting like": select(**like(9, 9, tolerance=0.2, gap=2, rect=[0, 0, 30, 30], of=None, contiguous=False)),
    "by a layer": select(layer="A", level=1),
    "by what was kept": select(saved="kept", op="intersect", level=0),
    "fill": fill(**like(30, 24, level=0, tolerance=0.2, gap=2, rect=[0, 0, 60, 40], of="A"), open=True, layer="B"),
    "filled selection": fill(level=1),
    "copies": stroke(copies=[[0, 1, 5, 5, True], [0.5, 0, 1, 2]]),
    "symmetry": stroke(symmetry={"centre": [30, 20], "count": 3, "mirror": [0, 1]}),
}
BEFORE = [
    *GROUND,
    {"do": "texture", "name": "ramp", "maker": "gradient", "from": [0, 0], "to": [9, 9], "ramp": RAMP},
    select(ellipse=[0, 8, 8, 40, 30], keep="kept"),
]
FIRST = {"bake": [placed("P", "A", at=[5, 5])]}  # what some of them need besides


def put(told: Any, path: tuple[Any, ...], value: Any, gone: bool = False) -> Any:
    """A command with another value at a path, or without that member."""
    key, *more = path
    out = dict(told) if isinstance(told, dict) else list(told)
    if gone and not more:
        del out[key]
    else:
        out[key] = put(out[key], tuple(more), value, gone) if more else value
    return out


def members_of(told: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths of all that a command tells."""
    for key, value in told.items() if isinstance(told, dict) else enumerate(told):
        if key != "do":
            yield (*path, key)
            if isinstance(value, dict | list):
                yield from members_of(value, (*path, key))


def wrong_members(name: str) -> Iterator[tuple[str, Commands]]:
    """Recordings with one member wrong or missing of one of the RIGHT commands."""
    told = RIGHT[name]
    for path in members_of(told):
        at = ".".join(map(str, path))
        for value in WRONG:
            yield f"{name}: {at} {str(value)[:9]}", [*BEFORE, *FIRST.get(name, []), put(told, path, value)]
        yield f"{name}: no {at}", [*BEFORE, *FIRST.get(name, []), put(told, path, None, gone=True)]


def lines(commands: Commands) -> bytes:
    """A recording of commands, as bytes."""
    return "\n".join(map(json.dumps, [HEAD, *commands])).encode() + b"\n"
