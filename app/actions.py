"""The table of actions: name, menu, keys, when allowed, what it does; those of no menu are offers of notices.

Menus, keys, tooltips and the list of keys are made from it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from app.desk import offers
from app.desk.desk import Desk
from app.desk.hand import BLACK, WHITE
from app.desk.known import moved_by
from app.desk.places import going
from engine.painting import commands as c
from engine.studio.filing.film_requests import StopFilm
from engine.studio.requests import Do

Check = Callable[[Desk], bool]
_ASIDE = 40  # points of the screen by which what is shown again lies beside itself, down and to the right


class Action(NamedTuple):
    """One thing the artist can do.  `keys`: such as `Ctrl+Shift+Z`, the first is shown in menus."""

    title: str
    menu: str
    keys: tuple[str, ...]
    hint: str
    do: Callable[[Desk], None]
    when: Check = lambda desk: True
    checked: Check | None = None


def _always(_desk: Desk) -> bool:
    return True


def _ready(desk: Desk) -> bool:
    return desk.known.ready and not desk.painting


def _has_file(desk: Desk) -> bool:
    return _ready(desk) and desk.known.path is not None


def _idle(desk: Desk) -> bool:
    return not desk.painting


def _filming(desk: Desk) -> bool:
    return desk.known.filming is not None


def _can_film(desk: Desk) -> bool:
    return _ready(desk) and not _filming(desk)


def _stop_film(desk: Desk) -> None:
    desk.post(StopFilm())


def _layer(desk: Desk) -> bool:
    return _ready(desk) and desk.known.scene is not None and desk.known.scene.active is not None


def _hidden(desk: Desk) -> bool:
    return _ready(desk) and bool(desk.known.hiding)


def _can_undo(desk: Desk) -> bool:
    scene = desk.known.scene
    return _ready(desk) and scene is not None and (scene.can_undo or desk.behind())  # a stroke may still be laid


def _can_redo(desk: Desk) -> bool:
    return _ready(desk) and desk.known.scene is not None and desk.known.scene.can_redo


def _back(desk: Desk) -> bool:
    return desk.places.trail.can_go_back and not desk.painting


def _forward(desk: Desk) -> bool:
    return desk.places.trail.can_go_forward and not desk.painting


def _lost(desk: Desk) -> bool:
    return desk.places.lost and not desk.painting


def _posts(make: Callable[[], c.Command]) -> Callable[[Desk], None]:
    return lambda desk: desk.post(Do(make()))


def _tool(name: str) -> Callable[[Desk], None]:
    def choose(desk: Desk) -> None:
        desk.hand.use(name)

    return choose


def _is(name: str) -> Check:
    return lambda desk: desk.hand.tool == name and not desk.hand.erasing


def _erasing(desk: Desk) -> bool:
    return desk.hand.erasing


def _toggle_eraser(desk: Desk) -> None:
    desk.hand.erase(not desk.hand.erasing)


def _swap(desk: Desk) -> None:
    desk.hand.swap()


def _default_colours(desk: Desk) -> None:
    desk.hand.colour, desk.hand.other_colour = BLACK, WHITE


def _zooms(levels: float) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        desk.glide.zoom(desk.view, levels, *desk.middle())

    return do


def _one_to_one(desk: Desk) -> None:
    desk.glide.to(desk.view, 0, 0.0, *desk.middle())


def _turns(degrees: float) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        desk.view = desk.view.turned(desk.view.angle + math.radians(degrees), *desk.middle())
        desk.glide.stop()

    return do


def _upright(desk: Desk) -> None:
    desk.view = desk.view.turned(0.0, *desk.middle())
    desk.glide.stop()


def _mirror(desk: Desk) -> None:
    place = desk.view.to_canvas(*desk.middle())
    desk.view = desk.view.flipped().held(place, *desk.middle())
    desk.glide.stop()


def _panels(desk: Desk) -> None:
    desk.panels = not desk.panels


def _strip(name: str) -> Callable[[Desk], None]:
    def toggle(desk: Desk) -> None:
        desk.strip = "" if desk.strip == name else name
        desk.panels = desk.panels or bool(desk.strip)

    return toggle


def _open(name: str) -> Check:
    return lambda desk: desk.strip == name


def _asks_here(desk: Desk) -> None:
    desk.strip, desk.panels = "history", True
    desk.past.listing, desk.past.asking = "here", True


def _looking_back(desk: Desk) -> bool:
    return desk.past.looking is not None


def _to_now(desk: Desk) -> None:
    desk.past.look(desk.post, None)


def _steps(by: int) -> Callable[[Desk], None]:
    return lambda desk: going.step(desk, by)


def _bookmark(desk: Desk) -> None:
    taken = {mark.name for mark in desk.known.scene.bookmarks} if desk.known.scene else set()
    bookmark = going.bookmark_here(desk, _free("Place", taken))
    if bookmark is not None:
        desk.post(Do(bookmark))
        desk.say(f"Bookmarked as “{bookmark.name}”", offer="" if desk.strip == "places" else "places")


def _type_place(desk: Desk) -> None:
    desk.places.typed, desk.places.fault = going.typed_text(desk), ""


def _escape(desk: Desk) -> None:
    if desk.known.opening is not None:
        desk.stop_opening()
        return
    desk.match.marking = None
    desk.past.asking = False
    if desk.past.looking is not None:
        _to_now(desk)
    desk.examples.swapping = False
    desk.hand.use("brush")


def next_layer_name(desk: Desk, stem: str) -> str:
    """`stem` with the first number that no layer has yet."""
    return _free(stem, {row.name for row in desk.known.scene.layers} if desk.known.scene else set())


def _free(stem: str, taken: set[str]) -> str:
    n = 1
    while f"{stem} {n}" in taken:
        n += 1
    return f"{stem} {n}"


def _add(kind: str, stem: str) -> Callable[[Desk], None]:
    return lambda desk: desk.post(Do(c.AddLayer(next_layer_name(desk, stem), kind=kind)))


def _active(desk: Desk) -> str:
    assert desk.known.scene is not None
    assert desk.known.scene.active is not None
    return desk.known.scene.active


def _duplicate(desk: Desk) -> None:
    name = _active(desk)
    desk.post(Do(c.DuplicateLayer(name, next_layer_name(desk, f"{name} copy"))))


def _show_again(desk: Desk) -> None:
    name, aside = _active(desk), round(_ASIDE * desk.scale)
    placing = c.Placing(of=name, at=(aside, aside), level=desk.view.shown_level)
    taken = {row.name for row in desk.known.scene.layers} if desk.known.scene else set()
    wanted = f"{name} again"
    desk.post(Do(c.AddPlacement(wanted if wanted not in taken else next_layer_name(desk, wanted), placing)))


def _nudges(x: int, y: int) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        row = desk.known.active
        if row is not None and not row.locked and desk.past.looking is None:
            desk.post(Do(c.SetLayer(row.name, placing=moved_by(row, desk.view.shown_level, x, y))))

    return do


def _remove(desk: Desk) -> None:
    desk.post(Do(c.RemoveLayer(_active(desk))))


def _show(desk: Desk) -> None:
    for name in desk.known.hiding:
        desk.post(Do(c.SetLayer(name, visible=True)))


def _moves(by: int) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        row = next((r for r in desk.known.scene.layers if r.name == _active(desk)), None) if desk.known.scene else None
        if row is not None and row.position + by >= 0:
            desk.post(Do(c.MoveLayer(row.name, row.position + by)))

    return do


def _asks(name: str) -> Callable[[Desk], None]:
    return lambda desk: desk.asked.show(name)


def _asks_guarded(name: str) -> Callable[[Desk], None]:
    return lambda desk: desk.guard(lambda: desk.asked.show(name))


def _stopped(desk: Desk) -> bool:
    return desk.notices.offering("start_engine") is not None


def close(desk: Desk) -> None:
    """Closes the window, after asking about a film that is being made and about unsaved changes."""
    if _filming(desk):
        desk.asked.show("filming")
    else:
        desk.guard(desk.asked.close)


A = Action
ACTIONS: dict[str, Action] = {
    "new": A("New…", "File", ("Ctrl+N",), "Start a new painting", _asks_guarded("new"), _ready),
    "open": A("Open…", "File", ("Ctrl+O",), "Open a painting, a picture or a recording", _asks_guarded("open"), _ready),
    "save": A("Save", "File", ("Ctrl+S",), "Save the painting; you can go on painting meanwhile", Desk.save, _ready),
    "save_as": A("Save as…", "File", ("Ctrl+Shift+S",), "Save under another name", _asks("save as"), _ready),
    "earlier": A("Earlier versions…", "File", (), "What the last saves replaced", _asks("earlier"), _has_file),
    "export": A("Export picture…", "File", ("Ctrl+E",), "Write the frame as PNG or TIFF", _asks("export"), _ready),
    "try_again": A("Try again", "", (), "Try once more what did not work", offers.try_again, offers.can_try),
    "free_space": A("Free space", "", (), "Tell how much room is left, and show the folder", offers.free_space),
    "bin": A("Bin…", "File", (), "Paintings that were closed without saving, or discarded", _asks("bin"), _idle),
    "start_engine": A(
        "Start it again",
        "",
        (),
        "Start the paint engine, with the painting as it was",
        lambda desk: desk.start_engine(),
        _stopped,
    ),
    "film": A("Film…", "File", ("Ctrl+Shift+E",), "Film how it was made, or a flight", _asks("film"), _can_film),
    "stop_film": A("Stop film", "File", (), "Stop making the film; no file is written", _stop_film, _filming),
    "quit": A("Quit", "File", ("Ctrl+Q",), "Close the window", close),
    "undo": A("Undo", "Edit", ("Ctrl+Z",), "Take back the last step", _posts(c.Undo), _can_undo),
    "redo": A("Redo", "Edit", ("Ctrl+Shift+Z", "Ctrl+Y"), "Do again what was taken back", _posts(c.Redo), _can_redo),
    "here": A("What was painted here?", "Edit", ("W",), "The strokes that show at a place", _asks_here, _ready),
    "now": A("Back to now", "Edit", (), "See the painting as it is, after looking back", _to_now, _looking_back),
    "swap": A("Swap colours", "Edit", ("X",), "Swap the two colours", _swap),
    "default": A("Black and white", "Edit", ("D",), "Set the colours to black and white", _default_colours),
    "brush": A("Brush", "Tools", ("B",), "Paint", _tool("brush"), _always, _is("brush")),
    "eraser": A("Eraser", "Tools", ("E",), "Erase; again to paint", _toggle_eraser, _always, _erasing),
    "pick": A("Pick colour", "Tools", ("I",), "Take a colour from the picture", _tool("pick"), _always, _is("pick")),
    "move": A("Move", "Tools", ("V",), "Drag the layer", _tool("move"), _always, _is("move")),
    "pan": A("Pan", "Tools", ("H",), "Drag the picture", _tool("pan"), _always, _is("pan")),
    "zoom": A("Zoom", "Tools", ("Z",), "Drag to zoom", _tool("zoom"), _always, _is("zoom")),
    "turn": A("Turn", "Tools", ("R",), "Drag to turn the view", _tool("turn"), _always, _is("turn")),
    "smaller": A("Smaller brush", "Tools", ("[",), "Make the brush smaller", lambda d: d.hand.resize(1 / 1.15)),
    "larger": A("Larger brush", "Tools", ("]",), "Make the brush larger", lambda d: d.hand.resize(1.15)),
    "escape": A("Back to the brush", "Tools", ("Escape",), "Stop what is going on; back to the brush", _escape),
    "add_layer": A("New layer", "Layer", ("Ctrl+Shift+N",), "Add a layer above", _add("layer", "Layer"), _ready),
    "add_group": A("New group", "Layer", ("Ctrl+G",), "Add a group above", _add("group", "Group"), _ready),
    "duplicate": A("Duplicate", "Layer", ("Ctrl+J",), "Copy the layer", _duplicate, _layer),
    "show_again": A(
        "Show again", "Layer", (), "Show the layer once more: what is painted on it shows there", _show_again, _layer
    ),
    "raise": A("Move up", "Layer", ("Ctrl+PageUp",), "Move the layer up", _moves(1), _layer),
    "lower": A("Move down", "Layer", ("Ctrl+PageDown",), "Move the layer down", _moves(-1), _layer),
    "remove": A("Delete", "Layer", ("Shift+Delete",), "Delete the layer", _remove, _layer),
    "left": A("Nudge left", "Layer", ("Left",), "Move the layer by a pixel of what you see", _nudges(-1, 0), _layer),
    "right": A("Nudge right", "Layer", ("Right",), "Move the layer by a pixel of what you see", _nudges(1, 0), _layer),
    "up": A("Nudge up", "Layer", ("Up",), "Move the layer by a pixel of what you see", _nudges(0, -1), _layer),
    "down": A("Nudge down", "Layer", ("Down",), "Move the layer by a pixel of what you see", _nudges(0, 1), _layer),
    "show_layer": A("Show layer", "Layer", (), "Show the layer, and the groups around it", _show, _hidden),
    "fit": A("Fit the frame", "View", ("F", "2"), "Show the whole frame", Desk.fit),
    "one": A("One to one", "View", ("1",), "One pixel of level 0 on one of the screen", _one_to_one),
    "in": A("Zoom in", "View", ("+", "=", "PageUp"), "One level deeper", _zooms(1.0)),
    "out": A("Zoom out", "View", ("-", "PageDown"), "One level back", _zooms(-1.0)),
    "turn_left": A("Turn left", "View", ("4",), "Turn the view by 15° to the left", _turns(-15)),
    "turn_right": A("Turn right", "View", ("6",), "Turn the view by 15° to the right", _turns(15)),
    "upright": A("Upright", "View", ("5",), "Turn the view upright", _upright),
    "mirror": A("Mirror", "View", ("M",), "Mirror the view", _mirror, _always, lambda d: d.view.mirrored),
    "panels": A("Panels", "View", ("Tab",), "Show or hide the panels", _panels, _always, lambda d: d.panels),
    "lab": A("Texture lab", "View", ("L",), "Paint a texture by its spectrum", _strip("lab"), _ready, _open("lab")),
    "analysis": A(
        "Analysis", "View", ("A",), "What the painting is made of", _strip("analysis"), _ready, _open("analysis")
    ),
    "match": A(
        "Match a texture", "View", ("T",), "Make a texture like an example", _strip("match"), _ready, _open("match")
    ),
    "examples": A(
        "Examples", "View", ("P",), "Paint with textures that have a rim", _strip("examples"), _ready, _open("examples")
    ),
    "history": A(
        "History", "View", ("Ctrl+H",), "Every step, to go back to", _strip("history"), _ready, _open("history")
    ),
    "back": A("Back", "Go", ("Alt+Left",), "To where you were before; the mouse’s back button, too", _steps(-1), _back),
    "forward": A("Forward", "Go", ("Alt+Right",), "To where you came back from", _steps(1), _forward),
    "nearest": A("Nearest paint", "Go", ("Home",), "Go to the nearest paint", going.go_to_nearest, _lost),
    "type_place": A("Go to place", "Go", ("Ctrl+L",), "Type or copy level and place", _type_place),
    "bookmark": A("Bookmark this view", "Go", ("Ctrl+B",), "Keep this view under a name", _bookmark, _ready),
    "places": A("Places", "Go", ("G",), "Bookmarks, and a map of the paint", _strip("places"), _ready, _open("places")),
    "keys": A("Keys…", "Help", ("F1",), "All keys in one list", _asks("keys")),
    "copy_details": A("Copy details", "Help", (), "Copy versions and the last faults", offers.copy_details),
    "about": A("About Inkfall…", "Help", (), "What this program is", _asks("about")),
}  # fmt: skip
MENUS = ("File", "Edit", "Tools", "Layer", "View", "Go", "Help")


def by_key(keys: str) -> Action | None:
    """Returns the action that a key press such as `Ctrl+S` means."""
    return _BY_KEY.get(keys)


_BY_KEY = {key: action for action in ACTIONS.values() for key in action.keys}


def perform(desk: Desk, action: Action) -> bool:
    """Does it if it is allowed now."""
    if not action.when(desk):
        return False
    action.do(desk)
    return True


def tip(name: str) -> str:
    """Returns an action's hint with its keys, for tooltips."""
    action = ACTIONS[name]
    return f"{action.hint}  ({action.keys[0]})" if action.keys else action.hint
