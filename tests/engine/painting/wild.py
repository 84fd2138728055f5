"""Commands of every kind, drawn at random, and what has to hold of a painting that some of them made."""

import io
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial

import numpy as np
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.placement import Placement
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.journal.records import Kind, told_command
from engine.journal.story import COMMAND
from engine.journal.volume import End
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.painting.recording import parse_header, read_from
from engine.painting.value import Painting, Refusal, first_painting
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio.filing.recovering import recovered

FRAME = Rect.at(0, 0, 96, 72)
PLACES = (
    (-2, Rect.at(-6, -6, 40, 32)),
    (0, Rect.at(-20, -20, 140, 120)),
    (3, Rect.at(160, 120, 150, 130)),
    (11, Rect.at((40 << 11) + 30, (30 << 11) + 30, 40, 30)),
)
FAR = 1 << 300
NAMES = st.integers(0, 99)  # which of the nodes that there are then: see `named`
NEW_NAMES = st.sampled_from(["A", "C", "D", "E", "F", "H", "I", "J", "K", "L"])
LEVELS = st.sampled_from([*range(-6, 5), 0, 0, 0, 0, 1, 1, 2, 600, -600])
SHARES = st.integers(0, 16)
COLOURS = st.sampled_from(["#c03020", "#204060", "#ffffff"])
BLENDS = st.sampled_from(["src-over", "multiply", "screen", "dst-in", "src-atop", "plus", "color", "no blend"])
OPS = (
    "invert",
    "toward",
    {"formula": "colour - pic"},
    {"name": "displace", "distance": 5},
    {"name": "clone", "layer": "B"},
    {"name": "smooth", "reach": 2},
    "erase",
)
MODES = st.sampled_from(
    [{}, {}, {}, {"mode": "erase"}, {"mode": "smooth"}, *({"mode": "raster", "op": op} for op in OPS)]
)
INKS = st.sampled_from(
    [
        {},
        {},
        {"ink": [{"texture": "rock", "period": 16}]},
        {"ink": [{"texture": "fade"}]},
        {"edge": "dark"},
        {"grain": {"texture": "rock", "period": 9}},
        {"ink": [{"texture": "lost"}]},
    ]
)
COPIES = st.sampled_from(
    [
        {},
        {},
        {},
        {"copies": [[1, 0, 9, 0, True], [0, 0.5, 3, 0]]},
        {"symmetry": {"centre": [20, 20], "count": 6, "mirror": True}},
        {"copies": [[0, 0, 1, 1]]},
        {"copies": [[3, 1, 1e8, -1e9]]},
        {"symmetry": {"centre": [1e4, -1e4], "count": 6}},
    ]
)


