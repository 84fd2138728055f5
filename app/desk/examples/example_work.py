"""The artist's own examples: their files are made, changed and taken away on the files' thread, then the palette lists
them as they are."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from immutables import Map

from app.desk import palette, presets
from app.desk.desk import Desk, FileWork
from app.desk.examples import example_state, own_example_files
from app.desk.examples.example_state import Entry
from app.desk.examples.example_use import choose, gather, take_example
from app.desk.examples.finding_state import FindingState
from app.desk.examples.region_state import RegionState
from engine.studio.textures.texture_requests import RegionClose, RegionOpen, RegionSaved
from engine.studio.textures.texture_results import RegionScene
from engine.texture.example.parameters import Parameters


class Listing(NamedTuple):
    """The artist's own as their files are, a line for each file that is at fault, and the name of one of them."""

    entries: tuple[Entry, ...]
    faults: tuple[str, ...]
    name: str = ""


def listing_of(name: str) -> Listing:
    """Reads the artist's own as their files are; `name`: of the one to paint with."""
    entries, faults = example_state.load_examples(example_state.own_folder(), True)
    return Listing(tuple(entries), tuple(faults), name)


def relist(desk: Desk, listing: Listing) -> None:
    """The palette lists the artist's own as their files are now; the brush takes the one that is named."""
    state = desk.examples
    others = (entry for entry in state.entries if not entry.own)
    state.entries = tuple(example_state.arranged([*others, *listing.entries]))
    for fault in listing.faults:
        desk.say(fault, bad=True)
    gather(desk)
    entry = next((entry for entry in listing.entries if entry.name == listing.name), None)
    if entry is not None:
        if state.group not in (example_state.ALL, example_state.OWN):
            state.group = example_state.ALL
        choose(desk, entry)


def dropped(desk: Desk, path: Path) -> bool:
    """Takes a picture that was dropped on the window while the palette is open; False if it is none."""
    if desk.strip != "examples" or not desk.panels or path.suffix.lower() not in example_state.PICTURES:
        return False
    add(desk, path)
    return True


# --- a picture of one's own ------------------------------------------------------------------------------------------


class _Added(NamedTuple):
    listing: Listing
    smaller: bool
    region: RegionOpen
    pixels: np.ndarray


@dataclass(frozen=True, slots=True)
class _Add(FileWork):
    path: Path
    shown: bool

    def carry_out(self) -> _Added:
        name, smaller = own_example_files.add(self.path)
        listing = listing_of(name)
        entry = next(entry for entry in listing.entries if entry.name == name)
        return _Added(listing, smaller, own_example_files.opening_of(entry), own_example_files.read_only(entry))

    def arrive(self, desk: Desk, found: _Added) -> None:
        relist(desk, found.listing)
        if self.shown:
            desk.examples.opening = found.region.ident
        desk.post(found.region)
        if found.pixels[..., 3].min() == 255:  # no holes tell what of it is meant
            desk.examples.finding = FindingState.of(found.region.ident, found.pixels, fresh=True)
            desk.examples.finding.ask(desk.post)
        size = f", made smaller: at most {own_example_files.SIDE} pixels" if found.smaller else ""
        desk.say(f"Added the example “{_title(desk)}”{size}")


def add(desk: Desk, path: Path, shown: bool = True) -> None:
    """A picture becomes an example of the artist's own, whose region is found, or is to be painted; `shown`: the page
    of the region comes up then."""
    desk.say(f"Adding {path.name}")
    desk.work(_Add(path, shown))


# --- the region ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Edit(FileWork):
    entry: Entry

    def carry_out(self) -> RegionOpen:
        return own_example_files.opening_of(self.entry)

    def arrive(self, desk: Desk, found: RegionOpen) -> None:
        desk.post(found)

    def fail(self, desk: Desk, fault: str) -> None:
        desk.examples.opening = ""
        desk.say(fault, bad=True)


def edit(desk: Desk) -> None:
    """Opens the chosen example's region."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None or state.opening == entry.ident:
        return
    if state.region is None:
        state.opening = entry.ident
        desk.work(_Edit(entry))
    else:
        state.tab = "region"


def take_scene(desk: Desk, scene: RegionScene) -> None:
    """Takes over what the engine tells of a region; one that was just opened is shown."""
    state, known = desk.examples, desk.examples.regions.get(scene.ident)
    if known is not None:
        known.scene = scene
    elif any(entry.ident == scene.ident for entry in state.entries):  # not deleted meanwhile
        state.regions[scene.ident] = RegionState.of(scene)
    if state.opening == scene.ident:
        state.opening = ""
        if state.chosen == scene.ident and state.tab != "maps":
            state.tab = "region"


@dataclass(frozen=True, slots=True)
class _SaveRegion(FileWork):
    entry: Entry
    parameters: Parameters
    scene: RegionScene

    def carry_out(self) -> Listing:
        return listing_of(own_example_files.save_region(self.entry, self.parameters, self.scene))

    def arrive(self, desk: Desk, found: Listing) -> None:
        state, name = desk.examples, f"own {found.name}"
        known = state.regions.pop(self.entry.ident, None)
        if known is not None:
            known.scene = replace(known.scene, ident=name)
            state.regions[name] = known
            desk.post(RegionSaved(self.entry.ident, name, self.scene.steps))
        relist(desk, found)
        desk.say(f"Saved the region of “{_title(desk)}”" + ("" if self.entry.own else ", an example of your own now"))


def save_region(desk: Desk) -> None:
    """Writes the region that was painted; one of an example that comes along goes to a copy of the artist's own."""
    state, entry, region = desk.examples, desk.examples.entry, desk.examples.region
    if entry is None or region is None:
        return
    if not region.scene.inside.any():
        desk.say("The region is empty: paint something in first", bad=True)
        return
    desk.work(_SaveRegion(entry, state.draft(entry), region.scene))


