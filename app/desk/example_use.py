"""Painting with an example: the brush takes one, at a size that fits what is seen; new ones come into the palette."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from immutables import Map

from app.desk import example_state, own_example_files, palette, presets
from app.desk.desk import Desk
from app.desk.example_state import Entry
from engine.brush.settings import Brush
from engine.painting.commands import Swap
from engine.studio.requests import Do, GetReady

NEAR = 1  # levels: an example that is chosen so near to where the last one was has the same pixels


def stock(desk: Desk) -> None:
    """Puts all examples into the palette; says which files are none."""
    found, faults = example_state.load(example_state.bundled_folder(), False)
    own, more = example_state.load(example_state.own_folder(), True)
    desk.examples.entries = tuple(example_state.arranged([*found, *own]))
    for fault in faults + more:
        desk.say(fault, bad=True)
    gather(desk)


def gather(desk: Desk) -> None:
    """Lists those that only the painting has, too."""
    state = desk.examples
    here = () if desk.known.scene is None else example_state.here(desk.known.scene.definitions, state)
    state.entries = tuple(example_state.arranged([*(entry for entry in state.entries if entry.here is None), *here]))
    if state.group not in (example_state.ALL, *state.groups()):
        state.group = example_state.ALL


def prepare(desk: Desk, now: float) -> None:
    """Has the engine get ready for examples, once, when the palette is open or something is painted with one."""
    state = desk.examples
    given = () if desk.known.scene is None else desk.known.scene.texture_kinds
    used = (
        desk.hand.brush.mode == "example"
        or desk.strip == "examples"
        or any(kind == example_state.KIND for _, kind in given)
    )
    if used and not state.prepared:
        state.prepared = True
        desk.learn(preparing=now)
        desk.post(GetReady())


def choose(desk: Desk, entry: Entry) -> None:
    """The brush paints with an example from now on, as large as its pixels are where the view is now."""
    state, level = desk.examples, desk.view.shown_level
    state.chosen = entry.ident
    if desk.hand.brush.mode != "example" or abs(level - state.base) > NEAR:
        state.base = level
    if desk.hand.brush.mode != "example":  # the tip and the width of a pencil, say, are not for this
        desk.hand.take(Brush(radius=state.radius, hardness=1.0), "")
    take(desk)


def take(desk: Desk) -> None:
    """The brush gets the chosen example with its settings, the painting with the first stroke; without one, the palette
    opens."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None:
        desk.strip, desk.panels, state.tab = "examples", True, "palette"
        return
    name, needs = state.needs(entry)
    others = (need for need in desk.hand.needs if need.name != name)
    desk.hand.take(replace(desk.hand.brush, mode="example", example=name), needs=(*others, *needs))
    desk.hand.use("brush")
    follow(desk)


def follow(desk: Desk) -> None:
    """The brush has the size and depth that are set."""
    state = desk.examples
    if desk.hand.brush.mode == "example":
        members: dict[str, Any] = {**state.levels(), "depth": float(state.depth)}
        desk.hand.change(**members)


def adopt(desk: Desk) -> None:
    """The panel shows what a brush has that came with an example of its own; its size fits what is seen."""
    state, brush = desk.examples, desk.hand.brush
    if brush.mode != "example":
        return
    need = next((need for need in desk.hand.needs if need.name == brush.example), None)
    told = None if need is None else need.arguments.get("bundled", need.arguments.get("path"))
    found = (entry for entry in state.entries if told in (str(entry.picture), None if entry.own else entry.name))
    entry = next(found, None) if told is not None else None
    state.chosen = entry.ident if entry is not None else ""
    state.size, state.depth = -brush.example_detail, round(brush.depth or 0)
    fit(desk)


def fit(desk: Desk) -> None:
    """The texture's size goes by the pixels that are seen now."""
    desk.examples.base = desk.view.shown_level
    follow(desk)


def reach(desk: Desk) -> None:
    """Before a stroke: the texture's size is fitted anew where the view is too far from where it was chosen."""
    if desk.hand.brush.mode == "example" and not example_state.within_reach(desk.hand.brush, desk.view.shown_level):
        fit(desk)
        desk.say("The texture’s size was set too far away: it fits this zoom now")


def swap(desk: Desk, x: float, y: float) -> None:
    """The texture at a point of the screen becomes like the chosen example."""
    level = desk.view.shown_level
    desk.examples.swapping = False
    take(desk)
    palette.provide(desk)
    if desk.hand.brush.example is not None:
        at = desk.view.to_canvas(x, y).pixel(level)
        desk.post(Do(Swap(level, at, desk.hand.brush.example, detail=desk.hand.brush.example_detail)))


# --- the artist's own ------------------------------------------------------------------------------------------------


def dropped(desk: Desk, path: Path) -> bool:
    """Takes a picture that was dropped on the window while the palette is open; False if it is none."""
    if desk.strip != "examples" or not desk.panels or path.suffix.lower() not in example_state.PICTURES:
        return False
    add(desk, path)
    return True


def add(desk: Desk, path: Path) -> None:
    """A picture becomes an example of the artist's own, whose region is to be painted."""
    try:
        name, smaller = own_example_files.add(path)
    except own_example_files.FAULTS as error:
        desk.say(str(error), bad=True)
        return
    _refresh(desk, name)
    edit(desk)
    mask = desk.examples.mask
    if mask is not None and mask.opaque:
        mask.way = "colour"  # what is to be cut out of a photograph is its background
    size = f", made smaller: at most {own_example_files.SIDE} pixels" if smaller else ""
    desk.say(f"Added the example “{_title(desk)}”{size}")