@st.composite
def corners(draw):
    """A level and a pixel of it, in the frame but for now and then."""
    level = draw(LEVELS)
    x, y = (draw(SHARES) * side // 16 for side in (FRAME.width, FRAME.height))
    far = draw(st.sampled_from([0] * 14 + [FAR, -FAR]))
    return level, [(value << level if level >= 0 else value >> -level) + far for value in (x, y)]


@st.composite
def brushes(draw):
    plain = {"radius": draw(st.sampled_from([0.3, 3, 9, 25])), "colour": draw(COLOURS)}
    return plain | draw(MODES) | draw(INKS) | {"hardness": draw(st.sampled_from([0.2, 1]))}


@st.composite
def lines(draw):
    level, origin = draw(corners())
    points = draw(st.lists(st.tuples(st.integers(-30, 60), st.integers(-30, 60)), min_size=1, max_size=4))
    return {"level": level, "origin": origin, "points": [list(point) for point in points], "brush": draw(brushes())}


@st.composite
def strokes(draw):
    layer = draw(st.none() | NAMES)
    return {"do": "stroke", **draw(lines()), **draw(COPIES), **({} if layer is None else {"layer": layer})}


@st.composite
def growths(draw):
    """Strokes that grow an example, or take some of it away."""
    level, origin = draw(st.sampled_from([(0, [30, 20]), (0, [60, 40]), (1, [90, 70]), (-1, [20, 20])]))
    mode = draw(st.sampled_from(["example", "example", "erase"]))
    brush = {"mode": mode, "radius": 14, **({"example": "spots"} if mode == "example" else {})}
    depth = draw(st.sampled_from([{}, {"depth": 1}]))
    swap = {"do": "swap", "at": [40, 30], "example": draw(st.sampled_from(["spots", "lost"]))}
    grown = {"do": "stroke", "level": level, "origin": origin, "points": [[0, 0], [15, 9]], "brush": brush | depth}
    return draw(st.sampled_from([grown, grown, swap]))


@st.composite
def likes(draw):
    level, at = draw(corners())
    near = {} if draw(st.booleans()) else {"rect": [at[0] - 20, at[1] - 30, 70, 60]}
    of = draw(st.sampled_from([{}, {}, {"of": None}, {"of": 0}, {"of": 1}, {"of": 2}, {"of": 3}]))
    return {
        "at": at,
        "level": level,
        "gap": draw(st.sampled_from([0, 0, 4])),
        "tolerance": draw(st.sampled_from([0, 0.1, 1])),
        "contiguous": draw(st.booleans()),
        **near,
        **of,
    }


@st.composite
def fills(draw):
    layer = draw(st.none() | NAMES)
    where = {"like": draw(likes())} if draw(SHARES) < 12 else {"level": draw(LEVELS)}
    more = {"open": draw(st.sampled_from([True, True, False])), **({} if layer is None else {"layer": layer})}
    return {"do": "fill", **where, "brush": draw(brushes()), **more}


@st.composite
def boxes(draw):
    level, at = draw(corners())
    return [level, *at, draw(st.sampled_from([1, 7, 40, 90, 100000])), draw(st.sampled_from([1, 30, 70]))]


SHAPES = ("rect", "rect", "ellipse", "outline", "stroke", "layer", "saved", "like", "all", "none", "invert", "nothing")
RIMS = [{}, {}, {}, {"grow": 3}, {"grow": -2.5}, {"feather": 4}, {"grow": -50, "feather": 9}]


@st.composite
def selects(draw):
    kind = draw(st.sampled_from(SHAPES))
    out = {"do": "select", "op": draw(st.sampled_from(["replace", "replace", "add", "subtract", "intersect"]))}
    if kind in ("rect", "ellipse"):
        out[kind] = draw(boxes())
    elif kind == "outline":
        line = draw(lines())
        out |= {"outline": line["points"], "level": line["level"], "origin": line["origin"]}
    elif kind in ("layer", "saved"):
        out |= {kind: draw(NAMES), "level": draw(LEVELS)}
    elif kind != "nothing":
        out[kind] = draw(lines()) if kind == "stroke" else draw(likes()) if kind == "like" else True
    return out | draw(st.sampled_from(RIMS)) | draw(st.sampled_from([{}, {}, {"keep": "A"}, {"keep": "B"}]))


TURNS = [{}, {"turn": 1}, {"turn": 3}, {"c": [0.6, 0.8]}, {"c": [0.5, 0]}, {"c": [-1.9, 0.1]}]
PARTS = [
    {},
    {},
    {"rect": [0, 0, 0, 48, 40]},
    {"rect": [0, 0, 0, 96, 72]},
    {"rect": [2, 40, 40, 100, 90], "repeat": True},
]


@st.composite
def poses(draw):
    """Where a placement lies."""
    level, at = draw(corners())
    levels = draw(st.sampled_from([0, 0, -1, -1, -2, 1, 3, -300]))
    turned, part = draw(st.sampled_from(TURNS)), draw(st.sampled_from(PARTS))
    return {"at": at, "level": level, "levels": levels, "mirror": draw(st.booleans()), **turned, **part}


@st.composite
def placings(draw):
    verb, of = draw(st.sampled_from(["add", "add", "set", "duplicate"])), draw(st.none() | NAMES)
    more = {"add": {"kind": "placement", "of": of}, "set": {}, "duplicate": {"to": draw(NEW_NAMES)}}[verb]
    return {"do": "layer", verb: draw(NEW_NAMES if verb == "add" else NAMES), **more, **draw(poses())}


CELLS = ([0, 0, 0, 48, 40], [0, -5, 7, 31, 33], [1, 0, 0, 64, 64], [-3, 0, 0, 1, 1], [2, 9, 9, 1 << 40, 7], None)
VERBS = (
    "add",
    "merge",
    "flatten",
    "clear",
    "select",
    "remove",
    "rename",
    "duplicate",
    "lift",
    "copy",
    "cut",
    "paste",
    "paste",
    "move",
    "set",
    "set",
    "bake",
)
SETTINGS = [
    *({name: value} for name in ("visible", "locked", "alpha_locked", "isolated", "clip") for value in (True, False)),
    {"clip": True},
    {"opacity": 0.4},
    *({"role": role} for role in ("reference", None, "no role")),
    *({"mask": mask} for mask in ("A", "B", True, True, None)),
    *({"wrap": cell} for cell in CELLS),
]


@st.composite
def layerings(draw):
    verb = draw(st.sampled_from(VERBS))
    name = draw(NEW_NAMES if verb in ("add", "paste") else NAMES)
    if verb in ("flatten", "clear") and draw(st.booleans()):
        name = None
    if verb == "add":
        kind = draw(st.sampled_from(["layer", "group", "picture", "picture"]))
        texture = draw(st.sampled_from(["fade", "rock", "spots", "bit"]))
        picture = {"texture": texture, "level": draw(st.integers(-2, 3)), "at": [5, -7]}
        return {"do": "layer", verb: name, "kind": kind, **(picture if kind == "picture" else {})}
    if verb == "lift":
        how = {"selected": draw(st.sampled_from(["copy", "cut"])), "aside": draw(st.booleans())}
        return {"do": "layer", "duplicate": name, "to": draw(NEW_NAMES), **how}
    if verb == "move":
        return {
            "do": "layer",
            verb: name,
            "to": draw(st.integers(0, 4)),
            **draw(st.sampled_from([{}, {"group": 1}, {"group": None}])),
        }
    more = {}
    if verb == "clear":
        more = {"outside": draw(st.booleans())}
    elif verb in ("rename", "duplicate"):
        more = {"to": draw(NEW_NAMES)}
    elif verb == "set":
        more = draw(st.sampled_from(SETTINGS) | st.builds(lambda b: {"blend": b}, BLENDS))
    return {"do": "layer", verb: name, **more}


FADE = {
    "do": "texture",
    "name": "fade",
    "maker": "gradient",
    "from": [40, 30],
    "ramp": [[0, "#ff0000"], [1, "#0000ff00"]],
}
HISTORY = st.sampled_from([{"do": "undo"}, {"do": "undo", "count": 3}, {"do": "redo"}, {"do": "redo", "count": 2}])
OTHERS = st.sampled_from(
    [
        *({"do": "frame", "rect": rect} for rect in ([0, 0, 96, 72], [-20, 5, 60, 90], [FAR, 0, 9, 9])),
        *({"do": "paper", "colour": colour} for colour in ("#f0e8d8", None)),
        {"do": "guide", "name": "g", "kind": "symmetry", "at": [FAR, 4], "points": [[0.5, 0], [0.5, 9]], "count": 6},
        {"do": "guide", "name": "g", "remove": True},
        {"do": "guide", "name": "h", "kind": "line", "points": [[1, 2]]},
        {"do": "bookmark", "name": "here", "level": 3.5},
        {"do": "bookmark", "name": "here", "to": "there"},
        {"do": "bookmark", "name": "there", "remove": True},
        {"do": "view", "level": 1, "origin": [0, 0], "size": [9, 9]},
        {**FADE, "kind": "radial", "to": [90, 70]},
        {**FADE, "to": [40, 30]},
        {"do": "texture", "name": "bit", "maker": "canvas", "rect": [0, 10, 10, 40, 40]},
    ]
)
COMMANDS = st.one_of(
    *(strokes(), strokes(), fills(), selects(), selects(), placings(), placings()),
    *(layerings(), layerings(), layerings(), growths(), OTHERS, HISTORY),
)
HEADERS = st.sampled_from([{}, {"grid": 12}, {"paper": "#f0e8d8"}, {"grid": 12, "paper": "#102030"}])
BEGUN = [
    {"do": "texture", "name": "spots", "maker": "example", "path": "blob.png", "levels": 2},
    {"do": "texture", "name": "bit", "maker": "image", "path": "colour.png"},
    {**FADE, "to": [41, 80]},
    {"do": "layer", "add": "A"},
    {"do": "stroke", "points": [[20, 20], [60, 50]], "brush": {"radius": 12}},
    {"do": "layer", "add": "G", "kind": "group"},
    {"do": "layer", "add": "B", "group": "G"},
    {
        "do": "stroke",
        "level": 2,
        "points": [[100, 100], [260, 120]],
        "brush": {"radius": 30, "colour": "#20a060", "ink": [{"texture": "rock", "period": 20}]},
    },
]


# ---- what has to hold ----

_KINDS = {"bake": Placement, "flatten": Group, "group": Group, "clear": Layer, "layer": Layer, "stroke": Layer}
_KINDS |= {"copy": Layer, "cut": Layer}


def named(painting, told):
    """The command with names in the place of numbers: of nodes that there are, most often of those it is meant for."""
    nodes = list(layers.walk(painting.root))

    def name(member, number):
        fit = [node for node in nodes if isinstance(node, _KINDS.get(member, object))] if number % 8 else []
        few = fit or nodes
        return "none such" if number == 99 or not few else few[number % len(few)].name

    members = ("layer", "of", "group", *VERBS)
    out = {key: name(key, value) if key in members and type(value) is int else value for key, value in told.items()}
    if told.get("do") == "layer" and "add" not in told and "levels" in told and "set" in told:
        out["set"] = name("bake", told["set"])
    if "like" in told:
        out["like"] = named(painting, told["like"])
    return out


def picture(painting, place, cache=None):
    """What is seen at a place, through a cache or without."""
    return composite(painting.root, *place, partial(layer_planes, cache=cache))


def seen(painting):
    """What is seen at all places, on one thread."""
    return [picture(painting, place) for place in PLACES]


def seen_by_two(painting):
    """What is seen at all places, and once more in smaller pieces, on two threads with one cache of little room."""
    cache = TileCache(1 << 20)
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda place: picture(painting, place, cache), (*PLACES, *PLACES)))


