"""Examples cut out of photographs: what lies on the ground is found, corrected, and taken as examples of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from immutables import Map

from app.desk.desk import Desk, FileWork
from app.desk.examples import example_work, own_example_files
from app.desk.examples.example_state import Entry
from app.desk.examples.finding_state import FindingState
from engine.studio.textures.cut_records import CutFound, FindCut
from engine.studio.textures.texture_requests import RegionClose

_NONE = np.zeros((0, 0, 4), np.uint8)


@dataclass(frozen=True, slots=True)
class _Read(FileWork):
    entry: Entry
    fresh: bool

    def carry_out(self) -> np.ndarray:
        return own_example_files.read_only(self.entry)

    def arrive(self, desk: Desk, found: np.ndarray) -> None:
        state = desk.examples
        if state.chosen == self.entry.ident:
            state.finding = FindingState.of(self.entry.ident, found, self.fresh)
            state.finding.ask(desk.post)


def finding_of(desk: Desk) -> FindingState | None:
    """Returns what is found in the picture of the chosen example, while it is."""
    finding = desk.examples.finding
    return finding if finding is not None and finding.ident == desk.examples.chosen else None


def find(desk: Desk, fresh: bool = False) -> None:
    """Finds what lies on the ground of the chosen example's picture; `fresh`: it was just added."""
    if desk.examples.entry is not None:
        desk.work(_Read(desk.examples.entry, fresh))


def leave(desk: Desk) -> None:
    """The region is painted by hand."""
    if desk.examples.finding is not None:
        desk.examples.finding = None
        desk.post(FindCut("", _NONE))


def hear(desk: Desk, found: CutFound, now: float) -> None:
    """Takes over what the engine tells; it is taken if that was asked for before it was there."""
    finding = desk.examples.finding
    if finding is None:
        return
    finding.hear(found)
    if finding.taking and finding.settled:
        take_cut(desk)


def take_cut(desk: Desk) -> None:
    """Makes examples of what was found, as soon as its rim is."""
    finding, entry = desk.examples.finding, desk.examples.entry
    if finding is None or entry is None or entry.ident != finding.ident:
        return
    finding.taking = not finding.settled
    found = finding.found
    if finding.taking or found is None or found.pixels is None:
        return
    if not found.things:
        desk.say("Nothing is left of the picture: mark what to keep", bad=True)
        return
    own = entry.own and finding.fresh and not example_work.users(desk, entry)
    desk.work(_Take(entry, found.pixels, own))


@dataclass(frozen=True, slots=True, eq=False)
class _Take(FileWork):
    """`instead`: the largest thing takes the place of the picture that it was found in."""

    entry: Entry
    pixels: np.ndarray
    instead: bool

    def carry_out(self) -> tuple[example_work.Listing, int]:
        names = own_example_files.add_cut(self.entry, self.pixels, self.instead)
        return example_work.listing_of(names[0]), len(names)

    def arrive(self, desk: Desk, found: tuple[example_work.Listing, int]) -> None:
        state, (listing, count) = desk.examples, found
        leave(desk)
        if self.instead:
            state.regions.pop(self.entry.ident, None)
            state.drafts.pop(self.entry.ident, None)
            state.used.pop(self.entry.ident, Map())
            desk.post(RegionClose(self.entry.ident))
        state.tab = "palette"
        example_work.relist(desk, listing)
        title = state.entry.title if state.entry is not None else ""
        desk.say(f"Cut out “{title}”" if count == 1 else f"Cut out {count} examples, “{title}” is the largest")