def edit(desk: Desk) -> None:
    """Opens the chosen example's region."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None:
        return
    try:
        if entry.ident not in state.masks:
            state.masks[entry.ident] = own_example_files.opened(entry)
    except own_example_files.FAULTS as error:
        desk.say(str(error), bad=True)
    else:
        state.tab = "region"


def save_region(desk: Desk) -> None:
    """Writes the region that was painted; one of an example that comes along goes to a copy of the artist's own."""
    state, entry, mask = desk.examples, desk.examples.entry, desk.examples.mask
    if entry is None or mask is None:
        return
    if not mask.inside.any():
        desk.say("The region is empty: paint something in first", bad=True)
        return
    try:
        name = entry.name if entry.own else own_example_files.copy(entry, state.draft(entry))
        own_example_files.write_region(name, mask.inside)
    except own_example_files.FAULTS as error:
        desk.say(str(error), bad=True)
        return
    mask.saved, mask.dirty = mask.version, mask.whole  # it is shown under another name from now on
    state.masks[f"own {name}"] = state.masks.pop(entry.ident)
    _refresh(desk, name)
    desk.say(f"Saved the region of “{_title(desk)}”" + ("" if entry.own else ", an example of your own now"))


def use_settings(desk: Desk) -> None:
    """Paints with the settings as they are; the artist's own example keeps them."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None:
        return
    if not entry.own:
        state.used[entry.ident] = state.drafts.get(entry.ident, state.used.get(entry.ident, Map()))
        take(desk)
        return
    try:
        own_example_files.write_parameters(entry.name, state.draft(entry), entry.given)
    except own_example_files.FAULTS as error:
        desk.say(str(error), bad=True)
        return
    state.drafts.pop(entry.ident, None)
    _refresh(desk, entry.name)


def keep_settings(desk: Desk) -> None:
    """Makes an example of the artist's own with the settings as they are."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None:
        return
    try:
        name = own_example_files.copy(entry, state.draft(entry))
    except own_example_files.FAULTS as error:
        desk.say(str(error), bad=True)
        return
    state.drafts.pop(entry.ident, None)
    _refresh(desk, name)
    desk.say(f"Saved as “{_title(desk)}”, an example of your own")


def rename(desk: Desk, entry: Entry, text: str) -> None:
    """Calls one of the artist's own something else; its files stay where brushes and paintings know them."""
    title = example_state.renamed(text, entry, desk.examples.entries)
    if not title or title == entry.title:
        return
    try:
        own_example_files.write_parameters(entry.name, entry.parameters, title)
    except own_example_files.FAULTS as error:
        desk.say(f"The example was not renamed: {error}", bad=True)
        return
    painting = desk.examples.chosen == entry.ident and desk.hand.brush.mode == "example"
    kept = (need for need in desk.hand.needs if need.arguments.get("path") != str(entry.picture))
    desk.hand.take(desk.hand.brush, needs=tuple(kept))
    _refresh(desk, entry.name if painting else "")
    desk.say(f"“{entry.title}” is called “{title}” now")


def users(desk: Desk, entry: Entry) -> str:
    """What is painted with one of the artist's own: the painting, brushes; empty if nothing is."""
    scene, path = desk.known.scene, str(entry.picture)
    found = ["this painting"] if scene is not None and example_state.in_painting(entry, scene.definitions) else []
    found += [
        f"the brush “{preset.name}”"
        for preset in desk.known.presets
        if any(need.arguments.get("path") == path for need in preset.textures)
    ]
    return " and ".join(found[:2]) + (" and more" if len(found) > 2 else "")


def delete(desk: Desk, entry: Entry) -> None:
    """Takes one of the artist's own away.  A painting that has it keeps it; a brush does not paint with it any more."""
    try:
        own_example_files.delete(entry.name)
    except own_example_files.FAULTS as error:
        desk.say(f"The example was not deleted: {error}", bad=True)
        return
    state = desk.examples
    state.masks.pop(entry.ident, None)
    state.entries = tuple(one for one in state.entries if one is not entry)
    if state.chosen == entry.ident:
        state.chosen, state.tab = "", "palette"
    gather(desk)
    _without(desk, entry)
    desk.say(f"Deleted the example “{entry.title}”")


def _without(desk: Desk, entry: Entry) -> None:
    """The brush that painted with it takes what the painting has of it, or is another one."""
    need = next((need for need in desk.hand.needs if need.name == desk.hand.brush.example), None)
    if desk.hand.brush.mode != "example" or need is None or need.arguments.get("path") != str(entry.picture):
        return
    same = (one for one in desk.examples.entries if one.here is not None and one.here.get("path") == str(entry.picture))
    left = next(same, None)
    if left is not None:
        choose(desk, left)
    else:
        palette.take(desk, next((p for p in desk.known.presets if p.brush.mode == "paint"), presets.DEFAULT))


def _title(desk: Desk) -> str:
    """What the chosen example is called in the palette."""
    return desk.examples.entry.title if desk.examples.entry is not None else ""


def _refresh(desk: Desk, name: str) -> None:
    """The palette lists the artist's own as their files are now; the brush takes one of them."""
    state = desk.examples
    own, faults = example_state.load(example_state.own_folder(), True)
    state.entries = tuple(example_state.arranged([*(entry for entry in state.entries if not entry.own), *own]))
    for fault in faults:
        desk.say(fault, bad=True)
    gather(desk)
    entry = next((entry for entry in own if entry.name == name), None)
    if entry is not None:
        if state.group not in (example_state.ALL, example_state.OWN):
            state.group = example_state.ALL
        choose(desk, entry)