def outlook(painting):
    """All that is told of a painting, but for its pixels."""
    names = "name", "opacity", "visible", "blend", "locked", "clip", "role", "alpha_locked", "isolated", "pose", "part"
    nodes = [
        (type(node).__name__, *(getattr(node, name, None) for name in (*names, "repeat", "wrap")))
        for node in layers.walk(painting.root)
    ]
    return nodes, painting.frame, painting.paper, painting.active, dict(painting.guides), dict(painting.bookmarks)


def selected(painting):
    """What is selected, what was kept, and the masks."""
    masks = [getattr(node, "mask", None) for node in layers.walk(painting.root)]
    return [painting.selection, *(painting.selections[name] for name in sorted(painting.selections)), *masks]


def assert_alike(one, other):
    """Two paintings are the same in all that can be told and seen."""
    assert outlook(one) == outlook(other)
    assert set(one.selections) == set(other.selections)
    one, other = settled(one, 1), settled(other, 2)
    for a, b in zip(seen(one) * 2, seen_by_two(other), strict=True):
        assert (a is None) == (b is None)
        assert np.array_equal(a, b)
    for a, b in zip(selected(one), selected(other), strict=True):
        assert (a is None) == (b is None)
        assert a is None or all(np.array_equal(a.part(*place), b.part(*place)) for place in PLACES)