# --- settings and names ----------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _KeepParameters(FileWork):
    entry: Entry
    parameters: Parameters

    def carry_out(self) -> Listing:
        own_example_files.write_parameters(self.entry.name, self.parameters, self.entry.given, self.entry.maps)
        return listing_of(self.entry.name)

    def arrive(self, desk: Desk, found: Listing) -> None:
        _settle(desk, self.entry, self.parameters)
        relist(desk, found)


def use_settings(desk: Desk) -> None:
    """Paints with the settings as they are; the artist's own example keeps them."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None:
        return
    if entry.own:
        desk.work(_KeepParameters(entry, state.draft(entry)))
        return
    state.used[entry.ident] = state.drafts.get(entry.ident, state.used.get(entry.ident, Map()))
    take_example(desk)


def _settle(desk: Desk, entry: Entry, kept: Parameters) -> None:
    """What was tried is in a file now, unless more has been tried since."""
    if desk.examples.draft(entry) == kept:
        desk.examples.drafts.pop(entry.ident, None)


@dataclass(frozen=True, slots=True)
class _Copy(FileWork):
    entry: Entry
    parameters: Parameters

    def carry_out(self) -> Listing:
        return listing_of(own_example_files.copy(self.entry, self.parameters))

    def arrive(self, desk: Desk, found: Listing) -> None:
        _settle(desk, self.entry, self.parameters)
        relist(desk, found)
        desk.say(f"Saved as “{_title(desk)}”, an example of your own")


def keep_settings(desk: Desk) -> None:
    """Makes an example of the artist's own with the settings as they are."""
    entry = desk.examples.entry
    if entry is not None:
        desk.work(_Copy(entry, desk.examples.draft(entry)))


@dataclass(frozen=True, slots=True)
class _Rename(FileWork):
    entry: Entry
    title: str

    def carry_out(self) -> Listing:
        own_example_files.write_parameters(self.entry.name, self.entry.parameters, self.title, self.entry.maps)
        return listing_of(self.entry.name)

    def arrive(self, desk: Desk, found: Listing) -> None:
        painting = desk.examples.chosen == self.entry.ident and desk.hand.brush.row.grows
        kept = (need for need in desk.hand.needs if need.arguments.get("path") != str(self.entry.picture))
        desk.hand.take(desk.hand.brush, needs=tuple(kept))
        relist(desk, found if painting else found._replace(name=""))
        desk.say(f"“{self.entry.title}” is called “{self.title}” now")

    def fail(self, desk: Desk, fault: str) -> None:
        desk.say(f"The example was not renamed: {fault}", bad=True)


def rename(desk: Desk, entry: Entry, text: str) -> None:
    """Calls one of the artist's own something else; its files stay where brushes and paintings know them."""
    title = example_state.renamed(text, entry, desk.examples.entries)
    if title and title != entry.title:
        desk.work(_Rename(entry, title))


# --- deleted ---------------------------------------------------------------------------------------------------------


def users(desk: Desk, entry: Entry) -> str:
    """Returns what is painted with one of the artist's own: the painting, brushes; empty if nothing is."""
    scene, path = desk.known.scene, str(entry.picture)
    found = ["this painting"] if scene is not None and example_state.in_painting(entry, scene.definitions) else []
    found += [
        f"the brush “{preset.name}”"
        for preset in desk.known.presets
        if any(need.arguments.get("path") == path for need in preset.textures)
    ]
    return " and ".join(found[:2]) + (" and more" if len(found) > 2 else "")


@dataclass(frozen=True, slots=True)
class _Delete(FileWork):
    entry: Entry

    def carry_out(self) -> None:
        own_example_files.delete(self.entry.name)

    def arrive(self, desk: Desk, found: None) -> None:
        state, entry = desk.examples, self.entry
        if state.regions.pop(entry.ident, None) is not None:
            desk.post(RegionClose(entry.ident))
        state.entries = tuple(one for one in state.entries if one.ident != entry.ident)
        if state.chosen == entry.ident:
            state.chosen, state.tab = "", "palette"
        gather(desk)
        _without(desk, entry)
        desk.say(f"Deleted the example “{entry.title}”")

    def fail(self, desk: Desk, fault: str) -> None:
        desk.say(f"The example was not deleted: {fault}", bad=True)


def delete_example(desk: Desk, entry: Entry) -> None:
    """Takes one of the artist's own away.  A painting that has it keeps it; a brush does not paint with it any more."""
    desk.work(_Delete(entry))


def _without(desk: Desk, entry: Entry) -> None:
    """The brush that painted with it takes what the painting has of it, or is another one."""
    need = next((need for need in desk.hand.needs if need.name == desk.hand.brush.example), None)
    if not desk.hand.brush.row.grows or need is None or need.arguments.get("path") != str(entry.picture):
        return
    same = (one for one in desk.examples.entries if one.here is not None and one.here.get("path") == str(entry.picture))
    left = next(same, None)
    if left is not None:
        choose(desk, left)
    else:
        palette.take(desk, next((p for p in desk.known.presets if p.brush.row.lays_ink), presets.DEFAULT))


def _title(desk: Desk) -> str:
    """Returns what the chosen example is called in the palette."""
    return desk.examples.entry.title if desk.examples.entry is not None else ""