def _paint(painting, name, level, rect):
    node = layers.find(painting.root, name) if layers.has(painting.root, name) else None
    return evaluate(node.pyramid, level, rect).rgba if isinstance(node, Layer) and node.wrap is None else 0.0


def assert_limited(before, after, command):
    """What a stroke or fill changes of its layer lies within what was selected."""
    level = command.level if isinstance(command, c.Stroke) or command.like is None else command.like.level
    name = command.layer or after.active
    if before.selection is None or name is None or abs(level) > 9:
        return
    x, y = (0, 0) if level < 0 else (40 << level, 30 << level)
    rect = Rect.at(x - 30, y - 30, 120, 120)
    changed = np.broadcast_to(_paint(before, name, level, rect) != _paint(after, name, level, rect), (4, 120, 120))
    outside = before.selection.part(level, rect) == 0
    assert not (changed.any(axis=0) & outside).any(), level


def carried_out(session, told):
    """Does a command and returns it, None if there is no such; or it is refused in a line, and nothing changes."""
    before, count, why = session.painting, len(session.log), ""
    try:
        command = c.parse(named(before, told))
    except FieldError as error:
        command, why = None, str(error)
    if command is not None:
        try:
            session.do(command)
        except (Refusal, FieldError, FileError) as error:
            why = str(error)
    if why:
        assert 5 < len(why) < 500, why
        assert "\n" not in why
        assert session.painting is before
        assert len(session.log) == count
        return command
    if isinstance(command, c.Stroke | c.Fill):
        assert_limited(before, session.painting, command)
    return command


class Wild:
    """A session of such commands, with a journal beside it, in a folder that holds the pictures that they name.

    The last `open_ended` commands have no answer in the journal: they are carried out when it is recovered."""

    def __init__(self, folder, header, commands, open_ended=2):
        self.folder = folder
        head = parse_header({"inkfall": 2, "frame": [0, 0, 96, 72], "seed": 7, **header})
        self.session = Session(first_painting(head), TileCache(32 << 20), folder=folder)
        self.first: Painting = self.session.painting
        self.journal = Journal(head_of_new(head, folder=folder), folder / "journal")
        told = [*BEGUN, *commands]
        for number, one in enumerate(told):
            self._one(one, number >= len(told) - open_ended)
        self.last: Painting = self.session.painting

    def _one(self, told, unanswered):
        log = self.session.log
        last = log[-1] if log else None
        command = carried_out(self.session, told)
        if command is None:
            return
        number = self.journal.ask(told_command(command))
        if unanswered:
            return
        if log and log[-1] is not last:
            self.journal.answer(number, Kind.DONE, COMMAND + told_command(log[-1]))
        else:
            self.journal.answer(number, Kind.REFUSED)

    def assert_replayed(self):
        text = "\n".join(self.session.recording().lines()).encode()
        again = replay(read_from(io.BytesIO(text), "log", self.folder), TileCache(1 << 20))
        assert_alike(self.last, again.painting)

    def assert_saved(self):
        path = self.folder / "wild.ora"
        save(path, Snapshot(self.last, self.session.recording()))
        found = open_painting(path)
        assert found.native, found.notes
        assert_alike(self.last, found.painting)

    def assert_recovered(self):
        self.journal.close(End.STAYS)
        (entry,) = (self.folder / "journal").iterdir()
        found = recovered(entry)
        assert not found.missing
        assert_alike(self.last, found.session.painting)

    def assert_undone(self):
        """All is taken back, and done again; what is no step stays."""
        cursor = self.session
        there = cursor.history.redo_count
        for _ in range(2):
            cursor.do(c.Undo(1000))
            assert_alike(settled(cursor.painting, 1), replaced(self.first, cursor.painting))
            cursor.do(c.Redo(1000))
        if not there:
            assert_alike(replaced(self.last, cursor.painting), cursor.painting)

    def check(self):
        """Asserts all of it."""
        self.assert_replayed()
        self.assert_saved()
        self.assert_recovered()
        self.assert_undone()


def replaced(painting, by):
    """A painting with what undo leaves alone of another."""
    return replace(painting, bookmarks=by.bookmarks, active=by.active)
